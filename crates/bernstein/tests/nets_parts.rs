//! Elevation, restriction and subdivision of tensor nets against exact cases and exact arithmetic.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_bernstein::{
    BernsteinError, elevate_along, elevate_tensor, restrict, restrict_along, restrict_tensor,
    subdivide_along, value,
};
use support::exact::{
    Hunter, Q, absolute_pair, absolutes, along, assert_within, blossom_of, choose, exact, exacts, factor,
    pair, rounds,
};
use support::{assert_accurate, cases, count, flat, number, numbers, size};

/// Degree elevation written out: `Qⱼ = Σ C(n,i) C(r,j−i)/C(n+r,j) Pᵢ`.
fn elevated_line(line: &[Q], to: usize) -> Vec<Q> {
    let (n, r) = (line.len() - 1, to + 1 - line.len());
    let weight = |i: usize, j: usize| choose(n, i) * choose(r, j - i) / choose(to, j);
    (0..=to).map(|j| (0..=n.min(j)).map(|i| weight(i, j) * &line[i]).sum()).collect()
}

#[test]
fn elevation_of_nets() {
    let mut hunter = Hunter::new(8);
    for round in 0..rounds(1000) {
        let (degrees, to) = match round {
            0 | 1 => ([50 * round, 1, 0], [100, 2, 1]),
            2 => ([18, 17, 2], [20, 20, 2]),
            _ => {
                let degrees = hunter.box_degrees();
                (degrees, degrees.map(|d| d + hunter.below(3)))
            }
        };
        let points = hunter.numbers(count(&degrees));
        let mut out = vec![0.0; count(&to)];
        elevate_tensor(&points, degrees, to, &mut out).unwrap();
        let (mut truth, mut done) = (exacts(&points), degrees);
        let mut scale = absolutes(&truth);
        for axis in 0..3 {
            truth = along(&truth, &done, axis, |line| elevated_line(line, to[axis]));
            scale = along(&scale, &done, axis, |line| elevated_line(line, to[axis]));
            done[axis] = to[axis];
        }
        for ((got, truth), scale) in out.iter().zip(&truth).zip(&scale) {
            assert_within(*got, truth, scale, factor(to.iter().sum(), 0), "elevated");
        }
    }
}

/// Restriction written out, at some places: the blossoms with n − i times a and i times b.
fn restricted_line(line: &[Q], [a, b]: [f64; 2], places: &[usize], absolute: bool) -> Vec<Q> {
    let n = line.len() - 1;
    let [a, b] = [a, b].map(|t| if absolute { absolute_pair(&exact(t)) } else { pair(&exact(t)) });
    let arguments =
        |i: usize| (0..n).map(|k| if k < n - i { a.clone() } else { b.clone() }).collect::<Vec<_>>();
    places.iter().map(|&i| blossom_of(line, &arguments(i))).collect()
}

fn whole_restricted_line(line: &[Q], interval: [f64; 2], absolute: bool) -> Vec<Q> {
    restricted_line(line, interval, &(0..line.len()).collect::<Vec<_>>(), absolute)
}

/// Degrees to 100; of the long lines a few points are compared.
#[test]
fn restriction_to_intervals() {
    let mut hunter = Hunter::new(9);
    for round in 0..rounds(1000) {
        let n = if round == 0 { 100 } else { hunter.degree(100) };
        let points = hunter.numbers(n + 1);
        let interval = [hunter.parameter(), hunter.parameter()];
        let mut out = vec![0.0; n + 1];
        restrict(&points, interval, &mut out).unwrap();
        assert_eq!(
            [out[0], out[n]],
            interval.map(|t| value(&points, t)).map(|end| if n == 0 { points[0] } else { end })
        );
        let q = exacts(&points);
        let places: Vec<usize> =
            if n <= 20 { (0..=n).collect() } else { (0..4).map(|_| hunter.below(n + 1)).collect() };
        let truth = restricted_line(&q, interval, &places, false);
        let scale = restricted_line(&absolutes(&q), interval, &places, true);
        for ((&place, truth), scale) in places.iter().zip(&truth).zip(&scale) {
            assert_within(out[place], truth, scale, factor(n, 0), &format!("degree {n} on {interval:?}"));
        }
        restrict(&points, [1.0, 0.0], &mut out).unwrap();
        out.reverse();
        assert_eq!(out, points);
    }
}

#[test]
fn restriction_of_nets() {
    let mut hunter = Hunter::new(10);
    for _ in 0..rounds(1000) {
        let degrees = hunter.box_degrees();
        let points = hunter.numbers(count(&degrees));
        let intervals = [0; 3].map(|_: usize| {
            if hunter.below(3) == 0 { [0.0, 1.0] } else { [hunter.parameter(), hunter.parameter()] }
        });
        let mut out = vec![0.0; points.len()];
        restrict_tensor(&points, degrees, intervals, &mut out).unwrap();
        let mut truth = exacts(&points);
        let mut scale = absolutes(&truth);
        for (axis, &interval) in intervals.iter().enumerate() {
            truth = along(&truth, &degrees, axis, |line| whole_restricted_line(line, interval, false));
            scale = along(&scale, &degrees, axis, |line| whole_restricted_line(line, interval, true));
        }
        for ((got, truth), scale) in out.iter().zip(&truth).zip(&scale) {
            assert_within(*got, truth, scale, factor(degrees.iter().sum(), 0), "restricted");
        }
    }
}

