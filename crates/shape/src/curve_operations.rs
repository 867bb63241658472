//! The same curve with other control points: reversed, elevated, cut; and its directions at the ends.

use casteljau_bernstein::{BernsteinError, MAX_DEGREE, elevate, reduce, restrict, subdivide};
use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};
use casteljau_geom::{Interval, UNIT_ROUNDOFF};

use crate::control_point::{checked, distance_bound};
use crate::error::check_points;
use crate::{BezierCurve, ControlPoint, RationalCurve, ShapeError};

impl<P: ControlPoint> BezierCurve<P> {
    /// Unit tangent at the start, `lim C′/|C′|` for t → a⁺.
    ///
    /// It points from `P₀` to the first control point apart from it (away from it, where the signs of their
    /// weights differ); points closer than `4u` times the largest coordinate coincide.
    /// `None` where all of them do, and where `P₀` lies at infinity.
    #[must_use]
    pub fn start_tangent(&self) -> Option<DVec3> {
        leaving(self.control_points().iter())
    }

    /// Unit tangent at the end, `lim C′/|C′|` for t → b⁻: from the last control point apart from `Pₙ` to
    /// `Pₙ`. Otherwise as [`start_tangent`](Self::start_tangent).
    #[must_use]
    pub fn end_tangent(&self) -> Option<DVec3> {
        leaving(self.control_points().iter().rev()).map(|d| -d)
    }

    /// The same curve run backwards, `C(a+b−t)`.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self::checked(self.interval(), self.control_points().iter().rev().copied().collect())
    }

    /// The same curve as one of degree n + `by`.
    ///
    /// Error of each control point: at most 4(n+by+2)·u times its convex combination of absolute values; the
    /// ends are kept to the bit.
    ///
    /// # Errors
    /// [`ShapeError::Kernel`] where the degree becomes larger than [`MAX_DEGREE`].
    pub fn elevated(&self, by: usize) -> Result<Self, ShapeError> {
        let degree = self.degree().saturating_add(by);
        if degree > MAX_DEGREE {
            return Err(BernsteinError::Degree { degree, limit: MAX_DEGREE }.into());
        }
        let mut points = vec![P::ZERO; degree + 1];
        elevate(self.control_points(), &mut points)?;
        Ok(Self::checked(self.interval(), points))
    }

    /// The curve over `[a, t]` and that over `[t, b]`, each on its own `[0, 1]`; they share `C(t)` to the bit.
    ///
    /// `t` may lie outside the interval. [`restricted`](Self::restricted) keeps the parameter.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`] where `t` is not finite, [`ShapeError::Coordinate`] where a `t` far outside
    /// the interval makes points out of range.
    pub fn split(&self, t: f64) -> Result<(Self, Self), ShapeError> {
        if !t.is_finite() {
            return Err(ShapeError::Parameter { value: t });
        }
        let mut left = vec![P::ZERO; self.control_points().len()];
        let mut right = left.clone();
        subdivide(self.control_points(), self.local(t), &mut left, &mut right)?;
        check_points(&left)?;
        check_points(&right)?;
        Ok((Self::checked(Interval::UNIT, left), Self::checked(Interval::UNIT, right)))
    }

    /// The part of the curve over another interval, which keeps its parameter: `part.point(t)` is
    /// `whole.point(t)`.
    ///
    /// The interval may reach beyond that of the curve, which is then continued. Error of each control point:
    /// at most 4(n+2)·u times its combination of absolute values.
    ///
    /// # Errors
    /// [`ShapeError::Coordinate`] where a far continuation makes points out of range.
    pub fn restricted(&self, interval: Interval) -> Result<Self, ShapeError> {
        let mut points = vec![P::ZERO; self.control_points().len()];
        let part = [self.local(interval.start()), self.local(interval.end())];
        restrict(self.control_points(), part, &mut points)?;
        check_points(&points)?;
        Ok(Self::checked(interval, points))
    }

    /// The nearest curve of a lower degree with the same ends, and a bound on its distance from this one at
    /// equal parameters, over the interval, in model units.
    ///
    /// Minimises the mean square distance of the control polynomials, which are homogeneous where the curve is
    /// rational. A curve that was elevated comes back as it was. See
    /// [`reduce`](casteljau_bernstein::reduce).
    ///
    /// ```
    /// use casteljau_shape::{Curve, geom::glam::DVec3};
    /// let parabola = Curve::new([DVec3::ZERO, DVec3::X, DVec3::ONE])?;
    /// let (again, error) = parabola.elevated(3)?.reduced(2)?;
    /// assert!(error < 1e-14 && again.point(0.5).distance(parabola.point(0.5)) < 1e-14);
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// [`ShapeError::Kernel`] where `degree` is above that of the curve, [`ShapeError::Unbounded`] for a
    /// rational curve whose weights, or whose reduced weights, do not all have one sign.
    pub fn reduced(&self, degree: usize) -> Result<(Self, f64), ShapeError> {
        let from = self.degree();
        if degree > from {
            return Err(BernsteinError::ReducedDegree { from, to: degree }.into());
        }
        let (mut points, mut work) = (vec![P::ZERO; degree + 1], vec![P::ZERO; from + 1]);
        let deviation = reduce(self.control_points(), &mut points, &mut work)?;
        let reduced = Self::checked(self.interval(), points);
        if !P::RATIONAL {
            return Ok((reduced, deviation));
        }
        let raised = reduced.elevated(from - degree)?;
        let error = distance_bound(self.control_points(), raised.control_points(), from)?;
        Ok((reduced, error))
    }
}

