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
#[path = "../examples/sample_models/solids.rs"]
mod solids;

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
    let all = designs::all().into_iter().chain(classical::all().unwrap()).chain(solids::all().unwrap());
    for (name, design) in all {
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

#[test]
fn solids_are_what_their_names_say() {
    use std::f64::consts::{FRAC_PI_4, PI};
    let solid = |name: &str| {
        let (model, _) = read_model_file(&folder().join(name)).unwrap();
        assert_eq!(model.shapes.len(), 1);
        model.shapes[0].to_geometry().unwrap()
    };
    let at = |name: &str, at: [f64; 3]| solid(name).as_solid().unwrap().try_point(at).unwrap();
    let near = |p: DVec3, exact: DVec3| assert!(p.distance(exact) < 1e-14, "{p} instead of {exact}");
    for t in [0.1, 0.35, 0.5, 0.9] {
        for side in [[0.0, t], [1.0, t], [t, 0.0], [t, 1.0]] {
            let [u, v] = side;
            assert!((at("ball.json", [u, v, t]).length() - 1.0).abs() < 1e-14);
            let cone = at("cone.json", [u, v, t]);
            assert!((cone.truncate().length() - (1.0 - t)).abs() < 1e-14 && (cone.z - 2.0 * t).abs() < 1e-14);
            // The disc moves along the circle around (2, 0, 0).
            let center = at("swept_disc.json", [0.5, 0.5, t]);
            let across = at("swept_disc.json", [u, v, t]) - at("swept_disc.json", [0.0, 0.0, t]) + DVec3::X;
            assert!((across.length() - 1.0).abs() < 1e-14 && across.z.abs() < 1e-14, "{center} {across}");
        }
        let corner = at("swept_disc.json", [0.0, 0.0, t]) - DVec3::X;
        assert!((corner.distance(2.0 * DVec3::X) - 2.0).abs() < 1e-14, "{corner}");
        let ring = at("quarter_ring.json", [0.0, t, 1.0 - t]);
        assert!((ring.truncate().length() - (1.0 + t)).abs() < 1e-14 && ring.z == 0.0);
        let octant = at("ball_octant.json", [t, 0.6 * (1.0 - t), 0.4 * (1.0 - t)]);
        assert!((octant.length() - 1.0).abs() < 1e-14);
        let rigid = at("rigid_twist.json", [1.0, 1.0, t]);
        assert!((rigid.truncate().length() - 2_f64.sqrt()).abs() < 1e-14);
    }
    near(at("ball_octant.json", [0.0, 0.0, 0.25]), 0.25 * DVec3::Z);
    near(at("rigid_twist.json", [1.0, 1.0, 1.0]), DVec3::new(-1.0, 1.0, 3.0));
    let shrunk = (PI / 12.0).cos().powi(3) * 2_f64.sqrt();
    near(at("twisted_prism.json", [1.0, 1.0, 0.5]), DVec3::new(0.0, shrunk, 1.5));
    near(at("quarter_ring.json", [0.0, 1.0, 0.5]), 2.0 * DVec3::new(FRAC_PI_4.cos(), FRAC_PI_4.sin(), 0.0));
    // None of them is inside out.
    for (name, _) in solids::all().unwrap() {
        let geometry = solid(name);
        let solid = geometry.as_solid().unwrap();
        for t in 0..64 {
            let [x, y, z] = [t % 4, t / 4 % 4, t / 16].map(|i| (i as f64 + 0.5) / 4.0);
            let place = match geometry {
                Geometry::RationalTetrahedron(_) => [x, (1.0 - x) * y, (1.0 - x) * (1.0 - y) * z],
                Geometry::RationalWedge(_) => [x, (1.0 - x) * y, z],
                _ => [x, y, z],
            };
            assert!(solid.try_jacobian(place).unwrap() > 0.0, "{name} at {place:?}");
        }
    }
}
