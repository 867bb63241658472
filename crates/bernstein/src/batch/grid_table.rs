//! What is made once of the parameters of a grid, for all its rows and nets.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use super::horner::{Parameter, reversed_interval};
use super::simd::{Lanes, WIDTH};
use crate::{MAX_DEGREE, basis};

/// Highest order of derivatives that batches have.
pub(super) const MAX_ORDER: usize = 2;

/// Columns of this degree have their basis tabulated, and so one operation less a component; of others it would not fit into
/// the first cache.
pub(super) const TABULATED: usize = 3;

/// Whether grids of columns of degree `N` take the table for `K` kinds of derivatives: on patches it pays for values alone.
pub(super) const fn takes_table(n: usize, kinds: usize) -> bool {
    n == TABULATED && (kinds == 1 || kinds == 4)
}

/// The rows u = constant: the Bernstein polynomials of degrees m, m − 1, m − 2.
#[derive(Debug, Clone)]
pub(super) struct Rows {
    pub(super) degree: usize,
    /// Number of parameters.
    pub(super) count: usize,
    /// Whether all of them lie in `[0, 1]`.
    pub(super) inside: bool,
    /// `Bᵢᵐ⁻ᵏ(u)` of order k: i fastest, then the parameter.
    basis: Vec<Vec<f64>>,
}

impl Rows {
    /// The basis for derivatives up to `order`.
    pub(super) fn new(degree: usize, parameters: &[f64], order: usize) -> Self {
        let of_order = |k: usize| {
            let width = (degree + 1).saturating_sub(k);
            let mut all = vec![0.0; parameters.len() * width];
            if width > 0 {
                all.chunks_exact_mut(width).zip(parameters).for_each(|(row, &u)| basis(u, row));
            }
            all
        };
        let basis = (0..=order).map(of_order).collect();
        Self { degree, count: parameters.len(), inside: are_inside(parameters), basis }
    }

    /// Highest order of derivatives.
    pub(super) fn order(&self) -> usize {
        self.basis.len() - 1
    }

    /// `Bᵢᵐ⁻ᵏ` at one parameter.
    #[inline(always)]
    pub(super) fn basis(&self, order: usize, at: usize) -> &[f64] {
        let width = (self.degree + 1).saturating_sub(order);
        &self.basis[order][at * width..(at + 1) * width]
    }

    /// `Σᵢ |Bᵢᵐ(u)|`: 1 inside `[0, 1]`.
    pub(super) fn spread(&self, at: usize) -> f64 {
        self.basis(0, at).iter().map(|b| b.abs()).sum()
    }
}

/// The columns v = constant: the quotients of Horner's scheme, see `horner.rs`.
///
/// The vectors are padded to whole registers with the last parameter's numbers.
#[derive(Debug, Clone)]
pub(super) struct Columns {
    pub(super) degree: usize,
    /// Number of parameters.
    pub(super) count: usize,
    /// Whether all of them lie in `[0, 1]`.
    pub(super) inside: bool,
    parameters: Vec<f64>,
    quotients: Vec<f64>,
    bases: Vec<f64>,
    /// 1/base
    inverses: Vec<f64>,
    /// 1 where the second form is taken, 0 where not.
    reversed: Vec<f64>,
    /// Whether it is, anywhere in each block of [`WIDTH`] columns.
    some: Vec<bool>,
    /// `Bⱼⁿ⁻ᵏ(v)` of order k at degree [`TABULATED`]: a block of [`WIDTH`] columns after the other, in each j by j.
    basis: [Vec<f64>; MAX_ORDER + 1],
}

