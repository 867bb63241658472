//! The mesh against the surface: tolerance, normals, area, angles.
#![allow(missing_docs, clippy::unwrap_used)]

mod common;

use casteljau_domain::Orientation;
use casteljau_gb::glam::{DVec2, DVec3, dvec2};
use casteljau_gb::{ConcavePatch, CoordinateKind, Location, Polygon};
use casteljau_mesh::{TriangleMesh, TriangleTree};
use casteljau_tess::{Report, TessellationOptions, no_progress, tessellate};
use common::{l_polygon, lifted, patch_over, regular, ribbons_over, shared_model, star_polygon, u_polygon};

fn mesh_of(patch: &ConcavePatch, options: &TessellationOptions) -> (TriangleMesh, Report) {
    tessellate(std::slice::from_ref(patch), options, &mut no_progress).unwrap()
}

/// Places all over a polygon, dense beside its sides and corners too.
fn places(polygon: &Polygon) -> Vec<Location> {
    let [low, high] = polygon.bounding_box();
    let mut places = Vec::new();
    for i in 0..60 {
        for j in 0..60 {
            let p = low + (high - low) * dvec2((f64::from(i) + 0.31) / 60.0, (f64::from(j) + 0.57) / 60.0);
            places.push(polygon.locate(p));
        }
    }
    for side in 0..polygon.len() {
        for i in 1..200 {
            let t = f64::from(i) / 200.0;
            places.push(Location::Side { side, t });
            let on = polygon.at(Location::Side { side, t }).unwrap();
            for k in 1..12 {
                let angle = f64::from(k) * std::f64::consts::TAU / 12.0;
                let near = on + DVec2::from_angle(angle) * 1e-3 * (high - low).max_element();
                places.push(polygon.locate(near));
            }
        }
    }
    places.retain(|location| *location != Location::Outside);
    places
}

#[test]
fn the_chord_tolerance_holds_everywhere() {
    let patches = [
        ("L", Some(patch_over(l_polygon()))),
        ("U", Some(patch_over(u_polygon()))),
        ("star", Some(patch_over(star_polygon()))),
        ("hexagon", Some(patch_over(regular(6)))),
        ("L.cgb", shared_model("L.cgb")),
        ("U.cgb", shared_model("U.cgb")),
        ("v31.cgb", shared_model("v31.cgb")),
    ];
    for (name, patch) in patches.into_iter().filter_map(|(name, p)| Some((name, p?))) {
        let size = patch.bounding_box().diagonal();
        for relative in [1e-2, 1e-3, 1e-4] {
            let tolerance = relative * size;
            let (mesh, report) = mesh_of(&patch, &TessellationOptions::tolerance(tolerance));
            assert!(report.chord_error.unwrap() <= tolerance, "{name}");
            let tree = TriangleTree::new(&mesh).unwrap();
            let mut worst = (0.0, Location::Outside);
            for location in places(patch.domain()) {
                let point = patch.point_at(location).unwrap();
                let distance = tree.closest(point).unwrap().distance;
                if distance > worst.0 {
                    worst = (distance, location);
                }
            }
            let (worst, place) = worst;
            assert!(worst <= tolerance, "{name} at {place:?}: {worst:e} for {tolerance:e}");
            // A coarse mesh has the edges of its sides, whatever the inside needs.
            let fine = relative < 1e-2 && worst < 0.2 * tolerance;
            assert!(!fine, "{name} is too fine: {worst:e} for {tolerance:e}");
        }
    }
}

