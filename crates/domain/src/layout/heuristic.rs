//! The layout from arc lengths and turning angles.

use std::f64::consts::PI;

use casteljau_geom::glam::DVec2;

use super::repair::{Shape, repair};
use super::{Layout, LayoutOptions, STRAIGHT, accept, required_clearance};
use crate::DomainError;

/// Layout from the arc lengths ℓᵢ of the sides and the turning angles αᵢ at their ends.
///
/// The interior angles π − αᵢ are scaled to sum to (n−2)π. From the origin and along +u side after side is
/// drawn with its length; where the last one misses the origin by g, vertex i moves by −g·(ℓ₀+…+ℓᵢ)/Σℓ. If
/// |g| > ½Σℓ, or if that gives no valid polygon, the repair does: see the [module](super), which also says
/// what is promised.
///
/// `lengths[i]` belongs to side i, in any unit: only ratios count. `turning[i]`, in radians within [−π, π],
/// belongs to vertex i, where side i meets side i+1: the angle between the tangents, positive at a convex
/// corner, negative at a concave one, that is where the end tangent of side i points along the cross
/// direction of ribbon i+1. Angles above −[`STRAIGHT`] are convex.
///
/// Error: fewer than three sides, lists of different length, a length that is not positive and finite, an
/// angle out of range, an option out of range. Cost: O(n²) for the test of the outline, at most 20 times that
/// for a repair.
///
/// Source: Salvi and Várady, *Multi-sided Bézier surfaces over concave polygonal domains*, 2018; the repair
/// is ours.
///
/// ```
/// use casteljau_domain::layout::{self, LayoutOptions};
/// let quarter = std::f64::consts::FRAC_PI_2;
/// let rectangle = layout::heuristic(&[2.0, 1.0, 2.0, 1.0], &[quarter; 4], &LayoutOptions::default())?;
/// assert!(!rectangle.repaired && (rectangle.polygon.side_length(0) / rectangle.polygon.side_length(1) - 2.0).abs() < 1e-15);
/// # Ok::<(), casteljau_domain::DomainError>(())
/// ```
pub fn heuristic(lengths: &[f64], turning: &[f64], options: &LayoutOptions) -> Result<Layout, DomainError> {
    options.check()?;
    let n = lengths.len();
    if n < 3 {
        return Err(DomainError::TooFewSides { count: n });
    }
    if turning.len() != n {
        return Err(DomainError::CountMismatch { what: "turning angles", given: turning.len(), wanted: n });
    }
    if let Some((side, &length)) = lengths.iter().enumerate().find(|(_, l)| !(**l > 0.0 && l.is_finite())) {
        return Err(DomainError::BadLength { side, length });
    }
    if let Some((corner, &angle)) = turning.iter().enumerate().find(|(_, a)| !(-PI..=PI).contains(*a)) {
        return Err(DomainError::BadAngle { corner, angle });
    }
    let concave: Vec<bool> = turning.iter().map(|&a| a < -STRAIGHT).collect();
    let required = required_clearance(n, options);
    let largest = lengths.iter().copied().fold(0.0, f64::max);
    let relative: Vec<f64> = lengths.iter().map(|l| l / largest).collect();
    match drawn(&relative, &scaled(turning)).and_then(|outline| accept(&outline, &concave, required)) {
        Some(layout) => Ok(layout),
        None => {
            let log_lengths = lengths.iter().map(|l| l.ln()).collect();
            repair(&Shape { turning: turning.to_vec(), log_lengths }, required)
        }
    }
}

/// Turning angles for interior angles that sum to (n−2)π; NaN when all interior angles are 0.
fn scaled(turning: &[f64]) -> Vec<f64> {
    let interior: f64 = turning.iter().map(|a| PI - a).sum();
    let factor = (turning.len() as f64 - 2.0) * PI / interior;
    turning.iter().map(|a| PI - (PI - a) * factor).collect()
}

/// Largest closing gap, in units of the sum of the lengths, that is distributed: each side keeps at least
/// half its length. Beyond it the outline says more about the gap than about the sides, and is lost in
/// rounding in the end.
const LARGEST_GAP: f64 = 0.5;

/// Ends of the sides drawn from the origin along +u, closed in proportion to the accumulated length; `None`
/// if the gap is larger than [`LARGEST_GAP`].
pub(super) fn drawn(lengths: &[f64], turning: &[f64]) -> Option<Vec<DVec2>> {
    let sides: Vec<DVec2> = lengths.iter().zip(directions(turning)).map(|(l, d)| d * *l).collect();
    let share = sides.iter().sum::<DVec2>() / lengths.iter().sum::<f64>();
    if share.is_nan() || share.length() > LARGEST_GAP {
        return None;
    }
    let mut at = DVec2::ZERO;
    let step = |(side, length): (&DVec2, &f64)| {
        at += *side - share * *length;
        at
    };
    Some(sides.iter().zip(lengths).map(step).collect())
}

/// Unit direction of each side, the first along +u.
pub(super) fn directions(turning: &[f64]) -> impl Iterator<Item = DVec2> {
    let before = |angle: &mut f64, turn: &f64| {
        let direction = DVec2::from_angle(*angle);
        *angle += turn;
        Some(direction)
    };
    turning.iter().scan(0.0, before)
}
