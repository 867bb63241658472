//! What can be wrong with a solid, or with a question about it.

use casteljau_bernstein::BernsteinError;
use casteljau_shape::ShapeError;
use thiserror::Error;

/// Why a solid could not be made, or a question about it not be answered.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum SolidError {
    /// What is wrong with control points, weights or parameters of every kind of shape.
    #[error(transparent)]
    Shape(#[from] ShapeError),

    /// A kernel refused.
    #[error(transparent)]
    Kernel(#[from] BernsteinError),

    /// A net whose number of control points does not fit its degrees.
    ///
    /// ```
    /// use casteljau_solid::{SolidError, SolidNet, jacobian_verdict, geom::glam::DVec3};
    /// let net = SolidNet::Tetrahedron { points: &[DVec3::ZERO; 3], degree: 1 };
    /// assert_eq!(jacobian_verdict(&net, 1000), Err(SolidError::NetLength { needed: 4, given: 3 }));
    /// ```
    #[error("a net of these degrees has {needed} control points, not {given}")]
    NetLength {
        /// The number that fits.
        needed: usize,
        /// The number given.
        given: usize,
    },

    /// A rational solid with a point at infinity: its weight function is zero there.
    ///
    /// ```
    /// use casteljau_solid::{SolidError, SolidNet, jacobian_verdict, geom::glam::DVec4};
    /// let points = [DVec4::X + DVec4::W, DVec4::Y + DVec4::W, DVec4::Z, DVec4::W];
    /// let net = SolidNet::Tetrahedron { points: &points, degree: 1 };
    /// assert_eq!(jacobian_verdict(&net, 1000), Err(SolidError::WeightZero { at: [0.0, 0.0, 1.0] }));
    /// ```
    #[error("the weight is zero at the parameters {at:?}")]
    WeightZero {
        /// Parameters, to some roundings.
        at: [f64; 3],
    },

    /// A rational solid whose weight function comes so near to zero that its sign was not found for the operations given.
    ///
    /// ```
    /// use casteljau_solid::{SolidError, SolidNet, jacobian_verdict, geom::glam::DVec4};
    /// // The weight is 9(u − ⅓)².
    /// let points: Vec<DVec4> = (0..12).map(|p| DVec4::W * [1.0, -2.0, 4.0][p / 4]).collect();
    /// let net = SolidNet::Hexahedron { points: &points, degrees: [2, 1, 1] };
    /// let refused = jacobian_verdict(&net, 1_000_000);
    /// assert!(matches!(refused, Err(SolidError::WeightUndecided { at: [u, ..] }) if (u - 1.0 / 3.0).abs() < 1e-3));
    /// ```
    #[error("the sign of the weight near the parameters {at:?} is not decided")]
    WeightUndecided {
        /// Parameters.
        at: [f64; 3],
    },

    /// Volume and moments of a rational solid were not reached to the accuracy asked for.
    ///
    /// ```
    /// use casteljau_solid::{SolidError, SolidNet, mass_properties, geom::glam::DVec4};
    /// let points = [DVec4::X + DVec4::W, DVec4::Y + DVec4::W, DVec4::Z + DVec4::W, 2.0 * DVec4::W];
    /// let net = SolidNet::Tetrahedron { points: &points, degree: 1 };
    /// assert!(mass_properties(&net, 1e-12).is_ok());
    /// let refused = mass_properties(&net, 1e-18); // below rounding
    /// assert!(matches!(refused, Err(SolidError::Moments { reached, .. }) if reached < 1e-13));
    /// ```
    #[error(
        "volume {volume:e} is known to {reached:.1e} of itself, not to {relative:.1e}, after {cells} cells"
    )]
    Moments {
        /// The volume found.
        volume: f64,
        /// The largest of the relative errors of the volume and the moments, estimated.
        reached: f64,
        /// The relative error asked for.
        relative: f64,
        /// The number of cells that were looked at.
        cells: usize,
    },

    /// A solid of so high degrees that its Jacobian determinant is not expanded: it would take minutes.
    ///
    /// ```
    /// use casteljau_solid::{SolidError, SolidNet, jacobian_verdict, geom::glam::DVec3};
    /// let points = vec![DVec3::ZERO; 40 * 40 * 40];
    /// let net = SolidNet::Hexahedron { points: &points, degrees: [39; 3] };
    /// let refused = jacobian_verdict(&net, 1000);
    /// assert_eq!(refused, Err(SolidError::Coefficients { needed: 118 * 118 * 118, limit: 1_000_000 }));
    /// ```
    #[error("the Jacobian determinant has up to {needed} coefficients, more than {limit}")]
    Coefficients {
        /// The number of coefficients, at most.
        needed: usize,
        /// The largest number served.
        limit: usize,
    },
}
