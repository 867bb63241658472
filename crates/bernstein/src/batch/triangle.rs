//! One triangle at scattered parameters.
//!
//! The powers of the three barycentric coordinates are made once for all kinds of derivatives; a control point
//! then takes one multiplication, and one multiply-add a component.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use pulp::bytemuck::{cast_slice, cast_slice_mut};

use super::BatchPoint;
use super::nets::ORDERS;
use super::scattered::{self, Form, check_lengths, one_by_one, rational_one_by_one};
use super::simd::Lanes;
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
        check_lengths(parameters, &out)?;
        if self.scaled.is_empty() {
            let mut out = out;
            one_by_one(parameters, &mut out, |at, jet| self.partials(at, jet));
            return Ok(());
        }
        self.view().plain(P::DIMENSION, cast_slice(parameters), &mut out.map(cast_slice_mut::<P, f64>))
    }

    fn partials(&self, at: DVec2, jet: &mut [P]) {
        TriangleNet::validated(&self.net, self.degree).partials(barycentric(at), jet);
    }

    fn view(&self) -> View<'_> {
        View { net: cast_slice(&self.net), degree: self.degree, scaled: &self.scaled }
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
        check_lengths(parameters, &out)?;
        let mut out = out.map(cast_slice_mut::<DVec3, f64>);
        if self.scaled.is_empty() {
            return rational_one_by_one(self.view(), parameters, &mut out, |at, jet| self.partials(at, jet));
        }
        self.view().rational(cast_slice(parameters), &mut out)
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

#[derive(Clone, Copy)]
struct View<'a> {
    net: &'a [f64],
    degree: usize,
    scaled: &'a [Vec<f64>],
}

impl View<'_> {
    fn plain(
        self,
        dimension: usize,
        parameters: &[f64],
        out: &mut [&mut [f64]],
    ) -> Result<(), BernsteinError> {
        scattered::surface::<_, false>(self, dimension, parameters, out)
    }

    fn rational(self, parameters: &[f64], out: &mut [&mut [f64]]) -> Result<(), BernsteinError> {
        scattered::surface::<_, true>(self, 4, parameters, out)
    }
}

impl Form<2> for View<'_> {
    /// The powers of the three barycentric coordinates.
    type At<S: Lanes> = [[S::f64s; MOST + 1]; 3];

    fn net(&self) -> &[f64] {
        self.net
    }

    fn degree(&self) -> usize {
        self.degree
    }

    #[inline(always)]
    fn at<S: Lanes>(&self, simd: S) -> Self::At<S> {
        [[simd.splat_f64s(1.0); MOST + 1]; 3]
    }

    #[inline(always)]
    fn move_to<S: Lanes>(&self, simd: S, powers: &mut Self::At<S>, [u, v]: [S::f64s; 2]) {
        let lambda = [u, v, last(simd, [u, v])];
        for a in 0..3 {
            let mut power = lambda[a];
            for i in 1..=self.degree.max(1) {
                powers[a][i] = power;
                power = simd.mul_f64s(power, lambda[a]);
            }
        }
    }

    #[inline(always)]
    fn jet<S: Lanes, const D: usize, const K: usize>(
        &self,
        simd: S,
        powers: &Self::At<S>,
    ) -> [[S::f64s; D]; K] {
        let mut jet = [[simd.splat_f64s(0.0); D]; K];
        for k in 0..K {
            let [a, b] = ORDERS[k];
            if let Some(lower) = self.degree.checked_sub(a + b) {
                jet[k] = sum(simd, powers, lower, self.scaled[k].as_chunks().0);
            }
        }
        jet
    }

    /// (|λ₁| + |λ₂| + |λ₃|)ⁿ.
    #[inline(always)]
    fn spread<S: Lanes>(&self, simd: S, powers: &Self::At<S>) -> S::f64s {
        let size = |a: usize| simd.abs_f64s(powers[a][1]);
        simd.power(simd.add_f64s(simd.add_f64s(size(0), size(1)), size(2)), self.degree)
    }

    #[cold]
    fn scale(&self, at: [f64; 2], basis: &mut Vec<f64>) -> f64 {
        basis.resize(self.net.len() / 4, 0.0);
        if simplex_basis(self.degree, barycentric(at.into()), basis).is_err() {
            return f64::INFINITY; // never: the net was checked
        }
        basis.iter().zip(self.net.chunks_exact(4)).map(|(b, p)| (b * p[3]).abs()).sum()
    }
}

/// 1 − Σ of the others, as [`last_barycentric`] has it.
#[inline(always)]
pub(super) fn last<S: Lanes, const N: usize>(simd: S, others: [S::f64s; N]) -> S::f64s {
    let (mut sum, mut lost) = (simd.splat_f64s(1.0), simd.splat_f64s(0.0));
    for a in 0..N {
        let x = others[a];
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
