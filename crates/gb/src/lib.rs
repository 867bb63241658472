//! n-sided Generalized Bézier patches: a smooth surface over a polygon, convex or not, that follows a *ribbon* (a side's
//! curve and its cross derivatives) along each side.
//!
//! - [`Ribbon`], [`ConcavePatch`] and its builder: the patch, evaluated at parameters (u, v) of its domain polygon.
//! - [`SampleSet`] keeps the coordinates of fixed points: fresh points of an edited patch cost 0.1 µs each.
//! - [`BlendMatrix`] keeps the blends themselves: moving control points costs a matrix product.
//! - [`ContinuityReport`] measures how the patch meets its ribbons; [`ConcavePatch::continuity`] says what it promises.

pub use casteljau_domain::{CoordinateKind, Coordinates, Location, Polygon};
pub use casteljau_geom::{SurfaceJet, glam};

mod blend_matrix;
mod builder;
mod contact;
mod error;
mod formula;
mod jet;
mod normal;
mod outline;
mod patch;
mod report;
mod ribbon;
mod samples;
mod scalar;

pub use blend_matrix::BlendMatrix;
pub use builder::{
    CORNER_TOLERANCE, ConcavePatchBuilder, DEFAULT_ACCURACY, DEFAULT_BLEND_POWER, HIGH_ACCURACY,
};
pub use contact::{Contact, ContactLimit};
pub use error::{GbError, Place};
pub use outline::{ARC_LENGTH_ACCURACY, NEARLY_STRAIGHT, turning_angles};
pub use patch::{CenterWeight, ConcavePatch, CornerPoint, LayoutKind};
pub use report::{ContinuityReport, Maximum, SideReport};
pub use ribbon::Ribbon;
pub use samples::SampleSet;

/// Largest degree of a ribbon.
pub const MAX_DEGREE: usize = 20;
/// Largest number of layers of a ribbon.
pub const MAX_LAYERS: usize = 6;
/// Largest blend power p.
pub const MAX_BLEND_POWER: u32 = 64;
/// Largest absolute coordinate of a control point: products of three stay in range.
pub const MAX_COORDINATE: f64 = 1e70;
