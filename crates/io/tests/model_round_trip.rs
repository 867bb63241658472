//! Writing what was read gives the same values, to the bit.
#![allow(clippy::unwrap_used, clippy::panic, clippy::unreachable)]

mod common;

use std::path::{Path, PathBuf};

use casteljau_io::cgb;
use casteljau_io::model::{Model, NamedShape, Shape};
use casteljau_io::{
    CenterWeightName, CoordinatesName, GbPatchRecord, Geometry, LayoutRecord, read_model_bytes,
    read_model_file, write_model_file,
};
use common::{classical, record, solid};
use proptest::prelude::*;

/// Unlike `==`, tells −0 from 0.
fn bits(value: &impl std::fmt::Debug) -> String {
    format!("{value:?}")
}

fn json(model: &Model) -> String {
    let mut text = Vec::new();
    model.write(&mut text).unwrap();
    String::from_utf8(text).unwrap()
}

fn records(model: &Model) -> Vec<(Option<String>, Shape)> {
    model.shapes.iter().map(|shape| (shape.name.clone(), shape.shape.clone())).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn model_files(shapes in prop::collection::vec((prop::option::of(any::<String>()), record()), 0..3)) {
        let shapes = shapes.into_iter().map(|(name, record)| NamedShape::new(name, Shape::GbPatch(record)));
        let model = Model { shapes: shapes.collect() };
        let text = json(&model);
        let again = Model::read(&text, "again.json").unwrap();
        prop_assert_eq!(bits(&records(&again)), bits(&records(&model)));
        prop_assert_eq!(json(&again), text);
    }

    #[test]
    fn curves_patches_and_triangles(
        shapes in prop::collection::vec((prop::option::of(any::<String>()), classical()), 1..4),
    ) {
        let shapes = shapes.into_iter().map(|(name, shape)| NamedShape::new(name, shape));
        let model = Model { shapes: shapes.collect() };
        let text = json(&model);
        let again = Model::read(&text, "again.json").unwrap();
        prop_assert_eq!(bits(&records(&again)), bits(&records(&model)));
        prop_assert_eq!(json(&again), text);
        for shape in &model.shapes {
            let geometry = shape.to_geometry().unwrap();
            prop_assert_eq!(geometry.as_curve().is_some(), geometry.as_surface().is_none());
            let refused = shape.patch_builder().unwrap_err().to_string();
            prop_assert!(refused.contains("is no GB patch"), "{}", refused);
        }
    }

    #[test]
    fn solids(
        shapes in prop::collection::vec((prop::option::of(any::<String>()), solid()), 1..4),
    ) {
        let shapes = shapes.into_iter().map(|(name, shape)| NamedShape::new(name, shape));
        let model = Model { shapes: shapes.collect() };
        let text = json(&model);
        let again = Model::read(&text, "again.json").unwrap();
        prop_assert_eq!(bits(&records(&again)), bits(&records(&model)));
        prop_assert_eq!(json(&again), text);
        for shape in &model.shapes {
            let geometry = shape.to_geometry().unwrap();
            prop_assert!(geometry.as_solid().is_some() && geometry.as_surface().is_none());
        }
    }

    /// What a solid is described as describes the same solid.
    #[test]
    fn descriptions_of_solids(shape in solid()) {
        let geometry = NamedShape::new(None, shape).to_geometry().unwrap();
        let again = match &geometry {
            Geometry::Tetrahedron(solid) => Shape::Tetrahedron(solid.into()),
            Geometry::RationalTetrahedron(solid) => Shape::Tetrahedron(solid.into()),
            Geometry::Hexahedron(solid) => Shape::Hexahedron(solid.into()),
            Geometry::RationalHexahedron(solid) => Shape::Hexahedron(solid.into()),
            Geometry::Wedge(solid) => Shape::Wedge(solid.into()),
            Geometry::RationalWedge(solid) => Shape::Wedge(solid.into()),
            Geometry::Constructed(solid) => Shape::from(solid.construction()),
            _ => unreachable!("no solid"),
        };
        let again = NamedShape::new(None, again).to_geometry().unwrap();
        prop_assert_eq!(format!("{again:?}"), format!("{geometry:?}"));
    }

    /// What a shape is described as describes the same shape.
    #[test]
    fn descriptions_of_shapes(shape in classical()) {
        let geometry = NamedShape::new(None, shape).to_geometry().unwrap();
        let again = match &geometry {
            Geometry::Curve(curve) => Shape::Curve(curve.into()),
            Geometry::RationalCurve(curve) => Shape::Curve(curve.into()),
            Geometry::PowerCurve(curve) => Shape::PowerCurve(curve.into()),
            Geometry::Patch(patch) => Shape::Patch(patch.into()),
            Geometry::RationalPatch(patch) => Shape::Patch(patch.into()),
            Geometry::PowerPatch(patch) => Shape::PowerPatch(patch.into()),
            Geometry::Triangle(triangle) => Shape::Triangle(triangle.into()),
            Geometry::RationalTriangle(triangle) => Shape::Triangle(triangle.into()),
            _ => unreachable!("no GB patch was asked for"),
        };
        let again = NamedShape::new(None, again).to_geometry().unwrap();
        prop_assert_eq!(format!("{again:?}"), format!("{geometry:?}"));
    }

    #[test]
    fn cgb_files(record in record(), heuristic in any::<bool>(), tolerance in common::number()) {
        let layout = if heuristic { LayoutRecord::Heuristic } else { LayoutRecord::Projection };
        let center = Some(record.center.unwrap_or([0.1, -0.0, 1e300]));
        let record =
            GbPatchRecord { layout, center, coordinates: CoordinatesName::Harmonic, blend_power: 2, ..record };
        let mut text = Vec::new();
        cgb::write(&record, tolerance, &mut text).unwrap();
        let again = cgb::read(str::from_utf8(&text).unwrap(), "again.cgb").unwrap();
        prop_assert_eq!(bits(&again.record), bits(&record));
        // The sign of a zero is lost to the dilation beside it.
        prop_assert_eq!(again.tolerance, tolerance);
        prop_assert!(again.warnings.is_empty());
    }

    /// Bytes changed, cut out and doubled: an error that names the file, or a model; nothing else.
    #[test]
    fn damaged_files(
        record in record(),
        as_json in any::<bool>(),
        wounds in prop::collection::vec((any::<prop::sample::Index>(), 0..4_u8, any::<u8>()), 1..4),
    ) {
        let mut bytes = Vec::new();
        if as_json {
            Model { shapes: vec![NamedShape::new(None, Shape::GbPatch(record))] }.write(&mut bytes).unwrap();
        } else {
            let plain = GbPatchRecord { layout: LayoutRecord::Projection, coordinates: CoordinatesName::Harmonic, blend_power: 2, ..record };
            cgb::write(&plain, 0.2, &mut bytes).unwrap();
        }
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
        if let Err(error) = read_model_bytes(&bytes, "damaged", None) {
            let message = error.to_string();
            prop_assert!(message.starts_with("damaged:") && message.len() < 600, "{}", message);
        }
    }
}

