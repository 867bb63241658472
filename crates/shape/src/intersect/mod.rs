//! Intersections: of curves with planes, of surfaces with straight lines.
//!
//! Both are roots of polynomials in Bernstein form, in one parameter or two. What is left out is left out because
//! its coefficients exclude a root in spite of rounding; what is kept is a root that is proved, or a stretch or box
//! in which rounding or a contact of higher order hides how many there are.

mod curve_plane;
mod line_patch;
mod straight;
mod system;

pub use curve_plane::{PlaneIntersection, PlanePoint};
pub use line_patch::{LineIntersection, LinePoint};
pub use straight::StraightLine;
