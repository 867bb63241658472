//! Newton's method for `φ = ½|S − q|²` on `[0, 1]ᴰ`, kept inside and kept from climbing.

use casteljau_geom::UNIT_ROUNDOFF;
use casteljau_geom::glam::DVec3;

use super::net::{LocalJet, LocalNet};

/// Iterations allowed; from a good start three or four are used.
const MOST_STEPS: usize = 100;
/// Steps below this are the last: the next one would be at most their square, or rounding.
const LAST_STEP: f64 = 1e-9;
/// Halvings of a step that does not descend.
const MOST_HALVINGS: usize = 12;

/// A place where Newton's method stopped.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stationary<const D: usize> {
    pub at: [f64; D],
    /// φ there.
    pub phi: f64,
    /// |S − q| and the gradient by the parameters of `[0, 1]`.
    pub distance: f64,
    pub gradient: [f64; D],
    /// Length of each S_k.
    pub speed: [f64; D],
    /// Whether the last step was below what the next one could improve, with a convex model.
    pub converged: bool,
}

/// φ with its derivatives at one place.
struct Local<const D: usize> {
    phi: f64,
    gradient: [f64; D],
    hessian: [[f64; D]; D],
    jet: LocalJet,
}

impl<const D: usize> Local<D> {
    #[inline]
    fn new(net: &LocalNet, q: DVec3, at: [f64; D]) -> Self {
        let mut place = [0.0; 2];
        place[..D].copy_from_slice(&at);
        let jet = net.jet(place);
        let d = jet.point - q;
        Self {
            phi: 0.5 * d.length_squared(),
            gradient: std::array::from_fn(|k| d.dot(jet.first[k])),
            hessian: std::array::from_fn(|k| {
                std::array::from_fn(|l| jet.first[k].dot(jet.first[l]) + d.dot(jet.second[k + l]))
            }),
            jet,
        }
    }

    fn stationary(&self, at: [f64; D], converged: bool) -> Stationary<D> {
        let speed = std::array::from_fn(|k| self.jet.first[k].length());
        let distance = (2.0 * self.phi).sqrt();
        Stationary { at, phi: self.phi, distance, gradient: self.gradient, speed, converged }
    }
}

/// φ and its gradient at a place, without any step.
pub(super) fn evaluate<const D: usize>(net: &LocalNet, q: DVec3, at: [f64; D]) -> Stationary<D> {
    Local::new(net, q, at).stationary(at, false)
}

/// Descends from `start` to a minimum of φ over `[0, 1]ᴰ`.
///
/// Where the Hessian is not positive on the free directions the Gauss–Newton matrix stands in for it; where
/// that is singular too, the steepest descent by axes. Steps are cut off at the sides of the box and halved
/// until φ falls.
pub(super) fn descend<const D: usize>(net: &LocalNet, q: DVec3, start: [f64; D]) -> Stationary<D> {
    let mut at = start.map(|x| x.clamp(0.0, 1.0));
    let mut here = Local::new(net, q, at);
    let mut previous = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let (step, newton) = step(&here, at);
        let length = step.iter().fold(0.0, |m: f64, s| m.max(s.abs()));
        if length == 0.0 {
            return here.stationary(at, newton);
        }
        // Close to the minimum φ cannot tell places apart that the gradient can: it may then stay level.
        let level = if newton && length < 1e-4 {
            8.0 * UNIT_ROUNDOFF * here.phi + net.rounding() * net.rounding()
        } else {
            0.0
        };
        if newton && length <= LAST_STEP && length >= 0.5 * previous {
            return here.stationary(at, true);
        }
        let mut share = 1.0;
        let mut moved = None;
        for _ in 0..MOST_HALVINGS {
            let next: [f64; D] = std::array::from_fn(|k| (at[k] + share * step[k]).clamp(0.0, 1.0));
            let there = Local::new(net, q, next);
            if there.phi < here.phi + level || next == at {
                moved = Some((next, there));
                break;
            }
            share *= 0.5;
        }
        let Some((next, there)) = moved else {
            return here.stationary(at, newton && length < LAST_STEP);
        };
        (at, here) = (next, there);
        if newton && length <= LAST_STEP && share == 1.0 {
            return here.stationary(at, true);
        }
        previous = length;
    }
    here.stationary(at, false)
}

/// The step to take, cut off at the box, and whether it is Newton's own.
fn step<const D: usize>(here: &Local<D>, at: [f64; D]) -> ([f64; D], bool) {
    let held: [bool; D] = std::array::from_fn(|k| {
        (at[k] <= 0.0 && here.gradient[k] >= 0.0) || (at[k] >= 1.0 && here.gradient[k] <= 0.0)
    });
    let metric: [[f64; D]; D] =
        std::array::from_fn(|k| std::array::from_fn(|l| here.jet.first[k].dot(here.jet.first[l])));
    let (mut step, newton) = match solve(&here.hessian, here.gradient, held) {
        Some(step) => (step, true),
        None => match solve(&metric, here.gradient, held) {
            Some(step) => (step, false),
            None => {
                let steepest = std::array::from_fn(|k| {
                    let size = here.hessian[k][k].abs().max(metric[k][k]);
                    if held[k] || size == 0.0 { 0.0 } else { -here.gradient[k] / size }
                });
                (steepest, false)
            }
        },
    };
    // A step that crosses a side is done again along the side, so that it ends at the least of the model.
    for k in 0..D {
        let end = at[k] + step[k];
        if !held[k] && !(0.0..=1.0).contains(&end) {
            let cut = end.clamp(0.0, 1.0) - at[k];
            let mut rest = held;
            rest[k] = true;
            let gradient = std::array::from_fn(|l| here.gradient[l] + here.hessian[l][k] * cut);
            let again = solve(&here.hessian, gradient, rest).unwrap_or(step);
            step = std::array::from_fn(|l| if l == k { cut } else { again[l] });
        }
    }
    (std::array::from_fn(|k| (at[k] + step[k]).clamp(0.0, 1.0) - at[k]), newton)
}

/// `−M⁻¹ g` on the coordinates that are not held, 0 on the others; `None` unless M is safely positive there.
fn solve<const D: usize>(m: &[[f64; D]; D], g: [f64; D], held: [bool; D]) -> Option<[f64; D]> {
    const SINGULAR: f64 = 64.0 * UNIT_ROUNDOFF;
    let mut step = [0.0; D];
    if D == 2 && !held[0] && !held[1] {
        let product = m[0][0] * m[1][1];
        let determinant = product - m[0][1] * m[1][0];
        if !(m[0][0] > 0.0 && determinant > SINGULAR * product) {
            return None;
        }
        step[0] = (m[0][1] * g[1] - m[1][1] * g[0]) / determinant;
        step[1] = (m[1][0] * g[0] - m[0][0] * g[1]) / determinant;
    } else {
        for k in 0..D {
            if !held[k] {
                if m[k][k] <= 0.0 {
                    return None;
                }
                step[k] = -g[k] / m[k][k];
            }
        }
    }
    step.iter().all(|s| s.is_finite()).then_some(step)
}
