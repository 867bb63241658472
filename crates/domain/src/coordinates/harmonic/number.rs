//! Numbers that the functions of a cell are computed in: one point (`f64`), or several side by side ([`Lanes`]).

use std::ops::{Add, Div, Mul, Sub};

use super::super::lanes::Lanes;
use super::elementary;

/// A real number, or one for each lane.
pub(super) trait Real:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    fn of(x: f64) -> Self;
    /// `yes` where self < limit, `no` elsewhere.
    fn select_less(self, limit: f64, yes: Self, no: Self) -> Self;
    /// Of a positive normal number.
    fn ln(self) -> Self;
    /// Below −707 it stays at e^−707.
    fn exp(self) -> Self;
    fn sin_cos(self) -> (Self, Self);
    /// The angle of (x, self), which is not (0, 0).
    fn atan2(self, x: Self) -> Self;
}

impl Real for f64 {
    #[inline(always)]
    fn of(x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn select_less(self, limit: f64, yes: Self, no: Self) -> Self {
        if self < limit { yes } else { no }
    }
    #[inline(always)]
    fn ln(self) -> Self {
        f64::ln(self)
    }
    #[inline(always)]
    fn exp(self) -> Self {
        f64::exp(self)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        f64::sin_cos(self)
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        f64::atan2(self, x)
    }
}

impl Real for Lanes {
    #[inline(always)]
    fn of(x: f64) -> Self {
        Self::splat(x)
    }
    #[inline(always)]
    fn select_less(self, limit: f64, yes: Self, no: Self) -> Self {
        self.less(Self::splat(limit)).select(yes, no)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        elementary::ln(self)
    }
    #[inline(always)]
    fn exp(self) -> Self {
        elementary::exp(self)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        elementary::sin_cos(self)
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        elementary::atan2(self, x)
    }
}

/// A complex number.
#[derive(Clone, Copy)]
pub(super) struct Complex<T> {
    pub(super) re: T,
    pub(super) im: T,
}

impl<T: Real> Complex<T> {
    #[inline(always)]
    pub(super) fn of(re: f64, im: f64) -> Self {
        Self { re: T::of(re), im: T::of(im) }
    }

    #[inline(always)]
    pub(super) fn scale(self, x: T) -> Self {
        Self { re: self.re * x, im: self.im * x }
    }

    #[inline(always)]
    pub(super) fn norm_sqr(self) -> T {
        self.re * self.re + self.im * self.im
    }

    #[inline(always)]
    pub(super) fn inv(self) -> Self {
        let inverse = T::of(1.0) / self.norm_sqr();
        Self { re: self.re * inverse, im: T::of(0.0) - self.im * inverse }
    }

    /// i·self
    #[inline(always)]
    pub(super) fn times_i(self) -> Self {
        Self { re: T::of(0.0) - self.im, im: self.re }
    }

    /// −i·self
    #[inline(always)]
    pub(super) fn over_i(self) -> Self {
        Self { re: self.im, im: T::of(0.0) - self.re }
    }

    /// e^self
    #[inline(always)]
    pub(super) fn exp(self) -> Self {
        let (sin, cos) = self.im.sin_cos();
        let r = self.re.exp();
        Self { re: r * cos, im: r * sin }
    }

    /// `yes` where x < limit, `no` elsewhere.
    #[inline(always)]
    pub(super) fn select_less(x: T, limit: f64, yes: Self, no: Self) -> Self {
        Self { re: x.select_less(limit, yes.re, no.re), im: x.select_less(limit, yes.im, no.im) }
    }
}

impl<T: Real> Add for Complex<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl<T: Real> Sub for Complex<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl<T: Real> Mul for Complex<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self { re: self.re * other.re - self.im * other.im, im: self.re * other.im + self.im * other.re }
    }
}
