//! What shapes at scattered parameters have in common: the loop over registers of places, the quotient rule, the poles.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use std::sync::atomic::{AtomicUsize, Ordering};

use pulp::Scalar;

use super::blocks::{load_tuples, store};
use super::parallel::{CHUNK, each_chunk};
use super::quotient::{
    is_tame, lane, largest_weight, partials, refuse_pole, settle, suspicious, uncertainty,
};
use super::simd::{Job, Lanes, dispatch, dispatch_in};
use super::{BatchPoint, check_length};
use crate::BernsteinError;
use crate::glam::DVec4;

/// A polynomial in `N` parameters, as plain numbers, so that the kernels are compiled with this crate and once.
pub(super) trait Form<const N: usize>: Copy + Send + Sync {
    /// What is made of a register of parameters for all kinds of derivatives.
    type At<S: Lanes>;

    /// The control points.
    fn net(&self) -> &[f64];
    /// The degree, of all parameters together.
    fn degree(&self) -> usize;
    /// Room for [`move_to`](Self::move_to).
    fn at<S: Lanes>(&self, simd: S) -> Self::At<S>;
    fn move_to<S: Lanes>(&self, simd: S, at: &mut Self::At<S>, parameters: [S::f64s; N]);
    /// The first `K` derivatives, in the order of [`simplex_partial_index`](crate::simplex_partial_index).
    fn jet<S: Lanes, const D: usize, const K: usize>(&self, simd: S, at: &Self::At<S>) -> [[S::f64s; D]; K];
    /// The same of numerators and denominator, in each lane divided by its [`factor`](Self::factor), which the
    /// quotient rule does not notice.
    #[inline(always)]
    fn homogeneous<S: Lanes, const K: usize>(&self, simd: S, at: &Self::At<S>) -> [[S::f64s; 4]; K] {
        self.jet(simd, at)
    }
    #[inline(always)]
    fn factor<S: Lanes>(&self, simd: S, at: &Self::At<S>) -> S::f64s {
        let _ = at;
        simd.splat_f64s(1.0)
    }
    /// A bound on `Σ|B|`, the sum over the basis, likewise divided.
    fn spread<S: Lanes>(&self, simd: S, at: &Self::At<S>) -> S::f64s;
    /// Whether all lanes lie inside the domain; `false` where that is not worth asking.
    #[inline(always)]
    fn is_inside<S: Lanes>(&self, simd: S, at: &Self::At<S>) -> bool {
        let _ = (simd, at);
        false
    }
    /// `Σ|B w|` at one place: the scale of the denominator's error. `scratch` is kept from place to place.
    fn scale(&self, at: [f64; N], scratch: &mut Vec<f64>) -> f64;
}

/// Values (one buffer), with first (three) and second (six) derivatives of a surface at pairs of parameters: of its
/// polynomials of `dimension` numbers, or of the rational shape in space that they are of.
pub(super) fn surface<F: Form<2>, const RATIONAL: bool>(
    form: F,
    dimension: usize,
    parameters: &[f64],
    out: &mut [&mut [f64]],
) -> Result<(), BernsteinError> {
    match out {
        [a] => run::<F, 2, 1, RATIONAL>(form, dimension, parameters, [a]),
        [a, b, c] => run::<F, 2, 3, RATIONAL>(form, dimension, parameters, [a, b, c]),
        [a, b, c, d, e, f] => run::<F, 2, 6, RATIONAL>(form, dimension, parameters, [a, b, c, d, e, f]),
        _ => Ok(()),
    }
}

/// Values (one buffer), with first (four) derivatives of a solid at triples of parameters, as [`surface`].
pub(super) fn solid<F: Form<3>, const RATIONAL: bool>(
    form: F,
    dimension: usize,
    parameters: &[f64],
    out: &mut [&mut [f64]],
) -> Result<(), BernsteinError> {
    match out {
        [a] => run::<F, 3, 1, RATIONAL>(form, dimension, parameters, [a]),
        [a, b, c, d] => run::<F, 3, 4, RATIONAL>(form, dimension, parameters, [a, b, c, d]),
        _ => Ok(()),
    }
}

