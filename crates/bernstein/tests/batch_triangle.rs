//! Batches over triangles against exact arithmetic and single evaluation, and their poles.
#![allow(clippy::unwrap_used, clippy::expect_used)] // helpers of tests

mod support;

use num_traits::{One, Signed};

use casteljau_bernstein::glam::{DVec2, DVec3, DVec4, Vec4Swizzles};
use casteljau_bernstein::{BernsteinError, TriangleBatch, TriangleNet, last_barycentric, simplex_count};
use support::U;
use support::exact::{Hunter, Q, absolutes, assert_within, dot, exact, exacts, factor, integer, rounds};
use support::simplices::{basis, differentiated, floor};

/// Orders (a, b) in the order of the buffers.
const ORDERS: [[usize; 2]; 6] = [[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2]];

fn jets(net: &[f64], degree: usize, at: &[DVec2]) -> Vec<[f64; 6]> {
    let mut out = [(); 6].map(|()| vec![f64::NAN; at.len()]);
    let triangle = TriangleBatch::new(net, degree).unwrap();
    triangle.evaluate(at, out.each_mut().map(|out| &mut out[..])).unwrap();
    (0..at.len()).map(|i| out.each_ref().map(|out| out[i])).collect()
}

/// Exact barycentric coordinates, and what of them the rounding errors act on: below u the last one is not better known.
fn coordinates(at: DVec2) -> [Vec<Q>; 2] {
    let (u, v) = (exact(at.x), exact(at.y));
    let last = Q::one() - &u - &v;
    let least = exact(3.0 * U) * (Q::one() + u.abs() + v.abs());
    let sizes = vec![u.abs(), v.abs(), last.abs().max(least)];
    [vec![u, v, last], sizes]
}

#[test]
fn against_exact_arithmetic() {
    let mut hunter = Hunter::new(31);
    for case in 0..rounds(1500) {
        // Above 40 there are no registers.
        let n = if case % 300 == 0 { 38 + case / 300 } else { hunter.below(8) };
        let net = hunter.numbers(simplex_count::<3>(n));
        let at: Vec<DVec2> =
            (0..1 + hunter.below(3)).map(|_| DVec2::new(hunter.parameter(), hunter.parameter())).collect();
        let q = exacts(&net);
        for (jet, &at) in jets(&net, n, &at).into_iter().zip(&at) {
            let [lambda, sizes] = coordinates(at);
            for ([a, b], got) in ORDERS.into_iter().zip(jet) {
                let what = format!("order {a},{b} of degree {n} at {at:?}");
                let Some(lower) = n.checked_sub(a + b) else {
                    assert_eq!(got, 0.0, "{what}");
                    continue;
                };
                let of = |points: &[Q], sign| differentiated(points, n, 3, &[a, b], sign);
                let scale =
                    dot(&basis(lower, &sizes), &of(&absolutes(&q), 1)) + floor(&q) * integer(n * n * n + 1);
                assert_within(
                    got,
                    &dot(&basis(lower, &lambda), &of(&q, -1)),
                    &scale,
                    factor(n, a + b),
                    &what,
                );
            }
        }
    }
}

#[test]
fn vertices_are_met_to_the_bit_and_single_evaluation_agrees() {
    for degree in [0, 1, 4, 20, 40, 60] {
        let net: Vec<f64> = (0..simplex_count::<3>(degree)).map(|i| (1.7 * i as f64).sin() + 2.0).collect();
        let [first, .., last] = net[..] else {
            assert_eq!(jets(&net, degree, &[DVec2::new(0.3, 0.2)])[0][0], net[0]);
            continue;
        };
        let second = net[simplex_count::<3>(degree) - degree - 1];
        let at = [DVec2::X, DVec2::Y, DVec2::ZERO, DVec2::new(0.2, 0.7)];
        let found = jets(&net, degree, &at);
        assert_eq!([found[0][0], found[1][0], found[2][0]], [first, second, last], "degree {degree}");
        let mut single = [0.0; 6];
        let lambda = [0.2, 0.7, last_barycentric(&[0.2, 0.7])];
        TriangleNet::new(&net, degree).unwrap().partials(lambda, &mut single);
        for k in 0..6 {
            // Of numbers up to 3 and their differences, at most 12 n².
            let scale = [3.0, 6.0, 6.0, 12.0, 12.0, 12.0][k]
                * (degree.pow(ORDERS[k][0] as u32 + ORDERS[k][1] as u32) as f64);
            let bound = 2.0 * (4 * (degree + 6)) as f64 * U * scale;
            assert!((found[3][k] - single[k]).abs() <= bound, "degree {degree}, kind {k}");
        }
    }
}

