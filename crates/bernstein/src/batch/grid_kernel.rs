//! The kernels of a grid: row by row, a register of columns at a time.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::blocks::store;
use super::grid::GridBatch;
use super::grid_row::{Doubtful, jet, plain, rational};
use super::grid_table::{self, Columns, takes_table};
use super::nets::Nets;
use super::normal::unit_normal;
use super::quotient::{is_tame, largest_weight, scale, uncertainty};
use super::simd::{Job, Lanes};
use crate::MAX_DEGREE;

/// What is made of the homogeneous or plain derivatives.
pub(super) const PLAIN: u8 = 0;
pub(super) const RATIONAL: u8 = 1;
pub(super) const NORMALS: u8 = 2;

/// Some of the rows of all nets.
pub(super) struct Chunk<'a, const K: usize> {
    pub(super) grid: &'a GridBatch,
    pub(super) nets: &'a [f64],
    pub(super) rows: Range<usize>,
    pub(super) out: [&'a mut [f64]; K],
    /// The first place of a pole.
    pub(super) pole: &'a AtomicUsize,
}

impl<'a, const K: usize> Chunk<'a, K> {
    /// The job to be done with these rows, by a kernel for degree `N` in both directions or for
    /// [`ANY`](super::nets::ANY) degrees.
    pub(super) fn by<const KIND: u8, const N: usize>(self) -> Rows<'a, K, KIND, N> {
        Rows(self)
    }
}

pub(super) struct Rows<'a, const K: usize, const KIND: u8, const N: usize>(Chunk<'a, K>);

impl<const K: usize, const KIND: u8, const N: usize> Job for Rows<'_, K, KIND, N> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes, const D: usize>(mut self, simd: S) {
        let (GridBatch { u, v }, rows) = (self.0.grid, self.0.rows.clone());
        let size = (u.degree + 1) * (v.degree + 1) * D;
        let mut scratch = Nets::new([u.degree, v.degree], D, if KIND == NORMALS { 3 } else { K });
        let mut row = rows.start;
        while row < rows.end {
            let number = row / u.count;
            let end = rows.end.min((number + 1) * u.count);
            let net = &self.0.nets[number * size..(number + 1) * size];
            scratch.set(net);
            if KIND == NORMALS {
                scratch.normalize_first();
            }
            if KIND == RATIONAL || !takes_table(N, K) {
                scratch.multiply_by_binomials();
            }
            let poles = Poles::new::<KIND>(u, v, net);
            for row in row..end {
                let at = row - number * u.count;
                if KIND == NORMALS {
                    scratch.contract::<S, 3, N, D>(simd, u, at);
                } else {
                    scratch.contract::<S, K, N, D>(simd, u, at);
                }
                let place = (row - rows.start) * v.count;
                match KIND {
                    PLAIN => plain::<S, _, D, K, N>(simd, v, &scratch, &mut self.0.out, place),
                    NORMALS => self.normals(simd, &scratch, place),
                    _ => {
                        let bound = poles.possible.then(|| poles.bound * poles.u.spread(at));
                        let doubtful = Doubtful { bound, bound_at: |column| poles.bound_at(at, column) };
                        let found =
                            rational::<S, _, _, 2, K, N>(simd, v, &scratch, &mut self.0.out, place, doubtful);
                        if let Some(column) = found {
                            self.0.pole.fetch_min(row * v.count + column, Ordering::Relaxed);
                        }
                    }
                }
            }
            row = end;
        }
    }
}

impl<const K: usize, const KIND: u8, const N: usize> Rows<'_, K, KIND, N> {
    #[inline(always)]
    fn normals<S: Lanes>(&mut self, simd: S, scratch: &Nets, place: usize) {
        let v = &self.0.grid.v;
        let inside = self.0.grid.u.inside && v.inside;
        for column in (0..v.count).step_by(S::F64_LANES) {
            let [point, du, dv] = jet::<S, 3, 3, N>(simd, v, column, scratch);
            store(simd, self.0.out[0], place + column, point);
            store(simd, self.0.out[1], place + column, unit_normal(simd, du, dv, inside));
        }
    }
}

/// What is to be known of a rational net where its denominator may vanish.
struct Poles<'a> {
    u: &'a grid_table::Rows,
    v: &'a Columns,
    net: &'a [f64],
    possible: bool,
    /// The uncertainty of the largest weight.
    bound: f64,
}

impl<'a> Poles<'a> {
    #[inline(always)]
    fn new<const KIND: u8>(u: &'a grid_table::Rows, v: &'a Columns, net: &'a [f64]) -> Self {
        let possible = KIND == RATIONAL && !(u.inside && v.inside && is_tame(net));
        let bound = if possible { uncertainty(u.degree + v.degree) * largest_weight(net) } else { 0.0 };
        Self { u, v, net, possible, bound }
    }

    /// The rounding error of the denominator at one place of the grid.
    #[cold]
    fn bound_at(&self, row: usize, column: usize) -> f64 {
        let mut in_v = [0.0; MAX_DEGREE + 1];
        let scale = scale(self.net, self.u.basis(0, row), self.v.basis(column, &mut in_v));
        uncertainty(self.u.degree + self.v.degree) * scale
    }
}
