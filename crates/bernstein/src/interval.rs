//! Values and derivatives of one polynomial over an interval.

use crate::{BernsteinError, MAX_DEGREE, Point, binomial::Row};

/// Value of the polynomial, `p(t) = Σ Bᵢⁿ(t) Pᵢ`, by nested multiplication.
///
/// Any `t`; no points give the zero vector. At t = 0 and t = 1 the answer is the end point to the bit.
/// Error: at most `4(n+2)·u·Σ|Bᵢⁿ(t)||Pᵢ|`. Cost: n + 1 points are read once, 3n operations a component.
///
/// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 5.7 (`hornbez`).
#[inline]
#[must_use]
pub fn value<P: Point>(points: &[P], t: f64) -> P {
    match points.len().checked_sub(1) {
        Some(n) => nested(n, t, points.iter().copied()),
        None => P::ZERO,
    }
}

/// `Σ Bᵢⁿ(t) Pᵢ` over points that are made one after another.
///
/// `((P₀ s + C(n,1) t P₁) s + C(n,2) t² P₂) s + … + tⁿ Pₙ`, s = 1 − t: positive weights on `[0, 1]`
/// throughout, hence stable.
#[inline]
pub(crate) fn nested<P: Point>(n: usize, t: f64, points: impl Iterator<Item = P>) -> P {
    nested_barycentric(n, 1.0 - t, t, points)
}

/// `Σ C(n,i) sⁿ⁻ⁱ tⁱ Pᵢ`, s and t being independent.
#[inline]
pub(crate) fn nested_barycentric<P: Point>(
    n: usize,
    s: f64,
    t: f64,
    mut points: impl Iterator<Item = P>,
) -> P {
    if n > MAX_DEGREE {
        return P::NAN;
    }
    let mut row = Row::new(n);
    let mut power = 1.0;
    let mut sum = points.next().unwrap_or(P::ZERO);
    for (i, p) in (1..=n).zip(points) {
        power *= t;
        sum = sum * s + p * (row.coefficient(i) * power);
    }
    sum
}

/// Derivative of one order, `dᵏp/dtᵏ = n!/(n−k)! Σ Bᵢⁿ⁻ᵏ(t) Δᵏ Pᵢ`.
///
/// The order is the length of `work`, whose content is lost. See [`derivatives`] for the error.
#[inline]
#[must_use]
pub fn derivative<P: Point>(points: &[P], t: f64, work: &mut [P]) -> P {
    differentiated(points.len(), t, work, points.iter().copied())
}

/// The derivative of order `work.len()` of a polynomial with `count` points, which are made one after another.
#[inline]
pub(crate) fn differentiated<P: Point>(
    count: usize,
    t: f64,
    work: &mut [P],
    points: impl Iterator<Item = P>,
) -> P {
    // With a length known to the compiler the differences stay in registers: three times as fast.
    match work.len() {
        0 => differentiated_in(count, t, [], points),
        1 => differentiated_in(count, t, [P::ZERO; 1], points),
        2 => differentiated_in(count, t, [P::ZERO; 2], points),
        3 => differentiated_in(count, t, [P::ZERO; 3], points),
        _ => differentiated_in(count, t, work, points),
    }
}

/// [`differentiated`], with `work` in the caller's slice or an array of its own.
#[inline(always)]
fn differentiated_in<P: Point>(
    count: usize,
    t: f64,
    mut work: impl AsMut<[P]>,
    mut points: impl Iterator<Item = P>,
) -> P {
    let work = work.as_mut();
    let order = work.len();
    if count <= order {
        return P::ZERO;
    }
    // `work` holds the last backward differences of orders 0…k−1; a new point pushes one diagonal further.
    for filled in 0..order {
        let Some(newest) = points.next() else { break };
        work[filled] = push(&mut work[..filled], newest);
    }
    let differences = points.map(|newest| push(work, newest));
    let factor = (count - order..count).fold(1.0, |f, m| f * m as f64);
    nested(count - 1 - order, t, differences) * factor
}

