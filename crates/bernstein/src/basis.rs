//! The Bernstein basis of an interval, and its derivatives.

use crate::binomial::{MAX_DEGREE, Row};

/// All Bernstein polynomials of degree n at `t`, `Bᵢⁿ(t) = C(n,i) tⁱ (1−t)ⁿ⁻ⁱ`, with n + 1 the length of `out`.
///
/// `t` may lie outside `[0, 1]`. On it the values are non-negative and add up to 1 within `3(n+1)·u`; each has
/// relative error at most `3(n+1)·u`, as long as it is above the smallest normal number. Cost: 6n
/// multiplications. An empty `out` stays so.
///
/// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 5.1.
pub fn basis(t: f64, out: &mut [f64]) {
    basis_barycentric(1.0 - t, t, out);
}

/// The Bernstein polynomials in two independent variables, `C(n,i) sⁿ⁻ⁱ tⁱ`, n + 1 being the length of `out`.
///
/// With `s = 1 − t` this is [`basis`]; given separately, a tiny `s` keeps its relative accuracy near `t = 1`,
/// which
/// `1 − t` would round away. Error and cost as for [`basis`].
///
/// ```
/// let mut b = [0.0; 3];
/// casteljau_bernstein::basis_barycentric(1e-20, 1.0, &mut b);
/// assert_eq!(b, [1e-40, 2e-20, 1.0]);
/// ```
pub fn basis_barycentric(s: f64, t: f64, out: &mut [f64]) {
    let Some(n) = out.len().checked_sub(1) else { return };
    if n > MAX_DEGREE {
        out.fill(f64::NAN);
        return;
    }
    let mut row = Row::new(n);
    let mut power = Halves::new(t);
    out[0] = 1.0;
    for (i, b) in out.iter_mut().enumerate().skip(1) {
        *b = power.next_times(row.coefficient(i));
    }
    power = Halves::new(s);
    for b in out[..n].iter_mut().rev() {
        *b = power.next_times(*b);
    }
}

/// The powers x, x², x³, …, each kept as a product of two, so that one that multiplies a large binomial
/// coefficient does not vanish before the product does.
pub(crate) struct Halves {
    x: f64,
    larger: f64,
    smaller: f64,
}

impl Halves {
    #[inline]
    pub(crate) fn new(x: f64) -> Self {
        Self { x, larger: 1.0, smaller: 1.0 }
    }

    /// `factor` times the next power.
    #[inline]
    pub(crate) fn next_times(&mut self, factor: f64) -> f64 {
        (self.larger, self.smaller) = (self.smaller * self.x, self.larger);
        factor * self.larger * self.smaller
    }
}

/// The Bernstein basis and its derivatives up to `order`: row k of `out` is
/// `dᵏBᵢⁿ/dtᵏ = n!/(n−k)! Σⱼ (−1)ᵏ⁻ʲ C(k,j) Bᵢ₋ⱼⁿ⁻ᵏ`, for i = 0…n.
///
/// `out` holds `order + 1` rows of n + 1 numbers, one after another; what is left over of its length is set
/// to 0, and so are the rows of orders above n. Error: `4(n + 2k + 2)·u` times the sum of the absolute values
/// of the terms above.
/// Cost: O(n) for row 0, O(n·k) for row k.
///
/// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 5.3.
pub fn basis_derivatives(t: f64, order: usize, out: &mut [f64]) {
    let width = out.len() / order.saturating_add(1);
    let Some(n) = width.checked_sub(1) else {
        out.fill(0.0);
        return;
    };
    let mut rest = out;
    for k in 0..=order {
        let (row, later) = rest.split_at_mut(width);
        rest = later;
        let Some(lower) = n.checked_sub(k) else {
            row.fill(0.0);
            continue;
        };
        basis(t, &mut row[..=lower]);
        // Each pass goes up one degree: (Bᵢᵐ)' = m (Bᵢ₋₁ᵐ⁻¹ − Bᵢᵐ⁻¹), where the basis of degree m−1 ends at i
        // = m−1.
        for m in lower + 1..=n {
            let degree = m as f64;
            row[m] = degree * row[m - 1];
            for i in (1..m).rev() {
                row[i] = degree * (row[i - 1] - row[i]);
            }
            row[0] *= -degree;
        }
    }
    rest.fill(0.0);
}
