//! Nets seen line by line: what a kernel does to a polynomial it does to every line of a net along an axis.

use std::ops::{Index, IndexMut};

use crate::{BernsteinError, MAX_DEGREE};

/// One line of a net, from its first point on: point i stands at `i·stride`.
pub(crate) struct Line<'a, P> {
    points: &'a mut [P],
    stride: usize,
}

impl<'a, P> Line<'a, P> {
    /// The points of a polynomial on the interval.
    pub(crate) fn whole(points: &'a mut [P]) -> Self {
        Self { points, stride: 1 }
    }

    /// The first `count` points.
    pub(crate) fn first(&self, count: usize) -> impl Iterator<Item = P>
    where
        P: Copy,
    {
        self.points.iter().copied().step_by(self.stride).take(count)
    }
}

impl<P> Index<usize> for Line<'_, P> {
    type Output = P;

    #[inline]
    fn index(&self, i: usize) -> &P {
        &self.points[i * self.stride]
    }
}

impl<P> IndexMut<usize> for Line<'_, P> {
    #[inline]
    fn index_mut(&mut self, i: usize) -> &mut P {
        &mut self.points[i * self.stride]
    }
}

/// The numbers of points along each axis.
pub(crate) fn counts<const D: usize>(degrees: [usize; D]) -> [usize; D] {
    degrees.map(|d| d.saturating_add(1))
}

/// How far apart neighbours along each axis stand.
pub(crate) fn strides<const D: usize>(counts: [usize; D]) -> [usize; D] {
    let mut strides = [1; D];
    for axis in (1..D).rev() {
        strides[axis - 1] = strides[axis] * counts[axis];
    }
    strides
}

/// The number of points of a net of the given degrees, which must be served.
pub(crate) fn net_size<const D: usize>(degrees: [usize; D]) -> Result<usize, BernsteinError> {
    if let Some(&degree) = degrees.iter().find(|&&d| d > MAX_DEGREE) {
        return Err(BernsteinError::Degree { degree, limit: MAX_DEGREE });
    }
    Ok(degrees.iter().fold(1_usize, |size, d| size.saturating_mul(d + 1)))
}

/// Whether the buffer of that name has the length that it should have.
pub(crate) fn check_length(buffer: &'static str, given: usize, needed: usize) -> Result<(), BernsteinError> {
    if given == needed { Ok(()) } else { Err(BernsteinError::BufferLength { buffer, needed, given }) }
}

/// Whether the net `points` has the given degrees, and the axis.
pub(crate) fn check_axis<P, const D: usize>(
    points: &[P],
    degrees: [usize; D],
    axis: usize,
) -> Result<(), BernsteinError> {
    check_length("points", points.len(), net_size(degrees)?)?;
    if axis < D { Ok(()) } else { Err(BernsteinError::Axis { axis, dimension: D }) }
}

/// The degree of the polynomial with these points: there must be one, and it must be served.
pub(crate) fn degree_of<P>(points: &[P]) -> Result<usize, BernsteinError> {
    let degree = points.len().checked_sub(1).ok_or(BernsteinError::NoPoints)?;
    if degree > MAX_DEGREE {
        return Err(BernsteinError::Degree { degree, limit: MAX_DEGREE });
    }
    Ok(degree)
}

/// The places where the lines along `axis` begin, in a net with room for `counts` points of which those within
/// `used` are taken.
pub(crate) fn line_starts<const D: usize>(
    counts: [usize; D],
    used: [usize; D],
    axis: usize,
) -> impl Iterator<Item = usize> {
    let strides = strides(counts);
    let mut across = used;
    across[axis] = 1;
    (0..across.iter().product()).map(move |number| place(number, across, strides))
}

/// The place of the point that comes as number `number` in the order of a net with `counts` points, in a net
/// with other strides.
fn place<const D: usize>(mut number: usize, counts: [usize; D], strides: [usize; D]) -> usize {
    let mut place = 0;
    for axis in (0..D).rev() {
        place += number % counts[axis] * strides[axis];
        number /= counts[axis];
    }
    place
}

/// Calls `kernel` with every line along `axis`.
pub(crate) fn each_line<P, const D: usize>(
    net: &mut [P],
    counts: [usize; D],
    used: [usize; D],
    axis: usize,
    mut kernel: impl FnMut(Line<'_, P>),
) {
    let stride = strides(counts)[axis];
    for start in line_starts(counts, used, axis) {
        kernel(Line { points: &mut net[start..], stride });
    }
}

/// Copies a net into the corner of a larger one: every point keeps its indices.
pub(crate) fn spread<P: Copy, const D: usize>(
    points: &[P],
    counts: [usize; D],
    out: &mut [P],
    out_counts: [usize; D],
) {
    let Some(last) = D.checked_sub(1) else { return };
    let width = counts[last];
    for (row, start) in points.chunks_exact(width).zip(line_starts(out_counts, counts, last)) {
        out[start..start + width].copy_from_slice(row);
    }
}
