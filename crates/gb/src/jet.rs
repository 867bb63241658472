//! Numbers with their derivatives in (u, v), to first or second order.

use std::ops::{Add, Mul, Sub};

use crate::scalar::{Real, Scalar, UNDERFLOW, power};

/// f, f_u, f_v.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct First<T>(pub [T; 3]);

/// f, f_u, f_v, f_uu, f_uv, f_vv.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Second<T>(pub [T; 6]);

/// What the rules below need beyond arithmetic.
trait Jet: Scalar {
    type Value: Real;
    fn value(self) -> Self::Value;
    fn with_value(self, value: Self::Value) -> Self;
    /// Component by component, where `a` ≤ `b`.
    fn select(a: Self::Value, b: Self::Value, x: Self, y: Self) -> Self;
    /// The quotient a/(a+b) where a and b vanish together, from their derivatives.
    fn limit(a: Self, sum: Self) -> Self;
}

// Written out component by component: closures over arrays of six vectors are not inlined, which costs a factor of ten.
macro_rules! jet_arithmetic {
    ($jet:ident, $($i:literal),*) => {
        impl<T: Real> Add for $jet<T> {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                Self([$(self.0[$i] + other.0[$i]),*])
            }
        }
        impl<T: Real> Sub for $jet<T> {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                Self([$(self.0[$i] - other.0[$i]),*])
            }
        }
        impl<T: Real> Scalar for $jet<T> {
            #[inline(always)]
            fn like(self, x: f64) -> Self {
                let value = self.0[0];
                Self([$(value.like(if $i == 0 { x } else { 0.0 })),*])
            }
            #[inline(always)]
            fn scale(self, x: f64) -> Self {
                Self([$(self.0[$i].scale(x)),*])
            }
            #[inline(always)]
            fn reciprocal(self) -> Self {
                self.inverse()
            }
            #[inline(always)]
            fn clamped(self, noise: bool) -> Self {
                let (value, zero) = (self.0[0], self.0[0].like(0.0));
                if noise {
                    self.with_value(value.clamped(true))
                } else {
                    Jet::select(zero, value, self, self.like(0.0))
                }
            }
            #[inline(always)]
            fn shares(a: Self, b: Self) -> (Self, Self) {
                jet_shares(a, b)
            }
            #[inline(always)]
            fn blends(a: Self, b: Self, p: u32) -> (Self, Self) {
                jet_blends(a, b, p)
            }
        }
    };
}
jet_arithmetic!(First, 0, 1, 2);
jet_arithmetic!(Second, 0, 1, 2, 3, 4, 5);

impl<T: Real> Mul for First<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let ([a, au, av], [b, bu, bv]) = (self.0, other.0);
        Self([a * b, au * b + a * bu, av * b + a * bv])
    }
}

impl<T: Real> Mul for Second<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let ([a, au, av, auu, auv, avv], [b, bu, bv, buu, buv, bvv]) = (self.0, other.0);
        Self([
            a * b,
            au * b + a * bu,
            av * b + a * bv,
            auu * b + (au * bu).scale(2.0) + a * buu,
            auv * b + (au * bv + av * bu) + a * buv,
            avv * b + (av * bv).scale(2.0) + a * bvv,
        ])
    }
}

impl<T: Real> First<T> {
    #[inline(always)]
    fn inverse(self) -> Self {
        let [a, au, av] = self.0;
        let r = a.reciprocal();
        let slope = (r * r).scale(-1.0);
        Self([r, slope * au, slope * av])
    }
}

impl<T: Real> Second<T> {
    #[inline(always)]
    fn inverse(self) -> Self {
        let [a, au, av, auu, auv, avv] = self.0;
        let r = a.reciprocal();
        let slope = (r * r).scale(-1.0);
        // 2/a³, with the first derivatives scaled before they are multiplied.
        let (ru, rv) = (au * r, av * r);
        let two = r.scale(2.0);
        Self([
            r,
            slope * au,
            slope * av,
            slope * auu + two * (ru * ru),
            slope * auv + two * (ru * rv),
            slope * avv + two * (rv * rv),
        ])
    }
}

impl<T: Real> Jet for First<T> {
    type Value = T;
    #[inline(always)]
    fn value(self) -> T {
        self.0[0]
    }
    #[inline(always)]
    fn with_value(self, value: T) -> Self {
        Self([value, self.0[1], self.0[2]])
    }
    #[inline(always)]
    fn select(a: T, b: T, x: Self, y: Self) -> Self {
        let ([x, xu, xv], [y, yu, yv]) = (x.0, y.0);
        Self([T::select(a, b, x, y), T::select(a, b, xu, yu), T::select(a, b, xv, yv)])
    }
    #[inline(always)]
    fn limit(a: Self, sum: Self) -> Self {
        let zero = a.0[0].like(0.0);
        Self([limit_value([a.0[1], a.0[2]], [sum.0[1], sum.0[2]]), zero, zero])
    }
}

