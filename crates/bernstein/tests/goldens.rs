//! The kernels against exact cases.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_bernstein::{
    Point, TensorNet, basis, basis_derivatives, binomial, de_casteljau, derivatives, elevate, partial_index,
    subdivide, value,
};
use support::{assert_accurate, cases, component, number, numbers, size};

/// `n!/(n−k)! Σᵢ |Bᵢⁿ⁻ᵏ(t)| Σⱼ C(k,j) |Pᵢ₊ⱼ|`: the sum of the absolute contributions to a derivative.
fn scale(points: &[f64], t: f64, k: usize) -> f64 {
    let Some(lower) = (points.len() - 1).checked_sub(k) else { return 0.0 };
    let mut b = vec![0.0; lower + 1];
    basis(t, &mut b);
    let spread = |i: usize| (0..=k).map(|j| binomial(k, j) * points[i + j].abs()).sum::<f64>();
    let factor: f64 = (lower + 1..points.len()).map(|m| m as f64).product();
    factor * b.iter().enumerate().map(|(i, b)| b.abs() * spread(i)).sum::<f64>()
}

#[test]
fn bernstein_basis() {
    for case in cases("bernstein_basis.json") {
        let (n, t) = (size(&case["degree"]), number(&case["t"]));
        let mut rows = vec![0.0; 4 * (n + 1)];
        basis_derivatives(t, 3, &mut rows);
        let mut b = vec![0.0; n + 1];
        basis(t, &mut b);
        assert_eq!(b, rows[..=n]);
        for (i, exact) in numbers(&case["values"]).into_iter().enumerate() {
            // A single product: the scale is the value itself.
            assert_accurate(b[i], exact, n, 0, exact.abs(), &format!("B {i} {n} at {t}"));
        }
        let Some(derivatives) = case["derivatives"].as_array() else { continue };
        for (k, row) in derivatives.iter().enumerate() {
            for (i, exact) in numbers(row).into_iter().enumerate() {
                let mut unit = vec![0.0; n + 1];
                unit[i] = 1.0;
                let what = format!("derivative {} of B {i} {n} at {t}", k + 1);
                assert_accurate(rows[(k + 1) * (n + 1) + i], exact, n, k + 1, scale(&unit, t, k + 1), &what);
            }
        }
    }
}

#[test]
fn curves() {
    for case in cases("curves.json") {
        let (n, dim) = (size(&case["degree"]), size(&case["dim"]));
        for sample in case["samples"].as_array().unwrap() {
            let t = number(&sample["params"][0]);
            for axis in 0..dim {
                let points = component(&case["control_points"], axis);
                let mut jet = [0.0; 4];
                derivatives(&points, t, &mut jet);
                assert_eq!(jet[0], value(&points, t));
                let mut scratch = vec![0.0; n + 1];
                let other = de_casteljau(&points, t, &mut scratch);
                for (order, partial) in sample["partials"].as_object().unwrap() {
                    let k: usize = order.parse().unwrap();
                    let what = format!("{} order {k} at {t}", case["name"]);
                    let exact = number(&partial[axis]);
                    assert_accurate(jet[k], exact, n, k, scale(&points, t, k), &what);
                    if k == 0 {
                        assert_accurate(other, exact, n, 0, scale(&points, t, 0), &what);
                    }
                }
            }
        }
    }
}

#[test]
fn elevation() {
    for case in cases("degree_elevation.json").iter().filter(|c| c["kind"] == "curve") {
        let (n, raise) = (size(&case["degree"]), size(&case["raise"]));
        for axis in 0..case["control_points"][0].as_array().unwrap().len() {
            let points = component(&case["control_points"], axis);
            let (mut out, mut absolute) = (vec![0.0; n + raise + 1], vec![0.0; n + raise + 1]);
            elevate(&points, &mut out).unwrap();
            elevate(&points.iter().map(|x| x.abs()).collect::<Vec<_>>(), &mut absolute).unwrap();
            for (j, exact) in component(&case["expected"], axis).into_iter().enumerate() {
                assert_accurate(
                    out[j],
                    exact,
                    n + raise,
                    0,
                    absolute[j],
                    &format!("{n} + {raise}, point {j}"),
                );
            }
        }
    }
}

#[test]
fn subdivision() {
    for case in cases("subdivision.json").iter().filter(|c| c["kind"] == "curve_split") {
        let (n, t) = (size(&case["degree"]), number(&case["t"]));
        let split = |points: &[f64]| {
            let (mut left, mut right) = (vec![0.0; n + 1], vec![0.0; n + 1]);
            subdivide(points, t, &mut left, &mut right).unwrap();
            [left, right]
        };
        let points = numbers(&case["coefficients"]);
        let parts = split(&points);
        let absolute = split(&points.iter().map(|x| x.abs()).collect::<Vec<_>>());
        for (side, key) in ["left", "right"].into_iter().enumerate() {
            for (i, exact) in numbers(&case[key]).into_iter().enumerate() {
                let what = format!("degree {n}, {key} {i}");
                assert_accurate(parts[side][i], exact, n, 0, absolute[side][i], &what);
            }
        }
    }
}

#[test]
fn patches() {
    for case in cases("patches.json") {
        let [m, n] = [size(&case["degree"][0]), size(&case["degree"][1])];
        for sample in case["samples"].as_array().unwrap() {
            let [u, v] = [number(&sample["params"][0]), number(&sample["params"][1])];
            for axis in 0..size(&case["dim"]) {
                let rows = case["control_points"].as_array().unwrap();
                let points: Vec<f64> = rows.iter().flat_map(|row| component(row, axis)).collect();
                let net = TensorNet::new(&points, [m, n]).unwrap();
                let mut partials = [0.0; 10];
                net.partials(u, v, &mut partials);
                assert_eq!(partials[0], net.value(u, v));
                for (orders, exact) in sample["partials"].as_object().unwrap() {
                    let (a, b) = orders.split_once(',').unwrap();
                    let (a, b): (usize, usize) = (a.parse().unwrap(), b.parse().unwrap());
                    let by_rows: Vec<f64> = points.chunks(n + 1).map(|row| scale(row, v, b)).collect();
                    let what = format!("{} {orders} at {u}, {v}", case["name"]);
                    let got = partials[partial_index(a, b)];
                    assert_accurate(got, number(&exact[axis]), m + n, a + b, scale(&by_rows, u, a), &what);
                }
            }
        }
    }
}

#[test]
fn vectors_are_their_components() {
    use casteljau_bernstein::glam::DVec4;
    let points: Vec<DVec4> =
        (0..9).map(|i| DVec4::new(1.0, 0.1, -3.7, 1e8) * (f64::from(i) - 2.3).sin()).collect();
    let mut jet = [DVec4::ZERO; 5];
    derivatives(&points, 0.37, &mut jet);
    for axis in 0..4 {
        let component: Vec<f64> = points.iter().map(|p| p[axis]).collect();
        let mut scalar = [f64::ZERO; 5];
        derivatives(&component, 0.37, &mut scalar);
        assert_eq!(jet.map(|p| p[axis]), scalar);
    }
}
