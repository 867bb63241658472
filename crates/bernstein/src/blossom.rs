//! Blossoms: the symmetric multi-affine forms of polynomials.

use crate::line::{Line, check_length, counts, degree_of, each_line, net_size};
use crate::{BernsteinError, Point};

/// Blossom `p[t₁, …, tₙ]`: symmetric, affine in each argument, and `p[t, …, t] = p(t)`.
///
/// One level of de Casteljau's algorithm for each argument, `Pᵢʳ = (1−tᵣ) Pᵢʳ⁻¹ + tᵣ Pᵢ₊₁ʳ⁻¹`. There are as many
/// arguments as the degree says; `work` holds n + 1 points, and its content is lost. Error: at most `4(n+2)·u`
/// times the same combination of absolute values. Cost: n(n+1)/2 affine combinations.
///
/// ```
/// use casteljau_bernstein::blossom;
/// let p = [0.0, 0.0, 1.0]; // t², whose blossom is t₁·t₂
/// assert_eq!(blossom(&p, &[0.5, 3.0], &mut [0.0; 3])?, 1.5);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
///
/// # Errors
/// [`BernsteinError::NoPoints`]; [`BernsteinError::Degree`]; [`BernsteinError::BufferLength`] for `arguments`
/// and `work`.
///
/// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 4.4.
pub fn blossom<P: Point>(points: &[P], arguments: &[f64], work: &mut [P]) -> Result<P, BernsteinError> {
    blossom_tensor(points, [degree_of(points)?], [arguments], work)
}

/// Blossom of a tensor product, `p[u₁, …, uₘ; v₁, …, vₙ; …]`: symmetric in the arguments of each axis, affine in
/// each.
///
/// The degrees are those of a net in the order of [`TensorNet`](crate::TensorNet) or
/// [`BoxNet`](crate::BoxNet); each axis has as many arguments as its degree says. `work` holds as many points
/// as the net. Error: at most `4(Σ degrees + 2)·u` times the same combination of absolute values.
///
/// # Errors
/// [`BernsteinError::Degree`]; [`BernsteinError::BufferLength`] for `points`, `arguments` and `work`.
pub fn blossom_tensor<P: Point, const D: usize>(
    points: &[P],
    degrees: [usize; D],
    arguments: [&[f64]; D],
    work: &mut [P],
) -> Result<P, BernsteinError> {
    let size = net_size(degrees)?;
    check_length("points", points.len(), size)?;
    check_length("work", work.len(), size)?;
    for (degree, list) in degrees.into_iter().zip(arguments) {
        check_length("arguments", list.len(), degree)?;
    }
    work.copy_from_slice(points);
    let counts = counts(degrees);
    let mut used = counts;
    for axis in (0..D).rev() {
        each_line(work, counts, used, axis, |mut line| {
            for (level, &t) in (0..degrees[axis]).rev().zip(arguments[axis]) {
                step_line(&mut line, level, t);
            }
        });
        used[axis] = 1;
    }
    Ok(work[0])
}

/// One step of de Casteljau's algorithm on the first `last + 2` points; the last of them keeps its old value.
#[inline]
pub(crate) fn step_line<P: Point>(line: &mut Line<'_, P>, last: usize, t: f64) {
    let s = 1.0 - t;
    for i in 0..=last {
        line[i] = line[i] * s + line[i + 1] * t;
    }
}