impl RationalCurve {
    /// The same curve run at another pace, `t ↦ ct/(1 − t + ct)` over `[0, 1]`: its weights become `cⁱ wᵢ`.
    ///
    /// This is the Möbius reparametrisation that keeps the ends; with c > 1 the start is run through faster.
    ///
    /// # Errors
    /// [`ShapeError::Construction`] unless c is positive and finite, [`ShapeError::Coordinate`] where weights
    /// leave the range.
    ///
    /// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 13.5.
    pub fn repaced(&self, c: f64) -> Result<Self, ShapeError> {
        if c.is_nan() || c <= 0.0 || c.is_infinite() {
            return Err(ShapeError::Construction { what: "ratio of the weights", value: c });
        }
        let mut power = 1.0;
        let mut points = self.control_points().to_vec();
        for p in &mut points {
            *p *= power;
            power *= c;
        }
        Ok(Self::checked(self.interval(), checked(points)?))
    }

    /// The same curve in standard form, with first and last weight 1.
    ///
    /// # Errors
    /// [`ShapeError::Construction`] unless the end weights have the same sign, [`ShapeError::Coordinate`] where
    /// weights leave the range.
    pub fn standard_form(&self) -> Result<Self, ShapeError> {
        let points = self.control_points();
        let (first, last) = (points[0].w, points[points.len() - 1].w);
        let ratio = first / last;
        if ratio.is_nan() || ratio <= 0.0 || ratio.is_infinite() {
            return Err(ShapeError::Construction { what: "ratio of the end weights", value: ratio });
        }
        let scaled = points.iter().map(|&p| p / first).collect();
        let even = Self::checked(self.interval(), scaled);
        if even.degree() == 0 { Ok(even) } else { even.repaced(ratio.powf(1.0 / self.degree() as f64)) }
    }
}

/// Unit direction in which a curve leaves the first point: that of the first `N_i − w_i P₀`, times the sign of
/// w₀, which does not vanish within rounding.
fn leaving<'a, P: ControlPoint + 'a>(points: impl Iterator<Item = &'a P> + Clone) -> Option<DVec3> {
    let mut nets = points.map(|p| p.homogeneous());
    let first = nets.clone().next()?;
    let start = first.xyz() / first.w;
    if !start.is_finite() {
        return None;
    }
    let largest =
        |m: f64, n: DVec4| m.max(n.xyz().abs().max_element()).max(n.w.abs() * start.abs().max_element());
    // What rounding of the largest coordinate can make.
    let coincidence = 4.0 * UNIT_ROUNDOFF * nets.clone().fold(0.0, largest);
    let offset = nets.find_map(|n| {
        let d = n.xyz() - start * n.w;
        (d.abs().max_element() > coincidence).then_some(d)
    })?;
    (offset * first.w.signum()).try_normalize()
}
