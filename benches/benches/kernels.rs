//! The batch kernels of `casteljau-bernstein` on one thread, against what this machine can do.
//!
//! Run with `cargo bench -p casteljau-benches --bench kernels`. First the machine: how fast it stores into memory
//! that was touched before, with buffers of the size that the batches have, and how many multiply-adds it does.
//! Then each row says, an item (point, patch or curve): the least time of all runs, the limit, which is the larger
//! of what its stores and what its multiply-adds take at these rates, the ratio of the two, and the bar, which is a
//! plain AVX-512 program's time on a machine that stores 24 GB/s, scaled where this one stores less, with 15 % on
//! top. Figures of one quiet core of an AMD EPYC (Zen 4, AVX-512), in nanoseconds an item; it stored 55 GB/s
//! into 24 MB (which its third cache holds) and 28 GB/s into 72 MB, and did 29.5 billion multiply-adds a second:
//!
//! | work an item | bytes | multiply-adds | limit | measured | bar |
//! | --- | --- | --- | --- | --- | --- |
//! | cubic curve | 24 | 12 | 0.43 | 1.00 | 1.15 |
//! | with two derivatives | 72 | 24 | 2.6 | 3.1 | 3.3 |
//! | curve of degree 9 | 24 | 30 | 1.0 | 1.6 | 1.8 |
//! | curve of degree 25 | 24 | 83 | 2.8 | 3.6 | 5.8 |
//! | rational cubic: two divisions, which take the multiplier's place | 24 | 16 | 0.54 | 1.19 | 1.08 |
//! | bicubic grid: a row's curve at its column | 24 | 12 | 0.43 | 1.12 | 1.5 |
//! | with first derivatives: three streams of stores | 72 | 33 | 2.6 | 4.2 | 3.7 |
//! | with unit normals | 48 | 51 | 1.7 | 3.3 | 3.0 |
//! | rational biquintic grid | 24 | 24 | 0.81 | 1.5 | 1.7 |
//! | with first derivatives | 72 | 74 | 2.6 | 4.9 | 4.6 |
//! | 10,000 bicubic patches on 16 × 16: a row's curve serves two registers | 24 | 12 | 0.87 | 1.5 | 1.15 |
//! | bicubic at scattered points: all control points, two divisions | 24 | 50 | 1.7 | 2.5 | 2.2 |
//! | with first derivatives | 72 | 126 | 4.3 | 5.7 | 6.6 |
//! | patch split: six affine combinations of 4 points, two operations each | 768 | 144 | 28 | 51 | 68 |
//! | patch elevated to (4,4) | 600 | 246 | 22 | 47 | 53 |
//! | degree 20 to the power basis | 504 | 693 | 23 | 56 | 196 |
//!
//! On a shared machine the rates fall and rise with the neighbours' work; compare the ratios, not the times.
//!
//! What the missed ones wait for, and what did not help:
//! - *Rational cubic.* The times are those of divisions that take as long as nine multiply-adds, with nothing multiplied meanwhile:
//!   16 + 2 · 9 a register. By the basis, with one division, it would be 22 + 3 + 9, the same (counted, not tried).
//! - *10,000 patches.* Four patches, which stay in the first cache, take 1.4 to 1.5 ns a point too: stores are a tenth of it, so
//!   that prefetching for them has little to win. The rest is what surrounds two registers a row. Making the control rows into
//!   points at all columns first, and rows into combinations of these, takes 11 % less in the cache and twice as long beyond it.
//!   Curves that begin at a line of the cache change nothing.
//! - *Scattered bicubic.* One division for both quotients, p = (1−u)(1−v), x = u(1−v)/p, y = v(1−u)/p, keeps the error bound
//!   with p³ as the factor, and changes nothing.

#![allow(clippy::unwrap_used)]

mod machine;

use std::hint::black_box;

use casteljau_bernstein::glam::DVec2;
use casteljau_bernstein::{CurveBatch, GridBatch, PatchBatch, elevate_many, subdivide_many, to_power_many};
use criterion::{Criterion, criterion_group, criterion_main};
use machine::{Machine, POINTS, Row, buffers, even, points, row, scattered, weighted};

/// Points a side of the large grids.
const SIDE: usize = 1000;

fn curves(criterion: &mut Criterion, machine: Machine) {
    let t = scattered(POINTS, 0.618_033_988_75);
    let [mut a, mut b, mut c] = buffers(POINTS);
    let of =
        |name, bytes, multiply_adds, reference| Row { name, items: POINTS, bytes, multiply_adds, reference };
    let cubic = CurveBatch::new(&points(4)).unwrap();
    row(criterion, machine, &of("cubic curve", 24, 12, 1.0), || {
        cubic.evaluate(black_box(&t), [black_box(&mut a)]).unwrap();
    });
    row(criterion, machine, &of("cubic curve, two derivatives", 72, 24, 2.9), || {
        cubic.evaluate(black_box(&t), [&mut a, &mut b, black_box(&mut c)]).unwrap();
    });
    let ninth = CurveBatch::new(&points(10)).unwrap();
    row(criterion, machine, &of("curve of degree 9", 24, 30, 1.6), || {
        ninth.evaluate(black_box(&t), [black_box(&mut a)]).unwrap();
    });
    let high = CurveBatch::new(&points(26)).unwrap();
    row(criterion, machine, &of("curve of degree 25", 24, 83, 5.0), || {
        high.evaluate(black_box(&t), [black_box(&mut a)]).unwrap();
    });
    let rational = CurveBatch::new(&weighted(4)).unwrap();
    row(criterion, machine, &of("rational cubic curve", 24, 16, 0.94), || {
        rational.evaluate_rational(black_box(&t), [black_box(&mut a)]).unwrap();
    });
}

