//! What surfaces at scattered parameters have in common: the loop over registers of places, the quotient rule, the poles.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use std::sync::atomic::{AtomicUsize, Ordering};

use pulp::Scalar;

use super::blocks::store;
use super::parallel::{CHUNK, each_chunk};
use super::patch_kernel::load_pairs;
use super::quotient::{lane, largest_weight, refuse_pole, settle, surface, suspicious, uncertainty};
use super::simd::{Job, Lanes, dispatch, dispatch_in};
use super::{BatchPoint, check_length};
use crate::BernsteinError;
use crate::glam::{DVec2, DVec4};

/// A polynomial in two parameters, as plain numbers, so that the kernels are compiled with this crate and once.
pub(super) trait Form: Copy + Send + Sync {
    /// What is made of a register of parameters for all kinds of derivatives.
    type At<S: Lanes>;

    /// The control points.
    fn net(&self) -> &[f64];
    /// The degree, of all parameters together.
    fn degree(&self) -> usize;
    /// Room for [`move_to`](Self::move_to).
    fn at<S: Lanes>(&self, simd: S) -> Self::At<S>;
    fn move_to<S: Lanes>(&self, simd: S, at: &mut Self::At<S>, u: S::f64s, v: S::f64s);
    /// The first `K` derivatives, in the order of [`partial_index`](crate::partial_index).
    fn jet<S: Lanes, const D: usize, const K: usize>(&self, simd: S, at: &Self::At<S>) -> [[S::f64s; D]; K];
    /// A bound on `Σ|B|`, the sum over the basis.
    fn spread<S: Lanes>(&self, simd: S, at: &Self::At<S>) -> S::f64s;
    /// `Σ|B w|` at one place: the scale of the denominator's error.
    fn scale(&self, at: DVec2) -> f64;
}

/// Values (one buffer), with first (three) and second (six) derivatives of a polynomial shape, at pairs of parameters.
pub(super) fn plain<F: Form>(
    form: F,
    dimension: usize,
    parameters: &[f64],
    out: &mut [&mut [f64]],
) -> Result<(), BernsteinError> {
    match out {
        [a] => run::<F, 1, false>(form, dimension, parameters, [a]),
        [a, b, c] => run::<F, 3, false>(form, dimension, parameters, [a, b, c]),
        [a, b, c, d, e, f] => run::<F, 6, false>(form, dimension, parameters, [a, b, c, d, e, f]),
        _ => Ok(()),
    }
}

/// The same of a rational shape in space, by the quotient rule.
pub(super) fn rational<F: Form>(
    form: F,
    parameters: &[f64],
    out: &mut [&mut [f64]],
) -> Result<(), BernsteinError> {
    match out {
        [a] => run::<F, 1, true>(form, 3, parameters, [a]),
        [a, b, c] => run::<F, 3, true>(form, 3, parameters, [a, b, c]),
        [a, b, c, d, e, f] => run::<F, 6, true>(form, 3, parameters, [a, b, c, d, e, f]),
        _ => Ok(()),
    }
}

/// Cuts the parameters into chunks, for results of `width` numbers a point.
fn run<F: Form, const K: usize, const RATIONAL: bool>(
    form: F,
    width: usize,
    parameters: &[f64],
    out: [&mut [f64]; K],
) -> Result<(), BernsteinError> {
    let out = out.map(|out| out.chunks_mut(CHUNK * width));
    let pole = AtomicUsize::new(usize::MAX);
    each_chunk(parameters.chunks(2 * CHUNK).enumerate(), out, |(number, parameters), out| {
        let chunk = Chunk::<F, K, RATIONAL> { form, parameters, out, first: number * CHUNK, pole: &pole };
        if RATIONAL {
            dispatch_in::<_, 4>(chunk);
        } else {
            dispatch(width, chunk);
        }
    });
    refuse_pole(pole.into_inner())
}

