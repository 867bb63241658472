//! Solids against exact cases.
#![allow(clippy::unwrap_used)] // helpers of tests

#[path = "../../shape/tests/support/mod.rs"]
mod support;

use casteljau_geom::glam::{DVec3, DVec4};
use casteljau_geom::rounding_bound;
use casteljau_shape::ShapeError;
use casteljau_solid::{
    Hexahedron, ParametricSolid, RationalHexahedron, RationalTetrahedron, SolidError, Tetrahedron,
    rational_rotation,
};
use serde_json::Value;
use support::{U, assert_accurate, cases, flat, net, number, numbers, orders, point, size, weighted_net};

fn parameters(value: &Value) -> [f64; 3] {
    numbers(value).try_into().unwrap()
}

fn degrees(case: &Value) -> [usize; 3] {
    [0, 1, 2].map(|axis| size(&case["degree"][axis]))
}

#[track_caller]
fn assert_pole(solid: &dyn ParametricSolid, at: [f64; 3]) {
    let refused = solid.try_jet(at).unwrap_err();
    assert!(matches!(refused, SolidError::Shape(ShapeError::Evaluation { .. })), "{refused}");
}

/// Every product of three derivatives within its scales and bounds.
fn jacobian_bound(degree: usize, scales: [DVec3; 3]) -> f64 {
    // Three factors, each off by its bound relative to its scale, six products, and the roundings of the determinant.
    let sizes: f64 = scales.iter().map(|s| s.element_sum()).product();
    3.0 * rounding_bound(degree, 1, sizes) + 8.0 * U * sizes
}

#[test]
fn tensor_solids() {
    for case in cases("tensor_solids.json") {
        let (points, weights) = weighted_net(&case);
        let degrees = degrees(&case);
        let rational = RationalHexahedron::new(degrees, &points, &weights).unwrap();
        let polynomial = case["weights"].is_null().then(|| Hexahedron::new(degrees, points.clone()).unwrap());
        let mut solids: Vec<&dyn ParametricSolid> = vec![&rational];
        solids.extend(polynomial.as_ref().map(|s| s as &dyn ParametricSolid));
        for solid in solids {
            check_solid(&case, solid, degrees.iter().sum(), "params");
        }
    }
}

fn check_solid(case: &Value, solid: &dyn ParametricSolid, degree: usize, key: &str) {
    for sample in case["samples"].as_array().unwrap() {
        let at = parameters(&sample[key]);
        if sample["pole"] == true {
            assert_pole(solid, at);
            continue;
        }
        let weight = number(&sample["weight"]);
        assert!((solid.weight(at) - weight).abs() <= 1e-12 * weight.abs(), "{} weight", case["name"]);
        let jet = solid.try_jet_of_order(at, 3).unwrap();
        for (key, exact) in sample["partials"].as_object().unwrap() {
            let [a, b, c] = orders(key);
            let what = format!("{} order {key} at {at:?}", case["name"]);
            let scale = point(&sample["scale"][key]);
            let got = jet.get([a, b, c]).unwrap();
            assert_accurate(got, point(exact), degree, a + b + c, scale, &what);
        }
        let exact = number(&sample["jacobian_det"]);
        let scales = ["1,0,0", "0,1,0", "0,0,1"].map(|key| point(&sample["scale"][key]));
        let off = (solid.try_jacobian(at).unwrap() - exact).abs();
        assert!(off <= jacobian_bound(degree, scales), "{} at {at:?}: off {off:e}", case["name"]);
    }
}

/// The files give the scale of the value only. That of a derivative of order k is at most n!/(n−k)!·2ᵏ times the
/// largest coordinate, seen from the tetrahedron's own sums; each division by the weight doubles it by the ratio of the
/// weights.
#[test]
fn tetrahedra() {
    for case in cases("tetrahedra.json") {
        let n = size(&case["degree"]);
        let (points, weights) = weighted_net(&case);
        let rational = RationalTetrahedron::new(n, &points, &weights).unwrap();
        let polynomial = case["weights"].is_null().then(|| Tetrahedron::new(n, points.clone()).unwrap());
        let mut solids: Vec<&dyn ParametricSolid> = vec![&rational];
        solids.extend(polynomial.as_ref().map(|s| s as &dyn ParametricSolid));
        let largest = points.iter().fold(DVec3::ZERO, |m, p| m.max(p.abs()));
        let heaviest = weights.iter().fold(0.0_f64, |m, w| m.max(w.abs()));
        for sample in case["samples"].as_array().unwrap() {
            let at = parameters(&sample["lambda_first"]);
            for solid in &solids {
                if sample["pole"] == true {
                    assert_pole(*solid, at);
                    continue;
                }
                let weight = number(&sample["weight"]);
                let ratio = (heaviest / weight.abs()).max(1.0);
                let jet = solid.try_jet_of_order(at, 3).unwrap();
                for (key, exact) in sample["partials"].as_object().unwrap() {
                    let [a, b, c] = orders(key);
                    let k = a + b + c;
                    let polynomial = case["weights"].is_null();
                    // Quotients have derivatives of every order; there C(n+k, k)·k! takes the place of n!/(n−k)!.
                    let factor = |i: usize| if polynomial { n - i.min(n) } else { n + i + 1 };
                    let falling: f64 = (0..k).map(|i| factor(i) as f64).product();
                    let divisions = if polynomial { 1.0 } else { (2.0 * ratio).powi(k as i32 + 1) };
                    let scale = if k == 0 {
                        point(&sample["scale0"])
                    } else {
                        largest * falling * 2_f64.powi(k as i32) * divisions
                    };
                    let what = format!("{} order {key} at {at:?}", case["name"]);
                    assert_accurate(jet.get([a, b, c]).unwrap(), point(exact), n, k, scale, &what);
                }
            }
        }
        if case["name"] == "ball_octant_quartic_tet" {
            for at in [[0.0, 0.2, 0.3], [0.0, 0.7, 0.1], [0.0, 1.0 / 3.0, 1.0 / 3.0]] {
                let on_sphere = [0, 1, 2, 3].map(|vertex| {
                    let [_, b, c] = at;
                    let face = rational.face(vertex).unwrap();
                    face.point(b, c).unwrap().length()
                });
                assert!(on_sphere.iter().any(|r| (r - 1.0).abs() < 1e-14), "{on_sphere:?}");
            }
        }
    }
}

