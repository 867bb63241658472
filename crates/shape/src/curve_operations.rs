//! The same curve with other control points: reversed, elevated, cut; and its directions at the ends.

use casteljau_bernstein::{BernsteinError, MAX_DEGREE, elevate, subdivide};
use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};
use casteljau_geom::{Interval, UNIT_ROUNDOFF};

use crate::error::check_points;
use crate::{BezierCurve, ControlPoint, ShapeError};

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
    /// two subdivisions, 8(n+2)·u times its combination of absolute values.
    ///
    /// # Errors
    /// [`ShapeError::Coordinate`] where a far continuation makes points out of range.
    pub fn restricted(&self, interval: Interval) -> Result<Self, ShapeError> {
        let mut points = self.control_points().to_vec();
        let mut rest = points.clone();
        let [a, b] = [self.local(interval.start()), self.local(interval.end())];
        // Cut first where the other end stays farther away, so that it is well placed in what is left.
        if (1.0 - a).abs() >= b.abs() {
            let source = points.clone();
            subdivide(&source, a, &mut rest, &mut points)?;
            let source = points.clone();
            subdivide(&source, (b - a) / (1.0 - a), &mut points, &mut rest)?;
        } else {
            let source = points.clone();
            subdivide(&source, b, &mut points, &mut rest)?;
            let source = points.clone();
            subdivide(&source, a / b, &mut rest, &mut points)?;
        }
        check_points(&points)?;
        Ok(Self::checked(interval, points))
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