#[test]
fn rational_triangles_are_quotients() {
    let mut hunter = Hunter::new(32);
    for _ in 0..rounds(1000) {
        let n = 1 + hunter.below(6);
        let net: Vec<DVec4> = (0..simplex_count::<3>(n))
            .map(|_| DVec4::new(hunter.unit(), hunter.unit(), hunter.unit(), 0.5 + hunter.unit().abs()))
            .collect();
        let at: Vec<DVec2> =
            (0..9).map(|_| DVec2::new(hunter.unit().abs() / 2.0, hunter.unit().abs() / 2.0)).collect();
        let triangle = TriangleBatch::new(&net, n).unwrap();
        let mut homogeneous = [(); 6].map(|()| vec![DVec4::ZERO; at.len()]);
        triangle.evaluate(&at, homogeneous.each_mut().map(|out| &mut out[..])).unwrap();
        let mut points = [(); 6].map(|()| vec![DVec3::ZERO; at.len()]);
        triangle.evaluate_rational(&at, points.each_mut().map(|out| &mut out[..])).unwrap();
        for place in 0..at.len() {
            let h = homogeneous.each_ref().map(|out| out[place]);
            let s = points.each_ref().map(|out| out[place]);
            let w = h.map(|h| h.w);
            let products = [
                s[0] * w[0],
                s[0] * w[1] + s[1] * w[0],
                s[0] * w[2] + s[2] * w[0],
                s[0] * w[3] + 2.0 * s[1] * w[1] + s[3] * w[0],
                s[0] * w[4] + s[1] * w[2] + s[2] * w[1] + s[4] * w[0],
                s[0] * w[5] + 2.0 * s[2] * w[2] + s[5] * w[0],
            ];
            for k in 0..6 {
                let size = (0..6)
                    .map(|i| s[i].abs().max_element() * w.iter().fold(0.0, |m: f64, w| m.max(w.abs())))
                    .sum::<f64>();
                // A division, and at most five operations on terms of that size.
                assert!(
                    (products[k] - h[k].xyz()).abs().max_element() <= 16.0 * U * size,
                    "kind {k} of degree {n}"
                );
            }
        }
    }
}

#[test]
fn poles_are_errors_with_their_first_place_and_never_not_a_number() {
    // The weight is λ₁ − λ₂.
    let net =
        [DVec4::new(1.0, 2.0, 3.0, 1.0), DVec4::new(4.0, 5.0, 6.0, -1.0), DVec4::new(7.0, 8.0, 9.0, 0.0)];
    let at = [DVec2::new(0.5, 0.25), DVec2::new(0.25, 0.25), DVec2::new(0.125, 0.5), DVec2::new(0.3, 0.3)];
    let mut out = [(); 3].map(|()| vec![DVec3::NAN; 4]);
    let answer =
        TriangleBatch::new(&net, 1).unwrap().evaluate_rational(&at, out.each_mut().map(|out| &mut out[..]));
    assert_eq!(answer, Err(BernsteinError::Pole { index: 1 }));
    for out in &out {
        assert_eq!([out[1], out[3]], [DVec3::ZERO; 2]);
        assert!(out.iter().all(|p| p.is_finite()) && out[0] != DVec3::ZERO && out[2] != DVec3::ZERO);
    }
}

#[test]
fn nothing_depends_on_the_number_of_threads() {
    let net: Vec<DVec3> = (0..15).map(f64::from).map(|i| DVec3::new(i, i.sin(), i.cos())).collect();
    let at: Vec<DVec2> = (0..40_000).map(|i| 0.5 * DVec2::from_angle(f64::from(i)).abs()).collect();
    let triangle = TriangleBatch::new(&net, 4).unwrap();
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut out = [(); 3].map(|()| vec![DVec3::NAN; at.len()]);
        pool.install(|| triangle.evaluate(&at, out.each_mut().map(|out| &mut out[..]))).unwrap();
        out
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn wrong_input_is_refused() {
    assert!(matches!(
        TriangleBatch::new(&[0.0; 5], 2),
        Err(BernsteinError::SimplexNetLength { vertices: 3, degree: 2, needed: 6, given: 5 })
    ));
    let triangle = TriangleBatch::new(&[0.0; 3], 1).unwrap();
    let answer = triangle.evaluate(&[DVec2::ZERO; 4], [&mut [0.0; 3]]);
    assert_eq!(answer, Err(BernsteinError::BufferLength { buffer: "out", needed: 4, given: 3 }));
    assert_eq!(triangle.evaluate(&[], [&mut []]), Ok(()));
}
