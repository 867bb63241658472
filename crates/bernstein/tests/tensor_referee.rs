//! Sums, integrals, moments and reductions of nets against exact arithmetic.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_bernstein::{integral_over_tensor, moment_tensor, reduce, reduce_along, sum_tensor};
use support::count;
use support::exact::{
    Hunter, Q, absolute_pair, absolutes, along, assert_within, blossom_of, choose, exact, exacts, factor,
    integer, pair, product, rounds, tensor_sum,
};

/// Small degrees, one in thirty of them larger.
fn degrees<const D: usize>(hunter: &mut Hunter) -> [usize; D] {
    [0; D].map(|_: usize| hunter.degree_of(3, 9, 30))
}

/// A net raised to other degrees, exactly.
fn elevated<const D: usize>(points: &[Q], mut degrees: [usize; D], to: [usize; D]) -> Vec<Q> {
    let mut net = points.to_vec();
    for axis in 0..D {
        let ones = vec![integer(1); to[axis] - degrees[axis] + 1];
        net = along(&net, &degrees, axis, |line| product(&ones, line));
        degrees[axis] = to[axis];
    }
    net
}

fn sums<const D: usize>(seed: u64) {
    let mut hunter = Hunter::new(seed);
    for _ in 0..rounds(1000) {
        let (m, n): ([usize; D], [usize; D]) = (degrees(&mut hunter), degrees(&mut hunter));
        let to = std::array::from_fn(|axis| m[axis].max(n[axis]));
        let (a, b) = (hunter.numbers(count(&m)), hunter.numbers(count(&n)));
        let (mut out, mut work) = (vec![f64::NAN; count(&to)], vec![f64::NAN; count(&to)]);
        sum_tensor(&a, m, &b, n, &mut out, &mut work).unwrap();
        let (a, b) = (exacts(&a), exacts(&b));
        let truth = (elevated(&a, m, to), elevated(&b, n, to));
        let scale = (elevated(&absolutes(&a), m, to), elevated(&absolutes(&b), n, to));
        for (i, &got) in out.iter().enumerate() {
            let (truth, scale) = (&truth.0[i] + &truth.1[i], &scale.0[i] + &scale.1[i]);
            assert_within(got, &truth, &scale, factor(to.iter().sum(), 0), &format!("{m:?} + {n:?}"));
        }
    }
}

#[test]
fn sums_of_nets() {
    sums::<2>(61);
    sums::<3>(62);
}

/// Mean of the points over a product of intervals, by the blossom: point k of a line takes the end k times.
fn mean<const D: usize>(
    points: &[Q],
    degrees: [usize; D],
    intervals: [[f64; 2]; D],
    of: impl Fn(&Q) -> (Q, Q),
) -> Q {
    let mut net = points.to_vec();
    for (axis, interval) in intervals.iter().enumerate() {
        let [a, b] = interval.map(|t| of(&exact(t)));
        net = along(&net, &degrees, axis, |line| {
            let n = line.len() - 1;
            let pairs = |k: usize| [vec![a.clone(); n - k], vec![b.clone(); k]].concat();
            (0..=n).map(|k| blossom_of(line, &pairs(k))).collect()
        });
    }
    net.iter().sum::<Q>() / integer(net.len())
}

fn integrals<const D: usize>(seed: u64) {
    let mut hunter = Hunter::new(seed);
    for _ in 0..rounds(1000) {
        let n: [usize; D] = [0; D].map(|_: usize| hunter.degree_of(3, 6, 30));
        let points = hunter.numbers(count(&n));
        let intervals = [[0.0; 2]; D].map(|_| [hunter.parameter(), hunter.parameter()]);
        let got = integral_over_tensor(&points, n, intervals, &mut vec![f64::NAN; points.len()]).unwrap();
        let volume = intervals.iter().fold(integer(1), |v, [a, b]| v * (exact(*b) - exact(*a)));
        let q = exacts(&points);
        let truth = mean(&q, n, intervals, pair) * &volume;
        let scale = mean(&absolutes(&q), n, intervals, absolute_pair) * volume.abs();
        let total: usize = n.iter().sum();
        assert_within(got, &truth, &scale, 4 * (total + 4 * D), &format!("{n:?} over {intervals:?}"));
    }
}

#[test]
fn integrals_of_nets() {
    integrals::<2>(63);
    integrals::<3>(64);
}

fn moments<const D: usize>(seed: u64) {
    let mut hunter = Hunter::new(seed);
    for _ in 0..rounds(1000) {
        let n: [usize; D] = degrees(&mut hunter);
        let orders = [0; D].map(|_: usize| hunter.below(6));
        let points = hunter.numbers(count(&n));
        let got = moment_tensor(&points, n, orders).unwrap();
        let weights: [Vec<Q>; D] = std::array::from_fn(|axis| {
            let (n, k) = (n[axis], orders[axis]);
            (0..=n).map(|i| choose(n, i) / choose(n + k, i + k) / integer(n + k + 1)).collect()
        });
        let q = exacts(&points);
        let (truth, scale) = (tensor_sum(&q, &weights), tensor_sum(&absolutes(&q), &weights));
        let total: usize = n.iter().chain(&orders).sum();
        assert_within(got, &truth, &scale, 4 * (total + 2 * D), &format!("{orders:?} of {n:?}"));
    }
}

#[test]
fn moments_of_nets() {
    moments::<2>(65);
    moments::<3>(66);
}

/// Each line is reduced as a curve of its own, and the loss of the worst is within the answer, exactly.
#[test]
fn reductions_of_nets() {
    let mut hunter = Hunter::new(67);
    for _ in 0..rounds(1000) {
        let n = [0; 3].map(|_: usize| hunter.below(5));
        let axis = hunter.below(3);
        let mut to = n;
        to[axis] = hunter.below(n[axis] + 1);
        let points: Vec<f64> = (0..count(&n)).map(|_| hunter.unit() * 2.0 - 1.0).collect();
        let mut out = vec![f64::NAN; count(&to)];
        let mut work = vec![f64::NAN; n[axis] + 1];
        let deviation = reduce_along(&points, n, axis, to[axis], &mut out, &mut work).unwrap();
        let lines = along(&points, &n, axis, |line| {
            let mut low = vec![f64::NAN; to[axis] + 1];
            let own = reduce(line, &mut low, &mut vec![f64::NAN; line.len()]).unwrap();
            assert!(own <= deviation, "{n:?} to {to:?}");
            low
        });
        assert_eq!(out, lines, "{n:?} to {to:?}");
        let lifted = elevated(&exacts(&out), to, n);
        for (p, q) in exacts(&points).iter().zip(&lifted) {
            assert!((p - q).abs() <= exact(deviation), "{n:?} to {to:?}");
        }
    }
}
