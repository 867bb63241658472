//! One tensor-product patch at scattered parameters.
//!
//! Of a low total degree each polynomial is nested Horner schemes in x = u/(1−u) and y = v/(1−v), as in
//! `horner.rs`: one multiply-add a control point and component. The lanes where u or v is 1, and patches of
//! higher degree, take the basis of both parameters and add up rows first.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use std::sync::atomic::{AtomicUsize, Ordering};

use pulp::Scalar;
use pulp::bytemuck::{cast_slice, cast_slice_mut};

use super::blocks::store;
use super::horner::ONE_SIDED;
use super::nets::{Nets, ORDERS};
use super::parallel::{CHUNK, each_chunk};
use super::patch_kernel::{At, BASIS, BICUBIC, MAX_BASIS, QUOTIENTS, load_pairs};
use super::quotient::{lane, largest_weight, refuse_pole, scale, settle, surface, suspicious, uncertainty};
use super::simd::{Job, Lanes, dispatch, dispatch_in};
use super::{BatchPoint, check_length};
use crate::glam::{DVec2, DVec3, DVec4};
use crate::{BernsteinError, MAX_DEGREE, TensorNet, basis, binomial};

/// A tensor-product patch, `p(u,v) = Σᵢ Σⱼ Bᵢᵐ(u) Bⱼⁿ(v) Pᵢⱼ`, made ready to be evaluated at many scattered
/// parameters.
///
/// For parameters that form a grid, [`GridBatch`](crate::GridBatch) takes a fraction of the time.
///
/// ```
/// use casteljau_bernstein::{PatchBatch, glam::DVec2};
/// let patch = PatchBatch::new(&[0.0, 0.0, 0.0, 1.0], [1, 1])?; // u·v
/// let [mut value, mut in_u, mut in_v] = [[0.0; 2]; 3];
/// patch.evaluate(&[DVec2::new(0.5, 0.25), DVec2::ONE], [&mut value, &mut in_u, &mut in_v])?;
/// assert_eq!((value, in_u, in_v), ([0.125, 1.0], [0.25, 1.0], [0.5, 1.0]));
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
#[derive(Debug, Clone)]
pub struct PatchBatch<P> {
    net: Vec<P>,
    degrees: [usize; 2],
    /// The nets of all orders, without binomial factors.
    plain: Vec<Vec<f64>>,
    /// The same multiplied by `C(m−a,i)·C(n−b,j)`.
    scaled: Vec<Vec<f64>>,
}

impl<P: BatchPoint> PatchBatch<P> {
    /// Prepares the patch with the net `points` of the degrees m (with u) and n (with v), in the order of
    /// [`TensorNet`].
    ///
    /// Cost: memory for twelve nets.
    ///
    /// # Errors
    /// [`BernsteinError::NetLength`] unless there are (m+1)(n+1) points, [`BernsteinError::Degree`] above
    /// [`MAX_DEGREE`].
    pub fn new(points: &[P], degrees: [usize; 2]) -> Result<Self, BernsteinError> {
        TensorNet::new(points, degrees)?;
        let mut nets = Nets::new(degrees, P::DIMENSION, ORDERS.len());
        nets.set(cast_slice(points));
        let plain = nets.into_nets();
        let mut scaled = plain.clone();
        for (net, [a, b]) in scaled.iter_mut().zip(ORDERS) {
            let [Some(m), Some(n)] = [degrees[0].checked_sub(a), degrees[1].checked_sub(b)] else { continue };
            for (at, point) in net.chunks_exact_mut(P::DIMENSION).enumerate() {
                let factor = binomial(m, at / (n + 1)) * binomial(n, at % (n + 1));
                point.iter_mut().for_each(|x| *x *= factor);
            }
        }
        Ok(Self { net: points.to_vec(), degrees, plain, scaled })
    }

    /// Degrees m and n.
    #[must_use]
    pub fn degrees(&self) -> [usize; 2] {
        self.degrees
    }