fn patch_of(case: &Value) -> casteljau_shape::RationalPatch {
    let inputs = &case["inputs"];
    let rows = inputs["P"].as_array().unwrap();
    let degrees = [rows.len() - 1, rows[0].as_array().unwrap().len() - 1];
    casteljau_shape::RationalPatch::new(degrees, &net(&inputs["P"]), &flat(&inputs["s"])).unwrap()
}

fn curve_of(case: &Value) -> casteljau_shape::RationalCurve {
    casteljau_shape::RationalCurve::new(&net(&case["inputs"]["Q"]), &flat(&case["inputs"]["r"])).unwrap()
}

#[test]
fn constructions() {
    for case in cases("constructions.json") {
        let curve = curve_of(&case);
        let solid = match case["kind"].as_str().unwrap() {
            "rotational" => RationalHexahedron::rotational(&curve).unwrap(),
            "transitional" => RationalHexahedron::transitional(&patch_of(&case), &curve).unwrap(),
            "twisted" => {
                let angle = number(&case["inputs"]["alpha_f64"]);
                RationalHexahedron::twisted(&patch_of(&case), &curve, angle).unwrap()
            }
            other => panic!("{other}"),
        };
        assert_eq!(solid.degrees(), degrees(&case), "{}", case["name"]);
        let (points, weights) = weighted_net(&case);
        let largest = points.iter().map(|p| p.length()).fold(0.0, f64::max);
        let degree: usize = solid.degrees().iter().sum();
        for ((p, exact), w) in solid.control_points().iter().zip(&points).zip(&weights) {
            assert!((p.w - w).abs() <= 2.0 * U * w.abs(), "{}", case["name"]);
            // A product, a sum, and for twisted ones the rounding of k·α and of a rotation.
            let off = (p.truncate() / p.w - *exact).length();
            assert!(off <= 8.0 * U * largest, "{}: {p} for {exact}, {w}", case["name"]);
        }
        let spread = weights.iter().fold(0.0_f64, |m, w| m.max(w.abs()));
        for sample in case["samples"].as_array().unwrap() {
            let at = parameters(&sample["params"]);
            let weight = solid.weight(at);
            let off = solid.point(at).unwrap().distance(point(&sample["point"]));
            let ratio = spread / weight.abs();
            assert!(off <= 2.0 * rounding_bound(degree, 0, largest * ratio), "{}: {off:e}", case["name"]);
            let jet = solid.jet(at).unwrap();
            // Differences of neighbouring points times the degree, and a division by the weight more.
            let slope = 2.0 * degree as f64 * largest * ratio * ratio;
            for (key, got) in [("du", jet.du), ("dv", jet.dv), ("dw", jet.dw)] {
                let Some(exact) = sample.get(key).filter(|v| !v.is_null()) else { continue };
                let off = got.distance(point(exact));
                assert!(off <= 2.0 * rounding_bound(degree, 1, slope), "{} {key}: {off:e}", case["name"]);
            }
            let off = (jet.jacobian() - number(&sample["jacobian_det"])).abs();
            assert!(off <= 6.0 * rounding_bound(degree, 1, slope.powi(3)), "{}: {off:e}", case["name"]);
        }
    }
}

#[test]
fn exact_twist() {
    for case in cases("exact_twist.json") {
        let k =
            case["k"].as_u64().map_or_else(|| case["k"].as_str().unwrap().parse().unwrap(), |k| k as usize);
        let angle = match case["total_angle"].as_str().unwrap() {
            "pi/2" => std::f64::consts::FRAC_PI_2,
            "pi" => std::f64::consts::PI,
            "4*pi" => 4.0 * std::f64::consts::PI,
            other => panic!("{other}"),
        };
        let [cosine, sine, weight] = rational_rotation(angle, k).unwrap();
        // The angle and its shares are rounded: u times the angle each.
        let allowed = 4.0 * U * angle.max(1.0);
        for (got, key) in [(&cosine, "numerator_re"), (&sine, "numerator_im"), (&weight, "weights")] {
            for (got, exact) in got.iter().zip(numbers(&case[key])) {
                assert!((got - exact).abs() <= allowed, "{} {key}: {got} {exact}", case["total_angle"]);
            }
        }
        let curve: Vec<DVec4> = (0..=2 * k).map(|j| DVec4::new(cosine[j], sine[j], 0.0, weight[j])).collect();
        let curve = casteljau_shape::RationalCurve::from_homogeneous(curve).unwrap();
        for sample in case["samples"].as_array().unwrap() {
            let p = curve.point(number(&sample["t"])).unwrap();
            let exact = DVec3::new(number(&sample["cos"]), number(&sample["sin"]), 0.0);
            // The weight is at least cos(θ/4k)²ᵏ ≥ 2⁻ᵏ.
            let allowed = (allowed + rounding_bound(2 * k, 0, 1.0)) * 2_f64.powi(k as i32);
            assert!(p.distance(exact) <= allowed, "{}: {p} {exact}", case["total_angle"]);
        }
    }
}
