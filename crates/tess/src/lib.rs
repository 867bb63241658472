//! Tessellation of Bézier shapes into meshes: plan first, then fill.
//!
//! - **Plan.** How many samples a side gets, and where they are, is decided by its curve alone ([`SideSamples`]). Two
//!   patches that share a side curve, whichever way round they store it, get the same vertices to the bit, in one call or
//!   in two. Sides are the same curve when their control points are the same (−0 counts as 0); one that is stored
//!   with a raised degree has the same points to rounding only, and a gap opens there.
//! - **Fill.** The polygon of the samples is triangulated in the domain, evened out by a linear map so that it is no more
//!   stretched than the patch. Flips, moved vertices and further points widen the angles in space; with a
//!   tolerance, edges are split until the chord error is small enough everywhere: measured at centroids and edge
//!   midpoints, except where the normals foretell less than half the tolerance. No triangle of the domain turns over, and no edge on a side is ever split.
//!
//! **Orientation.** Triangles and normals follow the order of the ribbons: seen from the tip of the normal the sides run
//! counter-clockwise. For a counter-clockwise domain that is `S_u × S_v`, for a clockwise one its opposite. On sides and
//! at corners the normal is the patch's own rule ([`ConcavePatch::normal_at`](casteljau_gb::ConcavePatch::normal_at)); where
//! a patch has none it is the mean of the triangles around, weighted by area. That neighbours agree on
//! the outside is the model's duty; the [`Report`] names the sides where they do not.
//!
//! **Angles.** Triangles that touch no side have angles above 19°, and 99 % of the others above 10°, where the sides'
//! samples and the corners allow it; the [`Report`] counts exceptions, in the domain and in space. The two pull
//! against each other where a patch is sheared; space comes first.
//!
//! **Determinism.** The same input gives the same bits.

pub use casteljau_geom as geom;

mod chart;
mod charted;
mod draft;
mod error;
mod face;
mod improve;
mod measure;
mod model;
mod options;
mod poles;
mod progress;
mod refine;
mod report;
mod side;
mod side_curve;
mod side_key;
mod sizing;
mod solid;
mod surface;
mod tessellate;
mod topology;

pub use error::TessError;
pub use face::{AsFace, Face};
pub use options::{DEFAULT_MAX_VERTICES, Density, Seams, TessellationOptions, no_progress};
pub use report::{Quality, Report, SideId};
pub use side::SideSamples;
pub use solid::{
    AsSolid, CellKind, FaceId, SectionOptions, SectionReport, SharedFaces, Skin, SkinFace, Solid, SolidField,
    VolumeOptions, VolumeReport, iso_surface, slice, tessellate_solids, volume_mesh,
};
pub use tessellate::{tessellate, tessellate_into};
