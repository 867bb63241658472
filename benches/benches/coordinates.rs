//! Closed-form coordinates and triangulation, on one thread.
//!
//! Run with `cargo bench -p casteljau-benches --bench coordinates`. Figures below: least of 30 runs on an otherwise idle
//! core of an AMD EPYC with AVX2, taken as 3.7 GHz, in nanoseconds a point on a regular 10-gon, in batches of 10,000
//! points. Limits count what the core's divider needs for 4 doubles at a time (5 cycles a division, 9 a square root).
//!
//! | bench | work a point | limit | measured |
//! | --- | --- | --- | --- |
//! | wachspress/0 | 11 divisions, 110 other operations, 80 bytes out | 3.7 ns (divisions) | 9 ns |
//! | wachspress/1 | twice 10 areas and reciprocals, 10 jets of 3, 240 bytes out | 8 ns (divisions) | 62 ns |
//! | wachspress/2 | the same with jets of 6, 480 bytes out | 8 ns (divisions) | 80 ns |
//! | mean_value/0 | 11 square roots, 22 divisions, 200 other operations | 14 ns (divider) | 15 ns |
//! | mean_value/1 | 21 square roots, 44 divisions, 10 jets of 3 | 28 ns (divider) | 80 ns |
//! | mean_value/2 | the same with jets of 6 | 28 ns (divider) | 98 ns |
//! | triangulate | one located insertion for two triangles; spade alone needs 740 ns a triangle | | 500 ns a triangle |
//!
//! With location of each point (`Coordinates::evaluate`) 57 ns are added: n exact orientations and distances.

use std::hint::black_box;

use casteljau_domain::glam::DVec2;
use casteljau_domain::triangulation::{TriangulationOptions, triangulate};
use casteljau_domain::{Coordinates, DomainError, Polygon};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

fn regular(n: usize) -> Result<Polygon, DomainError> {
    Polygon::new((0..n).map(|i| DVec2::from_angle(i as f64 * std::f64::consts::TAU / n as f64)).collect())
}

fn evaluation(criterion: &mut Criterion) -> Result<(), DomainError> {
    let points: Vec<DVec2> =
        (0..10_000).map(|i| DVec2::from_angle(f64::from(i)) * f64::from(i) * 9e-5).collect();
    let kinds = [
        ("wachspress", Coordinates::wachspress(regular(10)?)?),
        ("mean_value", Coordinates::mean_value(regular(10)?)?),
    ];
    for (name, coordinates) in kinds {
        let mut group = criterion.benchmark_group(name);
        group.throughput(Throughput::Elements(points.len() as u64));
        for order in 0..3 {
            let mut out = vec![0.0; points.len() * coordinates.stride(order)];
            group.bench_function(order.to_string(), |b| {
                b.iter(|| coordinates.evaluate_inside(black_box(&points), order, black_box(&mut out)));
            });
        }
        let mut out = vec![0.0; points.len() * coordinates.stride(0)];
        group.bench_function("located", |b| {
            b.iter(|| coordinates.evaluate(black_box(&points), 0, black_box(&mut out)));
        });
    }
    Ok(())
}

fn triangulation(criterion: &mut Criterion) -> Result<(), DomainError> {
    // A circle of 400 samples: 18,000 triangles, nearly all of them inside.
    let boundary = regular(400)?;
    let size = |_: DVec2| 0.025;
    let options = TriangulationOptions::default();
    let triangles = triangulate(&boundary, &size, &options)?.triangles.len();
    let mut group = criterion.benchmark_group("triangulate");
    group.throughput(Throughput::Elements(triangles as u64)).sample_size(20);
    group.bench_function("disc", |b| b.iter(|| triangulate(black_box(&boundary), &size, &options)));
    Ok(())
}

fn run(criterion: &mut Criterion) {
    if let Err(error) = evaluation(criterion).and_then(|()| triangulation(criterion)) {
        eprintln!("{error}");
    }
}

criterion_group!(benches, run);
criterion_main!(benches);
