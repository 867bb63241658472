//! One rational curve at many parameters.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use std::sync::atomic::{AtomicUsize, Ordering};

use super::blocks::{load, store};
use super::curve::Coefficients;
use super::horner::{ONE_SIDED, Parameter};
use super::parallel::{CHUNK, each_chunk};
use super::quotient::{curve, lane, refuse_pole, settle, uncertainty};
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
    let pole = AtomicUsize::new(usize::MAX);
    each_chunk(parameters.chunks(CHUNK).enumerate(), out, |(number, parameters), out| {
        let first = number * CHUNK;
        let pole = &pole;
        if coefficients.degree <= ONE_SIDED {
            dispatch_in::<_, 4>(Rational::<_, false> { coefficients, parameters, out, first, pole });
        } else {
            dispatch_in::<_, 4>(Rational::<_, true> { coefficients, parameters, out, first, pole });
        }
    });
    refuse_pole(pole.into_inner())
}

struct Rational<'a, const K: usize, const TWO_SIDED: bool> {
    coefficients: &'a Coefficients,
    parameters: &'a [f64],
    out: [&'a mut [f64]; K],
    /// The place of the first parameter in the whole batch.
    first: usize,
    /// The first place of a pole.
    pole: &'a AtomicUsize,
}

impl<const K: usize, const TWO_SIDED: bool> Job for Rational<'_, K, TWO_SIDED> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes, const D: usize>(self, simd: S) {
        let Self { coefficients, parameters, mut out, first, pole } = self;
        let degree = coefficients.degree;
        let share = uncertainty(degree);
        let bound =
            simd.splat_f64s(share * coefficients.weights.iter().fold(0.0, |m: f64, w| m.max(w.abs())));
        let mut place = 0;
        while place < parameters.len() {
            let t = load(simd, parameters, place);
            let parameter = Parameter::<S, TWO_SIDED>::new(simd, t);
            let mut jet = [[simd.splat_f64s(0.0); 4]; K];
            for k in 0..K {
                jet[k] = parameter.value(coefficients.of_order[k].as_chunks().0);
            }
            // Σ|Bᵢⁿ(t)||wᵢ| is at most (|1−t| + |t|)ⁿ times the largest weight.
            let s = simd.sub_f64s(simd.splat_f64s(1.0), t);
            let spread = simd.power(simd.add_f64s(simd.abs_f64s(s), simd.abs_f64s(t)), degree);
            let (points, suspicious) = curve(simd, jet, simd.mul_f64s(bound, spread));
            for k in 0..K {
                store(simd, out[k], place, points[k]);
            }
            if simd.any(suspicious) {
                for at in 0..S::F64_LANES.min(parameters.len() - place) {
                    let scale = scale(coefficients, parameters[place + at]);
                    if settle(lane::<S>(jet[0][3], at), share * scale, &mut out, place + at) {
                        pole.fetch_min(first + place + at, Ordering::Relaxed);
                    }
                }
            }
            place += S::F64_LANES;
        }
    }
}

/// `Σ |Bᵢⁿ(t) wᵢ|`: the scale of the denominator's error.
#[cold]
fn scale(coefficients: &Coefficients, t: f64) -> f64 {
    let mut all = [0.0; MAX_DEGREE + 1];
    let row = &mut all[..=coefficients.degree];
    basis(t, row);
    coefficients.weights.iter().zip(row).map(|(w, b)| (w * *b).abs()).sum()
}
