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
mod closest;
mod curve;
mod error;
mod patch;

pub use closest::{CurveProjector, LocalMinima, LocalMinimum, LocalProjection, PatchProjector, Projection};
pub use curve::Curve;
pub use error::{LARGEST_COORDINATE, ShapeError};
pub use patch::Patch;
