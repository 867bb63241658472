//! Single points and products over triangles and tetrahedra, on one thread.
//!
//! Run with `cargo bench -p casteljau-benches --bench simplices`.

#![allow(clippy::unwrap_used)]

use std::hint::black_box;

use casteljau_bernstein::glam::DVec3;
use casteljau_bernstein::{SimplexNet, simplex_count};
use criterion::{BatchSize, Criterion, criterion_group, criterion_main};

fn points(count: usize) -> Vec<DVec3> {
    (0..count).map(|i| DVec3::new(i as f64, (i * i % 7) as f64, (i % 5) as f64)).collect()
}

fn numbers(count: usize) -> Vec<f64> {
    (0..count).map(|i| (i * i % 17) as f64 - 8.0).collect()
}

fn partials<const V: usize>(criterion: &mut Criterion, name: &str, degrees: &[usize], lambda: [f64; V]) {
    let mut group = criterion.benchmark_group(format!("partials over {name}"));
    for &degree in degrees {
        let points = points(simplex_count::<V>(degree));
        let net = SimplexNet::<_, V>::new(&points, degree).unwrap();
        for order in 0..4 {
            let mut out = vec![DVec3::ZERO; simplex_count::<V>(order)];
            group.bench_function(format!("degree {degree}, order {order}"), |bencher| {
                bencher.iter(|| {
                    net.partials(black_box(lambda), &mut out);
                    out[0]
                });
            });
        }
    }
}

fn products<const V: usize>(criterion: &mut Criterion, name: &str, degrees: &[usize]) {
    let mut group = criterion.benchmark_group(format!("products over {name}"));
    group.sample_size(10);
    for &degree in degrees {
        let points = numbers(simplex_count::<V>(degree));
        let net = SimplexNet::<_, V>::new(&points, degree).unwrap();
        let out = vec![0.0; simplex_count::<V>(2 * degree)];
        group.bench_function(format!("degree {degree}"), |bencher| {
            bencher.iter_batched_ref(
                || out.clone(),
                |out| net.product(&net, out).unwrap(),
                BatchSize::LargeInput,
            );
        });
    }
}

fn run(criterion: &mut Criterion) {
    partials(criterion, "triangles", &[3, 5, 20], [0.5, 0.2, 0.3]);
    partials(criterion, "tetrahedra", &[3, 5], [0.4, 0.1, 0.2, 0.3]);
    products::<3>(criterion, "triangles", &[3, 10, 100]);
    products::<4>(criterion, "tetrahedra", &[3, 10]);
}

criterion_group!(benches, run);
criterion_main!(benches);