fn grids(criterion: &mut Criterion, machine: Machine) {
    let axis = even(SIDE);
    let [mut a, mut b, mut c] = buffers(SIDE * SIDE);
    let of = |name, bytes, multiply_adds, reference| Row {
        name,
        items: SIDE * SIDE,
        bytes,
        multiply_adds,
        reference,
    };
    // The basis is part of the work.
    let grid = |degree, order| GridBatch::new([degree; 2], black_box(&axis), &axis, order).unwrap();
    let net = points(16);
    row(criterion, machine, &of("bicubic grid", 24, 12, 1.3), || {
        grid(3, 0).evaluate(black_box(&net), [black_box(&mut a)]).unwrap();
    });
    row(criterion, machine, &of("bicubic grid, first derivatives", 72, 33, 3.2), || {
        grid(3, 1).evaluate(black_box(&net), [&mut a, &mut b, black_box(&mut c)]).unwrap();
    });
    row(criterion, machine, &of("bicubic grid, unit normals", 48, 51, 2.6), || {
        grid(3, 1).normals(black_box(&net), &mut a, black_box(&mut b)).unwrap();
    });
    let net = weighted(36);
    row(criterion, machine, &of("rational biquintic grid", 24, 24, 1.5), || {
        grid(5, 0).evaluate_rational(black_box(&net), [black_box(&mut a)]).unwrap();
    });
    row(criterion, machine, &of("rational biquintic grid, first derivatives", 72, 74, 4.0), || {
        grid(5, 1).evaluate_rational(black_box(&net), [&mut a, &mut b, black_box(&mut c)]).unwrap();
    });
    let (nets, axis) = (points(160_000), even(16));
    let [mut many] = buffers(10_000 * 256);
    let small = Row {
        name: "10,000 bicubic patches on 16 × 16 grids",
        items: 10_000 * 256,
        bytes: 24,
        multiply_adds: 12,
        reference: 1.0,
    };
    row(criterion, machine, &small, || {
        let grid = GridBatch::new([3, 3], black_box(&axis), &axis, 0).unwrap();
        grid.evaluate(black_box(&nets), [black_box(&mut many)]).unwrap();
    });
}

fn patches(criterion: &mut Criterion, machine: Machine) {
    let [u, v] = [0.754_877_666_25, 0.569_840_291].map(|step| scattered(POINTS, step));
    let uv: Vec<DVec2> = u.into_iter().zip(v).map(|(u, v)| DVec2::new(u, v)).collect();
    let [mut a, mut b, mut c] = buffers(POINTS);
    let of =
        |name, bytes, multiply_adds, reference| Row { name, items: POINTS, bytes, multiply_adds, reference };
    let patch = PatchBatch::new(&points(16), [3, 3]).unwrap();
    row(criterion, machine, &of("bicubic, scattered", 24, 50, 1.9), || {
        patch.evaluate(black_box(&uv), [black_box(&mut a)]).unwrap();
    });
    row(criterion, machine, &of("bicubic, scattered, first derivatives", 72, 126, 5.7), || {
        patch.evaluate(black_box(&uv), [&mut a, &mut b, black_box(&mut c)]).unwrap();
    });
}

fn many(criterion: &mut Criterion, machine: Machine) {
    let nets = points(16 * POINTS);
    let [mut a, mut b] = buffers(16 * POINTS);
    let of =
        |name, bytes, multiply_adds, reference| Row { name, items: POINTS, bytes, multiply_adds, reference };
    row(criterion, machine, &of("bicubic patch split at u = ½", 768, 144, 59.0), || {
        subdivide_many(black_box(&nets), 3, 4, 0.5, &mut a, black_box(&mut b)).unwrap();
    });
    drop(b);
    let [mut b] = buffers(25 * POINTS);
    row(criterion, machine, &of("bicubic patch elevated to (4,4)", 600, 246, 46.0), || {
        elevate_many(black_box(&nets), [3, 3], [4, 4], black_box(&mut b)).unwrap();
    });
    let curves = &nets[..21 * 100_000];
    let power = Row {
        name: "curve of degree 20 to the power basis",
        items: 100_000,
        bytes: 504,
        multiply_adds: 693,
        reference: 170.0,
    };
    row(criterion, machine, &power, || {
        to_power_many(black_box(curves), 20, black_box(&mut a[..21 * 100_000])).unwrap();
    });
}

fn run(criterion: &mut Criterion) {
    let machine = Machine::measure();
    curves(criterion, machine);
    grids(criterion, machine);
    patches(criterion, machine);
    many(criterion, machine);
}

criterion_group!(benches, run);
criterion_main!(benches);
