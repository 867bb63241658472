//! One row of a grid: the curves that the net was contracted to, a register of columns at a time.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use super::blocks::store;
use super::grid_table::{Columns, takes_table};
use super::horner::Parameter;
use super::quotient::{lane, partials, settle, suspicious};
use super::simd::Lanes;

/// The curves of a row, one for each kind of derivatives.
pub(super) trait Curves {
    /// Coefficients of the one at `place`, which is a derivative of order `B` with the columns' parameter. `N` is the degree of
    /// the value where the compiler is to know it, [`ANY`](super::nets::ANY) otherwise.
    fn curve<const D: usize, const N: usize, const B: usize>(&self, place: usize) -> &[[f64; D]];
}

// Lanes beyond the last column repeat it. They are stored where there is room, and overwritten by the next
// row.

/// Stores the row from `place` on.
#[inline(always)]
pub(super) fn plain<S: Lanes, C: Curves, const D: usize, const K: usize, const N: usize>(
    simd: S,
    columns: &Columns,
    curves: &C,
    out: &mut [&mut [f64]; K],
    place: usize,
) {
    for column in (0..columns.count).step_by(S::F64_LANES) {
        let jet: [_; K] = jet::<S, D, K, N>(simd, columns, column, curves);
        for k in 0..K {
            store(simd, out[k], place + column, jet[k]);
        }
    }
}

/// The first `K` derivatives at the columns from `column` on: with the columns' parameter last, and with one parameter (K = 3,
/// 6) or two (K = 4) before it.
#[inline(always)]
pub(super) fn jet<S: Lanes, const D: usize, const K: usize, const N: usize>(
    simd: S,
    columns: &Columns,
    column: usize,
    curves: &impl Curves,
) -> [[S::f64s; D]; K] {
    if takes_table(N, K) {
        return in_kinds::<S, D, K>(
            simd,
            #[inline(always)]
            |k| columns.by_table::<S, D, 0>(simd, column, curves.curve::<D, N, 0>(k)),
            #[inline(always)]
            |k| columns.by_table::<S, D, 1>(simd, column, curves.curve::<D, N, 1>(k)),
            #[inline(always)]
            |k| columns.by_table::<S, D, 2>(simd, column, curves.curve::<D, N, 2>(k)),
        );
    }
    let t = columns.parameter(simd, column);
    if t.some {
        by_horner::<S, D, K, N, true>(&t, curves)
    } else {
        by_horner::<S, D, K, N, false>(&t, curves)
    }
}

#[inline(always)]
fn by_horner<S: Lanes, const D: usize, const K: usize, const N: usize, const MIXED: bool>(
    t: &Parameter<S>,
    curves: &impl Curves,
) -> [[S::f64s; D]; K] {
    in_kinds::<S, D, K>(
        t.simd,
        #[inline(always)]
        |k| t.value::<D, MIXED>(curves.curve::<D, N, 0>(k)),
        #[inline(always)]
        |k| t.value::<D, MIXED>(curves.curve::<D, N, 1>(k)),
        #[inline(always)]
        |k| t.value::<D, MIXED>(curves.curve::<D, N, 2>(k)),
    )
}

/// All kinds of derivatives, each by the closure for its order with the columns' parameter.
#[inline(always)]
fn in_kinds<S: Lanes, const D: usize, const K: usize>(
    simd: S,
    value: impl Fn(usize) -> [S::f64s; D],
    first: impl Fn(usize) -> [S::f64s; D],
    second: impl Fn(usize) -> [S::f64s; D],
) -> [[S::f64s; D]; K] {
    let mut jet = [[simd.splat_f64s(0.0); D]; K];
    // Written out: the compiler must see the orders to unroll what depends on them.
    jet[0] = value(0);
    if K == 4 {
        jet[1] = value(1);
        jet[2] = value(2);
        jet[3] = first(3);
        return jet;
    }
    if K >= 3 {
        jet[1] = value(1);
        jet[2] = first(2);
    }
    if K >= 6 {
        jet[3] = value(3);
        jet[4] = first(4);
        jet[5] = second(5);
    }
    jet
}

/// Numerator and denominator with their derivatives, all divided by the same power of the columns' base, which the quotient
/// rule does not notice.
#[inline(always)]
fn homogeneous<S: Lanes, const K: usize, const N: usize, const MIXED: bool>(
    simd: S,
    t: &Parameter<S>,
    inverse: S::f64s,
    curves: &impl Curves,
) -> [[S::f64s; 4]; K] {
    in_kinds::<S, 4, K>(
        simd,
        #[inline(always)]
        |k| t.sum::<4, MIXED>(curves.curve::<4, N, 0>(k)),
        #[inline(always)]
        |k| times(simd, t.sum::<4, MIXED>(curves.curve::<4, N, 1>(k)), inverse),
        #[inline(always)]
        |k| times(simd, t.sum::<4, MIXED>(curves.curve::<4, N, 2>(k)), simd.mul_f64s(inverse, inverse)),
    )
}

