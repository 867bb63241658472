//! Several points at once: arithmetic on a few doubles side by side, and second-order jets over them.
//!
//! Plain loops over short arrays, which the compiler turns into vector instructions of whatever width the caller was
//! dispatched to. No operation mixes lanes, and a multiply-add is fused only where the source says so, so a point's
//! result has the same bits in every lane, block and instruction set.

// Loops over several arrays at once: an index says it best, and vectorises best.
#![allow(clippy::needless_range_loop)]

use std::ops::{Add, Div, Mul, Sub};

/// Points that are computed side by side.
pub(super) const LANES: usize = 8;

/// 2⁵²: from here on the last bit counts ones.
const TWO_52: f64 = 4_503_599_627_370_496.0;

/// One double for each of [`LANES`] points.
#[derive(Clone, Copy)]
pub(super) struct Lanes(pub(super) [f64; LANES]);

/// One truth value for each of [`LANES`] points: all bits or none, as vector comparisons give them.
#[derive(Clone, Copy)]
pub(super) struct Mask([u64; LANES]);

impl Lanes {
    pub(super) const ZERO: Self = Self([0.0; LANES]);

    #[inline(always)]
    pub(super) fn splat(x: f64) -> Self {
        Self([x; LANES])
    }

    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut out = [0.0; LANES];
        for l in 0..LANES {
            out[l] = f(self.0[l], other.0[l]);
        }
        Self(out)
    }

    #[inline(always)]
    fn compare(self, other: Self, f: impl Fn(f64, f64) -> bool) -> Mask {
        let mut out = [0; LANES];
        for l in 0..LANES {
            out[l] = if f(self.0[l], other.0[l]) { u64::MAX } else { 0 };
        }
        Mask(out)
    }

    #[inline(always)]
    pub(super) fn sqrt(self) -> Self {
        self.zip(self, |a, _| a.sqrt())
    }

    #[inline(always)]
    pub(super) fn abs(self) -> Self {
        self.zip(self, |a, _| a.abs())
    }

    /// The larger of the two; `other` where self is not a number.
    #[inline(always)]
    pub(super) fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    /// self·b + c with one rounding.
    #[inline(always)]
    pub(super) fn mul_add(self, b: Self, c: Self) -> Self {
        let mut out = [0.0; LANES];
        for l in 0..LANES {
            out[l] = self.0[l].mul_add(b.0[l], c.0[l]);
        }
        Self(out)
    }

    /// m and e with x = 2^e m, ½ ≤ m < 1, for positive normal numbers.
    #[inline(always)]
    pub(super) fn mantissa_and_exponent(self) -> (Self, Self) {
        const MANTISSA: u64 = (1 << 52) - 1;
        let (mut m, mut e) = ([0.0; LANES], [0.0; LANES]);
        for l in 0..LANES {
            let bits = self.0[l].to_bits();
            m[l] = f64::from_bits((bits & MANTISSA) | 0.5f64.to_bits());
            // The exponent as the last bits of 2⁵² + exponent.
            e[l] = f64::from_bits((bits >> 52) | TWO_52.to_bits()) - (TWO_52 + 1022.0);
        }
        (Self(m), Self(e))
    }

    /// self·2^n, n being the integer in the last bits of `shifted`; the result must be normal.
    #[inline(always)]
    pub(super) fn times_power_of_two(self, shifted: Self) -> Self {
        let mut out = [0.0; LANES];
        for l in 0..LANES {
            out[l] = f64::from_bits(self.0[l].to_bits().wrapping_add(shifted.0[l].to_bits() << 52));
        }
        Self(out)
    }

    /// Whether bit k of the representation is set.
    #[inline(always)]
    pub(super) fn bit(self, k: u32) -> Mask {
        let mut out = [0; LANES];
        for l in 0..LANES {
            out[l] = 0u64.wrapping_sub((self.0[l].to_bits() >> k) & 1);
        }
        Mask(out)
    }

    #[inline(always)]
    pub(super) fn less(self, other: Self) -> Mask {
        self.compare(other, |a, b| a < b)
    }

    #[inline(always)]
    pub(super) fn equal(self, other: Self) -> Mask {
        self.compare(other, |a, b| a == b)
    }
}

