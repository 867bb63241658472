//! Between the Bernstein and the power basis.
//!
//! Both ways are blossoms: with a power basis the coefficient of tⁱ, divided by C(n,i), is the blossom with i
//! arguments at infinity and the others at 0; with Bernstein points over `[a, b]`, the arguments are a and b. So
//! one scheme does either conversion over any interval, without going through `[0, 1]`, where the
//! contributions would be larger than they need be. The problem itself is ill-conditioned: from Bernstein to
//! power the scale grows as 3ⁿ on `[0, 1]`, and on intervals that are far from 0 for their length much faster.

use crate::interval::nested_barycentric;
use crate::line::{Line, check_length, counts, degree_of, each_line, net_size};
use crate::{BernsteinError, Point, binomial};

/// From the power basis to the Bernstein basis over `[a, b]`: `Σ aᵢ tⁱ = Σ Bⱼⁿ(s) Pⱼ` for `t = (1−s) a + s b`,
/// that is `Pⱼ = Σᵢ aᵢ / C(n,i) Σ_l C(j,l) C(n−j,i−l) bˡ aⁱ⁻ˡ`.
///
/// Any a and b, also a = b and a > b. Error of each point: at most `4(n+2)·u` times that sum of absolute values.
/// Cost: 3n² operations a component.
///
/// ```
/// use casteljau_bernstein::from_power;
/// let mut points = [0.0; 3];
/// from_power(&[0.0, 0.0, 1.0], [-1.0, 1.0], &mut points)?; // t²
/// assert_eq!(points, [1.0, -1.0, 1.0]);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
///
/// # Errors
/// [`BernsteinError::NoPoints`], [`BernsteinError::Degree`], [`BernsteinError::BufferLength`].
///
/// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 5.7 and 4.4.
pub fn from_power<P: Point>(
    coefficients: &[P],
    interval: [f64; 2],
    out: &mut [P],
) -> Result<(), BernsteinError> {
    from_power_tensor(coefficients, [degree_of(coefficients)?], [interval], out)
}

/// From the power basis to the Bernstein basis over a product of intervals: [`from_power`] along each axis, for
/// `ΣΣ aᵢⱼ uⁱ vʲ` and its like in one and three variables, coefficients in the order of control points.
///
/// Error of each point: at most `4(Σ degrees + 2D)·u` times its sum of absolute values.
///
/// # Errors
/// [`BernsteinError::Degree`], [`BernsteinError::BufferLength`].
pub fn from_power_tensor<P: Point, const D: usize>(
    coefficients: &[P],
    degrees: [usize; D],
    intervals: [[f64; 2]; D],
    out: &mut [P],
) -> Result<(), BernsteinError> {
    check_length("coefficients", coefficients.len(), net_size(degrees)?)?;
    check_length("out", out.len(), coefficients.len())?;
    out.copy_from_slice(coefficients);
    let counts = counts(degrees);
    for (axis, interval) in intervals.into_iter().enumerate() {
        each_line(out, counts, counts, axis, |mut line| from_power_line(&mut line, degrees[axis], interval));
    }
    Ok(())
}

/// From the Bernstein basis over `[a, b]` to the power basis: the `aᵢ` with `Σ aᵢ tⁱ = Σ Bⱼⁿ(s) Pⱼ`,
/// `s = (t−a)/(b−a)`; that is `aᵢ = C(n,i)/(b−a)ⁿ Σⱼ C(n−i,j) bⁿ⁻ⁱ⁻ʲ (−a)ʲ ΔⁱPⱼ`.
///
/// Error of each coefficient: at most `4(n+2)·u` times that sum, with every term and every part of Δⁱ taken
/// absolutely. Cost: 2n² operations a component.
///
/// ```
/// use casteljau_bernstein::to_power;
/// let mut coefficients = [0.0; 3];
/// to_power(&[1.0, -1.0, 1.0], [-1.0, 1.0], &mut coefficients)?;
/// assert_eq!(coefficients, [0.0, 0.0, 1.0]);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
///
/// # Errors
/// [`BernsteinError::NoPoints`], [`BernsteinError::Degree`], [`BernsteinError::BufferLength`];
/// [`BernsteinError::EmptyInterval`] where a = b.
pub fn to_power<P: Point>(points: &[P], interval: [f64; 2], out: &mut [P]) -> Result<(), BernsteinError> {
    to_power_tensor(points, [degree_of(points)?], [interval], out)
}

/// From the Bernstein basis over a product of intervals to the power basis: [`to_power`] along each axis.
///
/// Error of each coefficient: at most `4(Σ degrees + 2D)·u` times its sum of absolute values.
///
/// # Errors
/// [`BernsteinError::Degree`], [`BernsteinError::BufferLength`], [`BernsteinError::EmptyInterval`].
pub fn to_power_tensor<P: Point, const D: usize>(
    points: &[P],
    degrees: [usize; D],
    intervals: [[f64; 2]; D],
    out: &mut [P],
) -> Result<(), BernsteinError> {
    check_length("points", points.len(), net_size(degrees)?)?;
    check_length("out", out.len(), points.len())?;
    for [start, end] in intervals {
        if start == end {
            return Err(BernsteinError::EmptyInterval { start });
        }
    }
    out.copy_from_slice(points);
    let counts = counts(degrees);
    for (axis, interval) in intervals.into_iter().enumerate() {
        each_line(out, counts, counts, axis, |mut line| to_power_line(&mut line, degrees[axis], interval));
    }
    Ok(())
}

/// Levels at a, each evaluated at b, as for [`restrict`](crate::restrict); here a level of the scheme is
/// `dᵢ ← dᵢ + t dᵢ₊₁`.
fn from_power_line<P: Point>(line: &mut Line<'_, P>, n: usize, [a, b]: [f64; 2]) {
    for i in 1..n {
        line[i] = line[i] / binomial(n, i);
    }
    for last in (0..=n).rev() {
        // Σ C(last,i) bⁱ dᵢ by Horner's rule, with C(m,i+1)/C(m,i) = (m−i)/(i+1).
        let mut point = line[last];
        for i in (0..last).rev() {
            point = line[i] + point * (b * (last - i) as f64) / (i + 1) as f64;
        }
        for i in 0..last {
            line[i] = line[i] + line[i + 1] * a;
        }
        line[last] = point;
    }
}

/// Differences, each evaluated at 0, whose barycentric coordinates are b/(b−a) and −a/(b−a).
fn to_power_line<P: Point>(line: &mut Line<'_, P>, n: usize, [a, b]: [f64; 2]) {
    let length = b - a;
    let (s, t) = (b / length, -a / length);
    for last in (0..=n).rev() {
        let coefficient = nested_barycentric(last, s, t, line.first(last + 1)) * binomial(n, last);
        for i in 0..last {
            line[i] = (line[i + 1] - line[i]) / length;
        }
        line[last] = coefficient;
    }
    // The place `last` holds the coefficient of order n − last.
    for i in 0..n.div_ceil(2) {
        let (low, high) = (line[i], line[n - i]);
        line[i] = high;
        line[n - i] = low;
    }
}