const TRIANGLE: &str = "1 0 HINTS 3  0.25 0.25 0\n 1 1 0 0 0 1 0 0\n 1 1 1 0 0 0 1 0\n 1 1 0 1 0 0 0 0\n";

#[test]
fn both_orders_of_tolerance_and_dilation() {
    for (hints, tolerance) in [("0.3 0", 0.3), ("0 0.3", 0.3), ("0 0", 0.0), ("0.0 -2", -2.0)] {
        let file = cgb::read(&TRIANGLE.replace("HINTS", hints), "t.cgb").unwrap();
        assert_eq!(file.tolerance, tolerance, "{hints}");
    }
    let error = cgb::read(&TRIANGLE.replace("HINTS", "0.3 0.2"), "t.cgb").unwrap_err();
    assert_eq!(error.to_string(), "t.cgb:1: a dilation of 0.2 is not supported yet; supported: 0");
}

#[test]
fn the_tail_may_be_missing_and_every_prefix_is_an_error_or_the_patch() {
    let text = TRIANGLE.replace("HINTS", "0.2 0") + "0\r\n";
    let whole = cgb::read(&text, "t.cgb").unwrap();
    assert_eq!(whole.record.center_weight, CenterWeightName::None);
    assert_eq!(whole.ribbon_lines, [2, 3, 4]);
    let end = text.trim_end().len() - 2;
    for length in 0..text.len() {
        let read = cgb::read(&text[..length], "t.cgb");
        // The last number is "0", so that nothing but a whole last number ends the model.
        assert_eq!(read.is_ok(), length >= end, "{length} of {}", text.len());
        if let Ok(file) = read {
            assert_eq!(file.record, whole.record);
        }
    }
}

