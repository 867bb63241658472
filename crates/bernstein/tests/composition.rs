//! Composition against exact cases and exact arithmetic.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_bernstein::{
    BernsteinError, BernsteinSpace, BoxNet, TensorNet, compose, compose_homogeneous, compose_simplex,
    last_coordinate, value,
};

use support::exact::{Hunter, Q, absolutes, assert_within, choose, exact, exacts, integer};
use support::{assert_accurate, cases, component, flat, size};

/// A product in Bernstein form on the interval.
fn product(a: &[Q], b: &[Q]) -> Vec<Q> {
    support::exact::product(a, b)
}

/// `C(n,i) sⁿ⁻ⁱ tⁱ` for polynomials s and t.
fn term(n: usize, i: usize, s: &[Q], t: &[Q]) -> Vec<Q> {
    (0..n).fold(vec![choose(n, i)], |p, k| product(&p, if k < i { t } else { s }))
}

/// The composed shape with everything given, by the definition; also its scale, from absolute values.
fn composed(outer: &[Q], degrees: &[usize], arguments: &[(Vec<Q>, Vec<Q>)]) -> Vec<Q> {
    let Some((&n, rest)) = degrees.split_first() else { return vec![outer[0].clone()] };
    let mut sum: Vec<Q> = vec![];
    for (i, slab) in outer.chunks(outer.len() / (n + 1)).enumerate() {
        let (s, t) = &arguments[0];
        let one = product(&term(n, i, s, t), &composed(slab, rest, &arguments[1..]));
        sum = if sum.is_empty() { one } else { sum.iter().zip(one).map(|(a, b)| a + b).collect() };
    }
    sum
}

fn pair(t: &[f64]) -> (Vec<Q>, Vec<Q>) {
    let t = exacts(t);
    (t.iter().map(|t| integer(1) - t).collect(), t)
}

fn absolute((s, t): &(Vec<Q>, Vec<Q>)) -> (Vec<Q>, Vec<Q>) {
    (absolutes(s), absolutes(t))
}

#[test]
fn golden_compositions() {
    for case in cases("composition.json") {
        let d = size(&case["inner_degree"]);
        let result = size(&case["result_degree"]);
        let arguments = [0, 1, 2].map(|axis| component(&case["inner"], axis));
        let outer = flat(&case["outer"], if case["outer_degree"].is_array() { 4 } else { 2 });
        for axis in 0..3 {
            let points: Vec<f64> = outer.iter().skip(axis).step_by(3).copied().collect();
            let mut out = vec![0.0; result + 1];
            if case["outer_degree"].is_array() {
                let degrees = [0, 1, 2].map(|i| size(&case["outer_degree"][i]));
                let inner = [&arguments[0][..], &arguments[1], &arguments[2]];
                compose(&points, degrees, inner, [d], &mut out).unwrap();
            } else {
                let n = size(&case["outer_degree"]);
                let mut last = vec![0.0; d + 1];
                last_coordinate(&[&arguments[0], &arguments[1], &arguments[2]], &mut last).unwrap();
                let inner = [&arguments[0][..], &arguments[1], &arguments[2], &last];
                compose_simplex(&points, n, &inner, [d], &mut out).unwrap();
            }
            // Arguments lie in [0, 1]: the scale is at most the largest point.
            let scale = points.iter().fold(0.0, |m: f64, p| m.max(p.abs()));
            for (k, expected) in component(&case["expected"], axis).into_iter().enumerate() {
                assert_accurate(out[k], expected, result, 0, scale, &format!("{} {k}", case["kind"]));
            }
        }
    }
}

#[test]
fn curves_with_polynomial_arguments() {
    let mut hunter = Hunter::new(31);
    for round in 0..200 {
        let (n, d) = if round == 0 { (12, 3) } else { (hunter.below(7), hunter.below(4)) };
        let outer = hunter.numbers(n + 1);
        let wide = hunter.below(3) == 0;
        let t: Vec<f64> =
            (0..=d).map(|_| if wide { hunter.unit() * 3.0 - 1.0 } else { hunter.unit() }).collect();
        let mut out = vec![0.0; n * d + 1];
        compose(&outer, [n], [&t], [d], &mut out).unwrap();
        let arguments = [pair(&t)];
        let truth = composed(&exacts(&outer), &[n], &arguments);
        let scale = composed(&absolutes(&exacts(&outer)), &[n], &arguments.map(|a| absolute(&a)));
        for k in 0..out.len() {
            assert_within(out[k], &truth[k], &scale[k], 4 * (n * (d + 2) + 2), &format!("{n} of {d}"));
        }
    }
}

