//! The sample models in `models/`: as designed, sound, and smooth where they should be.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../examples/sample_models/classical.rs"]
mod classical;
#[path = "../examples/sample_models/designs.rs"]
mod designs;
#[path = "../examples/sample_models/guide.rs"]
mod guide;
#[path = "../examples/sample_models/plan.rs"]
mod plan;

use std::path::{Path, PathBuf};

use casteljau::geom::angle_degrees;
use casteljau::prelude::*;
use casteljau::tess::{TessellationOptions, no_progress, tessellate};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models")
}

fn patches(name: &str) -> Vec<ConcavePatch> {
    let (model, warnings) = read_model_file(&folder().join(name)).unwrap();
    assert!(warnings.is_empty());
    model.shapes.iter().map(|shape| shape.to_patch().unwrap()).collect()
}

/// `cargo run -p casteljau --example sample_models -- models` mends it.
#[test]
fn the_files_are_what_the_generator_writes() {
    for (name, design) in designs::all().into_iter().chain(classical::all().unwrap()) {
        let path = folder().join(name);
        assert_eq!(read_model_file(&path).unwrap().0, design, "{name}");
        let mut text = Vec::new();
        design.write(&mut text).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), text, "{name}");
    }
}

#[test]
fn they_are_what_their_names_say() {
    let concave = |p: &ConcavePatch| (0..p.sides()).filter(|&i| p.domain().is_concave(i)).count();
    let found = ["l.json", "u.json", "pocket.json", "mixed.json"].map(|name| {
        let all = patches(name);
        assert_eq!(all.len(), 1);
        assert!(!all[0].layout_repaired(), "{name}");
        (all[0].sides(), concave(&all[0]), all[0].continuity().iter().map(|c| c.geometric()).min())
    });
    assert_eq!(found, [(6, 1, Some(1)), (8, 2, Some(1)), (5, 0, Some(2)), (8, 2, Some(1))]);
    let mixed = &patches("mixed.json")[0];
    let degrees: std::collections::BTreeSet<_> = mixed.ribbons().iter().map(Ribbon::degree).collect();
    let layers: std::collections::BTreeSet<_> = mixed.ribbons().iter().map(Ribbon::layers).collect();
    assert!(degrees.len() >= 4 && layers.len() >= 2);
}

/// At a corner the ribbons of both sides have one tangent plane, that of the guide; numbers in the files are rounded to
/// a millionth, which the shortest control leg of 5 mm turns into 1e-5 degrees.
#[test]
fn ribbons_agree_in_tangent_planes_at_corners() {
    for (name, _) in designs::all() {
        for (shape, patch) in patches(name).iter().enumerate() {
            for corner in 0..patch.sides() {
                let [before, after] = [corner, (corner + 1) % patch.sides()].map(|i| &patch.ribbons()[i]);
                let normals =
                    [before.jet(1.0, 0.0), after.jet(0.0, 0.0)].map(|jet| jet.unwrap().normal().unwrap());
                let angle = angle_degrees(normals[0], normals[1]);
                assert!(angle < 1e-4, "{name}, shape {shape}, corner {corner}: {angle}°");
                let own = patch.normal_at(Location::Corner(corner)).unwrap();
                assert!(angle_degrees(own, normals[0]) < 1e-4, "{name}, shape {shape}, corner {corner}");
            }
        }
    }
}

#[test]
fn they_keep_their_promises() {
    for (name, _) in designs::all() {
        for patch in patches(name) {
            let size = patch.bounding_box().diagonal();
            for side in ContinuityReport::measure(&patch, 32).unwrap().sides {
                assert!(side.g0.value < 1e-6 * size, "{name}: {side:?}");
                assert!(side.promised.geometric() < 1 || side.g1.unwrap().value < 1e-6, "{name}: {side:?}");
                assert!(side.promised.geometric() < 2 || side.g2.unwrap().value < 1e-4, "{name}: {side:?}");
            }
        }
    }
}

#[test]
fn the_bracket_is_closed_and_its_outside_is_outside() {
    let (mesh, report) =
        tessellate(&patches("closed.json"), &TessellationOptions::resolution(12), &mut no_progress).unwrap();
    assert!(report.is_closed(), "{report:?}");
    let audit = mesh.audit().unwrap();
    assert_eq!((audit.boundary_edges, audit.manifold, audit.oriented), (0, true, true));
    assert_eq!((audit.components, audit.euler_characteristic), (1, 2));
    // The plan has about 4780 mm² above and 5531 mm² below, the walls are 20 to 36 mm high.
    let volume = mesh.signed_volume().unwrap();
    assert!((4700.0 * 20.0..5540.0 * 36.0).contains(&volume), "{volume}");
}

#[test]
fn the_pair_shares_a_side_to_the_bit() {
    let [arm, end] = patches("pair.json").try_into().unwrap();
    let reversed = end.ribbons()[0].reversed();
    assert_eq!(arm.ribbons()[1].row(0), reversed.row(0));
    // Sampled from inside, both surfaces have the guide's tangent planes along it.
    for t in [0.1, 0.5, 0.9] {
        let normal = |patch: &ConcavePatch, side, t| {
            patch.jet_at(Location::Side { side, t }).unwrap().normal().unwrap()
        };
        let angle = angle_degrees(normal(&arm, 1, t), normal(&end, 0, 1.0 - t));
        assert!(angle < 1e-4, "{angle}");
    }
}

#[test]
fn quadrics_are_what_their_names_say() {
    let surfaces = |name: &str| {
        let (model, _) = read_model_file(&folder().join(name)).unwrap();
        model.shapes.iter().map(|shape| shape.to_geometry().unwrap()).collect::<Vec<_>>()
    };
    for (name, count) in [("sphere.json", 8), ("torus.json", 16), ("octant.json", 1)] {
        let all = surfaces(name);
        assert_eq!(all.len(), count);
        for surface in &all {
            for (u, v) in [(0.0, 0.3), (0.25, 0.5), (0.1, 0.8)] {
                let p = surface.as_surface().unwrap().try_point(u, v).unwrap();
                let from_tube = match name {
                    "torus.json" => p - p.with_z(0.0).normalize() * 3.0,
                    _ => p,
                };
                assert!((from_tube.length() - 1.0).abs() < 1e-14, "{name} at ({u}, {v}): {p}");
            }
        }
    }
}