/// Cuts the parameters into chunks.
fn run<F: Form<N>, const N: usize, const K: usize, const RATIONAL: bool>(
    form: F,
    dimension: usize,
    parameters: &[f64],
    out: [&mut [f64]; K],
) -> Result<(), BernsteinError> {
    let width = if RATIONAL { 3 } else { dimension };
    let out = out.map(|out| out.chunks_mut(CHUNK * width));
    let pole = AtomicUsize::new(usize::MAX);
    let tame = RATIONAL && is_tame(form.net());
    each_chunk(parameters.chunks(N * CHUNK).enumerate(), out, |(number, parameters), out| {
        let first = number * CHUNK;
        let chunk = Chunk::<F, N, K, RATIONAL> { form, parameters, out, first, tame, pole: &pole };
        if RATIONAL {
            dispatch_in::<_, 4>(chunk);
        } else {
            dispatch(width, chunk);
        }
    });
    refuse_pole(pole.into_inner())
}

/// Some of the parameters.
struct Chunk<'a, F, const N: usize, const K: usize, const RATIONAL: bool> {
    form: F,
    parameters: &'a [f64],
    out: [&'a mut [f64]; K],
    /// The place of the first parameter in the whole batch.
    first: usize,
    /// Whether nothing can go wrong with a quotient inside the domain, see [`is_tame`].
    tame: bool,
    /// The first place of a pole.
    pole: &'a AtomicUsize,
}

impl<F: Form<N>, const N: usize, const K: usize, const RATIONAL: bool> Job for Chunk<'_, F, N, K, RATIONAL> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes, const D: usize>(self, simd: S) {
        let Self { form, parameters, mut out, first, tame, pole } = self;
        let uncertainty = uncertainty(form.degree());
        let weight = if RATIONAL { uncertainty * largest_weight(form.net()) } else { 0.0 };
        let count = parameters.len() / N;
        let mut at = form.at(simd);
        let mut scratch = Vec::new();
        let mut place = 0;
        while place < count {
            form.move_to(simd, &mut at, load_tuples(simd, parameters, place));
            if RATIONAL {
                let homogeneous: [_; K] = form.homogeneous(simd, &at);
                let points = partials::<S, N, K>(simd, &homogeneous);
                for k in 0..K {
                    store(simd, out[k], place, points[k]);
                }
                if !(tame && form.is_inside(simd, &at)) {
                    // Σ|B w| is at most Σ|B| times the largest weight.
                    let least = simd.mul_f64s(simd.splat_f64s(weight), form.spread(simd, &at));
                    if simd.any(suspicious(simd, homogeneous[0][3], &points, least)) {
                        let denominator = simd.mul_f64s(homogeneous[0][3], form.factor(simd, &at));
                        for l in 0..S::F64_LANES.min(count - place) {
                            let Some(at) = parameters[N * (place + l)..].first_chunk::<N>() else { continue };
                            let bound = uncertainty * form.scale(*at, &mut scratch);
                            if settle(lane::<S>(denominator, l), bound, &mut out, place + l) {
                                pole.fetch_min(first + place + l, Ordering::Relaxed);
                            }
                        }
                    }
                }
            } else {
                let jet: [[S::f64s; D]; K] = form.jet(simd, &at);
                for k in 0..K {
                    store(simd, out[k], place, jet[k]);
                }
            }
            place += S::F64_LANES;
        }
    }
}

/// Place by place, for degrees that have no kernel; `jet` fills in the derivatives at one place.
pub(super) fn one_by_one<P: BatchPoint, T: Copy, const K: usize>(
    parameters: &[T],
    out: &mut [&mut [P]; K],
    jet: impl Fn(T, &mut [P]),
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
pub(super) fn rational_one_by_one<F: Form<N>, T: Copy + Into<[f64; N]>, const N: usize, const K: usize>(
    form: F,
    parameters: &[T],
    out: &mut [&mut [f64]; K],
    jet: impl Fn(T, &mut [DVec4]),
) -> Result<(), BernsteinError> {
    let mut pole = usize::MAX;
    let mut all = [DVec4::ZERO; K];
    let mut scratch = Vec::new();
    for (place, &at) in parameters.iter().enumerate() {
        jet(at, &mut all);
        let homogeneous = all.map(|p| p.to_array());
        for (out, point) in out.iter_mut().zip(partials::<_, N, K>(Scalar, &homogeneous)) {
            out[3 * place..3 * place + 3].copy_from_slice(&point);
        }
        let bound = uncertainty(form.degree()) * form.scale(at.into(), &mut scratch);
        if settle(homogeneous[0][3], bound, out, place) {
            pole = pole.min(place);
        }
    }
    refuse_pole(pole)
}

/// Refuses buffers of another length than the parameters.
pub(super) fn check_lengths<P, T, const K: usize>(
    parameters: &[T],
    out: &[&mut [P]; K],
) -> Result<(), BernsteinError> {
    out.iter().try_for_each(|out| check_length("out", parameters.len(), out.len()))
}
