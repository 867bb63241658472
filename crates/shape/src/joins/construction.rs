//! The neighbour of a curve or patch that joins as wanted.

use casteljau_bernstein::{elevate, product};
use casteljau_geom::Interval;
use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};

use super::positive::check_positive;
use crate::error::check_points;
use crate::{BezierCurve, BezierPatch, ControlPoint, Curve, PatchEdge, RationalCurve, ShapeError};

impl<P: ControlPoint> BezierCurve<P> {
    /// The curve that goes on from the end of this one with C¹ continuity: control points `Pₙ`,
    /// `Pₙ + ratio·(Pₙ − Pₙ₋₁)`, and the `free` ones.
    ///
    /// `ratio` is that of the two legs at the joint. The new interval starts where the old one ends, and is so long
    /// that the derivatives agree; with any other interval the joint is still G¹. Rational curves are continued
    /// homogeneously, with the same ratio.
    ///
    /// ```
    /// use casteljau_shape::{Curve, JoinReport, geom::glam::DVec3};
    /// let first = Curve::new([DVec3::ZERO, DVec3::X, DVec3::new(2.0, 1.0, 0.0)])?;
    /// let next = first.continued(0.5, &[DVec3::new(4.0, 0.0, 1.0), DVec3::Z])?;
    /// assert!(JoinReport::of_curves(&first, &next)?.first.unwrap().value < 1e-15);
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// [`ShapeError::Construction`] unless the ratio is positive and finite, and for a curve of degree 0;
    /// [`ShapeError::Degree`], [`ShapeError::Coordinate`].
    ///
    /// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 7.4 and 8.2.
    pub fn continued(&self, ratio: f64, free: &[P]) -> Result<Self, ShapeError> {
        check_ratio(ratio)?;
        let [.., before, end] = self.control_points() else {
            return Err(ShapeError::Construction { what: "degree of the curve", value: 0.0 });
        };
        let mut points = vec![*end, *end + (*end - *before) * ratio];
        points.extend_from_slice(free);
        crate::error::check_degree(points.len() - 1)?;
        check_points(&points)?;
        let interval = next_interval(self.interval(), ratio, self.degree(), points.len() - 1)?;
        Ok(Self::checked(interval, points))
    }
}

impl Curve {
    /// The curve that goes on from the end of this one with continuous curvature (G²): `Q₀ = Pₙ`,
    /// `Q₁ = Q₀ + r(Pₙ − Pₙ₋₁)`, `Q₂ = Q₁ + slide·(Q₁ − Q₀) + ρ·h`, and the `free` points.
    ///
    /// h is the offset of `Pₙ₋₂` from the tangent. With d the offset of `Q₂`, the curvatures at the joint are
    /// `(n−1)/n · |h|/|Pₙ−Pₙ₋₁|²` and `(m−1)/m · |d|/|Q₁−Q₀|²`, m being the degree of the new curve, so that
    /// `ρ = r² · (n−1)m / (n(m−1))`; for two cubics `ρ = r²`. That three points at the joint are collinear and five
    /// coplanar is necessary; together with this ratio, and both offsets on one side, it is sufficient:
    /// [`CurvatureCondition`](crate::CurvatureCondition) measures it.
    ///
    /// `slide` moves Q₂ along the tangent, which the curvature does not see. The interval is that of
    /// [`continued`](BezierCurve::continued), so that the joint is C¹ too.
    ///
    /// # Errors
    /// Those of [`continued`](BezierCurve::continued); [`ShapeError::Construction`] for a degree below 2 and where
    /// `Pₙ₋₁` and `Pₙ` coincide.
    ///
    /// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 11.2.
    pub fn continued_with_curvature(
        &self,
        ratio: f64,
        slide: f64,
        free: &[DVec3],
    ) -> Result<Self, ShapeError> {
        check_ratio(ratio)?;
        let [.., inner, before, end] = self.control_points() else {
            return Err(ShapeError::Construction {
                what: "degree of the curve",
                value: self.degree() as f64,
            });
        };
        let leg = end - before;
        let Some(tangent) = leg.try_normalize() else {
            return Err(ShapeError::Construction { what: "length of the last leg", value: leg.length() });
        };
        let offset = (inner - before) - tangent * tangent.dot(inner - before);
        let (n, m) = (self.degree() as f64, (free.len() + 2) as f64);
        let rho = ratio * ratio * ((n - 1.0) * m) / (n * (m - 1.0));
        let first = end + leg * ratio;
        let mut rest = vec![first + leg * (ratio * slide) + offset * rho];
        rest.extend_from_slice(free);
        self.continued(ratio, &rest)
    }
}

