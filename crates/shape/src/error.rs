//! What can be wrong with a shape, and the check every shape makes of its control points.

use casteljau_bernstein::{BernsteinError, MAX_DEGREE};
use casteljau_geom::glam::DVec3;
use casteljau_geom::{GeomError, LARGEST_ORDER};
use thiserror::Error;

use crate::{ControlPoint, Parameters};

/// Coordinates beyond this are refused, so that squares of lengths and products with binomial coefficients
/// stay finite.
pub const LARGEST_COORDINATE: f64 = 1e140;

/// Why a shape could not be made, or a question about it not be answered.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ShapeError {
    /// A shape without control points.
    ///
    /// ```
    /// use casteljau_shape::{Curve, ShapeError};
    /// assert_eq!(Curve::new(vec![]), Err(ShapeError::NoControlPoints));
    /// ```
    #[error("no control points")]
    NoControlPoints,

    /// A coordinate that is not finite, or larger than [`LARGEST_COORDINATE`].
    ///
    /// ```
    /// use casteljau_shape::{Curve, ShapeError, geom::glam::DVec3};
    /// let refused = Curve::new(vec![DVec3::ZERO, DVec3::new(0.0, f64::INFINITY, 0.0)]);
    /// assert_eq!(refused, Err(ShapeError::Coordinate { place: 1, axis: 1, value: f64::INFINITY }));
    /// let refused = Curve::new(vec![DVec3::new(1e200, 0.0, 0.0)]).unwrap_err();
    /// assert_eq!(refused.to_string(), "control point 0, coordinate 0: 1e200 is not a number below 1e140");
    /// ```
    #[error(
        "control point {place}, coordinate {axis}: {value:e} is not a number below {LARGEST_COORDINATE:e}"
    )]
    Coordinate {
        /// Place of the control point in memory, from 0.
        place: usize,
        /// 0, 1, 2 for x, y, z (times the weight, where control points are homogeneous), 3 for the weight.
        axis: usize,
        /// The coordinate.
        value: f64,
    },

    /// A degree above [`MAX_DEGREE`].
    ///
    /// ```
    /// use casteljau_shape::{Curve, ShapeError, geom::glam::DVec3};
    /// let refused = Curve::new(vec![DVec3::ZERO; 502]);
    /// assert_eq!(refused, Err(ShapeError::Degree { degree: 501, limit: 500 }));
    /// ```
    #[error("degree {degree} is above the limit of {limit}")]
    Degree {
        /// The degree asked for.
        degree: usize,
        /// The largest one served.
        limit: usize,
    },

    /// An order of derivatives above [`LARGEST_ORDER`].
    ///
    /// ```
    /// use casteljau_shape::{Curve, ParametricCurve, ShapeError, geom::glam::DVec3};
    /// let line = Curve::new(vec![DVec3::ZERO, DVec3::X])?;
    /// let refused = line.try_jet_of_order(0.5, 1000);
    /// assert_eq!(refused, Err(ShapeError::Order { order: 1000, limit: 128 }));
    /// # Ok::<(), ShapeError>(())
    /// ```
    #[error("derivatives of order {order} are above the limit of {limit}")]
    Order {
        /// The order asked for.
        order: usize,
        /// The highest one served.
        limit: usize,
    },

    /// A patch whose number of control points does not fit its degrees.
    ///
    /// ```
    /// use casteljau_shape::{Patch, ShapeError, geom::glam::DVec3};
    /// let refused = Patch::new([1, 1], vec![DVec3::ZERO; 3]);
    /// assert_eq!(refused, Err(ShapeError::NetSize { degrees: [1, 1], needed: 4, given: 3 }));
    /// ```
    #[error("a patch of degrees {} × {} has {needed} control points, not {given}", .degrees[0], .degrees[1])]
    NetSize {
        /// The degrees with u and v.
        degrees: [usize; 2],
        /// (m+1)(n+1).
        needed: usize,
        /// The number given.
        given: usize,
    },

    /// A triangle whose number of control points does not fit its degree.
    ///
    /// ```
    /// use casteljau_shape::{ShapeError, Triangle, geom::glam::DVec3};
    /// let refused = Triangle::new(2, vec![DVec3::ZERO; 5]);
    /// assert_eq!(refused, Err(ShapeError::TriangleSize { degree: 2, needed: 6, given: 5 }));
    /// ```
    #[error("a triangle of degree {degree} has {needed} control points, not {given}")]
    TriangleSize {
        /// The degree.
        degree: usize,
        /// (n+1)(n+2)/2.
        needed: usize,
        /// The number given.
        given: usize,
    },

    /// A parameter that is not finite.
    ///
    /// ```
    /// use casteljau_shape::{Curve, ShapeError, geom::glam::DVec3};
    /// let point = Curve::new(vec![DVec3::ZERO])?;
    /// assert!(matches!(point.split(f64::NAN), Err(ShapeError::Parameter { .. })));
    /// # Ok::<(), ShapeError>(())
    /// ```
    #[error("the parameter {value} is not finite")]
    Parameter {
        /// The parameter.
        value: f64,
    },

    /// A relative accuracy that is not between 0 and 1.
    ///
    /// ```
    /// use casteljau_shape::{Curve, ShapeError, geom::glam::DVec3};
    /// let line = Curve::new(vec![DVec3::ZERO, DVec3::X])?;
    /// assert_eq!(line.arc_length(0.0), Err(ShapeError::Accuracy { relative: 0.0 }));
    /// # Ok::<(), ShapeError>(())
    /// ```
    #[error("the relative accuracy {relative} does not lie between 0 and 1")]
    Accuracy {
        /// The accuracy asked for.
        relative: f64,
    },

    /// A curve all of whose control points coincide: its length is 0, which no relative accuracy can describe.
    ///
    /// ```
    /// use casteljau_shape::{Curve, ShapeError, geom::glam::DVec3};
    /// let point = Curve::new(vec![DVec3::ONE; 4])?;
    /// assert_eq!(point.arc_length(1e-10), Err(ShapeError::ZeroLength { control_points: 4 }));
    /// # Ok::<(), ShapeError>(())
    /// ```
    #[error("the curve has length zero: its {control_points} control points coincide")]
    ZeroLength {
        /// How many there are.
        control_points: usize,
    },

    /// The arc length was not reached to the accuracy asked for.
    ///
    /// ```
    /// use casteljau_shape::{Curve, ShapeError, geom::glam::DVec3};
    /// let parabola = Curve::new(vec![DVec3::ZERO, DVec3::X, DVec3::ONE])?;
    /// let refused = parabola.arc_length(1e-17); // finer than rounding
    /// assert!(matches!(refused, Err(ShapeError::ArcLength { reached, .. }) if reached < 1e-13));
    /// # Ok::<(), ShapeError>(())
    /// ```
    #[error(
        "arc length {length:e} is certain to {reached:.1e} of itself only, {relative:.1e} was asked for ({pieces} pieces)"
    )]
    ArcLength {
        /// The length found.
        length: f64,
        /// The relative accuracy that is certain.
        reached: f64,
        /// The relative accuracy asked for.
        relative: f64,
        /// The number of pieces that were looked at.
        pieces: usize,
    },

    /// A weight that is not positive, where all must be (or all negative).
    ///
    /// ```
    /// use casteljau_shape::{CurveProjector, RationalCurve, ShapeError, geom::glam::DVec3};
    /// let curve = RationalCurve::new(&[DVec3::ZERO, DVec3::X], &[1.0, -1.0])?; // with a pole
    /// assert_eq!(CurveProjector::new(&curve).err(), Some(ShapeError::Weight { place: 1, value: -1.0 }));
    /// # Ok::<(), ShapeError>(())
    /// ```
    #[error("control point {place} has the weight {value}, which is not positive")]
    Weight {
        /// Place of the control point in memory, from 0.
        place: usize,
        /// Its weight.
        value: f64,
    },

    /// A direction or normal that is zero, not finite or out of range.
    ///
    /// ```
    /// use casteljau_shape::{ShapeError, StraightLine, geom::glam::DVec3};
    /// let refused = StraightLine::ray(DVec3::X, DVec3::ZERO);
    /// assert_eq!(refused, Err(ShapeError::Direction { direction: DVec3::ZERO }));
    /// ```
    #[error("{direction} is no direction")]
    Direction {
        /// The vector given.
        direction: DVec3,
    },

    /// A point in space about which a question was asked is not finite or too far away.
    ///
    /// ```
    /// use casteljau_shape::{Curve, CurveProjector, ShapeError, geom::glam::DVec3};
    /// let line = CurveProjector::new(&Curve::new(vec![DVec3::ZERO, DVec3::X])?)?;
    /// let refused = line.closest_point(DVec3::new(0.0, f64::INFINITY, 0.0));
    /// assert_eq!(refused, Err(ShapeError::Query { axis: 1, value: f64::INFINITY }));
    /// # Ok::<(), ShapeError>(())
    /// ```
    #[error(
        "the query's coordinate {axis}, {value}, is no number below {LARGEST_COORDINATE:e}, by itself or measured by the shape's size"
    )]
    Query {
        /// 0, 1, 2 for x, y, z.
        axis: usize,
        /// The coordinate.
        value: f64,
    },

    /// Another number of weights than of control points.
    ///
    /// ```
    /// use casteljau_shape::{RationalCurve, ShapeError, geom::glam::DVec3};
    /// let refused = RationalCurve::new(&[DVec3::ZERO, DVec3::X], &[1.0]);
    /// assert_eq!(refused, Err(ShapeError::WeightCount { needed: 2, given: 1 }));
    /// ```
    #[error("{needed} control points, but {given} weights")]
    WeightCount {
        /// The number of control points.
        needed: usize,
        /// The number of weights.
        given: usize,
    },

    /// A rational shape all of whose weights are zero: it has no point anywhere.
    ///
    /// ```
    /// use casteljau_shape::{RationalCurve, ShapeError, geom::glam::DVec3};
    /// let refused = RationalCurve::new(&[DVec3::ZERO, DVec3::X], &[0.0, -0.0]);
    /// assert_eq!(refused, Err(ShapeError::NoWeight { control_points: 2 }));
    /// ```
    #[error("all {control_points} weights are zero")]
    NoWeight {
        /// How many control points there are.
        control_points: usize,
    },

    /// A quantity that a construction cannot be carried out with.
    ///
    /// ```
    /// use casteljau_shape::{RationalPatch, ShapeError, geom::glam::DVec3};
    /// let refused = RationalPatch::sphere(DVec3::ZERO, -1.0);
    /// assert_eq!(refused, Err(ShapeError::Construction { what: "radius of the sphere", value: -1.0 }));
    /// ```
    #[error("nothing can be constructed with {what}: {value}")]
    Construction {
        /// What the quantity is.
        what: &'static str,
        /// Its value.
        value: f64,
    },

    /// A ratio that varies along an edge is not positive all along, or 0 within its rounding.
    ///
    /// ```
    /// use casteljau_shape::{Patch, PatchEdge, ShapeError, geom::glam::DVec3};
    /// let flat = Patch::new([1, 1], [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::new(1.0, 1.0, 0.0)])?;
    /// let alpha = |middle| flat.continued_varying(PatchEdge::UEnd, &[1.0, middle, 1.0], &[], &[]);
    /// assert_eq!(alpha(-2.0), Err(ShapeError::Ratio { at: 0.5, value: -0.5 }));
    /// assert!(alpha(-0.9).is_ok()); // at ½ it is 0.05
    /// # Ok::<(), ShapeError>(())
    /// ```
    #[error("the ratio along the edge is not positive: {value:e} at {at}")]
    Ratio {
        /// The parameter on the edge, from 0 to 1.
        at: f64,
        /// The ratio there.
        value: f64,
    },

    /// The weights of a rational shape do not all have one sign, so that its control points bound nothing.
    ///
    /// ```
    /// use casteljau_shape::{RationalCurve, ShapeError, geom::glam::DVec3};
    /// let curve = RationalCurve::new(&[DVec3::ZERO, DVec3::X, DVec3::Y], &[1.0, -0.5, 1.0])?;
    /// assert_eq!(curve.reduced(1), Err(ShapeError::Unbounded));
    /// # Ok::<(), ShapeError>(())
    /// ```
    #[error(
        "the weights do not all have one sign, or a control point lies at infinity: the hull bounds nothing"
    )]
    Unbounded,

    /// There is no point here: the denominator vanishes within its rounding, or a number leaves the range.
    ///
    /// ```
    /// use casteljau_shape::{Parameters, RationalCurve, ShapeError, geom::{GeomError, glam::DVec3}};
    /// let pole = RationalCurve::new(&[DVec3::ZERO, DVec3::X], &[1.0, -1.0])?; // w = 1 − 2t
    /// let refused = pole.point(0.5);
    /// assert!(matches!(
    ///     refused,
    ///     Err(ShapeError::Evaluation { at: Parameters::Curve(0.5), source: GeomError::Pole { .. } })
    /// ));
    /// # Ok::<(), ShapeError>(())
    /// ```
    #[error("no value at {at}: {source}")]
    Evaluation {
        /// The parameters.
        at: Parameters,
        /// Why.
        source: GeomError,
    },

    /// There is no normal here: derivatives up to order 2 do not span a tangent plane, not even in the limit.
    ///
    /// ```
    /// use casteljau_shape::{ParametricSurface, Patch, ShapeError, geom::glam::DVec3};
    /// let line = Patch::new([1, 1], [DVec3::ZERO, DVec3::X, DVec3::ZERO, DVec3::X])?;
    /// assert!(matches!(line.try_normal(0.5, 0.2), Err(ShapeError::NoTangentPlane { .. })));
    /// # Ok::<(), ShapeError>(())
    /// ```
    #[error("no tangent plane at {at}: the derivatives are parallel or vanish")]
    NoTangentPlane {
        /// The parameters.
        at: Parameters,
    },

    /// There is no moving frame here: C′ and C″ are parallel, or one of them vanishes.
    ///
    /// ```
    /// use casteljau_shape::{Curve, ParametricCurve, ShapeError, geom::glam::DVec3};
    /// let line = Curve::new([DVec3::ZERO, DVec3::X])?;
    /// assert!(matches!(line.try_frenet_frame(0.5), Err(ShapeError::NoFrame { .. })));
    /// # Ok::<(), ShapeError>(())
    /// ```
    #[error("no osculating plane at {at}: the derivatives are parallel or vanish")]
    NoFrame {
        /// The parameter.
        at: Parameters,
    },

    /// The area was not reached to the accuracy asked for.
    ///
    /// ```
    /// use casteljau_shape::{ParametricSurface, Patch, ShapeError, geom::glam::DVec3};
    /// let line = Patch::new([1, 1], [DVec3::ZERO, DVec3::X, DVec3::ZERO, DVec3::X])?;
    /// assert!(matches!(line.area(1e-6), Err(ShapeError::Area { .. }))); // it has none
    /// # Ok::<(), ShapeError>(())
    /// ```
    #[error(
        "area {area:e} is known to {reached:.1e} of itself only, {relative:.1e} was asked for ({cells} cells)"
    )]
    Area {
        /// The area found.
        area: f64,
        /// The relative accuracy reached.
        reached: f64,
        /// The relative accuracy asked for.
        relative: f64,
        /// The number of cells that were looked at.
        cells: usize,
    },

    /// A kernel refused.
    ///
    /// ```
    /// use casteljau_shape::{Curve, ShapeError, geom::glam::DVec3};
    /// let line = Curve::new(vec![DVec3::ZERO, DVec3::X])?;
    /// assert!(matches!(line.elevated(1000), Err(ShapeError::Kernel(_))));
    /// # Ok::<(), ShapeError>(())
    /// ```
    #[error(transparent)]
    Kernel(#[from] BernsteinError),
}

