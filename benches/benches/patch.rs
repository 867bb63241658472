//! Evaluation of a concave patch: six cubic sides of two layers (48 control points) over an L, one thread.
//!
//! | benchmark | limit | measured | why |
//! | --- | --- | --- | --- |
//! | `points from samples` | 22 ns a point | 44 ns | 460 additions and multiplications and 37 divisions, four at a time with AVX2; one blend waits for another |
//! | `normals from samples` | 70 ns a point | 124 ns | the same on numbers with two derivatives, 3 to 5 operations each; more than the registers hold |
//! | `jets from samples` | 250 ns a point | 344 ns | the same with five derivatives |
//! | `blend matrix` | 25 ns a row | 48 ns | the blends of a point and 384 bytes to write |
//! | `edit product` | 60 µs | 68 µs | 1.44 million multiplications and as many additions, four at a time and two in flight at 3 GHz; 3.84 MB from the second-level cache |
//! | `move one control point` | 4 µs | 12 µs | 80 kB of weights, 240 kB to read and write |
//!
//! Measured on one core of an AMD EPYC (Zen 4) with `cargo bench -p casteljau-benches --bench patch`.

#![allow(clippy::unwrap_used)]

use casteljau_domain::{Coordinates, Location, Polygon};
use casteljau_gb::glam::{DVec2, DVec3, dvec2, dvec3};
use casteljau_gb::{BlendMatrix, ConcavePatch, Ribbon, SampleSet, SurfaceJet};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// Points that the edit product is measured with; few enough to stay on one thread.
const POINTS: usize = 10_000;
/// Points of the other benchmarks: one chunk, so that one thread does the work.
const CHUNK: usize = 2048;

fn l_shape() -> Polygon {
    let v = [(0., 0.), (2., 0.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)];
    Polygon::new(v.iter().map(|&(x, y)| dvec2(x, y)).collect()).unwrap()
}

/// Straight sides, the layers a third further in, over a saddle.
fn patch() -> ConcavePatch {
    let polygon = l_shape();
    let ribbon = |i: usize| {
        let [a, b] = polygon.side(i);
        let inward = (b - a).perp() * 0.2;
        let lift = |p: DVec2| dvec3(p.x, p.y, 0.3 * p.x * p.y);
        let row = |k: usize| (0..4).map(move |j| lift(a.lerp(b, j as f64 / 3.0) + inward * k as f64));
        Ribbon::new(3, 2, row(0).chain(row(1)).collect()).unwrap()
    };
    let coordinates = Coordinates::mean_value(polygon.clone()).unwrap();
    ConcavePatch::builder((0..6).map(ribbon).collect()).prepared_coordinates(coordinates).build().unwrap()
}

fn locations(polygon: &Polygon, count: usize) -> Vec<Location> {
    let step = |k: usize, a: f64| 2.0 * (k as f64 * a).fract();
    let points = (0..).map(|k| dvec2(step(k, 0.754_877_666), step(k, 0.569_840_291)));
    points.map(|p| polygon.locate(p)).filter(|l| matches!(l, Location::Inside(_))).take(count).collect()
}

fn patch_benches(criterion: &mut Criterion) {
    let patch = patch();
    let at = locations(patch.domain(), POINTS);
    let mut group = criterion.benchmark_group("patch");

    group.throughput(Throughput::Elements(CHUNK as u64));
    let samples = |order| SampleSet::new(patch.coordinates(), &at[..CHUNK], order).unwrap();
    let (values, slopes, curvatures) = (samples(0), samples(1), samples(2));
    let (mut points, mut normals) = (vec![DVec3::ZERO; CHUNK], vec![DVec3::ZERO; CHUNK]);
    let zero = DVec3::ZERO;
    let mut jets =
        vec![SurfaceJet { point: zero, du: zero, dv: zero, duu: zero, duv: zero, dvv: zero }; CHUNK];
    group.bench_function("points from samples", |b| {
        b.iter(|| patch.evaluate_samples(&values, &mut points).unwrap());
    });
    group.bench_function("normals from samples", |b| {
        b.iter(|| patch.evaluate_sample_normals(&slopes, &mut points, &mut normals).unwrap());
    });
    group.bench_function("jets from samples", |b| {
        b.iter(|| patch.evaluate_sample_jets(&curvatures, &mut jets).unwrap());
    });
    group.bench_function("blend matrix", |b| b.iter(|| BlendMatrix::new(&patch, &values).unwrap()));

    group.throughput(Throughput::Elements(POINTS as u64));
    let all = SampleSet::new(patch.coordinates(), &at, 0).unwrap();
    let matrix = BlendMatrix::new(&patch, &all).unwrap();
    let mut net = vec![DVec3::ZERO; patch.control_point_count()];
    patch.control_points(&mut net).unwrap();
    let mut points = vec![DVec3::ZERO; POINTS];
    group.bench_function("edit product", |b| b.iter(|| matrix.apply(&net, &mut points).unwrap()));
    group.bench_function("move one control point", |b| {
        b.iter(|| matrix.move_column(7, dvec3(1e-9, 0.0, 0.0), &mut points).unwrap());
    });
    group.finish();
}

criterion_group!(benches, patch_benches);
criterion_main!(benches);
