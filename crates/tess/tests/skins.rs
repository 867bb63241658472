//! Surfaces of solids: closed, outside out, without the faces between neighbours.
#![allow(missing_docs, clippy::unwrap_used, clippy::panic)]

mod common;

use std::f64::consts::PI;

use casteljau_geom::glam::{DVec3, dvec3};
use casteljau_mesh::TriangleMesh;
use casteljau_solid::{Axis, Hexahedron, RationalHexahedron};
use casteljau_tess::{
    Density, FaceId, Seams, SharedFaces, Skin, Solid, TessellationOptions, no_progress, tessellate_solids,
};
use common::solids::{Any, any_solid, ball, cone, cylinder, folded_hexahedron, ring};
use proptest::prelude::*;

fn requests(size: f64) -> Vec<TessellationOptions> {
    let mut all: Vec<_> = [1, 2, 5, 12].map(TessellationOptions::resolution).into();
    all.extend([1e-1, 1e-2, 1e-3].map(|t| TessellationOptions::tolerance(t * size)));
    all
}

/// Jacobians that leave the range of numbers keep their sign.
#[test]
fn which_side_is_out_is_known_at_any_size() {
    for exponent in [-130, -110, 0, 110, 130] {
        let scale = 10f64.powi(exponent);
        // Columns whose determinant, −¼, is a sum of terms of both signs.
        let [u, v, w] = [dvec3(1.0, 1.0, 1.0), dvec3(1.0, 1.0, 0.5), dvec3(0.3, -0.2, 1.0)];
        let cube = Hexahedron::unit_cube();
        let points = cube.control_points().iter().map(|p| (u * p.x + v * p.y + w * p.z) * scale);
        let solid = Hexahedron::new([1; 3], points.collect::<Vec<_>>()).unwrap();
        for (solid, inverted) in [(solid.reversed(Axis::U), &[][..]), (solid, &[0])] {
            let skin = Skin::new(&[solid], SharedFaces::Dropped).unwrap();
            assert_eq!((skin.inverted(), skin.faces().len()), (inverted, 6), "1e{exponent}");
        }
    }
}

fn closed(mesh: &TriangleMesh, euler: i64, what: &str) -> f64 {
    let audit = mesh.audit().unwrap();
    assert!(audit.closed && audit.manifold && audit.oriented, "{what}: {audit:?}");
    assert_eq!((audit.euler_characteristic, audit.components), (euler, 1), "{what}");
    assert_eq!((audit.degenerate, audit.unreferenced_vertices), (0, 0), "{what}");
    mesh.signed_volume().unwrap()
}

/// Meshes in every way asked for; the volume of the finest must be within its tolerance times the area of the exact one.
fn check(name: &str, solids: &[RationalHexahedron], euler: i64, volume: f64) {
    for options in requests(1.0) {
        // With one edge a side the meridians of a ball are all the chord between its poles.
        if name == "ball" && options.density == Density::Resolution(1) {
            continue;
        }
        let (mesh, report, _) =
            tessellate_solids(solids, SharedFaces::Dropped, &options, &mut no_progress).unwrap();
        let what = format!("{name}, {:?}", options.density);
        let found = closed(&mesh, euler, &what);
        assert!(report.is_closed(), "{what}: {report:?}");
        if let Density::Tolerance(tolerance) = options.density {
            let allowed = tolerance * mesh.area().unwrap();
            assert_outside(name, &mesh, &what);
            println!("{what}: {} triangles, volume off by {:.1e}", mesh.triangles.len(), found - volume);
            assert!((found - volume).abs() <= allowed, "{what}: {found} {volume}");
            // It is no accident: the meshes lie inside convex bodies.
            assert!(euler != 2 || found < volume + 1e-12, "{what}");
        }
    }
}

#[test]
fn solids_of_revolution_have_their_volumes() {
    check("ball", &[ball()], 2, 4.0 * PI / 3.0);
    check("cone", &[cone()], 2, PI / 3.0);
    check("cylinder", &[cylinder()], 2, 2.0 * PI);
}

/// No triangle of a convex body is turned over, as seen from a point amid it.
fn assert_outside(name: &str, mesh: &TriangleMesh, what: &str) {
    let middle = match name {
        "ball" => DVec3::ZERO,
        "cone" => dvec3(0.0, 0.0, 0.75),
        "cylinder" => DVec3::Z,
        _ => return,
    };
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|v| mesh.positions[v as usize] - middle);
        assert!(a.dot(b.cross(c)) > 0.0, "{what}: {t:?}");
    }
}

#[test]
fn poles_are_collapsed_faces() {
    let skin = Skin::new(&[ball()], SharedFaces::Dropped).unwrap();
    assert_eq!(skin.collapsed(), [FaceId { solid: 0, face: 4 }, FaceId { solid: 0, face: 5 }]);
    // Four between the poles, each in halves.
    assert_eq!(skin.faces().len(), 8);
    let skin = Skin::new(&[cone()], SharedFaces::Dropped).unwrap();
    assert_eq!(skin.collapsed(), [FaceId { solid: 0, face: 4 }]);
    let skin = Skin::new(&[folded_hexahedron()], SharedFaces::Dropped).unwrap();
    assert_eq!(skin.collapsed(), [FaceId { solid: 0, face: 0 }]);
}