#[test]
fn subdivision_of_nets_is_restriction() {
    let mut hunter = Hunter::new(11);
    for _ in 0..rounds(1000) {
        let degrees = hunter.box_degrees();
        let points = hunter.numbers(count(&degrees));
        let (axis, t) = (hunter.below(3), hunter.parameter());
        let (mut left, mut right) = (vec![0.0; points.len()], vec![0.0; points.len()]);
        subdivide_along(&points, degrees, axis, t, &mut left, &mut right).unwrap();
        let (q, sizes) = (exacts(&points), absolutes(&exacts(&points)));
        for (part, interval) in [(&left, [0.0, t]), (&right, [t, 1.0])] {
            let truth = along(&q, &degrees, axis, |line| whole_restricted_line(line, interval, false));
            let scale = along(&sizes, &degrees, axis, |line| whole_restricted_line(line, interval, true));
            for ((got, truth), scale) in part.iter().zip(&truth).zip(&scale) {
                assert_within(*got, truth, scale, factor(degrees[axis], 0), "part");
            }
        }
    }
}

#[test]
fn golden_rational_elevation() {
    for case in cases("degree_elevation.json").iter().filter(|c| c["kind"] == "rational_curve") {
        let (n, raise) = (size(&case["degree"]), size(&case["raise"]));
        let weights = numbers(&case["weights"]);
        let lift = |points: &[f64]| {
            let mut out = vec![0.0; n + raise + 1];
            elevate_along(points, [n], 0, n + raise, &mut out).unwrap();
            out
        };
        let lifted = lift(&weights);
        for (got, exact) in lifted.iter().zip(numbers(&case["expected_weights"])) {
            assert_accurate(*got, exact, n + raise, 0, exact.abs(), "weight");
        }
        for axis in 0..2 {
            let points = support::component(&case["control_points"], axis);
            let products: Vec<f64> = points.iter().zip(&weights).map(|(p, w)| p * w).collect();
            let expected = support::component(&case["expected_points"], axis);
            let scale = lift(&products.iter().map(|x| x.abs()).collect::<Vec<_>>());
            for (i, got) in lift(&products).into_iter().enumerate() {
                let what = "point of a rational curve";
                assert_accurate(got / lifted[i], expected[i], n + raise + 2, 0, scale[i] / lifted[i], what);
            }
        }
    }
}

#[test]
fn golden_nets() {
    for case in cases("degree_elevation.json").iter().filter(|c| c["kind"] == "tensor") {
        let d: Vec<usize> = case["degree"].as_array().unwrap().iter().map(size).collect();
        let (axis, raise) = (size(&case["axis"]), size(&case["raise"]));
        let points = flat(&case["coefficients"], d.len());
        let expected = flat(&case["expected"], d.len());
        let mut out = vec![0.0; expected.len()];
        match d[..] {
            [m, n] => elevate_along(&points, [m, n], axis, d[axis] + raise, &mut out).unwrap(),
            [l, m, n] => elevate_along(&points, [l, m, n], axis, d[axis] + raise, &mut out).unwrap(),
            _ => panic!("{d:?}"),
        }
        for (got, exact) in out.into_iter().zip(expected) {
            assert_accurate(got, exact, d[axis] + raise, 0, 4.0, "tensor elevation");
        }
    }
    for case in cases("subdivision.json").iter().filter(|c| c["kind"] == "tensor_split") {
        let d: Vec<usize> = case["degree"].as_array().unwrap().iter().map(size).collect();
        let (axis, t) = (size(&case["axis"]), number(&case["t"]));
        let points = flat(&case["coefficients"], d.len());
        let [mut left, mut right] = [points.clone(), points.clone()];
        match d[..] {
            [m, n] => subdivide_along(&points, [m, n], axis, t, &mut left, &mut right).unwrap(),
            [l, m, n] => subdivide_along(&points, [l, m, n], axis, t, &mut left, &mut right).unwrap(),
            _ => panic!("{d:?}"),
        }
        for (part, key) in [(left, "left"), (right, "right")] {
            for (got, exact) in part.into_iter().zip(flat(&case[key], d.len())) {
                assert_accurate(got, exact, d[axis], 0, 4.0, "tensor split");
            }
        }
    }
    for case in cases("subdivision.json").iter().filter(|c| c["kind"] == "curve_restrict") {
        let points = numbers(&case["coefficients"]);
        let interval = numbers(&case["interval"]);
        let mut out = points.clone();
        restrict(&points, [interval[0], interval[1]], &mut out).unwrap();
        for (got, exact) in out.into_iter().zip(numbers(&case["expected"])) {
            assert_accurate(got, exact, points.len() - 1, 0, 4.0, "restriction");
        }
    }
}

#[test]
fn wrong_sizes_are_refused() {
    let length = |buffer, needed, given| Err(BernsteinError::BufferLength { buffer, needed, given });
    assert_eq!(restrict::<f64>(&[], [0.0, 1.0], &mut []), Err(BernsteinError::NoPoints));
    assert_eq!(restrict(&[1.0], [0.0, 1.0], &mut []), length("out", 1, 0));
    assert_eq!(restrict_along(&[1.0; 3], [1, 1], 0, [0.0, 1.0], &mut [0.0; 4]), length("points", 4, 3));
    let axis = Err(BernsteinError::Axis { axis: 2, dimension: 2 });
    assert_eq!(subdivide_along(&[1.0; 4], [1, 1], 2, 0.5, &mut [0.0; 4], &mut [0.0; 4]), axis);
    assert_eq!(
        subdivide_along(&[1.0; 4], [1, 1], 1, 0.5, &mut [0.0; 4], &mut [0.0; 3]),
        length("right", 4, 3)
    );
    assert_eq!(elevate_along(&[1.0; 4], [1, 1], 1, 3, &mut [0.0; 7]), length("out", 8, 7));
}