    /// Values (K = 1), with first (K = 3) and second (K = 6) partial derivatives at the parameters (u, v),
    /// each kind in its own buffer, in the order of [`partial_index`](crate::partial_index): 1; u, v; uu, uv,
    /// vv.
    ///
    /// Error: at most `4(m + n + 2(a+b) + 2)·u·scale`, see [the crate](crate). Cost: one multiply-add a
    /// component and control point for each kind; degrees above 31 go one by one through
    /// [`TensorNet::partials`].
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
        if self.degrees.iter().any(|&d| d >= MAX_BASIS) {
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
        let net = TensorNet::validated(&self.net, self.degrees);
        let mut jet = [P::ZERO; 6];
        for (place, uv) in parameters.iter().enumerate() {
            net.partials(uv.x, uv.y, &mut jet[..kinds]);
            take(place, &jet[..kinds]);
        }
    }

    fn view<'a>(&'a self, parameters: &'a [f64]) -> View<'a> {
        View {
            net: cast_slice(&self.net),
            degrees: self.degrees,
            plain: &self.plain,
            scaled: &self.scaled,
            parameters,
        }
    }
}

impl PatchBatch<DVec4> {
    /// As [`evaluate`](Self::evaluate), for a rational net `(w·x, w·y, w·z, w)`: points and derivatives in
    /// space, by the quotient rule.
    ///
    /// Error: that of numerator and denominator, magnified by 1/|w| once an order.
    ///
    /// # Errors
    /// [`BernsteinError::BufferLength`], and [`BernsteinError::Pole`] with the first place where the
    /// denominator vanishes within its rounding error, or the quotient is out of range; the buffers hold 0 at
    /// such places, and the answers everywhere else.
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
        if self.degrees.iter().any(|&d| d >= MAX_BASIS) {
            let mut pole = usize::MAX;
            self.one_by_one(parameters, K, |place, jet| {
                let mut all = [[0.0; 4]; K];
                all.iter_mut().zip(jet).for_each(|(to, p)| *to = p.to_array());
                let points = surface(Scalar, &all);
                for (out, point) in out.iter_mut().zip(points) {
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

/// A patch and parameters as plain numbers, so that the kernels are compiled with this crate and once.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    net: &'a [f64],
    pub(super) degrees: [usize; 2],
    pub(super) plain: &'a [Vec<f64>],
    pub(super) scaled: &'a [Vec<f64>],
    /// u and v of each place.
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

    fn rational(&self, out: &mut [&mut [f64]]) -> Result<(), BernsteinError> {
        match out {
            [a] => self.rational_in([a]),
            [a, b, c] => self.rational_in([a, b, c]),
            [a, b, c, d, e, f] => self.rational_in([a, b, c, d, e, f]),
            _ => Ok(()),
        }
    }

    fn plain_in<const K: usize>(&self, dimension: usize, out: [&mut [f64]; K]) -> Result<(), BernsteinError> {
        // Bicubic patches in space have kernels of their own, with unrolled loops.
        let unrolled = dimension == 3 && self.degrees == [3, 3];
        let by_quotients = self.degrees[0] + self.degrees[1] <= ONE_SIDED;
        self.run(dimension, out, |chunk| {
            if unrolled {
                dispatch_in::<_, 3>(chunk.by::<false, BICUBIC>());
            } else if by_quotients {
                dispatch(dimension, chunk.by::<false, QUOTIENTS>());
            } else {
                dispatch(dimension, chunk.by::<false, BASIS>());
            }
        })
    }

    fn rational_in<const K: usize>(&self, out: [&mut [f64]; K]) -> Result<(), BernsteinError> {
        let by_quotients = self.degrees[0] + self.degrees[1] <= ONE_SIDED;
        self.run(3, out, |chunk| {
            if by_quotients {
                dispatch_in::<_, 4>(chunk.by::<true, QUOTIENTS>());
            } else {
                dispatch_in::<_, 4>(chunk.by::<true, BASIS>());
            }
        })
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
            let patch = View { parameters, ..*self };
            kernel(Chunk { patch, out, first: number * CHUNK, pole: &pole });
        });
        refuse_pole(pole.into_inner())
    }

    /// The rounding error of the denominator at a place.
    #[cold]
    fn bound(&self, place: usize) -> f64 {
        let [m, n] = self.degrees;
        let mut rows = [[0.0; MAX_DEGREE + 1]; 2];
        basis(self.parameters[2 * place], &mut rows[0][..=m]);
        basis(self.parameters[2 * place + 1], &mut rows[1][..=n]);
        uncertainty(m + n) * scale(self.net, &rows[0][..=m], &rows[1][..=n])
    }
}

/// Some of the parameters.
struct Chunk<'a, const K: usize> {
    patch: View<'a>,
    out: [&'a mut [f64]; K],
    /// The place of the first parameter in the whole batch.
    first: usize,
    /// The first place of a pole.
    pole: &'a AtomicUsize,
}

impl<'a, const K: usize> Chunk<'a, K> {
    /// The job to be done with these parameters.
    fn by<const RATIONAL: bool, const WAY: u8>(self) -> Scattered<'a, K, RATIONAL, WAY> {
        Scattered(self)
    }
}

struct Scattered<'a, const K: usize, const RATIONAL: bool, const WAY: u8>(Chunk<'a, K>);

