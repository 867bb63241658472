//! Logarithm, exponential, sine and cosine, and angle, of several numbers at once.
//!
//! The standard library has them for one number only, and eight calls of each cost more than all the rest of a
//! coordinate. These are the textbook reductions followed by Taylor series, without branches, so that vector registers
//! are full. Each is within 2 units in the last place of its result (sine, cosine and the angle: of 1).

use super::super::lanes::Lanes;

/// 1.5·2⁵²: added to a number below 2⁵¹, it leaves the nearest integer in the last bits.
const ROUND: f64 = 6_755_399_441_055_744.0;
/// ln 2 in two parts, the first with 33 bits, so that its products with exponents are exact.
const LN_2: [f64; 2] = [0.693_147_180_485_539_1, 7.440_617_110_012_397e-11];
/// π/2 in two parts.
const HALF_PI: [f64; 2] = [std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17];
/// tan(π/8)
const TAN_EIGHTH: f64 = std::f64::consts::SQRT_2 - 1.0;

/// `Σ c[i] z^i`.
#[inline(always)]
fn horner<const N: usize>(z: Lanes, c: &[f64; N]) -> Lanes {
    let mut sum = Lanes::splat(c[N - 1]);
    for &c in c[..N - 1].iter().rev() {
        sum = sum.mul_add(z, Lanes::splat(c));
    }
    sum
}

/// Of positive normal numbers: `x = 2^e m`, √½ ≤ m < √2, `ln m = 2 artanh((m−1)/(m+1))`.
#[inline(always)]
pub(super) fn ln(x: Lanes) -> Lanes {
    const SERIES: [f64; 11] = {
        let mut c = [0.0; 11];
        let mut k = 0;
        while k < 11 {
            c[k] = 1.0 / (2 * k + 3) as f64;
            k += 1;
        }
        c
    };
    let (m, e) = x.mantissa_and_exponent();
    let low = m.less(Lanes::splat(std::f64::consts::FRAC_1_SQRT_2));
    let one = Lanes::splat(1.0);
    let m = low.select(m + m, m);
    let e = low.select(e - one, e);
    let s = (m - one) / (m + one);
    let z = s * s;
    let twice = s + s;
    let small = (twice * z).mul_add(horner(z, &SERIES), e * Lanes::splat(LN_2[1]));
    e.mul_add(Lanes::splat(LN_2[0]), twice + small)
}

/// `e^x = 2^n e^r`, |r| ≤ ½ ln 2; x is raised to −707 and lowered to 708.
#[inline(always)]
pub(super) fn exp(x: Lanes) -> Lanes {
    const SERIES: [f64; 14] = {
        let mut c = [1.0; 14];
        let mut k = 1;
        while k < 14 {
            c[k] = c[k - 1] / k as f64;
            k += 1;
        }
        c
    };
    let (low, high) = (Lanes::splat(-707.0), Lanes::splat(708.0));
    let x = x.less(low).select(low, x);
    let x = high.less(x).select(high, x);
    let shifted = x.mul_add(Lanes::splat(std::f64::consts::LOG2_E), Lanes::splat(ROUND));
    let n = shifted - Lanes::splat(ROUND);
    let r = n.mul_add(Lanes::splat(-LN_2[0]), x);
    let r = n.mul_add(Lanes::splat(-LN_2[1]), r);
    horner(r, &SERIES).times_power_of_two(shifted)
}

/// By `x = n π/2 + r`, |r| ≤ π/4; for |x| up to 10⁶.
#[inline(always)]
pub(super) fn sin_cos(x: Lanes) -> (Lanes, Lanes) {
    const SINE: [f64; 8] = alternating(2);
    const COSINE: [f64; 8] = alternating(1);
    let shifted = x.mul_add(Lanes::splat(std::f64::consts::FRAC_2_PI), Lanes::splat(ROUND));
    let n = shifted - Lanes::splat(ROUND);
    let r = n.mul_add(Lanes::splat(-HALF_PI[0]), x);
    let r = n.mul_add(Lanes::splat(-HALF_PI[1]), r);
    let z = r * r;
    let sine = (r * z).mul_add(horner(z, &SINE), r);
    let cosine = z.mul_add(horner(z, &COSINE), Lanes::splat(1.0));
    let odd = shifted.bit(0);
    let (s, c) = (odd.select(cosine, sine), odd.select(sine, cosine));
    let zero = Lanes::ZERO;
    let next = (n + Lanes::splat(1.0)) + Lanes::splat(ROUND);
    (shifted.bit(1).select(zero - s, s), next.bit(1).select(zero - c, c))
}

