//! The layout by projection on the best plane of the corners.

use std::f64::consts::PI;

use casteljau_geom::glam::{DVec2, DVec3, dvec2};
use faer::Mat;

use super::repair::{Shape, repair};
use super::{Layout, LayoutOptions, STRAIGHT, accept, normalised, required_clearance};
use crate::{DomainError, Orientation, Polygon};

/// Principal values of the corners that differ by less than this part of the largest count as equal.
pub const DISTINCT: f64 = 1e-3;

/// Layout by projection on the best plane of the corners.
///
/// The plane passes through the mean of the corners and is spanned by the first two principal directions,
/// those of the largest eigenvalues λ₁ ≥ λ₂ ≥ λ₃ of the covariance; the coordinates are those along these
/// directions, the second one reversed where that is needed to make the polygon counter-clockwise.
///
/// `corners[i]` ends side i. `concave` says which corners are to be concave, if the caller knows; corners
/// nearer to straight than [`STRAIGHT`] count as convex. Without it they are concave where the projection is.
///
/// *Ties.* Where λ₂ and λ₃ differ by less than [`DISTINCT`]·λ₁ the plane is not well defined by them: then it
/// is the one that contains the first direction and on which the loop has the largest area, or if λ₁ is as
/// close too, simply the plane on which the loop has the largest area. Where λ₁ and λ₂ are close but λ₃ is
/// not, the plane is well defined, and u points to the corner farthest from the mean (the first of these;
/// another choice would turn the polygon).
///
/// *Repair.* If the projection is no valid polygon in the sense of the [module](super) the plane of the
/// largest area is tried, then the repair of the heuristic. It starts from the angles and lengths of a
/// projection that is too narrow but otherwise as wanted; without one, from the chords in space and the
/// angles between them, concave where `concave` says so or, without it, where they turn against the loop's
/// area vector.
///
/// Error: fewer than three corners, a corner that is not finite, equal successive corners, a list of the
/// wrong length, an option out of range. Cost: O(n²) for the test of the outline, at most 20 times that for a
/// repair.
///
/// ```
/// use casteljau_domain::{glam::dvec3, layout::{self, LayoutOptions}};
/// let corners = [dvec3(0., 0., 5.), dvec3(3., 0., 5.), dvec3(3., 1., 5.), dvec3(0., 1., 5.)];
/// let rectangle = layout::projection(&corners, None, &LayoutOptions::default())?;
/// assert!((rectangle.polygon.side_length(1) / rectangle.polygon.side_length(0) - 3.0).abs() < 1e-14);
/// # Ok::<(), casteljau_domain::DomainError>(())
/// ```
pub fn projection(
    corners: &[DVec3],
    concave: Option<&[bool]>,
    options: &LayoutOptions,
) -> Result<Layout, DomainError> {
    options.check()?;
    check(corners, concave)?;
    let required = required_clearance(corners.len(), options);
    let points = centred(corners);
    let area = area_vector(&points);
    let mut wanted = concave.map(<[bool]>::to_vec);
    let mut near = None;
    for (attempt, plane) in
        [Plane::best(&points, area), Plane::of_largest_area(&points, area)].iter().enumerate()
    {
        let outline = plane.project(&points);
        let found = concave_corners(&outline);
        wanted = wanted.or_else(|| found.clone());
        let Some(kinds) = wanted.as_deref().filter(|w| found.as_deref() == Some(w)) else { continue };
        if let Some(layout) = accept(&outline, kinds, required) {
            return Ok(Layout { repaired: attempt > 0, ..layout });
        }
        near.get_or_insert_with(|| Shape::of_kinds(&outline, kinds));
    }
    repair(&near.unwrap_or_else(|| chords(&points, area, concave)), required)
}

fn check(corners: &[DVec3], concave: Option<&[bool]>) -> Result<(), DomainError> {
    let n = corners.len();
    if n < 3 {
        return Err(DomainError::TooFewSides { count: n });
    }
    if let Some(flags) = concave.filter(|flags| flags.len() != n) {
        return Err(DomainError::CountMismatch { what: "concavity flags", given: flags.len(), wanted: n });
    }
    if let Some(corner) = corners.iter().position(|p| !p.is_finite()) {
        return Err(DomainError::NotFinite { corner, position: corners[corner].into() });
    }
    match (0..n).find(|&i| corners[i] == corners[(i + n - 1) % n]) {
        Some(side) => Err(DomainError::ZeroSide { side, position: corners[side].into() }),
        None => Ok(()),
    }
}

/// The corners about their mean, the farthest at distance 1. Scaled twice so that no size overflows.
fn centred(corners: &[DVec3]) -> Vec<DVec3> {
    let largest = corners.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
    let scaled: Vec<DVec3> = corners.iter().map(|p| *p / largest).collect();
    let mean = scaled[0] + scaled.iter().map(|p| *p - scaled[0]).sum::<DVec3>() / scaled.len() as f64;
    let radius = scaled.iter().map(|p| p.distance(mean)).fold(0.0, f64::max);
    scaled.iter().map(|p| (*p - mean) / radius).collect()
}

