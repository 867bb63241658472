//! Reading the exact cases, and what properties are tried with.
#![allow(dead_code)] // every test file uses its own share of this

// The exact arithmetic of the kernels' tests.
#[path = "../../../bernstein/tests/support/exact.rs"]
pub mod exact;
#[path = "../../../bernstein/tests/support/rational.rs"]
pub mod rational;

use std::path::PathBuf;

use casteljau_geom::glam::{DVec3, DVec4};
use casteljau_geom::{UNIT_ROUNDOFF, rounding_bound};
use proptest::prelude::*;
use serde_json::Value;

/// Unit roundoff.
pub const U: f64 = UNIT_ROUNDOFF;

/// The cases of one golden file; none where the goldens are absent.
pub fn cases(name: &str) -> Vec<Value> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/goldens").join(name);
    let Ok(text) = std::fs::read_to_string(&path) else {
        println!("goldens absent: {}", path.display());
        return Vec::new();
    };
    let file: Value = serde_json::from_str(&text).unwrap();
    let cases = file["cases"].as_array().unwrap().clone();
    assert!(!cases.is_empty(), "{name}");
    cases
}

/// A number, given as such or as a decimal string.
pub fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| value.as_str().unwrap().parse().unwrap())
}

pub fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(number).collect()
}

pub fn size(value: &Value) -> usize {
    usize::try_from(value.as_u64().unwrap()).unwrap()
}

/// A point on the line, in the plane or in space.
pub fn point(value: &Value) -> DVec3 {
    let x = numbers(value);
    DVec3::from_array(std::array::from_fn(|axis| x.get(axis).copied().unwrap_or(0.0)))
}

/// All numbers of a nested list.
pub fn flat(value: &Value) -> Vec<f64> {
    match value.as_array() {
        Some(list) => list.iter().flat_map(flat).collect(),
        None => vec![number(value)],
    }
}

/// Control points of a net nested to any depth, with coordinates innermost.
pub fn net(value: &Value) -> Vec<DVec3> {
    if value[0].is_array() {
        value.as_array().unwrap().iter().flat_map(net).collect()
    } else {
        vec![point(value)]
    }
}

/// A net with its weights; 1 where none are given.
pub fn weighted_net(case: &Value) -> (Vec<DVec3>, Vec<f64>) {
    let points = net(&case["control_points"]);
    let weights = if case["weights"].is_null() { vec![1.0; points.len()] } else { flat(&case["weights"]) };
    (points, weights)
}

/// The orders of a key such as "1,2".
pub fn orders<const N: usize>(key: &str) -> [usize; N] {
    let mut parts = key.split(',').map(|k| k.parse().unwrap());
    std::array::from_fn(|_| parts.next().unwrap())
}

/// `got` within `4(degree + 2 order + 2)·u·scale` of the exact value in every component; `exact` itself is
/// rounded once.
#[track_caller]
pub fn assert_accurate(got: DVec3, exact: DVec3, degree: usize, order: usize, scale: DVec3, what: &str) {
    for axis in 0..3 {
        let (got, exact, scale) = (got[axis], exact[axis], scale[axis]);
        let allowed = rounding_bound(degree, order, scale) + UNIT_ROUNDOFF * exact.abs() + f64::MIN_POSITIVE;
        let off = (got - exact).abs();
        assert!(off <= allowed, "{what}: {got:e} instead of {exact:e}, off {off:e}, allowed {allowed:e}");
    }
}

/// Coordinates that hunt: repeats, near-equal values, spread exponents.
pub fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        prop_oneof![Just(0.0), Just(1.0), Just(-1.0), Just(1.0 + 1e-9), Just(f64::MIN_POSITIVE)],
        -1.0..1.0,
        -1e3..1e3,
        (-1.0..1.0, -20..20i32).prop_map(|(m, e)| m * 2_f64.powi(e)),
    ]
}

pub fn space_point() -> impl Strategy<Value = DVec3> {
    (coordinate(), coordinate(), coordinate()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

/// Positive weights from 1e-8 to 1e8, half of them 1 or near it.
pub fn weight() -> impl Strategy<Value = f64> {
    prop_oneof![Just(1.0), Just(1.0 + 1e-12), 0.5..2.0, (-8.0..8.0).prop_map(|e| 10_f64.powf(e))]
}

/// A control point in homogeneous form, its weight of any sign, zero included.
pub fn homogeneous_point() -> impl Strategy<Value = DVec4> {
    let weight = prop_oneof![4 => weight(), 1 => Just(0.0), 1 => weight().prop_map(|w| -w)];
    (space_point(), weight).prop_map(|(p, w)| (p * w).extend(w))
}
