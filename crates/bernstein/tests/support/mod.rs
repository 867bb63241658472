//! Reading the exact cases, and the numbers that properties are tried with.
#![allow(dead_code)] // every test file uses its own share of this

pub mod exact;
pub mod rational;
pub mod simplices;

use std::path::PathBuf;

use proptest::prelude::*;
use serde_json::Value;

pub const U: f64 = f64::EPSILON / 2.0;

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

/// Component `axis` of a list of points.
pub fn component(points: &Value, axis: usize) -> Vec<f64> {
    points.as_array().unwrap().iter().map(|p| number(&p[axis])).collect()
}

/// `got` within `4(degree + 2 order + 2)·u·scale` of the exact value; `exact` itself is rounded once.
#[track_caller]
pub fn assert_accurate(got: f64, exact: f64, degree: usize, order: usize, scale: f64, what: &str) {
    let allowed = (4 * (degree + 2 * order + 2)) as f64 * U * scale + U * exact.abs() + f64::MIN_POSITIVE;
    let off = (got - exact).abs();
    assert!(off <= allowed, "{what}: {got:e} instead of {exact:e}, off {off:e}, allowed {allowed:e}");
}

/// Numbers that hunt: half of them within 32 ulps of 0, 1, −1 or of a power of two, exponents spread, both signs.
pub fn hunting() -> impl Strategy<Value = f64> {
    let near = prop_oneof![Just(0.0), Just(1.0), Just(-1.0), (-40..40i32).prop_map(|e| 2_f64.powi(e))];
    prop_oneof![
        (near, -32..=32i32).prop_map(|(x, ulps)| x + f64::from(ulps) * U * f64::max(1e-6, x.abs())),
        (-1.0..1.0, -30..30i32).prop_map(|(m, e)| m * 2_f64.powi(e)),
    ]
}

/// Parameters: inside, at, very near and somewhat beyond the ends.
pub fn parameter() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => 0.0..=1.0,
        1 => (0..64i32).prop_map(|k| f64::from(k) * U),
        1 => (0..64i32).prop_map(|k| 1.0 - f64::from(k) * U),
        1 => (0..1000i32).prop_map(|e| 2_f64.powi(-e)),
        1 => -1.0..2.0,
    ]
}

/// The number of control points of a tensor net.
pub fn count(degrees: &[usize]) -> usize {
    degrees.iter().map(|d| d + 1).product()
}

/// The numbers of a nested array, `depth` arrays deep, in order.
pub fn flat(value: &Value, depth: usize) -> Vec<f64> {
    match depth {
        0 => vec![number(value)],
        _ => value.as_array().unwrap().iter().flat_map(|v| flat(v, depth - 1)).collect(),
    }
}
