//! Shapes against exact cases.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_geom::glam::{DVec3, DVec4};
use casteljau_shape::{
    Curve, ParametricCurve, ParametricSurface, Patch, PowerCurve, RationalCurve, RationalPatch,
    RationalTriangle, ShapeError, Triangle,
};
use serde_json::Value;
use support::{assert_accurate, cases, flat, net, number, numbers, orders, point, size, weighted_net};

fn check_curve(case: &Value, curve: &dyn ParametricCurve) {
    let n = size(&case["degree"]);
    for sample in case["samples"].as_array().unwrap() {
        let t = number(&sample["params"][0]);
        if sample["pole"] == true {
            assert!(matches!(curve.try_jet(t), Err(ShapeError::Evaluation { .. })), "{}", case["name"]);
            continue;
        }
        let jet = curve.try_jet_of_order(t, 3).unwrap();
        let weight = number(&sample["weight"]);
        assert!((curve.weight(t) - weight).abs() <= 1e-12 * weight.abs(), "{} weight", case["name"]);
        for (key, exact) in sample["partials"].as_object().unwrap() {
            let [k] = orders(key);
            let what = format!("{} order {k} at {t}", case["name"]);
            assert_accurate(jet.get([k]).unwrap(), point(exact), n, k, point(&sample["scale"][key]), &what);
        }
    }
}

#[test]
fn curves() {
    for case in cases("curves.json") {
        let curve = Curve::new(net(&case["control_points"])).unwrap();
        check_curve(&case, &curve);
        check_curve(&case, &RationalCurve::from(curve));
    }
}

#[test]
fn rational_curves() {
    for case in cases("rational_curves.json") {
        if case["homogeneous"].is_array() {
            let points: Vec<DVec4> = case["homogeneous"]
                .as_array()
                .unwrap()
                .iter()
                .map(numbers)
                .map(|p| DVec4::new(p[0], p[1], 0.0, p[2]))
                .collect();
            let curve = RationalCurve::from_homogeneous(points).unwrap();
            for sample in case["samples"].as_array().unwrap() {
                let t = number(&sample["params"][0]);
                let exact = point(&sample["value"]);
                assert_accurate(curve.point(t).unwrap(), exact, 2, 0, DVec3::splat(4.0), "infinite point");
            }
            continue;
        }
        let (points, weights) = weighted_net(&case);
        let curve = RationalCurve::new(&points, &weights).unwrap();
        assert!(curve.weights().eq(weights));
        check_curve(&case, &curve);
    }
}

fn check_patch(case: &Value, patch: &dyn ParametricSurface) {
    let degree = size(&case["degree"][0]) + size(&case["degree"][1]);
    for sample in case["samples"].as_array().unwrap() {
        let [u, v] = [number(&sample["params"][0]), number(&sample["params"][1])];
        if sample["pole"] == true {
            assert!(matches!(patch.try_jet(u, v), Err(ShapeError::Evaluation { .. })), "{}", case["name"]);
            continue;
        }
        let jet = patch.try_jet_of_order(u, v, 3).unwrap();
        for (key, exact) in sample["partials"].as_object().unwrap() {
            let [a, b] = orders(key);
            let what = format!("{} order {key} at {u}, {v}", case["name"]);
            let scale = point(&sample["scale"][key]);
            assert_accurate(jet.get([a, b]).unwrap(), point(exact), degree, a + b, scale, &what);
        }
        let Some(normal) = sample.get("normal").filter(|n| !n.is_null()).map(point) else { continue };
        assert!(patch.try_normal(u, v).unwrap().distance(normal) < 1e-12, "{} normal", case["name"]);
        let curvatures = patch.try_curvatures(u, v).unwrap();
        let exact = numbers(&sample["principal"]);
        let size = exact[0].abs().max(exact[1].abs()) + 1e-3;
        for (got, exact) in curvatures.principal.into_iter().zip(exact) {
            assert!((got - exact).abs() < 1e-11 * size, "{} at {u}, {v}: {got} {exact}", case["name"]);
        }
        assert!((curvatures.gaussian - number(&sample["gaussian"])).abs() < 1e-11 * size * size);
        assert!((curvatures.mean - number(&sample["mean"])).abs() < 1e-11 * size);
    }
}

#[test]
fn patches() {
    for case in cases("patches.json").iter().filter(|c| c["dim"] == 3) {
        let degrees = [size(&case["degree"][0]), size(&case["degree"][1])];
        let patch = Patch::new(degrees, net(&case["control_points"])).unwrap();
        check_patch(case, &patch);
        check_patch(case, &RationalPatch::from(patch));
    }
}

#[test]
fn rational_patches() {
    for case in cases("rational_patches.json").iter().filter(|c| c["dim"] == 3) {
        let degrees = [size(&case["degree"][0]), size(&case["degree"][1])];
        let (points, weights) = weighted_net(case);
        let patch = RationalPatch::new(degrees, &points, &weights).unwrap();
        check_patch(case, &patch);
    }
}