/// ½ Σ pᵢ₋₁ × pᵢ, whose component along a plane's normal is the signed area of the projection on it.
fn area_vector(points: &[DVec3]) -> DVec3 {
    let before = points.iter().cycle().skip(points.len() - 1);
    before.zip(points).map(|(a, b)| a.cross(*b)).sum::<DVec3>() * 0.5
}

/// Corners of interior angle above π, if the outline is a simple counter-clockwise polygon.
fn concave_corners(outline: &[DVec2]) -> Option<Vec<bool>> {
    let polygon = Polygon::new(normalised(outline)).ok()?;
    let concave = (0..polygon.len()).map(|i| polygon.interior_angle(i) >= PI + STRAIGHT).collect();
    (polygon.orientation() == Orientation::CounterClockwise).then_some(concave)
}

/// The polygon of the chords, unrolled: its lengths and the angles between them in space.
fn chords(points: &[DVec3], area: DVec3, concave: Option<&[bool]>) -> Shape {
    let n = points.len();
    let chord = |i: usize| points[i % n] - points[(i + n - 1) % n];
    let normal = area.normalize_or_zero();
    let turning = |i: usize| {
        let (a, b) = (chord(i), chord(i + 1));
        let angle = a.cross(b).length().atan2(a.dot(b));
        let right = |normal: DVec3| normal.dot(a.cross(b)) < -STRAIGHT * a.length() * b.length();
        // A corner that must be concave is, however straight its chords are.
        if concave.map_or_else(|| right(normal), |flags| flags[i]) {
            -angle.max(2.0 * STRAIGHT)
        } else {
            angle
        }
    };
    Shape {
        turning: (0..n).map(turning).collect(),
        log_lengths: (0..n).map(|i| chord(i).length().ln()).collect(),
    }
}

/// A plane through the origin, by an orthonormal basis.
struct Plane {
    u: DVec3,
    v: DVec3,
}

impl Plane {
    /// The plane of the first two principal directions, with the ties of [`projection`].
    fn best(points: &[DVec3], area: DVec3) -> Self {
        // The singular values of the points, not the eigenvalues of their covariance: half the digits are
        // lost there.
        let matrix = Mat::from_fn(points.len(), 3, |i, j| points[i][j]);
        let Ok(svd) = matrix.thin_svd() else {
            return Self::of_largest_area(points, area);
        };
        let value = |i: usize| svd.S()[i] * svd.S()[i];
        let direction = |i: usize| DVec3::new(svd.V()[(0, i)], svd.V()[(1, i)], svd.V()[(2, i)]);
        let close = |i: usize| value(i) - value(i + 1) <= DISTINCT * value(0);
        let u = direction(0);
        match (close(0), close(1)) {
            (false, false) => Self { u, v: direction(1) },
            (true, false) => Self::with_normal(direction(2), points),
            (false, true) => {
                let normal = (area - u * area.dot(u)).try_normalize();
                Self { u, v: normal.map_or(direction(1), |normal| normal.cross(u)) }
            }
            (true, true) => Self::of_largest_area(points, area),
        }
    }

    /// The plane on which the loop has the largest area; any plane if that is zero.
    fn of_largest_area(points: &[DVec3], area: DVec3) -> Self {
        Self::with_normal(area.try_normalize().unwrap_or(DVec3::Z), points)
    }

    /// The plane of this unit normal, u toward the point that is farthest from the origin in it.
    fn with_normal(normal: DVec3, points: &[DVec3]) -> Self {
        let within = points.iter().map(|p| p.reject_from_normalized(normal));
        let farthest = within
            .fold(DVec3::ZERO, |far, p| if p.length_squared() > far.length_squared() { p } else { far });
        let u = farthest.try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
        Self { u, v: normal.cross(u) }
    }

    /// Coordinates in the plane, as a counter-clockwise outline: its senses of u and v are these.
    ///
    /// The point with the largest |u| has a positive one (the first of several), and v is reversed where the
    /// area says so.
    fn project(&self, points: &[DVec3]) -> Vec<DVec2> {
        let flat: Vec<DVec2> = points.iter().map(|p| dvec2(p.dot(self.u), p.dot(self.v))).collect();
        let farthest = flat.iter().fold(0.0, |far: f64, p| if p.x.abs() > far.abs() { p.x } else { far });
        let before = flat.iter().cycle().skip(flat.len() - 1);
        let area: f64 = before.zip(&flat).map(|(a, b)| a.perp_dot(*b)).sum();
        // Reversing u reverses the area as well.
        let u = if farthest < 0.0 { -1.0 } else { 1.0 };
        let v = if area * u < 0.0 { -1.0 } else { 1.0 };
        flat.iter().map(|p| dvec2(u * p.x, v * p.y)).collect()
    }
}
