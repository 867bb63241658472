//! A straight line and a patch.

use casteljau_geom::UNIT_ROUNDOFF;
use casteljau_geom::glam::{DVec2, DVec3, Vec4Swizzles};

use super::StraightLine;
use super::system::{Area, System};
use crate::closest::clusters;
use crate::{BezierPatch, ControlPoint, ShapeError};

/// A point that a line and a patch have in common.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinePoint {
    /// Parameters of the patch.
    pub parameters: [f64; 2],
    /// The common point lies within so much of each parameter.
    pub uncertainty: [f64; 2],
    /// Parameter s of the line `p + s·d`.
    pub line_parameter: f64,
    /// The point of the patch.
    pub point: DVec3,
    /// Distance of that point from the line.
    pub distance: f64,
    /// Whether the line certainly goes through the patch here, once. Otherwise the two touch, within rounding: there
    /// may be no common point, or several within the uncertainty.
    pub transversal: bool,
}

/// What a line and a patch have in common.
#[derive(Debug, Clone, PartialEq)]
pub enum LineIntersection {
    /// Isolated points, by ascending line parameter; none where the line misses.
    Points(Vec<LinePoint>),
    /// A whole stretch of the line lies in the patch, or nearly: a ruling, or a contact that could not be resolved.
    /// All common points are among `points` or in the parameter boxes `stretches`.
    Stretches {
        /// The isolated common points.
        points: Vec<LinePoint>,
        /// Boxes around the rest.
        stretches: Vec<[[f64; 2]; 2]>,
    },
    /// The patch lies in one plane with the line, within rounding.
    Coplanar {
        /// A unit normal of that plane.
        normal: DVec3,
    },
}

/// Undecided boxes may join to so many times the resolution, and still count as one place of contact.
const CONTACT: f64 = 1e4;

impl<P: ControlPoint> BezierPatch<P> {
    /// All points that a straight line, ray or segment and the patch have in common.
    ///
    /// With two planes `nₖ·x = nₖ·p` through the line these are the common roots of `Σ Bᵢⱼ nₖ·(Aᵢⱼ − wᵢⱼ p)`, k = 1, 2,
    /// found by subdivision: nothing is left out but where rounded coefficients exclude a root. `resolution` is the
    /// width, as a share of the intervals, down to which points are told apart where the line is not transversal to
    /// the patch; contacts are blurred by rounding to about 1e-7, so that a finer one is of little use.
    /// Weights may have any sign; where the denominator vanishes too there is no point.
    ///
    /// Cost: some 20 µs for a bicubic patch and a transversal line; at most 20,000 boxes are looked at.
    ///
    /// ```
    /// use casteljau_shape::{LineIntersection, Patch, StraightLine, geom::glam::DVec3};
    /// let net = [[0., 0., 0.], [0., 1., 0.], [1., 0., 0.], [1., 1., 1.]].map(DVec3::from_array); // z = xy
    /// let patch = Patch::new([1, 1], net)?;
    /// let ray = StraightLine::ray(DVec3::new(0.5, 0.5, 9.0), DVec3::NEG_Z)?;
    /// let LineIntersection::Points(found) = patch.intersect_line(&ray, 1e-7)? else { panic!() };
    /// assert_eq!(found.len(), 1);
    /// assert!(found[0].transversal && found[0].point.distance(DVec3::new(0.5, 0.5, 0.25)) < 1e-14);
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// [`ShapeError::Accuracy`] for a resolution that is not between 0 and 1.
    pub fn intersect_line(
        &self,
        line: &StraightLine,
        resolution: f64,
    ) -> Result<LineIntersection, ShapeError> {
        if !(resolution > 0.0 && resolution < 1.0) {
            return Err(ShapeError::Accuracy { relative: resolution });
        }
        let normals = line.normals();
        let homogeneous = || self.control_points().iter().map(|p| p.homogeneous());
        // The largest number that a coefficient is made of: in its unit all is computed, so that nothing overflows.
        let size = |p: DVec3, w: f64| p.abs().max_element() + (line.origin() * w).abs().max_element();
        let largest = homogeneous().map(|h| size(h.xyz(), h.w)).fold(f64::MIN_POSITIVE, f64::max);
        let net: Vec<DVec2> = homogeneous()
            .map(|h| {
                let away = (h.xyz() - line.origin() * h.w) / largest;
                DVec2::new(normals[0].dot(away), normals[1].dot(away))
            })
            .collect();
        let error = 16.0 * UNIT_ROUNDOFF;
        if let Some(normal) = common_normal(&net, error) {
            let normal = normals[0] * normal.x + normals[1] * normal.y;
            return Ok(LineIntersection::Coplanar { normal });
        }
        let system = System::new(net, self.degrees(), error, 1.0);
        let roots = system.roots(resolution);
        let mut points: Vec<LinePoint> = roots
            .isolated
            .iter()
            .filter_map(|root| {
                let at = root.at.clamp(DVec2::ZERO, DVec2::ONE);
                self.line_point(line, at, root.radius, true)
            })
            .collect();
        let mut stretches: Vec<Area> = Vec::new();
        for area in clusters(roots.undecided) {
            let extent = area.map(|[a, b]| b - a);
            if extent[0].max(extent[1]) > CONTACT * resolution {
                stretches.push([0, 1].map(|k| area[k].map(|s| self.intervals()[k].at(s))));
                continue;
            }
            let middle = DVec2::new(area[0][0] + area[0][1], area[1][0] + area[1][1]) * 0.5;
            let at = system
                .nearest(middle)
                .clamp(DVec2::new(area[0][0], area[1][0]), DVec2::new(area[0][1], area[1][1]));
            points.extend(self.line_point(line, at, DVec2::from_array(extent), false));
        }
        points.sort_by(|a, b| a.line_parameter.total_cmp(&b.line_parameter));
        if stretches.is_empty() {
            Ok(LineIntersection::Points(points))
        } else {
            Ok(LineIntersection::Stretches { points, stretches })
        }
    }

    /// The point at a place of `[0, 1]²`, if the line reaches it and it is no pole.
    fn line_point(
        &self,
        line: &StraightLine,
        at: DVec2,
        radius: DVec2,
        transversal: bool,
    ) -> Option<LinePoint> {
        let p = self.net().value(at.x, at.y).homogeneous();
        let point = p.xyz() / p.w;
        if !point.is_finite() {
            return None;
        }
        let s = line.parameter(point);
        // What rounding of the point makes of s.
        let size = point.abs().max_element() + line.origin().abs().max_element();
        let degree = self.degrees()[0] + self.degrees()[1];
        let slack = (8 * (degree + 4)) as f64 * UNIT_ROUNDOFF * size / line.direction().abs().max_element();
        let intervals = self.intervals();
        line.reaches(s, slack).then(|| LinePoint {
            parameters: [intervals[0].at(at.x), intervals[1].at(at.y)],
            uncertainty: [radius.x * intervals[0].length(), radius.y * intervals[1].length()],
            line_parameter: s,
            point,
            distance: point.distance(line.point(s)),
            transversal,
        })
    }
}

/// A unit vector orthogonal to all coefficients, within `error`.
fn common_normal(net: &[DVec2], error: f64) -> Option<DVec2> {
    let longest = net.iter().copied().max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))?;
    let normal = longest.try_normalize().map_or(DVec2::Y, DVec2::perp);
    net.iter().all(|c| c.dot(normal).abs() <= error).then_some(normal)
}
