//! The sign of det J over solids, on one thread.
//!
//! | benchmark | limit | measured | why |
//! | --- | --- | --- | --- |
//! | `certificate/trilinear hexahedra` | 1 µs a solid | … | … |
//!
//! The trilinear hexahedra are unit cubes whose corners were moved by up to 0.2 in each direction, all valid.

#![allow(clippy::unwrap_used)]

use casteljau_solid::geom::glam::{DVec3, DVec4};
use casteljau_solid::{DEFAULT_OPERATIONS, SolidNet, jacobian_verdict};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

const SOLIDS: usize = 1000;

/// The k-th term of an evenly spread sequence in the cube from −1 to 1.
fn spread(k: usize) -> DVec3 {
    DVec3::from(
        [0.819_172_513, 0.671_043_607, 0.549_700_478].map(|a| 2.0 * ((k + 1) as f64 * a).fract() - 1.0),
    )
}

/// A cube of n³ cells with control points moved by up to `noise` of a cell.
fn cube(k: usize, n: usize, noise: f64) -> Vec<DVec3> {
    let count = (n + 1).pow(3);
    let point = |p: usize| {
        let index = [p / (n + 1).pow(2), p / (n + 1) % (n + 1), p % (n + 1)];
        DVec3::from(index.map(|i| i as f64)) + noise * spread(k * count + p)
    };
    (0..count).map(point).collect()
}

/// The ball of radius 1 as one rational hexahedron: half a circle about the axis.
fn ball() -> Vec<DVec4> {
    let meridian = [[0.0, -1.0, 1.0], [2.0, -1.0, 1.0 / 3.0], [2.0, 1.0, 1.0 / 3.0], [0.0, 1.0, 1.0]];
    let turned = [[1, 0], [1, -1], [0, -1], [1, 1], [0, 0], [-1, -1], [0, 1], [-1, 1], [-1, 0]];
    let shares = [1.0, 1.0, 2.0];
    let place = |p: usize| {
        let share: f64 = shares[p / 3] * shares[p % 3];
        meridian.map(|[x, z, r]: [f64; 3]| {
            let [c, s] = turned[p].map(f64::from);
            DVec4::new(c * x, s * x, z, 1.0) * (r * share)
        })
    };
    (0..9).flat_map(place).collect()
}

fn benches(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("certificate");
    let trilinear: Vec<Vec<DVec3>> = (0..SOLIDS).map(|k| cube(k, 1, 0.2)).collect();
    let valid = |net: &SolidNet<'_, DVec3>| jacobian_verdict(net, DEFAULT_OPERATIONS).unwrap().is_valid();
    let hexahedron = |points: &[DVec3], n: usize| valid(&SolidNet::Hexahedron { points, degrees: [n; 3] });
    group.throughput(Throughput::Elements(SOLIDS as u64));
    group.bench_function("trilinear hexahedra", |b| {
        b.iter(|| assert_eq!(trilinear.iter().filter(|points| hexahedron(points, 1)).count(), SOLIDS));
    });
    group.throughput(Throughput::Elements(1));
    // Two control points were moved until coefficients are negative: the general way, with subdivision.
    let mut bent = cube(0, 1, 0.0);
    (bent[7], bent[0]) = (DVec3::splat(0.4), DVec3::splat(0.3));
    group.bench_function("bent trilinear hexahedron", |b| b.iter(|| hexahedron(&bent, 1)));
    let quadratic = cube(0, 2, 0.2);
    group.bench_function("triquadratic hexahedron", |b| b.iter(|| assert!(hexahedron(&quadratic, 2))));
    let ball = ball();
    group.bench_function("rational ball of degrees 2 × 2 × 3", |b| {
        let net = SolidNet::Hexahedron { points: &ball, degrees: [2, 2, 3] };
        b.iter(|| assert!(jacobian_verdict(&net, DEFAULT_OPERATIONS).unwrap().is_valid()));
    });
    group.finish();
}

criterion_group!(certificate, benches);
criterion_main!(certificate);