/// The files give the scale of the value only; that of a derivative of order k is at most n!/(n−k)!·2ᵏ times
/// the largest coordinate, and each division by the weight doubles it by the ratio of the weights.
fn check_triangle(case: &Value, triangle: &dyn ParametricSurface, control_points: &[DVec3], weights: &[f64]) {
    let n = size(&case["degree"]);
    let largest = control_points.iter().fold(DVec3::ZERO, |m, p| m.max(p.abs()));
    for sample in case["samples"].as_array().unwrap() {
        let lambda = numbers(&sample["lambda_first"]);
        if sample["pole"] == true {
            assert!(triangle.try_jet(lambda[0], lambda[1]).is_err());
            continue;
        }
        let jet = triangle.try_jet_of_order(lambda[0], lambda[1], 3).unwrap();
        let w = triangle.weight(lambda[0], lambda[1]);
        let ratio = weights.iter().fold(0.0, |m: f64, x| m.max(x.abs())) / w.abs();
        for (key, exact) in sample["partials"].as_object().unwrap() {
            let [a, b] = orders(key);
            let k = a + b;
            let polynomial = weights.iter().all(|&w| w == 1.0);
            // Quotients have derivatives of every order; there C(n+k, k)·k! takes the place of n!/(n−k)!.
            let factor = |i: usize| if polynomial { n - i.min(n) } else { n + i + 1 };
            let falling: f64 = (0..k).map(|i| factor(i) as f64).product();
            let rational = if polynomial { 1.0 } else { (2.0 * ratio).powi(k as i32 + 1) };
            let outside: f64 = lambda.iter().chain([&(1.0 - lambda[0] - lambda[1])]).map(|l| l.abs()).sum();
            let scale = if k == 0 {
                point(&sample["scale0"])
            } else {
                largest * falling * 2_f64.powi(k as i32) * rational * outside.powi(n as i32)
            };
            let what = format!("{} order {key} at {lambda:?}", case["name"]);
            assert_accurate(jet.get([a, b]).unwrap(), point(exact), n, k, scale, &what);
        }
    }
}

#[test]
fn triangles() {
    for case in cases("triangles.json") {
        let n = size(&case["degree"]);
        let (points, weights) = weighted_net(&case);
        if case["weights"].is_null() {
            let triangle = Triangle::new(n, points.clone()).unwrap();
            check_triangle(&case, &triangle, &points, &weights);
            check_triangle(&case, &RationalTriangle::from(triangle), &points, &weights);
        } else {
            let triangle = RationalTriangle::new(n, &points, &weights).unwrap();
            assert!(triangle.weights().eq(flat(&case["weights"])));
            check_triangle(&case, &triangle, &points, &weights);
        }
    }
}

#[test]
fn conversion() {
    use casteljau_geom::Interval;
    for case in cases("conversion.json") {
        let kind = case["kind"].as_str().unwrap();
        if !kind.starts_with("power_to_bernstein") {
            continue;
        }
        let n = size(&case["degree"]);
        let input = numbers(&case["input"]);
        let ends = if case["interval"].is_array() { numbers(&case["interval"]) } else { vec![0.0, 1.0] };
        let interval = Interval::new(ends[0], ends[1]).unwrap();
        let power = PowerCurve::new(input.iter().map(|&x| DVec3::X * x).collect::<Vec<_>>()).unwrap();
        let curve = power.clone().with_interval(interval).to_bezier().unwrap();
        // Contributions are at most |aᵢ| max(|a|, |b|)ⁱ.
        let farthest = ends[0].abs().max(ends[1].abs());
        let scale: f64 = input.iter().enumerate().map(|(i, x)| x.abs() * farthest.powi(i as i32)).sum();
        for (p, exact) in curve.control_points().iter().zip(numbers(&case["expected"])) {
            assert_accurate(*p, DVec3::X * exact, n, 0, DVec3::X * scale, kind);
        }
        // And back: to 3ⁿ times the largest control point over [0, 1].
        if case["interval"].is_null() {
            let back = curve.to_power().unwrap();
            let largest = curve.control_points().iter().map(|p| p.x.abs()).fold(0.0, f64::max);
            for (i, (a, exact)) in back.coefficients().iter().zip(&input).enumerate() {
                let what = format!("{kind}, degree {n}, coefficient {i}");
                // The contributions to aᵢ are C(n,i)·2ⁱ at most; the control points carry an error of their own.
                let grown = 3_f64.powi(n as i32) * (largest + 4.0 * scale * (n + 2) as f64);
                assert_accurate(*a, DVec3::X * *exact, n, 0, DVec3::X * grown, &what);
            }
        }
    }
}

#[test]
fn elevation_and_subdivision() {
    for case in cases("degree_elevation.json").iter().filter(|c| c["kind"] == "rational_curve") {
        let (n, raise) = (size(&case["degree"]), size(&case["raise"]));
        let (points, weights) = weighted_net(case);
        let raised = RationalCurve::new(&points, &weights).unwrap().elevated(raise).unwrap();
        let exact = net(&case["expected_points"]);
        let largest = points.iter().fold(DVec3::ZERO, |m, p| m.max(p.abs()));
        for (i, w) in numbers(&case["expected_weights"]).into_iter().enumerate() {
            let p = raised.control_points()[i];
            assert!((p.w - w).abs() <= 1e-15 * w);
            assert_accurate(p.truncate() / p.w, exact[i], n + raise, 0, 2.0 * largest, "elevated point");
        }
    }
    for case in cases("subdivision.json").iter().filter(|c| c["kind"] == "curve_split") {
        let input = numbers(&case["coefficients"]);
        let curve = Curve::new(input.iter().map(|&x| DVec3::X * x).collect::<Vec<_>>()).unwrap();
        let (left, right) = curve.split(number(&case["t"])).unwrap();
        let largest = input.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        for (part, key) in [(left, "left"), (right, "right")] {
            for (p, exact) in part.control_points().iter().zip(numbers(&case[key])) {
                assert_accurate(*p, DVec3::X * exact, input.len() - 1, 0, DVec3::X * largest, key);
            }
        }
    }
}
