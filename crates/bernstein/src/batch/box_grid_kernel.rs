//! The kernels of a grid in three parameters: layer by layer, line by line, a register of columns at a time.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::box_grid::BoxGridBatch;
use super::grid_row::{Curves, Doubtful, plain, rational};
use super::grid_table::Rows;
use super::nets::{ANY, combine};
use super::quotient::{is_tame, largest_weight, scale, uncertainty};
use super::simd::{Job, Lanes, WIDTH};
use crate::{MAX_DEGREE, binomial};

/// What is made of the derivatives.
pub(super) const PLAIN: u8 = 0;
pub(super) const RATIONAL: u8 = 1;

/// Some of the lines (uᵢ, vⱼ) of all nets; `N` is the degree in w where the compiler is to know it, or [`ANY`].
pub(super) struct Chunk<'a, const K: usize, const KIND: u8, const N: usize> {
    pub(super) grid: &'a BoxGridBatch,
    pub(super) nets: &'a [f64],
    /// The nets of all derivatives, see [`prepare`].
    pub(super) prepared: &'a [Vec<f64>],
    pub(super) lines: Range<usize>,
    pub(super) out: [&'a mut [f64]; K],
    /// The first place of a pole.
    pub(super) pole: &'a AtomicUsize,
}

/// Degrees of the derivative at place `k`: of the value, with u, v and w.
#[inline(always)]
fn lowered([l, m, n]: [usize; 3], k: usize) -> [usize; 3] {
    let less = |degree: usize, axis: usize| degree.saturating_sub(usize::from(k == axis));
    [less(l, 1), less(m, 2), less(n, 3)]
}

/// For each kind of derivatives the nets `degree · Δ P` of all nets, one after another; zeros where a degree is 0, of degree 0
/// again. With `binomials` the points are multiplied by `C(n,k)`, as Horner's scheme in w wants it.
pub(super) fn prepare(
    nets: &[f64],
    degrees: [usize; 3],
    dimension: usize,
    kinds: usize,
    binomials: bool,
) -> Vec<Vec<f64>> {
    let [_, m, n] = degrees;
    let size = degrees.iter().map(|d| d + 1).product::<usize>() * dimension;
    let step = [0, (m + 1) * (n + 1) * dimension, (n + 1) * dimension, dimension];
    let of_kind = |kind: usize| {
        let [l, m, n] = lowered(degrees, kind);
        let degree = if kind == 0 { 0 } else { degrees[kind - 1] };
        let mut all = Vec::with_capacity(nets.len() / size * (l + 1) * (m + 1) * (n + 1) * dimension + WIDTH);
        for net in nets.chunks_exact(size) {
            for (i, j, k) in (0..=l).flat_map(|i| (0..=m).flat_map(move |j| (0..=n).map(move |k| (i, j, k))))
            {
                let factor = if binomials { binomial(n, k) } else { 1.0 };
                let from = i * step[1] + j * step[2] + k * step[3];
                all.extend((from..from + dimension).map(|x| match kind {
                    0 => net[x] * factor,
                    _ if degree == 0 => 0.0,
                    _ => (net[x + step[kind]] - net[x]) * (degree as f64 * factor),
                }));
            }
        }
        // Registers may read beyond the end.
        all.resize(all.len() + WIDTH, 0.0);
        all
    };
    (0..kinds).map(of_kind).collect()
}

/// What the nets of all kinds were contracted to: at uᵢ, and at (uᵢ, vⱼ).
struct Contracted<const K: usize> {
    degrees: [usize; 3],
    layers: [Vec<f64>; K],
    lines: [Vec<f64>; K],
}

impl<const K: usize> Curves for Contracted<K> {
    #[inline(always)]
    fn curve<const D: usize, const N: usize, const B: usize>(&self, place: usize) -> &[[f64; D]] {
        let degree = if N == ANY { self.degrees[2] } else { N };
        &self.lines[place].as_chunks().0[..(degree + 1).saturating_sub(B).max(1)]
    }
}

