//! The basis at the parameters of one side of a grid.

use super::simd::WIDTH;
use crate::basis;

/// Highest order of derivatives that batches have.
pub(super) const MAX_ORDER: usize = 2;

/// The Bernstein polynomials of degrees n, n − 1, n − 2 at fixed parameters.
#[derive(Debug, Clone)]
pub(super) struct Table {
    pub(super) degree: usize,
    /// Number of parameters.
    pub(super) count: usize,
    /// `Bᵢⁿ⁻ᵏ(t)` of order k: i fastest, then the parameter.
    rows: Vec<Vec<f64>>,
    /// The same for registers: the parameter's place in its block of [`WIDTH`] fastest, then i, then the
    /// block. Places beyond the last parameter repeat it.
    blocks: Vec<Vec<f64>>,
    /// `Σᵢ |Bᵢⁿ(t)|`, padded likewise: 1 inside `[0, 1]`.
    spread: Vec<f64>,
}

impl Table {
    /// The basis for derivatives up to `order`.
    pub(super) fn new(degree: usize, parameters: &[f64], order: usize) -> Self {
        let count = parameters.len();
        let padded = count.next_multiple_of(WIDTH);
        let (mut rows, mut blocks) = (Vec::new(), Vec::new());
        for k in 0..=order {
            let width = (degree + 1).saturating_sub(k);
            let mut row = vec![0.0; count * width];
            let mut block = vec![0.0; padded * width];
            if width > 0 {
                for (&t, row) in parameters.iter().zip(row.chunks_exact_mut(width)) {
                    basis(t, row);
                }
                for at in 0..padded {
                    let last = at.min(count - 1) * width;
                    for (i, &b) in row[last..last + width].iter().enumerate() {
                        block[(at / WIDTH * width + i) * WIDTH + at % WIDTH] = b;
                    }
                }
            }
            rows.push(row);
            blocks.push(block);
        }
        let mut spread: Vec<f64> =
            rows[0].chunks_exact(degree + 1).map(|row| row.iter().map(|b| b.abs()).sum()).collect();
        spread.resize(padded, spread.last().copied().unwrap_or(1.0));
        Self { degree, count, rows, blocks, spread }
    }

    /// Highest order of derivatives.
    pub(super) fn order(&self) -> usize {
        self.rows.len() - 1
    }

    /// The number of basis functions of order k, n + 1 − k.
    #[inline(always)]
    pub(super) fn width(&self, order: usize) -> usize {
        (self.degree + 1).saturating_sub(order)
    }

    /// `Bᵢⁿ⁻ᵏ` at one parameter.
    #[inline(always)]
    pub(super) fn row(&self, order: usize, at: usize) -> &[f64] {
        let width = self.width(order);
        &self.rows[order][at * width..(at + 1) * width]
    }

    /// `Bᵢⁿ⁻ᵏ` at the block of parameters that begins with number `first`.
    #[inline(always)]
    pub(super) fn block(&self, order: usize, first: usize) -> &[[f64; WIDTH]] {
        let width = self.width(order);
        let block = first / WIDTH * width;
        &self.blocks[order].as_chunks().0[block..block + width]
    }

    /// `Σᵢ |Bᵢⁿ(t)|` of all parameters, padded.
    #[inline(always)]
    pub(super) fn spread(&self) -> &[f64] {
        &self.spread
    }
}
