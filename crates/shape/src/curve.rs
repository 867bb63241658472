//! Bézier curves, polynomial and rational: construction and evaluation.

use casteljau_bernstein::{MAX_DEGREE, basis_barycentric, derivatives, value};
use casteljau_geom::glam::{DVec3, DVec4};
use casteljau_geom::{BoundingBox, CurveJet, Interval, rounding_bound};

use crate::control_point::{checked, hull_box, largest_weight, lifted, points_box};
use crate::error::check_degree;
use crate::{ControlPoint, Parameters, ParametricCurve, ShapeError};

/// A Bézier curve over an interval `[a, b]`, `C(t) = Σ Bᵢⁿ(s) Pᵢ` with `s = (t−a)/(b−a)`.
///
/// [`Curve`] is the polynomial one, [`RationalCurve`] the rational one, whose control points are homogeneous.
/// There is at least one control point, all are finite, and the degree is at most
/// [`MAX_DEGREE`]. Control points may coincide.
#[derive(Debug, Clone, PartialEq)]
pub struct BezierCurve<P> {
    interval: Interval,
    control_points: Vec<P>,
}

/// A polynomial Bézier curve, `C(t) = Σ Bᵢⁿ(t) Pᵢ` over `[0, 1]` unless given another interval.
///
/// Evaluation at a parameter that is not finite gives NaN, at any other one a finite answer, unless the
/// polynomial itself leaves the range of f64.
pub type Curve = BezierCurve<DVec3>;

/// A rational Bézier curve, `C(t) = Σ Bᵢⁿ(t) wᵢ Pᵢ / Σ Bᵢⁿ(t) wᵢ`, held homogeneous: (w·x, w·y, w·z, w).
///
/// Weights may be zero or negative. Where the denominator vanishes within its rounding bound the answer is
/// [`ShapeError::Evaluation`].
///
/// ```
/// use casteljau_shape::{RationalCurve, geom::glam::DVec3};
/// let quarter = RationalCurve::new(&[DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y], &[1.0, 1.0, 2.0])?;
/// assert_eq!(quarter.point(0.5)?, DVec3::new(0.6, 0.8, 0.0)); // on the unit circle
/// # Ok::<(), casteljau_shape::ShapeError>(())
/// ```
pub type RationalCurve = BezierCurve<DVec4>;

impl<P: ControlPoint> BezierCurve<P> {
    /// Makes a curve of points that were checked.
    pub(crate) fn checked(interval: Interval, control_points: Vec<P>) -> Self {
        debug_assert!(!control_points.is_empty());
        Self { interval, control_points }
    }

    /// The curve over an interval with the given control points, polynomial or rational as they are.
    ///
    /// ```
    /// use casteljau_shape::{BezierCurve, geom::{Interval, glam::DVec4}};
    /// let half = BezierCurve::from_net(Interval::UNIT, [DVec4::W, DVec4::new(2.0, 0.0, 0.0, 2.0)])?;
    /// assert_eq!(half.point(0.5)?.x, 2.0 / 3.0);
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// [`ShapeError::NoControlPoints`], [`ShapeError::Degree`], [`ShapeError::Coordinate`],
    /// [`ShapeError::NoWeight`].
    pub fn from_net(interval: Interval, control_points: impl Into<Vec<P>>) -> Result<Self, ShapeError> {
        let control_points = control_points.into();
        check_count(control_points.len())?;
        Ok(Self::checked(interval, checked(control_points)?))
    }

