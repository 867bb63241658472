//! Binomial coefficients: a table for the degrees in daily use, a recurrence for the others.

use std::borrow::Cow;

/// The largest degree served: `C(500, 250)` is about 10¹⁴⁹, which leaves room for coordinates up to 10¹⁵⁰.
pub const MAX_DEGREE: usize = 500;

/// Degrees below this one are read from the table.
const TABLE: usize = 32;

/// Pascal's triangle; every entry is an integer below 2⁵³ and so exact.
static PASCAL: [[f64; TABLE]; TABLE] = pascal();

const fn pascal() -> [[f64; TABLE]; TABLE] {
    let mut rows = [[0.0; TABLE]; TABLE];
    let mut n = 0;
    while n < TABLE {
        rows[n][0] = 1.0;
        let mut i = 1;
        while i <= n {
            rows[n][i] = rows[n - 1][i - 1] + rows[n - 1][i];
            i += 1;
        }
        n += 1;
    }
    rows
}

/// Binomial coefficient `C(n, i) = n! / (i! (n−i)!)`; 0 for `i > n`.
///
/// Exact up to n = 50; above, relative error at most `2·min(i, n−i)·u`. Cost: a table look-up for n < 32,
/// otherwise min(i, n−i) divisions.
#[must_use]
pub fn binomial(n: usize, i: usize) -> f64 {
    match PASCAL.get(n) {
        Some(row) => row.get(i).copied().unwrap_or(0.0),
        None if i > n => 0.0,
        None => (1..=i.min(n - i)).fold(1.0, |c, j| next(c, n, j)),
    }
}

/// `C(n, i)` from `C(n, i−1)`. The product is formed first, so that the quotient is exact while it fits 53
/// bits.
fn next(previous: f64, n: usize, i: usize) -> f64 {
    previous * (n + 1 - i) as f64 / i as f64
}

/// All coefficients of one degree, each within 1 ulp: from the table, or by the recurrence in twice the
/// precision.
pub(crate) fn binomials(n: usize) -> Cow<'static, [f64]> {
    if let Some(row) = PASCAL.get(n) {
        return Cow::Borrowed(&row[..=n]);
    }
    let mut row = vec![1.0; n.saturating_add(1)];
    let (mut high, mut low) = (1.0_f64, 0.0);
    for i in 1..=n / 2 {
        let (factor, divisor) = ((n + 1 - i) as f64, i as f64);
        let product = high * factor;
        let rest = high.mul_add(factor, -product) + low * factor;
        let quotient = product / divisor;
        let remainder = quotient.mul_add(-divisor, product) + rest;
        let correction = remainder / divisor;
        high = quotient + correction;
        low = correction - (high - quotient);
        (row[i], row[n - i]) = (high, high);
    }
    Cow::Owned(row)
}

/// The coefficients of one degree, asked for in ascending order.
pub(crate) struct Row {
    table: Option<&'static [f64; TABLE]>,
    n: usize,
    last: f64,
}

impl Row {
    #[inline]
    pub(crate) fn new(n: usize) -> Self {
        Self { table: PASCAL.get(n), n, last: 1.0 }
    }

    /// `C(n, i)`, to be called with i = 1, 2, 3, … in turn.
    #[inline]
    pub(crate) fn coefficient(&mut self, i: usize) -> f64 {
        match self.table {
            Some(row) => row.get(i).copied().unwrap_or(0.0),
            None if i == self.n => 1.0,
            None => {
                self.last = next(self.last, self.n, i);
                self.last
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn table_and_recurrence_agree() {
        assert_eq!(binomial(31, 15), 300_540_195.0);
        assert_eq!(binomial(50, 25), 126_410_606_437_752.0);
        assert_eq!(binomial(40, 0), 1.0);
        assert_eq!(binomial(40, 40), 1.0);
        assert_eq!((binomial(3, 4), binomial(40, 41)), (0.0, 0.0));
        for n in 32..=50 {
            for i in 1..n {
                assert_eq!(binomial(n, i), binomial(n - 1, i - 1) + binomial(n - 1, i), "C({n}, {i})");
            }
        }
        assert!(binomial(MAX_DEGREE, MAX_DEGREE / 2).is_finite());
    }

    #[test]
    fn whole_rows_are_correct_to_the_last_bit_or_next_to_it() {
        use num_bigint::BigInt;
        use num_rational::BigRational;
        use num_traits::Signed;
        for n in [0, 5, 31, 32, 57, 100, 200, MAX_DEGREE] {
            let mut exact = BigInt::from(1);
            for (i, &c) in binomials(n).iter().enumerate() {
                let got = BigRational::from_float(c).unwrap();
                let off = (got / BigRational::from_integer(exact.clone()) - BigInt::from(1)).abs();
                assert!(off <= BigRational::from_float(f64::EPSILON).unwrap(), "C({n}, {i})");
                exact = exact * (n - i) / (i + 1);
            }
        }
    }
}
