use casteljau_domain::Location;
use casteljau_geom::SurfaceJet;
use casteljau_geom::glam::DVec3;

use crate::formula;
use crate::normal::unit;
use crate::{ConcavePatch, Contact, GbError};

/// How a patch meets its ribbons, measured.
///
/// Along every side, at `samples` parameters that are denser toward the corners (t = sin²), three figures are taken and
/// their maxima kept:
///
/// - `g0`: distance, in model units, between the side's curve and the point that the *inside* formula gives there, with
///   the coordinates as they are inside, error included (on the side itself the patch uses exact ones and is the
///   curve to rounding). Coordinates that have no inside formula on a side are exact there and count as 0.
/// - `g1`: angle, in degrees, between the ribbon's normal and the limit from inside of the patch's.
/// - `g2`: difference of the two normal curvatures across the side, relative to the larger of their absolute values and
///   1/(size of the model), size being the diagonal of the bounding box.
///
/// These are samples: nothing is proved about what lies between them. A ribbon of one layer prescribes no tangent plane,
/// so `g1` and `g2` are missing for its side.
#[derive(Debug, Clone, PartialEq)]
pub struct ContinuityReport {
    /// One entry a side.
    pub sides: Vec<SideReport>,
    /// Parameters sampled on each side.
    pub samples: usize,
}

/// One side of a [`ContinuityReport`].
#[derive(Debug, Clone, PartialEq)]
pub struct SideReport {
    /// The side.
    pub side: usize,
    /// What the patch promises there.
    pub promised: Contact,
    /// Distance to the side's curve, in model units.
    pub g0: Maximum,
    /// Angle to the ribbon's normal, in degrees.
    pub g1: Option<Maximum>,
    /// Relative difference of the normal curvatures across the side.
    pub g2: Option<Maximum>,
}

/// A largest value and the parameter along the side where it was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Maximum {
    /// The value.
    pub value: f64,
    /// Where on the side, 0 < t < 1.
    pub t: f64,
}

impl Maximum {
    fn raise(slot: &mut Option<Self>, value: f64, t: f64) {
        if slot.is_none_or(|m| value > m.value) {
            *slot = Some(Self { value, t });
        }
    }
}

impl ContinuityReport {
    /// Measures with `samples` (at least 1) parameters a side. Cost: one jet and one point a sample.
    ///
    /// # Errors
    /// Those of [`ConcavePatch::jet_at`].
    pub fn measure(patch: &ConcavePatch, samples: usize) -> Result<Self, GbError> {
        let samples = samples.max(1);
        let size = patch.bounding_box().diagonal();
        let side = |promised: &Contact| side_report(patch, *promised, samples, size);
        Ok(Self { sides: patch.continuity().iter().map(side).collect::<Result<_, _>>()?, samples })
    }
}

fn side_report(
    patch: &ConcavePatch,
    promised: Contact,
    samples: usize,
    size: f64,
) -> Result<SideReport, GbError> {
    let side = promised.side;
    let ribbon = patch.ribbon(side)?;
    let (mut g0, mut g1, mut g2) = (None, None, None);
    for m in 0..samples {
        let t = (std::f64::consts::FRAC_PI_4 * (2 * m + 1) as f64 / samples as f64).sin().powi(2);
        let location = Location::Side { side, t };
        let Some(own) = ribbon.jet(t, 0.0) else { continue };
        let inside = inside_formula(patch, location)?.unwrap_or(own.point);
        Maximum::raise(&mut g0, inside.distance(own.point), t);
        if ribbon.layers() < 2 {
            continue;
        }
        let jet = patch.jet_at(location)?;
        let normal = |jet: &SurfaceJet, sign: f64| unit(jet.du.cross(jet.dv) * sign);
        let (Some(ours), Some(theirs)) = (normal(&jet, patch.handedness()), normal(&own, 1.0)) else {
            continue;
        };
        let angle = ours.cross(theirs).length().atan2(ours.dot(theirs));
        Maximum::raise(&mut g1, angle.to_degrees(), t);
        let across = |normal: DVec3| unit(normal.cross(own.du));
        if let (Some(a), Some(b)) = (across(ours), across(theirs)) {
            let (a, b) = (normal_curvature(&jet, ours, a), normal_curvature(&own, theirs, b));
            let scale = a.abs().max(b.abs()).max(1.0 / size);
            Maximum::raise(&mut g2, (a - b).abs() / scale, t);
        }
    }
    let g0 = g0.unwrap_or(Maximum { value: 0.0, t: 0.5 });
    Ok(SideReport { side, promised, g0, g1, g2 })
}

/// The point that the formula for inside points gives on the side, if the coordinates have a value there.
fn inside_formula(patch: &ConcavePatch, location: Location) -> Result<Option<DVec3>, GbError> {
    let Some(uv) = patch.domain().at(location) else { return Ok(None) };
    let mut lambda = vec![0.0; patch.sides()];
    patch.coordinates().evaluate_inside(&[uv], 0, &mut lambda)?;
    let point = formula::point(&patch.net(), &|i| lambda[i]);
    Ok((point.is_finite() && lambda.iter().all(|x| x.is_finite())).then_some(point))
}

/// Normal curvature in the unit tangent direction `w`: II(a, b) where a·S_u + b·S_v = w.
fn normal_curvature(jet: &SurfaceJet, normal: DVec3, w: DVec3) -> f64 {
    // The dual basis of (S_u, S_v) in the tangent plane.
    let area = jet.du.cross(jet.dv).dot(normal);
    let (a, b) = (w.cross(jet.dv).dot(normal) / area, jet.du.cross(w).dot(normal) / area);
    (jet.duu * (a * a) + jet.duv * (2.0 * a * b) + jet.dvv * (b * b)).dot(normal)
}