/// A point of each lane times a number of each lane.
#[inline(always)]
fn times<S: Lanes>(simd: S, mut points: [S::f64s; 4], factor: S::f64s) -> [S::f64s; 4] {
    for c in 0..4 {
        points[c] = simd.mul_f64s(points[c], factor);
    }
    points
}

/// A register of points with their first derivatives, where no denominator can vanish: each kind is stored before the next is
/// begun, so that nothing leaves the registers. The operations are those of [`homogeneous`] and [`partials`].
#[inline(always)]
fn certain<S: Lanes, C: Curves, const K: usize, const N: usize, const MIXED: bool>(
    t: &Parameter<S>,
    inverse: S::f64s,
    curves: &C,
    out: &mut [&mut [f64]; K],
    place: usize,
) {
    let simd = t.simd;
    let value = t.sum::<4, MIXED>(curves.curve::<4, N, 0>(0));
    let reciprocal = simd.div_f64s(simd.splat_f64s(1.0), value[3]);
    let mut point = [reciprocal; 3];
    for c in 0..3 {
        point[c] = simd.mul_f64s(value[c], reciprocal);
    }
    store(simd, out[0], place, point);
    for k in 1..K {
        let jet = if k + 1 == K {
            times(simd, t.sum::<4, MIXED>(curves.curve::<4, N, 1>(k)), inverse)
        } else {
            t.sum::<4, MIXED>(curves.curve::<4, N, 0>(k))
        };
        let weight = simd.neg_f64s(jet[3]);
        let mut first = point;
        for c in 0..3 {
            first[c] = simd.mul_f64s(simd.mul_add_f64s(point[c], weight, jet[c]), reciprocal);
        }
        store(simd, out[k], place, first);
    }
}

/// A row where denominators may vanish.
pub(super) struct Doubtful<F> {
    /// Their largest uncertainty, divided by the spread of the columns' basis; `None` where none can vanish.
    pub(super) bound: Option<f64>,
    /// The uncertainty of one column's.
    pub(super) bound_at: F,
}

/// As [`plain`], for a rational shape in `P` parameters; the first column that has a pole.
#[inline(always)]
pub(super) fn rational<
    S: Lanes,
    C: Curves,
    F: Fn(usize) -> f64,
    const P: usize,
    const K: usize,
    const N: usize,
>(
    simd: S,
    columns: &Columns,
    curves: &C,
    out: &mut [&mut [f64]; K],
    place: usize,
    doubtful: Doubtful<F>,
) -> Option<usize> {
    let mut pole = None;
    for column in (0..columns.count).step_by(S::F64_LANES) {
        let t = columns.parameter(simd, column);
        let inverse = columns.inverse(simd, column);
        if K <= P + 1 && doubtful.bound.is_none() {
            if t.some {
                certain::<S, C, K, N, true>(&t, inverse, curves, out, place + column);
            } else {
                certain::<S, C, K, N, false>(&t, inverse, curves, out, place + column);
            }
            continue;
        }
        let jet: [_; K] = if t.some {
            homogeneous::<S, K, N, true>(simd, &t, inverse, curves)
        } else {
            homogeneous::<S, K, N, false>(simd, &t, inverse, curves)
        };
        let points = partials::<S, P, K>(simd, &jet);
        for k in 0..K {
            store(simd, out[k], place + column, points[k]);
        }
        if let Some(bound) = doubtful.bound {
            // Σ C(n,j)|xʲ| is (1 + |x|)ⁿ.
            let one = simd.splat_f64s(1.0);
            let spread = simd.power(simd.add_f64s(one, simd.abs_f64s(t.quotient)), columns.degree);
            let least = simd.mul_f64s(simd.splat_f64s(bound), spread);
            if simd.any(suspicious(simd, jet[0][3], &points, least)) {
                let denominator = simd.mul_f64s(jet[0][3], simd.power(t.base, columns.degree));
                for l in 0..S::F64_LANES.min(columns.count - column) {
                    let at = column + l;
                    if settle(lane::<S>(denominator, l), (doubtful.bound_at)(at), out, place + at) {
                        pole = pole.or(Some(at));
                    }
                }
            }
        }
    }
    pole
}
