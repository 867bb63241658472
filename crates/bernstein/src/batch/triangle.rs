//! One triangle at scattered parameters.
//!
//! The powers of the three barycentric coordinates are made once for all kinds of derivatives; a control point
//! then takes one multiplication, and one multiply-add a component.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use std::sync::atomic::{AtomicUsize, Ordering};

use pulp::Scalar;
use pulp::bytemuck::{cast_slice, cast_slice_mut};

use super::blocks::store;
use super::nets::ORDERS;
use super::parallel::{CHUNK, each_chunk};
use super::patch_kernel::load_pairs;
use super::quotient::{lane, largest_weight, refuse_pole, settle, surface, suspicious, uncertainty};
use super::simd::{Job, Lanes, dispatch, dispatch_in};
use super::{BatchPoint, check_length};
use crate::glam::{DVec2, DVec3, DVec4};
use crate::simplex::differentiate;
use crate::{BernsteinError, TriangleNet, binomial, last_barycentric, multi_indices, simplex_basis};

/// Degrees up to this one have their powers in registers on the stack.
const MOST: usize = 40;

/// A triangle, `p(λ) = Σ n!/(i!j!k!) λ₁ⁱ λ₂ʲ λ₃ᵏ P_ijk`, made ready to be evaluated at many scattered parameters (λ₁, λ₂),
/// λ₃ being 1 − λ₁ − λ₂.
///
/// ```
/// use casteljau_bernstein::{TriangleBatch, glam::DVec2};
/// let triangle = TriangleBatch::new(&[0.0, 0.5, 0.0, 0.0, 0.0, 0.0], 2)?; // λ₁λ₂
/// let [mut value, mut first, mut second] = [[0.0; 2]; 3];
/// triangle.evaluate(&[DVec2::new(0.5, 0.25), DVec2::X], [&mut value, &mut first, &mut second])?;
/// assert_eq!((value, first, second), ([0.125, 0.0], [0.25, 0.0], [0.5, 1.0]));
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
#[derive(Debug, Clone)]
pub struct TriangleBatch<P> {
    net: Vec<P>,
    degree: usize,
    /// The nets of all orders, `n!/(n−a−b)! Δ₁ᵃΔ₂ᵇ P`, each control point multiplied by its `(n−a−b)!/(i!j!k!)`; empty where the
    /// degree is too low, or too high for registers.
    scaled: Vec<Vec<f64>>,
}

impl<P: BatchPoint> TriangleBatch<P> {
    /// Prepares the triangle with the net `points` of degree n, in the order of [`TriangleNet`].
    ///
    /// Cost: memory for seven nets.
    ///
    /// # Errors
    /// [`BernsteinError::SimplexNetLength`] unless there are (n+1)(n+2)/2 points, [`BernsteinError::Degree`] above
    /// [`MAX_DEGREE`](crate::MAX_DEGREE).
    pub fn new(points: &[P], degree: usize) -> Result<Self, BernsteinError> {
        TriangleNet::new(points, degree)?;
        let orders = if degree <= MOST { &ORDERS[..] } else { &[] };
        let scaled = orders.iter().map(|&orders| scaled(points, degree, orders)).collect();
        Ok(Self { net: points.to_vec(), degree, scaled })
    }

