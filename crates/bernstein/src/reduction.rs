//! The nearest polynomial of a lower degree.

use crate::elevation::elevate_line;
use crate::line::{Line, check_axis, check_length, counts, degree_of, line_starts, net_size, strides};
use crate::{BernsteinError, Point, binomial};

/// Degree reduction from n to m: the polynomial q of degree m with the same end points that minimises
/// `∫₀¹ |p(t) − q(t)|² dt`; gives a bound on `|p(t) − q(t)|` over `[0, 1]`.
///
/// The bound is the distance of the control polygons, `max |Pᵢ − Qᵢ|` with q elevated to degree n, and an
/// allowance for rounding: by the convex hull property nothing in `[0, 1]` is farther apart. It is certified,
/// being measured on the result. Vectors are measured by their Euclidean length. For m = 0, where the ends
/// cannot both be kept, q is the mean of p.
///
/// Polynomials that agree in both end points and have degree k are an affine space within that for k + 1, so
/// the nearest one is reached one degree at a time. In a step from n to n − 1 the part that is lost is a
/// multiple of `t(1−t)·J(t)`, J being the Jacobi polynomial of degree n − 2 for the weight t²(1−t)²; its
/// Bernstein coefficients are `(−1)ⁿ⁻ʲ C(n,j−1) C(n,j+1)/C(n,j)`. What remains has exactly degree n − 1, and
/// elevation is undone from both ends towards the middle, where the recurrences are stable. So a polynomial of
/// degree m that was elevated to n comes back as it was, up to rounding.
///
/// `out` holds m + 1 points; `work` n + 1, whose content is lost. Error against the exact minimiser: at most
/// `4(n+2)·κ·u·√Σ|Pᵢ|²` with `κ² = n! (n+1)! (2m+1)! / ((n+m+1)! (n−m)! m! (m+1)!)`; 1/κ is the smallest
/// singular value of elevation from m to n, so that κ is the condition of the problem itself, and at most 364
/// for n = 30. Cost: O((n−m)·n).
///
/// ```
/// use casteljau_bernstein::{elevate, reduce};
/// let (mut high, mut low, mut work) = ([0.0; 8], [0.0; 3], [0.0; 8]);
/// elevate(&[1.0, 4.0, -2.0], &mut high)?;
/// assert!(reduce(&high, &mut low, &mut work)? < 1e-13);
/// assert!((low[1] - 4.0).abs() < 1e-14);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
///
/// # Errors
/// [`BernsteinError::NoPoints`], [`BernsteinError::Degree`]; [`BernsteinError::BufferLength`] for `work`, and
/// for `out` where it is empty; [`BernsteinError::ReducedDegree`] where `out` is longer than `points`.
///
/// Sources: Eck, *Degree reduction of Bézier curves*, CAGD 10, 1993; Sunwoo and Lee, *A unified matrix
/// representation for degree reduction of Bézier curves*, CAGD 21, 2004; Farin, *Curves and Surfaces for CAGD*,
/// 5th ed., sec. 6.4 (undoing an elevation from both ends).
pub fn reduce<P: Point>(points: &[P], out: &mut [P], work: &mut [P]) -> Result<f64, BernsteinError> {
    let from = degree_of(points)?;
    check_length("work", work.len(), points.len())?;
    let Some(to) = out.len().checked_sub(1) else {
        return Err(BernsteinError::BufferLength { buffer: "out", needed: 1, given: 0 });
    };
    reduce_along(points, [from], 0, to, out, work)
}

/// Degree reduction of a net along one axis: [`reduce`] on each of its lines, from `degrees[axis]` to `to`; gives
/// a bound on the distance of the two polynomials over the unit square or cube.
///
/// The outer rows of the net are kept. `out` is a net of the new degrees; `work` holds `degrees[axis] + 1`
/// points.
///
/// # Errors
/// [`BernsteinError::Axis`], [`BernsteinError::Degree`], [`BernsteinError::ReducedDegree`] where `to` is above
/// the degree, [`BernsteinError::BufferLength`].
pub fn reduce_along<P: Point, const D: usize>(
    points: &[P],
    degrees: [usize; D],
    axis: usize,
    to: usize,
    out: &mut [P],
    work: &mut [P],
) -> Result<f64, BernsteinError> {
    check_axis(points, degrees, axis)?;
    let from = degrees[axis];
    if to > from {
        return Err(BernsteinError::ReducedDegree { from, to });
    }
    let mut lower = degrees;
    lower[axis] = to;
    check_length("out", out.len(), net_size(lower)?)?;
    check_length("work", work.len(), from + 1)?;

    let (old, new) = (counts(degrees), counts(lower));
    let stride = strides(old)[axis];
    let (mut deviation, mut largest) = (0.0_f64, 0.0_f64);
    for (source, target) in line_starts(old, old, axis).zip(line_starts(new, new, axis)) {
        let line = || points[source..].iter().copied().step_by(stride);
        for (place, p) in work.iter_mut().zip(line()) {
            *place = p;
        }
        if to == 0 {
            work[0] = work.iter().fold(P::ZERO, |sum, &p| sum + p) / (from + 1) as f64;
        } else {
            for degree in (to + 1..=from).rev() {
                reduce_once(&mut work[..=degree]);
            }
        }
        for (i, &q) in work[..=to].iter().enumerate() {
            out[target + i * stride] = q;
            largest = largest.max(q.norm());
        }
        elevate_line(&mut Line::whole(work), to + 1, from + 1);
        for (&q, p) in work.iter().zip(line()) {
            deviation = deviation.max((p - q).norm());
        }
    }
    // The elevated point is within 3(n−m) roundings of the true one, difference and length add a few.
    let rounding = (4 * (from - to) + 8) as f64 * f64::EPSILON / 2.0;
    Ok(if from == to { 0.0 } else { deviation * (1.0 + rounding) + rounding * largest })
}

/// One degree less: from n + 1 points to n, for n ≥ 2; the last place is left over.
fn reduce_once<P: Point>(points: &mut [P]) {
    let n = points.len() - 1;
    let size = n as f64;
    // Both factors are scaled by the root of C(2n, n−2), so that neither is large.
    let root = binomial(2 * n, n - 2).sqrt();
    let sign = |j: usize| if (n - j).is_multiple_of(2) { 1.0 } else { -1.0 };
    let weight = |j: usize| sign(j) * (binomial(n, j) / root);
    let excess = points.iter().enumerate().fold(P::ZERO, |sum, (j, &p)| sum + p * weight(j));
    for (j, p) in points.iter_mut().enumerate().take(n).skip(1) {
        let share = (j * (n - j)) as f64 / ((j + 1) * (n - j + 1)) as f64;
        *p = *p - excess * (weight(j) * share);
    }
    // Elevation undone: from the left to the middle, then from the right; there each point stands one place to
    // the right of its own until all are made.
    let middle = (n - 1) / 2;
    for j in 1..=middle {
        points[j] = (points[j] * size - points[j - 1] * j as f64) / (n - j) as f64;
    }
    for j in (middle + 2..n).rev() {
        points[j] = (points[j] * size - points[j + 1] * (n - j) as f64) / j as f64;
    }
    points.copy_within(middle + 2.., middle + 1);
}
