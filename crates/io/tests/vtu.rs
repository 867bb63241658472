//! Bézier cells for VTK: order of nodes, and the file read back by a reader of our own.
#![allow(clippy::unwrap_used, clippy::panic)]

use casteljau_io::model::Model;
use casteljau_io::vtu::{self, curve_order, quadrilateral_order, triangle_order};
use serde_json::Value;

/// The tables verified with VTK itself.
#[test]
fn orders_are_those_of_vtk() {
    let path =
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/goldens/vtk_order.json");
    let Ok(text) = std::fs::read_to_string(&path) else {
        println!("goldens absent: {}", path.display());
        return;
    };
    let file: Value = serde_json::from_str(&text).unwrap();
    let mut seen = [0; 3];
    for case in file["cases"].as_array().unwrap() {
        let degree: Vec<usize> = serde_json::from_value(case["degree"].clone()).unwrap();
        let ours = match case["cell"].as_str().unwrap() {
            "VTK_BEZIER_CURVE" => {
                seen[0] += 1;
                serde_json::to_value(curve_order(degree[0]).iter().map(|i| [i]).collect::<Vec<_>>())
            }
            "VTK_BEZIER_TRIANGLE" => {
                seen[1] += 1;
                serde_json::to_value(triangle_order(degree[0]))
            }
            "VTK_BEZIER_QUADRILATERAL" => {
                seen[2] += 1;
                serde_json::to_value(quadrilateral_order([degree[0], degree[1]]))
            }
            _ => continue,
        };
        assert_eq!(ours.unwrap(), case["order"], "{} {degree:?}", case["cell"]);
    }
    assert!(seen.iter().all(|&count| count >= 5), "{seen:?}");
}

#[test]
fn every_point_once() {
    for n in 1..13 {
        let mut triangle = triangle_order(n);
        triangle.sort_unstable();
        triangle.dedup();
        assert!(triangle.iter().all(|index| index.iter().sum::<usize>() == n));
        assert_eq!(triangle.len(), (n + 1) * (n + 2) / 2);
        for m in 1..6 {
            let mut patch = quadrilateral_order([m, n]);
            patch.sort_unstable();
            patch.dedup();
            assert_eq!(patch.len(), (m + 1) * (n + 1));
        }
    }
}

fn written(shapes: &str) -> Result<String, String> {
    let model = Model::read(&format!("{{\"casteljau\": 1, \"shapes\": [{shapes}]}}"), "m.json").unwrap();
    let mut out = Vec::new();
    vtu::write(&model, &mut out).map_err(|error| error.to_string())?;
    Ok(String::from_utf8(out).unwrap())
}

/// The numbers of an array.
fn array(file: &str, name: &str) -> Vec<f64> {
    let start = file.find(&format!("Name=\"{name}\"")).unwrap();
    let body = &file[start..][file[start..].find('>').unwrap() + 1..];
    body[..body.find("</DataArray>").unwrap()].split_whitespace().map(|word| word.parse().unwrap()).collect()
}

#[test]
fn cells_of_all_kinds() {
    let file = written(
        r#"{"kind": "curve", "degree": 0, "control_points": [[7, 8, 9]]},
        {"kind": "curve", "degree": 2, "control_points": [[0.1, 0, 0], [1, 1, 0], [2, 0, 0]], "weights": [1, 0, -3]},
        {"kind": "power_curve", "coefficients": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "interval": [0, 2]},
        {"kind": "patch", "degree": [1, 0], "control_points": [[[0, 0, 0]], [[5, 0, 0]]]},
        {"kind": "triangle", "degree": 1, "homogeneous": [[2, 0, 0, 2], [0, 4, 0, 4], [0, 0, 0, 0]]}"#,
    )
    .unwrap();
    assert!(file.contains("<VTKFile type=\"UnstructuredGrid\" version=\"2.2\""));
    assert!(file.contains("NumberOfPoints=\"15\" NumberOfCells=\"5\""));
    assert!(file.contains("<PointData RationalWeights=\"RationalWeights\">"));
    assert!(file.contains("<CellData HigherOrderDegrees=\"HigherOrderDegrees\">"));
    let points = [
        [7., 8., 9.],
        [7., 8., 9.],
        [0.1, 0., 0.],
        [2., 0., 0.],
        [1., 1., 0.],
        [0., 0., 0.],
        [2., 4., 0.],
        [1., 0., 0.],
        [0., 0., 0.],
        [5., 0., 0.],
        [5., 0., 0.],
        [0., 0., 0.],
        [0., 0., 0.],
        [1., 0., 0.],
        [0., 1., 0.],
    ];
    assert_eq!(array(&file, "Points"), points.as_flattened());
    let weights = [1., 1., 1., -3., 0., 1., 1., 1., 1., 1., 1., 1., 0., 2., 4.];
    assert_eq!(array(&file, "RationalWeights"), weights);
    assert_eq!(array(&file, "offsets"), [2., 5., 8., 12., 15.]);
    assert_eq!(array(&file, "types"), [75., 75., 75., 77., 76.]);
    assert_eq!(array(&file, "connectivity"), (0..15).map(f64::from).collect::<Vec<_>>());
    let degrees = [1., 0., 0., 2., 0., 0., 2., 0., 0., 1., 1., 0., 1., 1., 0.];
    assert_eq!(array(&file, "HigherOrderDegrees"), degrees);
}

#[test]
fn what_vtk_cannot_hold_is_refused_at_its_place() {
    let infinite = r#"{"kind": "patch", "degree": [0, 1], "homogeneous": [[[0, 0, 0, 1], [1, 0, 0, 0]]]}"#;
    let message = written(infinite).unwrap_err();
    assert!(
        message.contains("m.json:1: shapes[0].homogeneous[0][1]: ") && message.contains("at infinity"),
        "{message}"
    );
    let gb = r#"{"kind": "gb_patch", "ribbons": [{"control_points": [[[0, 0, 0], [1, 0, 0]]]},
        {"control_points": [[[1, 0, 0], [0, 1, 0]]]}, {"control_points": [[[0, 1, 0], [0, 0, 0.1]]]}]}"#;
    let message = written(gb).unwrap_err();
    assert!(message.contains("m.json:1: shapes[0].kind: ") && message.contains("GB patches"), "{message}");
}
