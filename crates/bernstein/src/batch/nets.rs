//! A net with its difference nets, and their contraction to the curves u = constant.

use super::grid_table::Table;
use super::simd::{Lanes, WIDTH};

/// The orders (a, b) of ∂ᵃ⁺ᵇ/∂uᵃ∂vᵇ, in the order of [`partial_index`](crate::partial_index).
pub(super) const ORDERS: [[usize; 2]; 6] = [[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2]];

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

    /// The curves in v at row `at` of the grid: `Σᵢ Bᵢᵐ⁻ᵃ(u) Nᵢⱼ`.
    #[inline(always)]
    pub(super) fn contract<S: Lanes>(&mut self, simd: S, table: &Table, at: usize) {
        for (place, (net, curve)) in self.of_order.iter().zip(&mut self.curves).enumerate() {
            let [a, b] = ORDERS[place];
            let length = extent(self.degrees, a, b)[1] * self.dimension;
            let basis = table.row(a, at);
            let mut x = 0;
            while x < length {
                let mut sum = simd.splat_f64s(0.0);
                for (i, &basis) in basis.iter().enumerate() {
                    sum = simd.mul_add_f64s(simd.splat_f64s(basis), simd.load(net, i * length + x), sum);
                }
                S::as_mut_simd_f64s(&mut curve[x..x + S::F64_LANES]).0[0] = sum;
                x += S::F64_LANES;
            }
        }
    }

    /// The curve of the order at `place`, of the row that was contracted last.
    #[inline(always)]
    pub(super) fn curve<const D: usize>(&self, place: usize) -> &[[f64; D]] {
        self.curves[place].as_chunks().0
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
