//! The words every Casteljau crate shares: jets and their quotient rule, normals, curvatures, boxes, intervals,
//! tolerances and, behind the feature `laws`, the laws that shapes are tested with.
//!
//! A *jet* is a point together with its derivatives. Every shape answers with jets, and everything a designer
//! asks for (tangent plane, normal, fundamental forms, curvature) is computed from the jet, here and only here.
//!
//! ```
//! use casteljau_geom::{SurfaceJet, glam::DVec3};
//! // z = (x² + y²)/2 at its lowest point: both principal curvatures are 1.
//! let jet = SurfaceJet {
//!     point: DVec3::ZERO,
//!     du: DVec3::X,
//!     dv: DVec3::Y,
//!     duu: DVec3::Z,
//!     duv: DVec3::ZERO,
//!     dvv: DVec3::Z,
//! };
//! let curvatures = jet.curvatures().unwrap();
//! assert_eq!(jet.normal(), Some(DVec3::Z));
//! assert_eq!((curvatures.gaussian, curvatures.mean), (1.0, 1.0));
//! ```

pub use glam;

mod angle;
mod bounds;
mod curvature;
mod curve_jet;
mod error;
mod interval;
#[cfg(feature = "laws")]
pub mod laws;
mod multi_index;
mod partials;
mod quotient;
mod solid_jet;
mod surface_jet;
mod tolerance;

pub use angle::angle_degrees;
pub use bounds::BoundingBox;
pub use curvature::{Curvatures, FirstForm, SecondForm};
pub use curve_jet::{CurveJet, FrenetFrame};
pub use error::GeomError;
pub use interval::Interval;
pub use multi_index::{multi_indices, partial_count, partial_index};
pub use partials::{LARGEST_ORDER, Partials};
pub use quotient::{
    ScalarJet, extended_quotient_partials, quotient_curve_jet, quotient_jet, quotient_partials,
};
pub use solid_jet::SolidJet;
pub use surface_jet::{SurfaceJet, TangentPlane};
pub use tolerance::{COLLAPSE, UNIT_ROUNDOFF, power_of_two_below, rounding_bound};
