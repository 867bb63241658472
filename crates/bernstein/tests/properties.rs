//! Properties of the kernels, tried on numbers that hunt for trouble.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_bernstein::{
    BernsteinError, MAX_DEGREE, TensorNet, basis, basis_barycentric, de_casteljau, de_casteljau_scheme,
    derivatives, elevate, partial_count, partial_index, subdivide, value,
};
use proptest::collection::vec;
use proptest::prelude::*;
use support::{U, assert_accurate, hunting, parameter};

fn points() -> impl Strategy<Value = Vec<f64>> {
    prop_oneof![3 => vec(hunting(), 1..12), 1 => vec(hunting(), 1..=101)]
}

/// Σ |Bᵢⁿ(t)||Pᵢ|
fn scale(points: &[f64], t: f64) -> f64 {
    let mut b = vec![0.0; points.len()];
    basis(t, &mut b);
    b.iter().zip(points).map(|(b, p)| (b * p).abs()).sum()
}

proptest! {
    #[test]
    fn basis_adds_up_to_one(n in 0..=100usize, t in 0.0..=1.0) {
        let mut b = vec![0.0; n + 1];
        basis(t, &mut b);
        let sum: f64 = b.iter().sum();
        prop_assert!((sum - 1.0).abs() <= 3.0 * (n + 1) as f64 * U, "{sum:e}");
        prop_assert!(b.iter().all(|&b| b >= 0.0));
    }

    /// Swapping the two variables reverses the basis, to the bit where no power is lost.
    #[test]
    fn basis_is_symmetric(n in 0..=100usize, s in 0.01..2.0, t in 0.01..2.0) {
        let (mut b, mut c) = (vec![0.0; n + 1], vec![0.0; n + 1]);
        basis_barycentric(s, t, &mut b);
        basis_barycentric(t, s, &mut c);
        c.reverse();
        for (b, c) in b.into_iter().zip(c) {
            assert_accurate(b, c, 2 * n, 0, c, "reversed");
        }
    }

    #[test]
    fn evaluation_agrees_in_all_ways(p in points(), t in parameter()) {
        let n = p.len() - 1;
        let (scale, nested) = (scale(&p, t), value(&p, t));
        let mut b = vec![0.0; n + 1];
        basis(t, &mut b);
        let sum = b.iter().zip(&p).map(|(b, p)| b * p).sum::<f64>();
        let mut scratch = vec![0.0; n + 1];
        assert_accurate(nested, sum, 2 * n, 0, scale, "nested and basis");
        assert_accurate(nested, de_casteljau(&p, t, &mut scratch), 2 * n, 0, scale, "nested and de Casteljau");
        let mut scheme = vec![0.0; (n + 1) * (n + 2) / 2];
        de_casteljau_scheme(&p, t, &mut scheme).unwrap();
        prop_assert_eq!(scheme.last(), scratch.first());
        prop_assert_eq!(&scheme[..=n], &p[..]);
    }

    #[test]
    fn ends_are_exact(p in points()) {
        prop_assert_eq!(value(&p, 0.0), p[0]);
        prop_assert_eq!(value(&p, 1.0), p[p.len() - 1]);
        let (mut left, mut right) = (p.clone(), p.clone());
        subdivide(&p, 0.3, &mut left, &mut right).unwrap();
        prop_assert_eq!([left[0], right[p.len() - 1]], [p[0], p[p.len() - 1]]);
        prop_assert_eq!(left[p.len() - 1], right[0]);
    }

    #[test]
    fn derivatives_are_those_of_the_difference_polynomial(p in vec(-1.0..1.0f64, 2..30), t in parameter()) {
        let n = p.len() - 1;
        let q: Vec<f64> = p.windows(2).map(|w| (w[1] - w[0]) * n as f64).collect();
        let (mut of_p, mut of_q) = ([0.0; 5], [0.0; 4]);
        derivatives(&p, t, &mut of_p);
        derivatives(&q, t, &mut of_q);
        let mut b = vec![0.0; n + 1];
        basis(t, &mut b);
        let size = b.iter().map(|b| b.abs()).sum::<f64>().max(1.0);
        for k in 0..4 {
            let scale = size * (0..=k).map(|j| 2.0 * (n - j.min(n)) as f64).product::<f64>();
            assert_accurate(of_p[k + 1], of_q[k], 2 * n, k + 1, scale, "derivative");
        }
    }

    #[test]
    fn elevation_keeps_the_polynomial(p in vec(hunting(), 1..20), by in 0..20usize, t in 0.0..=1.0) {
        let mut q = vec![0.0; p.len() + by];
        elevate(&p, &mut q).unwrap();
        let largest = p.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        assert_accurate(value(&q, t), value(&p, t), 3 * q.len(), 0, largest, "elevated");
    }

    #[test]
    fn subdivision_keeps_the_polynomial(p in vec(hunting(), 1..20), t in 0.0..=1.0, s in 0.0..=1.0) {
        let (mut left, mut right) = (p.clone(), p.clone());
        subdivide(&p, t, &mut left, &mut right).unwrap();
        let largest = p.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        // A parameter is rounded on the way, u·|p′| ≤ 2n·u·largest: hence the larger constant.
        assert_accurate(value(&left, s), value(&p, s * t), 4 * p.len(), 0, largest, "left");
        assert_accurate(value(&right, s), value(&p, t + s * (1.0 - t)), 4 * p.len(), 0, largest, "right");
    }

    /// Both ways of making partial derivatives, that with rows kept and that with rows made again, against
    /// one-variable kernels.
    #[test]
    fn tensor_partials_are_derivatives_of_derivatives(
        m in prop_oneof![0..6usize, 22..26usize], n in 0..6usize, order in 0..=4usize, u in -0.5..1.5, v in -0.5..1.5, seed in any::<u64>(),
    ) {
        let net: Vec<f64> = (0..(m + 1) * (n + 1)).map(|i| ((i as f64 + 1.0) * (seed % 1000) as f64).sin()).collect();
        let mut partials = vec![0.0; partial_count(order)];
        TensorNet::new(&net, [m, n]).unwrap().partials(u, v, &mut partials);
        for b in 0..=order {
            let column: Vec<f64> = net.chunks(n + 1).map(|row| {
                let mut jet = [0.0; 5];
                derivatives(row, v, &mut jet);
                jet[b]
            }).collect();
            let mut jet = [0.0; 5];
            derivatives(&column, u, &mut jet);
            for a in 0..=order - b {
                prop_assert_eq!(partials[partial_index(a, b)], jet[a], "order {} {}", a, b);
            }
        }
    }
}