    /// Degree n.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.control_points.len() - 1
    }

    /// Control points `P₀ … Pₙ`; homogeneous ones, (w·x, w·y, w·z, w), where the curve is rational.
    #[must_use]
    pub fn control_points(&self) -> &[P] {
        &self.control_points
    }

    /// The interval `[a, b]` of the parameter.
    #[must_use]
    pub fn interval(&self) -> Interval {
        self.interval
    }

    /// The same curve with its parameter running over another interval: the linear reparametrisation.
    ///
    /// ```
    /// use casteljau_shape::{Curve, geom::{Interval, glam::DVec3}};
    /// let line = Curve::new([DVec3::ZERO, DVec3::X])?.with_interval(Interval::new(2.0, 4.0)?);
    /// assert_eq!((line.point(3.0), line.jet(3.0).d1), (DVec3::X / 2.0, DVec3::X / 2.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_interval(self, interval: Interval) -> Self {
        Self { interval, ..self }
    }

    /// `s = (t−a)/(b−a)`.
    pub(crate) fn local(&self, t: f64) -> f64 {
        self.interval.local(t)
    }

    /// A bound on the error of the denominator `w`, which was computed at `s`.
    fn weight_error(&self, s: f64, w: f64) -> f64 {
        let degree = self.degree();
        // On [0, 1] the largest weight bounds them all, and is mostly enough to show that w is none.
        let rough = rounding_bound(degree, 0, largest_weight(&self.control_points));
        if (0.0..=1.0).contains(&s) && w.abs() > rough {
            return rough;
        }
        let mut basis = [0.0; MAX_DEGREE + 1];
        basis_barycentric((1.0 - s).abs(), s.abs(), &mut basis[..=degree]);
        let terms = self.control_points.iter().zip(basis).map(|(p, b)| b * p.homogeneous().w.abs());
        rounding_bound(degree, 0, terms.sum())
    }
}

/// From derivatives with respect to `s = (t−a)/(b−a)` to those with respect to t, `dᵏ/dtᵏ = (b−a)⁻ᵏ dᵏ/dsᵏ`.
fn per_unit_of(interval: Interval, out: &mut [DVec3]) {
    let length = interval.length();
    for (order, derivative) in out.iter_mut().enumerate().skip(1) {
        // One division after another: no power of the length leaves the range before the answer does.
        for _ in 0..order {
            *derivative /= length;
        }
    }
}

impl<P: ControlPoint> ParametricCurve for BezierCurve<P> {
    fn interval(&self) -> Interval {
        self.interval
    }

    fn extended_partials(&self, t: f64, out: &mut [DVec3]) -> Result<(), ShapeError> {
        let at = Parameters::Curve(t).finite()?;
        let s = self.local(t);
        let kernel = |net: &mut [P]| derivatives(&self.control_points, s, net);
        P::project::<1>(out, kernel, |w| self.weight_error(s, w))
            .map_err(|source| ShapeError::Evaluation { at, source })?;
        per_unit_of(self.interval, out);
        Ok(())
    }

    fn weight(&self, t: f64) -> f64 {
        value(&self.control_points, self.local(t)).homogeneous().w
    }
}

impl Curve {
    /// The curve with the given control points over `[0, 1]`; its degree is their number less one.
    ///
    /// # Errors
    /// [`ShapeError::NoControlPoints`], [`ShapeError::Degree`], [`ShapeError::Coordinate`].
    pub fn new(control_points: impl Into<Vec<DVec3>>) -> Result<Self, ShapeError> {
        Self::from_net(Interval::UNIT, control_points)
    }

    /// Point `C(t) = Σ Bᵢⁿ(s) Pᵢ`, by nested multiplication.
    ///
    /// `t` may lie outside the interval: the polynomial is continued, not clamped. The ends are met to the bit.
    /// Error: at most 4(n+2)·u·Σ|Bᵢⁿ(s)||Pᵢ|, u = 2⁻⁵³, besides the rounding of s, which is exact over [0, 1].
    /// Cost: O(n), no allocation.
    #[must_use]
    pub fn point(&self, t: f64) -> DVec3 {
        value(&self.control_points, self.local(t))
    }

    /// Point and derivatives up to order 3, `dᵏC/dtᵏ = (b−a)⁻ᵏ n!/(n−k)! Σ Bᵢⁿ⁻ᵏ(s) Δᵏ Pᵢ`.
    ///
    /// Error: at most 4(n+2k+2)·u times the sum of the absolute contributions. Cost: O(n), no allocation.
    #[must_use]
    pub fn jet(&self, t: f64) -> CurveJet {
        let mut jet = [DVec3::ZERO; 4];
        derivatives(&self.control_points, self.local(t), &mut jet);
        per_unit_of(self.interval, &mut jet);
        jet.into()
    }

    /// The first control point, `C(a)`.
    #[must_use]
    pub fn start(&self) -> DVec3 {
        value(&self.control_points, 0.0)
    }

    /// The last control point, `C(b)`.
    #[must_use]
    pub fn end(&self) -> DVec3 {
        value(&self.control_points, 1.0)
    }

