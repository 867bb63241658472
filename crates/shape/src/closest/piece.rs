//! Pieces of a shape with bounds on all of their second derivatives, and what these say about a query.
//!
//! A piece lives on local parameters `x ∈ [−1, 1]ᴰ` (D = 1 for curves, 2 for patches) and is described by its
//! jet at the middle and by the radii of balls around the middle's second derivatives that hold those of the
//! whole piece. For a query q, half the squared distance `φ(x) = ½|S(x) − q|²` has
//!
//! ```text
//! φ_k = (S − q)·S_k,   φ_kl = S_k·S_l + (S − q)·S_kl,   |φ_kl(x) − φ_kl(0)| ≤ Δ_kl = |S(0) − q| τ_kl + κ_kl,
//! ```
//!
//! where τ and κ do not depend on q. So a few scalar products bound φ, its gradient and its Hessian over the
//! piece: whether it can hold a critical point, whether φ is convex there, and how small φ can be.
//!
//! Rational shapes need positive weights on the piece. The bounds come from the hull property of quotients:
//! `|Σ Bᵢ Nᵢ / Σ Bᵢ wᵢ| ≤ max |Nᵢ|/wᵢ`.

use casteljau_geom::UNIT_ROUNDOFF;
use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};

use super::net::{derivative_net, homogeneous_jet};

/// The jet of a piece at its middle, and what bounds its change.
#[derive(Debug, Clone)]
pub(super) struct Piece<const D: usize> {
    /// S(0)
    pub center: DVec3,
    /// S_k(0)
    pub first: [DVec3; D],
    /// S_kl(0)
    second: [[DVec3; D]; D],
    /// S_k(0)·S_l(0)
    metric: [[f64; D]; D],
    /// |S − S(0)|, at most.
    radius: f64,
    /// τ: |S_kl − S_kl(0)|, at most.
    variation: [[f64; D]; D],
    /// What rounding contributes to τ, at most.
    noise: f64,
    /// κ: |S_k·S_l − S_k(0)·S_l(0)| + |(S − S(0))·S_kl|, at most.
    constant: [[f64; D]; D],
}

/// What is known of φ over a piece.
#[derive(Debug, Clone, Copy)]
pub(super) struct Assessment<const D: usize> {
    /// φ is nowhere smaller.
    pub lower: f64,
    /// φ in the middle.
    pub middle: f64,
    /// There is no minimum but on the sides of `[0, 1]ᴰ`: a component of the gradient keeps its sign, or the
    /// Hessian is nowhere positive semidefinite.
    pub barren: bool,
    /// φ is strictly convex: its Hessian is above the diagonal matrix of these positive numbers.
    pub convex: Option<[f64; D]>,
    /// The most that each component of the gradient can change away from the middle.
    pub spread: [f64; D],
    /// Where the quadratic model is least along each axis.
    pub start: [f64; D],
}

/// Nets that [`Piece::new`] works in.
#[derive(Debug, Default)]
pub(super) struct PieceScratch {
    shifted: Vec<DVec4>,
    first: [Vec<DVec4>; 2],
    second: Vec<DVec4>,
}

