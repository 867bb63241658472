//! Numbers that the formula runs on: one point, or several points at once.
//!
//! The formula of the patch is written once, over [`Scalar`]. `f64` evaluates one point, [`Vector`] as many points as the
//! processor's vector registers hold, and the jets of the next module carry derivatives along. All of them do the same
//! operations in the same order on the value, none of them fused, so all of them give the same bits.

use std::ops::{Add, Mul, Sub};

use pulp::Simd;

/// Below this a share of the denominators is taken as exactly zero, so that their squares stay in range. Such a side's
/// blends are at most this number: the value cannot tell.
pub(crate) const UNDERFLOW: f64 = 1e-140;

/// What the formula needs of a number.
pub(crate) trait Scalar: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// The constant x, of the same kind as self.
    fn like(self, x: f64) -> Self;
    fn scale(self, x: f64) -> Self;
    fn reciprocal(self) -> Self;
    /// max(self, 0). Where self < 0 its derivatives are kept if `noise` says that the true value is not negative and only
    /// its error is, and are zero otherwise; at 0 they are kept, being those of the side where self > 0.
    fn clamped(self, noise: bool) -> Self;
    /// (a/(a+b), b/(a+b)) for a, b ≥ 0. Where both vanish the derivatives tell the limit, see
    /// [`Second`](crate::jet::Second); a value alone takes (0, 0), which is as good since it is multiplied by zero.
    fn shares(a: Self, b: Self) -> (Self, Self);
    /// (a^p/(a^p+b^p), b^p/(a^p+b^p)) for a, b ≥ 0; (½, ½) where both vanish.
    fn blends(a: Self, b: Self, p: u32) -> (Self, Self);
}

/// Numbers without derivatives.
pub(crate) trait Real: Scalar {
    fn quotient(self, divisor: Self) -> Self;
    /// `x` where a ≤ b, else `y`.
    fn select(a: Self, b: Self, x: Self, y: Self) -> Self;
    /// Whether any lane is at most zero.
    fn any_zero(self) -> bool;
}

/// x^p by squaring, p ≥ 1.
#[inline(always)]
pub(crate) fn power<T: Scalar>(x: T, p: u32) -> T {
    let mut result = x;
    let mut rest = p.saturating_sub(1);
    let mut square = x;
    while rest > 0 {
        if rest & 1 == 1 {
            result = result * square;
        }
        rest >>= 1;
        if rest > 0 {
            square = square * square;
        }
    }
    result
}

/// The share formula for plain numbers.
#[inline(always)]
fn real_shares<T: Real>(a: T, b: T) -> (T, T) {
    let sum = a + b;
    let (limit, zero, one) = (a.like(UNDERFLOW), a.like(0.0), a.like(1.0));
    let divisor = T::select(sum, limit, one, sum);
    (T::select(sum, limit, zero, a).quotient(divisor), T::select(sum, limit, zero, b).quotient(divisor))
}

/// The blend formula for plain numbers: by the ratio of the smaller to the larger, which neither over- nor underflows.
#[inline(always)]
fn real_blends<T: Real>(a: T, b: T, p: u32) -> (T, T) {
    let (zero, one) = (a.like(0.0), a.like(1.0));
    let (small, large) = (T::select(a, b, a, b), T::select(a, b, b, a));
    // Both zero: the ratio 1 gives one half each.
    let ratio = T::select(large, zero, one, small).quotient(T::select(large, zero, one, large));
    let ratio = power(ratio, p);
    let major = (one + ratio).reciprocal();
    let minor = ratio * major;
    (T::select(a, b, minor, major), T::select(a, b, major, minor))
}

