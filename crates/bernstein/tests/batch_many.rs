//! Polynomials by the thousand against their kernels for one, and against exact arithmetic.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_bernstein::glam::DVec3;
use casteljau_bernstein::{BernsteinError, elevate, elevate_many, subdivide, subdivide_many, to_power_many};
use proptest::collection::vec;
use proptest::prelude::*;
use support::exact::{Q, choose, exact, rounds};
use support::{assert_accurate, hunting, parameter};

/// Column `at` of rows that are `row` numbers wide.
fn column(net: &[f64], row: usize, at: usize) -> Vec<f64> {
    net.iter().skip(at).step_by(row).copied().collect()
}

fn absolute(numbers: &[f64]) -> Vec<f64> {
    numbers.iter().map(|x| x.abs()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(rounds(1000) as u32))]

    #[test]
    fn split_as_one_by_one(degree in 0..8usize, row in 1..14usize, p in vec(hunting(), 8 * 14 * 3), t in parameter()) {
        let size = (degree + 1) * row;
        let nets = &p[..3 * size];
        let (mut left, mut right) = (vec![0.0; nets.len()], vec![0.0; nets.len()]);
        subdivide_many(nets, degree, row, t, &mut left, &mut right).unwrap();
        for (number, net) in nets.chunks(size).enumerate() {
            for at in 0..row {
                let curve = column(net, row, at);
                let (mut a, mut b) = (curve.clone(), curve.clone());
                subdivide(&curve, t, &mut a, &mut b).unwrap();
                let (mut scale_a, mut scale_b) = (a.clone(), b.clone());
                // With |t| and |1 − t| every term counts absolutely: t to 1 side, 1 − t to the other.
                let reach = (t.abs() + (1.0 - t).abs()).powi(degree as i32).max(1.0);
                subdivide(&absolute(&curve), t.clamp(0.0, 1.0), &mut scale_a, &mut scale_b).unwrap();
                let largest = curve.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
                let inside = (0.0..=1.0).contains(&t);
                for i in 0..=degree {
                    let at = number * size + i * row + at;
                    let scale = |own: f64| if inside { own } else { reach * largest };
                    // Both have an error.
                    assert_accurate(left[at], a[i], 2 * degree + 2, 0, scale(scale_a[i]), "left");
                    assert_accurate(right[at], b[i], 2 * degree + 2, 0, scale(scale_b[i]), "right");
                }
                prop_assert_eq!(left[number * size + at], curve[0]);
                prop_assert_eq!(right[number * size + degree * row + at], curve[degree]);
                prop_assert_eq!(left[number * size + degree * row + at], right[number * size + at]);
            }
        }
    }

    #[test]
    fn elevated_as_one_by_one(
        m in 0..5usize, n in 0..5usize, by in (0..4usize, 0..4usize), p in vec(hunting(), 25 * 3), count in 0..3usize,
    ) {
        let (p_, q) = (m + by.0, n + by.1);
        let nets = &p[..count * (m + 1) * (n + 1)];
        let larger = (p_ + 1) * (q + 1);
        let mut out = vec![f64::NAN; count * larger];
        elevate_many(nets, [m, n], [p_, q], &mut out).unwrap();
        for (net, out) in nets.chunks((m + 1) * (n + 1)).zip(out.chunks(larger)) {
            let both = |net: &[f64]| {
                let mut rows = vec![0.0; (m + 1) * (q + 1)];
                for (row, to) in net.chunks(n + 1).zip(rows.chunks_mut(q + 1)) {
                    elevate(row, to).unwrap();
                }
                let mut all = vec![0.0; larger];
                for at in 0..=q {
                    let mut raised = vec![0.0; p_ + 1];
                    elevate(&column(&rows, q + 1, at), &mut raised).unwrap();
                    for (k, x) in raised.into_iter().enumerate() {
                        all[k * (q + 1) + at] = x;
                    }
                }
                all
            };
            let (expected, scale) = (both(net), both(&absolute(net)));
            for i in 0..larger {
                assert_accurate(out[i], expected[i], 2 * (p_ + q) + 2, 0, scale[i], &format!("{m} {n} {by:?} {i}"));
            }
            prop_assert_eq!([out[0], out[q], out[larger - 1]], [net[0], net[n], net[net.len() - 1]]);
        }
    }

    #[test]
    fn power_basis_exactly(n in 0..26usize, p in vec(hunting(), 26 * 2)) {
        let curves = &p[..2 * (n + 1)];
        let mut out = vec![0.0; curves.len()];
        to_power_many(curves, n, &mut out).unwrap();
        for (curve, out) in curves.chunks(n + 1).zip(out.chunks(n + 1)) {
            for (k, &got) in out.iter().enumerate() {
                let term = |i: usize| choose(n, k) * choose(k, i) * exact(curve[i]);
                let truth: Q = (0..=k).map(|i| if (k - i) % 2 == 0 { term(i) } else { -term(i) }).sum();
                let scale: Q = (0..=k).map(|i| term(i).abs()).sum();
                assert_accurate(got, truth.to_f64(), n, 0, scale.to_f64(), &format!("{n} {k}"));
            }
        }
    }
}

