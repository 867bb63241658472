//! Tessellation of a concave patch, six cubic sides of two layers over an L with harmonic coordinates, on one thread.
//!
//! Least of 12 runs on one core of an AMD EPYC (Zen 4). Run with
//! `RAYON_NUM_THREADS=1 cargo bench -p casteljau-benches --bench tessellate`. Per triangle, that is for half a vertex;
//! the bound wanted is 3 µs.
//!
//! | bench | triangles | limit | measured | why |
//! | --- | --- | --- | --- | --- |
//! | resolution 10 | 0.5 thousand | 0.9 µs | 1.4 µs | 120 jets for half a thousand triangles |
//! | resolution 50 | 12 thousand | 0.9 µs | 1.3 µs | 0.5 µs triangulation, 0.4 µs half a point with derivatives; the rest below |
//! | resolution 140 | 99 thousand | 0.9 µs | 1.4 µs | the same, out of the second-level cache |
//! | tolerance 5e-5 | 12 thousand | 1.2 µs | 1.6 µs | and 0.3 µs measuring |
//! | tolerance 6e-6 | 90 thousand | 1.2 µs | 2.0 µs | the same, out of the second-level cache |
//!
//! The limit is what the parts cost that cannot be left out: half an insertion into the triangulation, half a fresh
//! point with derivatives, half a normal. With a tolerance one triangle in two or three is measured at a further fresh
//! point. The rest is neighbours, flips, and the mesh itself. Small meshes pay for the 120 or 300 jets that the
//! sizes come from.

#![allow(clippy::unwrap_used)]

use std::hint::black_box;

use casteljau::tess::{TessellationOptions, no_progress, tessellate};
use casteljau_domain::Polygon;
use casteljau_gb::glam::{DVec2, DVec3, dvec2, dvec3};
use casteljau_gb::{ConcavePatch, Ribbon};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// An L lifted to a gently curved surface, ribbons leaning along the neighbouring sides.
fn patch() -> ConcavePatch {
    let corners = [(0., 0.), (2., 0.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)];
    let domain = Polygon::new(corners.iter().map(|&(x, y)| dvec2(x, y)).collect()).unwrap();
    let n = domain.len();
    let v = |i: usize| domain.vertices()[i % n];
    let sign = |corner: usize| if domain.is_concave(corner % n) { -1.0 } else { 1.0 };
    let lifted = |p: DVec2| -> DVec3 { dvec3(p.x, p.y, 0.25 * (1.1 * p.x + 0.4).sin() + 0.1 * p.x * p.y) };
    let ribbons = (0..n).map(|i| {
        let (a, b) = (v(i + n - 1), v(i));
        let before = (v(i + n - 2) - a) * sign(i + n - 1);
        let after = (v(i + 1) - b) * sign(i);
        let row = |k: f64| {
            (0..4).map(move |j| {
                let s = f64::from(j) / 3.0;
                lifted(a.lerp(b, s) + before.lerp(after, s) * (k / 3.0))
            })
        };
        Ribbon::new(3, 2, row(0.0).chain(row(1.0)).collect()).unwrap()
    });
    ConcavePatch::builder(ribbons.collect()).domain(domain).build().unwrap()
}

fn run(criterion: &mut Criterion) {
    let patch = [patch()];
    let mut group = criterion.benchmark_group("tessellate");
    group.sample_size(20);
    let requests = [
        ("resolution 10", TessellationOptions::resolution(10)),
        ("resolution 50", TessellationOptions::resolution(50)),
        ("resolution 140", TessellationOptions::resolution(140)),
        ("tolerance 5e-5", TessellationOptions::tolerance(5e-5)),
        ("tolerance 6e-6", TessellationOptions::tolerance(6e-6)),
    ];
    for (name, options) in requests {
        let triangles = tessellate(&patch, &options, &mut no_progress).unwrap().1.triangles;
        group.throughput(Throughput::Elements(triangles as u64));
        group.bench_function(format!("{name}, {triangles} triangles"), |b| {
            b.iter(|| tessellate(black_box(&patch), &options, &mut no_progress));
        });
    }
}

criterion_group!(benches, run);
criterion_main!(benches);
