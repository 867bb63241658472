//! One polynomial at a register of parameters.
//!
//! With `qᵢ = C(n,i) Pᵢ` and s = 1 − t the polynomial is `sⁿ Σ qᵢ xⁱ`, x = t/s, and also `tⁿ Σ qₙ₋ᵢ yⁱ`, y =
//! s/t. Horner's scheme needs one fused multiply-add a coefficient for either. No term is larger than the
//! corresponding `|Bᵢⁿ(t) Pᵢ|`, wherever t is, so both are as accurate as nested multiplication: term i takes
//! the rounding of s n − i times, that of x i times, i + 1 roundings of Horner's scheme, those of qᵢ, and n
//! of the power, 3n + 4 together.
//!
//! Up to degree [`ONE_SIDED`] the first form serves every t but t = 1; xⁿ, at most 2⁵³ⁿ, leaves room for
//! coordinates up to 10¹⁵⁰. Above, each lane takes the form whose quotient is at most 1, that is the first
//! one for t ≤ ½.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use super::simd::Lanes;

/// Up to this degree the form in x = t/(1−t) is in range for all t.
pub(super) const ONE_SIDED: usize = 9;

/// A register of parameters, made ready for polynomials of any degree (`TWO_SIDED`) or of degrees up to
/// [`ONE_SIDED`].
#[derive(Clone, Copy)]
pub(super) struct Parameter<S: Lanes, const TWO_SIDED: bool> {
    simd: S,
    /// x, or y in the reversed lanes of the two-sided form.
    quotient: S::f64s,
    /// What the sum is to be multiplied by n times: s, or t in the reversed lanes of the two-sided form.
    base: S::f64s,
    /// The lanes that take the second form (two-sided), or those where t = 1 and x does not exist
    /// (one-sided).
    reversed: S::m64s,
    /// Whether `reversed` is true in any lane.
    some: bool,
    /// Whether it is true in some and false in others.
    mixed: bool,
}

impl<S: Lanes, const TWO_SIDED: bool> Parameter<S, TWO_SIDED> {
    #[inline(always)]
    pub(super) fn new(simd: S, t: S::f64s) -> Self {
        let s = simd.sub_f64s(simd.splat_f64s(1.0), t);
        if TWO_SIDED {
            let half = simd.splat_f64s(0.5);
            let reversed = simd.greater_than_f64s(t, half);
            let base = simd.select_f64s(reversed, t, s);
            let quotient = simd.div_f64s(simd.select_f64s(reversed, s, t), base);
            let some = simd.any(reversed);
            let mixed = some && simd.any(simd.less_than_or_equal_f64s(t, half));
            Self { simd, quotient, base, reversed, some, mixed }
        } else {
            let reversed = simd.equal_f64s(s, simd.splat_f64s(0.0));
            let quotient = simd.div_f64s(t, s);
            Self { simd, quotient, base: s, reversed, some: simd.any(reversed), mixed: false }
        }
    }

    /// The polynomial with the coefficients `C(n,i) Pᵢ`; zero where there are none.
    #[inline(always)]
    pub(super) fn value<const D: usize>(&self, coefficients: &[[f64; D]]) -> [S::f64s; D] {
        let simd = self.simd;
        let Some(degree) = coefficients.len().checked_sub(1) else { return [simd.splat_f64s(0.0); D] };
        let power = simd.power(self.base, degree);
        let mut value = if TWO_SIDED && self.mixed {
            self.mixed_sum(coefficients)
        } else if TWO_SIDED && self.some {
            horner(simd, coefficients.iter(), self.quotient)
        } else {
            horner(simd, coefficients.iter().rev(), self.quotient)
        };
        for c in 0..D {
            value[c] = simd.mul_f64s(value[c], power);
        }
        if TWO_SIDED || !self.some {
            return value;
        }
        select(simd, self.reversed, splat(simd, &coefficients[degree]), value)
    }

    /// Horner's scheme with the coefficients in the order that each lane wants.
    #[inline(always)]
    fn mixed_sum<const D: usize>(&self, coefficients: &[[f64; D]]) -> [S::f64s; D] {
        let simd = self.simd;
        let mut pairs = coefficients.iter().zip(coefficients.iter().rev());
        let Some((reversed, kept)) = pairs.next() else { return [simd.splat_f64s(0.0); D] };
        let mut sum = select(simd, self.reversed, splat(simd, reversed), splat(simd, kept));
        for (reversed, kept) in pairs {
            let next = select(simd, self.reversed, splat(simd, reversed), splat(simd, kept));
            for c in 0..D {
                sum[c] = simd.mul_add_f64s(sum[c], self.quotient, next[c]);
            }
        }
        sum
    }
}

/// `(… (q₀ x + q₁) x + …) x + qₙ`; zero where there are no coefficients.
#[inline(always)]
fn horner<'a, S: Lanes, const D: usize>(
    simd: S,
    mut coefficients: impl Iterator<Item = &'a [f64; D]>,
    x: S::f64s,
) -> [S::f64s; D] {
    let Some(first) = coefficients.next() else { return [simd.splat_f64s(0.0); D] };
    let mut sum = splat(simd, first);
    for next in coefficients {
        for c in 0..D {
            sum[c] = simd.mul_add_f64s(sum[c], x, simd.splat_f64s(next[c]));
        }
    }
    sum
}

/// One point in all lanes.
#[inline(always)]
pub(super) fn splat<S: Lanes, const D: usize>(simd: S, point: &[f64; D]) -> [S::f64s; D] {
    let mut lanes = [simd.splat_f64s(0.0); D];
    for c in 0..D {
        lanes[c] = simd.splat_f64s(point[c]);
    }
    lanes
}

/// `yes` in the lanes where `mask` is true, `no` in the others.
#[inline(always)]
pub(super) fn select<S: Lanes, const D: usize>(
    simd: S,
    mask: S::m64s,
    yes: [S::f64s; D],
    no: [S::f64s; D],
) -> [S::f64s; D] {
    let mut chosen = no;
    for c in 0..D {
        chosen[c] = simd.select_f64s(mask, yes[c], no[c]);
    }
    chosen
}