impl ShapeError {
    /// The answer at these parameters leaves the range of numbers.
    #[must_use]
    pub fn overflow(at: Parameters, denominator: f64) -> Self {
        Self::Evaluation { at, source: GeomError::Overflow { denominator } }
    }
}

/// Every coordinate finite and in range.
///
/// # Errors
/// [`ShapeError::Coordinate`].
pub fn check_points<P: ControlPoint>(points: &[P]) -> Result<(), ShapeError> {
    for (place, p) in points.iter().enumerate() {
        for (axis, &value) in p.components().iter().enumerate() {
            if value.is_nan() || value.abs() > LARGEST_COORDINATE {
                return Err(ShapeError::Coordinate { place, axis, value });
            }
        }
    }
    Ok(())
}

/// The degree within the kernels' range.
///
/// # Errors
/// [`ShapeError::Degree`].
pub fn check_degree(degree: usize) -> Result<(), ShapeError> {
    if degree > MAX_DEGREE { Err(ShapeError::Degree { degree, limit: MAX_DEGREE }) } else { Ok(()) }
}

/// The order of derivatives that a jet can hold.
///
/// # Errors
/// [`ShapeError::Order`].
pub fn check_order(order: usize) -> Result<(), ShapeError> {
    if order > LARGEST_ORDER { Err(ShapeError::Order { order, limit: LARGEST_ORDER }) } else { Ok(()) }
}
