//! What can be wrong with a solid, or with a question about it.

use casteljau_bernstein::BernsteinError;
use casteljau_geom::glam::DVec3;
use casteljau_shape::ShapeError;
use thiserror::Error;

use crate::Axis;

/// Why a solid could not be made, or a question about it not be answered.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum SolidError {
    /// What can be wrong with control points, weights or parameters of every kind of shape.
    ///
    /// ```
    /// use casteljau_solid::{SolidError, Tetrahedron, geom::glam::DVec3, shape::ShapeError};
    /// let refused = Tetrahedron::new(0, [DVec3::new(0.0, 0.0, f64::NAN)]).unwrap_err();
    /// assert!(matches!(refused, SolidError::Shape(ShapeError::Coordinate { place: 0, axis: 2, .. })));
    /// ```
    #[error(transparent)]
    Shape(#[from] ShapeError),

    /// A hexahedron whose number of control points does not fit its degrees.
    ///
    /// ```
    /// use casteljau_solid::{Hexahedron, SolidError, geom::glam::DVec3};
    /// let refused = Hexahedron::new([1, 1, 2], [DVec3::ZERO; 8]);
    /// assert_eq!(refused, Err(SolidError::HexahedronSize { degrees: [1, 1, 2], needed: 12, given: 8 }));
    /// ```
    #[error(
        "a hexahedron of degrees {} × {} × {} has {needed} control points, not {given}",
        .degrees[0], .degrees[1], .degrees[2]
    )]
    HexahedronSize {
        /// The degrees with u, v and w.
        degrees: [usize; 3],
        /// (l+1)(m+1)(n+1).
        needed: usize,
        /// The number given.
        given: usize,
    },

    /// A tetrahedron whose number of control points does not fit its degree.
    ///
    /// ```
    /// use casteljau_solid::{SolidError, Tetrahedron, geom::glam::DVec3};
    /// let refused = Tetrahedron::new(2, [DVec3::ZERO; 4]);
    /// assert_eq!(refused, Err(SolidError::TetrahedronSize { degree: 2, needed: 10, given: 4 }));
    /// ```
    #[error("a tetrahedron of degree {degree} has {needed} control points, not {given}")]
    TetrahedronSize {
        /// The degree.
        degree: usize,
        /// (n+1)(n+2)(n+3)/6.
        needed: usize,
        /// The number given.
        given: usize,
    },

    /// A wedge whose number of control points does not fit its degrees.
    ///
    /// ```
    /// use casteljau_solid::{SolidError, Wedge, geom::glam::DVec3};
    /// let refused = Wedge::new([1, 1], [DVec3::ZERO; 8]);
    /// assert_eq!(refused, Err(SolidError::WedgeSize { degrees: [1, 1], needed: 6, given: 8 }));
    /// ```
    #[error(
        "a wedge of degrees {} (triangle) and {} (height) has {needed} control points, not {given}",
        .degrees[0], .degrees[1]
    )]
    WedgeSize {
        /// The degrees of the triangle and of the height.
        degrees: [usize; 2],
        /// (n+1)(n+2)/2·(o+1).
        needed: usize,
        /// The number given.
        given: usize,
    },

    /// Three axes that are not U, V and W in some order.
    ///
    /// ```
    /// use casteljau_solid::{Axis, Hexahedron, SolidError};
    /// let axes = [Axis::U, Axis::W, Axis::W];
    /// assert_eq!(Hexahedron::unit_cube().permuted(axes), Err(SolidError::Axes { axes }));
    /// ```
    #[error("{:?}, {:?}, {:?} are not U, V and W in some order", .axes[0], .axes[1], .axes[2])]
    Axes {
        /// The axes given.
        axes: [Axis; 3],
    },

    /// A composed shape that would have more control points than
    /// [`MOST_COMPOSED_POINTS`](crate::MOST_COMPOSED_POINTS).
    ///
    /// ```
    /// use casteljau_solid::{Deformation, Hexahedron, SolidError};
    /// let large = Hexahedron::unit_cube().elevated([39; 3])?;
    /// let refused = Hexahedron::unit_cube().deform_hexahedron(&large);
    /// assert_eq!(refused, Err(SolidError::ComposedPoints { needed: 121_usize.pow(3), limit: 1_000_000 }));
    /// # Ok::<(), SolidError>(())
    /// ```
    #[error("the composed shape would have {needed} control points, more than the limit of {limit}")]
    ComposedPoints {
        /// The number of its control points.
        needed: usize,
        /// The largest number served.
        limit: usize,
    },

    /// A quantity that a construction cannot be carried out with.
    ///
    /// ```
    /// use casteljau_solid::{RationalHexahedron, SolidError, shape::RationalCurve, geom::glam::DVec3};
    /// let meridian = RationalCurve::new(&[DVec3::X, DVec3::new(1.0, 0.0, 2.0)], &[1.0, 1.0])?;
    /// let refused = RationalHexahedron::rotational_with_center(&meridian, -1.0);
    /// assert_eq!(refused, Err(SolidError::Construction { what: "weight of the center", value: -1.0 }));
    /// # Ok::<(), SolidError>(())
    /// ```
    #[error("nothing can be constructed with {what}: {value}")]
    Construction {
        /// What the quantity is.
        what: &'static str,
        /// Its value.
        value: f64,
    },

    /// It is not decided whether a point belongs to a solid: the work that is allowed was done.
    ///
    /// ```
    /// use casteljau_solid::{Hexahedron, SolidError, SolidLocator, geom::glam::DVec3};
    /// let mut locator = SolidLocator::of_hexahedron(&Hexahedron::unit_cube())?;
    /// // Nothing can be told apart at 1e-300.
    /// let refused = locator.locate_within(DVec3::new(0.3, 0.3, 1.0 + 1e-16), 1e-300);
    /// assert!(matches!(refused, Ok(Some(_)) | Err(SolidError::Undecided { .. })));
    /// # Ok::<(), SolidError>(())
    /// ```
    #[error("whether {point} belongs to the solid within {tolerance:e} is not decided after {cells} cells")]
    Undecided {
        /// The point.
        point: DVec3,
        /// The tolerance, in model units.
        tolerance: f64,
        /// The number of cells that were looked at.
        cells: usize,
    },

    /// A kernel refused.
    ///
    /// ```
    /// use casteljau_solid::{Hexahedron, SolidError};
    /// assert!(matches!(Hexahedron::unit_cube().elevated([500, 0, 0]), Err(SolidError::Kernel(_))));
    /// ```
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

    /// A solid of so high degrees that binomial coefficients of its determinant, or of the products that
    /// moments are integrals of, leave the range of numbers: from about 200 on.
    ///
    /// ```
    /// use casteljau_solid::{Hexahedron, SolidError};
    /// let cube = Hexahedron::unit_cube().elevated([499, 0, 0])?;
    /// assert_eq!(cube.mass_properties(1e-12), Err(SolidError::Multiplicities { degrees: [500, 1, 1] }));
    /// # Ok::<(), SolidError>(())
    /// ```
    #[error("binomial coefficients for the degrees {degrees:?} leave the range of numbers")]
    Multiplicities {
        /// The degrees along the three parameters.
        degrees: [usize; 3],
    },
}
