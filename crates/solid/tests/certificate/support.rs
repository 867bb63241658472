//! Nets of solids, and numbers by chance.
#![allow(dead_code)] // every test file uses its own share of this

use std::path::PathBuf;

use casteljau_solid::geom::glam::{DVec3, DVec4};
use serde_json::Value;

/// The cases of one golden file; none where the goldens are absent.
pub fn cases(name: &str) -> Vec<Value> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/goldens").join(name);
    let Ok(text) = std::fs::read_to_string(&path) else {
        println!("GOLDENS ABSENT, nothing was compared: {}", path.display());
        return Vec::new();
    };
    let file: Value = serde_json::from_str(&text).unwrap();
    let cases = file["cases"].as_array().unwrap().clone();
    assert!(!cases.is_empty(), "{name}");
    cases
}

/// All numbers of a nested list, given as such or as decimal strings.
pub fn flat(value: &Value) -> Vec<f64> {
    match value.as_array() {
        Some(list) => list.iter().flat_map(flat).collect(),
        None => vec![value.as_f64().unwrap_or_else(|| value.as_str().unwrap().parse().unwrap())],
    }
}

pub fn sizes(value: &Value) -> Vec<usize> {
    flat(value).into_iter().map(|x| x as usize).collect()
}

pub fn points(value: &Value) -> Vec<DVec3> {
    flat(value).chunks_exact(3).map(DVec3::from_slice).collect()
}

pub fn homogeneous(points: &[DVec3], weights: &[f64]) -> Vec<DVec4> {
    points.iter().zip(weights).map(|(&p, &w)| (p * w).extend(w)).collect()
}

/// The net of the rotational solid of a meridian with weights, its middle weight being `middle` times that of the meridian.
///
/// Degrees (2, 2, n).
pub fn rotational(meridian: &[DVec3], weights: &[f64], middle: f64) -> Vec<DVec4> {
    let mut net = Vec::with_capacity(9 * meridian.len());
    for (i, row_weight) in [1.0, 1.0, 2.0].into_iter().enumerate() {
        for (j, column_weight) in [1.0, 1.0, 2.0].into_iter().enumerate() {
            for (q, &r) in meridian.iter().zip(weights) {
                let (x, y) = (q.x, q.y);
                let (x, y) = match (i, j) {
                    (0, 0) => (x, y),
                    (0, 1) => (x + y, y - x),
                    (1, 0) => (x - y, x + y),
                    (0, 2) => (y, -x),
                    (1, 1) => (0.0, 0.0),
                    (2, 0) => (-y, x),
                    (1, 2) => (y - x, -x - y),
                    (2, 1) => (-x - y, x - y),
                    _ => (-x, -y),
                };
                let share = if (i, j) == (1, 1) { middle } else { row_weight * column_weight };
                let w = r * share;
                net.push(DVec4::new(w * x, w * y, w * q.z, w));
            }
        }
    }
    net
}

/// Numbers by chance, the same on every run (SplitMix64).
pub struct Chance(pub u64);

impl Chance {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * 2_f64.powi(-53)
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// 0 … n − 1.
    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    pub fn point(&mut self, size: f64) -> DVec3 {
        DVec3::new(self.between(-size, size), self.between(-size, size), self.between(-size, size))
    }

    /// A point with integer coordinates from −size to size.
    pub fn grid_point(&mut self, size: usize) -> DVec3 {
        let mut coordinate = || self.below(2 * size + 1) as f64 - size as f64;
        DVec3::new(coordinate(), coordinate(), coordinate())
    }
}
