//! A curve and a plane.

use casteljau_bernstein::{RootKind, roots};
use casteljau_geom::glam::{DVec3, Vec4Swizzles};
use casteljau_geom::{TangentPlane, UNIT_ROUNDOFF};

use crate::{BezierCurve, ControlPoint, ShapeError};

/// A point, or a short stretch, that a curve has in common with a plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanePoint {
    /// A parameter of the curve, the middle of the enclosure.
    pub parameter: f64,
    /// The common parameters lie in this interval of the curve's.
    pub enclosure: [f64; 2],
    /// The point of the curve at `parameter`.
    pub point: DVec3,
    /// What is certain: a simple crossing, an end, a change of side, or a touch.
    pub kind: RootKind,
}

/// What a curve and a plane have in common.
#[derive(Debug, Clone, PartialEq)]
pub enum PlaneIntersection {
    /// Isolated points, by ascending parameter; none where the curve stays on one side.
    Points(Vec<PlanePoint>),
    /// The curve lies in the plane: all its control points do, within rounding.
    Contained,
}

impl<P: ControlPoint> BezierCurve<P> {
    /// All parameters at which the curve meets a plane, `n·C(t) = d`, the roots of `Σ Bᵢ (n·Aᵢ − d wᵢ)` with the
    /// homogeneous control points (Aᵢ, wᵢ).
    ///
    /// Every common parameter lies in one of the enclosures, which are no longer than `resolution` times the
    /// curve's interval where rounding allows it. A coefficient within its rounding error, `8u (|n||Aᵢ| +
    /// |d wᵢ|)`, counts as 0: it is that of a plane and a curve which are these to the last digits. The normal need not
    /// have length 1. Where the denominator vanishes too there is no point; such parameters are left out.
    ///
    /// ```
    /// use casteljau_shape::{Curve, PlaneIntersection, geom::{TangentPlane, glam::DVec3}};
    /// let parabola = Curve::new([DVec3::NEG_X + DVec3::Y, DVec3::NEG_Y, DVec3::X + DVec3::Y])?; // y = x²
    /// let plane = TangentPlane { normal: DVec3::Y, offset: 0.25 };
    /// let PlaneIntersection::Points(found) = parabola.intersect_plane(&plane, 1e-12)? else { panic!() };
    /// assert_eq!(found.len(), 2);
    /// assert!((found[0].point.x + 0.5).abs() < 1e-11 && (found[1].point.x - 0.5).abs() < 1e-11);
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// [`ShapeError::Direction`] for a normal that is zero or not finite, [`ShapeError::Parameter`] for an offset
    /// that is not finite, [`ShapeError::Kernel`] for a resolution that is not positive.
    pub fn intersect_plane(
        &self,
        plane: &TangentPlane,
        resolution: f64,
    ) -> Result<PlaneIntersection, ShapeError> {
        let size = plane.normal.abs().max_element();
        if !(plane.normal.is_finite() && size > 0.0) {
            return Err(ShapeError::Direction { direction: plane.normal });
        }
        if !plane.offset.is_finite() {
            return Err(ShapeError::Parameter { value: plane.offset });
        }
        // Divided by its size, so that products with coordinates stay in range.
        let (normal, offset) = (plane.normal / size, plane.offset / size);
        let coefficient = |p: &P| {
            let h = p.homogeneous();
            let value = normal.dot(h.xyz()) - offset * h.w;
            let rounding = 8.0 * UNIT_ROUNDOFF * (normal.abs().dot(h.xyz().abs()) + (offset * h.w).abs());
            if value.abs() <= rounding { 0.0 } else { value }
        };
        let coefficients: Vec<f64> = self.control_points().iter().map(coefficient).collect();
        if coefficients.iter().all(|&c| c == 0.0) {
            return Ok(PlaneIntersection::Contained);
        }
        let interval = self.interval();
        let point = |parameter: f64| {
            let p = casteljau_bernstein::value(self.control_points(), parameter).homogeneous();
            Some(p.xyz() / p.w).filter(|p| p.is_finite())
        };
        let found = roots(&coefficients, resolution)?.into_iter().filter_map(|root| {
            let point = point(root.middle())?;
            let enclosure = [root.start, root.end].map(|t| interval.at(t));
            Some(PlanePoint { parameter: interval.at(root.middle()), enclosure, point, kind: root.kind })
        });
        Ok(PlaneIntersection::Points(found.collect()))
    }
}
