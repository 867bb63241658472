//! What a control point must be able to do.

use std::ops::{Add, Div, Mul, Sub};

use glam::{DVec2, DVec3, DVec4};

/// A control point: an element of a real vector space, with numbers in f64.
///
/// Affine combinations are all that the kernels take of it. Implemented for `f64`, [`DVec2`], [`DVec3`] and
/// [`DVec4`] (homogeneous points, `(w·x, w·y, w·z, w)`).
pub trait Point:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
    + PartialEq
    + std::fmt::Debug
{
    /// The neutral element of addition.
    const ZERO: Self;
    /// The value that stands for "not defined": NaN in every component.
    const NAN: Self;

    /// Absolute values, component by component: the scale of error bounds is made of these.
    fn abs(self) -> Self;
    /// Euclidean length, `√Σxᵢ²`.
    fn norm(self) -> f64;
    /// Inner product, `Σ xᵢ yᵢ`.
    fn dot(self, other: Self) -> f64;
    /// Whether every component is finite.
    fn is_finite(self) -> bool;
}

macro_rules! point {
    ($($type:ty: $zero:expr, $norm:expr, $dot:expr;)*) => {$(
        impl Point for $type {
            const ZERO: Self = $zero;
            const NAN: Self = <$type>::NAN;

            fn abs(self) -> Self {
                <$type>::abs(self)
            }

            fn norm(self) -> f64 {
                $norm(self)
            }

            fn dot(self, other: Self) -> f64 {
                $dot(self, other)
            }

            fn is_finite(self) -> bool {
                <$type>::is_finite(self)
            }
        }
    )*};
}

point! {
    f64: 0.0, f64::abs, f64::mul;
    DVec2: DVec2::ZERO, DVec2::length, DVec2::dot;
    DVec3: DVec3::ZERO, DVec3::length, DVec3::dot;
    DVec4: DVec4::ZERO, DVec4::length, DVec4::dot;
}
