//! Exact values, made with seventy digits' care by two bases that agree.

use std::f64::consts::PI;
use std::path::PathBuf;

use casteljau_domain::glam::{DVec2, dvec2};
use casteljau_domain::{Coordinates, HarmonicOptions, Location, Polygon};
use serde_json::Value;

use crate::shapes::{clearance, rows};

/// One polygon with its points.
struct Golden {
    name: String,
    polygon: Polygon,
    /// How far the exact values may be off themselves.
    bound: f64,
    points: Vec<Point>,
}

struct Point {
    kind: String,
    at: DVec2,
    /// Values, ∂u, ∂v; the latter are absent at corners.
    rows: [Option<Vec<f64>>; 3],
}

fn numbers(value: &Value) -> Option<Vec<f64>> {
    value.as_array()?.iter().map(Value::as_f64).collect()
}

fn pair(value: &Value) -> DVec2 {
    let v = numbers(value).unwrap();
    dvec2(v[0], v[1])
}

fn goldens() -> Vec<Golden> {
    let mut all = Vec::new();
    for (folder, outline) in [("coords", "polygon"), ("concave", "domain")] {
        let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/goldens/gb").join(folder);
        let Ok(entries) = path.read_dir() else {
            println!("goldens are absent, nothing compared");
            return all;
        };
        let mut files: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).collect();
        files.sort();
        for file in files {
            let case: Value = serde_json::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap();
            let point = |p: &Value| {
                let exact = if folder == "coords" { p } else { &p["exact"] };
                let keys =
                    if folder == "coords" { ["lambda", "du", "dv"] } else { ["bary", "bary_du", "bary_dv"] };
                Point {
                    kind: p["kind"].as_str().unwrap().to_string(),
                    at: pair(&p["uv"]),
                    rows: keys.map(|key| numbers(&exact[key])),
                }
            };
            all.push(Golden {
                name: format!("{folder}/{}", case["id"].as_str().unwrap()),
                polygon: Polygon::new(case[outline].as_array().unwrap().iter().map(pair).collect()).unwrap(),
                bound: case["lambda_bound"].as_f64().unwrap(),
                points: case["points"].as_array().unwrap().iter().map(point).collect(),
            });
        }
    }
    assert!(all.is_empty() || all.len() >= 13, "{} goldens only", all.len());
    all
}

/// Compares; returns the largest error of a value.
///
/// The error of λ is harmonic inside and at most M = certificate + bound of the golden, so at the distance r from the
/// boundary its gradient is at most (4/π) M/r. On a side no bound of the slope across follows; it is compared to a
/// hundred times M by the distance to the nearest corner.
fn compare(golden: &Golden, coordinates: &Coordinates, allowed: f64) -> f64 {
    let (n, polygon) = (golden.polygon.len(), &golden.polygon);
    let mut largest = 0.0_f64;
    let both = coordinates.certificate() + golden.bound;
    for point in &golden.points {
        let place = || format!("{} {} {}", golden.name, point.kind, point.at);
        let location = polygon.locate(point.at);
        let values = point.rows[0].as_ref().unwrap();
        let mut located = vec![0.0; n];
        coordinates.evaluate(&[point.at], 0, &mut located).unwrap();
        let free = rows(coordinates, point.at, 1);
        for (j, exact) in values.iter().enumerate() {
            if matches!(location, Location::Inside(_)) {
                assert_eq!(located[j].to_bits(), free[j].to_bits(), "{}", place());
            } else {
                assert!((located[j] - exact).abs() <= 1e-14, "{}: {} for {exact}", place(), located[j]);
            }
            let error = (free[j] - exact).abs();
            assert!(error <= allowed, "{}: value {j} is off by {error:.2e}", place());
            assert!(error <= both, "{}: {error:.2e}, certificate {both:.2e}", place());
            largest = largest.max(error);
        }
        let slack = match location {
            Location::Inside(p) => 4.0 / PI * both / clearance(polygon, p),
            Location::Side { .. } => {
                let corner =
                    polygon.vertices().iter().map(|v| v.distance(point.at)).fold(f64::INFINITY, f64::min);
                100.0 * both / corner
            }
            _ => continue,
        };
        let mut computed = vec![0.0; 3 * n];
        coordinates.evaluate(&[point.at], 1, &mut computed).unwrap();
        for row in [1, 2] {
            let Some(exact) = &point.rows[row] else { continue };
            for j in 0..n {
                let error = (computed[row * n + j] - exact[j]).abs();
                assert!(error <= slack, "{}: gradient {j} is off by {error:.2e} of {slack:.2e}", place());
            }
        }
    }
    largest
}

#[test]
fn values_and_gradients_of_the_goldens() {
    for golden in goldens() {
        let plain = Coordinates::harmonic(golden.polygon.clone(), &HarmonicOptions::default()).unwrap();
        let error = compare(&golden, &plain, 1e-8);
        let fine = Coordinates::harmonic(golden.polygon.clone(), &HarmonicOptions::high_accuracy()).unwrap();
        let least = compare(&golden, &fine, golden.bound.max(1e-10));
        println!(
            "{:30} certificate {:.1e}, error {error:.1e}; high accuracy {:.1e}, {least:.1e}; golden {:.1e}",
            golden.name,
            plain.certificate(),
            fine.certificate(),
            golden.bound
        );
        assert!(plain.certificate() <= 1e-8, "{}: {:e}", golden.name, plain.certificate());
        assert!(fine.certificate() <= 1e-10, "{}: {:e}", golden.name, fine.certificate());
    }
}

/// The comparison would notice: a certificate of 1e-3 leaves errors that 1e-8 does not allow.
#[test]
fn coarse_coordinates_miss_the_goldens_by_no_more_than_they_say() {
    for golden in goldens() {
        let coarse = HarmonicOptions { target: 1e-3, limit: 1e-3 };
        let coordinates = Coordinates::harmonic(golden.polygon.clone(), &coarse).unwrap();
        let error = compare(&golden, &coordinates, 1e-3);
        println!("{:30} certificate {:.1e}, error {error:.1e}", golden.name, coordinates.certificate());
    }
}