/// Replaces the last backward differences by those that end at a new point; gives the one of the next order.
#[inline(always)]
pub(crate) fn push<P: Point>(differences: &mut [P], mut newest: P) -> P {
    for difference in differences {
        let older = std::mem::replace(difference, newest);
        newest = newest - older;
    }
    newest
}

/// Value and derivatives, `out[k] = dᵏp/dtᵏ = n!/(n−k)! Σ Bᵢⁿ⁻ᵏ(t) Δᵏ Pᵢ`, up to the order `out.len() − 1`.
///
/// Orders above n are zero. Differences are taken of the control points themselves, so that a shape far from
/// the origin keeps the digits of its derivatives. Error: at most `4(n + 2k + 2)·u·scale`, scale being the
/// sum above with every term and every part of Δᵏ taken absolutely. Cost: O(n) for the value, O(n·k) for
/// order k.
///
/// ```
/// let mut jet = [0.0; 4];
/// casteljau_bernstein::derivatives(&[0.0, 0.0, 1.0], 0.5, &mut jet); // t²
/// assert_eq!(jet, [0.25, 1.0, 2.0, 0.0]);
/// ```
pub fn derivatives<P: Point>(points: &[P], t: f64, out: &mut [P]) {
    // From the highest order down: the places below are still free to work in.
    for k in (0..out.len()).rev() {
        out[k] = derivative(points, t, &mut out[..k]);
    }
}

/// Value of the polynomial by de Casteljau's algorithm, `Pᵢʳ = (1−t) Pᵢʳ⁻¹ + t Pᵢ₊₁ʳ⁻¹`, `p(t) = P₀ⁿ`.
///
/// `scratch` should hold n + 1 points and its content is lost; where it is shorter, [`value`] answers instead.
/// Error: at most `4(n+2)·u·Σ|Bᵢⁿ(t)||Pᵢ|`. Cost: n(n+1)/2 affine combinations, no limit on the degree.
///
/// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 4.2.
#[must_use]
pub fn de_casteljau<P: Point>(points: &[P], t: f64, scratch: &mut [P]) -> P {
    let Some(scratch) = scratch.get_mut(..points.len()) else { return value(points, t) };
    scratch.copy_from_slice(points);
    for level in (1..points.len()).rev() {
        step(t, &mut scratch[..=level]);
    }
    scratch.first().copied().unwrap_or(P::ZERO)
}

/// One step of de Casteljau's algorithm in place; the last point keeps its old value.
#[inline]
pub(crate) fn step<P: Point>(t: f64, points: &mut [P]) {
    let s = 1.0 - t;
    for i in 1..points.len() {
        points[i - 1] = points[i - 1] * s + points[i] * t;
    }
}

/// The whole scheme of de Casteljau's algorithm: level r, the points `Pᵢʳ` for i = 0…n−r, follows level r − 1
/// in `out`.
///
/// `out` must hold (n+1)(n+2)/2 points: the control points first, `p(t)` last.
///
/// # Errors
/// [`BernsteinError::BufferLength`] where `out` has another length, [`BernsteinError::NoPoints`] without
/// points.
pub fn de_casteljau_scheme<P: Point>(points: &[P], t: f64, out: &mut [P]) -> Result<(), BernsteinError> {
    let count = points.len();
    if count == 0 {
        return Err(BernsteinError::NoPoints);
    }
    let needed = count.saturating_mul(count + 1) / 2;
    if out.len() != needed {
        return Err(BernsteinError::BufferLength { buffer: "out", needed, given: out.len() });
    }
    out[..count].copy_from_slice(points);
    fill_scheme(count, t, out);
    Ok(())
}

/// The levels of the scheme above the first, which is there and has `count` points.
pub(crate) fn fill_scheme<P: Point>(count: usize, t: f64, out: &mut [P]) {
    let s = 1.0 - t;
    let (mut below, mut rest) = out.split_at_mut(count);
    for length in (1..count).rev() {
        let (level, left) = rest.split_at_mut(length);
        for (p, pair) in level.iter_mut().zip(below.windows(2)) {
            *p = pair[0] * s + pair[1] * t;
        }
        (below, rest) = (level, left);
    }
}
