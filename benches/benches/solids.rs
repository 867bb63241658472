//! Batches over boxes, tetrahedra and wedges on one thread, against what this machine can do.
//!
//! Run with `cargo bench -p casteljau-benches --bench solids`. Figures of one core of an AMD EPYC (Zen 4, AVX-512) in
//! nanoseconds a point; it stored 57 GB/s into 24 MB and 28 GB/s into 72 MB, and did 29.5 billion multiply-adds a second. The
//! bar has its 15 % included; wedges have twice their limit for one.
//!
//! | work a point | bytes | multiply-adds | limit | measured | bar |
//! | --- | --- | --- | --- | --- | --- |
//! | box (3,3,3), scattered | 24 | 195 | 6.6 | 8.4 | 13.8 |
//! | with first derivatives | 96 | 636 | 22 | 25 | 55 |
//! | rational box (2,2,5), scattered | 24 | 219 | 7.4 | 9.6 | 13.8 |
//! | box (3,3,3) on a 128³ grid | 24 | 12 | 0.85 | 0.87 | 1.15 |
//! | with first derivatives: four streams of stores | 96 | 45 | 3.4 | 5.1 | 4.6 |
//! | rational box (2,2,5) on a 128³ grid | 24 | 24 | 0.85 | 1.3 | 1.5 |
//! | with first derivatives | 96 | 107 | 3.6 | 6.3 | 6.0 |
//! | rational tetrahedron of degree 4 | 24 | 142 | 4.8 | 8.1 | 8.9 |
//! | with first derivatives | 96 | 409 | 14 | 21 | 35 |
//! | rational tetrahedron of degree 10 | 24 | 1146 | 39 | 43 | 39 |
//! | with first derivatives | 96 | 3813 | 129 | 142 | 156 |
//! | rational wedge (3,3) | 24 | 162 | 5.5 | 7.7 | none |
//! | with first derivatives | 96 | 483 | 16 | 25 | none |
//!
//! The bar of degree 10 is the limit itself: each of 286 points takes a multiply-add for each of its four components. On the grid of
//! 16³ every other register holds w = 1, whose lanes take the second form of Horner's scheme, where it is not tabulated.

#![allow(clippy::unwrap_used)]

mod machine;

use std::hint::black_box;

use casteljau_bernstein::glam::{DVec3, DVec4};
use casteljau_bernstein::{BoxBatch, BoxGridBatch, TetrahedronBatch, WedgeBatch, simplex_count};
use criterion::{Criterion, criterion_group, criterion_main};
use machine::{Machine, POINTS, Row, buffers, even, points, row, scattered, weighted};

/// Points a side of the grids.
const SIDE: usize = 128;

/// A row with `POINTS` points.
fn of(name: &'static str, bytes: usize, multiply_adds: usize, reference: f64) -> Row {
    Row { name, items: POINTS, bytes, multiply_adds, reference }
}

/// Triples of parameters, times `size`.
fn triples(size: f64) -> Vec<DVec3> {
    let [u, v, w] = [0.819_172_513_4, 0.671_043_606_7, 0.549_700_477_9].map(|step| scattered(POINTS, step));
    (0..POINTS).map(|i| DVec3::new(u[i], v[i], w[i]) * size).collect()
}

fn boxes(criterion: &mut Criterion, machine: Machine) {
    let at = triples(1.0);
    let [mut a, mut b, mut c, mut d] = buffers(POINTS);
    let cubic = BoxBatch::new(&points(64), [3; 3]).unwrap();
    row(criterion, machine, &of("box (3,3,3), scattered", 24, 195, 12.0), || {
        cubic.evaluate(black_box(&at), [black_box(&mut a)]).unwrap();
    });
    row(criterion, machine, &of("box (3,3,3), scattered, first derivatives", 96, 636, 48.0), || {
        cubic.evaluate(black_box(&at), [&mut a, &mut b, &mut c, black_box(&mut d)]).unwrap();
    });
    let rational = BoxBatch::new(&weighted(54), [2, 2, 5]).unwrap();
    row(criterion, machine, &of("rational box (2,2,5), scattered", 24, 219, 12.0), || {
        rational.evaluate_rational(black_box(&at), [black_box(&mut a)]).unwrap();
    });
}

