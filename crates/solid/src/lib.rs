//! Bézier solids, polynomial and rational: control points that are checked once, and everything that is asked of them.
//!
//! | | polynomial | rational |
//! | --- | --- | --- |
//! | tensor-product solid | [`Hexahedron`] | [`RationalHexahedron`] |
//! | tetrahedron | [`Tetrahedron`] | [`RationalTetrahedron`] |
//! | wedge, triangle × interval | [`Wedge`] | [`RationalWedge`] |
//!
//! A polynomial solid and its rational twin are one generic type ([`BezierHexahedron`], [`BezierTetrahedron`],
//! [`BezierWedge`]): rational control points are homogeneous, and one quotient rule ends every evaluation.
//! [`ParametricSolid`] is what all kinds answer: point, jets of any order, Jacobian.
//!
//! ```
//! use casteljau_solid::{Hexahedron, geom::glam::DVec3};
//! let cube = Hexahedron::unit_cube();
//! assert_eq!(cube.jet([0.5, 0.25, 0.75]).jacobian(), 1.0);
//! ```

pub use casteljau_bernstein as bernstein;
pub use casteljau_geom as geom;
pub use casteljau_shape as shape;

mod certificate;
mod constructions;
mod deformation;
mod domain_tetrahedron;
mod error;
mod hexahedron;
mod hexahedron_operations;
mod inversion;
mod moments;
mod parametric;
mod tetrahedron;
mod tetrahedron_operations;
mod tight_box;
mod validity;
mod wedge;
mod wedge_operations;

pub use certificate::{
    DEFAULT_OPERATIONS, Feature, JacobianCoefficients, JacobianVerdict, SolidDegrees, SolidNet,
    jacobian_verdict,
};
pub use constructions::{ConstructedSolid, Construction, Twist, rational_rotation};
pub use deformation::{Deformation, LARGEST_COMPOSED_DEGREE};
pub use domain_tetrahedron::DomainTetrahedron;
pub use error::SolidError;
pub use hexahedron::{BezierHexahedron, Hexahedron, RationalHexahedron};
pub use hexahedron_operations::{Axis, HexahedronFace};
pub use inversion::{Preimage, SolidLocator};
pub use moments::{MassProperties, mass_properties};
pub use parametric::{ParametricSolid, SolidDomain};
pub use tetrahedron::{BezierTetrahedron, RationalTetrahedron, Tetrahedron};
pub use wedge::{BezierWedge, RationalWedge, Wedge};
