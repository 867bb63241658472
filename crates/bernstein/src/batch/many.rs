//! Many polynomials of one degree at once: cut in two, raised in degree, taken to the power basis.
//!
//! The polynomials stand one after another, and so do the results; scratch is for one polynomial a chunk.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use pulp::bytemuck::{cast_slice, cast_slice_mut};

use super::blocks::store;
use super::parallel::{CHUNK, each_chunk};
use super::simd::{Job, Lanes, WIDTH, dispatch, dispatch_in};
use super::{BatchPoint, check_length};
use crate::{BernsteinError, MAX_DEGREE, binomial};

/// Cuts many nets at `t`, as [`subdivide`](crate::subdivide) does one curve: `left` holds each over `[0, t]`,
/// `right` over `[t, 1]`.
///
/// Each polynomial has `degree + 1` rows of `row` points. With `row` = 1 these are curves; tensor nets of the
/// degrees m × n are cut in u with `degree` = m and `row` = n + 1, and in v with `degree` = n and `row` = 1.
/// The two parts share their common row to the bit, and the outer rows are kept to the bit. Error of each
/// point: at most `4(degree + 2)·u` times its combination of absolute values. Cost: degree(degree+1)/2 affine
/// combinations a point of a row.
///
/// ```
/// let (mut left, mut right) = ([0.0; 4], [0.0; 4]);
/// casteljau_bernstein::subdivide_many(&[0.0, 2.0, 1.0, 5.0], 1, 1, 0.5, &mut left, &mut right)?; // two lines
/// assert_eq!((left, right), ([0.0, 1.0, 1.0, 3.0], [1.0, 2.0, 3.0, 5.0]));
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
///
/// # Errors
/// [`BernsteinError::NoPoints`] where rows are empty, [`BernsteinError::Degree`] above [`MAX_DEGREE`],
/// [`BernsteinError::BufferLength`] unless `points` holds whole polynomials and `left` and `right` have its
/// length.
pub fn subdivide_many<P: BatchPoint>(
    points: &[P],
    degree: usize,
    row: usize,
    t: f64,
    left: &mut [P],
    right: &mut [P],
) -> Result<(), BernsteinError> {
    check_degree(degree)?;
    check_whole(points.len(), (degree + 1).saturating_mul(row))?;
    check_length("left", points.len(), left.len())?;
    check_length("right", points.len(), right.len())?;
    if points.is_empty() {
        return Ok(());
    }
    let row = row * P::DIMENSION;
    split_all(cast_slice(points), degree, row, t, cast_slice_mut(left), cast_slice_mut(right));
    Ok(())
}

fn split_all(points: &[f64], degree: usize, row: usize, t: f64, left: &mut [f64], right: &mut [f64]) {
    let size = (degree + 1) * row;
    let chunk = CHUNK.div_ceil(size) * size;
    let out = [left.chunks_mut(chunk), right.chunks_mut(chunk)];
    each_chunk(points.chunks(chunk), out, |points, [left, right]| match (degree, row) {
        (3, 12) => dispatch_in::<_, 1>(Split::<3, 12> { points, degree, row, t, left, right }),
        _ => dispatch_in::<_, 1>(Split::<ANY, ANY> { points, degree, row, t, left, right }),
    });
}

/// A number that a kernel learns when it runs; with another one its loops are unrolled.
const ANY: usize = usize::MAX;

struct Split<'a, const DEGREE: usize, const ROW: usize> {
    points: &'a [f64],
    degree: usize,
    /// Numbers a row.
    row: usize,
    t: f64,
    left: &'a mut [f64],
    right: &'a mut [f64],
}

