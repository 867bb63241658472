//! Polynomials over triangles and tetrahedra, in barycentric coordinates.

mod basis;
mod de_casteljau;
mod index;
mod net;

pub use basis::{simplex_basis, simplex_basis_partials};
pub(crate) use de_casteljau::{directional, raised, step};
pub(crate) use index::step_back;
pub use index::{MultiIndices, multi_indices, simplex_count, simplex_index, simplex_partial_index};
pub use net::{SimplexNet, TetrahedronNet, TriangleNet, last_barycentric};
pub(crate) use net::{partial, value};