impl<T: Real> Jet for Second<T> {
    type Value = T;
    #[inline(always)]
    fn value(self) -> T {
        self.0[0]
    }
    #[inline(always)]
    fn with_value(self, value: T) -> Self {
        let mut jet = self.0;
        jet[0] = value;
        Self(jet)
    }
    #[inline(always)]
    fn select(a: T, b: T, x: Self, y: Self) -> Self {
        let ([x, xu, xv, xuu, xuv, xvv], [y, yu, yv, yuu, yuv, yvv]) = (x.0, y.0);
        Self([
            T::select(a, b, x, y),
            T::select(a, b, xu, yu),
            T::select(a, b, xv, yv),
            T::select(a, b, xuu, yuu),
            T::select(a, b, xuv, yuv),
            T::select(a, b, xvv, yvv),
        ])
    }
    /// With g = ∇sum, D = ∇²a − s ∇²sum: s = a_n/sum_n and ∇s = (D g − ½ (gᵀDg) g/|g|²)/|g|². The second derivatives of s
    /// need third ones of a; they are not needed, since the factor (1 − h)^l vanishes, and are set to zero.
    #[inline(always)]
    fn limit(a: Self, sum: Self) -> Self {
        let (zero, one) = (a.0[0].like(0.0), a.0[0].like(1.0));
        let [_, au, av, auu, auv, avv] = a.0;
        let [_, gu, gv, huu, huv, hvv] = sum.0;
        let s = limit_value([au, av], [gu, gv]);
        let (duu, duv, dvv) = (auu - s * huu, auv - s * huv, avv - s * hvv);
        let square = gu * gu + gv * gv;
        let divisor = T::select(square, zero, one, square);
        let (wu, wv) = (duu * gu + duv * gv, duv * gu + dvv * gv);
        let half = (wu * gu + wv * gv).quotient(divisor).scale(0.5);
        let (su, sv) = ((wu - half * gu).quotient(divisor), (wv - half * gv).quotient(divisor));
        Self([s, T::select(square, zero, zero, su), T::select(square, zero, zero, sv), zero, zero, zero])
    }
}

/// a_n/sum_n along ∇sum, kept in [0, 1] where it must lie since 0 ≤ a ≤ sum inside; ½ where ∇sum vanishes.
#[inline(always)]
fn limit_value<T: Real>(a: [T; 2], g: [T; 2]) -> T {
    let (zero, one) = (a[0].like(0.0), a[0].like(1.0));
    let square = g[0] * g[0] + g[1] * g[1];
    let s = (a[0] * g[0] + a[1] * g[1]).quotient(T::select(square, zero, one, square));
    let s = T::select(square, zero, zero.like(0.5), s);
    T::select(s, one, s.clamped(true), one)
}

#[inline(always)]
fn jet_shares<J: Jet>(a: J, b: J) -> (J, J) {
    let sum = a + b;
    let (one, value) = (sum.like(1.0), sum.value());
    // The values are those of plain numbers, to the bit.
    let (sa, sb) = J::Value::shares(a.value(), b.value());
    if !value.any_zero() {
        let inverse = sum.reciprocal();
        return ((a * inverse).with_value(sa), (b * inverse).with_value(sb));
    }
    let least = value.like(UNDERFLOW);
    let inverse = J::select(value, least, one, sum).reciprocal();
    let limit = J::limit(a, sum);
    (
        J::select(value, least, limit, (a * inverse).with_value(sa)),
        J::select(value, least, one - limit, (b * inverse).with_value(sb)),
    )
}

#[inline(always)]
fn jet_blends<J: Jet>(a: J, b: J, p: u32) -> (J, J) {
    let (va, vb) = (a.value(), b.value());
    let (zero, one) = (va.like(0.0), a.like(1.0));
    let (small, large) = (J::select(va, vb, a, b), J::select(va, vb, b, a));
    let value = large.value();
    let divisor = J::select(value, zero, one, large);
    let ratio = (J::select(value, zero, one, small) * divisor.reciprocal())
        .with_value(J::Value::select(value, zero, one.value(), small.value()).quotient(divisor.value()));
    let ratio = power(ratio, p);
    let major = (one + ratio).reciprocal();
    let minor = ratio * major;
    (J::select(va, vb, minor, major), J::select(va, vb, major, minor))
}