impl<const DEGREE: usize, const ROW: usize> Job for Split<'_, DEGREE, ROW> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes, const D: usize>(self, _simd: S) {
        let degree = if DEGREE == ANY { self.degree } else { DEGREE };
        let row = if ROW == ANY { self.row } else { ROW };
        let (t, s) = (self.t, 1.0 - self.t);
        let size = (degree + 1) * row;
        let out = self.left.chunks_exact_mut(size).zip(self.right.chunks_exact_mut(size));
        for (points, (left, right)) in self.points.chunks_exact(size).zip(out) {
            right.copy_from_slice(points);
            for done in 0..=degree {
                left[done * row..][..row].copy_from_slice(&right[..row]);
                for i in 0..degree - done {
                    let (low, high) = right[i * row..(i + 2) * row].split_at_mut(row);
                    for (low, high) in low.iter_mut().zip(high) {
                        *low = t.mul_add(*high, *low * s);
                    }
                }
            }
        }
    }
}

/// Raises the degrees of many tensor nets from `degrees` to `to`: `ΣΣ Bᵢᵐ Bⱼⁿ Pᵢⱼ = ΣΣ Bₖᵖ Bₗ^q Qₖₗ`.
///
/// `Qₖ = Σᵢ C(m,i) C(p−m,k−i)/C(p,k) Pᵢ` in each direction, convex combinations; the corners are kept to the
/// bit. Curves are nets of the degrees 0 × n. Error: at most `4(p + q + 2)·u` times the same combination of
/// absolute values. Cost: (p−m+1)(n+1)(p+1) + (q−n+1)(p+1)(q+1) multiply-adds a component.
///
/// ```
/// let mut out = [0.0; 6];
/// casteljau_bernstein::elevate_many(&[0.0, 2.0, 4.0, 8.0], [0, 1], [0, 2], &mut out)?; // two lines
/// assert_eq!(out, [0.0, 1.0, 2.0, 4.0, 6.0, 8.0]);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
///
/// # Errors
/// [`BernsteinError::Degree`] above [`MAX_DEGREE`], [`BernsteinError::NetLength`] unless `points` holds whole
/// nets, [`BernsteinError::BufferLength`] unless `out` holds as many of the new degrees, or where `to` is
/// lower.
pub fn elevate_many<P: BatchPoint>(
    points: &[P],
    degrees: [usize; 2],
    to: [usize; 2],
    out: &mut [P],
) -> Result<(), BernsteinError> {
    for axis in 0..2 {
        check_degree(degrees[axis].max(to[axis]))?;
        if to[axis] < degrees[axis] {
            let (needed, given) = (degrees[axis] + 1, to[axis] + 1);
            return Err(BernsteinError::BufferLength { buffer: "out", needed, given });
        }
    }
    let [size, larger] = [degrees, to].map(|[m, n]| (m + 1) * (n + 1));
    if !points.len().is_multiple_of(size) {
        return Err(BernsteinError::NetLength { degrees, given: points.len() });
    }
    check_length("out", points.len() / size * larger, out.len())?;
    elevate_all(cast_slice(points), degrees, to, P::DIMENSION, cast_slice_mut(out));
    Ok(())
}

fn elevate_all(points: &[f64], degrees: [usize; 2], to: [usize; 2], dimension: usize, out: &mut [f64]) {
    let [size, larger] = [degrees, to].map(|[m, n]| (m + 1) * (n + 1) * dimension);
    if points.is_empty() {
        return;
    }
    let in_u = elevation_matrix(degrees[0], to[0]);
    // Coefficients of the number that stands k points to the left, for all numbers of a row of the result.
    let matrix = elevation_matrix(degrees[1], to[1]);
    let width = (to[1] + 1) * dimension;
    let shifted = |k: usize| {
        let entry =
            |x: usize| (x / dimension).checked_sub(k).and_then(|i| matrix[x / dimension].get(i).copied());
        let mut row: Vec<f64> = (0..width).map(|x| entry(x).unwrap_or(0.0)).collect();
        row.resize(width + WIDTH, 0.0);
        row
    };
    let in_v: Vec<Vec<f64>> = (0..=to[1] - degrees[1]).map(shifted).collect();
    let count = CHUNK.div_ceil(larger);
    let jobs = points.chunks(count * size);
    each_chunk(jobs, [out.chunks_mut(count * larger)], |points, [out]| {
        let (in_u, in_v) = (&in_u[..], &in_v[..]);
        if (degrees, to, dimension) == ([3, 3], [4, 4], 3) {
            dispatch_in::<_, 1>(Elevate::<true> { points, size, dimension, width, in_u, in_v, out });
        } else {
            dispatch_in::<_, 1>(Elevate::<false> { points, size, dimension, width, in_u, in_v, out });
        }
    });
}

