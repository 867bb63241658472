//! Exact numbers, as fast as a referee of thousands of cases needs them.

use std::cmp::Ordering;
use std::iter::{Product, Sum};
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// A rational number `m·2ᵉ/d`, d > 0 and odd.
///
/// Numbers made of f64 by sums and products keep d = 1, and d stays short where binomial coefficients are divided
/// by. So fractions are never reduced, which would take longer than all the rest; unreduced they are as exact.
#[derive(Clone, Debug)]
pub struct Q {
    m: BigInt,
    e: i64,
    d: BigInt,
}

impl Q {
    /// The number that an f64 is; `None` if it is not finite.
    pub fn from_float(x: f64) -> Option<Self> {
        let exact = BigRational::from_float(x)?;
        // The denominator is a power of two.
        let e = 1 - i64::try_from(exact.denom().bits()).ok()?;
        Some(Self { m: exact.numer().clone(), e, d: BigInt::one() })
    }

    pub fn from_integer(n: BigInt) -> Self {
        Self { m: n, e: 0, d: BigInt::one() }
    }

    pub fn abs(&self) -> Self {
        Self { m: self.m.abs(), e: self.e, d: self.d.clone() }
    }

    /// −1, 0 or 1.
    pub fn signum(&self) -> i32 {
        match self.cmp(&Self::zero()) {
            Ordering::Less => -1,
            Ordering::Equal => 0,
            Ordering::Greater => 1,
        }
    }

    /// `x·2ᵏ`
    pub fn times_power_of_two(mut self, k: i64) -> Self {
        self.e += k;
        self
    }

    /// As a fraction of integers.
    pub fn fraction(&self) -> BigRational {
        let power = BigInt::one() << self.e.unsigned_abs();
        if self.e < 0 {
            BigRational::new_raw(self.m.clone(), &self.d * power)
        } else {
            BigRational::new_raw(&self.m * power, self.d.clone())
        }
    }

    /// The nearest f64.
    pub fn to_f64(&self) -> f64 {
        self.fraction().to_f64().unwrap()
    }
}

/// `a·2^(from−to)`, from ≥ to.
fn shifted(a: &BigInt, from: i64, to: i64) -> BigInt {
    a << (from - to).unsigned_abs()
}

impl AddAssign<&Q> for Q {
    fn add_assign(&mut self, other: &Q) {
        if other.m.is_zero() {
            return;
        }
        if self.m.is_zero() {
            *self = other.clone();
            return;
        }
        let e = self.e.min(other.e);
        if self.e > e {
            self.m = shifted(&self.m, self.e, e);
            self.e = e;
        }
        if self.d == other.d {
            if other.e == e {
                self.m += &other.m
            } else {
                self.m += shifted(&other.m, other.e, e)
            }
            return;
        }
        let common = common_divisor(&self.d, &other.d);
        let (own, theirs) = (&other.d / &common, &self.d / common);
        self.m = &self.m * &own + shifted(&other.m, other.e, e) * theirs;
        self.d = &self.d * own;
    }
}

/// The greatest common divisor of two odd numbers, by Euclid's algorithm.
fn common_divisor(a: &BigInt, b: &BigInt) -> BigInt {
    let (mut a, mut b) = (a.clone(), b.clone());
    while !b.is_zero() {
        let rest = &a % &b;
        (a, b) = (b, rest);
    }
    a
}

impl Neg for Q {
    type Output = Q;
    fn neg(mut self) -> Q {
        self.m = -self.m;
        self
    }
}

impl Neg for &Q {
    type Output = Q;
    fn neg(self) -> Q {
        -self.clone()
    }
}

impl SubAssign<&Q> for Q {
    fn sub_assign(&mut self, other: &Q) {
        *self += &-other;
    }
}

impl MulAssign<&Q> for Q {
    fn mul_assign(&mut self, other: &Q) {
        self.m *= &other.m;
        self.e += other.e;
        if !other.d.is_one() {
            self.d *= &other.d;
        }
    }
}

impl Q {
    fn divide(&mut self, other: &Q) {
        let twos = other.m.trailing_zeros().unwrap();
        let odd = &other.m >> twos;
        self.m *= &other.d;
        self.e -= other.e + i64::try_from(twos).unwrap();
        if odd.is_negative() {
            self.m = -std::mem::take(&mut self.m);
        }
        self.d *= odd.abs();
    }
}

/// An operator for numbers and references to them, by a function that changes the left one.
macro_rules! operator {
    ($name:ident, $method:ident, $change:expr) => {
        impl $name<&Q> for Q {
            type Output = Q;
            fn $method(mut self, other: &Q) -> Q {
                $change(&mut self, other);
                self
            }
        }
        impl $name<Q> for Q {
            type Output = Q;
            fn $method(self, other: Q) -> Q {
                self.$method(&other)
            }
        }
        impl $name<&Q> for &Q {
            type Output = Q;
            fn $method(self, other: &Q) -> Q {
                self.clone().$method(other)
            }
        }
        impl $name<Q> for &Q {
            type Output = Q;
            fn $method(self, other: Q) -> Q {
                self.clone().$method(&other)
            }
        }
    };
}

operator!(Add, add, Q::add_assign);
operator!(Sub, sub, Q::sub_assign);
operator!(Mul, mul, Q::mul_assign);
operator!(Div, div, Q::divide);

impl AddAssign for Q {
    fn add_assign(&mut self, other: Q) {
        *self += &other;
    }
}

impl SubAssign for Q {
    fn sub_assign(&mut self, other: Q) {
        *self -= &other;
    }
}

impl MulAssign for Q {
    fn mul_assign(&mut self, other: Q) {
        *self *= &other;
    }
}

impl Zero for Q {
    fn zero() -> Self {
        Self::from_integer(BigInt::zero())
    }
    fn is_zero(&self) -> bool {
        self.m.is_zero()
    }
}

impl One for Q {
    fn one() -> Self {
        Self::from_integer(BigInt::one())
    }
}

impl Sum for Q {
    fn sum<I: Iterator<Item = Q>>(numbers: I) -> Q {
        numbers.fold(Q::zero(), |sum, x| sum + x)
    }
}

impl<'a> Sum<&'a Q> for Q {
    fn sum<I: Iterator<Item = &'a Q>>(numbers: I) -> Q {
        numbers.fold(Q::zero(), |sum, x| sum + x)
    }
}

impl Product for Q {
    fn product<I: Iterator<Item = Q>>(numbers: I) -> Q {
        numbers.fold(Q::one(), |product, x| product * x)
    }
}

impl PartialEq for Q {
    fn eq(&self, other: &Q) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Q {}

impl PartialOrd for Q {
    fn partial_cmp(&self, other: &Q) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Q {
    fn cmp(&self, other: &Q) -> Ordering {
        (self - other).m.cmp(&BigInt::zero())
    }
}
