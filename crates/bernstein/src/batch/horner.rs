//! One polynomial at a register of parameters.
//!
//! With `qᵢ = C(n,i) Pᵢ` and s = 1 − t the polynomial is `sⁿ Σ qᵢ xⁱ`, x = t/s, and also `tⁿ Σ qₙ₋ᵢ yⁱ`, y =
//! s/t. Horner's scheme needs one fused multiply-add a coefficient for either. No term is larger than the
//! corresponding `|Bᵢⁿ(t) Pᵢ|`, wherever t is, so both are as accurate as nested multiplication: term i takes
//! the rounding of s n − i times, that of x i times, i + 1 roundings of Horner's scheme, those of qᵢ, and n
//! of the power, 3n + 4 together.
//!
//! The first form is taken unless t is so near 1 that (1 + |x|)ⁿ leaves the range of numbers; the bound 2⁴⁷⁷
//! leaves room for coordinates up to 10¹⁵⁰. Up to degree 9 only t = 1 and its neighbour are so near, at
//! degree 25 what is within 2⁻¹⁸ of 1; for degrees of 239 and more the second form is taken for all t > ½.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use super::simd::Lanes;

/// Degrees up to this one, or total degrees of patches, have the first form for all parameters that are not
/// 1.
pub(super) const ONE_SIDED: usize = 9;

/// The open interval of the parameters that take the second form, at degree n.
pub(super) fn reversed_interval(degree: usize) -> [f64; 2] {
    // With |s| ≥ 2⁻ˡ, 1 + |x| is at most 2 + 2ˡ ≤ 2ˡ⁺¹, and Σ C(n,i)|xⁱ| = (1 + |x|)ⁿ.
    match (477 / degree.max(1)).saturating_sub(1).min(52) {
        0 => [0.5, f64::INFINITY],
        l => {
            [1.0 - f64::EPSILON * (1_u64 << (52 - l)) as f64, 1.0 + f64::EPSILON * (1_u64 << (52 - l)) as f64]
        }
    }
}

/// A register of parameters, made ready for polynomials of some degree.
#[derive(Clone, Copy)]
pub(super) struct Parameter<S: Lanes> {
    pub(super) simd: S,
    /// x, or y in the reversed lanes.
    pub(super) quotient: S::f64s,
    /// What the sum is to be multiplied by n times: s, or t in the reversed lanes.
    pub(super) base: S::f64s,
    /// The lanes that take the second form.
    pub(super) reversed: S::m64s,
    /// Whether there may be such lanes.
    pub(super) some: bool,
}

impl<S: Lanes> Parameter<S> {
    /// Of the parameters t, given the [`reversed_interval`] of the largest degree.
    #[inline(always)]
    pub(super) fn new(simd: S, t: S::f64s, [low, high]: [f64; 2]) -> Self {
        let s = simd.sub_f64s(simd.splat_f64s(1.0), t);
        let above = simd.greater_than_f64s(t, simd.splat_f64s(low));
        let reversed = simd.and_m64s(above, simd.less_than_f64s(t, simd.splat_f64s(high)));
        let some = simd.any(reversed);
        let (mut numerator, mut base) = (t, s);
        if some {
            numerator = simd.select_f64s(reversed, s, t);
            base = simd.select_f64s(reversed, t, s);
        }
        Self { simd, quotient: simd.div_f64s(numerator, base), base, reversed, some }
    }

    /// The polynomial with the coefficients `C(n,i) Pᵢ`; zero where there are none. `MIXED` is the field
    /// `some`, so that kernels ask once for all their polynomials.
    #[inline(always)]
    pub(super) fn value<const D: usize, const MIXED: bool>(&self, coefficients: &[[f64; D]]) -> [S::f64s; D] {
        let simd = self.simd;
        let mut value = self.sum::<D, MIXED>(coefficients);
        let power = simd.power(self.base, coefficients.len().saturating_sub(1));
        for c in 0..D {
            value[c] = simd.mul_f64s(value[c], power);
        }
        value
    }

    /// The polynomial without the power of s or t.
    #[inline(always)]
    pub(super) fn sum<const D: usize, const MIXED: bool>(&self, coefficients: &[[f64; D]]) -> [S::f64s; D] {
        if MIXED {
            return self.mixed_sum(coefficients);
        }
        horner(self.simd, coefficients, self.quotient)
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

/// `(… (qₙ x + qₙ₋₁) x + …) x + q₀`; zero where there are no coefficients.
#[inline(always)]
pub(super) fn horner<S: Lanes, const D: usize>(
    simd: S,
    coefficients: &[[f64; D]],
    x: S::f64s,
) -> [S::f64s; D] {
    let Some((last, rest)) = coefficients.split_last() else { return [simd.splat_f64s(0.0); D] };
    let mut sum = splat(simd, last);
    for next in rest.iter().rev() {
        for c in 0..D {
            sum[c] = simd.mul_add_f64s(sum[c], x, simd.splat_f64s(next[c]));
        }
    }
    sum
}

/// One point in all lanes.
#[inline(always)]
fn splat<S: Lanes, const D: usize>(simd: S, point: &[f64; D]) -> [S::f64s; D] {
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
