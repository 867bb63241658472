//! Closest points and intersections, one query at a time on one thread.
//!
//! | benchmark | limit | measured | why |
//! | --- | --- | --- | --- |
//! | `closest/bicubic patch` | 25 µs a query | 6.9 µs | 40 to 90 pieces looked at, one or two descents of 0.7 µs; a few queries cut further pieces |
//! | `closest/bicubic patch from a start` | 2 µs a query | 0.70 µs | four jets of order 2 |
//! | `closest/cubic triangle` | 25 µs a query | 8.0 µs | as the patch of degrees 3 × 3 that its square with a collapsed side is |
//! | `closest/cubic triangle from a start` | 2 µs a query | 0.80 µs | as the patch; again where the descent comes near the collapsed side |
//! | `closest/cubic curve` | 5 µs a query | 0.83 µs | as the patch |
//! | `closest/prepare a bicubic patch` | 5 ms | 1.5 ms | 1500 pieces, each a restriction and six derivative nets |
//! | `closest/all minima of a bicubic patch` | 1 ms | 8.8 µs | every piece with a minimum |
//! | `intersect/bicubic patch and line` | 100 µs | 4.8 µs | some boxes, each a restriction |
//!
//! The queries are random points in a box twice the size of that of the patch, as are the patches themselves: half
//! of them like a surface (a net near a grid), half with points anywhere.
//! Measured on one idle core of an AMD EPYC (Zen 4) with
//! `cargo bench -p casteljau-benches --bench closest`.

#![allow(clippy::unwrap_used)]

use casteljau::shape::geom::glam::DVec3;
use casteljau::shape::{
    Curve, CurveProjector, Patch, PatchProjector, StraightLine, Triangle, TriangleProjector,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

const SHAPES: usize = 20;
const QUERIES: usize = 1000;

/// The k-th term of an evenly spread sequence in the unit cube.
fn spread(k: usize) -> DVec3 {
    DVec3::from([0.819_172_513, 0.671_043_607, 0.549_700_478].map(|a| ((k + 1) as f64 * a).fract()))
}

fn patch(k: usize) -> Patch {
    let point = |p: usize| match k % 2 {
        0 => DVec3::new((p / 4) as f64, (p % 4) as f64, 0.0) / 3.0 + (spread(k * 16 + p) - 0.5) * 0.3,
        _ => spread(k * 16 + p),
    };
    Patch::new([3, 3], (0..16).map(point).collect::<Vec<_>>()).unwrap()
}

/// A cubic triangle over half of the square, chosen as the patches are.
fn triangle(k: usize) -> Triangle {
    let over = |p: usize, i: usize, j: usize| match k % 2 {
        0 => DVec3::new(i as f64, j as f64, 0.0) / 3.0 + (spread(k * 10 + p) - 0.5) * 0.3,
        _ => spread(k * 10 + p),
    };
    // Indices (i, j, 3 − i − j) in descending lexicographic order.
    let indices = (0..4).rev().flat_map(|i| (0..4 - i).rev().map(move |j| (i, j)));
    Triangle::new(3, indices.enumerate().map(|(p, (i, j))| over(p, i, j)).collect::<Vec<_>>()).unwrap()
}

fn query(k: usize) -> DVec3 {
    spread(k + 7777) * 2.0 - 0.5
}

fn closest_benches(criterion: &mut Criterion) {
    let patches: Vec<Patch> = (0..SHAPES).map(patch).collect();
    let projectors: Vec<PatchProjector> = patches.iter().map(|p| PatchProjector::new(p).unwrap()).collect();
    let curve = |k: usize| Curve::new((0..4).map(|p| spread(k * 4 + p)).collect::<Vec<_>>()).unwrap();
    let curves: Vec<CurveProjector> = (0..SHAPES).map(|k| CurveProjector::new(&curve(k)).unwrap()).collect();
    let mut group = criterion.benchmark_group("closest");

    group.throughput(Throughput::Elements(QUERIES as u64));
    group.bench_function("bicubic patch", |b| {
        b.iter(|| -> f64 {
            (0..QUERIES).map(|k| projectors[k % SHAPES].closest_point(query(k)).unwrap().distance).sum()
        });
    });
    let starts: Vec<[f64; 2]> = (0..QUERIES)
        .map(|k| projectors[k % SHAPES].closest_point(query(k)).unwrap().parameters.map(|x| x + 0.01))
        .collect();
    group.bench_function("bicubic patch from a start", |b| {
        b.iter(|| -> f64 {
            let near = |k: usize| projectors[k % SHAPES].closest_point_from(query(k), starts[k]);
            (0..QUERIES).map(|k| near(k).unwrap().distance).sum()
        });
    });
    group.bench_function("cubic curve", |b| {
        b.iter(|| -> f64 {
            (0..QUERIES).map(|k| curves[k % SHAPES].closest_point(query(k)).unwrap().distance).sum()
        });
    });
    let triangles: Vec<TriangleProjector> =
        (0..SHAPES).map(|k| TriangleProjector::new(&triangle(k)).unwrap()).collect();
    group.bench_function("cubic triangle", |b| {
        b.iter(|| -> f64 {
            (0..QUERIES).map(|k| triangles[k % SHAPES].closest_point(query(k)).unwrap().distance).sum()
        });
    });
    let starts: Vec<[f64; 2]> = (0..QUERIES)
        .map(|k| triangles[k % SHAPES].closest_point(query(k)).unwrap().parameters.map(|x| x + 0.01))
        .collect();
    group.bench_function("cubic triangle from a start", |b| {
        b.iter(|| -> f64 {
            let near = |k: usize| triangles[k % SHAPES].closest_point_from(query(k), starts[k]);
            (0..QUERIES).map(|k| near(k).unwrap().distance).sum()
        });
    });
    group.throughput(Throughput::Elements(1));
    group.bench_function("prepare a bicubic patch", |b| b.iter(|| PatchProjector::new(&patches[0]).unwrap()));
    group.bench_function("all minima of a bicubic patch", |b| {
        b.iter(|| projectors[0].local_minima(query(3)).unwrap());
    });
    group.finish();

    let mut group = criterion.benchmark_group("intersect");
    let line = StraightLine::line(DVec3::new(0.4, 0.6, 2.0), DVec3::new(0.1, -0.1, -1.0)).unwrap();
    group.bench_function("bicubic patch and line", |b| {
        b.iter(|| patches[0].intersect_line(&line, 1e-7).unwrap());
    });
    group.finish();
}

criterion_group!(benches, closest_benches);
criterion_main!(benches);
