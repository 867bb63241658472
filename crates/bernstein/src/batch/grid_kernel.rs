//! The kernels of a grid: row by row, a register of columns at a time.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::blocks::store;
use super::grid::GridBatch;
use super::grid_table::{self, Columns};
use super::horner::Parameter;
use super::nets::Nets;
use super::normal::unit_normal;
use super::quotient::{is_tame, lane, largest_weight, scale, settle, surface, suspicious, uncertainty};
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
            scratch.multiply_by_binomials();
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
                    PLAIN => self.plain::<S, D>(simd, &scratch, place),
                    NORMALS => self.normals(simd, &scratch, place),
                    _ => self.rational(simd, &scratch, place, [row, at], &poles),
                }
            }
            row = end;
        }
    }
}

// Lanes beyond the last column repeat it. They are stored where there is room, and overwritten by the next
// row.
impl<const K: usize, const KIND: u8, const N: usize> Rows<'_, K, KIND, N> {
    #[inline(always)]
    fn plain<S: Lanes, const D: usize>(&mut self, simd: S, scratch: &Nets, place: usize) {
        let v = &self.0.grid.v;
        for column in (0..v.count).step_by(S::F64_LANES) {
            let t = v.parameter(simd, column);
            let jet: [_; K] = if t.some {
                jet::<S, D, K, N, true>(&t, scratch)
            } else {
                jet::<S, D, K, N, false>(&t, scratch)
            };
            for k in 0..K {
                store(simd, self.0.out[k], place + column, jet[k]);
            }
        }
    }

    #[inline(always)]
    fn normals<S: Lanes>(&mut self, simd: S, scratch: &Nets, place: usize) {
        let v = &self.0.grid.v;
        let inside = self.0.grid.u.inside && v.inside;
        for column in (0..v.count).step_by(S::F64_LANES) {
            let t = v.parameter(simd, column);
            let [point, du, dv] = if t.some {
                jet::<S, 3, 3, N, true>(&t, scratch)
            } else {
                jet::<S, 3, 3, N, false>(&t, scratch)
            };
            store(simd, self.0.out[0], place + column, point);
            store(simd, self.0.out[1], place + column, unit_normal(simd, du, dv, inside));
        }
    }

    /// `[row, at]` are the row's number among those of all nets, and in its own.
    #[inline(always)]
    fn rational<S: Lanes>(
        &mut self,
        simd: S,
        scratch: &Nets,
        place: usize,
        [row, at]: [usize; 2],
        poles: &Poles<'_>,
    ) {
        let v = &self.0.grid.v;
        for column in (0..v.count).step_by(S::F64_LANES) {
            let t = v.parameter(simd, column);
            let inverse = v.inverse(simd, column);
            let jet: [_; K] = if t.some {
                homogeneous::<S, K, N, true>(simd, &t, inverse, scratch)
            } else {
                homogeneous::<S, K, N, false>(simd, &t, inverse, scratch)
            };
            let points = surface(simd, &jet);
            for k in 0..K {
                store(simd, self.0.out[k], place + column, points[k]);
            }
            if poles.possible {
                // Σ C(n,j)|xʲ| is (1 + |x|)ⁿ.
                let one = simd.splat_f64s(1.0);
                let spread = simd.power(simd.add_f64s(one, simd.abs_f64s(t.quotient)), v.degree);
                let least = simd.mul_f64s(simd.splat_f64s(poles.bound * poles.u.spread(at)), spread);
                if simd.any(suspicious(simd, jet[0][3], &points, least)) {
                    let denominator = simd.mul_f64s(jet[0][3], simd.power(t.base, v.degree));
                    for l in 0..S::F64_LANES.min(v.count - column) {
                        let bound = poles.bound_at(at, column + l);
                        if settle(lane::<S>(denominator, l), bound, &mut self.0.out, place + column + l) {
                            self.0.pole.fetch_min(row * v.count + column + l, Ordering::Relaxed);
                        }
                    }
                }
            }
        }
    }
}

/// The first `K` partial derivatives in the order of [`partial_index`](crate::partial_index).
#[inline(always)]
fn jet<S: Lanes, const D: usize, const K: usize, const N: usize, const MIXED: bool>(
    t: &Parameter<S>,
    scratch: &Nets,
) -> [[S::f64s; D]; K] {
    let mut jet = [[t.simd.splat_f64s(0.0); D]; K];
    // Written out: the compiler must see the orders to unroll what depends on them.
    jet[0] = t.value::<D, MIXED>(scratch.curve::<D, N, 0>(0));
    if K >= 3 {
        jet[1] = t.value::<D, MIXED>(scratch.curve::<D, N, 0>(1));
        jet[2] = t.value::<D, MIXED>(scratch.curve::<D, N, 1>(2));
    }
    if K >= 6 {
        jet[3] = t.value::<D, MIXED>(scratch.curve::<D, N, 0>(3));
        jet[4] = t.value::<D, MIXED>(scratch.curve::<D, N, 1>(4));
        jet[5] = t.value::<D, MIXED>(scratch.curve::<D, N, 2>(5));
    }
    jet
}

/// Numerator and denominator with their derivatives, all divided by the same power of 1 − v or v, which the
/// quotient rule does not notice.
#[inline(always)]
fn homogeneous<S: Lanes, const K: usize, const N: usize, const MIXED: bool>(
    simd: S,
    t: &Parameter<S>,
    inverse: S::f64s,
    scratch: &Nets,
) -> [[S::f64s; 4]; K] {
    let mut jet = [[simd.splat_f64s(0.0); 4]; K];
    jet[0] = t.sum::<4, MIXED>(scratch.curve::<4, N, 0>(0));
    if K >= 3 {
        jet[1] = t.sum::<4, MIXED>(scratch.curve::<4, N, 0>(1));
        jet[2] = times(simd, t.sum::<4, MIXED>(scratch.curve::<4, N, 1>(2)), inverse);
    }
    if K >= 6 {
        jet[3] = t.sum::<4, MIXED>(scratch.curve::<4, N, 0>(3));
        jet[4] = times(simd, t.sum::<4, MIXED>(scratch.curve::<4, N, 1>(4)), inverse);
        let square = simd.mul_f64s(inverse, inverse);
        jet[5] = times(simd, t.sum::<4, MIXED>(scratch.curve::<4, N, 2>(5)), square);
    }
    jet
}

/// A point of each lane times a number of each lane.
#[inline(always)]
fn times<S: Lanes>(simd: S, mut points: [S::f64s; 4], factor: S::f64s) -> [S::f64s; 4] {
    for c in 0..4 {
        points[c] = simd.mul_f64s(points[c], factor);
    }
    points
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