/// −1/(first·(first+1)), +1/(first·…·(first+3)), …: the Taylor coefficients of sine (first = 2) and cosine (first = 1)
/// after the leading one.
const fn alternating(first: usize) -> [f64; 8] {
    let mut c = [0.0; 8];
    let mut term = 1.0;
    let mut k = 0;
    while k < 8 {
        let m = first + 2 * k;
        term /= -((m * (m + 1)) as f64);
        c[k] = term;
        k += 1;
    }
    c
}

/// The angle of (x, y), by the arctangent of the smaller part over the larger, less π/4 where that is above tan(π/8).
#[inline(always)]
pub(super) fn atan2(y: Lanes, x: Lanes) -> Lanes {
    const SERIES: [f64; 20] = {
        let mut c = [0.0; 20];
        let mut k = 0;
        while k < 20 {
            let sign = if k % 2 == 0 { -1.0 } else { 1.0 };
            c[k] = sign / (2 * k + 3) as f64;
            k += 1;
        }
        c
    };
    let (ax, ay) = (x.abs(), y.abs());
    let steep = ax.less(ay);
    let (large, small) = (steep.select(ay, ax), steep.select(ax, ay));
    let turned = (large * Lanes::splat(TAN_EIGHTH)).less(small);
    let zero = Lanes::ZERO;
    let t = turned.select(small - large, small) / turned.select(small + large, large);
    let z = t * t;
    let base = turned.select(Lanes::splat(std::f64::consts::FRAC_PI_4), zero);
    let angle = base + (t * z).mul_add(horner(z, &SERIES), t);
    let angle = steep.select(Lanes::splat(HALF_PI[0]) - angle, angle);
    let angle = x.less(zero).select(Lanes::splat(std::f64::consts::PI) - angle, angle);
    y.less(zero).select(zero - angle, angle)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers spread over magnitudes, both signs.
    fn numbers(count: usize, least: i32, most: i32) -> impl Iterator<Item = f64> {
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        (0..count).map(move |_| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let unit = (state >> 11) as f64 / (1u64 << 53) as f64;
            let exponent = least + ((state >> 3) % (most - least + 1) as u64) as i32;
            let sign = if state & 1 == 0 { 1.0 } else { -1.0 };
            sign * (1.0 + unit) * 2f64.powi(exponent)
        })
    }

    fn ulps(got: f64, exact: f64, least: f64) -> f64 {
        (got - exact).abs() / (exact.abs().max(least) * f64::EPSILON)
    }

    #[test]
    fn logarithms_and_exponentials() {
        for x in
            numbers(20_000, -400, 400).chain([1.0, 0.5, 2.0, 1.0 + f64::EPSILON, 1.0 - f64::EPSILON / 2.0])
        {
            let x = x.abs();
            assert!(ulps(ln(Lanes::splat(x)).0[3], x.ln(), f64::MIN_POSITIVE) <= 2.0, "ln {x:e}");
        }
        for x in numbers(20_000, -40, 9).chain([0.0, 1.0, -1.0, 707.9, -706.9]).filter(|x| x.abs() < 707.0) {
            assert!(ulps(exp(Lanes::splat(x)).0[5], x.exp(), 0.0) <= 2.0, "exp {x:e}");
        }
        assert!(exp(Lanes::splat(-1e9)).0[0] < 1e-300);
    }

    #[test]
    fn angles() {
        for x in numbers(20_000, -60, 12).chain([0.0, 1.0, std::f64::consts::FRAC_PI_2, std::f64::consts::PI])
        {
            let (sin, cos) = sin_cos(Lanes::splat(x));
            let (s, c) = x.sin_cos();
            assert!(ulps(sin.0[0], s, 1.0) <= 1.0 && ulps(cos.0[7], c, 1.0) <= 1.0, "sin, cos {x:e}");
        }
        for (y, x) in numbers(20_000, -30, 30).zip(numbers(30_000, -30, 30).skip(7)) {
            let angle = atan2(Lanes::splat(y), Lanes::splat(x)).0[2];
            assert!(ulps(angle, y.atan2(x), 1.0) <= 2.0, "atan2 {y:e} {x:e}: {angle}");
        }
        for (y, x, angle) in
            [(0.0, 1.0, 0.0), (1.0, 0.0, HALF_PI[0]), (0.0, -2.0, 2.0 * HALF_PI[0]), (-3.0, 0.0, -HALF_PI[0])]
        {
            assert_eq!(atan2(Lanes::splat(y), Lanes::splat(x)).0[1], angle);
        }
    }
}
