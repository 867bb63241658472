//! What the machine can do, and rows of a bench that are held against it: shared by the benches `kernels` and `solids`.

use std::cell::Cell;
use std::hint::black_box;
use std::time::{Duration, Instant};

use casteljau_bernstein::glam::{DVec3, DVec4};
use criterion::{Criterion, Throughput};
use pulp::{Arch, Simd, WithSimd};

pub const POINTS: usize = 1_000_000;

/// What the machine does in this run.
#[derive(Clone, Copy)]
pub struct Machine {
    /// Nanoseconds a byte stored, for buffers of 24 MB and of more than 48 MB.
    store: [f64; 2],
    /// Nanoseconds a multiply-add.
    multiply_add: f64,
}

struct Fill<'a>(&'a mut [f64]);

impl WithSimd for Fill<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let value = simd.splat_f64s(black_box(0.5));
        S::as_mut_simd_f64s(self.0).0.fill(value);
    }
}

/// 1.2 million multiplications with addition, of whole registers, in twelve chains.
struct MultiplyAdd;

const STEPS: usize = 100_000;
const CHAINS: usize = 12;

impl WithSimd for MultiplyAdd {
    type Output = usize;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> usize {
        let mut sums = [simd.splat_f64s(1.0); CHAINS];
        let x = simd.splat_f64s(black_box(0.5));
        for _ in 0..STEPS {
            for sum in &mut sums {
                *sum = simd.mul_add_f64s(*sum, x, x);
            }
        }
        black_box(sums.map(|sum| simd.reduce_sum_f64s(sum)));
        STEPS * CHAINS * S::F64_LANES
    }
}

/// Least time of some runs, in nanoseconds.
fn least(runs: usize, mut work: impl FnMut()) -> f64 {
    let once = |_| {
        let start = Instant::now();
        work();
        start.elapsed().as_nanos() as f64
    };
    (0..runs).map(once).fold(f64::INFINITY, f64::min)
}

impl Machine {
    /// On one thread, which the bars are for, and the rows after this.
    pub fn measure() -> Self {
        // Fails where a pool exists already, which then does the work.
        if let Err(error) = rayon::ThreadPoolBuilder::new().num_threads(1).build_global() {
            eprintln!("more than one thread: {error}");
        }
        let arch = Arch::new();
        let store = [POINTS * 3, POINTS * 9].map(|numbers| {
            let mut buffer = vec![0.1; numbers];
            least(20, || arch.dispatch(Fill(black_box(&mut buffer)))) / (8 * numbers) as f64
        });
        let mut count = 0;
        let time = least(20, || count = arch.dispatch(MultiplyAdd));
        let machine = Self { store, multiply_add: time / count as f64 };
        println!(
            "this machine, one thread: stores {:.1} GB/s into 24 MB, {:.1} GB/s into 72 MB; {:.1} billion multiply-adds a second\n",
            1.0 / store[0],
            1.0 / store[1],
            1.0 / machine.multiply_add
        );
        machine
    }
}

/// One row of the table: what an item stores and computes, and the bar in nanoseconds at 24 GB/s.
pub struct Row {
    pub name: &'static str,
    pub items: usize,
    pub bytes: usize,
    pub multiply_adds: usize,
    pub reference: f64,
}

pub fn row(criterion: &mut Criterion, machine: Machine, row: &Row, mut work: impl FnMut()) {
    work(); // buffers are touched before
    let best = Cell::new(f64::INFINITY);
    let mut group = criterion.benchmark_group("kernels");
    group.throughput(Throughput::Elements(row.items as u64));
    group.bench_function(row.name, |b| {
        b.iter_custom(|count| {
            let mut total = Duration::ZERO;
            for _ in 0..count {
                let start = Instant::now();
                work();
                let time = start.elapsed();
                best.set(best.get().min(time.as_nanos() as f64));
                total += time;
            }
            total
        });
    });
    group.finish();
    if best.get().is_infinite() {
        return; // filtered out
    }
    let time = best.get() / row.items as f64;
    let per_byte = machine.store[usize::from(row.items * row.bytes > 48_000_000)];
    let (store, compute) = (row.bytes as f64 * per_byte, row.multiply_adds as f64 * machine.multiply_add);
    let (limit, of) = if store >= compute { (store, "stores") } else { (compute, "multiply-adds") };
    let bar = 1.15 * row.reference * (per_byte * 24.0).max(1.0);
    println!(
        "{:<44} {time:8.2} ns, limit {limit:7.2} ({of}), ratio {:5.2}; bar {bar:7.2}: {}\n",
        row.name,
        time / limit,
        if time <= bar { "met" } else { "missed" }
    );
}

/// Parameters without order: the fractions of multiples of the golden ratio.
pub fn scattered(count: usize, step: f64) -> Vec<f64> {
    (0..count).map(|i| (i as f64 * step).fract()).collect()
}

pub fn even(count: usize) -> Vec<f64> {
    (0..count).map(|i| i as f64 / (count - 1) as f64).collect()
}

pub fn points(count: usize) -> Vec<DVec3> {
    (0..count).map(|i| i as f64).map(|i| DVec3::new(i, (1.3 * i).sin(), (0.7 * i).cos())).collect()
}

pub fn weighted(count: usize) -> Vec<DVec4> {
    let weights = (0..count).map(|i| 1.0 + 0.5 * (i as f64).sin());
    points(count).into_iter().zip(weights).map(|(p, w)| (p * w).extend(w)).collect()
}

pub fn buffers<const K: usize>(count: usize) -> [Vec<DVec3>; K] {
    [(); K].map(|()| vec![DVec3::ONE; count])
}
