//! Composition against exact cases and exact arithmetic.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_bernstein::{
    BernsteinError, BernsteinSpace, SimplexSpace, compose, compose_homogeneous, compose_simplex,
    compose_wedge, last_coordinate, value,
};

use support::exact::{
    Hunter, Q, absolutes, assert_within, basis, choose, dot, exact, exacts, integer, product, rounds,
    tensor_sum, value as exact_value,
};
use support::simplices::{basis as simplex_basis, indices, multinomial, wedge_value};
use support::{assert_accurate, cases, component, count, flat, size};

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
    for round in 0..rounds(1000) {
        // To degree 100, one in a hundred.
        let (n, d) = match round {
            0 => (20, 5),
            _ if round % 100 == 0 => (8 + hunter.below(13), hunter.below(6)),
            _ => (hunter.below(7), hunter.below(4)),
        };
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
    for _ in 0..rounds(1000) {
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

/// Values of a composition, exactly that of the net which was made, against those of the shape at its arguments.
///
/// Errors of the net's points are at most `4(total·(d+2) + 2)·u` of their scales, and where arguments and
/// parameters are in [0, 1], these scales are the points of the composition of |P|.
fn check_values(got: &Q, truth: &Q, scale: &Q, total: usize, d: usize, what: &str) {
    let off = (got - truth).abs();
    let allowed = scale * exact(support::U) * integer(4 * (total * (d + 2) + 2));
    assert!(off <= allowed, "{what}: off {:e}, allowed {:e}", off.to_f64(), allowed.to_f64());
}

/// Exact value of a net over [0, 1]ᴰ.
fn tensor_value(points: &[Q], degrees: &[usize], at: &[Q]) -> Q {
    let weights: Vec<_> = degrees.iter().zip(at).map(|(&n, t)| basis(n, t)).collect();
    tensor_sum(points, &weights)
}

/// Patches with arguments on the square and the cube.
#[test]
fn arguments_in_more_variables() {
    let mut hunter = Hunter::new(33);
    for _ in 0..rounds(1000) {
        let degrees = [hunter.degree_of(3, 8, 100), hunter.below(4)];
        let total = degrees[0] + degrees[1];
        let outer = hunter.numbers(count(&degrees));
        let (q, sizes) = (exacts(&outer), absolutes(&exacts(&outer)));
        let at = [hunter.unit(), hunter.unit(), hunter.unit()].map(exact);

        let quad = [hunter.below(3), hunter.below(3)];
        let inner = [0; 2].map(|_: usize| (0..count(&quad)).map(|_| hunter.unit()).collect::<Vec<_>>());
        let mut out = vec![0.0; quad.power(total).size().unwrap()];
        compose(&outer, degrees, [&inner[0], &inner[1]], quad, &mut out).unwrap();
        let place = inner.each_ref().map(|t| tensor_value(&exacts(t), &quad, &at[..2]));
        let got = tensor_value(&exacts(&out), &quad.power(total), &at[..2]);
        let [truth, scale] = [&q, &sizes].map(|points| tensor_value(points, &degrees, &place));
        check_values(&got, &truth, &scale, total, quad[0] + quad[1], "patch on the square");

        let cube = [1, hunter.below(2), 1];
        let inner = [0; 2].map(|_: usize| (0..count(&cube)).map(|_| hunter.unit()).collect::<Vec<_>>());
        let mut out = vec![0.0; cube.power(total).size().unwrap()];
        compose(&outer, degrees, [&inner[0], &inner[1]], cube, &mut out).unwrap();
        let place = inner.each_ref().map(|t| tensor_value(&exacts(t), &cube, &at));
        let got = tensor_value(&exacts(&out), &cube.power(total), &at);
        let [truth, scale] = [&q, &sizes].map(|points| tensor_value(points, &degrees, &place));
        check_values(&got, &truth, &scale, total, cube.iter().sum(), "patch on the cube");
    }
}

#[test]
fn simplices_along_curves() {
    let mut hunter = Hunter::new(34);
    for _ in 0..rounds(1000) {
        for vertices in [2, 3, 4] {
            let (n, d) = (hunter.degree_of(4, 12, 100), hunter.below(3));
            let coordinates: Vec<Vec<f64>> =
                (0..vertices).map(|_| (0..=d).map(|_| hunter.unit() * 1.2 - 0.2).collect()).collect();
            let all = indices(vertices, n);
            let outer = hunter.numbers(all.len());
            let mut out = vec![0.0; n * d + 1];
            let lists: Vec<&[f64]> = coordinates.iter().map(Vec::as_slice).collect();
            compose_simplex(&outer, n, &lists, [d], &mut out).unwrap();
            // `Σ n!/β! λ^β P_β` for polynomials λ.
            let composed = |size: fn(&[Q]) -> Vec<Q>| -> Vec<Q> {
                let powers = |list: &Vec<f64>| -> Vec<Vec<Q>> {
                    let list = size(&exacts(list));
                    std::iter::successors(Some(vec![integer(1)]), |p| Some(product(p, &list)))
                        .take(n + 1)
                        .collect()
                };
                let powers: Vec<_> = coordinates.iter().map(powers).collect();
                let mut sum = vec![integer(0); n * d + 1];
                for (index, p) in all.iter().zip(size(&exacts(&outer))) {
                    let one = vec![multinomial(index) * p];
                    let one = index.iter().zip(&powers).fold(one, |one, (&b, p)| product(&one, &p[b]));
                    sum.iter_mut().zip(one).for_each(|(sum, x)| *sum += x);
                }
                sum
            };
            let (truth, scale) = (composed(<[Q]>::to_vec), composed(absolutes));
            for k in 0..out.len() {
                assert_within(out[k], &truth[k], &scale[k], 4 * (n * (d + 2) + 2), "simplex along a curve");
            }
        }
    }
    let mut out = [0.0];
    assert_eq!(compose_simplex(&[1.0], 0, &[], [0], &mut out), Err(BernsteinError::NoPoints));
    let refused = compose_simplex(&[1.0], usize::MAX, &[&[0.0]], [0], &mut out);
    assert_eq!(refused, Err(BernsteinError::Degree { degree: usize::MAX, limit: 500 }));
    let refused = compose_simplex(&[1.0; 3], 1, &[&[0.0], &[0.0]], [0], &mut out);
    assert_eq!(refused, Err(BernsteinError::BufferLength { buffer: "outer", needed: 2, given: 3 }));
}

/// Wedges along curves and over triangles.
#[test]
fn wedges() {
    let mut hunter = Hunter::new(35);
    for _ in 0..rounds(1000) {
        let [n, o] = [hunter.below(4), hunter.below(4)];
        let outer = hunter.numbers((n + 1) * (n + 2) / 2 * (o + 1));
        let (q, sizes) = (exacts(&outer), absolutes(&exacts(&outer)));
        let shape =
            |points: &[Q], at: &[Q]| wedge_value(points, [n, o], &at[..3], (&(integer(1) - &at[3]), &at[3]));
        // Coordinates that stay inside the wedge: the first two at most a half.
        let mut arguments = |size: usize| -> [Vec<f64>; 4] {
            let mut argument = |most: f64| (0..size).map(|_| hunter.unit() * most).collect::<Vec<_>>();
            let (first, second, height) = (argument(0.5), argument(0.5), argument(1.0));
            let mut third = vec![0.0; size];
            last_coordinate(&[&first, &second], &mut third).unwrap();
            [first, second, third, height]
        };
        let along = arguments(1 + n);
        let over = arguments(3);

        let [first, second, third, height] = &along;
        let mut out = vec![0.0; (n + o) * n + 1];
        compose_wedge(&outer, [n, o], [first, second, third], height, [n], &mut out).unwrap();
        let s = exact(hunter.unit());
        let place = along.each_ref().map(|a| exact_value(&exacts(a), &s));
        let [truth, scale] = [&q, &sizes].map(|points| shape(points, &place));
        check_values(&exact_value(&exacts(&out), &s), &truth, &scale, n + o, n, "wedge along a curve");

        let [first, second, third, height] = &over;
        let space = SimplexSpace::<3>(1);
        let mut out = vec![0.0; space.power(n + o).size().unwrap()];
        compose_wedge(&outer, [n, o], [first, second, third], height, space, &mut out).unwrap();
        let at = [hunter.unit() / 2.0, hunter.unit() / 2.0].map(exact);
        let at = [at[0].clone(), at[1].clone(), integer(1) - &at[0] - &at[1]];
        let over_triangle = |points: &[f64], degree| dot(&exacts(points), &simplex_basis(degree, &at));
        let place = over.each_ref().map(|a| over_triangle(a, 1));
        let [truth, scale] = [&q, &sizes].map(|points| shape(points, &place));
        check_values(&over_triangle(&out, n + o), &truth, &scale, n + o, 1, "wedge over a triangle");
    }
    let line: &[f64] = &[0.0, 1.0];
    let refused = compose_wedge(&[0.0; 5], [1, 1], [line; 3], line, [1], &mut [0.0; 3]);
    assert_eq!(refused, Err(BernsteinError::BufferLength { buffer: "outer", needed: 6, given: 5 }));
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
