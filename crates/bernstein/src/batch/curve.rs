//! One curve at many parameters.

use pulp::bytemuck::{cast_slice, cast_slice_mut};

use super::blocks::{each, load};
use super::coefficients::scaled_differences;
use super::horner::{Parameter, reversed_interval};
use super::parallel::{CHUNK, each_chunk};
use super::quotient::is_tame;
use super::simd::{Job, Lanes, dispatch};
use super::{BatchPoint, check_length, rational};
use crate::glam::{DVec3, DVec4};
use crate::{BernsteinError, MAX_DEGREE};

/// A curve, `p(t) = Σ Bᵢⁿ(t) Pᵢ`, made ready to be evaluated at many parameters.
///
/// ```
/// use casteljau_bernstein::{CurveBatch, glam::DVec2};
/// let parabola = CurveBatch::new(&[DVec2::ZERO, DVec2::new(0.5, 0.0), DVec2::ONE])?; // (t, t²)
/// let (mut points, mut tangents) = ([DVec2::ZERO; 3], [DVec2::ZERO; 3]);
/// parabola.evaluate(&[0.0, 0.5, 3.0], [&mut points, &mut tangents])?;
/// assert_eq!(points, [DVec2::ZERO, DVec2::new(0.5, 0.25), DVec2::new(3.0, 9.0)]);
/// assert_eq!(tangents[2], DVec2::new(1.0, 6.0));
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
#[derive(Debug, Clone)]
pub struct CurveBatch<P> {
    coefficients: Coefficients,
    points: std::marker::PhantomData<P>,
}

/// `n!/(n−k)! · C(n−k,i) · Δᵏ Pᵢ` for k = 0, 1, 2, flat.
#[derive(Debug, Clone)]
pub(super) struct Coefficients {
    pub(super) degree: usize,
    /// The fourth components, the weights of a rational curve; none in other dimensions.
    pub(super) weights: Vec<f64>,
    /// Whether nothing can go wrong with a quotient inside `[0, 1]`, see [`is_tame`].
    pub(super) tame: bool,
    pub(super) of_order: [Vec<f64>; 3],
}

impl Coefficients {
    pub(super) fn new<P: BatchPoint>(points: &[P]) -> Result<Self, BernsteinError> {
        let degree = points.len().checked_sub(1).ok_or(BernsteinError::NoPoints)?;
        if degree > MAX_DEGREE {
            return Err(BernsteinError::Degree { degree, limit: MAX_DEGREE });
        }
        let of_order = [0, 1, 2].map(|k| scaled_differences(cast_slice(points), P::DIMENSION, k));
        let fourth = cast_slice::<P, f64>(points).iter().skip(3).step_by(P::DIMENSION);
        let weights = if P::DIMENSION == 4 { fourth.copied().collect() } else { Vec::new() };
        let tame = P::DIMENSION == 4 && is_tame(cast_slice(points));
        Ok(Self { degree, weights, tame, of_order })
    }
}

impl<P: BatchPoint> CurveBatch<P> {
    /// Prepares the curve with the given control points; their number less one is its degree n.
    ///
    /// Cost: 3(n+1) points of memory, about as many operations a component as five evaluations.
    ///
    /// # Errors
    /// [`BernsteinError::NoPoints`], [`BernsteinError::Degree`] above [`MAX_DEGREE`].
    pub fn new(points: &[P]) -> Result<Self, BernsteinError> {
        Ok(Self { coefficients: Coefficients::new(points)?, points: std::marker::PhantomData })
    }

