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
//!
//! | task | where |
//! | --- | --- |
//! | point, jets of any order, Jacobian | [`ParametricSolid`], which all kinds answer |
//! | faces, edges, sections, parts, elevation, reduction, boxes | methods of each kind |
//! | a patch translated along a curve, a curve rotated, twisted sweeps | [`RationalHexahedron::transitional`], [`rotational`](RationalHexahedron::rotational), [`twisted`](RationalHexahedron::twisted), [`rigidly_twisted`](RationalHexahedron::rigidly_twisted); [`ConstructedSolid`] remembers what it was made of |
//! | is it valid: a proof that the Jacobian is positive, or a witness | [`BezierHexahedron::jacobian_verdict`], [`JacobianVerdict`] |
//! | volume, centroid, second moments | [`BezierHexahedron::mass_properties`], [`MassProperties`] |
//! | the parameter of a point, or a proof that it lies outside | [`SolidLocator`] |
//! | free-form deformation of points, curves, patches and solids | [`Deformation`] |
//!
//! ```
//! use casteljau_solid::{RationalHexahedron, SolidLocator};
//! use casteljau_solid::{shape::RationalCurve, geom::glam::DVec3};
//! // A ball in one hexahedron: the meridian is a half circle.
//! let net = [-DVec3::Z, DVec3::new(2.0, 0.0, -1.0), DVec3::new(2.0, 0.0, 1.0), DVec3::Z];
//! let meridian = RationalCurve::new(&net, &[1.0, 1.0 / 3.0, 1.0 / 3.0, 1.0])?;
//! let ball = RationalHexahedron::rotational(&meridian)?;
//! assert!(ball.jacobian_verdict()?.is_valid());
//! let volume = ball.mass_properties(1e-12)?.volume;
//! assert!((volume - 4.0 / 3.0 * std::f64::consts::PI).abs() < 1e-11);
//! let p = DVec3::new(0.3, -0.4, 0.5);
//! let found = SolidLocator::of_hexahedron(&ball)?.locate(p)?.unwrap();
//! assert!(ball.point(found.parameters)?.distance(p) < 1e-12);
//! # Ok::<(), casteljau_solid::SolidError>(())
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
pub use deformation::{Deformation, LARGEST_COMPOSED_DEGREE, MOST_COMPOSED_POINTS};
pub use domain_tetrahedron::DomainTetrahedron;
pub use error::SolidError;
pub use hexahedron::{BezierHexahedron, Hexahedron, RationalHexahedron};
pub use hexahedron_operations::{Axis, HexahedronFace};
pub use inversion::{Preimage, SolidLocator};
pub use moments::{MassProperties, mass_properties};
pub use parametric::{ParametricSolid, SolidDomain};
pub use tetrahedron::{BezierTetrahedron, RationalTetrahedron, Tetrahedron};
pub use wedge::{BezierWedge, RationalWedge, Wedge};
