//! Indexed meshes, the sinks that receive them, and what can be measured on them.
//!
//! A tessellator pushes vertices and triangles into a [`MeshSink`]; [`TriangleMesh`] is the ready-made one. The mesh
//! answers for its topology ([`TriangleMesh::audit`], [`TriangleMesh::boundary_loops`]), its size
//! ([`TriangleMesh::area`], [`TriangleMesh::signed_volume`]) and its distance to points ([`TriangleTree`]).
//! [`VolumeMesh`] is the same for cells: tetrahedra, pyramids, wedges and hexahedra.
//! Topology is by index: vertices that only share a place are joined by [`TriangleMesh::welded`] first.
//!
//! The crate knows nothing of Bézier shapes. Nothing here panics: a mesh's fields are public, so every question checks
//! what it needs and answers with a [`MeshError`] that names the triangle or vertex.
//!
//! ```
//! use casteljau_mesh::{MeshSink, TriangleMesh, glam::DVec3};
//!
//! let mut mesh = TriangleMesh::default();
//! let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
//! for corner in corners {
//!     mesh.vertex(corner, None)?;
//! }
//! for triangle in [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]] {
//!     mesh.triangle(triangle)?;
//! }
//! assert!(mesh.audit()?.closed);
//! assert!((mesh.signed_volume()? - 1.0 / 6.0).abs() < 1e-15);
//! # Ok::<(), casteljau_mesh::MeshError>(())
//! ```

pub use casteljau_geom::{BoundingBox, glam};

mod audit;
mod boundary;
mod cell;
mod distance;
mod edges;
mod error;
mod measure;
mod sink;
mod triangle_mesh;
mod union_find;
mod volume_audit;
mod volume_mesh;
mod weld;

pub use audit::Audit;
pub use cell::Cell;
pub use distance::{Closest, Deviation, TriangleTree};
pub use error::MeshError;
pub use measure::MAX_COORDINATE;
pub use sink::{CountingSink, MeshSink};
pub use triangle_mesh::TriangleMesh;
pub use volume_audit::VolumeAudit;
pub use volume_mesh::VolumeMesh;
pub use weld::Welded;