fn grids(criterion: &mut Criterion, machine: Machine) {
    let axis = even(SIDE);
    let items = SIDE.pow(3);
    let [mut a, mut b, mut c, mut d] = buffers(items);
    let of = |name, bytes, multiply_adds, reference| Row { name, items, bytes, multiply_adds, reference };
    // The basis is part of the work.
    let grid = |degrees, order| BoxGridBatch::new(degrees, black_box(&axis), &axis, &axis, order).unwrap();
    let net = points(64);
    row(criterion, machine, &of("box (3,3,3) on a 128³ grid", 24, 12, 1.0), || {
        grid([3; 3], 0).evaluate(black_box(&net), [black_box(&mut a)]).unwrap();
    });
    row(criterion, machine, &of("box (3,3,3) on a grid, first derivatives", 96, 45, 4.0), || {
        let out = [&mut a[..], &mut b, &mut c, black_box(&mut d)];
        grid([3; 3], 1).evaluate(black_box(&net), out).unwrap();
    });
    let net = weighted(54);
    row(criterion, machine, &of("rational box (2,2,5) on a 128³ grid", 24, 24, 1.3), || {
        grid([2, 2, 5], 0).evaluate_rational(black_box(&net), [black_box(&mut a)]).unwrap();
    });
    row(criterion, machine, &of("rational box (2,2,5), first derivatives", 96, 107, 5.2), || {
        let out = [&mut a[..], &mut b, &mut c, black_box(&mut d)];
        grid([2, 2, 5], 1).evaluate_rational(black_box(&net), out).unwrap();
    });
}

fn simplices(criterion: &mut Criterion, machine: Machine) {
    let at = triples(1.0 / 3.0);
    let [mut a, mut b, mut c, mut d] = buffers(POINTS);
    let net = |degree| -> Vec<DVec4> { weighted(simplex_count::<4>(degree)) };
    let quartic = TetrahedronBatch::new(&net(4), 4).unwrap();
    row(criterion, machine, &of("rational tetrahedron of degree 4", 24, 142, 7.7), || {
        quartic.evaluate_rational(black_box(&at), [black_box(&mut a)]).unwrap();
    });
    row(criterion, machine, &of("degree 4, first derivatives", 96, 409, 30.8), || {
        let out = [&mut a[..], &mut b, &mut c, black_box(&mut d)];
        quartic.evaluate_rational(black_box(&at), out).unwrap();
    });
    let tenth = TetrahedronBatch::new(&net(10), 10).unwrap();
    row(criterion, machine, &of("rational tetrahedron of degree 10", 24, 1146, 34.0), || {
        tenth.evaluate_rational(black_box(&at), [black_box(&mut a)]).unwrap();
    });
    row(criterion, machine, &of("degree 10, first derivatives", 96, 3813, 136.0), || {
        let out = [&mut a[..], &mut b, &mut c, black_box(&mut d)];
        tenth.evaluate_rational(black_box(&at), out).unwrap();
    });
    // There is no bar for wedges: twice the multiply-adds.
    let wedge = WedgeBatch::new(&weighted(40), [3, 3]).unwrap();
    row(criterion, machine, &of("rational wedge (3,3)", 24, 162, 11.0), || {
        wedge.evaluate_rational(black_box(&at), [black_box(&mut a)]).unwrap();
    });
    row(criterion, machine, &of("rational wedge (3,3), first derivatives", 96, 483, 44.0), || {
        let out = [&mut a[..], &mut b, &mut c, black_box(&mut d)];
        wedge.evaluate_rational(black_box(&at), out).unwrap();
    });
}

fn run(criterion: &mut Criterion) {
    let machine = Machine::measure();
    boxes(criterion, machine);
    grids(criterion, machine);
    simplices(criterion, machine);
}

criterion_group!(benches, run);
criterion_main!(benches);