impl RationalCurve {
    /// The rational curve that goes on from the end of this one with C¹ and with continuous curvature (G²), its first
    /// weights `wₙ`, `v₁`, `v₂`: `Q₀ = Pₙ`, `Q₁ = Q₀ + r(Pₙ − Pₙ₋₁)`, `Q₂ = Q₁ + slide·(Q₁ − Q₀) + ρ·h`, and the `free`
    /// points, which are homogeneous.
    ///
    /// h is the offset of `Pₙ₋₂` from the tangent. The curvature at the joint is `(n−1)/n · wₙwₙ₋₂/wₙ₋₁² ·
    /// |h|/|Pₙ−Pₙ₋₁|²` on one side and likewise on the other, so that with m, the degree of the new curve,
    /// `ρ = r² · (n−1)m / (n(m−1)) · (wₙwₙ₋₂/wₙ₋₁²) · (v₁²/(wₙv₂))`. Where all weights are equal this is
    /// [`Curve::continued_with_curvature`].
    ///
    /// ```
    /// use casteljau_shape::{JoinReport, RationalCurve, geom::glam::DVec3};
    /// let arc = RationalCurve::arc(DVec3::ZERO, DVec3::X, DVec3::Y, 1.0)?.remove(0);
    /// let next = arc.continued_with_curvature(1.5, 0.5, [2.0, 3.0], &[DVec3::Z.extend(1.0)])?;
    /// let report = JoinReport::of_curves(&arc, &next)?;
    /// assert!(report.first.unwrap().value < 1e-14 && report.curvature.unwrap().value < 1e-13);
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// [`ShapeError::Construction`] unless the ratio is positive and finite, for a degree below 2, where `Pₙ₋₁` and `Pₙ`
    /// coincide, and unless `wₙ₋₁`, `v₁` and `v₂` have the sign of `wₙ`; [`ShapeError::Degree`],
    /// [`ShapeError::Coordinate`].
    ///
    /// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., the chapter on rational curves, for the curvature.
    pub fn continued_with_curvature(
        &self,
        ratio: f64,
        slide: f64,
        weights: [f64; 2],
        free: &[DVec4],
    ) -> Result<Self, ShapeError> {
        check_ratio(ratio)?;
        let &[.., inner, before, end] = self.control_points() else {
            return Err(ShapeError::Construction {
                what: "degree of the curve",
                value: self.degree() as f64,
            });
        };
        for weight in [before.w, weights[0], weights[1]] {
            let quotient = weight / end.w;
            if !(quotient > 0.0 && quotient.is_finite()) {
                return Err(ShapeError::Construction { what: "quotient of the weights", value: quotient });
            }
        }
        let (start, last) = (end.xyz() / end.w, before.xyz() / before.w);
        let leg = start - last;
        let Some(tangent) = leg.try_normalize() else {
            return Err(ShapeError::Construction { what: "length of the last leg", value: leg.length() });
        };
        // Times its weight, so that a point at infinity is no exception.
        let inner = inner.xyz() - last * inner.w;
        let offset = inner - tangent * tangent.dot(inner);
        let (n, m) = (self.degree() as f64, (free.len() + 2) as f64);
        let [v1, v2] = weights;
        let degrees = (n - 1.0) * m / (n * (m - 1.0));
        let rho = ratio * ratio * degrees * (v1 / before.w) * (v1 / before.w) / v2;
        let first = start + leg * ratio;
        let second = first + leg * (ratio * slide) + offset * rho;
        let mut points = vec![end, (first * v1).extend(v1), (second * v2).extend(v2)];
        points.extend_from_slice(free);
        crate::error::check_degree(points.len() - 1)?;
        check_points(&points)?;
        // C′ is n·wₙ₋₁/wₙ times the leg at the end, m·v₁/wₙ times that at the start.
        let ratio = ratio * (v1 / before.w);
        let interval = next_interval(self.interval(), ratio, self.degree(), points.len() - 1)?;
        Ok(Self::checked(interval, points))
    }
}

