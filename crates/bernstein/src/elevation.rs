//! The same polynomial at a higher degree.

use crate::line::{Line, check_axis, check_length, counts, each_line, net_size, spread};
use crate::{BernsteinError, MAX_DEGREE, Point};

/// Degree elevation from n to m: `Σ Bᵢⁿ Pᵢ = Σ Bⱼᵐ Qⱼ`, with n + 1 points given and m + 1 the length of `out`.
///
/// One degree at a time, `Qᵢ = (i Pᵢ₋₁ + (n+1−i) Pᵢ) / (n+1)`: convex combinations only. The end points are
/// kept to the bit. Error: at most `4(m+2)·u` times the same combination of absolute values. Cost:
/// (m−n)(m+n)/2 combinations.
///
/// # Errors
/// [`BernsteinError::NoPoints`] without points, [`BernsteinError::BufferLength`] where `out` is shorter than
/// `points`, [`BernsteinError::Degree`] above [`MAX_DEGREE`].
///
/// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 6.1.
pub fn elevate<P: Point>(points: &[P], out: &mut [P]) -> Result<(), BernsteinError> {
    let (count, given) = (points.len(), out.len());
    if count == 0 {
        return Err(BernsteinError::NoPoints);
    }
    if given < count {
        return Err(BernsteinError::BufferLength { buffer: "out", needed: count, given });
    }
    if given > MAX_DEGREE + 1 {
        return Err(BernsteinError::Degree { degree: given - 1, limit: MAX_DEGREE });
    }
    out[..count].copy_from_slice(points);
    elevate_line(&mut Line::whole(out), count, given);
    Ok(())
}

/// Elevation of the first `count` points of a line to `to` points, in place.
pub(crate) fn elevate_line<P: Point>(line: &mut Line<'_, P>, count: usize, to: usize) {
    for degree in count..to {
        line[degree] = line[degree - 1];
        for i in (1..degree).rev() {
            line[i] = (line[i - 1] * i as f64 + line[i] * (degree - i) as f64) / degree as f64;
        }
    }
}

/// Degree elevation of a net along one axis: [`elevate`] on each of its lines, from `degrees[axis]` to `to`.
///
/// `out` is a net of the new degrees. Error of each point: at most `4(to+2)·u` times its combination of
/// absolute values.
///
/// ```
/// use casteljau_bernstein::elevate_along;
/// let mut out = [0.0; 6];
/// elevate_along(&[0.0, 1.0, 2.0, 4.0], [1, 1], 1, 2, &mut out)?;
/// assert_eq!(out, [0.0, 0.5, 1.0, 2.0, 3.0, 4.0]);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
///
/// # Errors
/// [`BernsteinError::Axis`], [`BernsteinError::Degree`], [`BernsteinError::ElevatedDegree`] where `to` is below
/// the degree, [`BernsteinError::BufferLength`].
pub fn elevate_along<P: Point, const D: usize>(
    points: &[P],
    degrees: [usize; D],
    axis: usize,
    to: usize,
    out: &mut [P],
) -> Result<(), BernsteinError> {
    check_axis(points, degrees, axis)?;
    let mut higher = degrees;
    higher[axis] = to;
    elevate_tensor(points, degrees, higher, out)
}

/// Degree elevation of a net along all axes, one after another.
///
/// Error of each point: at most `4(Σ degrees + 2)·u` times its combination of absolute values, with the new
/// degrees.
///
/// # Errors
/// [`BernsteinError::Degree`], [`BernsteinError::ElevatedDegree`] where a new degree is below the old one,
/// [`BernsteinError::BufferLength`].
pub fn elevate_tensor<P: Point, const D: usize>(
    points: &[P],
    degrees: [usize; D],
    to: [usize; D],
    out: &mut [P],
) -> Result<(), BernsteinError> {
    check_length("points", points.len(), net_size(degrees)?)?;
    check_length("out", out.len(), net_size(to)?)?;
    for (from, to) in degrees.into_iter().zip(to) {
        if to < from {
            return Err(BernsteinError::ElevatedDegree { from, to });
        }
    }
    let room = counts(to);
    let mut used = counts(degrees);
    spread(points, used, out, room);
    for axis in 0..D {
        let count = used[axis];
        each_line(out, room, used, axis, |mut line| elevate_line(&mut line, count, room[axis]));
        used[axis] = room[axis];
    }
    Ok(())
}