impl<const D: usize> Piece<D> {
    /// The piece with a homogeneous net of its own; `None` unless all weights are positive.
    ///
    /// `rounding` bounds the error of the net's Euclidean points; it goes into every bound.
    /// Cost: some 30 operations a control point, component and order.
    pub fn new(
        net: &[DVec4],
        degrees: [usize; 2],
        rounding: f64,
        scratch: &mut PieceScratch,
    ) -> Option<Self> {
        let (least, largest) =
            net.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), p| (a.min(p.w), b.max(p.w)));
        if least <= 0.0 {
            return None;
        }
        // Differences of points of unlike weight are rounded on the scale of the larger one.
        let rounding = rounding * (largest / least);
        let factor = |k: usize| degrees[k].max(1) as f64;
        let jet = homogeneous_jet(net, degrees, [0.5, 0.5]);
        let w = jet[0].w;
        let center = jet[0].xyz() / w;
        let slope = |k: usize| 0.5 * jet[1 + k];
        let first: [DVec3; D] = std::array::from_fn(|k| (slope(k).xyz() - center * slope(k).w) / w);
        let second: [[DVec3; D]; D] = std::array::from_fn(|k| {
            std::array::from_fn(|l| {
                let bend = 0.25 * jet[3 + k + l];
                let carried = first[k] * slope(l).w + first[l] * slope(k).w + center * bend.w;
                (bend.xyz() - carried) / w
            })
        });

        scratch.shifted.clear();
        scratch.shifted.extend(net.iter().map(|p| (p.xyz() - center * p.w).extend(p.w)));
        let shifted = &scratch.shifted;
        // With one weight for all the bounds have one term, and one root does for all of them.
        let polynomial = least == largest;
        let length = |v: DVec3| if polynomial { v.length_squared() } else { v.length() };
        let largest_quotient = |numerator: &dyn Fn(usize) -> f64| {
            let most = (0..shifted.len()).map(|i| numerator(i) / shifted[i].w).fold(0.0, f64::max);
            if polynomial { (most / least).sqrt() } else { most }
        };
        let radius = rounding + largest_quotient(&|i| length(shifted[i].xyz()));
        let mut speed = [0.0; D];
        for k in 0..D {
            let slopes = &mut scratch.first[k];
            derivative_net(shifted, degrees, k, slopes);
            speed[k] = rounding * factor(k)
                + largest_quotient(&|i| {
                    let (p, s) = (shifted[i], slopes[i]);
                    length(s.xyz() - first[k] * p.w) + radius * s.w.abs()
                });
        }
        let mut variation = [[0.0; D]; D];
        for k in 0..D {
            for l in k..D {
                derivative_net(&scratch.first[k], degrees, l, &mut scratch.second);
                let (along, across, bends) = (&scratch.first[k], &scratch.first[l], &scratch.second);
                let bound = largest_quotient(&|i| {
                    let (wk, wl, bend) = (along[i].w, across[i].w, bends[i]);
                    let rest = bend.xyz() - second[k][l] * shifted[i].w - first[k] * wl - first[l] * wk;
                    length(rest) + speed[k] * wl.abs() + speed[l] * wk.abs() + radius * bend.w.abs()
                });
                variation[k][l] = rounding * factor(k) * factor(l) + bound;
                variation[l][k] = variation[k][l];
            }
        }
        let noise = rounding * (0..D).map(factor).fold(1.0, f64::max).powi(2);
        let metric = first.map(|a| first.map(|b| a.dot(b)));
        let mut constant = variation;
        for k in 0..D {
            for l in 0..D {
                constant[k][l] = first[k].length() * speed[l]
                    + first[l].length() * speed[k]
                    + speed[k] * speed[l]
                    + radius * (second[k][l].length() + variation[k][l]);
            }
        }
        let piece = Self { center, first, second, metric, radius, variation, noise, constant };
        piece.center.is_finite().then_some(piece)
    }

    /// Whether rounding makes up much of what is known of the gradient's change along an axis: cutting the
    /// piece would not tell more.
    pub fn is_rounded(&self, q: DVec3, spread: f64) -> bool {
        2.0 * self.noise * (self.center.distance(q) + self.radius) >= spread
    }

    /// A bound of |S − S(0)|.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// How far the piece is from affine, as a length, by axis: what decides where a tree is refined.
    pub fn nonlinearity(&self) -> [f64; D] {
        std::array::from_fn(|k| {
            let bend: f64 = (0..D).map(|l| self.second[k][l].length() + self.variation[k][l]).sum();
            bend * if bend > 0.0 { (bend / (bend + self.first[k].length())).sqrt() } else { 0.0 }
        })
    }

    /// What is known of φ for the query `q` when values of at least `enough` are of no interest.
    ///
    /// Where even the ball around the piece is too far away the rest is not looked at.
    #[inline]
    pub fn assess(&self, q: DVec3, enough: f64) -> Assessment<D> {
        let d = self.center - q;
        let square = d.length_squared();
        let distance = square.sqrt();
        let away = (distance - self.radius).max(0.0);
        let middle = 0.5 * square;
        let ball = 0.5 * away * away - 8.0 * UNIT_ROUNDOFF * square;
        if ball >= enough {
            return Assessment {
                lower: ball,
                middle,
                barren: true,
                convex: None,
                spread: [0.0; D],
                start: [0.0; D],
            };
        }
        let mut gradient = [0.0; D];
        let (mut hessian, mut change) = ([[0.0; D]; D], [[0.0; D]; D]);
        for k in 0..D {
            gradient[k] = d.dot(self.first[k]);
            for l in 0..D {
                hessian[k][l] = self.metric[k][l] + d.dot(self.second[k][l]);
                change[k][l] = distance * self.variation[k][l] + self.constant[k][l];
            }
        }
        let mut model = middle - 8.0 * UNIT_ROUNDOFF * square;
        let mut spread = [0.0; D];
        let mut start = [0.0; D];
        let mut barren = false;
        for k in 0..D {
            for l in 0..D {
                spread[k] += hessian[k][l].abs() + change[k][l];
                // |h_kl x_k x_l| for l ≠ k, each half of the pair; and the remainder.
                model -= 0.5 * change[k][l] + if k == l { 0.0 } else { 0.5 * hessian[k][l].abs() };
            }
            let (place, least) = least_on(gradient[k], hessian[k][k], [-1.0, 1.0]);
            start[k] = place;
            model += least;
            barren |= gradient[k].abs() > spread[k];
        }
        let convex = positive_diagonal(&hessian, &change);
        let barren = barren || nowhere_positive(&hessian, &change);
        Assessment { lower: model.max(ball), middle, barren, convex, spread, start }
    }
}