/// `C(n,i) C(m−n,j−i) / C(m,j)` in row j and column i.
fn elevation_matrix(n: usize, m: usize) -> Vec<Vec<f64>> {
    let entry = |j: usize, i: usize| {
        let share = |j: usize| binomial(m - n, j);
        j.checked_sub(i).map_or(0.0, |left| binomial(n, i) / binomial(m, j) * share(left))
    };
    (0..=m).map(|j| (0..=n).map(|i| entry(j, i)).collect()).collect()
}

/// `BICUBIC` says that the numbers are those of (3,3) → (4,4) in space, so that loops can be unrolled.
struct Elevate<'a, const BICUBIC: bool> {
    points: &'a [f64],
    /// Numbers a net.
    size: usize,
    dimension: usize,
    /// Numbers a row of the result.
    width: usize,
    in_u: &'a [Vec<f64>],
    in_v: &'a [Vec<f64>],
    out: &'a mut [f64],
}

impl<const BICUBIC: bool> Job for Elevate<'_, BICUBIC> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes, const D: usize>(self, simd: S) {
        let Self { points, in_u, in_v, out, .. } = self;
        let (size, dimension, width) =
            if BICUBIC { (48, 3, 15) } else { (self.size, self.dimension, self.width) };
        let (rows, in_u, in_v) =
            if BICUBIC { (4, &in_u[..5], &in_v[..2]) } else { (in_u[0].len(), in_u, in_v) };
        let row = size / rows;
        let stride = width.next_multiple_of(WIDTH);
        // Numbers before and after a row are read and multiplied by zero.
        let before = (in_v.len() - 1) * dimension;
        let mut padded = vec![0.0; before + size + stride + WIDTH];
        let mut raised = vec![0.0; rows * stride];
        for (number, out) in out.chunks_exact_mut(in_u.len() * width).enumerate() {
            let first = number * size;
            let around = first.checked_sub(before).and_then(|from| points.get(from..from + padded.len()));
            let source = around.unwrap_or_else(|| {
                padded[before..before + size].copy_from_slice(&points[first..first + size]);
                &padded
            });
            for (i, raised) in raised.chunks_exact_mut(stride).enumerate() {
                let source = &source[i * row..];
                let mut x = 0;
                while x < width {
                    let mut sum = simd.splat_f64s(0.0);
                    for (k, weights) in in_v.iter().enumerate() {
                        let left = simd.load(source, before + x - k * dimension);
                        sum = simd.mul_add_f64s(simd.load(weights, x), left, sum);
                    }
                    S::as_mut_simd_f64s(&mut raised[x..]).0[0] = sum;
                    x += S::F64_LANES;
                }
            }
            for (j, weights) in in_u.iter().enumerate() {
                // The other weights are zero.
                let (from, to) = ((j + rows).saturating_sub(in_u.len()), rows.min(j + 1));
                let out = &mut out[j * width..];
                let mut x = 0;
                while x < width {
                    let mut sum = simd.splat_f64s(0.0);
                    for i in from..to {
                        let weight = simd.splat_f64s(weights[i]);
                        sum = simd.mul_add_f64s(weight, simd.load(&raised, i * stride + x), sum);
                    }
                    // What goes beyond the row is overwritten by the next.
                    match out.get_mut(x..x + S::F64_LANES) {
                        Some(room) => S::as_mut_simd_f64s(room).0[0] = sum,
                        None => simd.partial_store_f64s(&mut out[x..], sum),
                    }
                    x += S::F64_LANES;
                }
            }
        }
    }
}