#[test]
fn every_prefix_of_a_model_file_is_an_error() {
    let text = cgb::read(&TRIANGLE.replace("HINTS", "0.2 0"), "t.cgb").unwrap().record;
    let text = json(&Model { shapes: vec![NamedShape::new(Some("é\"\\\n".into()), Shape::GbPatch(text))] });
    for length in 0..text.trim_end().len() {
        let error =
            read_model_bytes(&text.as_bytes()[..length], "t.json", Some(casteljau_io::ModelFormat::Json));
        assert!(error.unwrap_err().to_string().starts_with("t.json:"));
    }
    assert!(read_model_bytes(text.as_bytes(), "t.json", None).is_ok());
    assert!(read_model_bytes(("\u{feff}".to_owned() + &text).as_bytes(), "t.json", None).is_ok());
}

#[test]
fn what_cgb_cannot_hold_is_refused_and_leaves_no_file() {
    let plain = cgb::read(&TRIANGLE.replace("HINTS", "0.2 0"), "t.cgb").unwrap().record;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.cgb");
    let cases = [
        (GbPatchRecord { blend_power: 3, ..plain.clone() }, "blend power 3"),
        (GbPatchRecord { coordinates: CoordinatesName::MeanValue, ..plain.clone() }, "MeanValue coordinates"),
        (GbPatchRecord { layout: LayoutRecord::Regular, ..plain.clone() }, "a regular domain"),
        (
            GbPatchRecord { layout: LayoutRecord::Given(vec![[0.0, 0.0]; 3]), ..plain.clone() },
            "a given domain",
        ),
        (GbPatchRecord { center: Some([0.0, f64::NAN, 0.0]), ..plain.clone() }, "coordinate 1 is NaN"),
    ];
    for (record, part) in cases {
        let model = Model { shapes: vec![NamedShape::new(None, Shape::GbPatch(record))] };
        let message = write_model_file(&path, &model).unwrap_err().to_string();
        assert!(message.starts_with(&path.display().to_string()) && message.contains(part), "{message}");
    }
    let message = write_model_file(&path, &Model::default()).unwrap_err().to_string();
    assert!(message.contains("0 shapes, only one"), "{message}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

/// The published models, which are not part of this repository.
fn published(name: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/models").join(name);
    if !path.exists() {
        println!("the published models are absent: {} skipped", path.display());
        return None;
    }
    Some(path)
}

#[test]
fn published_models_are_read_as_they_are() {
    let cases = [
        ("L.cgb", 6, CenterWeightName::None, LayoutRecord::Heuristic, 1),
        ("U.cgb", 8, CenterWeightName::Deficiency, LayoutRecord::Heuristic, 0),
        ("v31.cgb", 6, CenterWeightName::Deficiency, LayoutRecord::Heuristic, 0),
    ];
    for (name, sides, weight, layout, warnings) in cases {
        let Some(path) = published(name) else { continue };
        let (model, found) = read_model_file(&path).unwrap();
        assert_eq!(found.len(), warnings, "{name}");
        if let Some(warning) = found.first() {
            let expected = format!("{}:2: domain type 3 (curved) is not supported yet", path.display());
            assert!(warning.to_string().starts_with(&expected), "{warning}");
        }
        let [NamedShape { shape: Shape::GbPatch(record), .. }] = model.shapes.as_slice() else {
            unreachable!("{name} holds one patch")
        };
        assert_eq!((record.ribbons.len(), record.center_weight, &record.layout), (sides, weight, &layout));
        for ribbon in &record.ribbons {
            assert_eq!((ribbon.control_points.len(), ribbon.control_points[0].len()), (2, 4));
        }
        // Through both formats and back.
        let folder = tempfile::tempdir().unwrap();
        for ending in ["json", "cgb"] {
            let copy = folder.path().join(name).with_extension(ending);
            write_model_file(&copy, &model).unwrap();
            assert_eq!(read_model_file(&copy).unwrap(), (model.clone(), Vec::new()));
        }
        let patch = model.shapes[0].to_patch().unwrap();
        assert_eq!(GbPatchRecord::from(&patch), *record);
    }
}

#[test]
fn published_convex_models_are_refused_by_name() {
    if let Some(path) = published("pocket5.gbp") {
        let message = read_model_file(&path).unwrap_err().to_string();
        assert!(
            message.ends_with("pocket5.gbp: the format .gbp is not supported yet; supported: json, cgb, vtu")
        );
    }
}
