//! The referee: Bernstein polynomials in exact rational arithmetic.
//!
//! Every f64 is a rational number, so kernels can be compared with the truth itself. Nothing here is clever:
//! formulas are written as in the books.
#![allow(dead_code)] // every test file uses its own share of this

use num_bigint::BigInt;
use num_traits::{One, Zero};

use super::U;
pub use super::rational::Q;

/// The rational number that an f64 is.
pub fn exact(x: f64) -> Q {
    Q::from_float(x).unwrap()
}

pub fn exacts(x: &[f64]) -> Vec<Q> {
    x.iter().copied().map(exact).collect()
}

pub fn absolutes(x: &[Q]) -> Vec<Q> {
    x.iter().map(Q::abs).collect()
}

pub fn integer(n: usize) -> Q {
    Q::from_integer(BigInt::from(n))
}

pub fn factorial(n: usize) -> Q {
    Q::from_integer((1..=n).map(BigInt::from).product())
}

/// `C(n, k)`, 0 for k > n.
pub fn choose(n: usize, k: usize) -> Q {
    let c = if k > n { 0.into() } else { (0..k).fold(BigInt::from(1), |c, j| c * (n - j) / (j + 1)) };
    Q::from_integer(c)
}

/// `xᵏ`, with x⁰ = 1.
pub fn power(x: &Q, k: usize) -> Q {
    num_traits::pow(x.clone(), k)
}

/// `1, x, …, xⁿ`.
pub fn powers(x: &Q, n: usize) -> Vec<Q> {
    std::iter::successors(Some(Q::one()), |p| Some(p * x)).take(n + 1).collect()
}

/// All `C(n,i) sⁿ⁻ⁱ tⁱ`; s + t need not be 1.
pub fn basis_of(n: usize, s: &Q, t: &Q) -> Vec<Q> {
    let (in_s, in_t) = (powers(s, n), powers(t, n));
    (0..=n).map(|i| choose(n, i) * &in_s[n - i] * &in_t[i]).collect()
}

/// All Bernstein polynomials of degree n at t.
pub fn basis(n: usize, t: &Q) -> Vec<Q> {
    basis_of(n, &(Q::one() - t), t)
}

/// The same with both variables taken absolutely: the weights in the scale of an error bound.
pub fn absolute_basis(n: usize, t: &Q) -> Vec<Q> {
    basis_of(n, &(Q::one() - t).abs(), &t.abs())
}

pub fn dot(a: &[Q], b: &[Q]) -> Q {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The product of two polynomials on the interval.
pub fn product(a: &[Q], b: &[Q]) -> Vec<Q> {
    let (m, n) = (a.len() - 1, b.len() - 1);
    let scaled = |list: &[Q], degree| -> Vec<Q> {
        list.iter().enumerate().map(|(i, p)| choose(degree, i) * p).collect()
    };
    let mut out = vec![Q::zero(); m + n + 1];
    let b = scaled(b, n);
    for (i, a) in scaled(a, m).iter().enumerate() {
        for (j, b) in b.iter().enumerate() {
            out[i + j] += a * b;
        }
    }
    out.into_iter().enumerate().map(|(k, p)| p / choose(m + n, k)).collect()
}

/// Value of a polynomial on the interval.
pub fn value(points: &[Q], t: &Q) -> Q {
    dot(&basis(points.len() - 1, t), points)
}

/// The sum of the absolute contributions to [`value`].
pub fn scale(points: &[Q], t: &Q) -> Q {
    dot(&absolute_basis(points.len() - 1, t), &absolutes(points))
}

/// Derivative polynomial, with its n points.
pub fn differentiate(points: &[Q]) -> Vec<Q> {
    let degree = integer(points.len() - 1);
    points.windows(2).map(|w| (&w[1] - &w[0]) * &degree).collect()
}

/// Affine combinations by a list of pairs (1 − t, t), one level each: the blossom. With pairs taken absolutely,
/// and points too, its scale.
pub fn blossom_of(points: &[Q], pairs: &[(Q, Q)]) -> Q {
    let mut level = points.to_vec();
    for (s, t) in pairs {
        level = level.windows(2).map(|w| &w[0] * s + &w[1] * t).collect();
    }
    assert_eq!(level.len(), 1, "as many arguments as the degree");
    level.remove(0)
}

pub fn pair(t: &Q) -> (Q, Q) {
    (Q::one() - t, t.clone())
}

pub fn absolute_pair(t: &Q) -> (Q, Q) {
    ((Q::one() - t).abs(), t.abs())
}

/// The lines of a net along an axis, each mapped to a new line (of any common length): tensor kernels are
/// one-variable kernels along each axis in turn.
pub fn along<T: Clone>(points: &[T], degrees: &[usize], axis: usize, map: impl Fn(&[T]) -> Vec<T>) -> Vec<T> {
    let count = degrees[axis] + 1;
    let block: usize = degrees[axis + 1..].iter().map(|d| d + 1).product();
    let mut out = Vec::new();
    for slab in points.chunks(count * block) {
        let lines: Vec<Vec<T>> =
            (0..block).map(|j| map(&slab[j..].iter().step_by(block).cloned().collect::<Vec<_>>())).collect();
        for i in 0..lines[0].len() {
            out.extend(lines.iter().map(|line| line[i].clone()));
        }
    }
    out
}

/// Value of a tensor product; `weights[axis]` are the basis functions along that axis.
pub fn tensor_sum(points: &[Q], weights: &[Vec<Q>]) -> Q {
    match weights.split_first() {
        None => points[0].clone(),
        Some((first, rest)) => {
            let slab = points.len() / first.len();
            first.iter().zip(points.chunks(slab)).map(|(w, p)| w * tensor_sum(p, rest)).sum()
        }
    }
}

/// `|computed − exact| ≤ factor·u·scale`, but for the smallest normal number.
#[track_caller]
pub fn assert_within(computed: f64, truth: &Q, scale: &Q, factor: usize, what: &str) {
    assert!(computed.is_finite(), "{what}: {computed}");
    let off = (exact(computed) - truth).abs();
    let allowed = (scale * integer(factor)).times_power_of_two(-53);
    if off <= allowed {
        return;
    }
    assert!(
        off <= &allowed + exact(f64::MIN_POSITIVE),
        "{what}: {computed:e} instead of {:e}, off {:e}, allowed {:e}",
        truth.to_f64(),
        off.to_f64(),
        allowed.to_f64()
    );
}

/// The bound that every kernel keeps: `4(degree + 2·order + 2)`.
pub fn factor(degree: usize, order: usize) -> usize {
    4 * (degree + 2 * order + 2)
}

/// So many random cases; as many as `PROPTEST_CASES` says where that is more.
pub fn rounds(usual: usize) -> usize {
    let asked = std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok());
    asked.unwrap_or(0).max(usual)
}

