//! From homogeneous derivatives to those in space, a register of points at a time, and the poles on the way.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use super::simd::{Lanes, WIDTH};
use crate::BernsteinError;

/// u = 2⁻⁵³
const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;

/// The rounding error of a denominator of some total degree: `4(degree + 2)·u`, times the scale.
pub(super) fn uncertainty(degree: usize) -> f64 {
    (4 * (degree + 2)) as f64 * UNIT_ROUNDOFF
}

/// Quotient rule in `N` variables: `S_α = (N_α − Σ_{0<β≤α} C(α,β) w_β S_{α−β}) / w`, for values (K = 1), with first (K = N + 1)
/// and second derivatives, in the order of [`simplex_partial_index`](crate::simplex_partial_index).
///
/// Source: Piegl and Tiller, *The NURBS Book*, 2nd ed., sec. 4.5.
#[inline(always)]
pub(super) fn partials<S: Lanes, const N: usize, const K: usize>(
    simd: S,
    jet: &[[S::f64s; 4]; K],
) -> [[S::f64s; 3]; K] {
    let inverse = simd.div_f64s(simd.splat_f64s(1.0), jet[0][3]);
    let mut out = [[simd.splat_f64s(0.0); 3]; K];
    for c in 0..3 {
        let weight = |k: usize| simd.neg_f64s(jet[k][3]);
        let point = simd.mul_f64s(jet[0][c], inverse);
        out[0][c] = point;
        if K <= N {
            continue;
        }
        let mut first = [point; N];
        for a in 0..N {
            first[a] = simd.mul_f64s(simd.mul_add_f64s(point, weight(1 + a), jet[1 + a][c]), inverse);
            out[1 + a][c] = first[a];
        }
        if K <= N + 1 {
            continue;
        }
        let mut k = N + 1;
        for a in 0..N {
            for b in a..N {
                let rest = if a == b {
                    simd.mul_add_f64s(simd.add_f64s(first[a], first[a]), weight(1 + a), jet[k][c])
                } else {
                    let rest = simd.mul_add_f64s(first[b], weight(1 + a), jet[k][c]);
                    simd.mul_add_f64s(first[a], weight(1 + b), rest)
                };
                out[k][c] = simd.mul_f64s(simd.mul_add_f64s(point, weight(k), rest), inverse);
                k += 1;
            }
        }
    }
    out
}

/// Quotient rule for a curve, `C⁽ᵏ⁾ = (N⁽ᵏ⁾ − Σ_{0<j≤k} C(k,j) w⁽ʲ⁾ C⁽ᵏ⁻ʲ⁾) / w`, up to order 2; otherwise as
/// [`partials`].
#[inline(always)]
pub(super) fn curve<S: Lanes, const K: usize>(simd: S, jet: &[[S::f64s; 4]; K]) -> [[S::f64s; 3]; K] {
    let inverse = simd.div_f64s(simd.splat_f64s(1.0), jet[0][3]);
    let mut out = [[simd.splat_f64s(0.0); 3]; K];
    for c in 0..3 {
        let weight = |k: usize| simd.neg_f64s(jet[k][3]);
        let point = simd.mul_f64s(jet[0][c], inverse);
        out[0][c] = point;
        if K < 2 {
            continue;
        }
        let d1 = simd.mul_f64s(simd.mul_add_f64s(point, weight(1), jet[1][c]), inverse);
        out[1][c] = d1;
        if K < 3 {
            continue;
        }
        let d2 = simd.mul_add_f64s(simd.add_f64s(d1, d1), weight(1), jet[2][c]);
        out[2][c] = simd.mul_f64s(simd.mul_add_f64s(point, weight(2), d2), inverse);
    }
    out
}

/// Lanes with a denominator of at most `least` in size or an answer that is not finite.
#[inline(always)]
pub(super) fn suspicious<S: Lanes, const K: usize>(
    simd: S,
    denominator: S::f64s,
    out: &[[S::f64s; 3]; K],
    least: S::f64s,
) -> S::m64s {
    let mut sum = simd.splat_f64s(0.0);
    for k in 0..K {
        for c in 0..3 {
            sum = simd.add_f64s(sum, out[k][c]);
        }
    }
    // x − x is 0 for finite numbers alone.
    let zero = simd.splat_f64s(0.0);
    let finite = simd.equal_f64s(simd.sub_f64s(sum, sum), zero);
    let sound = simd.and_m64s(finite, simd.greater_than_f64s(simd.abs_f64s(denominator), least));
    simd.xor_m64s(sound, simd.equal_f64s(zero, zero))
}

/// One lane of a register.
#[inline(always)]
pub(super) fn lane<S: Lanes>(register: S::f64s, at: usize) -> f64 {
    let mut numbers = [0.0; WIDTH];
    S::as_mut_simd_f64s(&mut numbers).0[0] = register;
    numbers[at % WIDTH]
}

/// Whether a point that looked suspicious is a pole: its denominator vanishes within `bound`, or the numbers
/// at `place` in one of the buffers are not all finite. A pole's numbers become 0.
#[cold]
pub(super) fn settle(denominator: f64, bound: f64, out: &mut [&mut [f64]], place: usize) -> bool {
    let range = 3 * place..3 * place + 3;
    let finite = |out: &&mut [f64]| out[range.clone()].iter().all(|x| x.is_finite());
    if denominator.abs() > bound && out.iter().all(finite) {
        return false;
    }
    out.iter_mut().for_each(|out| out[range.clone()].fill(0.0));
    true
}

/// `Σᵢ Σⱼ |Bᵢ Bⱼ wᵢⱼ|`: the scale of a denominator's error.
#[cold]
pub(super) fn scale(net: &[f64], in_u: &[f64], in_v: &[f64]) -> f64 {
    let row = |row: &[f64]| -> f64 { row.chunks_exact(4).zip(in_v).map(|(p, b)| (p[3] * b).abs()).sum() };
    net.chunks_exact(4 * in_v.len()).zip(in_u).map(|(points, b)| row(points) * b.abs()).sum()
}

/// Whether inside `[0, 1]` no denominator of these points can vanish and no quotient, derivatives to order 2
/// included, can leave the range of numbers: all weights have one sign, and are within 10⁶⁰ of each other and
/// of all components.
pub(super) fn is_tame(points: &[f64]) -> bool {
    let weights = || points.chunks_exact(4).map(|p| p[3]);
    let least = weights().fold(f64::INFINITY, |m, w| m.min(w.abs()));
    let largest = points.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let one_sign = weights().all(|w| w > 0.0) || weights().all(|w| w < 0.0);
    one_sign && least > 1e-150 && largest < 1e150 && largest < 1e60 * least
}

/// The largest weight in size.
pub(super) fn largest_weight(points: &[f64]) -> f64 {
    points.chunks_exact(4).fold(0.0, |m: f64, p| m.max(p[3].abs()))
}

/// An error where a pole was found.
pub(super) fn refuse_pole(first: usize) -> Result<(), BernsteinError> {
    if first == usize::MAX { Ok(()) } else { Err(BernsteinError::Pole { index: first }) }
}
