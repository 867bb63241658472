//! Bézier cells for VTK: order of nodes, what is written, and what is refused.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use casteljau_io::NetRecord;
use casteljau_io::model::{Model, NamedShape, Shape};
use casteljau_io::vtu::{
    self, curve_order, hexahedron_order, old_hexahedron_order, quadrilateral_order, tetrahedron_order,
    triangle_order, wedge_order,
};
use common::{classical, solid};
use proptest::prelude::*;
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
    let cases = file["cases"].as_array().unwrap();
    for case in cases {
        let degree: Vec<usize> = serde_json::from_value(case["degree"].clone()).unwrap();
        let cell = case["cell"].as_str().unwrap();
        let ours = match (cell, &degree[..]) {
            ("VTK_BEZIER_CURVE", &[n]) => {
                serde_json::to_value(curve_order(n).iter().map(|i| [i]).collect::<Vec<_>>())
            }
            ("VTK_BEZIER_TRIANGLE", &[n]) => serde_json::to_value(triangle_order(n)),
            ("VTK_BEZIER_QUADRILATERAL", &[m, n]) => serde_json::to_value(quadrilateral_order([m, n])),
            ("VTK_BEZIER_TETRAHEDRON", &[n]) => serde_json::to_value(tetrahedron_order(n)),
            ("VTK_BEZIER_HEXAHEDRON", &[l, m, n]) => serde_json::to_value(hexahedron_order([l, m, n])),
            ("VTK_BEZIER_WEDGE", &[n, _, o]) => {
                let order = wedge_order([n, o]).into_iter().map(|([i, j, _], k)| [i, j, k]);
                serde_json::to_value(order.collect::<Vec<_>>())
            }
            _ => panic!("{cell} of degree {degree:?}"),
        };
        assert_eq!(ours.unwrap(), case["order"], "{cell} {degree:?}");
    }
    assert_eq!(cases.len(), 44);
    println!("{} tables of VTK's order of nodes compared", cases.len());
}

/// Whether every index of a net is there once.
fn once<T: Ord>(mut order: Vec<T>, count: usize) -> bool {
    order.sort_unstable();
    order.dedup();
    order.len() == count
}

#[test]
fn every_point_once() {
    for n in 1..13 {
        let triangle = triangle_order(n);
        assert!(triangle.iter().all(|index| index.iter().sum::<usize>() == n));
        assert!(once(triangle, (n + 1) * (n + 2) / 2));
        let tetrahedron = tetrahedron_order(n);
        assert!(tetrahedron.iter().all(|index| index.iter().sum::<usize>() == n));
        assert!(once(tetrahedron, (n + 1) * (n + 2) * (n + 3) / 6));
        for m in 1..6 {
            assert!(once(quadrilateral_order([m, n]), (m + 1) * (n + 1)));
            assert!(once(wedge_order([n, m]), (n + 1) * (n + 2) / 2 * (m + 1)));
            for order in [hexahedron_order, old_hexahedron_order] {
                assert!(once(order([n, m, 3]), (n + 1) * (m + 1) * 4));
            }
        }
    }
}

fn written(shapes: &str) -> Result<String, String> {
    let model = Model::read(&format!("{{\"casteljau\": 1, \"shapes\": [{shapes}]}}"), "m.json").unwrap();
    file(&model)
}