impl Scalar for f64 {
    #[inline(always)]
    fn like(self, x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn scale(self, x: f64) -> Self {
        self * x
    }
    #[inline(always)]
    fn reciprocal(self) -> Self {
        1.0 / self
    }
    #[inline(always)]
    fn clamped(self, _noise: bool) -> Self {
        if self <= 0.0 { 0.0 } else { self }
    }
    #[inline(always)]
    fn shares(a: Self, b: Self) -> (Self, Self) {
        real_shares(a, b)
    }
    #[inline(always)]
    fn blends(a: Self, b: Self, p: u32) -> (Self, Self) {
        real_blends(a, b, p)
    }
}

impl Real for f64 {
    #[inline(always)]
    fn quotient(self, divisor: Self) -> Self {
        self / divisor
    }
    #[inline(always)]
    fn select(a: Self, b: Self, x: Self, y: Self) -> Self {
        if a <= b { x } else { y }
    }
    #[inline(always)]
    fn any_zero(self) -> bool {
        self <= UNDERFLOW
    }
}

/// Points kept side by side in memory: a multiple of every vector register's length.
pub(crate) const LANES: usize = 8;

/// As many points as a vector register holds; the token `simd` says that the processor has such registers.
#[derive(Clone, Copy)]
pub(crate) struct Vector<S: Simd> {
    simd: S,
    lanes: S::f64s,
}

impl<S: Simd> Vector<S> {
    /// Points in a register.
    pub(crate) const WIDTH: usize = S::F64_LANES;

    #[inline(always)]
    pub(crate) fn zero(simd: S) -> Self {
        Self { simd, lanes: simd.splat_f64s(0.0) }
    }

    /// The first numbers of a slice that is long enough.
    #[inline(always)]
    pub(crate) fn load(simd: S, slice: &[f64]) -> Self {
        let (vectors, _) = S::as_simd_f64s(slice);
        Self { simd, lanes: vectors[0] }
    }

    /// Stores into the first numbers of a slice that is long enough.
    #[inline(always)]
    pub(crate) fn store(self, slice: &mut [f64]) {
        let (vectors, _) = S::as_mut_simd_f64s(slice);
        vectors[0] = self.lanes;
    }

    /// The lanes as plain numbers; those beyond the register's length are zero.
    #[inline(always)]
    pub(crate) fn to_array(self) -> [f64; LANES] {
        let mut array = [0.0; LANES];
        self.store(&mut array);
        array
    }
}

impl<S: Simd> Add for Vector<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { simd: self.simd, lanes: self.simd.add_f64s(self.lanes, other.lanes) }
    }
}

impl<S: Simd> Sub for Vector<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { simd: self.simd, lanes: self.simd.sub_f64s(self.lanes, other.lanes) }
    }
}

impl<S: Simd> Mul for Vector<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self { simd: self.simd, lanes: self.simd.mul_f64s(self.lanes, other.lanes) }
    }
}

impl<S: Simd> Scalar for Vector<S> {
    #[inline(always)]
    fn like(self, x: f64) -> Self {
        Self { simd: self.simd, lanes: self.simd.splat_f64s(x) }
    }
    #[inline(always)]
    fn scale(self, x: f64) -> Self {
        self * self.like(x)
    }
    #[inline(always)]
    fn reciprocal(self) -> Self {
        self.like(1.0).quotient(self)
    }
    #[inline(always)]
    fn clamped(self, _noise: bool) -> Self {
        let zero = self.like(0.0);
        Self::select(self, zero, zero, self)
    }
    #[inline(always)]
    fn shares(a: Self, b: Self) -> (Self, Self) {
        real_shares(a, b)
    }
    #[inline(always)]
    fn blends(a: Self, b: Self, p: u32) -> (Self, Self) {
        real_blends(a, b, p)
    }
}

impl<S: Simd> Real for Vector<S> {
    #[inline(always)]
    fn quotient(self, divisor: Self) -> Self {
        Self { simd: self.simd, lanes: self.simd.div_f64s(self.lanes, divisor.lanes) }
    }
    #[inline(always)]
    fn select(a: Self, b: Self, x: Self, y: Self) -> Self {
        let mask = a.simd.less_than_or_equal_f64s(a.lanes, b.lanes);
        Self { simd: a.simd, lanes: a.simd.select_f64s(mask, x.lanes, y.lanes) }
    }
    #[inline(always)]
    fn any_zero(self) -> bool {
        self.simd.reduce_min_f64s(self.lanes) <= UNDERFLOW
    }
}
