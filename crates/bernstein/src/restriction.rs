//! Polynomials over part of their domain, or beyond it.

use crate::blossom::step_line;
use crate::interval::nested;
use crate::line::{Line, check_axis, check_length, counts, degree_of, each_line, net_size};
use crate::{BernsteinError, Point};

/// Restriction to an interval `[a, b]`, brought to `[0, 1]`: q with `q(s) = p((1−s) a + s b)`.
///
/// `Qᵢ = p[a, …, a, b, …, b]` is the blossom with n − i times a and i times b: levels of de Casteljau's algorithm
/// at a, each evaluated at b. No division, so that a = b, a > b (a polynomial run backwards, [1, 0] reverses the
/// points to the bit) and intervals outside `[0, 1]` are served alike. The ends are `value(points, a)` and
/// `value(points, b)` to the bit, so neighbours meet. Error of each point: at most `4(n+2)·u` times its
/// combination of absolute values; outside `[0, 1]` the combination is not convex, and grows as
/// `(|1−t| + |t|)ⁿ`. Cost: 2n² operations a component.
///
/// ```
/// use casteljau_bernstein::restrict;
/// let mut half = [0.0; 3];
/// restrict(&[0.0, 0.0, 1.0], [0.5, 1.0], &mut half)?; // t² from ½ to 1
/// assert_eq!(half, [0.25, 0.5, 1.0]);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
///
/// # Errors
/// [`BernsteinError::NoPoints`], [`BernsteinError::Degree`]; [`BernsteinError::BufferLength`] where `out` has
/// another length than `points`.
///
/// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 5.4 (blossoms).
pub fn restrict<P: Point>(points: &[P], interval: [f64; 2], out: &mut [P]) -> Result<(), BernsteinError> {
    restrict_tensor(points, [degree_of(points)?], [interval], out)
}

/// Restriction of a net along one axis to `[a, b]`: [`restrict`] on each of its lines.
///
/// # Errors
/// [`BernsteinError::Axis`], [`BernsteinError::Degree`], [`BernsteinError::BufferLength`].
pub fn restrict_along<P: Point, const D: usize>(
    points: &[P],
    degrees: [usize; D],
    axis: usize,
    interval: [f64; 2],
    out: &mut [P],
) -> Result<(), BernsteinError> {
    check_axis(points, degrees, axis)?;
    check_length("out", out.len(), points.len())?;
    out.copy_from_slice(points);
    restrict_in_place(out, degrees, axis, interval);
    Ok(())
}

/// Restriction of a net to a rectangle or box, the product of one interval an axis, brought to `[0, 1]ᴰ`.
///
/// Axes with `[0, 1]` are left as they are. Error of each point: at most `4(Σ degrees + 2)·u` times its
/// combination of absolute values.
///
/// # Errors
/// [`BernsteinError::Degree`], [`BernsteinError::BufferLength`].
pub fn restrict_tensor<P: Point, const D: usize>(
    points: &[P],
    degrees: [usize; D],
    intervals: [[f64; 2]; D],
    out: &mut [P],
) -> Result<(), BernsteinError> {
    check_length("points", points.len(), net_size(degrees)?)?;
    check_length("out", out.len(), points.len())?;
    out.copy_from_slice(points);
    for (axis, interval) in intervals.into_iter().enumerate() {
        if interval != [0.0, 1.0] {
            restrict_in_place(out, degrees, axis, interval);
        }
    }
    Ok(())
}

fn restrict_in_place<P: Point, const D: usize>(
    net: &mut [P],
    degrees: [usize; D],
    axis: usize,
    interval: [f64; 2],
) {
    let counts = counts(degrees);
    each_line(net, counts, counts, axis, |mut line| restrict_line(&mut line, degrees[axis], interval));
}

/// [`restrict`] in place. The point made last of a level goes to the place that the next level leaves free.
pub(crate) fn restrict_line<P: Point>(line: &mut Line<'_, P>, n: usize, [a, b]: [f64; 2]) {
    let start = nested(n, a, line.first(n + 1));
    for last in (0..=n).rev() {
        let point = nested(last, b, line.first(last + 1));
        if last > 0 {
            step_line(line, last - 1, a);
        }
        line[last] = point;
    }
    line[0] = start;
}