fn file(model: &Model) -> Result<String, String> {
    let mut out = Vec::new();
    vtu::write(model, &mut out).map_err(|error| error.to_string())?;
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
fn solids_are_cells() {
    let file = written(
        r#"{"kind": "tetrahedron", "degree": 1, "control_points": [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]]},
        {"kind": "hexahedron", "degree": [0, 1, 2], "control_points": [[[[0, 0, 0], [0, 0, 1], [0, 0, 2]],
          [[0, 1, 0], [0, 1, 1], [0, 1, 2]]]]},
        {"kind": "wedge", "degree": [1, 1], "homogeneous": [[[2, 0, 0, 2], [2, 0, 2, 2]], [[0, 1, 0, 1], [0, 1, 1, 1]],
          [[0, 0, 0, 1], [0, 0, 1, 1]]]},
        {"kind": "rotational_solid", "curve": {"degree": 1, "control_points": [[1, 0, 0], [2, 0, 1]]}},
        {"kind": "tetrahedron", "degree": 0, "control_points": [[4, 5, 6]]}"#,
    )
    .unwrap();
    assert_eq!(array(&file, "types"), [78., 79., 80., 79., 78.]);
    let degrees = [1., 1., 1., 1., 1., 2., 1., 1., 1., 2., 2., 1., 1., 1., 1.];
    assert_eq!(array(&file, "HigherOrderDegrees"), degrees);
    assert_eq!(array(&file, "offsets"), [4., 16., 22., 40., 44.]);
    let points = array(&file, "Points");
    assert_eq!(points[..12], [0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1.]);
    // The hexahedron's corners: of degree 0 with u, both ends are one.
    assert_eq!(points[12..24], [0., 0., 0., 0., 0., 0., 0., 1., 0., 0., 1., 0.]);
    assert_eq!(array(&file, "RationalWeights")[16..22], [1., 2., 1., 1., 2., 1.]);
    // The corners of the rotational solid's disc.
    assert_eq!(array(&file, "RationalWeights")[22..26], [1., 2., 4., 2.]);
}

#[test]
fn what_vtk_cannot_hold_is_refused_at_its_place() {
    let infinite = r#"{"kind": "patch", "degree": [0, 1], "homogeneous": [[[0, 0, 0, 1], [1, 0, 0, 0]]]}"#;
    let message = written(infinite).unwrap_err();
    assert!(
        message.contains("m.json:1: shapes[0].homogeneous[0][1]: ") && message.contains("at infinity"),
        "{message}"
    );
    let infinite = r#"{"kind": "hexahedron", "degree": [0, 1, 1], "homogeneous":
        [[[[0, 0, 0, 1], [1, 0, 0, 1]],
          [[1, 0, 0, 1], [1, 0, 0, 0]]]]}"#;
    let message = written(infinite).unwrap_err();
    assert!(message.contains("m.json:3: shapes[0].homogeneous[0][1][1]: "), "{message}");
    let swept = r#"{"kind": "rotational_solid", "curve": {"degree": 1, "homogeneous": [[1, 0, 0, 1], [0, 0, 1, 0]]}}"#;
    let message = written(swept).unwrap_err();
    assert!(message.contains("m.json:1: shapes[0]: ") && message.contains("at infinity"), "{message}");
    let gb = r#"{"kind": "gb_patch", "ribbons": [{"control_points": [[[0, 0, 0], [1, 0, 0]]]},
        {"control_points": [[[1, 0, 0], [0, 1, 0]]]}, {"control_points": [[[0, 1, 0], [0, 0, 0.1]]]}]}"#;
    let message = written(gb).unwrap_err();
    assert!(message.contains("m.json:1: shapes[0].kind: ") && message.contains("GB patches"), "{message}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// File, shapes, file: the same bytes. Shapes, file, shapes: the same bits, where they were points with weights.
    #[test]
    fn round_trips(shapes in prop::collection::vec(prop_oneof![classical(), solid()], 1..4)) {
        let shapes = shapes.into_iter().map(|shape| NamedShape::new(None, shape));
        let model = Model { shapes: shapes.collect() };
        // Control points at infinity have no place in these files.
        if let Ok(text) = file(&model) {
            let again = vtu::read(text.as_bytes(), "again.vtu").unwrap();
            prop_assert_eq!(file(&again).unwrap(), text);
            for (shape, again) in model.shapes.iter().zip(&again.shapes) {
                if let Some(net) = kept(&shape.shape) {
                    prop_assert_eq!(format!("{:?}", Some(net)), format!("{:?}", kept(&again.shape)));
                }
            }
        }
    }

    /// Bytes changed, cut out and doubled: an error that names the file, or a model; nothing else.
    #[test]
    fn damaged_files(
        shape in solid(),
        wounds in prop::collection::vec((any::<prop::sample::Index>(), 0..4_u8, any::<u8>()), 1..4),
    ) {
        let Ok(text) = file(&Model { shapes: vec![NamedShape::new(None, shape)] }) else { return Ok(()) };
        let mut bytes = text.into_bytes();
        for (place, how, byte) in wounds {
            let at = place.index(bytes.len());
            match how {
                0 => bytes[at] = byte,
                1 => bytes.truncate(at + 1),
                2 => drop(bytes.remove(at)),
                _ => bytes.insert(at, bytes[at]),
            }
            if bytes.is_empty() {
                bytes.push(byte);
            }
        }
        if let Err(error) = vtu::read(&bytes, "damaged") {
            let message = error.to_string();
            prop_assert!(message.starts_with("damaged:") && message.len() < 600, "{}", message);
        }
    }
}

/// The net of a shape that a file holds to the bit: points, with weights or without, and no degree of 0.
fn kept(shape: &Shape) -> Option<&NetRecord> {
    let (net, degrees) = match shape {
        Shape::Curve(curve) => (&curve.net, vec![curve.net.len() - 1]),
        Shape::Patch(patch) => (&patch.net, patch.degrees.to_vec()),
        Shape::Triangle(triangle) => (&triangle.net, vec![triangle.degree]),
        Shape::Tetrahedron(solid) => (&solid.net, vec![solid.degree]),
        Shape::Hexahedron(solid) => (&solid.net, solid.degrees.to_vec()),
        Shape::Wedge(solid) => (&solid.net, solid.degrees.to_vec()),
        _ => return None,
    };
    (!matches!(net, NetRecord::Homogeneous(_)) && !degrees.contains(&0)).then_some(net)
}
