//! The closest point of a shape, and all places where the distance has a minimum, with a proof.
//!
//! A projector is made once for a shape: [`CurveProjector`], [`PatchProjector`], [`TriangleProjector`]. It
//! cuts the shape into pieces on which all second derivatives are bounded. A query q then walks down the tree of pieces and leaves
//! one aside for a reason that holds in spite of rounding:
//!
//! * nothing in it is closer to q than what was found already,
//! * one component of the gradient of `½|S − q|²` keeps its sign there, or the Hessian is nowhere positive
//!   semidefinite, so that minima can only lie on sides, which are curves with trees of their own, and at
//!   corners,
//! * `½|S − q|²` is convex there: Newton's method finds its minimum, and value and gradient at that place
//!   bound it from below.
//!
//! What is left when the tree ends is cut further, the most promising piece first. So the answer is the
//! global one, and it carries a lower bound of the distance as its certificate. For a q that is equally far
//! from a whole curve of the shape (on the axis of a surface of revolution, say) the proof may not end within
//! the limit of 1000 further pieces; the point is then as good as the pieces tell, and the lower bound says so.
//!
//! Weights must have one sign. Queries allocate nothing unless pieces are left when the tree ends.
//!
//! Source: Johnson and Cohen, *A framework for efficient minimum distance computations*, 1998 (bounds by
//! pieces); Hansen and Walster, *Global Optimization Using Interval Analysis*, 2nd ed., ch. 12 (monotonicity
//! and convexity tests).

mod curve;
mod minima;
mod net;
mod newton;
mod patch;
mod piece;
mod square;
mod tree;
mod triangle;

use casteljau_geom::glam::DVec3;

pub use curve::CurveProjector;
pub(crate) use minima::clusters;
pub use minima::{LocalMinima, LocalMinimum};
pub use patch::PatchProjector;
pub use triangle::TriangleProjector;

use crate::{LARGEST_COORDINATE, ShapeError};

/// A closest point of a shape with D parameters: 1 for curves, 2 for patches and triangles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Projection<const D: usize> {
    /// The parameters of the point.
    pub parameters: [f64; D],
    /// The point of the shape there.
    pub point: DVec3,
    /// Its distance from the query.
    pub distance: f64,
    /// No point of the shape is closer than this; at most `distance`.
    ///
    /// Usually the two differ by rounding, that is by at most some 100(d+2)·u times the largest coordinate
    /// (or the distance, if that is larger), d being the total degree and u = 2⁻⁵³.
    pub lower_bound: f64,
}

/// Where a local descent ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalProjection<const D: usize> {
    /// The parameters of the point.
    pub parameters: [f64; D],
    /// The point of the shape there.
    pub point: DVec3,
    /// Its distance from the query.
    pub distance: f64,
    /// Whether this is a local minimum to rounding: Newton's method came to rest with a positive Hessian on
    /// the directions that lead into the domain. `false` where it got stuck or ran out of steps.
    pub converged: bool,
}

/// A query is a finite point, not so far away that its squared distance leaves the range of numbers.
fn check_query(q: DVec3, local: DVec3) -> Result<(), ShapeError> {
    for axis in 0..3 {
        // Written so that NaN is refused.
        if !(q[axis].abs() <= LARGEST_COORDINATE && local[axis].abs() <= LARGEST_COORDINATE) {
            return Err(ShapeError::Query { axis, value: q[axis] });
        }
    }
    Ok(())
}
