//! The parameter of a point in a solid, one query at a time on one thread.
//!
//! | benchmark | limit | measured | why |
//! | --- | --- | --- | --- |
//! | `shaken cubes of degrees (2,2,2), points inside` | 5 µs a point | 1.8 µs | boxes of 64 cells, four or five jets |
//! | `shaken cubes of degrees (2,2,2), points of a box` | 5 µs | 1.7 µs | outside, too |
//! | `shaken cubes of degrees (2,2,2), prepare` | 1 ms | 0.12 ms | 64 restrictions and jets |
//! | `ball, points inside` | 10 µs | 2.9 µs | more steps near the edges without Jacobian |
//! | `ball, points of a box` | 10 µs | 3.2 µs | |
//! | `ball, points 1e-2 outside` | none | 0.1 ms | some hundred cells are left out one by one |
//!
//! Points inside: images of random parameters. Points of a box: random ones in a box a half larger than the solid,
//! some inside and some outside. The shaken cubes have degrees (2, 2, 2), weights from ½ to 2 and control points up to
//! 0.1 of the size away from those of a cube; the ball is one rotational hexahedron of degrees (2, 2, 3), whose
//! Jacobian vanishes on four of its edges. Measured on one core of an AMD EPYC (Zen 4) with
//! `cargo bench -p casteljau-benches --bench inversion`.

#![allow(clippy::unwrap_used)]

use casteljau_solid::geom::glam::DVec3;
use casteljau_solid::shape::RationalCurve;
use casteljau_solid::{Hexahedron, RationalHexahedron, SolidLocator};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

const SOLIDS: usize = 20;
const QUERIES: usize = 1000;

/// The k-th term of an evenly spread sequence in the unit cube.
fn spread(k: usize) -> DVec3 {
    DVec3::from([0.819_172_513, 0.671_043_607, 0.549_700_478].map(|a| ((k + 1) as f64 * a).fract()))
}

fn shaken_cube(k: usize) -> RationalHexahedron {
    let cube = Hexahedron::unit_cube().elevated([1; 3]).unwrap();
    let shaken = cube.control_points().iter().enumerate().map(|(i, p)| *p + 0.2 * (spread(27 * k + i) - 0.5));
    let weights: Vec<f64> = (0..27).map(|i| 2_f64.powf(2.0 * spread(27 * k + i + 999).x - 1.0)).collect();
    RationalHexahedron::new([2; 3], &shaken.collect::<Vec<_>>(), &weights).unwrap()
}

fn ball() -> RationalHexahedron {
    let points =
        [DVec3::new(0.0, 0.0, -1.0), DVec3::new(2.0, 0.0, -1.0), DVec3::new(2.0, 0.0, 1.0), DVec3::Z];
    let meridian = RationalCurve::new(&points, &[1.0, 1.0 / 3.0, 1.0 / 3.0, 1.0]).unwrap();
    RationalHexahedron::rotational(&meridian).unwrap()
}

fn inversion_benches(criterion: &mut Criterion) {
    let kinds = [
        ("shaken cubes of degrees (2,2,2)", (0..SOLIDS).map(shaken_cube).collect::<Vec<_>>()),
        ("ball", vec![ball()]),
    ];
    let mut group = criterion.benchmark_group("inversion");
    for (name, solids) in kinds {
        let mut locators: Vec<_> = solids.iter().map(|s| SolidLocator::of_hexahedron(s).unwrap()).collect();
        let count = solids.len();
        let inside: Vec<DVec3> =
            (0..QUERIES).map(|k| solids[k % count].point(spread(k + 7777).to_array()).unwrap()).collect();
        let boxes: Vec<_> = solids.iter().map(|s| s.tight_box(0.1).unwrap()).collect();
        let anywhere: Vec<DVec3> = (0..QUERIES)
            .map(|k| boxes[k % count].center() + (spread(k + 99) - 0.5) * 1.5 * boxes[k % count].size())
            .collect();
        group.throughput(Throughput::Elements(QUERIES as u64));
        for (which, points) in [("points inside", &inside), ("points of a box", &anywhere)] {
            group.bench_function(format!("{name}, {which}"), |b| {
                b.iter(|| -> usize {
                    let found = |(k, &p): (usize, &DVec3)| locators[k % count].locate(p).unwrap().is_some();
                    points.iter().enumerate().map(found).filter(|&found| found).count()
                });
            });
        }
        group.throughput(Throughput::Elements(1));
        group.bench_function(format!("{name}, prepare"), |b| {
            b.iter(|| SolidLocator::of_hexahedron(&solids[0]).unwrap().size());
        });
    }
    let mut locator = SolidLocator::of_hexahedron(&ball()).unwrap();
    let direction = |k: usize| (spread(k) - 0.5).normalize();
    group.throughput(Throughput::Elements(QUERIES as u64));
    for gap in [1e-2, 1e-6, 1e-10] {
        group.bench_function(format!("ball, points {gap:e} outside"), |b| {
            b.iter(|| -> usize {
                let outside = |k: usize| locator.locate(direction(k) * (1.0 + gap)).unwrap().is_none();
                (0..QUERIES).map(outside).filter(|&outside| outside).count()
            });
        });
    }
    group.finish();
}

criterion_group!(benches, inversion_benches);
criterion_main!(benches);
