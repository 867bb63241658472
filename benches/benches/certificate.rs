//! The sign of det J over solids, and their volumes and moments, on one thread.
//!
//! | benchmark | limit | measured | why |
//! | --- | --- | --- | --- |
//! | `certificate/trilinear hexahedra` | 1 µs a solid | 0.12 µs | 16 cross and 48 dot products, no allocation |
//! | `certificate/bent trilinear hexahedron` | 50 µs | 5.9 µs | negative coefficients: bounds for each, then cuts |
//! | `certificate/rational trilinear hexahedron` | 50 µs | 5.9 µs | 48 coefficients, each with its bounds |
//! | `certificate/triquadratic hexahedron` | 200 µs | 19 µs | 216 coefficients |
//! | `certificate/rational ball of degrees 2 × 2 × 3` | 2 ms | 0.14 ms | 672 coefficients |
//! | `moments/triquadratic hexahedron` | 1 ms | 0.08 ms | 216 coefficients times 125 products of coordinates |
//! | `moments/rational ball of degrees 2 × 2 × 3` | 20 ms | 2.8 ms | Gauss's rule in cells of 4096 nodes |
//!
//! The trilinear hexahedra are unit cubes whose corners were moved by up to 0.2 in each direction, all valid.
//! Measured is the fastest of 100 samples on a core that others used too; the medians were 2.5 times that. With
//! `cargo bench -p casteljau-benches --bench certificate`.

#![allow(clippy::unwrap_used)]

use casteljau_solid::geom::glam::{DVec3, DVec4};
use casteljau_solid::{DEFAULT_OPERATIONS, SolidNet, jacobian_verdict, mass_properties};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

const SOLIDS: usize = 1000;

/// A valid hexahedron whose det J has negative Bernstein coefficients, so that it must be cut.
const BENT: [[f64; 3]; 8] = [
    [0.21875, 0.333984375, 0.482421875],
    [0.072265625, 0.248046875, 0.845703125],
    [0.580078125, 1.06640625, -0.466796875],
    [-0.099609375, 1.3388671875, 0.3291015625],
    [1.53515625, 0.564453125, -0.6005859375],
    [1.5986328125, -0.60546875, 0.982421875],
    [0.392578125, 1.33203125, 0.20703125],
    [0.53125, 0.59375, 1.3359375],
];

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
    let bent = BENT.map(DVec3::from_array);
    group.bench_function("bent trilinear hexahedron", |b| b.iter(|| assert!(hexahedron(&bent, 1))));
    let quadratic = cube(0, 2, 0.2);
    group.bench_function("triquadratic hexahedron", |b| b.iter(|| assert!(hexahedron(&quadratic, 2))));
    let ball = ball();
    group.bench_function("rational ball of degrees 2 × 2 × 3", |b| {
        let net = SolidNet::Hexahedron { points: &ball, degrees: [2, 2, 3] };
        b.iter(|| assert!(jacobian_verdict(&net, DEFAULT_OPERATIONS).unwrap().is_valid()));
    });
    let box_of_weights: Vec<DVec4> = cube(0, 1, 0.0)
        .iter()
        .enumerate()
        .map(|(p, q)| q.extend(1.0) * [0.5, 1.0, 2.0, 1.5, 1.0, 0.7, 1.0, 1.2][p])
        .collect();
    let rational = SolidNet::Hexahedron { points: &box_of_weights, degrees: [1; 3] };
    group.bench_function("rational trilinear hexahedron", |b| {
        b.iter(|| assert!(jacobian_verdict(&rational, DEFAULT_OPERATIONS).unwrap().is_valid()));
    });
    group.finish();

    let mut group = criterion.benchmark_group("moments");
    group.bench_function("triquadratic hexahedron", |b| {
        let net = SolidNet::Hexahedron { points: &quadratic, degrees: [2; 3] };
        b.iter(|| mass_properties(&net, 1e-12).unwrap().volume);
    });
    group.sample_size(20);
    group.bench_function("rational ball of degrees 2 × 2 × 3", |b| {
        let net = SolidNet::Hexahedron { points: &ball, degrees: [2, 2, 3] };
        b.iter(|| mass_properties(&net, 1e-12).unwrap().volume);
    });
    group.finish();
}

criterion_group!(certificate, benches);
criterion_main!(certificate);