#[test]
fn normals_are_the_surfaces_and_triangles_agree_with_them() {
    for (patch, sign) in [(patch_over(l_polygon()), 1.0), (mirrored(), -1.0)] {
        let (mesh, _) = mesh_of(&patch, &TessellationOptions::resolution(24));
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
            let flat = (b - a).cross(c - a).normalize();
            for &v in t {
                assert!(flat.dot(mesh.normals[v as usize]) > 0.9, "{flat} {}", mesh.normals[v as usize]);
            }
        }
        // Normals of the formula by finite differences, compared at the vertices nearest to their points.
        let tree_of = |p: DVec3| {
            let near = |v: &usize| mesh.positions[*v].distance(p);
            (0..mesh.positions.len()).min_by(|a, b| near(a).total_cmp(&near(b))).unwrap()
        };
        for uv in [dvec2(0.5, 0.5), dvec2(1.5, 0.4), dvec2(0.3, 1.7), dvec2(0.9, 0.9)] {
            let uv = dvec2(uv.x * sign, uv.y);
            let h = 1e-5;
            let at = |du: f64, dv: f64| patch.point(uv + dvec2(du, dv)).unwrap();
            let (du, dv) = (at(h, 0.0) - at(-h, 0.0), at(0.0, h) - at(0.0, -h));
            let normal = du.cross(dv).normalize() * sign;
            // The nearest vertex is within 0.05, over which the normal turns by 0.1 at most.
            let vertex = tree_of(at(0.0, 0.0));
            assert!(normal.distance(mesh.normals[vertex]) < 0.1, "{uv}");
        }
        assert!(mesh.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-14));
    }
}

/// The L over a domain that is drawn in a mirror: the ribbons and the surface are the same.
fn mirrored() -> ConcavePatch {
    let vertices = l_polygon().vertices().iter().map(|p| dvec2(-p.x, p.y)).collect();
    let domain = Polygon::new(vertices).unwrap();
    assert_eq!(domain.orientation(), Orientation::Clockwise);
    let ribbons = ribbons_over(&l_polygon(), &lifted);
    ConcavePatch::builder(ribbons).domain(domain).coordinates(CoordinateKind::Harmonic).build().unwrap()
}

#[test]
fn a_clockwise_domain_changes_nothing_but_the_triangulation() {
    let options = TessellationOptions::resolution(40);
    let (plain, turned) = (mesh_of(&patch_over(l_polygon()), &options).0, mesh_of(&mirrored(), &options).0);
    assert!((plain.area().unwrap() - turned.area().unwrap()).abs() < 1e-3);
    let up = |mesh: &TriangleMesh| mesh.normals.iter().filter(|n| n.z > 0.0).count() == mesh.normals.len();
    assert!(up(&plain) && up(&turned));
}

#[test]
fn area_converges_at_second_order() {
    let patch = patch_over(regular(6));
    let areas: Vec<f64> = [8, 16, 32, 128]
        .map(|n| mesh_of(&patch, &TessellationOptions::resolution(n)).0.area().unwrap())
        .to_vec();
    let error = |i: usize| (areas[i] - areas[3]).abs();
    for i in 0..2 {
        let order = (error(i) / error(i + 1)).log2();
        assert!((1.7..2.6).contains(&order), "order {order}: {areas:?}");
    }
}

#[test]
fn angles_are_wide_in_space() {
    let patches = [
        ("L", Some(patch_over(l_polygon()))),
        ("U", Some(patch_over(u_polygon()))),
        ("star", Some(patch_over(star_polygon()))),
        ("hexagon", Some(patch_over(regular(6)))),
        ("L.cgb", shared_model("L.cgb")),
        ("U.cgb", shared_model("U.cgb")),
        ("v31.cgb", shared_model("v31.cgb")),
    ];
    for (name, patch) in patches.into_iter().filter_map(|(name, p)| Some((name, p?))) {
        let size = patch.bounding_box().diagonal();
        let requests = [
            TessellationOptions::resolution(5),
            TessellationOptions::resolution(30),
            TessellationOptions::tolerance(1e-3 * size),
        ];
        for options in requests {
            let (mesh, report) = mesh_of(&patch, &options);
            let angles = report.space;
            println!("{name} {:?}: {angles:?}", options.density);
            assert_eq!(angles.interior_below_19, 0, "{name} {options:?}: {angles:?}");
            assert!(100 * angles.boundary_below_10 <= angles.boundary, "{name} {options:?}: {angles:?}");
            let least = angles.interior_least.min(angles.boundary_least);
            assert!((mesh.audit().unwrap().min_angle.unwrap() - least).abs() < 1e-9, "{name}");
            // Nothing turns over in the domain.
            assert!(report.domain.interior_least > 0.02 && report.domain.boundary_least > 0.02);
            assert_eq!(report.domain.interior + report.domain.boundary, mesh.triangles.len());
        }
    }
}