/// Some of the parameters.
struct Chunk<'a, F, const K: usize, const RATIONAL: bool> {
    form: F,
    parameters: &'a [f64],
    out: [&'a mut [f64]; K],
    /// The place of the first parameter in the whole batch.
    first: usize,
    /// The first place of a pole.
    pole: &'a AtomicUsize,
}

impl<F: Form, const K: usize, const RATIONAL: bool> Job for Chunk<'_, F, K, RATIONAL> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes, const D: usize>(self, simd: S) {
        let Self { form, parameters, mut out, first, pole } = self;
        let uncertainty = uncertainty(form.degree());
        let weight = if RATIONAL { uncertainty * largest_weight(form.net()) } else { 0.0 };
        let count = parameters.len() / 2;
        let mut at = form.at(simd);
        let mut place = 0;
        while place < count {
            let [u, v] = load_pairs(simd, parameters, place);
            form.move_to(simd, &mut at, u, v);
            let jet: [[S::f64s; D]; K] = form.jet(simd, &at);
            if RATIONAL {
                let mut homogeneous = [[simd.splat_f64s(0.0); 4]; K];
                for k in 0..K {
                    for c in 0..D {
                        homogeneous[k][c] = jet[k][c];
                    }
                }
                let points = surface(simd, &homogeneous);
                for k in 0..K {
                    store(simd, out[k], place, points[k]);
                }
                // Σ|B w| is at most Σ|B| times the largest weight.
                let least = simd.mul_f64s(simd.splat_f64s(weight), form.spread(simd, &at));
                if simd.any(suspicious(simd, homogeneous[0][3], &points, least)) {
                    for l in 0..S::F64_LANES.min(count - place) {
                        let denominator = lane::<S>(homogeneous[0][3], l);
                        let [u, v] = [parameters[2 * (place + l)], parameters[2 * (place + l) + 1]];
                        let bound = uncertainty * form.scale(DVec2::new(u, v));
                        if settle(denominator, bound, &mut out, place + l) {
                            pole.fetch_min(first + place + l, Ordering::Relaxed);
                        }
                    }
                }
            } else {
                for k in 0..K {
                    store(simd, out[k], place, jet[k]);
                }
            }
            place += S::F64_LANES;
        }
    }
}

/// Place by place, for degrees that have no kernel; `jet` fills in the derivatives at one place.
pub(super) fn one_by_one<P: BatchPoint, const K: usize>(
    parameters: &[DVec2],
    out: &mut [&mut [P]; K],
    jet: impl Fn(DVec2, &mut [P]),
) {
    let mut all = [P::ZERO; K];
    for (place, &at) in parameters.iter().enumerate() {
        jet(at, &mut all);
        for (out, p) in out.iter_mut().zip(all) {
            out[place] = p;
        }
    }
}

/// The same of a rational shape.
pub(super) fn rational_one_by_one<F: Form, const K: usize>(
    form: F,
    parameters: &[DVec2],
    out: &mut [&mut [f64]; K],
    jet: impl Fn(DVec2, &mut [DVec4]),
) -> Result<(), BernsteinError> {
    let mut pole = usize::MAX;
    let mut all = [DVec4::ZERO; K];
    for (place, &at) in parameters.iter().enumerate() {
        jet(at, &mut all);
        let homogeneous = all.map(|p| p.to_array());
        for (out, point) in out.iter_mut().zip(surface(Scalar, &homogeneous)) {
            out[3 * place..3 * place + 3].copy_from_slice(&point);
        }
        if settle(homogeneous[0][3], uncertainty(form.degree()) * form.scale(at), out, place) {
            pole = pole.min(place);
        }
    }
    refuse_pole(pole)
}

/// Refuses buffers of another length than the parameters.
pub(super) fn check_lengths<P, const K: usize>(
    parameters: &[DVec2],
    out: &[&mut [P]; K],
) -> Result<(), BernsteinError> {
    out.iter().try_for_each(|out| check_length("out", parameters.len(), out.len()))
}