impl<const K: usize, const RATIONAL: bool, const WAY: u8> Job for Scattered<'_, K, RATIONAL, WAY> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes, const D: usize>(self, simd: S) {
        let Chunk { patch, mut out, first, pole } = self.0;
        let [m, n] = patch.degrees;
        let weight = if RATIONAL { uncertainty(m + n) * largest_weight(patch.net) } else { 0.0 };
        let count = patch.parameters.len() / 2;
        let mut place = 0;
        while place < count {
            let [u, v] = load_pairs(simd, patch.parameters, place);
            let at = At::new(simd, u, v);
            let mut jet = [[simd.splat_f64s(0.0); D]; K];
            if WAY == BASIS {
                for k in 0..K {
                    jet[k] = at.by_basis(&patch, k);
                }
            } else {
                jet[0] = at.partial::<D, WAY, 0, 0>(&patch);
                // Written out: the compiler must see the orders to keep everything in registers.
                if K >= 3 {
                    jet[1] = at.partial::<D, WAY, 1, 0>(&patch);
                    jet[2] = at.partial::<D, WAY, 0, 1>(&patch);
                }
                if K >= 6 {
                    jet[3] = at.partial::<D, WAY, 2, 0>(&patch);
                    jet[4] = at.partial::<D, WAY, 1, 1>(&patch);
                    jet[5] = at.partial::<D, WAY, 0, 2>(&patch);
                }
            }
            if RATIONAL {
                let mut homogeneous = [[simd.splat_f64s(0.0); 4]; K];
                for k in 0..K {
                    for c in 0..D {
                        homogeneous[k][c] = jet[k][c];
                    }
                }
                // Σ|Bᵢ Bⱼ wᵢⱼ| is at most (|1−u| + |u|)ᵐ (|1−v| + |v|)ⁿ times the largest weight.
                let size = |s, t| simd.add_f64s(simd.abs_f64s(s), simd.abs_f64s(t));
                let spread = simd.mul_f64s(simd.power(size(at.su, u), m), simd.power(size(at.sv, v), n));
                let least = simd.mul_f64s(simd.splat_f64s(weight), spread);
                let points = surface(simd, &homogeneous);
                for k in 0..K {
                    store(simd, out[k], place, points[k]);
                }
                if simd.any(suspicious(simd, homogeneous[0][3], &points, least)) {
                    for l in 0..S::F64_LANES.min(count - place) {
                        let denominator = lane::<S>(homogeneous[0][3], l);
                        if settle(denominator, patch.bound(place + l), &mut out, place + l) {
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