impl Mask {
    #[inline(always)]
    pub(super) fn or(self, other: Self) -> Self {
        let mut out = [0; LANES];
        for l in 0..LANES {
            out[l] = self.0[l] | other.0[l];
        }
        Self(out)
    }

    /// `yes` where true, `no` where false.
    #[inline(always)]
    pub(super) fn select(self, yes: Lanes, no: Lanes) -> Lanes {
        let mut out = [0.0; LANES];
        for l in 0..LANES {
            out[l] = f64::from_bits((self.0[l] & yes.0[l].to_bits()) | (!self.0[l] & no.0[l].to_bits()));
        }
        Lanes(out)
    }

    /// [`Mask::select`] in each entry.
    #[inline(always)]
    pub(super) fn select_jet(self, yes: Jet, no: Jet) -> Jet {
        Jet {
            f: self.select(yes.f, no.f),
            u: self.select(yes.u, no.u),
            v: self.select(yes.v, no.v),
            uu: self.select(yes.uu, no.uu),
            uv: self.select(yes.uv, no.uv),
            vv: self.select(yes.vv, no.vv),
        }
    }
}

impl Add for Lanes {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl Sub for Lanes {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl Mul for Lanes {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl Div for Lanes {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }
}

/// Value and partial derivatives to order 2 of a function of (u, v), at [`LANES`] points.
///
/// Where only the first order is stored in the end, the compiler drops the arithmetic of the second.
#[derive(Clone, Copy)]
pub(super) struct Jet {
    pub(super) f: Lanes,
    pub(super) u: Lanes,
    pub(super) v: Lanes,
    pub(super) uu: Lanes,
    pub(super) uv: Lanes,
    pub(super) vv: Lanes,
}

impl Jet {
    pub(super) const ZERO: Self = Self::linear(Lanes::ZERO, Lanes::ZERO, Lanes::ZERO);

    /// A function with a constant gradient.
    #[inline(always)]
    pub(super) const fn linear(f: Lanes, u: Lanes, v: Lanes) -> Self {
        Self { f, u, v, uu: Lanes::ZERO, uv: Lanes::ZERO, vv: Lanes::ZERO }
    }

    /// The constant 1.
    #[inline(always)]
    pub(super) fn one() -> Self {
        Self::linear(Lanes::splat(1.0), Lanes::ZERO, Lanes::ZERO)
    }

    #[inline(always)]
    pub(super) fn scale(self, c: Lanes) -> Self {
        Self {
            f: self.f * c,
            u: self.u * c,
            v: self.v * c,
            uu: self.uu * c,
            uv: self.uv * c,
            vv: self.vv * c,
        }
    }

    /// `g ∘ self`, from g, g' and g'' at self's value.
    #[inline(always)]
    pub(super) fn compose(self, g: Lanes, g1: Lanes, g2: Lanes) -> Self {
        Self {
            f: g,
            u: g1 * self.u,
            v: g1 * self.v,
            uu: g1 * self.uu + g2 * (self.u * self.u),
            uv: g1 * self.uv + g2 * (self.u * self.v),
            vv: g1 * self.vv + g2 * (self.v * self.v),
        }
    }
}

impl Add for Jet {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self {
            f: self.f + o.f,
            u: self.u + o.u,
            v: self.v + o.v,
            uu: self.uu + o.uu,
            uv: self.uv + o.uv,
            vv: self.vv + o.vv,
        }
    }
}

impl Sub for Jet {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        self + o.scale(Lanes::splat(-1.0))
    }
}

impl Mul for Jet {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        let two = Lanes::splat(2.0);
        Self {
            f: self.f * o.f,
            u: self.u * o.f + self.f * o.u,
            v: self.v * o.f + self.f * o.v,
            uu: self.uu * o.f + self.f * o.uu + two * (self.u * o.u),
            uv: self.uv * o.f + self.f * o.uv + (self.u * o.v + self.v * o.u),
            vv: self.vv * o.f + self.f * o.vv + two * (self.v * o.v),
        }
    }
}
