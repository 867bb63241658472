//! The neighbour of a curve or patch that joins as wanted.

use casteljau_geom::Interval;
use casteljau_geom::glam::DVec3;

use crate::error::check_points;
use crate::{BezierCurve, BezierPatch, ControlPoint, Curve, PatchEdge, ShapeError};

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

impl<P: ControlPoint> BezierPatch<P> {
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
