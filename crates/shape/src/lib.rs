//! Bézier curves, patches and triangles, polynomial and rational: control points that are checked once, and
//! everything that is asked of them.
//!
//! | | polynomial | rational | power basis |
//! | --- | --- | --- | --- |
//! | curve | [`Curve`] | [`RationalCurve`] | [`PowerCurve`] |
//! | tensor-product patch | [`Patch`] | [`RationalPatch`] | [`PowerPatch`] |
//! | triangle | [`Triangle`] | [`RationalTriangle`] | |
//!
//! A polynomial shape and its rational twin are one generic type ([`BezierCurve`], [`BezierPatch`],
//! [`BezierTriangle`]): rational control points are homogeneous, and one quotient rule ends every evaluation.
//! [`ParametricCurve`] and [`ParametricSurface`] are what all kinds answer: point, jets of any order, normal,
//! curvatures, area. Circles and conics are made by [`RationalCurve`], quadrics by [`RationalPatch`]. How two shapes
//! meet is measured by [`JoinReport`].
//!
//! ```
//! use casteljau_shape::{Curve, geom::glam::DVec3};
//! let parabola = Curve::new(vec![DVec3::ZERO, 0.5 * DVec3::X, DVec3::new(1.0, 1.0, 0.0)])?; // y = x²
//! assert_eq!(parabola.point(0.5), DVec3::new(0.5, 0.25, 0.0));
//! let exact = 5_f64.sqrt() / 2.0 + 2_f64.asinh() / 4.0;
//! assert!((parabola.arc_length(1e-12)? - exact).abs() < 1e-12 * exact);
//! # Ok::<(), casteljau_shape::ShapeError>(())
//! ```
//!
//! ```
//! use casteljau_shape::{ParametricSurface, RationalPatch, geom::glam::DVec3};
//! let octant = RationalPatch::sphere_octant(DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z)?;
//! assert!((octant.try_curvatures(0.3, 0.6)?.gaussian - 1.0).abs() < 1e-12);
//! // At the pole an edge collapses; the normal is the limit.
//! assert!(octant.normal(0.3, 1.0)?.distance(DVec3::Z) < 1e-15);
//! # Ok::<(), casteljau_shape::ShapeError>(())
//! ```

pub use casteljau_bernstein as bernstein;
pub use casteljau_geom as geom;

mod arc_length;
mod area;
mod closest;
mod conic;
mod control_point;
mod conversion;
mod curve;
mod curve_operations;
mod error;
mod intersect;
mod joins;
mod parametric;
mod patch;
mod patch_operations;
mod power;
mod quadrature;
mod quadric;
mod rational_arc_length;
mod tight_box;
mod triangle;
mod triangle_operations;

/// What shapes of every kind check their control points with, and bound themselves by.
pub mod control_net {
    pub use crate::control_point::{
        checked, distance_bound, has_hull, homogeneous, hull_box, largest_weight, lifted, points_box,
    };
    pub use crate::error::{check_degree, check_order, check_points};
    pub use crate::tight_box::{Grid, Halving, tight_box};
}

pub use area::MeasuredArea;
pub use closest::{
    CurveProjector, LocalMinima, LocalMinimum, LocalProjection, PatchProjector, Projection, TriangleProjector,
};
pub use control_point::ControlPoint;
pub use curve::{BezierCurve, Curve, RationalCurve};
pub use error::{LARGEST_COORDINATE, ShapeError};
pub use intersect::{LineIntersection, LinePoint, PlaneIntersection, PlanePoint, StraightLine};
pub use joins::{
    Continuity, CrossRatio, CurvatureCondition, JoinReport, JoinTolerance, Maximum, SurfaceEdge,
};
pub use parametric::{Parameters, ParametricCurve, ParametricSurface, SurfaceDomain};
pub use patch::{BezierPatch, Patch, RationalPatch};
pub use patch_operations::PatchEdge;
pub use power::{PowerCurve, PowerPatch};
pub use quadrature::gauss_rule;
pub use triangle::{BezierTriangle, RationalTriangle, Triangle};