/// A repeatable source of numbers that hunt for trouble: half of them near 0, ±1 or a power of two, the rest
/// with exponents spread; repeats are frequent.
pub struct Hunter(u64);

impl Hunter {
    /// Other numbers for another seed, and for another `PROPTEST_RNG_SEED`.
    pub fn new(seed: u64) -> Self {
        let run: u64 =
            std::env::var("PROPTEST_RNG_SEED").ok().and_then(|seed| seed.parse().ok()).unwrap_or(0);
        Self((seed ^ run << 32).wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    pub fn bits(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }

    /// One of 0, …, n − 1.
    pub fn below(&mut self, n: usize) -> usize {
        ((self.bits() >> 33) as usize) % n
    }

    /// Evenly in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * U
    }

    /// A coordinate.
    pub fn number(&mut self) -> f64 {
        let sign = if self.bits() & 1 == 0 { 1.0 } else { -1.0 };
        let ulps = self.below(65) as f64 - 32.0;
        sign * match self.below(8) {
            0 => 0.0,
            1 => 1.0 + ulps * U,
            2 => 2_f64.powi(self.below(81) as i32 - 40) * (1.0 + ulps * 2.0 * U),
            3 => self.unit() * 2_f64.powi(self.below(61) as i32 - 30),
            4 if self.below(8) == 0 => self.unit() * 2_f64.powi(-(self.below(900) as i32)),
            _ => self.unit() * 4.0 - 2.0,
        }
    }

    /// Coordinates, with repeats.
    pub fn numbers(&mut self, count: usize) -> Vec<f64> {
        let mut list: Vec<f64> = Vec::with_capacity(count);
        for i in 0..count {
            let x = if i > 0 && self.below(6) == 0 { list[i - 1] } else { self.number() };
            list.push(x);
        }
        list
    }

    /// A parameter: inside, at the ends, very near them, and outside.
    pub fn parameter(&mut self) -> f64 {
        match self.below(12) {
            0 => 0.0,
            1 => 1.0,
            2 => self.below(64) as f64 * U,
            3 => 1.0 - self.below(64) as f64 * U,
            4 => 2_f64.powi(-(self.below(60) as i32)),
            5 => self.unit() * 3.0 - 1.0,
            _ => self.unit(),
        }
    }

    /// A degree: mostly small, one in fifty up to `most`, and of these each third `most` itself.
    pub fn degree(&mut self, most: usize) -> usize {
        self.degree_of(9, most, 50)
    }

    /// A degree up to `usual`; one in `rarely` up to `most`, and of these each third `most` itself.
    pub fn degree_of(&mut self, usual: usize, most: usize, rarely: usize) -> usize {
        if self.below(rarely) > 0 {
            self.below(most.min(usual) + 1)
        } else if self.below(3) == 0 {
            most
        } else {
            self.below(most + 1)
        }
    }

    /// Degrees of a box: small, one in forty 20 along one axis.
    pub fn box_degrees(&mut self) -> [usize; 3] {
        let mut degrees = [0; 3].map(|_: usize| self.below(4));
        if self.below(40) == 0 {
            degrees[self.below(3)] = 20;
        }
        degrees
    }
}