    /// Degree n.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.coefficients.degree
    }

    /// Values and derivatives, `out[k][i] = dᵏp/dtᵏ(tᵢ)`, k = 0…K−1, where K is 1, 2 or 3.
    ///
    /// Any parameters. The ends are met to the bit. Error: at most `4(n + 2k + 2)·u·scale`, see [the
    /// crate](crate). Cost: one multiply-add a component and control point, one division, and about 2 log₂ n
    /// multiplications.
    ///
    /// # Errors
    /// [`BernsteinError::BufferLength`] unless every buffer has the length of `parameters`.
    pub fn evaluate<const K: usize>(
        &self,
        parameters: &[f64],
        out: [&mut [P]; K],
    ) -> Result<(), BernsteinError> {
        const { assert!(1 <= K && K <= 3, "values, first and second derivatives") };
        for out in &out {
            check_length("out", parameters.len(), out.len())?;
        }
        let mut out = out.map(cast_slice_mut::<P, f64>);
        evaluate(&self.coefficients, P::DIMENSION, parameters, &mut out);
        Ok(())
    }
}

impl CurveBatch<DVec4> {
    /// As [`evaluate`](Self::evaluate), for a rational curve with the control points `(w·x, w·y, w·z, w)`:
    /// points and derivatives in space, by the quotient rule.
    ///
    /// Error: that of numerator and denominator, magnified by 1/|w| once an order.
    ///
    /// # Errors
    /// [`BernsteinError::BufferLength`], and [`BernsteinError::Pole`] with the first place where the
    /// denominator vanishes within its rounding error, or the quotient is out of range; the buffers hold 0 at
    /// such places, and the answers everywhere else.
    pub fn evaluate_rational<const K: usize>(
        &self,
        parameters: &[f64],
        out: [&mut [DVec3]; K],
    ) -> Result<(), BernsteinError> {
        const { assert!(1 <= K && K <= 3, "values, first and second derivatives") };
        for out in &out {
            check_length("out", parameters.len(), out.len())?;
        }
        let mut out = out.map(cast_slice_mut::<DVec3, f64>);
        rational::evaluate(&self.coefficients, parameters, &mut out)
    }
}

/// Not generic, so that the kernels are compiled with this crate and once.
fn evaluate(coefficients: &Coefficients, dimension: usize, parameters: &[f64], out: &mut [&mut [f64]]) {
    match out {
        [a] => chunks(coefficients, dimension, parameters, [a]),
        [a, b] => chunks(coefficients, dimension, parameters, [a, b]),
        [a, b, c] => chunks(coefficients, dimension, parameters, [a, b, c]),
        _ => {}
    }
}

fn chunks<const K: usize>(
    coefficients: &Coefficients,
    dimension: usize,
    parameters: &[f64],
    out: [&mut [f64]; K],
) {
    let out = out.map(|out| out.chunks_mut(CHUNK * dimension));
    let interval = reversed_interval(coefficients.degree);
    each_chunk(parameters.chunks(CHUNK), out, |parameters, out| {
        dispatch(dimension, Values { coefficients, interval, parameters, out });
    });
}

struct Values<'a, const K: usize> {
    coefficients: &'a Coefficients,
    interval: [f64; 2],
    parameters: &'a [f64],
    out: [&'a mut [f64]; K],
}

impl<const K: usize> Job for Values<'_, K> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes, const D: usize>(self, simd: S) {
        let [q0, q1, q2] = &self.coefficients.of_order;
        let q = [q0, q1, q2].map(|q| q.as_chunks::<D>().0);
        each(
            simd,
            self.parameters.len(),
            self.out,
            #[inline(always)]
            |place| {
                let t = Parameter::new(simd, load(simd, self.parameters, place), self.interval);
                if t.some { jet::<S, D, K, true>(simd, &t, q) } else { jet::<S, D, K, false>(simd, &t, q) }
            },
        );
    }
}

/// The first `K` derivatives.
#[inline(always)]
fn jet<S: Lanes, const D: usize, const K: usize, const MIXED: bool>(
    simd: S,
    t: &Parameter<S>,
    coefficients: [&[[f64; D]]; 3],
) -> [[S::f64s; D]; K] {
    let mut points = [[simd.splat_f64s(0.0); D]; K];
    for k in 0..K {
        points[k] = t.value::<D, MIXED>(coefficients[k]);
    }
    points
}