impl Columns {
    pub(super) fn new(degree: usize, parameters: &[f64]) -> Self {
        let (count, inside) = (parameters.len(), are_inside(parameters));
        let mut parameters = parameters.to_vec();
        parameters.resize(count.next_multiple_of(WIDTH), parameters.last().copied().unwrap_or_default());
        let [low, high] = reversed_interval(degree);
        let is_reversed = |v: f64| low < v && v < high;
        let base = |v: f64| if is_reversed(v) { v } else { 1.0 - v };
        let tabulated = if degree == TABULATED { &parameters[..] } else { &[] };
        let basis = [0, 1, 2].map(|k| tabulate(tabulated, degree.saturating_sub(k)));
        let of = |number: &dyn Fn(f64) -> f64| parameters.iter().map(|&v| number(v)).collect::<Vec<_>>();
        Self {
            degree,
            count,
            inside,
            quotients: of(&|v| if is_reversed(v) { (1.0 - v) / base(v) } else { v / base(v) }),
            bases: of(&base),
            inverses: of(&|v| 1.0 / base(v)),
            reversed: of(&|v| f64::from(is_reversed(v))),
            some: parameters.chunks(WIDTH).map(|block| block.iter().any(|&v| is_reversed(v))).collect(),
            basis,
            parameters,
        }
    }

    /// The columns from `first` on.
    #[inline(always)]
    pub(super) fn parameter<S: Lanes>(&self, simd: S, first: usize) -> Parameter<S> {
        let zero = simd.splat_f64s(0.0);
        Parameter {
            simd,
            quotient: simd.load(&self.quotients, first),
            base: simd.load(&self.bases, first),
            reversed: simd.greater_than_f64s(simd.load(&self.reversed, first), zero),
            some: self.some[first / WIDTH],
        }
    }

    /// `Σⱼ Bⱼⁿ⁻ᵏ(v) cⱼ`, of order `B`, at the columns from `first` on, for columns of degree [`TABULATED`].
    #[inline(always)]
    pub(super) fn by_table<S: Lanes, const D: usize, const B: usize>(
        &self,
        simd: S,
        first: usize,
        curve: &[[f64; D]],
    ) -> [S::f64s; D] {
        const { assert!(B <= MAX_ORDER) };
        let height = TABULATED + 1 - B;
        let block = &self.basis[B][first / WIDTH * height * WIDTH..][..height * WIDTH];
        let mut sum = [simd.splat_f64s(0.0); D];
        for j in 0..height {
            let basis = simd.load(block, j * WIDTH + first % WIDTH);
            for c in 0..D {
                let coefficient = simd.splat_f64s(curve[j][c]);
                sum[c] = if j == 0 {
                    simd.mul_f64s(basis, coefficient)
                } else {
                    simd.mul_add_f64s(basis, coefficient, sum[c])
                };
            }
        }
        sum
    }

    /// 1/base of the columns from `first` on.
    #[inline(always)]
    pub(super) fn inverse<S: Lanes>(&self, simd: S, first: usize) -> S::f64s {
        simd.load(&self.inverses, first)
    }

    /// `Bⱼⁿ` at one parameter, in part of `row`.
    pub(super) fn basis<'a>(&self, at: usize, row: &'a mut [f64; MAX_DEGREE + 1]) -> &'a [f64] {
        let row = &mut row[..=self.degree];
        basis(self.parameters[at], row);
        row
    }
}

/// The basis of a degree at whole blocks of parameters.
fn tabulate(parameters: &[f64], degree: usize) -> Vec<f64> {
    let mut table = vec![0.0; parameters.len() * (degree + 1)];
    let mut column = [0.0; TABULATED + 1];
    let blocks = table.chunks_exact_mut((degree + 1) * WIDTH).zip(parameters.chunks_exact(WIDTH));
    for (block, parameters) in blocks {
        for (l, &v) in parameters.iter().enumerate() {
            basis(v, &mut column[..=degree]);
            block.iter_mut().skip(l).step_by(WIDTH).zip(column).for_each(|(to, b)| *to = b);
        }
    }
    table
}

fn are_inside(parameters: &[f64]) -> bool {
    parameters.iter().all(|t| (0.0..=1.0).contains(t))
}