/// Takes many curves of one degree to the power basis: `Σ Bᵢⁿ(t) Pᵢ = Σ tᵏ aₖ`, `aₖ = C(n,k) Σᵢ (−1)ᵏ⁻ⁱ
/// C(k,i) Pᵢ`.
///
/// Error: at most `4(n + 2)·u` times the same sum of absolute values. It grows like 3ⁿ against the size of
/// the points: at degree 20 about nine digits are left. Cost: (n+1)(n+2)/2 multiply-adds a component.
///
/// ```
/// let mut out = [0.0; 3];
/// casteljau_bernstein::to_power_many(&[1.0, 1.0, 2.0], 2, &mut out)?; // 1 + t²
/// assert_eq!(out, [1.0, 0.0, 1.0]);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
///
/// # Errors
/// [`BernsteinError::Degree`] above [`MAX_DEGREE`], [`BernsteinError::BufferLength`] unless `points` holds
/// whole curves and `out` has its length.
pub fn to_power_many<P: BatchPoint>(
    points: &[P],
    degree: usize,
    out: &mut [P],
) -> Result<(), BernsteinError> {
    check_degree(degree)?;
    check_whole(points.len(), degree + 1)?;
    check_length("out", points.len(), out.len())?;
    power_all(cast_slice(points), degree, P::DIMENSION, cast_slice_mut(out));
    Ok(())
}

fn power_all(points: &[f64], degree: usize, dimension: usize, out: &mut [f64]) {
    if points.is_empty() {
        return;
    }
    let stride = (degree + 1).next_multiple_of(WIDTH);
    let mut columns = vec![0.0; (degree + 1) * stride];
    for i in 0..=degree {
        for k in i..=degree {
            let sign = if (k - i) % 2 == 0 { 1.0 } else { -1.0 };
            columns[i * stride + k] = sign * binomial(degree, k) * binomial(k, i);
        }
    }
    let size = (degree + 1) * dimension;
    let chunk = CHUNK.div_ceil(size) * size;
    each_chunk(points.chunks(chunk), [out.chunks_mut(chunk)], |points, [out]| {
        dispatch(dimension, Power { points, degree, columns: &columns, out });
    });
}

struct Power<'a> {
    points: &'a [f64],
    degree: usize,
    /// Column i of the matrix, padded.
    columns: &'a [f64],
    out: &'a mut [f64],
}

impl Job for Power<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes, const D: usize>(self, simd: S) {
        let count = self.degree + 1;
        let stride = count.next_multiple_of(WIDTH);
        let curves = self.points.as_chunks::<D>().0.chunks_exact(count);
        for (points, out) in curves.zip(self.out.chunks_exact_mut(count * D)) {
            let mut first = 0;
            while first < count {
                let mut sum = [simd.splat_f64s(0.0); D];
                // Above its diagonal the matrix is zero.
                for i in 0..count.min(first + S::F64_LANES) {
                    let column = simd.load(self.columns, i * stride + first);
                    for c in 0..D {
                        sum[c] = simd.mul_add_f64s(column, simd.splat_f64s(points[i][c]), sum[c]);
                    }
                }
                store(simd, out, first, sum);
                first += S::F64_LANES;
            }
        }
    }
}

fn check_degree(degree: usize) -> Result<(), BernsteinError> {
    if degree > MAX_DEGREE { Err(BernsteinError::Degree { degree, limit: MAX_DEGREE }) } else { Ok(()) }
}

/// Checks that a number of points is made of whole polynomials.
fn check_whole(given: usize, size: usize) -> Result<(), BernsteinError> {
    if size == 0 {
        return Err(BernsteinError::NoPoints);
    }
    if given.is_multiple_of(size) {
        return Ok(());
    }
    Err(BernsteinError::BufferLength { buffer: "points", needed: given.next_multiple_of(size), given })
}
