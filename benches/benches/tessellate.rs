//! Tessellation of concave patches with harmonic coordinates on one thread: six cubic sides of two layers over an L, and
//! twelve sides of degree 9 with five layers, 600 control points, over a star.
//!
//! Medians on one core of an AMD EPYC (Zen 4). Run with
//! `RAYON_NUM_THREADS=1 cargo bench -p casteljau-benches --bench tessellate`. Per triangle, that is for half a vertex;
//! the bound wanted is 3 µs.
//!
//! | bench | triangles | limit | measured | why |
//! | --- | --- | --- | --- | --- |
//! | L, resolution 10 | 0.5 thousand | 0.7 µs | 0.9 µs | 48 samples with normals for the sizes |
//! | L, resolution 50 | 13 thousand | 0.7 µs | 1.0 µs | 0.5 µs triangulation, 0.2 µs half a point with its normal; the rest below |
//! | L, resolution 140 | 99 thousand | 0.7 µs | 1.1 µs | the same, out of the second-level cache |
//! | L, tolerance 1e-3 | 0.6 thousand | 0.8 µs | 1.7 µs | 170 samples for the sizes |
//! | L, tolerance 5e-5 | 11 thousand | 0.8 µs | 1.3 µs | and 0.3 µs measuring |
//! | L, tolerance 6e-6 | 86 thousand | 0.8 µs | 1.6 µs | the same, out of the second-level cache |
//! | star, tolerance 1e-3 | 0.3 thousand | 1.4 µs | 3.9 µs | a sample for every other triangle, two places measured a triangle, and rounds of flips at the tips |
//! | star, tolerance 1e-4 | 3 thousand | 1.4 µs | 3.2 µs | ten times the control points of the L: 0.6 µs half a point, the rest as above |
//!
//! The limit is what the parts cost that cannot be left out: half an insertion into the triangulation, half a fresh
//! point with derivatives, half a normal. With a tolerance one triangle in two or three is measured at a further fresh
//! point. The rest is neighbours, flips, and the mesh itself. Small meshes pay for the samples that the sizes come from.

#![allow(clippy::unwrap_used)]

use std::f64::consts::TAU;
use std::hint::black_box;

use casteljau::tess::{TessellationOptions, no_progress, tessellate};
use casteljau_domain::Polygon;
use casteljau_gb::glam::{DVec2, DVec3, dvec2, dvec3};
use casteljau_gb::{ConcavePatch, Ribbon};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// A polygon lifted to a gently curved surface, ribbons leaning along the neighbouring sides.
fn patch(corners: Vec<DVec2>, degree: usize, layers: usize) -> ConcavePatch {
    let domain = Polygon::new(corners).unwrap();
    let n = domain.len();
    let v = |i: usize| domain.vertices()[i % n];
    let sign = |corner: usize| if domain.is_concave(corner % n) { -1.0 } else { 1.0 };
    let lifted = |p: DVec2| -> DVec3 { dvec3(p.x, p.y, 0.25 * (1.1 * p.x + 0.4).sin() + 0.1 * p.x * p.y) };
    let ribbons = (0..n).map(|i| {
        let (a, b) = (v(i + n - 1), v(i));
        let before = (v(i + n - 2) - a) * sign(i + n - 1);
        let after = (v(i + 1) - b) * sign(i);
        let row = |k: usize| {
            (0..=degree).map(move |j| {
                let (s, h) = (j as f64 / degree as f64, k as f64 / (2 * layers - 1) as f64);
                lifted(a.lerp(b, s) + before.lerp(after, s) * h)
            })
        };
        Ribbon::new(degree, layers, (0..layers).flat_map(row).collect()).unwrap()
    });
    ConcavePatch::builder(ribbons.collect()).domain(domain).build().unwrap()
}

/// Six cubic sides of two layers over an L.
fn l() -> ConcavePatch {
    let corners = [(0., 0.), (2., 0.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)];
    patch(corners.iter().map(|&(x, y)| dvec2(x, y)).collect(), 3, 2)
}

/// Twelve sides of degree 9 with five layers, every other corner concave: 600 control points.
fn star() -> ConcavePatch {
    let corner = |i: usize| {
        let radius = if i.is_multiple_of(2) { 1.0 } else { 0.6 };
        DVec2::from_angle(i as f64 * TAU / 12.0) * radius
    };
    patch((0..12).map(corner).collect(), 9, 5)
}

fn run(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("tessellate");
    group.sample_size(20);
    let of_l = [
        ("L, resolution 10", TessellationOptions::resolution(10)),
        ("L, resolution 50", TessellationOptions::resolution(50)),
        ("L, resolution 140", TessellationOptions::resolution(140)),
        ("L, tolerance 1e-3", TessellationOptions::tolerance(1e-3)),
        ("L, tolerance 5e-5", TessellationOptions::tolerance(5e-5)),
        ("L, tolerance 6e-6", TessellationOptions::tolerance(6e-6)),
    ];
    let of_star = [
        ("star, tolerance 1e-3", TessellationOptions::tolerance(1e-3)),
        ("star, tolerance 1e-4", TessellationOptions::tolerance(1e-4)),
    ];
    for (patch, requests) in [([l()], &of_l[..]), ([star()], &of_star)] {
        for (name, options) in requests {
            let triangles = tessellate(&patch, options, &mut no_progress).unwrap().1.triangles;
            group.throughput(Throughput::Elements(triangles as u64));
            group.bench_function(format!("{name}, {triangles} triangles"), |b| {
                b.iter(|| tessellate(black_box(&patch), options, &mut no_progress));
            });
        }
    }
}

criterion_group!(benches, run);
criterion_main!(benches);
