//! `casteljau mesh` of solids: their surface, a slice, cells.
#![allow(missing_docs, clippy::unwrap_used)]

use std::process::Command;

use serde_json::Value;

const BALL: &str = r#"{"casteljau": 1, "shapes": [{"kind": "rotational_solid", "curve": {"kind": "curve", "degree": 3,
  "control_points": [[0, 0, -1], [2, 0, -1], [2, 0, 1], [0, 0, 1]], "weights": [3, 1, 1, 3]}}]}"#;

/// The exit status, the JSON, and what was said on standard error.
fn mesh(name: &str, ending: &str, arguments: &[&str]) -> (Option<i32>, Value, String) {
    let place = tempfile::tempdir().unwrap();
    let (model, out) = (place.path().join("ball.json"), place.path().join(format!("{name}.{ending}")));
    std::fs::write(&model, BALL).unwrap();
    let done = Command::new(env!("CARGO_BIN_EXE_casteljau"))
        .args(["mesh", "--json", "-o"])
        .args([&out, &model])
        .args(arguments)
        .output()
        .unwrap();
    assert_eq!(out.exists(), done.status.success());
    let json = serde_json::from_slice(&done.stdout).unwrap_or(Value::Null);
    (done.status.code(), json, String::from_utf8(done.stderr).unwrap())
}

#[test]
fn a_ball_has_a_surface_a_slice_and_cells() {
    let ball = 4.0 / 3.0 * std::f64::consts::PI;
    let (status, report, _) = mesh("surface", "obj", &["--tolerance", "1e-2"]);
    assert_eq!(
        (status, report["closed"].as_bool(), report["collapsed_faces"].as_u64()),
        (Some(0), Some(true), Some(2))
    );
    assert!((report["volume"].as_f64().unwrap() - ball).abs() < 1e-2 * 4.0 * std::f64::consts::PI);

    let (status, report, _) = mesh("slice", "stl", &["--slice", "0,0,-2,-1", "--tolerance", "1e-2"]);
    assert_eq!((status, report["outlines"].as_u64()), (Some(0), Some(1)));
    let circle = 0.75 * std::f64::consts::PI;
    assert!((report["area"].as_f64().unwrap() - circle).abs() < 1e-2 * 2.0 * std::f64::consts::PI);

    let (status, report, _) = mesh("cells", "vtu", &["--volume", "--resolution", "6"]);
    assert_eq!(
        (status, report["pyramids"].as_u64(), report["hexahedra"].as_u64()),
        (Some(0), Some(72), Some(144))
    );
    let (status, report, _) = mesh("cells", "vtu", &["--volume", "--tetrahedra", "--tolerance", "0.1"]);
    assert_eq!(
        (status, report["conforming"].as_bool(), report["hexahedra"].as_u64()),
        (Some(0), Some(true), Some(0))
    );
    assert!(report["chord_error"].as_f64().unwrap() <= 0.1);
}

#[test]
fn what_does_not_fit_together_is_usage() {
    for (ending, arguments) in [
        ("obj", &["--slice", "0,0,1"][..]),
        ("obj", &["--slice", "0,0,1,0", "--resolution", "4"]),
        ("obj", &["--volume"]),
        ("vtu", &["--tetrahedra"]),
    ] {
        let (status, _, said) = mesh("nothing", ending, arguments);
        assert_eq!(status, Some(2), "{arguments:?}: {said}");
    }
    let (status, _, said) = mesh("nothing", "obj", &["--slice", "0,0,0,1"]);
    assert_eq!(status, Some(1));
    assert!(said.contains("there is no plane"), "{said}");
}