impl<P: ControlPoint> BezierPatch<P> {
    /// The patch that goes on beyond an edge of this one with G¹ continuity and a ratio that varies along the edge: the
    /// row of the edge, the row beyond it, `R + α·(Rₘ − Rₘ₋₁) + β·R′`, and the `free` rows.
    ///
    /// α and β are polynomials of the parameter of the edge over `[0, 1]`, given by their Bernstein coefficients; R is the
    /// edge, R′ its derivative. With a and b the degrees of α and β, the rows have the degree `max(n + a, n − 1 + b)` along
    /// the edge, and `free` must have that many control points a row and one more. No β (an empty slice) is β = 0; with
    /// one number for α it is [`continued`](Self::continued). The tangent planes agree all along; the derivatives across
    /// do not.
    ///
    /// ```
    /// use casteljau_shape::{JoinReport, Patch, PatchEdge, SurfaceEdge, geom::glam::DVec3};
    /// let p = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    /// let roof = Patch::new([1, 1], [p(0., 0., 0.), p(0., 1., 0.), p(1., 0., 1.), p(1., 1., 2.)])?;
    /// let next = roof.continued_varying(PatchEdge::UEnd, &[1.0, 3.0], &[0.5, 0.0, -0.5], &[])?;
    /// assert_eq!(next.degrees(), [1, 2]);
    /// let (a, b) = (SurfaceEdge::of_patch(&roof, PatchEdge::UEnd)?, SurfaceEdge::of_patch(&next, PatchEdge::UStart)?);
    /// assert!(JoinReport::along_edge(&a, &b, 9)?.angle.unwrap().value < 1e-6);
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// [`ShapeError::Ratio`] where α is not positive on `[0, 1]`, whatever the signs of its coefficients; it names a
    /// parameter and α there. [`ShapeError::Construction`] without coefficients of α, and for one that is not finite;
    /// otherwise those of [`continued`](Self::continued).
    ///
    /// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., the chapter on geometric continuity of surfaces.
    pub fn continued_varying(
        &self,
        edge: PatchEdge,
        alpha: &[f64],
        beta: &[f64],
        free: &[P],
    ) -> Result<Self, ShapeError> {
        let (Some(&first), false) = (alpha.first(), beta.iter().any(|b| !b.is_finite())) else {
            let value = beta.iter().copied().find(|b| !b.is_finite()).unwrap_or(0.0);
            return Err(ShapeError::Construction { what: "coefficient along the edge", value });
        };
        check_positive(alpha)?;
        let simple = self.continued(edge, 1.0, &[])?;
        let n = simple.degrees()[1];
        // The row of the edge, and the one beyond it for α = 1: their difference is the leg.
        let (last, beyond) = simple.control_points().split_at(n + 1);
        let legs: Vec<P> = last.iter().zip(beyond).map(|(&p, &q)| q - p).collect();
        let slopes: Vec<P> = last.windows(2).map(|p| (p[1] - p[0]) * n as f64).collect();
        let degree = (n + alpha.len() - 1).max((n + beta.len()).saturating_sub(2));
        crate::error::check_degree(degree)?;
        let raised = |points: &[P]| -> Result<Vec<P>, ShapeError> {
            let mut out = vec![P::ZERO; degree + 1];
            elevate(points, &mut out)?;
            Ok(out)
        };
        let mut points = raised(last)?;
        let mut second = points.clone();
        let mut add = |factor: &[f64], row: &[P]| -> Result<(), ShapeError> {
            if !factor.is_empty() && !row.is_empty() {
                let mut term = vec![P::ZERO; factor.len() + row.len() - 1];
                product(factor, row, &mut term)?;
                second.iter_mut().zip(raised(&term)?).for_each(|(p, q)| *p = *p + q);
            }
            Ok(())
        };
        add(alpha, &legs)?;
        add(beta, &slopes)?;
        points.extend(second);
        points.extend_from_slice(free);
        let rows = points.len() / (degree + 1);
        if rows * (degree + 1) != points.len() {
            let needed = (rows + 1) * (degree + 1);
            return Err(ShapeError::NetSize { degrees: [rows, degree], needed, given: points.len() });
        }
        crate::error::check_degree(rows - 1)?;
        check_points(&points)?;
        let [across, along] = simple.intervals();
        // The derivatives across agree where the edge starts, up to β.
        let across = Interval::new(0.0, across.length() * first * (rows - 1) as f64).unwrap_or(across);
        Ok(Self::checked([across, along], [rows - 1, degree], points))
    }