/// A positive diagonal matrix below all symmetric matrices within `change` of `hessian`, where there is one.
fn positive_diagonal<const D: usize>(hessian: &[[f64; D]; D], change: &[[f64; D]; D]) -> Option<[f64; D]> {
    let diagonal: [f64; D] = std::array::from_fn(|k| hessian[k][k] - change[k][k]);
    if diagonal.iter().any(|&x| x <= 0.0) {
        return None;
    }
    // Of (a b; b c) the part (1 − |b|/√(ac))·diag(a, c) lies below it.
    let coupling = match D {
        2 => (hessian[0][1].abs() + change[0][1]) / (diagonal[0].sqrt() * diagonal[1].sqrt()),
        _ => 0.0,
    };
    (coupling < 1.0).then(|| diagonal.map(|x| x * (1.0 - coupling)))
}

/// Whether no symmetric matrix within `change` of `hessian` is positive semidefinite.
#[inline]
fn nowhere_positive<const D: usize>(hessian: &[[f64; D]; D], change: &[[f64; D]; D]) -> bool {
    let diagonal: [f64; D] = std::array::from_fn(|k| hessian[k][k] + change[k][k]);
    if diagonal.iter().any(|&x| x < 0.0) {
        return true;
    }
    let coupling = if D == 2 { hessian[0][1].abs() - change[0][1] } else { 0.0 };
    D == 2 && coupling > 0.0 && coupling * coupling > diagonal[0] * diagonal[1]
}

/// Where `g x + ½ h x²` is least on an interval that holds 0, and its value there.
#[inline]
pub(super) fn least_on(g: f64, h: f64, [from, to]: [f64; 2]) -> (f64, f64) {
    let value = |x: f64| (g + 0.5 * h * x) * x;
    let x = if h > 0.0 && g.abs() < h * (to - from) {
        (-g / h).clamp(from, to)
    } else if value(from) <= value(to) {
        from
    } else {
        to
    };
    (x, value(x))
}