    /// The box around the control points; by the convex hull property it contains the curve over its interval.
    #[must_use]
    pub fn bounding_box(&self) -> BoundingBox {
        points_box(&self.control_points)
    }
}

impl RationalCurve {
    /// The curve with the given control points and weights over `[0, 1]`.
    ///
    /// A control point of weight 0 contributes nothing; for a point at infinity see
    /// [`from_homogeneous`](Self::from_homogeneous).
    ///
    /// # Errors
    /// [`ShapeError::NoControlPoints`], [`ShapeError::Degree`], [`ShapeError::WeightCount`],
    /// [`ShapeError::NoWeight`], [`ShapeError::Coordinate`] (also of the products w·x).
    pub fn new(control_points: &[DVec3], weights: &[f64]) -> Result<Self, ShapeError> {
        check_count(control_points.len())?;
        Self::from_homogeneous(lifted(control_points, weights)?)
    }

    /// The curve with homogeneous control points (w·x, w·y, w·z, w) over `[0, 1]`; (x, y, z, 0) is the point
    /// at infinity in that direction.
    ///
    /// ```
    /// use casteljau_shape::{RationalCurve, geom::glam::{DVec3, DVec4}};
    /// // Half a circle: its end tangents meet at infinity.
    /// let half = RationalCurve::from_homogeneous([
    ///     DVec4::new(1.0, 0.0, 0.0, 1.0),
    ///     DVec4::new(0.0, 1.0, 0.0, 0.0),
    ///     DVec4::new(-1.0, 0.0, 0.0, 1.0),
    /// ])?;
    /// assert_eq!(half.point(0.5)?, DVec3::Y);
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// [`ShapeError::NoControlPoints`], [`ShapeError::Degree`], [`ShapeError::NoWeight`],
    /// [`ShapeError::Coordinate`].
    pub fn from_homogeneous(control_points: impl Into<Vec<DVec4>>) -> Result<Self, ShapeError> {
        Self::from_net(Interval::UNIT, control_points)
    }

    /// The first control point, `C(a)`; `None` where it lies at infinity.
    #[must_use]
    pub fn start(&self) -> Option<DVec3> {
        value(&self.control_points, 0.0).euclidean()
    }

    /// The last control point, `C(b)`; `None` where it lies at infinity.
    #[must_use]
    pub fn end(&self) -> Option<DVec3> {
        value(&self.control_points, 1.0).euclidean()
    }

    /// Weights `w₀ … wₙ`.
    pub fn weights(&self) -> impl ExactSizeIterator<Item = f64> {
        self.control_points.iter().map(|p| p.w)
    }

    /// Point `C(t) = Σ Bᵢⁿ(s) wᵢ Pᵢ / Σ Bᵢⁿ(s) wᵢ`.
    ///
    /// Error: 4(n+2)·u·(Σ|Bᵢⁿ wᵢ Pᵢ| + |C|·Σ|Bᵢⁿ wᵢ|)/|w|. Cost: O(n), no allocation.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`] where `t` is not finite, [`ShapeError::Evaluation`] at a pole.
    pub fn point(&self, t: f64) -> Result<DVec3, ShapeError> {
        self.try_point(t)
    }

    /// Point and derivatives up to order 3, by the quotient rule.
    ///
    /// Error: at most 4(n+2k+2)·u times the sum of the absolute contributions. Cost: O(n), no allocation.
    ///
    /// # Errors
    /// Those of [`point`](Self::point).
    pub fn jet(&self, t: f64) -> Result<CurveJet, ShapeError> {
        self.try_jet(t)
    }

    /// The box around the control points, which contains the curve where all weights have one sign.
    ///
    /// `None` where they have not (or a control point lies at infinity): then the hull says nothing.
    #[must_use]
    pub fn hull_box(&self) -> Option<BoundingBox> {
        hull_box(&self.control_points)
    }
}

impl From<Curve> for RationalCurve {
    /// The same curve, all weights 1.
    fn from(curve: Curve) -> Self {
        let points = curve.control_points.iter().map(|p| p.extend(1.0)).collect();
        Self::checked(curve.interval, points)
    }
}

fn check_count(count: usize) -> Result<(), ShapeError> {
    check_degree(count.checked_sub(1).ok_or(ShapeError::NoControlPoints)?)
}