#[test]
fn a_ring_closes_on_itself() {
    let quarters = ring();
    check("ring", &quarters, 0, 5.0 * PI);
    let skin = Skin::new(&quarters, SharedFaces::Dropped).unwrap();
    assert_eq!((skin.shared().len(), skin.faces().len()), (4, 16));
}

#[test]
fn a_face_that_is_an_edge_leaves_its_neighbours_joined() {
    for options in requests(1.0) {
        let (mesh, report, _) =
            tessellate_solids(&[folded_hexahedron()], SharedFaces::Dropped, &options, &mut no_progress)
                .unwrap();
        assert!(closed(&mesh, 2, "folded") > 0.0);
        assert!(report.is_closed());
    }
}

#[test]
fn of_shared_faces_both_may_stay_and_overlaps_are_told() {
    let (left, right) = Hexahedron::unit_cube().split(Axis::U, 0.5).unwrap();
    let options = TessellationOptions::resolution(2);
    let pair = [left.clone(), right];
    let (mesh, ..) = tessellate_solids(&pair, SharedFaces::Dropped, &options, &mut no_progress).unwrap();
    assert!((mesh.signed_volume().unwrap() - 1.0).abs() < 1e-14);
    let options = TessellationOptions { seams: Seams::Separate, ..options };
    let (mesh, report, skin) =
        tessellate_solids(&pair, SharedFaces::Kept, &options, &mut no_progress).unwrap();
    assert_eq!((skin.faces().len(), skin.shared().len(), report.crowded_sides.len()), (12, 0, 16));
    // Both halves of the wall are there, one lying on the other.
    assert!((mesh.area().unwrap() - 8.0).abs() < 1e-13);
    // A solid twice: all faces look the same way.
    let skin = Skin::new(&[left.clone(), left], SharedFaces::Dropped).unwrap();
    assert_eq!((skin.shared().len(), skin.overlapping().len(), skin.faces().len()), (0, 12, 12));
}

#[test]
fn turned_inside_out_the_outside_stays_outside() {
    let cube = Hexahedron::unit_cube().reversed(Axis::V);
    let skin = Skin::new(std::slice::from_ref(&cube), SharedFaces::Dropped).unwrap();
    assert_eq!(skin.inverted(), [0]);
    let options = TessellationOptions::resolution(3);
    let (mesh, ..) = tessellate_solids(&[cube], SharedFaces::Dropped, &options, &mut no_progress).unwrap();
    assert!((closed(&mesh, 2, "cube") - 1.0).abs() < 1e-14);
    for (point, normal) in mesh.positions.iter().zip(&mesh.normals) {
        assert!((*point - DVec3::splat(0.5)).dot(*normal) > 0.0, "{point} {normal}");
    }
}

#[test]
fn neighbours_in_two_calls_share_their_sides_to_the_bit() {
    let (left, right) = ball().split(Axis::W, 0.5).unwrap();
    let options = TessellationOptions::tolerance(1e-2);
    let rim = |solid: &RationalHexahedron| {
        let (mesh, ..) =
            tessellate_solids(&[solid], SharedFaces::Dropped, &options, &mut no_progress).unwrap();
        let mut rim: Vec<[u64; 3]> = Vec::new();
        for p in mesh.positions {
            // The equator, the four sides of the shared face.
            if p.z.abs() < 1e-14 && (p.length() - 1.0).abs() < 1e-13 {
                rim.push((p + DVec3::ZERO).to_array().map(f64::to_bits));
            }
        }
        rim.sort_unstable();
        rim
    };
    let (below, above) = (rim(&left), rim(&right));
    assert!(below.len() > 12 && below == above, "{} {}", below.len(), above.len());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn random_solids_are_closed(solid in any_solid()) {
        let size = casteljau_mesh::BoundingBox::from_points(corners(&solid)).unwrap().diagonal();
        for options in [
            TessellationOptions::resolution(1),
            TessellationOptions::resolution(3),
            TessellationOptions::tolerance(5e-3 * size),
        ] {
            let (mesh, report, _) =
                tessellate_solids(&[solid.solid()], SharedFaces::Dropped, &options, &mut no_progress).unwrap();
            let whole = closed(&mesh, 2, "random");
            prop_assert!(whole > 0.0 && report.is_closed());

            let halves = solid.halves();
            let both: Vec<Solid<'_>> = halves.iter().map(Any::solid).collect();
            let (mesh, report, skin) =
                tessellate_solids(&both, SharedFaces::Dropped, &options, &mut no_progress).unwrap();
            prop_assert_eq!(skin.shared().len(), 1);
            let parts = closed(&mesh, 2, "halves");
            prop_assert!(report.is_closed());
            if let Density::Tolerance(tolerance) = options.density {
                let allowed = 2.0 * tolerance * mesh.area().unwrap();
                prop_assert!((parts - whole).abs() <= allowed, "{} {}", parts, whole);
            }
        }
    }
}

fn corners(solid: &Any) -> Vec<DVec3> {
    let parametric = solid.solid();
    let at = |x: f64, y: f64, z: f64| parametric.parametric().try_point([x, y, z]).unwrap();
    vec![at(0., 0., 0.), at(1., 0., 0.), at(0., 1., 0.), at(0., 0., 1.), dvec3(0., 0., 0.)]
}
