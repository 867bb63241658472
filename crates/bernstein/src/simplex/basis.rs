//! The Bernstein basis of a simplex, and its derivatives.

use super::index::{simplex_count, simplex_index, step_back};
use crate::basis::{Halves, basis_barycentric};
use crate::binomial::Row;
use crate::line::check_length;
use crate::{BernsteinError, MAX_DEGREE};

/// All Bernstein polynomials of degree n over a simplex with V vertices, `B_β(λ) = n!/β! λ^β`, |β| = n, at the
/// places [`simplex_index`] of `out`.
///
/// Barycentric coordinates are taken as given, and each value has relative error at most `4(n+2)·u`, as long as
/// it is above the smallest normal number: tiny coordinates keep their digits. Inside the simplex all values are
/// non-negative, and they add up to `(Σλ)ⁿ`. Cost: about 4 multiplications a value.
///
/// # Errors
/// [`BernsteinError::BufferLength`] unless `out` holds [`simplex_count`] numbers, [`BernsteinError::Degree`]
/// above [`MAX_DEGREE`].
///
/// ```
/// let mut b = [0.0; 6];
/// casteljau_bernstein::simplex_basis(2, [0.5, 0.25, 0.25], &mut b)?;
/// assert_eq!(b, [0.25, 0.25, 0.25, 0.0625, 0.125, 0.0625]);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
pub fn simplex_basis<const V: usize>(
    degree: usize,
    lambda: [f64; V],
    out: &mut [f64],
) -> Result<(), BernsteinError> {
    check::<V>(degree, 0, out)?;
    fill(degree, &lambda, out);
    Ok(())
}

/// The Bernstein basis and all its partial derivatives up to a total order, with respect to all barycentric
/// coordinates but the last, which is `1 − Σ` of the others.
///
/// Row [`simplex_partial_index`](crate::simplex_partial_index)`(α)` of `out`, of [`simplex_count`] numbers,
/// holds `∂^α B_β`, made of the basis of degree n − |α| by `∂ₐB_β = n (B_{β−eₐ} − B_{β−e_V})` once an order.
/// Orders above n are zero. Error: at most `4(n + 2|α| + 2)·u` times the sum of the absolute values of all terms.
///
/// # Errors
/// [`BernsteinError::BufferLength`] unless `out` holds `simplex_count::<V>(order)` such rows,
/// [`BernsteinError::Degree`] above [`MAX_DEGREE`].
pub fn simplex_basis_partials<const V: usize>(
    degree: usize,
    lambda: [f64; V],
    order: usize,
    out: &mut [f64],
) -> Result<(), BernsteinError> {
    check::<V>(degree, order, out)?;
    let mut orders = [0; V];
    orders[V - 1] = order;
    for row in out.chunks_exact_mut(simplex_count::<V>(degree)).rev() {
        let total = order - orders[0];
        if let Some(lower) = degree.checked_sub(total) {
            fill(lower, &lambda, &mut row[..simplex_count::<V>(lower)]);
            let axes = orders[1..].iter().enumerate().flat_map(|(a, &k)| std::iter::repeat_n(a, k));
            for (m, axis) in (lower + 1..).zip(axes) {
                raise::<V>(m, axis, row);
            }
        } else {
            row.fill(0.0);
        }
        step_back(&mut orders);
    }
    Ok(())
}

fn check<const V: usize>(degree: usize, order: usize, out: &[f64]) -> Result<(), BernsteinError> {
    const { assert!(V >= 2, "a simplex has two vertices or more") };
    if degree > MAX_DEGREE {
        return Err(BernsteinError::Degree { degree, limit: MAX_DEGREE });
    }
    check_length("out", out.len(), simplex_count::<V>(order).saturating_mul(simplex_count::<V>(degree)))
}

/// `C(n,r) λ₁ⁿ⁻ʳ` times the basis of degree r in the other coordinates, for all r.
fn fill(n: usize, lambda: &[f64], out: &mut [f64]) {
    let (first, others) = match *lambda {
        [] => return,
        [last] => return out.fill(last.powi(i32::try_from(n).unwrap_or(i32::MAX))),
        [s, t] => return basis_barycentric(s, t, out),
        [first, ref others @ ..] => (first, others),
    };
    let mut row = Row::new(n);
    let mut power = Halves::new(first);
    let mut factor = 1.0;
    let mut rest = out;
    for i in 0..=n {
        let r = n - i;
        // The last so many places are those of the basis of degree r in one variable fewer.
        let length = (0..others.len() - 1).fold(1, |c, d| c * (r + 1 + d) / (d + 1));
        let (before, block) = rest.split_at_mut(rest.len().saturating_sub(length));
        rest = before;
        fill(r, others, block);
        if i > 0 {
            factor = power.next_times(row.coefficient(i));
        }
        for b in block {
            *b *= factor;
        }
    }
}

/// `m (B_{β−eₐ} − B_{β−e_V})`, from degree m − 1 to m, in place: what is read stands at lower places.
fn raise<const V: usize>(m: usize, axis: usize, row: &mut [f64]) {
    let mut index = [0; V];
    index[V - 1] = m;
    loop {
        let lowered = |vertex: usize| {
            let mut lower = index;
            match lower[vertex].checked_sub(1) {
                Some(entry) => {
                    lower[vertex] = entry;
                    row[simplex_index(lower)]
                }
                None => 0.0,
            }
        };
        row[simplex_index(index)] = m as f64 * (lowered(axis) - lowered(V - 1));
        if !step_back(&mut index) {
            break;
        }
    }
}
