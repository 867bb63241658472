//! The repair: a finite list of candidates that ends with a polygon that always passes.
//!
//! 1. The pattern: a corner is concave when its turning angle is below −[`STRAIGHT`]; see [`Layout::concave`]
//!    for fewer than three convex corners.
//! 2. Wanted angles: the interior angle, less π at a concave corner, is a fraction r of π. It becomes
//!    σ(σ⁻¹(r) + s), σ the logistic function, with the one s for which the interior angles sum to (n−2)π. It
//!    exists since the sum grows with s from cπ to (n+c)π for c ≤ n−3 concave corners. No corner changes its
//!    kind.
//! 3. For b = 0, 1/16, …, 15/16: the angles of 2 and the logarithms of the lengths, blended by b with those
//!    of the star. The outline is closed by giving side j, of direction dⱼ, the length ℓⱼ·exp(a·dⱼ), where a
//!    minimises the convex function Σ ℓⱼ exp(a·dⱼ): the gradient is the closing gap. The angles stay as they
//!    are. The minimum exists since steps of less than π that add up to one turn leave no half-plane without
//!    directions. The first outline that passes is taken. (A convex pattern passes the test for simplicity at
//!    once.)
//! 4. The star itself.

use std::f64::consts::PI;

use casteljau_geom::glam::{DMat2, DVec2};

use super::heuristic::{directions, drawn};
use super::star::star;
use super::{Layout, STRAIGHT, accept, normalised};
use crate::{DomainError, Polygon};

/// Steps from the wanted shape to the star.
const STEPS: usize = 16;

/// Fractions of π are kept away from 0 and 1 by this, so that one cusp or straight corner does not govern the
/// rest.
const LEAST_FRACTION: f64 = 0.02;

/// Limit for Newton's method: lengths may differ by a factor of e to this power.
const NEWTON_STEPS: usize = 100;

/// Newton's method ends with a step no longer than this; the lengths are then right to its square.
const NEWTON_END: f64 = 1e-9;

/// A layout that keeps the promises of the module for any positive lengths and any turning angles.
///
/// An error stands for a star that is no polygon, which `star.rs` excludes.
pub(super) fn repair(wanted: &Shape, required: f64) -> Result<Layout, DomainError> {
    let concave = pattern(&wanted.turning);
    let star = star(&concave);
    let far = Shape::of(&star);
    let near = Shape { turning: tamed(&wanted.turning, &concave), log_lengths: wanted.log_lengths.clone() };
    for step in 0..STEPS {
        let blend = step as f64 / STEPS as f64;
        let outline = near.blended(&far, blend).outline();
        if let Some(layout) = outline.and_then(|outline| accept(&outline, &concave, required)) {
            return Ok(Layout { repaired: true, blend, ..layout });
        }
    }
    let polygon = Polygon::new(normalised(&star))?;
    let clearance = polygon.clearance() / polygon.diameter();
    Ok(Layout { polygon, concave, clearance, repaired: true, blend: 1.0 })
}

/// Which corners are to be concave.
fn pattern(turning: &[f64]) -> Vec<bool> {
    let mut sorted = turning.to_vec();
    sorted.sort_by(|a, b| b.total_cmp(a));
    // Where there are too few, equal angles go together, also those of congruent corners that rounding made
    // differ.
    let bound = if sorted[2] < -STRAIGHT { sorted[2] - STRAIGHT } else { -STRAIGHT };
    turning.iter().map(|&a| a < bound).collect()
}

/// Turning angles of the wanted kind at every corner that sum to 2π.
fn tamed(turning: &[f64], concave: &[bool]) -> Vec<f64> {
    let offset = |concave: bool| if concave { PI } else { 0.0 };
    let logit = |(a, &c): (&f64, &bool)| {
        let fraction = ((PI - a - offset(c)) / PI).clamp(LEAST_FRACTION, 1.0 - LEAST_FRACTION);
        (fraction / (1.0 - fraction)).ln()
    };
    let logits: Vec<f64> = turning.iter().zip(concave).map(logit).collect();
    let logistic = |x: f64| 1.0 / (1.0 + (-x).exp());
    let fractions = |shift: f64| logits.iter().map(move |x| logistic(x + shift));
    let wanted = turning.len() as f64 - 2.0 - concave.iter().filter(|c| **c).count() as f64;
    // Beyond ±60 all fractions are 0 or 1 to rounding, and 70 halvings exhaust an f64.
    let (mut low, mut high) = (-60.0, 60.0);
    for _ in 0..70 {
        let shift = 0.5 * (low + high);
        if fractions(shift).sum::<f64>() < wanted { low = shift } else { high = shift }
    }
    fractions(0.5 * (low + high)).zip(concave).map(|(f, &c)| PI - PI * f - offset(c)).collect()
}

/// An outline up to motion and scale: the turning angle at the end of each side, the logarithm of its length.
pub(super) struct Shape {
    pub turning: Vec<f64>,
    pub log_lengths: Vec<f64>,
}

impl Shape {
    pub(super) fn of(vertices: &[DVec2]) -> Self {
        let n = vertices.len();
        let side = |i: usize| vertices[i % n] - vertices[(i + n - 1) % n];
        // Not by glam's angle_to, whose arc cosine loses half the digits of small angles.
        let angle = |a: DVec2, b: DVec2| a.perp_dot(b).atan2(a.dot(b));
        let turning = (0..n).map(|i| angle(side(i), side(i + 1))).collect();
        Self { turning, log_lengths: (0..n).map(|i| side(i).length().ln()).collect() }
    }

    /// As [`Shape::of`], with the corners convex and concave as they are known to be: near ±π rounding decides the sign.
    pub(super) fn of_kinds(vertices: &[DVec2], concave: &[bool]) -> Self {
        let mut shape = Self::of(vertices);
        for (turning, &concave) in shape.turning.iter_mut().zip(concave) {
            if concave {
                *turning = -turning.abs().max(2.0 * STRAIGHT);
            } else if *turning < -STRAIGHT {
                *turning = -*turning;
            }
        }
        shape
    }

    fn blended(&self, other: &Self, blend: f64) -> Self {
        let mix =
            |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (1.0 - blend) * a + blend * b).collect();
        Self {
            turning: mix(&self.turning, &other.turning),
            log_lengths: mix(&self.log_lengths, &other.log_lengths),
        }
    }

    /// Vertices of the closed outline of these angles, its lengths changed as step 3 says.
    ///
    /// Newton's method on a convex function, with steps of at most 1, which change no length by more than a
    /// factor e. `None` if it has not converged. What gap rounding leaves is distributed.
    fn outline(&self) -> Option<Vec<DVec2>> {
        let directions: Vec<DVec2> = directions(&self.turning).collect();
        let mut a = DVec2::ZERO;
        let mut converged = false;
        for _ in 0..NEWTON_STEPS {
            let exponents: Vec<f64> =
                self.log_lengths.iter().zip(&directions).map(|(l, d)| l + a.dot(*d)).collect();
            let largest = exponents.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let lengths: Vec<f64> = exponents.iter().map(|e| (e - largest).exp()).collect();
            if converged {
                return drawn(&lengths, &self.turning);
            }
            let (mut gap, mut hessian) = (DVec2::ZERO, DMat2::ZERO);
            for (&length, &d) in lengths.iter().zip(&directions) {
                gap += d * length;
                hessian += DMat2::from_cols(d * d.x, d * d.y) * length;
            }
            let step = hessian.inverse() * gap;
            if !step.is_finite() {
                return None;
            }
            a -= step.clamp_length_max(1.0);
            converged = step.length() <= NEWTON_END;
        }
        None
    }
}
