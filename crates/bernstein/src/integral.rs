//! Integrals and moments.

use crate::line::{check_axis, check_length, counts, degree_of, each_line, net_size, spread};
use crate::restriction::restrict_tensor;
use crate::space::last_lines;
use crate::{BernsteinError, Point};

/// Integral over `[0, 1]`, `∫₀¹ p(t) dt = Σ Pᵢ / (n+1)`; of a tensor product over the unit square or cube. In
/// every case it is the mean of the control points.
///
/// No points give zero. Error: at most `(log₂ N + 5)·u·Σ|Pᵢ|/N` for N points.
///
/// ```
/// assert_eq!(casteljau_bernstein::integral(&[0.0, 0.0, 1.0]), 1.0 / 3.0); // t²
/// ```
///
/// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 6.7.
#[must_use]
pub fn integral<P: Point>(points: &[P]) -> P {
    if points.is_empty() { P::ZERO } else { pairwise_sum(points) / points.len() as f64 }
}

/// Sum by halves: the error grows with the logarithm of the number.
fn pairwise_sum<P: Point>(points: &[P]) -> P {
    match points {
        [] => P::ZERO,
        [p] => *p,
        _ => {
            let (a, b) = points.split_at(points.len() / 2);
            pairwise_sum(a) + pairwise_sum(b)
        }
    }
}

/// Integral over a part of the interval, `∫ₐᵇ p(t) dt`, which changes sign with the order of a and b.
///
/// It is b − a times the mean of the points of p restricted to `[a, b]`: no cancellation between values of an
/// antiderivative. `work` holds as many points as `points`; its content is lost. Error: at most `4(n+4)·u` times
/// |b − a| times the mean of the scales of [`restrict`](crate::restrict).
///
/// # Errors
/// [`BernsteinError::NoPoints`], [`BernsteinError::Degree`], [`BernsteinError::BufferLength`].
pub fn integral_over<P: Point>(
    points: &[P],
    interval: [f64; 2],
    work: &mut [P],
) -> Result<P, BernsteinError> {
    integral_over_tensor(points, [degree_of(points)?], [interval], work)
}

/// Integral of a tensor product over a product of intervals.
///
/// `work` holds as many points as the net. Error: at most `4(Σ degrees + 4D)·u` times the volume times the mean
/// of the scales of [`restrict_tensor`].
///
/// # Errors
/// [`BernsteinError::Degree`], [`BernsteinError::BufferLength`].
pub fn integral_over_tensor<P: Point, const D: usize>(
    points: &[P],
    degrees: [usize; D],
    intervals: [[f64; 2]; D],
    work: &mut [P],
) -> Result<P, BernsteinError> {
    check_length("work", work.len(), points.len())?;
    restrict_tensor(points, degrees, intervals, work)?;
    Ok(intervals.iter().fold(integral(work), |integral, [a, b]| integral * (b - a)))
}

/// Moment of order k, `∫₀¹ tᵏ p(t) dt = 1/(n+k+1) Σ Pᵢ Πⱼ₌₁ᵏ (i+j)/(n+j)`.
///
/// Positive weights only. Error: at most `4(n + k + 2)·u` times the sum of absolute values. Cost: O(nk).
///
/// ```
/// use casteljau_bernstein::moment;
/// assert_eq!(moment(&[0.0, 1.0], 2)?, 0.25); // ∫ t²·t dt
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
///
/// # Errors
/// [`BernsteinError::NoPoints`], [`BernsteinError::Degree`].
pub fn moment<P: Point>(points: &[P], order: usize) -> Result<P, BernsteinError> {
    moment_tensor(points, [degree_of(points)?], [order])
}

/// Moment of a tensor product, `∫∫ uᵏ vˡ p(u,v) du dv` and its like in three variables.
///
/// Error: at most `4(Σ (degree + order) + 2D)·u` times the sum of absolute values.
///
/// # Errors
/// [`BernsteinError::Degree`], [`BernsteinError::BufferLength`].
pub fn moment_tensor<P: Point, const D: usize>(
    points: &[P],
    degrees: [usize; D],
    orders: [usize; D],
) -> Result<P, BernsteinError> {
    check_length("points", points.len(), net_size(degrees)?)?;
    let Some(last) = D.checked_sub(1) else { return Ok(integral(points)) };
    let weight = |axis: usize, i: usize| {
        let (n, k) = (degrees[axis], orders[axis]);
        (1..=k).fold(1.0 / (n + k + 1) as f64, |w, j| w * (i + j) as f64 / (n + j) as f64)
    };
    let mut sum = P::ZERO;
    for (index, line) in last_lines(points, degrees) {
        let across = (0..last).map(|axis| weight(axis, index[axis])).product::<f64>();
        let along = line.iter().enumerate().fold(P::ZERO, |sum, (i, &p)| sum + p * weight(last, i));
        sum = sum + along * across;
    }
    Ok(sum)
}

/// The indefinite integral that is 0 at t = 0, of degree n + 1: `Q₀ = 0`, `Qᵢ₊₁ = Qᵢ + Pᵢ/(n+1)`.
///
/// `out` holds n + 2 points. Error of each point: at most `(n+2)·u·Σ|Pᵢ|/(n+1)` over the points up to it.
///
/// # Errors
/// [`BernsteinError::NoPoints`], [`BernsteinError::Degree`], [`BernsteinError::BufferLength`].
pub fn antiderivative<P: Point>(points: &[P], out: &mut [P]) -> Result<(), BernsteinError> {
    antiderivative_along(points, [degree_of(points)?], 0, out)
}

/// The indefinite integral along one axis of a net, 0 where that parameter is: the degree along it rises by
/// one.
///
/// # Errors
/// [`BernsteinError::Axis`], [`BernsteinError::Degree`], [`BernsteinError::BufferLength`].
pub fn antiderivative_along<P: Point, const D: usize>(
    points: &[P],
    degrees: [usize; D],
    axis: usize,
    out: &mut [P],
) -> Result<(), BernsteinError> {
    check_axis(points, degrees, axis)?;
    let mut higher = degrees;
    higher[axis] += 1;
    check_length("out", out.len(), net_size(higher)?)?;
    let (used, room) = (counts(degrees), counts(higher));
    spread(points, used, out, room);
    let count = used[axis];
    each_line(out, room, used, axis, |mut line| {
        let mut sum = P::ZERO;
        for i in 0..=count {
            let next = if i < count { sum + line[i] } else { sum };
            line[i] = sum / count as f64;
            sum = next;
        }
    });
    Ok(())
}
