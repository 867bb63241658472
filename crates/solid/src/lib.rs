//! Bézier solids, polynomial and rational: tetrahedra, hexahedra and wedges.

pub use casteljau_bernstein as bernstein;
pub use casteljau_geom as geom;
pub use casteljau_shape as shape;

mod certificate;
mod error;
mod moments;

pub use certificate::{
    DEFAULT_OPERATIONS, Feature, JacobianCoefficients, JacobianVerdict, SolidDegrees, SolidNet,
    jacobian_verdict,
};
pub use error::SolidError;
pub use moments::{MassProperties, mass_properties};