#[test]
fn solids_along_curves() {
    let mut hunter = Hunter::new(32);
    for _ in 0..40 {
        let degrees = [0; 3].map(|_: usize| hunter.below(3));
        let d = hunter.below(4);
        let outer = hunter.numbers(degrees.iter().map(|d| d + 1).product());
        let inner = [0; 3].map(|_: usize| (0..=d).map(|_| hunter.unit() * 1.5 - 0.25).collect::<Vec<_>>());
        let total: usize = degrees.iter().sum();
        let mut out = vec![0.0; total * d + 1];
        compose(&outer, degrees, [&inner[0], &inner[1], &inner[2]], [d], &mut out).unwrap();
        let arguments = inner.map(|t| pair(&t));
        let truth = composed(&exacts(&outer), &degrees, &arguments);
        let scale = composed(&absolutes(&exacts(&outer)), &degrees, &arguments.map(|a| absolute(&a)));
        for k in 0..out.len() {
            assert_within(out[k], &truth[k], &scale[k], 4 * (total * (d + 2) + 2), "solid along a curve");
        }
    }
}

/// Degree 200, where the composed basis must still add up to 1, and a curve keeps its box.
#[test]
fn degree_two_hundred() {
    let t: Vec<f64> = (0..=20).map(|i| 0.5 + 0.5 * (f64::from(i) * 2.3).sin()).collect();
    let mut out = vec![0.0; 201];
    compose(&[1.0; 11], [10], [&t], [20], &mut out).unwrap();
    assert!(out.iter().all(|x| (x - 1.0).abs() <= 4.0 * (10.0 * 22.0 + 2.0) * support::U));
    let outer: Vec<f64> = (0..=200).map(|i| if i % 2 == 0 { 1e100 } else { -1e100 }).collect();
    compose(&outer, [200], [&[0.25, 0.75]], [1], &mut out).unwrap();
    for (k, &p) in out.iter().enumerate() {
        assert!(p.abs() <= 1e100, "{k}: {p}");
    }
    let mut half = vec![0.0; 201];
    casteljau_bernstein::restrict(&outer, [0.25, 0.75], &mut half).unwrap();
    for (a, b) in out.iter().zip(half) {
        assert_accurate(*a, b, 4 * 200, 0, 1e100, "composition with a line is restriction");
    }
    let refused = compose(&[0.0; 252], [251], [&[0.0; 3]], [2], &mut [0.0; 503]);
    assert!(matches!(refused, Err(BernsteinError::Degree { degree: 502, .. })));
}

/// Patches and solids on the square and the cube, by values at parameters.
#[test]
fn arguments_in_more_variables() {
    let mut hunter = Hunter::new(33);
    for _ in 0..60 {
        let degrees = [hunter.below(4), hunter.below(4)];
        let total = degrees[0] + degrees[1];
        let outer: Vec<f64> =
            (0..(degrees[0] + 1) * (degrees[1] + 1)).map(|_| hunter.unit() * 2.0 - 1.0).collect();
        let net = TensorNet::new(&outer, degrees).unwrap();
        let at = [hunter.unit(), hunter.unit(), hunter.unit()];

        let quad = [hunter.below(3), hunter.below(3)];
        let inner = [0; 2]
            .map(|_: usize| (0..(quad[0] + 1) * (quad[1] + 1)).map(|_| hunter.unit()).collect::<Vec<_>>());
        let mut out = vec![0.0; quad.power(total).size().unwrap()];
        compose(&outer, degrees, [&inner[0], &inner[1]], quad, &mut out).unwrap();
        let [x, y] = [0, 1].map(|i| TensorNet::new(&inner[i], quad).unwrap().value(at[0], at[1]));
        let got = TensorNet::new(&out, quad.power(total)).unwrap().value(at[0], at[1]);
        // Arguments are rounded, which moves the value by at most u·|p′| ≤ 2·degree·u each.
        assert_accurate(got, net.value(x, y), 8 * (total + 1) * 4, 0, 1.0, "patch on the square");

        let cube = [1, hunter.below(2), 1];
        let inner =
            [0; 2].map(|_: usize| (0..cube.size().unwrap()).map(|_| hunter.unit()).collect::<Vec<_>>());
        let mut out = vec![0.0; cube.power(total).size().unwrap()];
        compose(&outer, degrees, [&inner[0], &inner[1]], cube, &mut out).unwrap();
        let [x, y] = [0, 1].map(|i| BoxNet::new(&inner[i], cube).unwrap().value(at[0], at[1], at[2]));
        let got = BoxNet::new(&out, cube.power(total)).unwrap().value(at[0], at[1], at[2]);
        assert_accurate(got, net.value(x, y), 8 * (total + 1) * 4, 0, 1.0, "patch on the cube");
    }
}

