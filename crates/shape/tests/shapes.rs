//! Curves and patches: doors, laws, and exact cases of the geometry.
#![allow(clippy::unwrap_used)] // helpers of tests

use std::path::PathBuf;

use casteljau_geom::glam::{DAffine3, DMat3, DVec2, DVec3};
use casteljau_geom::{UNIT_ROUNDOFF, angle_degrees, laws};
use casteljau_shape::{Curve, Patch, ShapeError};
use proptest::collection::vec;
use proptest::prelude::*;
use serde_json::Value;

fn point() -> impl Strategy<Value = DVec3> {
    let x = || prop_oneof![Just(0.0), Just(1.0), -1.0..1.0, -1e3..1e3];
    (x(), x(), x()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

fn affine() -> impl Strategy<Value = DAffine3> {
    (vec(-2.0..2.0, 9), point())
        .prop_map(|(m, p)| DAffine3 { matrix3: DMat3::from_cols_slice(&m), translation: p })
}

proptest! {
    #[test]
    fn curve_laws(p in vec(point(), 1..10), map in affine(), t in 0.0..=1.0, cut in 0.0..=1.0) {
        let c = Curve::new(p.clone()).unwrap();
        let n = c.degree() as f64;
        let size: f64 = p.iter().map(|p| p.length()).sum::<f64>() + 1.0;
        let rounding = 4.0 * (n + 2.0) * UNIT_ROUNDOFF * size;
        laws::end_point_law(|t| c.point(t), p[0], p[p.len() - 1]).unwrap();
        // The map multiplies lengths by at most 6 and adds its own rounding.
        let at = |p: &[DVec3]| Curve::new(p).unwrap().point(t);
        laws::affine_invariance_law(&p, map, at, 20.0 * (rounding + 3e3 * UNIT_ROUNDOFF)).unwrap();
        let (left, right) = c.split(cut).unwrap();
        laws::subdivision_law(|t| c.point(t), |t| left.point(t), |t| right.point(t), cut, 8.0 * rounding).unwrap();
        // Differences are exact up to degree 8, but for rounding 2u|f|/h.
        let h = 1.0 / 64.0;
        let step = 400.0 * rounding;
        laws::derivative_law(|t| c.jet(t).point, |t| c.jet(t).d1, t, h, step * 10.0).unwrap();
        laws::derivative_law(|t| c.jet(t).d1, |t| c.jet(t).d2, t, h, step * 100.0).unwrap();
        laws::derivative_law(|t| c.jet(t).d2, |t| c.jet(t).d3, t, h, step * 1e4).unwrap();
        let back = c.reversed();
        prop_assert!(back.point(1.0 - t).distance(c.point(t)) <= 8.0 * rounding);
        prop_assert!(c.bounding_box().grown(rounding).contains(c.point(t)));
    }

    #[test]
    fn patch_laws(m in 0..5usize, n in 0..5usize, p in vec(point(), 25), u in 0.0..=1.0, v in 0.0..=1.0, map in affine()) {
        let p = &p[..(m + 1) * (n + 1)];
        let patch = Patch::new([m, n], p).unwrap();
        let size: f64 = p.iter().map(|p| p.length()).sum::<f64>() + 1.0;
        let rounding = 4.0 * (m + n + 2) as f64 * UNIT_ROUNDOFF * size;
        laws::surface_derivative_law(|u, v| patch.jet(u, v), [u, v], 1.0 / 64.0, 4e4 * rounding).unwrap();
        let at = |p: &[DVec3]| Patch::new([m, n], p).unwrap().point(u, v);
        laws::affine_invariance_law(p, map, at, 20.0 * (rounding + 3e3 * UNIT_ROUNDOFF)).unwrap();
        // The sides are the curves of the net's first and last row and column; along them the patch is such a
        // curve.
        let row = Curve::new(&p[..=n]).unwrap();
        prop_assert!(patch.point(0.0, v).distance(row.point(v)) <= rounding);
        let column: Vec<DVec3> = (0..=m).map(|i| patch.control_point(i, n).unwrap()).collect();
        prop_assert!(patch.point(u, 1.0).distance(Curve::new(column).unwrap().point(u)) <= rounding);
        prop_assert!(patch.bounding_box().grown(rounding).contains(patch.point(u, v)));
    }
}

#[test]
fn tangents_skip_coinciding_points() {
    let c = Curve::new(vec![DVec3::ONE, DVec3::ONE, DVec3::new(1.0, 3.0, 1.0), DVec3::ZERO, DVec3::ZERO])
        .unwrap();
    assert_eq!(c.start_tangent(), Some(DVec3::Y));
    let end = c.end_tangent().unwrap();
    assert!(angle_degrees(end, DVec3::new(-1.0, -3.0, -1.0)) < 1e-13);
    // The limit of C′/|C′|, indeed.
    assert!(angle_degrees(c.jet(1e-9).d1, DVec3::Y) < 1e-6);
    assert!(angle_degrees(c.jet(1.0 - 1e-9).d1, end) < 1e-6);
    // Apart by rounding only.
    let near =
        Curve::new(vec![DVec3::ONE, DVec3::ONE + DVec3::X * f64::EPSILON, DVec3::ONE + DVec3::Z]).unwrap();
    assert_eq!(near.start_tangent(), Some(DVec3::Z));
    let all = Curve::new(vec![DVec3::ONE; 5]).unwrap();
    assert_eq!((all.start_tangent(), all.end_tangent()), (None, None));
}

#[test]
fn doors() {
    assert!(matches!(
        Curve::new(vec![DVec3::ZERO, DVec3::new(0.0, 0.0, f64::NAN)]),
        Err(ShapeError::Coordinate { place: 1, axis: 2, .. })
    ));
    assert!(matches!(
        Curve::new(vec![DVec3::splat(1e200)]),
        Err(ShapeError::Coordinate { place: 0, axis: 0, .. })
    ));
    assert!(matches!(Patch::new([usize::MAX, 1], vec![]), Err(ShapeError::Degree { .. })));
    assert!(matches!(Patch::new([0, 0], vec![]), Err(ShapeError::NetSize { needed: 1, given: 0, .. })));
    assert!(matches!(Patch::new([0, 0], vec![DVec3::NAN]), Err(ShapeError::Coordinate { .. })));
    let c = Curve::new(vec![DVec3::ZERO, DVec3::X]).unwrap();
    assert!(c.elevated(usize::MAX).is_err());
    assert!(matches!(c.split(1e300), Err(ShapeError::Coordinate { .. })));
    let patch = Patch::new([0, 1], vec![DVec3::ZERO, DVec3::X]).unwrap();
    assert_eq!(
        (patch.control_point(0, 1), patch.control_point(0, 2), patch.control_point(1, 0)),
        (Some(DVec3::X), None, None)
    );
}

#[test]
fn patch_with_a_collapsed_edge_has_its_limit_normal() {
    // An eighth of something round: the edge v = 1 is the point (0, 0, 1), where every meridian arrives
    // horizontally.
    let net = [
        [DVec3::X, DVec3::new(1.0, 0.0, 1.0), DVec3::Z],
        [DVec3::new(1.0, 1.0, 0.0), DVec3::ONE, DVec3::Z],
        [DVec3::Y, DVec3::new(0.0, 1.0, 1.0), DVec3::Z],
    ];
    let patch = Patch::new([2, 2], net.concat()).unwrap();
    for u in [0.0, 0.25, 0.5, 1.0] {
        assert_eq!(patch.jet(u, 1.0).normal(), None);
        assert!(angle_degrees(patch.normal(u, 1.0).unwrap(), DVec3::Z) < 1e-12, "{u}");
        assert!(angle_degrees(patch.normal(u, 1.0 - 1e-7).unwrap(), DVec3::Z) < 1e-4);
    }
    assert_eq!(patch.normal(0.5, 0.5), patch.jet(0.5, 0.5).normal_toward(DVec2::X));
}

/// Curvatures of exact cases: within 1e-11 of their size, in the unit that the case itself sets.
#[test]
fn golden_geometry() {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/goldens/patches.json");
    let Ok(text) = std::fs::read_to_string(&path) else {
        println!("goldens absent: {}", path.display());
        return;
    };
    let file: Value = serde_json::from_str(&text).unwrap();
    let number = |v: &Value| v.as_f64().unwrap_or_else(|| v.as_str().unwrap().parse().unwrap());
    let vector = |v: &Value| DVec3::new(number(&v[0]), number(&v[1]), number(&v[2]));
    let mut seen = 0;
    for case in file["cases"].as_array().unwrap().iter().filter(|c| c["dim"] == 3) {
        let degrees = [0, 1].map(|i| case["degree"][i].as_u64().unwrap() as usize);
        let rows = case["control_points"].as_array().unwrap();
        let net: Vec<DVec3> = rows.iter().flat_map(|r| r.as_array().unwrap()).map(vector).collect();
        let patch = Patch::new(degrees, net).unwrap();
        for sample in case["samples"].as_array().unwrap() {
            let [u, v] = [0, 1].map(|i| number(&sample["params"][i]));
            let jet = patch.jet(u, v);
            if sample["normal"].is_null() {
                assert!(jet.normal().is_none(), "{} at {u}, {v}", case["name"]);
                continue;
            }
            seen += 1;
            let c = jet.curvatures().unwrap();
            let plane = jet.tangent_plane().unwrap();
            assert!(jet.normal().unwrap().distance(vector(&sample["normal"])) < 1e-12);
            let size = c.principal[0].abs().max(c.principal[1].abs())
                + 1.0 / (1.0 + patch.bounding_box().diagonal());
            let close = |got: f64, key: &str, scale: f64| {
                let exact = number(&sample[key]);
                assert!(
                    (got - exact).abs() < 1e-11 * scale,
                    "{} at {u}, {v}: {key} {got:e}, not {exact:e}",
                    case["name"]
                );
            };
            close(c.gaussian, "gaussian", size * size);
            close(c.mean, "mean", size);
            close(plane.offset, "plane_d", 1.0 + patch.bounding_box().diagonal());
            for (i, k) in c.principal.iter().enumerate() {
                assert!((k - number(&sample["principal"][i])).abs() < 1e-11 * size);
            }
            let (one, two) = (jet.first_form(), jet.second_form().unwrap());
            for (i, x) in [one.e, one.f, one.g].into_iter().enumerate() {
                assert!((x - number(&sample["first_form"][i])).abs() < 1e-13 * (1.0 + one.e + one.g));
            }
            let largest = two.l.abs().max(two.m.abs()).max(two.n.abs()).max(1.0);
            for (i, x) in [two.l, two.m, two.n].into_iter().enumerate() {
                assert!((x - number(&sample["second_form"][i])).abs() < 1e-12 * largest);
            }
        }
    }
    assert!(seen > 5);
}
