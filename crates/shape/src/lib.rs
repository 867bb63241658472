//! Bézier curves and patches: control points that are checked once, and jets of them.
//!
//! ```
//! use casteljau_shape::{Curve, geom::glam::DVec3};
//! let parabola = Curve::new(vec![DVec3::ZERO, 0.5 * DVec3::X, DVec3::new(1.0, 1.0, 0.0)])?; // y = x²
//! assert_eq!(parabola.point(0.5), DVec3::new(0.5, 0.25, 0.0));
//! let exact = 5_f64.sqrt() / 2.0 + 2_f64.asinh() / 4.0;
//! assert!((parabola.arc_length(1e-12)? - exact).abs() < 1e-12 * exact);
//! # Ok::<(), casteljau_shape::ShapeError>(())
//! ```

pub use casteljau_bernstein as bernstein;
pub use casteljau_geom as geom;

mod arc_length;
mod area;
mod conic;
mod control_point;
mod conversion;
mod curve;
mod curve_operations;
mod error;
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

pub use control_point::ControlPoint;
pub use curve::{BezierCurve, Curve, RationalCurve};
pub use error::{LARGEST_COORDINATE, ShapeError};
pub use joins::{Continuity, CurvatureCondition, JoinReport, JoinTolerance, Maximum, SurfaceEdge};
pub use parametric::{Parameters, ParametricCurve, ParametricSurface, SurfaceDomain};
pub use patch::{BezierPatch, Patch, RationalPatch};
pub use patch_operations::PatchEdge;
pub use power::{PowerCurve, PowerPatch};
pub use triangle::{BezierTriangle, RationalTriangle, Triangle};
