//! The published models over their domains: exact coordinates in, exact points out.
#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod common;

use std::path::PathBuf;

use casteljau_gb::glam::{DVec2, DVec3, dvec2, dvec3};
use casteljau_gb::{CenterWeight, ConcavePatch, CoordinateKind, GbError, Polygon, Ribbon};
use serde_json::Value;

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

fn point(value: &Value) -> DVec3 {
    let x = numbers(value);
    dvec3(x[0], x[1], x[2])
}

/// Every case of the folder, or none where it is missing.
fn cases() -> Vec<Value> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/goldens/gb/concave");
    let Ok(entries) = std::fs::read_dir(&folder) else {
        println!("goldens absent: {} is missing, nothing checked", folder.display());
        return Vec::new();
    };
    let mut paths: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).collect();
    paths.sort();
    paths.iter().map(|p| serde_json::from_str(&std::fs::read_to_string(p).unwrap()).unwrap()).collect()
}

fn patch(case: &Value, kind: CoordinateKind, accuracy: f64) -> Result<ConcavePatch, GbError> {
    let mut ribbons = Vec::new();
    for rows in case["ribbons"].as_array().unwrap() {
        let rows: Vec<Vec<DVec3>> = rows
            .as_array()
            .unwrap()
            .iter()
            .map(|row| row.as_array().unwrap().iter().map(point).collect())
            .collect();
        ribbons.push(Ribbon::new(rows[0].len() - 1, rows.len(), rows.concat())?);
    }
    let vertices: Vec<DVec2> =
        case["domain"].as_array().unwrap().iter().map(numbers).map(|v| dvec2(v[0], v[1])).collect();
    let weight = match case["central_weight"].as_str().unwrap() {
        "deficiency" => CenterWeight::Deficiency,
        _ => CenterWeight::None,
    };
    ConcavePatch::builder(ribbons)
        .domain(Polygon::new(vertices).unwrap())
        .coordinates(kind)
        .accuracy(accuracy)
        .center(point(&case["central_control_point"]))
        .center_weight(weight)
        .build()
}

#[test]
fn surface_from_exact_coordinates() {
    for case in cases() {
        // The coordinates come from the file: which kind the patch would use itself does not matter.
        let patch = patch(&case, CoordinateKind::MeanValue, 1e-8).unwrap();
        let diagonal = case["bbox_diagonal"].as_f64().unwrap();
        let tolerance = case["suggested_tolerance"]["exact.xyz_over_diag"].as_f64().unwrap();
        for at in case["points"].as_array().unwrap() {
            let lambda = numbers(&at["exact"]["bary"]);
            let expected = point(&at["exact"]["xyz"]);
            let found = patch.point_from_coordinates(&lambda).unwrap();
            let error = found.distance(expected) / diagonal;
            assert!(error <= tolerance, "{} {} {}: {error:e}", case["id"], at["kind"], at["uv"]);
            if !lambda.contains(&0.0) {
                assert!(found.distance(common::plain(&patch, &lambda)) < 1e-13 * diagonal);
            }
        }
    }
}

/// First derivatives, from the exact gradients, against differences of the formula along those gradients.
#[test]
fn gradients_from_exact_coordinates() {
    for case in cases() {
        let patch = patch(&case, CoordinateKind::MeanValue, 1e-8).unwrap();
        let n = patch.sides();
        for at in case["points"].as_array().unwrap() {
            let lambda = numbers(&at["exact"]["bary"]);
            if at["kind"] != "interior" || lambda.iter().any(|&x| x < 1e-3) {
                continue;
            }
            let gradient = [numbers(&at["exact"]["bary_du"]), numbers(&at["exact"]["bary_dv"])];
            let mut rows = lambda.clone();
            rows.extend(gradient.iter().flatten());
            rows.resize(6 * n, 0.0);
            let jet = patch.jet_from_coordinates(&rows).unwrap();
            for (found, gradient) in [jet.du, jet.dv].iter().zip(&gradient) {
                let step = 1e-5;
                let shifted = |e: f64| {
                    let moved: Vec<f64> = lambda.iter().zip(gradient).map(|(x, g)| x + e * g).collect();
                    patch.point_from_coordinates(&moved).unwrap()
                };
                let coarse = (shifted(step) - shifted(-step)) / (2.0 * step);
                let fine = (shifted(step / 2.0) - shifted(-step / 2.0)) / step;
                let expected = (fine * 4.0 - coarse) / 3.0;
                assert!(found.distance(expected) < 1e-7 * expected.length(), "{} {}", case["id"], at["uv"]);
            }
        }
    }
}

/// The whole way: our own harmonic coordinates.
#[test]
fn surface_from_our_coordinates() {
    for case in cases() {
        let patch = patch(&case, CoordinateKind::Harmonic, 1e-8).unwrap();
        let diagonal = case["bbox_diagonal"].as_f64().unwrap();
        let bound = 1e-8f64.max(case["suggested_tolerance"]["exact.xyz_over_diag"].as_f64().unwrap());
        for at in case["points"].as_array().unwrap() {
            let uv = numbers(&at["uv"]);
            let found = patch.point(dvec2(uv[0], uv[1])).unwrap();
            let error = found.distance(point(&at["exact"]["xyz"])) / diagonal;
            assert!(error <= bound, "{} {} {uv:?}: {error:e}", case["id"], at["kind"]);
        }
    }
}
