//! Values and derivatives of the fitted functions.

use num_complex::Complex64;
use pulp::{Arch, Simd, WithSimd};

use super::{
    basis::{Basis, Site},
    cell::Cell,
};

/// Coordinates that are accumulated together.
const LANES: usize = 8;

/// A cell with its functions and their coefficients.
#[derive(Clone, Debug)]
pub(super) struct Part {
    cell: Cell,
    basis: Basis,
    /// Row-major, one row an unknown, rows padded with zeros to a multiple of [`LANES`].
    coefficients: Vec<f64>,
    stride: usize,
}

/// The functions at one point, one array each for Re φ, Re φ′, Im φ′, Re φ″, Im φ″.
pub(super) struct Scratch {
    rows: [Vec<f64>; 5],
}

impl Scratch {
    pub(super) fn new(parts: &[Part]) -> Self {
        let longest = parts.iter().map(|p| p.basis.len()).max().unwrap_or(0);
        Self { rows: std::array::from_fn(|_| vec![0.0; longest]) }
    }
}

impl Part {
    /// `coefficients` holds a row of n values for every unknown.
    pub(super) fn new(cell: Cell, basis: Basis, coefficients: &[f64], n: usize) -> Self {
        let stride = n.next_multiple_of(LANES);
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

    /// Re F, and for orders 1 and 2 Re F′, Im F′, Re F″, Im F″, of all n functions: `out` holds 1, 3 or 5 rows of n.
    #[inline(always)]
    pub(super) fn evaluate(&self, site: &Site, order: usize, scratch: &mut Scratch, out: &mut [f64]) {
        match order {
            0 => self.rows::<0, 1>(site, scratch, out),
            1 => self.rows::<1, 3>(site, scratch, out),
            _ => self.rows::<2, 5>(site, scratch, out),
        }
    }

    #[inline(always)]
    fn rows<const ORDER: usize, const ROWS: usize>(
        &self,
        site: &Site,
        scratch: &mut Scratch,
        out: &mut [f64],
    ) {
        let count = self.basis.len();
        {
            let [v, d1r, d1i, d2r, d2i] = &mut scratch.rows;
            let (v, d1r, d1i) = (&mut v[..count], &mut d1r[..count], &mut d1i[..count]);
            let (d2r, d2i) = (&mut d2r[..count], &mut d2i[..count]);
            let mut k = 0;
            self.basis.visit::<ORDER>(site, |g| {
                v[k] = g[0].re;
                if ORDER > 0 {
                    d1r[k] = g[1].re;
                    d1i[k] = g[1].im;
                }
                if ORDER > 1 {
                    d2r[k] = g[2].re;
                    d2i[k] = g[2].im;
                }
                k += 1;
            });
        }
        let n = out.len() / ROWS;
        for first in (0..n).step_by(LANES) {
            let mut sums = [[0.0; LANES]; ROWS];
            let columns = self.coefficients.chunks_exact(self.stride);
            for (k, row) in columns.enumerate() {
                let Some(c) = row[first..].first_chunk::<LANES>() else { continue };
                for (sum, values) in sums.iter_mut().zip(&scratch.rows) {
                    let x = values[k];
                    for (s, &c) in sum.iter_mut().zip(c) {
                        *s = x.mul_add(c, *s);
                    }
                }
            }
            let width = LANES.min(n - first);
            for (r, sum) in sums.iter().enumerate() {
                out[r * n + first..r * n + first + width].copy_from_slice(&sum[..width]);
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
                    *o += g[0] * c;
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
        let mut scratch = Scratch::new(std::slice::from_ref(self.part));
        let n = self.out.len() / self.sites.len().max(1);
        for (site, out) in self.sites.iter().zip(self.out.chunks_exact_mut(n.max(1))) {
            self.part.evaluate(site, 0, &mut scratch, out);
        }
    }
}
