//! A net with its difference nets, and their contraction to the curves u = constant.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use super::grid_row::Curves;
use super::grid_table::Rows;
use super::simd::{Lanes, WIDTH};
use crate::{binomial, partial_index};

/// The orders (a, b) of ∂ᵃ⁺ᵇ/∂uᵃ∂vᵇ, in the order of [`partial_index`](crate::partial_index).
pub(super) const ORDERS: [[usize; 2]; 6] = [[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2]];

/// Degree of a kernel that takes every degree; those with a number have their loops unrolled.
pub(super) const ANY: usize = usize::MAX;

/// The nets `m!/(m−a)! · n!/(n−b)! · Δᵃ⁰Δ⁰ᵇ Pᵢⱼ` of the first `count` orders, for points of `dimension`
/// numbers.
#[derive(Debug, Clone)]
pub(super) struct Nets {
    degrees: [usize; 2],
    dimension: usize,
    /// Each followed by [`WIDTH`] numbers that registers may read and that mean nothing.
    of_order: Vec<Vec<f64>>,
    /// The curves of one row, of the same orders; likewise longer.
    curves: Vec<Vec<f64>>,
}

impl Nets {
    /// Room for the nets of the first `count` orders.
    pub(super) fn new(degrees: [usize; 2], dimension: usize, count: usize) -> Self {
        let room = |[a, b]: &[usize; 2]| {
            let [rows, columns] = extent(degrees, *a, *b);
            vec![0.0; rows * columns * dimension + WIDTH]
        };
        let curve = |[_, b]: &[usize; 2]| vec![0.0; extent(degrees, 0, *b)[1] * dimension + 2 * WIDTH];
        let orders = &ORDERS[..count.min(6)];
        Self {
            degrees,
            dimension,
            of_order: orders.iter().map(room).collect(),
            curves: orders.iter().map(curve).collect(),
        }
    }

    /// Takes another net, and makes its differences.
    #[inline(never)]
    pub(super) fn set(&mut self, net: &[f64]) {
        let [m, n] = self.degrees;
        self.of_order[0][..net.len()].copy_from_slice(net);
        for (place, &[a, b]) in ORDERS.iter().enumerate().take(self.of_order.len()).skip(1) {
            // Differences with v are taken of the net without them, those with u of the net with one less.
            let lower = match [a, b] {
                [2, 0] => 1,
                [1, 1] | [0, 2] => 2,
                _ => 0,
            };
            let (before, after) = self.of_order.split_at_mut(place);
            let (from, to) = (&before[lower], &mut after[0]);
            let [rows, columns] = extent(self.degrees, a, b);
            let in_u = a > 0;
            let factor = if in_u { (m + 1).saturating_sub(a) } else { (n + 1).saturating_sub(b) } as f64;
            let (length, wide) =
                (columns * self.dimension, if in_u { columns } else { columns + 1 } * self.dimension);
            let step = if in_u { wide } else { self.dimension };
            if length == 0 {
                continue;
            }
            for row in 0..rows {
                let from = &from[row * wide..][..step + length];
                for ((to, high), low) in to[row * length..][..length].iter_mut().zip(&from[step..]).zip(from)
                {
                    *to = (high - low) * factor;
                }
            }
        }
    }

    /// Multiplies the point of column j by `C(n−b,j)`, as Horner's scheme in v wants it.
    pub(super) fn multiply_by_binomials(&mut self) {
        for (net, &[a, b]) in self.of_order.iter_mut().zip(&ORDERS) {
            let [rows, columns] = extent(self.degrees, a, b);
            for j in 1..columns.saturating_sub(1) {
                let factor = binomial(columns - 1, j);
                for i in 0..rows {
                    let point = &mut net[(i * columns + j) * self.dimension..][..self.dimension];
                    point.iter_mut().for_each(|x| *x *= factor);
                }
            }
        }
    }

    /// The nets alone.
    pub(super) fn into_nets(self) -> Vec<Vec<f64>> {
        self.of_order
    }

