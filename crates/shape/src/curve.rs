//! Polynomial Bézier curves.

use casteljau_bernstein::{derivatives, elevate, subdivide, value};
use casteljau_geom::glam::DVec3;
use casteljau_geom::{BoundingBox, CurveJet, UNIT_ROUNDOFF};

use crate::ShapeError;
use crate::error::{check_degree, check_points};

/// A polynomial Bézier curve over `[0, 1]`, `C(t) = Σ Bᵢⁿ(t) Pᵢ`.
///
/// There is at least one control point, all are finite, and the degree is at most
/// [`MAX_DEGREE`](casteljau_bernstein::MAX_DEGREE). Control points may coincide. Evaluation at a parameter
/// that is not finite gives NaN, at any other one a finite answer, unless the polynomial itself leaves the
/// range of f64.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    control_points: Vec<DVec3>,
}

impl Curve {
    /// The curve with the given control points; its degree is their number less one.
    ///
    /// # Errors
    /// [`ShapeError::NoControlPoints`], [`ShapeError::Degree`], [`ShapeError::Coordinate`].
    pub fn new(control_points: impl Into<Vec<DVec3>>) -> Result<Self, ShapeError> {
        let control_points = control_points.into();
        check_degree(control_points.len().checked_sub(1).ok_or(ShapeError::NoControlPoints)?)?;
        check_points(&control_points)?;
        Ok(Self { control_points })
    }

    /// Degree n.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.control_points.len() - 1
    }

    /// Control points `P₀ … Pₙ`.
    #[must_use]
    pub fn control_points(&self) -> &[DVec3] {
        &self.control_points
    }

    /// Point `C(t) = Σ Bᵢⁿ(t) Pᵢ`, by nested multiplication.
    ///
    /// `t` may lie outside `[0, 1]`: the polynomial is continued, not clamped. The ends are met to the bit.
    /// Error: at most 4(n+2)·u·Σ|Bᵢⁿ(t)||Pᵢ|, u = 2⁻⁵³. Cost: O(n), no allocation.
    #[must_use]
    pub fn point(&self, t: f64) -> DVec3 {
        value(&self.control_points, t)
    }

    /// Point and derivatives up to order 3, `dᵏC/dtᵏ = n!/(n−k)! Σ Bᵢⁿ⁻ᵏ(t) Δᵏ Pᵢ`.
    ///
    /// Error: at most 4(n+2k+2)·u times the sum of the absolute contributions. Cost: O(n), no allocation.
    #[must_use]
    pub fn jet(&self, t: f64) -> CurveJet {
        let mut jet = [DVec3::ZERO; 4];
        derivatives(&self.control_points, t, &mut jet);
        let [point, d1, d2, d3] = jet;
        CurveJet { point, d1, d2, d3 }
    }

    /// The first control point, `C(0)`.
    #[must_use]
    pub fn start(&self) -> DVec3 {
        self.point(0.0)
    }

    /// The last control point, `C(1)`.
    #[must_use]
    pub fn end(&self) -> DVec3 {
        self.point(1.0)
    }

    /// Unit tangent at the start, `lim C′/|C′|` for t → 0⁺.
    ///
    /// It points from `P₀` to the first control point apart from it; points closer than `4u` times the
    /// largest coordinate coincide.
    /// `None` where all of them do.
    #[must_use]
    pub fn start_tangent(&self) -> Option<DVec3> {
        leaving(self.coincidence(), self.control_points.iter())
    }

    /// Unit tangent at the end, `lim C′/|C′|` for t → 1⁻: from the last control point apart from `Pₙ` to
    /// `Pₙ`. Otherwise as [`start_tangent`](Self::start_tangent).
    #[must_use]
    pub fn end_tangent(&self) -> Option<DVec3> {
        leaving(self.coincidence(), self.control_points.iter().rev()).map(|d| -d)
    }

    /// The distance up to which control points count as one: what rounding of the largest coordinate can make.
    fn coincidence(&self) -> f64 {
        4.0 * UNIT_ROUNDOFF * self.control_points.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max)
    }

    /// The same curve run backwards, `C(1−t)`.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self { control_points: self.control_points.iter().rev().copied().collect() }
    }

    /// The same curve as one of degree n + `by`.
    ///
    /// Error of each control point: at most 4(n+by+2)·u times its convex combination of absolute values; the
    /// ends are kept to the bit.
    ///
    /// # Errors
    /// [`ShapeError::Kernel`] where the degree becomes larger than
    /// [`MAX_DEGREE`](casteljau_bernstein::MAX_DEGREE).
    pub fn elevated(&self, by: usize) -> Result<Self, ShapeError> {
        let count = self.control_points.len().saturating_add(by);
        if count - 1 > casteljau_bernstein::MAX_DEGREE {
            let limit = casteljau_bernstein::MAX_DEGREE;
            return Err(casteljau_bernstein::BernsteinError::Degree { degree: count - 1, limit }.into());
        }
        let mut control_points = vec![DVec3::ZERO; count];
        elevate(&self.control_points, &mut control_points)?;
        Ok(Self { control_points })
    }

    /// The curve over `[0, t]` and that over `[t, 1]`, each on its own `[0, 1]`; they share `C(t)` to the bit.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`] where `t` is not finite, [`ShapeError::Coordinate`] where a `t` far outside
    /// `[0, 1]` makes points out of range.
    pub fn split(&self, t: f64) -> Result<(Self, Self), ShapeError> {
        if !t.is_finite() {
            return Err(ShapeError::Parameter { value: t });
        }
        let mut left = vec![DVec3::ZERO; self.control_points.len()];
        let mut right = left.clone();
        subdivide(&self.control_points, t, &mut left, &mut right)?;
        Ok((Self::new(left)?, Self::new(right)?))
    }

    /// The box around the control points; by the convex hull property it contains the curve over `[0, 1]`.
    #[must_use]
    pub fn bounding_box(&self) -> BoundingBox {
        let first = self.control_points[0];
        let point = BoundingBox { min: first, max: first };
        self.control_points.iter().fold(point, |b, &p| BoundingBox { min: b.min.min(p), max: b.max.max(p) })
    }
}

/// Unit direction from the first point to the first one farther from it than `coincidence`.
fn leaving<'a>(coincidence: f64, mut points: impl Iterator<Item = &'a DVec3>) -> Option<DVec3> {
    let first = points.next()?;
    points.map(|p| p - first).find(|d| d.abs().max_element() > coincidence)?.try_normalize()
}
