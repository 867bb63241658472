//! One rational curve at many parameters.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use std::sync::atomic::{AtomicUsize, Ordering};

use super::blocks::{load, store};
use super::curve::Coefficients;
use super::horner::{Parameter, reversed_interval};
use super::nets::ANY;
use super::parallel::{CHUNK, each_chunk};
use super::quotient::{curve, lane, refuse_pole, settle, suspicious, uncertainty};
use super::simd::{Job, Lanes, dispatch_in};
use crate::{BernsteinError, MAX_DEGREE, basis};

/// Not generic, so that the kernels are compiled with this crate and once.
pub(super) fn evaluate(
    coefficients: &Coefficients,
    parameters: &[f64],
    out: &mut [&mut [f64]],
) -> Result<(), BernsteinError> {
    match out {
        [a] => chunks(coefficients, parameters, [a]),
        [a, b] => chunks(coefficients, parameters, [a, b]),
        [a, b, c] => chunks(coefficients, parameters, [a, b, c]),
        _ => Ok(()),
    }
}

fn chunks<const K: usize>(
    coefficients: &Coefficients,
    parameters: &[f64],
    out: [&mut [f64]; K],
) -> Result<(), BernsteinError> {
    let out = out.map(|out| out.chunks_mut(CHUNK * 3));
    let interval = reversed_interval(coefficients.degree);
    let pole = AtomicUsize::new(usize::MAX);
    each_chunk(parameters.chunks(CHUNK).enumerate(), out, |(number, parameters), out| {
        let first = number * CHUNK;
        let pole = &pole;
        if coefficients.degree == 3 {
            dispatch_in::<_, 4>(Rational::<_, 3> { coefficients, interval, parameters, out, first, pole });
        } else {
            dispatch_in::<_, 4>(Rational::<_, ANY> { coefficients, interval, parameters, out, first, pole });
        }
    });
    refuse_pole(pole.into_inner())
}

/// `N` is the degree, or [`ANY`].
struct Rational<'a, const K: usize, const N: usize> {
    coefficients: &'a Coefficients,
    interval: [f64; 2],
    parameters: &'a [f64],
    out: [&'a mut [f64]; K],
    /// The place of the first parameter in the whole batch.
    first: usize,
    /// The first place of a pole.
    pole: &'a AtomicUsize,
}

impl<const K: usize, const N: usize> Job for Rational<'_, K, N> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes, const D: usize>(self, simd: S) {
        let Self { coefficients, interval, parameters, mut out, first, pole } = self;
        let (zero, one) = (simd.splat_f64s(0.0), simd.splat_f64s(1.0));
        let degree = coefficients.degree;
        let share = uncertainty(degree);
        let bound = share * coefficients.weights.iter().fold(0.0, |m: f64, w| m.max(w.abs()));
        let mut place = 0;
        while place < parameters.len() {
            let t = load(simd, parameters, place);
            let parameter = Parameter::new(simd, t, interval);
            let jet: [_; K] = if parameter.some {
                homogeneous::<S, K, N, true>(simd, &parameter, coefficients)
            } else {
                homogeneous::<S, K, N, false>(simd, &parameter, coefficients)
            };
            let points = curve(simd, &jet);
            for k in 0..K {
                store(simd, out[k], place, points[k]);
            }
            let outside = simd.or_m64s(simd.less_than_f64s(t, zero), simd.greater_than_f64s(t, one));
            if !coefficients.tame || simd.any(outside) {
                // Σ C(n,i)|wᵢ xⁱ| is at most (1 + |x|)ⁿ times the largest weight.
                let spread = simd.power(simd.add_f64s(one, simd.abs_f64s(parameter.quotient)), degree);
                let least = simd.mul_f64s(simd.splat_f64s(bound), spread);
                if simd.any(suspicious(simd, jet[0][3], &points, least)) {
                    for at in 0..S::F64_LANES.min(parameters.len() - place) {
                        let scale = scale(coefficients, parameters[place + at]);
                        let power = simd.power(parameter.base, degree);
                        let denominator = lane::<S>(simd.mul_f64s(jet[0][3], power), at);
                        if settle(denominator, share * scale, &mut out, place + at) {
                            pole.fetch_min(first + place + at, Ordering::Relaxed);
                        }
                    }
                }
            }
            place += S::F64_LANES;
        }
    }
}

/// Numerator and denominator with their derivatives, all divided by the same power of 1 − t or t, which the
/// quotient rule does not notice.
#[inline(always)]
fn homogeneous<S: Lanes, const K: usize, const N: usize, const MIXED: bool>(
    simd: S,
    parameter: &Parameter<S>,
    coefficients: &Coefficients,
) -> [[S::f64s; 4]; K] {
    let degree = if N == ANY { coefficients.degree } else { N };
    let q = |k: usize| &coefficients.of_order[k].as_chunks().0[..(degree + 1).saturating_sub(k)];
    let mut jet = [[simd.splat_f64s(0.0); 4]; K];
    jet[0] = parameter.sum::<4, MIXED>(q(0));
    if K > 1 {
        let inverse = simd.div_f64s(simd.splat_f64s(1.0), parameter.base);
        let mut factor = inverse;
        for k in 1..K {
            jet[k] = parameter.sum::<4, MIXED>(q(k));
            for c in 0..4 {
                jet[k][c] = simd.mul_f64s(jet[k][c], factor);
            }
            factor = simd.mul_f64s(factor, inverse);
        }
    }
    jet
}

/// `Σ |Bᵢⁿ(t) wᵢ|`: the scale of the denominator's error.
#[cold]
fn scale(coefficients: &Coefficients, t: f64) -> f64 {
    let mut all = [0.0; MAX_DEGREE + 1];
    let row = &mut all[..=coefficients.degree];
    basis(t, row);
    coefficients.weights.iter().zip(row).map(|(w, b)| (w * *b).abs()).sum()
}