impl<const K: usize, const KIND: u8, const N: usize> Job for Chunk<'_, K, KIND, N> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes, const D: usize>(self, simd: S) {
        let Self { grid, nets, prepared, lines, mut out, pole } = self;
        let BoxGridBatch { u, v, w } = grid;
        let degrees = grid.degrees();
        let size = degrees.iter().map(|d| d + 1).product::<usize>() * D;
        let all = |k| lowered(degrees, k);
        let room = |numbers: usize| vec![0.0; numbers * D + 2 * WIDTH];
        let mut contracted = Contracted::<K> {
            degrees,
            layers: std::array::from_fn(|k| room((all(k)[1] + 1) * (all(k)[2] + 1))),
            lines: std::array::from_fn(|k| room(all(k)[2] + 1)),
        };
        // The layer that is at hand.
        let mut layer = usize::MAX;
        let mut doubts = Doubts::default();
        for line in lines.clone() {
            let (number, i, j) = (line / (u.count * v.count), line / v.count % u.count, line % v.count);
            if layer != line / v.count {
                layer = line / v.count;
                let net = &nets[number * size..(number + 1) * size];
                if KIND == RATIONAL {
                    doubts = Doubts::new(grid, net);
                }
                for k in 0..K {
                    let [l, m, n] = lowered(degrees, k);
                    let width = (m + 1) * (n + 1) * D;
                    let net = &prepared[k][number * (l + 1) * width..];
                    combine(simd, basis(u, k == 1, i), net, width, &mut contracted.layers[k]);
                }
            }
            for k in 0..K {
                let width = (lowered(degrees, k)[2] + 1) * D;
                combine(simd, basis(v, k == 2, j), &contracted.layers[k], width, &mut contracted.lines[k]);
            }
            let place = (line - lines.start) * w.count;
            if KIND == PLAIN {
                plain::<S, _, D, K, N>(simd, w, &contracted, &mut out, place);
                continue;
            }
            let doubtful = Doubtful {
                bound: doubts.possible.then(|| doubts.bound * u.spread(i) * v.spread(j)),
                bound_at: |column| {
                    let net = &nets[number * size..(number + 1) * size];
                    doubts.bound_at(grid, net, [i, j, column])
                },
            };
            if let Some(column) =
                rational::<S, _, _, 3, K, N>(simd, w, &contracted, &mut out, place, doubtful)
            {
                pole.fetch_min(line * w.count + column, Ordering::Relaxed);
            }
        }
    }
}

/// The basis in one direction, of one degree less for the derivative with it.
#[inline(always)]
fn basis(rows: &Rows, lowered: bool, at: usize) -> &[f64] {
    rows.basis(usize::from(lowered), at)
}

/// What is to be known of a rational net where its denominator may vanish.
#[derive(Default)]
struct Doubts {
    possible: bool,
    /// The uncertainty of the largest weight.
    bound: f64,
    of_one: f64,
}

impl Doubts {
    fn new(grid: &BoxGridBatch, net: &[f64]) -> Self {
        let inside = grid.u.inside && grid.v.inside && grid.w.inside;
        let of_one = uncertainty(grid.degrees().iter().sum());
        Self { possible: !(inside && is_tame(net)), bound: of_one * largest_weight(net), of_one }
    }

    /// The rounding error of the denominator at one place of the grid.
    #[cold]
    fn bound_at(&self, grid: &BoxGridBatch, net: &[f64], [i, j, k]: [usize; 3]) -> f64 {
        let mut row = [0.0; MAX_DEGREE + 1];
        let in_w = grid.w.basis(k, &mut row);
        let in_v = grid.v.basis(0, j);
        let layers = net.chunks_exact(4 * in_v.len() * in_w.len()).zip(grid.u.basis(0, i));
        self.of_one * layers.map(|(layer, b)| scale(layer, in_v, in_w) * b.abs()).sum::<f64>()
    }
}