    /// Degree n.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Values (K = 1), with first (K = 3) and second (K = 6) partial derivatives at the parameters (λ₁, λ₂), each kind in its own
    /// buffer: 1; λ₁, λ₂; λ₁λ₁, λ₁λ₂, λ₂λ₂, as [`TriangleNet::partials`] has them.
    ///
    /// Error: at most `4(n + 2(a+b) + 2)·u·scale`, see [the crate](crate). Cost: (1 + components) multiply-adds a control point
    /// for each kind; degrees above 40 go one by one through [`TriangleNet::partials`].
    ///
    /// # Errors
    /// [`BernsteinError::BufferLength`] unless every buffer has the length of `parameters`.
    pub fn evaluate<const K: usize>(
        &self,
        parameters: &[DVec2],
        out: [&mut [P]; K],
    ) -> Result<(), BernsteinError> {
        const { assert!(K == 1 || K == 3 || K == 6, "values; first; second derivatives") };
        for out in &out {
            check_length("out", parameters.len(), out.len())?;
        }
        let mut out = out.map(cast_slice_mut::<P, f64>);
        if self.scaled.is_empty() {
            self.one_by_one(parameters, K, |place, jet| {
                for (out, p) in out.iter_mut().zip(jet) {
                    out[P::DIMENSION * place..][..P::DIMENSION].copy_from_slice(cast_slice(&[*p]));
                }
            });
            return Ok(());
        }
        self.view(cast_slice(parameters)).plain(P::DIMENSION, &mut out)
    }

    /// The first `kinds` partial derivatives at each parameter, given to `take` with its place.
    fn one_by_one(&self, parameters: &[DVec2], kinds: usize, mut take: impl FnMut(usize, &[P])) {
        let net = TriangleNet::validated(&self.net, self.degree);
        let mut jet = [P::ZERO; 6];
        for (place, &at) in parameters.iter().enumerate() {
            net.partials(barycentric(at), &mut jet[..kinds]);
            take(place, &jet[..kinds]);
        }
    }

    fn view<'a>(&'a self, parameters: &'a [f64]) -> View<'a> {
        View { net: cast_slice(&self.net), degree: self.degree, scaled: &self.scaled, parameters }
    }
}

impl TriangleBatch<DVec4> {
    /// As [`evaluate`](Self::evaluate), for a rational net `(w·x, w·y, w·z, w)`: points and derivatives in space, by the quotient
    /// rule.
    ///
    /// Error: that of numerator and denominator, magnified by 1/|w| once an order.
    ///
    /// # Errors
    /// [`BernsteinError::BufferLength`], and [`BernsteinError::Pole`] with the first place where the denominator vanishes within
    /// its rounding error, or the quotient is out of range; the buffers hold 0 at such places, and the answers everywhere else.
    pub fn evaluate_rational<const K: usize>(
        &self,
        parameters: &[DVec2],
        out: [&mut [DVec3]; K],
    ) -> Result<(), BernsteinError> {
        const { assert!(K == 1 || K == 3 || K == 6, "values; first; second derivatives") };
        for out in &out {
            check_length("out", parameters.len(), out.len())?;
        }
        let mut out = out.map(cast_slice_mut::<DVec3, f64>);
        let view = self.view(cast_slice(parameters));
        if self.scaled.is_empty() {
            let mut pole = usize::MAX;
            self.one_by_one(parameters, K, |place, jet| {
                let mut all = [[0.0; 4]; K];
                all.iter_mut().zip(jet).for_each(|(to, p)| *to = p.to_array());
                for (out, point) in out.iter_mut().zip(surface(Scalar, &all)) {
                    out[3 * place..3 * place + 3].copy_from_slice(&point);
                }
                if settle(all[0][3], view.bound(place), &mut out, place) {
                    pole = pole.min(place);
                }
            });
            return refuse_pole(pole);
        }
        view.rational(&mut out)
    }
}

/// The net of the order (a, b) as the kernel wants it.
fn scaled<P: BatchPoint>(points: &[P], degree: usize, [a, b]: [usize; 2]) -> Vec<f64> {
    let Some(lower) = degree.checked_sub(a + b) else { return Vec::new() };
    let mut net = points.to_vec();
    differentiate::<P, 3>(degree, &[a, b], &mut net);
    let factor = (lower + 1..=degree).fold(1.0, |f, m| f * m as f64);
    let indices = multi_indices::<3>(lower);
    let scaled = indices.zip(&net).map(|([i, j, _], &p)| {
        let multinomial = binomial(lower, i) * binomial(lower - i, j);
        p * factor * multinomial
    });
    let scaled: Vec<P> = scaled.collect();
    cast_slice(&scaled).to_vec()
}

