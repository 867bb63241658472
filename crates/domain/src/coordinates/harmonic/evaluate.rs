//! Values and derivatives of the fitted functions.

use num_complex::Complex64;
use pulp::{Arch, Simd, WithSimd};

use super::super::lanes::{LANES, Lanes};
use super::{
    basis::{Basis, Site},
    cell::Cell,
};

/// Rows of coefficients are padded to a multiple of this, the most coordinates that are accumulated together.
const PADDING: usize = 4;

/// A cell with its functions and their coefficients.
#[derive(Clone, Debug)]
pub(super) struct Part {
    cell: Cell,
    basis: Basis,
    /// Row-major, one row an unknown, rows padded with zeros to a multiple of [`PADDING`].
    coefficients: Vec<f64>,
    stride: usize,
}

/// The functions at [`LANES`] points, and what they sum up to.
pub(super) struct Scratch {
    /// Re φ, Re φ′, Im φ′, Re φ″, Im φ″.
    functions: [Vec<Lanes>; 5],
    /// Re F, Re F′, Im F′, Re F″, Im F″, rows of n.
    pub(super) sums: Vec<Lanes>,
}

impl Scratch {
    /// Room for all `parts`, `n` coordinates and derivatives up to `order`.
    pub(super) fn new(parts: &[Part], n: usize, order: usize) -> Self {
        let longest = parts.iter().map(|p| p.basis.len()).max().unwrap_or(0);
        let rows = solved_rows(order);
        let room = |row: usize| vec![Lanes::ZERO; if row < rows { longest } else { 0 }];
        Self { functions: std::array::from_fn(room), sums: vec![Lanes::ZERO; rows * n] }
    }
}

/// Rows that are summed up: Re F; Re F′, Im F′; Re F″, Im F″.
pub(super) fn solved_rows(order: usize) -> usize {
    2 * order.min(2) + 1
}

impl Part {
    /// `coefficients` holds a row of n values for every unknown.
    pub(super) fn new(cell: Cell, basis: Basis, coefficients: &[f64], n: usize) -> Self {
        let stride = n.next_multiple_of(PADDING);
        let mut padded = vec![0.0; basis.len() * stride];
        for (to, from) in padded.chunks_exact_mut(stride).zip(coefficients.chunks_exact(n)) {
            to[..n].copy_from_slice(from);
        }
        Self { cell, basis, coefficients: padded, stride }
    }

    pub(super) fn cell(&self) -> &Cell {
        &self.cell
    }

    pub(super) fn basis(&self) -> &Basis {
        &self.basis
    }

    /// Re F, and for orders 1 and 2 Re F′, Im F′, Re F″, Im F″, of all functions at several sites, into the sums of
    /// `scratch`.
    ///
    /// So many coordinates are accumulated together that the rows of their sums stay in vector registers.
    #[inline(always)]
    pub(super) fn evaluate(&self, sites: &[Site; LANES], order: usize, scratch: &mut Scratch) {
        match order {
            0 => self.rows::<0, 1, 4>(sites, scratch),
            1 => self.rows::<1, 3, 4>(sites, scratch),
            _ => self.rows::<2, 5, 2>(sites, scratch),
        }
    }

    #[inline(always)]
    fn rows<const ORDER: usize, const ROWS: usize, const TILE: usize>(
        &self,
        sites: &[Site; LANES],
        scratch: &mut Scratch,
    ) {
        let Scratch { functions, sums } = scratch;
        let count = self.basis.len();
        {
            let [v, d1r, d1i, d2r, d2i] = functions.each_mut().map(|row| {
                let held = row.len().min(count);
                &mut row[..held]
            });
            let mut k = 0;
            self.basis.visit_lanes::<ORDER>(sites, |g| {
                v[k] = g[0].re;
                if ORDER > 0 {
                    (d1r[k], d1i[k]) = (g[1].re, g[1].im);
                }
                if ORDER > 1 {
                    (d2r[k], d2i[k]) = (g[2].re, g[2].im);
                }
                k += 1;
            });
        }
        let functions: [&[Lanes]; ROWS] = std::array::from_fn(|r| &functions[r][..count]);
        let n = sums.len() / ROWS;
        for first in (0..n).step_by(TILE) {
            let mut tile = [[Lanes::ZERO; TILE]; ROWS];
            for (k, row) in self.coefficients.chunks_exact(self.stride).enumerate() {
                let Some(c) = row[first..].first_chunk::<TILE>() else { continue };
                for (sums, functions) in tile.iter_mut().zip(&functions) {
                    for (sum, &c) in sums.iter_mut().zip(c) {
                        *sum = functions[k].mul_add(Lanes::splat(c), *sum);
                    }
                }
            }
            let width = TILE.min(n - first);
            for (r, tile) in tile.iter().enumerate() {
                sums[r * n + first..r * n + first + width].copy_from_slice(&tile[..width]);
            }
        }
    }

    /// The n functions at many sites, site-major, compiled for the widest vector instructions at hand.
    pub(super) fn values(&self, sites: &[Site], out: &mut [f64]) {
        Arch::new().dispatch(Values { part: self, sites, out });
    }

    /// F itself, both parts, for the jumps between cells: `out` holds n values.
    pub(super) fn complex(&self, z: Complex64, out: &mut [Complex64]) {
        out.fill(Complex64::ZERO);
        let mut rows = self.coefficients.chunks_exact(self.stride);
        self.basis.visit::<0>(&Site::free(z), |g| {
            if let Some(row) = rows.next() {
                for (o, &c) in out.iter_mut().zip(row) {
                    *o += Complex64::new(g[0].re, g[0].im) * c;
                }
            }
        });
    }

    /// Largest Σ |c||φ| over the n functions: what rounding acts on.
    pub(super) fn magnitude(&self, site: &Site) -> f64 {
        let mut sums = vec![0.0; self.stride];
        let mut rows = self.coefficients.chunks_exact(self.stride);
        self.basis.visit::<0>(site, |g| {
            if let Some(row) = rows.next() {
                for (s, &c) in sums.iter_mut().zip(row) {
                    *s += (g[0].re * c).abs();
                }
            }
        });
        sums.into_iter().fold(0.0, f64::max)
    }
}

struct Values<'a> {
    part: &'a Part,
    sites: &'a [Site],
    out: &'a mut [f64],
}

impl WithSimd for Values<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let n = self.out.len() / self.sites.len().max(1);
        let mut scratch = Scratch::new(std::slice::from_ref(self.part), n, 0);
        for (sites, out) in self.sites.chunks(LANES).zip(self.out.chunks_mut((LANES * n).max(1))) {
            self.part.evaluate(&block(sites), 0, &mut scratch);
            for (lane, out) in out.chunks_exact_mut(n.max(1)).enumerate() {
                out.iter_mut().zip(&scratch.sums).for_each(|(out, sum)| *out = sum.0[lane]);
            }
        }
    }
}

/// Up to [`LANES`] things, the last one repeated.
#[inline(always)]
pub(super) fn block<T: Copy>(things: &[T]) -> [T; LANES] {
    std::array::from_fn(|l| things[l.min(things.len() - 1)])
}
