//! When two curves join with continuous curvature, read off their control points.

use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};
use casteljau_geom::{COLLAPSE, angle_degrees};

use crate::{BezierCurve, ControlPoint};

/// The conditions on control points for continuous curvature where one curve ends and another starts.
///
/// For cubics P and Q with P₃ = Q₀ it is necessary that P₂, P₃, Q₁ are collinear and P₁, P₂, P₃, Q₁, Q₂ coplanar.
/// That is not sufficient: it leaves the curvatures free. With h and d the distances of P₁ and Q₂ from the common
/// tangent, on one side of it, they agree if and only if `d/|Q₁−Q₀|² = h/|P₃−P₂|²`.
///
/// Of rational curves with the weights wᵢ and vᵢ the curvatures at the joint are, with the degrees n and m,
/// `(n−1)/n · wₙwₙ₋₂/wₙ₋₁² · h/|Pₙ−Pₙ₋₁|²` and `(m−1)/m · v₀v₂/v₁² · d/|Q₁−Q₀|²`; that these agree is the ratio that
/// is measured, for any degrees. The points that have to be collinear and coplanar are the same, the Euclidean ones.
/// A product of weights that is negative turns the offset to the other side; a point at infinity, of weight 0, has
/// w·P in its place.
///
/// ```
/// use casteljau_shape::{CurvatureCondition, Curve, geom::glam::DVec3};
/// let p = |x: f64, y: f64| DVec3::new(x, y, 0.0);
/// let first = Curve::new([p(-2., 3.), p(-2., 1.), p(-1., 0.), p(0., 0.)])?;
/// let coplanar = Curve::new([p(0., 0.), p(2., 0.), p(3., 1.), p(5., 5.)])?; // the distance should be 4
/// let condition = CurvatureCondition::measure(&first, &coplanar).unwrap();
/// assert!(condition.is_necessary(1e-9) && !condition.is_sufficient(1e-9));
/// let right = first.continued_with_curvature(2.0, 0.5, &[p(5., 5.)])?;
/// assert!(CurvatureCondition::measure(&first, &right).unwrap().is_sufficient(1e-9));
/// # Ok::<(), casteljau_shape::ShapeError>(())
/// ```
///
/// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 11.2, and the chapter on rational curves for the weights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvatureCondition {
    /// Distance of the end of the first curve from the start of the second, relative to the longer leg there.
    pub gap: f64,
    /// Sine of the angle between the legs Pₙ − Pₙ₋₁ and Q₁ − Q₀, 1 where it is above 90°: three collinear points.
    pub collinear: f64,
    /// Sine of the angle between the offsets of Pₙ₋₂ and Q₂ from the tangent, 1 where they lie on opposite sides; 0
    /// where one of them vanishes: five coplanar points.
    pub coplanar: f64,
    /// Difference of the two curvatures, relative to the larger: the ratio. 0 where both vanish.
    pub ratio: f64,
}

impl CurvatureCondition {
    /// Measures how the end of `first` and the start of `second` meet, polynomial or rational.
    ///
    /// `None` where a curve has a degree below 2, where one of the legs at the joint vanishes, and where one of its
    /// ends is at infinity.
    ///
    /// ```
    /// use casteljau_shape::{CurvatureCondition, Curve, RationalCurve, geom::glam::DVec3};
    /// // A quarter of the unit circle goes on as a parabola of curvature 1.
    /// let circle = RationalCurve::new(&[DVec3::Y, DVec3::new(1., 1., 0.), DVec3::X], &[1., 0.5_f64.sqrt(), 1.])?;
    /// let p = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    /// let parabola = Curve::new([p(1., 0.), p(1., -1.), p(-1., -2.)])?;
    /// assert!(CurvatureCondition::measure(&circle, &parabola).unwrap().is_sufficient(1e-15));
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    #[must_use]
    pub fn measure<P: ControlPoint, Q: ControlPoint>(
        first: &BezierCurve<P>,
        second: &BezierCurve<Q>,
    ) -> Option<Self> {
        let (&[.., inner, before, end], &[start, after, outer, ..]) =
            (first.control_points(), second.control_points())
        else {
            return None;
        };
        let incoming = End::new([end, before, inner].map(P::homogeneous), first.degree())?;
        let outgoing = End::new([start, after, outer].map(Q::homogeneous), second.degree())?;
        let (k, l) = (incoming.bend.length(), outgoing.bend.length());
        let largest = k.max(l);
        Some(Self {
            gap: incoming.point.distance(outgoing.point) / incoming.leg.max(outgoing.leg),
            collinear: sine(-incoming.direction, outgoing.direction),
            coplanar: sine(incoming.bend, outgoing.bend),
            ratio: if largest > 0.0 { (k - l).abs() / largest } else { 0.0 },
        })
    }

    /// Whether the necessary conditions hold within a relative tolerance: three points collinear, five coplanar.
    #[must_use]
    pub fn is_necessary(&self, relative: f64) -> bool {
        self.gap.max(self.collinear).max(self.coplanar) <= relative
    }

    /// Whether the curvature is continuous within a relative tolerance: the ratio is right, too.
    #[must_use]
    pub fn is_sufficient(&self, relative: f64) -> bool {
        self.is_necessary(relative) && self.ratio <= relative
    }
}

/// The end of a curve, seen from the joint.
struct End {
    point: DVec3,
    /// Length of the leg from the point to the next control point.
    leg: f64,
    /// Direction in which the curve leaves the joint.
    direction: DVec3,
    /// The curvature vector.
    bend: DVec3,
}

impl End {
    /// From the homogeneous control points at the joint, beside it and behind that.
    fn new([end, beside, behind]: [DVec4; 3], degree: usize) -> Option<Self> {
        let (point, next) = (end.euclidean()?, beside.euclidean()?);
        let leg = next - point;
        let (direction, length) = (leg.try_normalize()?, leg.length());
        // Times its weight, so that a point at infinity is no exception.
        let offset = offset(behind.xyz() - next * behind.w, direction);
        let degrees = (degree - 1) as f64 / degree as f64;
        let bend = offset / length / length * (degrees * (end.w / beside.w) / beside.w);
        // C′ is n·w₁/w₀ times the leg.
        Some(Self { point, leg: length, direction: direction * (beside.w / end.w).signum(), bend })
    }
}

/// The part of v across the tangent; zero where it is rounding.
fn offset(v: DVec3, tangent: DVec3) -> DVec3 {
    let across = v - tangent * tangent.dot(v);
    if across.length() <= COLLAPSE * v.length() { DVec3::ZERO } else { across }
}

fn sine(a: DVec3, b: DVec3) -> f64 {
    let angle = angle_degrees(a, b);
    if angle > 90.0 { 1.0 } else { angle.to_radians().sin() }
}