fn barycentric(at: DVec2) -> [f64; 3] {
    [at.x, at.y, last_barycentric(&at.to_array())]
}

/// A triangle and parameters as plain numbers, so that the kernels are compiled with this crate and once.
#[derive(Clone, Copy)]
struct View<'a> {
    net: &'a [f64],
    degree: usize,
    scaled: &'a [Vec<f64>],
    /// λ₁ and λ₂ of each place.
    parameters: &'a [f64],
}

impl View<'_> {
    fn plain(&self, dimension: usize, out: &mut [&mut [f64]]) -> Result<(), BernsteinError> {
        match out {
            [a] => self.plain_in(dimension, [a]),
            [a, b, c] => self.plain_in(dimension, [a, b, c]),
            [a, b, c, d, e, f] => self.plain_in(dimension, [a, b, c, d, e, f]),
            _ => Ok(()),
        }
    }

    fn plain_in<const K: usize>(&self, dimension: usize, out: [&mut [f64]; K]) -> Result<(), BernsteinError> {
        self.run(dimension, out, |chunk| dispatch(dimension, Scattered::<K, false>(chunk)))
    }

    fn rational(&self, out: &mut [&mut [f64]]) -> Result<(), BernsteinError> {
        match out {
            [a] => self.rational_in([a]),
            [a, b, c] => self.rational_in([a, b, c]),
            [a, b, c, d, e, f] => self.rational_in([a, b, c, d, e, f]),
            _ => Ok(()),
        }
    }

    fn rational_in<const K: usize>(&self, out: [&mut [f64]; K]) -> Result<(), BernsteinError> {
        self.run(3, out, |chunk| dispatch_in::<_, 4>(Scattered::<K, true>(chunk)))
    }

    /// Cuts the parameters into chunks, for results of `width` numbers a point.
    fn run<const K: usize>(
        &self,
        width: usize,
        out: [&mut [f64]; K],
        kernel: impl Fn(Chunk<'_, K>) + Send + Sync,
    ) -> Result<(), BernsteinError> {
        let out = out.map(|out| out.chunks_mut(CHUNK * width));
        let pole = AtomicUsize::new(usize::MAX);
        each_chunk(self.parameters.chunks(2 * CHUNK).enumerate(), out, |(number, parameters), out| {
            let triangle = View { parameters, ..*self };
            kernel(Chunk { triangle, out, first: number * CHUNK, pole: &pole });
        });
        refuse_pole(pole.into_inner())
    }

    /// The rounding error of the denominator at a place.
    #[cold]
    fn bound(&self, place: usize) -> f64 {
        let at = DVec2::new(self.parameters[2 * place], self.parameters[2 * place + 1]);
        let mut basis = vec![0.0; self.net.len() / 4];
        if simplex_basis(self.degree, barycentric(at), &mut basis).is_err() {
            return f64::INFINITY; // never: the net was checked
        }
        let scale: f64 = basis.iter().zip(self.net.chunks_exact(4)).map(|(b, p)| (b * p[3]).abs()).sum();
        uncertainty(self.degree) * scale
    }
}

/// Some of the parameters.
struct Chunk<'a, const K: usize> {
    triangle: View<'a>,
    out: [&'a mut [f64]; K],
    /// The place of the first parameter in the whole batch.
    first: usize,
    /// The first place of a pole.
    pole: &'a AtomicUsize,
}

struct Scattered<'a, const K: usize, const RATIONAL: bool>(Chunk<'a, K>);