#[test]
fn simplices_along_curves() {
    let mut hunter = Hunter::new(34);
    for _ in 0..60 {
        let (n, d) = (hunter.below(5), hunter.below(3));
        for vertices in [2, 3, 4] {
            let coordinates: Vec<Vec<f64>> =
                (0..vertices).map(|_| (0..=d).map(|_| hunter.unit() * 1.2 - 0.2).collect()).collect();
            // Multi-indices in descending lexicographic order.
            let mut indices = vec![vec![]];
            for place in 0..vertices {
                indices = indices
                    .into_iter()
                    .flat_map(|head: Vec<usize>| {
                        let left = n - head.iter().sum::<usize>();
                        let choices = if place + 1 == vertices { left..=left } else { 0..=left };
                        choices.rev().map(move |i| [head.clone(), vec![i]].concat()).collect::<Vec<_>>()
                    })
                    .collect();
            }
            let outer = hunter.numbers(indices.len());
            let mut out = vec![0.0; n * d + 1];
            let lists: Vec<&[f64]> = coordinates.iter().map(Vec::as_slice).collect();
            compose_simplex(&outer, n, &lists, [d], &mut out).unwrap();
            let (mut truth, mut scale) = (vec![integer(0); out.len()], vec![integer(0); out.len()]);
            for (index, p) in indices.iter().zip(&outer) {
                let (mut one, mut left) = (vec![exact(*p)], n);
                for (coordinate, &i) in coordinates.iter().zip(index) {
                    one = one.iter().map(|x| x * choose(left, i)).collect();
                    one = (0..i).fold(one, |one, _| product(&one, &exacts(coordinate)));
                    left -= i;
                }
                let mut positive = vec![exact(p.abs())];
                left = n;
                for (coordinate, &i) in coordinates.iter().zip(index) {
                    positive = positive.iter().map(|x| x * choose(left, i)).collect();
                    positive = (0..i).fold(positive, |one, _| product(&one, &absolutes(&exacts(coordinate))));
                    left -= i;
                }
                for k in 0..out.len() {
                    truth[k] += &one[k];
                    scale[k] += &positive[k];
                }
            }
            for k in 0..out.len() {
                assert_within(out[k], &truth[k], &scale[k], 4 * (n * (d + 2) + 2), "simplex along a curve");
            }
        }
    }
    let mut out = [0.0];
    assert_eq!(compose_simplex(&[1.0], 0, &[], [0], &mut out), Err(BernsteinError::NoPoints));
    let refused = compose_simplex(&[1.0; 3], 1, &[&[0.0], &[0.0]], [0], &mut out);
    assert_eq!(refused, Err(BernsteinError::BufferLength { buffer: "outer", needed: 2, given: 3 }));
}

/// A rational argument: a parabola run through by t = x/w.
#[test]
fn rational_arguments() {
    let (x, w) = ([0.0, 0.3, 2.0], [1.0, 0.7, 2.5]);
    let rest: Vec<f64> = w.iter().zip(x).map(|(w, x)| w - x).collect();
    let curve = [1.0, -2.0, 0.5, 4.0];
    let (mut numerator, mut denominator) = ([0.0; 7], [0.0; 7]);
    compose_homogeneous(&curve, [3], [[&rest, &x]], [2], &mut numerator).unwrap();
    compose_homogeneous(&[1.0; 4], [3], [[&rest, &x]], [2], &mut denominator).unwrap();
    for s in [0.0, 0.2, 0.5, 0.9, 1.0] {
        let t = value(&x, s) / value(&w, s);
        let got = value(&numerator, s) / value(&denominator, s);
        assert!((got - value(&curve, t)).abs() < 1e-14, "{s}");
    }
    let refused = compose_homogeneous(&curve, [3], [[&rest, &x[..2]]], [2], &mut numerator);
    assert_eq!(refused, Err(BernsteinError::BufferLength { buffer: "arguments", needed: 3, given: 2 }));
    assert!(compose(&curve, [3], [&x], [2], &mut [0.0; 6]).is_err());
}
