//! Single points, batches and products over triangles and tetrahedra, on one thread.
//!
//! Run with `cargo bench -p casteljau-benches --bench simplices`. Medians on one core of an AMD EPYC (Zen 4). The limit is
//! what the multiply-adds take: for batches at the 29.5 billion a second of full registers that the bench `kernels`
//! measures, for the rest, which has no registers to fill, at an eighth of them.
//!
//! | bench | multiply-adds | limit | measured | why |
//! | --- | --- | --- | --- | --- |
//! | a point of a cubic triangle in space | 90 | 24 ns | 72 ns | a chain of additions |
//! | with first derivatives | 200 | 54 ns | 0.33 µs | differences are made at the place |
//! | with second, third derivatives | 290, 330 | 80, 90 ns | 0.57, 0.84 µs | difference nets on the stack, for each |
//! | a point of a cubic tetrahedron | 180 | 49 ns | 0.18 µs | as above |
//! | with first, second derivatives | 450, 700 | 0.12, 0.19 µs | 1.1, 2.7 µs | as above |
//! | batch of a cubic triangle, a point | 55 | 1.9 ns | 4.5 ns | loops over the rows of the net |
//! | with first derivatives | 121 | 4.1 ns | 8.2 ns | the same |
//! | batch of degree 5, of degree 20 | 117, 1047 | 4.0, 35 ns | 6.9, 48 ns | the same |
//! | with first derivatives | 267, 2847 | 9.1, 97 ns | 14, 125 ns | the same |
//! | product of two triangles of degree 10 | 4356 | 1.2 µs | 8.0 µs | binomial weights row by row |
//! | of degree 100 | 26.5 million | 7.2 ms | 11.8 ms | the same |
//! | product of two tetrahedra of degree 10 | 81,796 | 22 µs | 0.24 ms | lines of eleven points and fewer |

#![allow(clippy::unwrap_used)]

use std::hint::black_box;

use casteljau_bernstein::glam::{DVec2, DVec3};
use casteljau_bernstein::{SimplexNet, TriangleBatch, simplex_count};
use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};

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

fn batches(criterion: &mut Criterion) {
    let count = 100_000;
    let at: Vec<DVec2> = (0..count)
        .map(f64::from)
        .map(|i| DVec2::new((i * 0.754_877_666_25).fract(), (i * 0.569_840_291).fract()) * 0.5)
        .collect();
    let [mut a, mut b, mut c] = [(); 3].map(|()| vec![DVec3::ONE; at.len()]);
    let mut group = criterion.benchmark_group("batches over triangles");
    group.throughput(Throughput::Elements(at.len() as u64));
    for degree in [3, 5, 20] {
        let triangle = TriangleBatch::new(&points(simplex_count::<3>(degree)), degree).unwrap();
        group.bench_function(format!("degree {degree}, values"), |bencher| {
            bencher.iter(|| triangle.evaluate(black_box(&at), [black_box(&mut a)]));
        });
        group.bench_function(format!("degree {degree}, first derivatives"), |bencher| {
            bencher.iter(|| triangle.evaluate(black_box(&at), [&mut a, &mut b, black_box(&mut c)]));
        });
    }
}

fn run(criterion: &mut Criterion) {
    // Fails where a pool exists already, which then does the work.
    if let Err(error) = rayon::ThreadPoolBuilder::new().num_threads(1).build_global() {
        eprintln!("more than one thread: {error}");
    }
    partials(criterion, "triangles", &[3, 5, 20], [0.5, 0.2, 0.3]);
    partials(criterion, "tetrahedra", &[3, 5], [0.4, 0.1, 0.2, 0.3]);
    batches(criterion);
    products::<3>(criterion, "triangles", &[3, 10, 100]);
    products::<4>(criterion, "tetrahedra", &[3, 10]);
}

criterion_group!(benches, run);
criterion_main!(benches);
