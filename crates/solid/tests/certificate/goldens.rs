//! The exact cases of jacobian.json and constructions.json.

use casteljau_solid::bernstein::elevate_tensor;
use casteljau_solid::geom::UNIT_ROUNDOFF as U;
use casteljau_solid::geom::glam::DVec4;
use casteljau_solid::shape::ControlPoint;
use casteljau_solid::{
    DEFAULT_OPERATIONS, JacobianCoefficients, JacobianVerdict, SolidDegrees, SolidNet, jacobian_verdict,
};
use serde_json::Value;

use crate::support::{cases, flat, homogeneous, points, sizes};

fn check<P: ControlPoint>(case: &Value, net: &SolidNet<'_, P>, exact: Vec<f64>, degrees: SolidDegrees) {
    let computed = JacobianCoefficients::new(net).unwrap();
    // The determinant of a rational hexahedron is written in one degree more than it has, along two axes.
    let exact = match (computed.degrees(), degrees) {
        (SolidDegrees::Hexahedron(to), SolidDegrees::Hexahedron(from)) => {
            let mut elevated = vec![0.0; computed.degrees().count()];
            elevate_tensor(&exact, from, to, &mut elevated).unwrap();
            elevated
        }
        (of_computed, of_exact) => {
            assert_eq!(of_computed, of_exact);
            exact
        }
    };
    let largest = exact.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
    let bounds = computed.rounding();
    assert_eq!(computed.values().len(), exact.len());
    for ((value, exact), bound) in computed.values().into_iter().zip(exact).zip(bounds) {
        // Elevation of the exact ones rounds twelve times.
        assert!(
            (value - exact).abs() <= bound + 12.0 * U * largest,
            "{}: {value:e} for {exact:e}",
            case["kind"]
        );
        // A bound that says nothing would be no test.
        assert!(bound <= 1e-13 * largest, "{bound:e}");
    }
    let verdict = jacobian_verdict(net, DEFAULT_OPERATIONS).unwrap();
    match case["positivity"].as_str() {
        Some("negative_somewhere") => {
            assert!(matches!(verdict, JacobianVerdict::Invalid { .. }), "{verdict:?}")
        }
        // Tetrahedra come without a word, but with a positive least coefficient.
        Some("positive") => assert_eq!(verdict, JacobianVerdict::Positive),
        None if flat(&case["min_coef"])[0] > 0.0 => assert_eq!(verdict, JacobianVerdict::Positive),
        _ => panic!("an unknown case {case}"),
    }
}

#[test]
fn determinants_and_verdicts() {
    for case in cases("jacobian.json") {
        let points = points(&case["control_points"]);
        match case["kind"].as_str().unwrap() {
            "tet_polynomial" => {
                let degree = sizes(&case["degree"])[0];
                let exact = flat(&case["jacobian_coefficients"]);
                let degrees = SolidDegrees::Tetrahedron(sizes(&case["jacobian_degree"])[0]);
                check(&case, &SolidNet::Tetrahedron { points: &points, degree }, exact.clone(), degrees);
                // As a rational one with weights 1: the degree is 4(n − 1) then, so compare by verdict.
                let lifted: Vec<DVec4> = points.iter().map(|p| p.extend(1.0)).collect();
                let rational = SolidNet::Tetrahedron { points: &lifted, degree };
                assert_eq!(
                    jacobian_verdict(&rational, DEFAULT_OPERATIONS).unwrap(),
                    JacobianVerdict::Positive
                );
            }
            kind => {
                let degrees: [usize; 3] = sizes(&case["degree"]).try_into().unwrap();
                let rational = kind == "hex_rational";
                let name = if rational { "D" } else { "jacobian" };
                let exact = flat(&case[if rational { "D_coefficients" } else { "jacobian_coefficients" }]);
                let of_exact = sizes(&case[format!("{name}_degree")]).try_into().unwrap();
                let of_exact = SolidDegrees::Hexahedron(of_exact);
                if rational {
                    let points = homogeneous(&points, &flat(&case["weights"]));
                    check(&case, &SolidNet::Hexahedron { points: &points, degrees }, exact, of_exact);
                } else {
                    check(&case, &SolidNet::Hexahedron { points: &points, degrees }, exact, of_exact);
                }
            }
        }
    }
}

/// The determinants at the samples agree with the verdict; and the verdict is the true one, known from the determinants at
/// 31³ places each.
#[test]
fn constructions() {
    for case in cases("constructions.json") {
        let name = case["name"].as_str().unwrap();
        let points = homogeneous(&points(&case["control_points"]), &flat(&case["weights"]));
        let degrees = sizes(&case["degree"]).try_into().unwrap();
        let net = SolidNet::Hexahedron { points: &points, degrees };
        let verdict = jacobian_verdict(&net, DEFAULT_OPERATIONS).unwrap();
        let samples = case["samples"].as_array().unwrap();
        let least = samples.iter().map(|s| flat(&s["jacobian_det"])[0]).fold(f64::INFINITY, f64::min);
        let named: Vec<String> = verdict.exceptions().iter().map(ToString::to_string).collect();
        let corners = ["edge u = 0, v = 0", "edge u = 0, v = 1", "edge u = 1, v = 0", "edge u = 1, v = 1"];
        match name {
            // The curve of the arcs ends, and that of the cone meets the axis, at the upper end.
            "rotational_cone_to_apex" | "twisted_disc_arc_pi/2" | "twisted_disc_arc_-1" => {
                assert_eq!(named[0], "face w = 1", "{name}");
                assert_eq!(named[1..], corners, "{name}");
            }
            // A curve turns back, or the patch leans over.
            "transitional_seed002_arc"
            | "twisted_bilinear_arc_pi/2"
            | "twisted_bilinear_arc_-1"
            | "twisted_bilinear_cubic_offset_pi/2"
            | "twisted_bilinear_cubic_offset_-1" => {
                assert!(matches!(verdict, JacobianVerdict::Invalid { value, .. } if value < -1e-3), "{name}");
            }
            // det J touches zero along a curve on the face u = 1, within 1e-15.
            "twisted_bilinear_line_z4_pi/2" => match verdict {
                JacobianVerdict::Undecided { least, .. } => assert!(least.abs() < 1e-5, "{least}"),
                _ => panic!("{name}: {verdict:?}"),
            },
            _ if name.contains("bilinear") => assert_eq!(verdict, JacobianVerdict::Positive, "{name}"),
            _ => assert_eq!(named, corners, "{name}"),
        }
        if verdict.is_valid() {
            assert!(least > if named.is_empty() { 0.0 } else { -1e-12 }, "{name}: {least}");
        }
    }
}