impl<const K: usize, const RATIONAL: bool> Job for Scattered<'_, K, RATIONAL> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes, const D: usize>(self, simd: S) {
        let Chunk { triangle, mut out, first, pole } = self.0;
        let degree = triangle.degree;
        let weight = if RATIONAL { uncertainty(degree) * largest_weight(triangle.net) } else { 0.0 };
        let count = triangle.parameters.len() / 2;
        let mut powers = [[simd.splat_f64s(1.0); MOST + 1]; 3];
        let mut place = 0;
        while place < count {
            let [u, v] = load_pairs(simd, triangle.parameters, place);
            let lambda = [u, v, last(simd, u, v)];
            for (row, x) in powers.iter_mut().zip(lambda) {
                let mut power = x;
                for i in 1..=degree {
                    row[i] = power;
                    power = simd.mul_f64s(power, x);
                }
            }
            let mut jet = [[simd.splat_f64s(0.0); D]; K];
            for k in 0..K {
                let [a, b] = ORDERS[k];
                if let Some(lower) = degree.checked_sub(a + b) {
                    jet[k] = sum(simd, &powers, lower, triangle.scaled[k].as_chunks().0);
                }
            }
            if !RATIONAL {
                for k in 0..K {
                    store(simd, out[k], place, jet[k]);
                }
                place += S::F64_LANES;
                continue;
            }
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
            // Σ|B w| is at most (|λ₁| + |λ₂| + |λ₃|)ⁿ times the largest weight.
            let size = simd.add_f64s(simd.abs_f64s(lambda[0]), simd.abs_f64s(lambda[1]));
            let size = simd.add_f64s(size, simd.abs_f64s(lambda[2]));
            let least = simd.mul_f64s(simd.splat_f64s(weight), simd.power(size, degree));
            if simd.any(suspicious(simd, homogeneous[0][3], &points, least)) {
                for l in 0..S::F64_LANES.min(count - place) {
                    let denominator = lane::<S>(homogeneous[0][3], l);
                    if settle(denominator, triangle.bound(place + l), &mut out, place + l) {
                        pole.fetch_min(first + place + l, Ordering::Relaxed);
                    }
                }
            }
            place += S::F64_LANES;
        }
    }
}

/// 1 − u − v, as [`last_barycentric`] has it.
#[inline(always)]
fn last<S: Lanes>(simd: S, u: S::f64s, v: S::f64s) -> S::f64s {
    let (mut sum, mut lost) = (simd.splat_f64s(1.0), simd.splat_f64s(0.0));
    for x in [u, v] {
        let next = simd.sub_f64s(sum, x);
        let taken = simd.sub_f64s(sum, next);
        let of_sum = simd.sub_f64s(sum, simd.add_f64s(next, taken));
        lost = simd.add_f64s(lost, simd.add_f64s(of_sum, simd.sub_f64s(taken, x)));
        sum = next;
    }
    simd.add_f64s(sum, lost)
}

/// `Σᵢ λ₁ⁱ Σ_{j+k=n−i} λ₂ʲ λ₃ᵏ q_ijk`.
///
/// A term takes i − 1, j − 1 and 3k − 1 roundings of powers (λ₃ having two of its own), 1 of their product, 4 of q, j + 1 additions
/// in its row and i + 1 after it: at most 3n + 4.
#[inline(always)]
fn sum<S: Lanes, const D: usize>(
    simd: S,
    powers: &[[S::f64s; MOST + 1]; 3],
    degree: usize,
    net: &[[f64; D]],
) -> [S::f64s; D] {
    let mut sum = [simd.splat_f64s(0.0); D];
    let mut first = 0;
    for rest in 0..=degree {
        let mut row = [simd.splat_f64s(0.0); D];
        for k in 0..=rest {
            let power = simd.mul_f64s(powers[1][rest - k], powers[2][k]);
            let point = &net[first + k];
            for c in 0..D {
                row[c] = simd.mul_add_f64s(power, simd.splat_f64s(point[c]), row[c]);
            }
        }
        first += rest + 1;
        for c in 0..D {
            sum[c] = simd.mul_add_f64s(powers[0][degree - rest], row[c], sum[c]);
        }
    }
    sum
}
