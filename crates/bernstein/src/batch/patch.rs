//! One tensor-product patch at scattered parameters.
//!
//! Of a low total degree each polynomial is nested Horner schemes in x = u/(1−u) and y = v/(1−v), as in
//! `horner.rs`: one multiply-add a control point and component. The lanes where u or v is 1, and patches of
//! higher degree, take the basis of both parameters and add up rows first.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use pulp::bytemuck::{cast_slice, cast_slice_mut};

use super::BatchPoint;
use super::horner::ONE_SIDED;
use super::nets::{Nets, ORDERS};
use super::patch_kernel::{At, BASIS, BICUBIC, MAX_BASIS, QUOTIENTS};
use super::quotient::scale;
use super::scattered::{self, Form, check_lengths, one_by_one, rational_one_by_one};
use super::simd::Lanes;
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
        check_lengths(parameters, &out)?;
        if self.has_no_kernel() {
            let mut out = out;
            one_by_one(parameters, &mut out, |at, jet| self.partials(at, jet));
            return Ok(());
        }
        self.view().plain(P::DIMENSION, cast_slice(parameters), &mut out.map(cast_slice_mut::<P, f64>))
    }

    fn has_no_kernel(&self) -> bool {
        self.degrees.iter().any(|&d| d >= MAX_BASIS)
    }

    fn partials(&self, at: DVec2, jet: &mut [P]) {
        TensorNet::validated(&self.net, self.degrees).partials(at.x, at.y, jet);
    }

    fn view(&self) -> View<'_> {
        View { net: cast_slice(&self.net), degrees: self.degrees, plain: &self.plain, scaled: &self.scaled }
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
        check_lengths(parameters, &out)?;
        let mut out = out.map(cast_slice_mut::<DVec3, f64>);
        if self.has_no_kernel() {
            let form = Tensor::<BASIS>(self.view());
            return rational_one_by_one(form, parameters, &mut out, |at, jet| self.partials(at, jet));
        }
        self.view().rational(cast_slice(parameters), &mut out)
    }
}

/// A patch as plain numbers.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    net: &'a [f64],
    pub(super) degrees: [usize; 2],
    pub(super) plain: &'a [Vec<f64>],
    pub(super) scaled: &'a [Vec<f64>],
}

impl View<'_> {
    fn plain(
        self,
        dimension: usize,
        parameters: &[f64],
        out: &mut [&mut [f64]],
    ) -> Result<(), BernsteinError> {
        // Bicubic patches in space have kernels of their own, with unrolled loops.
        if dimension == 3 && self.degrees == [3, 3] {
            scattered::surface::<_, false>(Tensor::<BICUBIC>(self), dimension, parameters, out)
        } else if self.degrees[0] + self.degrees[1] <= ONE_SIDED {
            scattered::surface::<_, false>(Tensor::<QUOTIENTS>(self), dimension, parameters, out)
        } else {
            scattered::surface::<_, false>(Tensor::<BASIS>(self), dimension, parameters, out)
        }
    }

    fn rational(self, parameters: &[f64], out: &mut [&mut [f64]]) -> Result<(), BernsteinError> {
        if self.degrees[0] + self.degrees[1] <= ONE_SIDED {
            scattered::surface::<_, true>(Tensor::<QUOTIENTS>(self), 4, parameters, out)
        } else {
            scattered::surface::<_, true>(Tensor::<BASIS>(self), 4, parameters, out)
        }
    }
}

/// A patch, to be evaluated in one of the ways of `patch_kernel.rs`.
#[derive(Clone, Copy)]
struct Tensor<'a, const WAY: u8>(View<'a>);

impl<const WAY: u8> Form<2> for Tensor<'_, WAY> {
    type At<S: Lanes> = At<S>;

    fn net(&self) -> &[f64] {
        self.0.net
    }

    fn degree(&self) -> usize {
        self.0.degrees[0] + self.0.degrees[1]
    }

    #[inline(always)]
    fn at<S: Lanes>(&self, simd: S) -> At<S> {
        At::new(simd, simd.splat_f64s(0.0), simd.splat_f64s(0.0))
    }

    #[inline(always)]
    fn move_to<S: Lanes>(&self, simd: S, at: &mut At<S>, [u, v]: [S::f64s; 2]) {
        *at = At::new(simd, u, v);
    }

    #[inline(always)]
    fn jet<S: Lanes, const D: usize, const K: usize>(&self, simd: S, at: &At<S>) -> [[S::f64s; D]; K] {
        let patch = &self.0;
        let mut jet = [[simd.splat_f64s(0.0); D]; K];
        if WAY == BASIS {
            for k in 0..K {
                jet[k] = at.by_basis(patch, k);
            }
            return jet;
        }
        jet[0] = at.partial::<D, WAY, 0, 0>(patch);
        // Written out: the compiler must see the orders to keep everything in registers.
        if K >= 3 {
            jet[1] = at.partial::<D, WAY, 1, 0>(patch);
            jet[2] = at.partial::<D, WAY, 0, 1>(patch);
        }
        if K >= 6 {
            jet[3] = at.partial::<D, WAY, 2, 0>(patch);
            jet[4] = at.partial::<D, WAY, 1, 1>(patch);
            jet[5] = at.partial::<D, WAY, 0, 2>(patch);
        }
        jet
    }

    /// (|1−u| + |u|)ᵐ (|1−v| + |v|)ⁿ.
    #[inline(always)]
    fn spread<S: Lanes>(&self, simd: S, at: &At<S>) -> S::f64s {
        let [m, n] = self.0.degrees;
        let size = |s, t| simd.add_f64s(simd.abs_f64s(s), simd.abs_f64s(t));
        simd.mul_f64s(simd.power(size(at.su, at.u), m), simd.power(size(at.sv, at.v), n))
    }

    #[cold]
    fn scale(&self, [u, v]: [f64; 2], _: &mut Vec<f64>) -> f64 {
        let [m, n] = self.0.degrees;
        let mut rows = [[0.0; MAX_DEGREE + 1]; 2];
        basis(u, &mut rows[0][..=m]);
        basis(v, &mut rows[1][..=n]);
        scale(self.0.net, &rows[0][..=m], &rows[1][..=n])
    }
}
