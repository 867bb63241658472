//! Harmonic coordinates: set-up and fresh evaluation, on one thread.
//!
//! Run with `cargo bench -p casteljau-benches --bench harmonic`; certificates are printed first.
//!
//! **Set-up** (`harmonic set-up`, by number of sides and accuracy, milliseconds). The limit is the last least-squares
//! solve alone, a Householder factorization of r rows and c unknowns, r about 3c: (2r − 2c/3)·c² flops, 16 a cycle. The
//! rounds before it, the rows themselves (a complex power series a row) and the check come on top.
//!
//! The medians over the exact cases: `cargo run --release -p casteljau-domain --example harmonic_bars`.
//!
//! **Evaluation** (`harmonic evaluate`, nanoseconds a point; order 0, 1, 2 = values, gradients, second derivatives). The
//! limit for c unknowns and n coordinates is c·m·k multiply-adds, m being n rounded up to a multiple of 4 and k = 1, 3, 5
//! the solved rows, 8 a cycle at 3.7 GHz:
//!
//! | polygon | c | singular corners | values | gradients | second derivatives |
//! | --- | --- | --- | --- | --- | --- |
//! | 6 L | 71 | 1 | 19 | 58 | 96 |
//! | 8 U | 137 | 2 | 37 | 110 | 190 |
//! | 10 regular | 115 | 10 | 47 | 140 | 230 |
//! | 10 star | 140 | 10 | 57 | 170 | 280 |
//!
//! Eight points run side by side, their logarithms, angles and powers too. With gradients the exact cases need 259 ns a
//! point in the median and 465 at most, by `harmonic_bars` above: two to four times the limit. Most of the distance is
//! the chain of complex products that makes the c functions: each power waits for the one before it.
//!
//! Measured on one core of an AMD EPYC (Zen 4) with AVX-512.

use std::f64::consts::{PI, TAU};
use std::hint::black_box;
use std::time::Duration;

use casteljau_domain::glam::{DVec2, dvec2};
use casteljau_domain::{Coordinates, DomainError, HarmonicOptions, Location, Polygon};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

fn polygon(points: &[(f64, f64)]) -> Result<Polygon, DomainError> {
    Polygon::new(points.iter().map(|p| dvec2(p.0, p.1)).collect())
}

fn regular(n: usize) -> Result<Polygon, DomainError> {
    Polygon::new((0..n).map(|i| DVec2::from_angle(i as f64 * TAU / n as f64)).collect())
}

fn star() -> Result<Polygon, DomainError> {
    let corner =
        |i: usize| DVec2::from_angle(i as f64 * PI / 5.0) * if i.is_multiple_of(2) { 1.0 } else { 0.4 };
    Polygon::new((0..10).map(corner).collect())
}

/// Polygons of 4 to 10 sides, then hard ones.
fn shapes() -> Result<Vec<(&'static str, Polygon)>, DomainError> {
    Ok(vec![
        ("4 dart", polygon(&[(0., 0.), (2., -1.), (0.8, 0.), (2., 1.)])?),
        ("6 regular", regular(6)?),
        ("6 L", polygon(&[(0., 0.), (2., 0.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)])?),
        ("8 regular", regular(8)?),
        ("8 U", polygon(&[(0., 0.), (3., 0.), (3., 2.), (2., 2.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)])?),
        ("10 regular", regular(10)?),
        ("10 star", star()?),
        ("6 thin L", polygon(&[(0., 0.), (10., 0.), (10., 0.5), (0.5, 0.5), (0.5, 6.), (0., 6.)])?),
        (
            "8 slot",
            polygon(&[
                (0., 0.),
                (3., 0.),
                (3., 3.),
                (1.55, 3.),
                (1.55, 0.5),
                (1.45, 0.5),
                (1.45, 3.),
                (0., 3.),
            ])?,
        ),
        (
            "16 comb",
            polygon(&[
                (0., 0.),
                (7., 0.),
                (7., 3.),
                (6., 3.),
                (6., 1.),
                (5., 1.),
                (5., 3.),
                (4., 3.),
                (4., 1.),
                (3., 1.),
                (3., 3.),
                (2., 3.),
                (2., 1.),
                (1., 1.),
                (1., 3.),
                (0., 3.),
            ])?,
        ),
    ])
}

fn set_up(criterion: &mut Criterion) -> Result<(), DomainError> {
    let mut group = criterion.benchmark_group("harmonic set-up");
    group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2));
    for (name, polygon) in shapes()? {
        for (accuracy, options) in
            [("1e-8", HarmonicOptions::default()), ("1e-10", HarmonicOptions::high_accuracy())]
        {
            match Coordinates::harmonic(polygon.clone(), &options) {
                Ok(c) => println!("{name} {accuracy}: certificate {:.1e}", c.certificate()),
                Err(error) => println!("{name} {accuracy}: {error}"),
            }
            group.bench_function(BenchmarkId::new(name, accuracy), |b| {
                b.iter(|| Coordinates::harmonic(black_box(polygon.clone()), &options));
            });
        }
    }
    Ok(())
}

/// Points that fill the polygon evenly.
fn points(polygon: &Polygon, count: usize) -> Vec<DVec2> {
    let [low, high] = polygon.bounding_box();
    let at = |k: u32| {
        low + (high - low) * dvec2(f64::from(k) * 0.754_877_666, f64::from(k) * 0.569_840_291).fract()
    };
    (1..).map(at).filter(|p| matches!(polygon.locate(*p), Location::Inside(_))).take(count).collect()
}

fn evaluation(criterion: &mut Criterion) -> Result<(), DomainError> {
    let mut group = criterion.benchmark_group("harmonic evaluate");
    group.warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2));
    for (name, polygon) in
        shapes()?.into_iter().filter(|s| ["6 L", "8 U", "10 regular", "10 star"].contains(&s.0))
    {
        let coordinates = Coordinates::harmonic(polygon, &HarmonicOptions::default())?;
        let points = points(coordinates.polygon(), 4000);
        group.throughput(Throughput::Elements(points.len() as u64));
        for order in 0..3 {
            let mut out = vec![0.0; points.len() * coordinates.stride(order)];
            group.bench_function(BenchmarkId::new(name, order), |b| {
                b.iter(|| coordinates.evaluate_inside(black_box(&points), order, black_box(&mut out)));
            });
        }
    }
    Ok(())
}

fn run(criterion: &mut Criterion) {
    if let Err(error) = set_up(criterion).and_then(|()| evaluation(criterion)) {
        eprintln!("{error}");
    }
}

criterion_group!(benches, run);
criterion_main!(benches);