    /// The patch that goes on beyond an edge of this one with C¹ continuity: the row of the edge, the row beyond it,
    /// `Rₘ + ratio·(Rₘ − Rₘ₋₁)`, and the `free` rows, one after another.
    ///
    /// The new patch begins at its edge u = a, with v along the common edge; its rows have as many control points as
    /// the edge. The interval of u starts at 0 and is so long that the derivatives across agree; with any other one the joint
    /// is still G¹. Where the first row is degenerate the joint is too.
    ///
    /// ```
    /// use casteljau_shape::{JoinReport, Patch, PatchEdge, SurfaceEdge, geom::glam::DVec3};
    /// let p = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    /// let roof = Patch::new([1, 1], [p(0., 0., 0.), p(0., 1., 0.), p(1., 0., 1.), p(1., 1., 2.)])?;
    /// let next = roof.continued(PatchEdge::VEnd, 2.0, &[p(0., 4., 0.), p(1., 5., 0.)])?;
    /// let (a, b) = (SurfaceEdge::of_patch(&roof, PatchEdge::VEnd)?, SurfaceEdge::of_patch(&next, PatchEdge::UStart)?);
    /// let report = JoinReport::along_edge(&a, &b, 9)?;
    /// assert!(report.gap.value == 0.0 && report.first.unwrap().value < 1e-15);
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// [`ShapeError::Construction`] unless the ratio is positive and finite, and for degree 0 across the edge;
    /// [`ShapeError::NetSize`] where `free` is no whole number of rows; [`ShapeError::Degree`],
    /// [`ShapeError::Coordinate`].
    ///
    /// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 15.7.
    pub fn continued(&self, edge: PatchEdge, ratio: f64, free: &[P]) -> Result<Self, ShapeError> {
        check_ratio(ratio)?;
        // Turned so that the edge is the last row.
        let turned = match edge {
            PatchEdge::UStart => self.reversed_u(),
            PatchEdge::UEnd => self.clone(),
            PatchEdge::VStart => self.swapped().reversed_u(),
            PatchEdge::VEnd => self.swapped(),
        };
        let [m, n] = turned.degrees();
        if m == 0 {
            return Err(ShapeError::Construction { what: "degree across the edge", value: 0.0 });
        }
        let (before, last) = turned.control_points()[(m - 1) * (n + 1)..].split_at(n + 1);
        let mut points = last.to_vec();
        points.extend(last.iter().zip(before).map(|(&p, &q)| p + (p - q) * ratio));
        points.extend_from_slice(free);
        let rows = points.len() / (n + 1);
        let degrees = [rows - 1, n];
        if rows * (n + 1) != points.len() {
            return Err(ShapeError::NetSize {
                degrees: [rows, n],
                needed: (rows + 1) * (n + 1),
                given: points.len(),
            });
        }
        crate::error::check_degree(rows - 1)?;
        check_points(&points)?;
        let [across, along] = turned.intervals();
        let from = Interval::new(-across.length(), 0.0).unwrap_or(across);
        Ok(Self::checked([next_interval(from, ratio, m, rows - 1)?, along], degrees, points))
    }
}

/// The interval after `[a, b]` over which degree m makes of a leg `ratio` times as long the same derivative as degree
/// n over `[a, b]`: its length is `ratio·(m/n)·(b−a)`.
fn next_interval(interval: Interval, ratio: f64, n: usize, m: usize) -> Result<Interval, ShapeError> {
    let length = interval.length() * (ratio * m as f64 / n as f64);
    Interval::new(interval.end(), interval.end() + length)
        .map_err(|_| ShapeError::Construction { what: "length of the next interval", value: length })
}

fn check_ratio(ratio: f64) -> Result<(), ShapeError> {
    if ratio > 0.0 && ratio.is_finite() {
        Ok(())
    } else {
        Err(ShapeError::Construction { what: "ratio of the legs", value: ratio })
    }
}