#[test]
fn nothing_panics_on_odd_buffers() {
    basis(0.5, &mut []);
    casteljau_bernstein::basis_derivatives(0.5, 7, &mut [1.0; 3]);
    casteljau_bernstein::basis_derivatives(0.5, usize::MAX, &mut [1.0; 3]);
    derivatives(&[1.0, 2.0], 0.5, &mut []);
    assert_eq!(value::<f64>(&[], 0.5), 0.0);
    assert_eq!(de_casteljau::<f64>(&[], 0.5, &mut []), 0.0);
    assert_eq!(de_casteljau(&[1.0, 3.0], 0.5, &mut []), 2.0);
    TensorNet::validated(&[1.0], [5, usize::MAX]).partials(0.5, 0.5, &mut [0.0; 7]);
    TensorNet::validated(&[1.0], [0, 0]).partials(0.5, 0.5, &mut []);
    assert_eq!(
        subdivide(&[1.0], 0.5, &mut [0.0], &mut []),
        Err(BernsteinError::BufferLength { buffer: "right", needed: 1, given: 0 })
    );
    assert_eq!(de_casteljau_scheme::<f64>(&[], 0.5, &mut []), Err(BernsteinError::NoPoints));
}

#[test]
fn the_largest_degree_is_served_and_the_next_is_refused() {
    let ones = vec![1e100; MAX_DEGREE + 1];
    for t in [0.0, 1e-300, 0.1, 0.5, 0.999, 1.0] {
        // The bound is 4(n+2)u.
        assert!((value(&ones, t) / 1e100 - 1.0).abs() < 4.0 * (MAX_DEGREE + 2) as f64 * U, "{t}");
    }
    assert!(value(&vec![1.0; MAX_DEGREE + 2], 0.5).is_nan());
    let mut b = vec![0.0; MAX_DEGREE + 2];
    basis(0.5, &mut b);
    assert!(b.iter().all(|b| b.is_nan()));
    assert!(TensorNet::new(&[0.0], [0, MAX_DEGREE + 1]).is_err());
}