    /// Multiplies the nets of first derivatives by powers of two that bring their largest numbers into [1,
    /// 2).
    pub(super) fn normalize_first(&mut self) {
        for net in self.of_order.iter_mut().skip(1) {
            let end = net.len() - WIDTH;
            let factor = inverse_size(&net[..end]);
            net[..end].iter_mut().for_each(|x| *x *= factor);
        }
    }

    /// The coefficients of the curves in v at row `at` of the grid, for the first `K` orders: `Σᵢ Bᵢᵐ⁻ᵃ(u)
    /// Nᵢⱼ`.
    ///
    /// `N` is the degree in both directions where the compiler is to know it, [`ANY`] otherwise.
    #[inline(always)]
    pub(super) fn contract<S: Lanes, const K: usize, const N: usize, const D: usize>(
        &mut self,
        simd: S,
        rows: &Rows,
        at: usize,
    ) {
        // Written out: the compiler must see the orders to unroll what depends on them.
        self.contract_one::<S, N, D, 0, 0>(simd, rows, at);
        if K >= 3 {
            self.contract_one::<S, N, D, 1, 0>(simd, rows, at);
            self.contract_one::<S, N, D, 0, 1>(simd, rows, at);
        }
        if K >= 6 {
            self.contract_one::<S, N, D, 2, 0>(simd, rows, at);
            self.contract_one::<S, N, D, 1, 1>(simd, rows, at);
            self.contract_one::<S, N, D, 0, 2>(simd, rows, at);
        }
    }

    #[inline(always)]
    fn contract_one<S: Lanes, const N: usize, const D: usize, const A: usize, const B: usize>(
        &mut self,
        simd: S,
        rows: &Rows,
        at: usize,
    ) {
        let [height, columns] = extent(if N == ANY { self.degrees } else { [N, N] }, A, B);
        let place = partial_index(A, B);
        let basis = &rows.basis(A, at)[..height];
        let net = &self.of_order[place][..height * columns * D + WIDTH];
        let curve = &mut self.curves[place][..columns * D + WIDTH];
        combine(simd, basis, net, columns * D, curve);
    }
}

impl Curves for Nets {
    /// Those of the row that was contracted last.
    #[inline(always)]
    fn curve<const D: usize, const N: usize, const B: usize>(&self, place: usize) -> &[[f64; D]] {
        let degree = if N == ANY { self.degrees[1] } else { N };
        &self.curves[place].as_chunks().0[..(degree + 1).saturating_sub(B)]
    }
}

/// `Σᵢ bᵢ nᵢₓ` of a net with rows of `width` numbers; net and result are followed by [`WIDTH`] numbers that mean nothing.
#[inline(always)]
pub(super) fn combine<S: Lanes>(simd: S, basis: &[f64], net: &[f64], width: usize, out: &mut [f64]) {
    let mut x = 0;
    while x < width {
        let mut sum = simd.splat_f64s(0.0);
        for i in 0..basis.len() {
            sum = simd.mul_add_f64s(simd.splat_f64s(basis[i]), simd.load(net, i * width + x), sum);
        }
        S::as_mut_simd_f64s(&mut out[x..x + S::F64_LANES]).0[0] = sum;
        x += S::F64_LANES;
    }
}

/// Rows and columns of the net of the order (a, b).
#[inline(always)]
fn extent(degrees: [usize; 2], a: usize, b: usize) -> [usize; 2] {
    [(degrees[0] + 1).saturating_sub(a), (degrees[1] + 1).saturating_sub(b)]
}

/// The power of two that brings the largest of some numbers into [1, 2); 1 where all are zero.
pub(super) fn inverse_size(numbers: &[f64]) -> f64 {
    let largest = numbers.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    // The exponents of 2^±1022 keep both the power and its inverse normal.
    let exponent = ((largest.to_bits() >> 52) as i64 - 1023).clamp(-1022, 1022);
    if largest > 0.0 { f64::from_bits(((1023 - exponent) as u64) << 52) } else { 1.0 }
}