#[test]
fn many_chunks_of_patches_in_space() {
    let net: Vec<DVec3> = (0..16).map(|i| DVec3::new(f64::from(i), 0.1, f64::from(i).sin())).collect();
    let nets: Vec<DVec3> = net.iter().cycle().take(16 * 2000).copied().collect();
    let (mut left, mut right) = (nets.clone(), nets.clone());
    subdivide_many(&nets, 3, 4, 0.3, &mut left, &mut right).unwrap();
    assert!(left.chunks(16).all(|net| net == &left[..16]) && right.chunks(16).all(|net| net == &right[..16]));
    let mut raised = vec![DVec3::NAN; 25 * 2000];
    elevate_many(&nets, [3, 3], [4, 4], &mut raised).unwrap();
    assert!(raised.chunks(25).all(|net| net == &raised[..25] && net.iter().all(|p| p.is_finite())));
    // In v the rows are curves.
    let (mut a, mut b) = (net.clone(), net.clone());
    subdivide_many(&net, 3, 1, 0.3, &mut a, &mut b).unwrap();
    assert_eq!((a[0], a[3], b[15]), (net[0], b[0], net[15]));
}

#[test]
fn wrong_buffers_are_refused() {
    let [mut a, mut b] = [[0.0; 4]; 2];
    let length = |buffer, needed, given| Err(BernsteinError::BufferLength { buffer, needed, given });
    assert_eq!(subdivide_many(&[0.0; 4], 1, 1, 0.5, &mut a[..3], &mut b), length("left", 4, 3));
    assert_eq!(subdivide_many(&[0.0; 4], 2, 1, 0.5, &mut a, &mut b), length("points", 6, 4));
    assert_eq!(subdivide_many(&[0.0; 4], 1, 0, 0.5, &mut a, &mut b), Err(BernsteinError::NoPoints));
    assert!(subdivide_many(&[0.0; 4], 501, 1, 0.5, &mut a, &mut b).is_err());
    assert_eq!(elevate_many(&[0.0; 4], [0, 3], [0, 2], &mut a), length("out", 4, 3));
    assert!(elevate_many(&[0.0; 3], [0, 3], [0, 4], &mut a).is_err());
    assert!(elevate_many(&[0.0; 4], [0, 3], [0, 501], &mut a).is_err());
    assert_eq!(to_power_many(&[0.0; 4], 3, &mut a[..3]), length("out", 4, 3));
    subdivide_many::<f64>(&[], 2, 1, 0.5, &mut [], &mut []).unwrap();
    elevate_many::<f64>(&[], [2, 2], [3, 3], &mut []).unwrap();
    to_power_many::<f64>(&[], 2, &mut []).unwrap();
}
