//! From ribbons to the domain polygon: the lengths, angles and corners that a layout is made of.

use casteljau_domain::layout::{self, Layout, LayoutOptions};
use casteljau_geom::glam::DVec3;
use casteljau_shape::Curve;

use crate::normal::unit;
use crate::{GbError, LayoutKind, Ribbon};

/// Relative error allowed in the arc lengths of the sides.
pub const ARC_LENGTH_ACCURACY: f64 = 1e-12;

/// A projection that has another concave corner than the ribbons is kept if the corner turns by less than this, in
/// radians: near a straight corner the ribbons' cross directions decide nothing.
pub const NEARLY_STRAIGHT: f64 = 0.1;

/// Signed turning angle at every corner, in radians within [−π, π]: the angle between the end tangent of side i and the
/// start tangent of side i+1, negative at a concave corner.
///
/// A corner is concave where the end tangent of side i points along the cross direction of ribbon i+1,
/// `(C^{i+1}_{0,1} − C^{i+1}_{0,0})·tangent > 0`. A ribbon i+1 of one layer has no cross direction; then side i's own
/// decides the same question seen from the other side of the corner, `(C^i_{d,1} − C^i_{d,0})·(start tangent of i+1) < 0`;
/// with one layer on both sides the corner is taken for convex. Tangents are directions to the nearest control point
/// that differs from the corner.
///
/// ```
/// use casteljau_gb::{Ribbon, turning_angles, glam::DVec3};
/// let line = |a: DVec3, b: DVec3| Ribbon::new(1, 1, vec![a, b]).unwrap();
/// let triangle = [line(DVec3::ZERO, DVec3::X), line(DVec3::X, DVec3::Y), line(DVec3::Y, DVec3::ZERO)];
/// let angles = turning_angles(&triangle);
/// assert!((angles[0] - 0.75 * std::f64::consts::PI).abs() < 1e-15);
/// ```
pub fn turning_angles(ribbons: &[Ribbon]) -> Vec<f64> {
    let n = ribbons.len();
    (0..n).map(|i| turning_angle(&ribbons[i], &ribbons[(i + 1) % n])).collect()
}

fn turning_angle(side: &Ribbon, next: &Ribbon) -> f64 {
    let (arriving, leaving) = (end_tangent(side), start_tangent(next));
    let angle = arriving.cross(leaving).length().atan2(arriving.dot(leaving));
    let cross = |ribbon: &Ribbon, j: usize| ribbon.point(j, 1).and_then(|p| Some(p - ribbon.point(j, 0)?));
    let concave = match (cross(next, 0), cross(side, side.degree())) {
        (Some(direction), _) => arriving.dot(direction) > 0.0,
        (None, Some(direction)) => leaving.dot(direction) < 0.0,
        (None, None) => false,
    };
    if concave { -angle } else { angle }
}

/// Unit tangent at the end of a side; zero for a side without length.
pub(crate) fn end_tangent(ribbon: &Ribbon) -> DVec3 {
    ribbon.row(0).iter().rev().find_map(|&p| unit(ribbon.end() - p)).unwrap_or(DVec3::ZERO)
}

/// Unit tangent at the start of a side; zero for a side without length.
pub(crate) fn start_tangent(ribbon: &Ribbon) -> DVec3 {
    ribbon.row(0).iter().find_map(|&p| unit(p - ribbon.start())).unwrap_or(DVec3::ZERO)
}

/// The polygon of that kind, and whether it comes from a repair.
pub(crate) fn lay_out(ribbons: &[Ribbon], kind: LayoutKind) -> Result<Layout, GbError> {
    let options = LayoutOptions::default();
    let turning = turning_angles(ribbons);
    match kind {
        LayoutKind::Heuristic => {
            let length = |r: &Ribbon| Ok(Curve::new(r.row(0).to_vec())?.arc_length(ARC_LENGTH_ACCURACY)?);
            let lengths: Vec<f64> = ribbons.iter().map(length).collect::<Result<_, GbError>>()?;
            Ok(layout::heuristic(&lengths, &turning, &options)?)
        }
        _ => {
            let corners: Vec<DVec3> = ribbons.iter().map(Ribbon::end).collect();
            let concave: Vec<bool> = turning.iter().map(|&angle| angle < 0.0).collect();
            let plain = layout::projection(&corners, None, &options)?;
            let agrees = turning
                .iter()
                .zip(&plain.concave)
                .all(|(&angle, &projected)| (angle < 0.0) == projected || angle.abs() < NEARLY_STRAIGHT);
            if agrees && !plain.repaired {
                return Ok(plain);
            }
            Ok(layout::projection(&corners, Some(&concave), &options)?)
        }
    }
}
