//! Slices by planes and iso-surfaces: exact figures, watertight, on the plane, within the tolerance.
#![allow(missing_docs, clippy::unwrap_used, clippy::panic)]

mod common;

use std::f64::consts::PI;

use casteljau_geom::glam::{DVec3, dvec3};
use casteljau_mesh::TriangleMesh;
use casteljau_solid::{Axis, Hexahedron, SolidDomain, Tetrahedron};
use casteljau_tess::{
    SectionOptions, SectionReport, Solid, SolidField, TessError, iso_surface, no_progress, slice,
};
use common::solids::{Any, any_solid, ball, cone, ring};
use proptest::prelude::*;

fn cut(solids: &[Solid<'_>], normal: DVec3, offset: f64, tolerance: f64) -> (TriangleMesh, SectionReport) {
    slice(solids, normal, offset, &SectionOptions::tolerance(tolerance), &mut no_progress)
        .unwrap_or_else(|e| panic!("{normal} {offset}: {e}"))
}

/// A surface with or without a boundary, in one piece where it hangs together, without degenerate triangles.
fn assert_surface(mesh: &TriangleMesh, what: &str) {
    let audit = mesh.audit().unwrap();
    assert!(audit.edge_manifold && audit.oriented, "{what}: {audit:?}");
    assert_eq!((audit.degenerate, audit.unreferenced_vertices), (0, 0), "{what}: {audit:?}");
}

/// Every vertex of the boundary lies on a face of its solid: a parameter is at an end, to the bit.
fn assert_boundary_on_faces(mesh: &TriangleMesh, report: &SectionReport, solids: &[Solid<'_>]) {
    for v in mesh.boundary_loops().unwrap().into_iter().flatten() {
        let (solid, at) = report.origins[v as usize];
        let domain = solids[solid].parametric().domain();
        let end = |i: casteljau_geom::Interval, t: f64| t == i.start() || t == i.end();
        let on = match domain {
            SolidDomain::Box(intervals) => intervals.iter().zip(at).any(|(i, t)| end(*i, t)),
            // The last barycentric coordinate is a difference of others, which round.
            SolidDomain::Tetrahedron => at.contains(&0.0) || (1.0 - at.iter().sum::<f64>()).abs() < 4e-16,
            SolidDomain::Wedge(height) => {
                at[..2].contains(&0.0) || (1.0 - at[0] - at[1]).abs() < 4e-16 || end(height, at[2])
            }
        };
        assert!(on, "{solid} {at:?}");
    }
}

#[test]
fn slices_of_a_ball_are_circles() {
    let ball = ball();
    let solids = [Solid::from(&ball)];
    for tolerance in [1e-1, 1e-2, 5e-3] {
        for z in [0.0, 0.3, -0.5, 0.9, 0.99] {
            for normal in [DVec3::Z, DVec3::X, dvec3(1.0, -2.0, 0.5)] {
                let (mesh, report) = cut(&solids, normal, z * normal.length(), tolerance);
                assert_surface(&mesh, "ball");
                assert_boundary_on_faces(&mesh, &report, &solids);
                let (radius, unit) = ((1.0 - z * z).sqrt(), normal.normalize());
                let loops = mesh.boundary_loops().unwrap();
                assert_eq!(loops.len(), 1);
                // The outline's vertices lie on the circle, its edges within the tolerance of it.
                for v in &loops[0] {
                    assert!((mesh.positions[*v as usize].length() - 1.0).abs() < 1e-12);
                }
                for p in &mesh.positions {
                    assert!((p.dot(unit) - z).abs() <= 1e-15);
                }
                let middles = loops[0].iter().zip(loops[0].iter().cycle().skip(1));
                let off = middles
                    .map(|(&a, &b)| {
                        let middle = mesh.positions[a as usize].midpoint(mesh.positions[b as usize]);
                        radius - (middle - unit * z).length()
                    })
                    .fold(0.0, f64::max);
                assert!(off <= tolerance && report.chord_error <= tolerance, "{z} {off} {report:?}");
                let area = mesh.area().unwrap();
                let exact = PI * radius * radius;
                assert!(area < exact && exact - area <= tolerance * 2.0 * PI * radius, "{z}: {area} {exact}");
                // Of one sign, but for what may lie between the outline and its chords, where x = 0 runs along edges of the solid.
                let turned = |t: &[u32; 3]| {
                    let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
                    (0.5 * (b - a).cross(c - a).dot(unit)).min(0.0)
                };
                let over: f64 = mesh.triangles.iter().map(turned).sum();
                let band = tolerance * 2.0 * PI * radius;
                assert!(
                    -over <= if z == 0.0 && normal == DVec3::X { 1e-2 * band } else { 0.0 },
                    "{z} {normal} {over}"
                );
            }
        }
    }
    let (nothing, _) = cut(&solids, DVec3::Z, 1.01, 1e-2);
    assert!(nothing.is_empty());
}

#[test]
fn a_plane_through_places_of_the_lattice_is_half_open() {
    let cube = Hexahedron::unit_cube().elevated([1, 1, 1]).unwrap();
    let solids = [Solid::from(&cube)];
    // Through the middle layer of places, the top face, and the bottom face from either side.
    for (normal, offset, area) in [
        (DVec3::Z, 0.5, 1.0),
        (DVec3::Z, 1.0, 1.0),
        (DVec3::Z, 0.0, 0.0),
        (-DVec3::Z, 0.0, 1.0),
        (DVec3::X + DVec3::Y, 1.0, 2f64.sqrt()),
        // Through edges: on the far side of the cube, and on its near side.
        (DVec3::X + DVec3::Y, 2.0, 0.0),
        (DVec3::X + DVec3::Y, 0.0, 0.0),
        (DVec3::ONE, 1.0, 0.75f64.sqrt()),
        (DVec3::ONE, 3.0, 0.0),
        (DVec3::X - DVec3::Y, 0.0, 2f64.sqrt()),
        (dvec3(1.0, 1.0, -1.0), 0.0, 0.75f64.sqrt()),
        (dvec3(1.0, 1.0, -1.0), 1.0, 0.75f64.sqrt()),
    ] {
        let (mesh, report) = cut(&solids, normal, offset, 1e-2);
        assert_surface(&mesh, "cube");
        assert!((mesh.area().unwrap() - area).abs() < 1e-14, "{normal} {offset}: {}", mesh.area().unwrap());
        assert_eq!(mesh.boundary_loops().unwrap().len(), usize::from(area > 0.0), "{normal} {offset}");
        assert_boundary_on_faces(&mesh, &report, &solids);
        assert!(mesh.positions.iter().all(|p| p.dot(normal) == offset || normal.abs().element_sum() > 1.0));
    }
    // Two boxes on each other have their common face once.
    let above = Hexahedron::new(
        [1; 3],
        Hexahedron::unit_cube().control_points().iter().map(|p| *p + DVec3::Z).collect::<Vec<_>>(),
    );
    let (below, above) = (Hexahedron::unit_cube(), above.unwrap());
    let (mesh, _) = cut(&[(&below).into(), (&above).into()], DVec3::Z, 1.0, 1e-2);
    assert_surface(&mesh, "boxes");
    assert_eq!(mesh.area().unwrap(), 1.0);
}

#[test]
fn a_ring_is_cut_into_two_squares_and_an_annulus() {
    let ring = ring();
    let solids: Vec<Solid<'_>> = ring.iter().map(Solid::from).collect();
    for (normal, offset, loops, area, components) in
        [(DVec3::Y, 0.0, 2, 2.0, 2), (DVec3::Z, 0.5, 2, 5.0 * PI, 1), (dvec3(1.0, 1.0, 0.0), 0.0, 2, 2.0, 2)]
    {
        let (mesh, report) = cut(&solids, normal, offset, 1e-3);
        assert_surface(&mesh, "ring");
        assert_eq!(mesh.boundary_loops().unwrap().len(), loops, "{normal}");
        assert_eq!(mesh.audit().unwrap().components, components, "{normal}");
        assert!((mesh.area().unwrap() - area).abs() < 3e-2, "{normal} {}", mesh.area().unwrap());
        assert_boundary_on_faces(&mesh, &report, &solids);
    }
}

#[test]
fn a_cone_is_cut_through_its_apex() {
    let cone = cone();
    let solids = [Solid::from(&cone)];
    let (mesh, _) = cut(&solids, DVec3::X, 0.0, 1e-3);
    assert_surface(&mesh, "cone");
    assert!((mesh.area().unwrap() - 1.0).abs() < 1e-3);
    let (mesh, _) = cut(&solids, DVec3::Z, 1e-3, 1e-3);
    assert_surface(&mesh, "tip");
    let allowed = 1e-3 * 2.0 * PI * 1e-3;
    assert!((mesh.area().unwrap() - PI * 1e-6).abs() <= allowed, "{}", mesh.area().unwrap());
}

/// A solid that needs a fine lattice, and a field that has the value all over it, or all but has it in half of it.
#[test]
fn fields_without_a_slope_end_soon() {
    let bent = Hexahedron::unit_cube().elevated([1, 1, 1]).unwrap();
    let points = bent.control_points().iter().map(|p| *p + 0.2 * dvec3(p.y * p.y, p.z * p.z, p.x * p.x));
    let bent = Hexahedron::new([2; 3], points.collect::<Vec<_>>()).unwrap();
    let options = SectionOptions { max_vertices: 1000, ..SectionOptions::tolerance(1e-7) };
    let constant = SolidField::hexahedron([1; 3], [0.5; 8]).unwrap();
    let (mesh, _) = iso_surface(&[&bent], &[constant], 0.5, &options, &mut no_progress).unwrap();
    assert!(mesh.is_empty());
    // −u⁶⁰
    let power: Vec<f64> = (0..=60).map(|i| if i == 60 { -1.0 } else { 0.0 }).collect();
    let power = SolidField::hexahedron([60, 0, 0], power).unwrap();
    let refused = iso_surface(&[&bent], &[power], 0.0, &options, &mut no_progress);
    assert!(matches!(refused, Err(TessError::TooManySolidVertices { solid: 0, .. })), "{refused:?}");
}

#[test]
fn the_unit_of_a_field_does_not_matter() {
    let options = SectionOptions::tolerance(1e-2);
    for exponent in [-1000, -600, 0, 600, 1000] {
        let unit = 2f64.powi(exponent);
        let net: Vec<f64> = sphere_field_net().map(|c| c * unit).collect();
        let field = SolidField::hexahedron([2; 3], net).unwrap();
        let cube = Hexahedron::unit_cube();
        let (mesh, _) = iso_surface(&[&cube], &[field], 0.0625 * unit, &options, &mut no_progress).unwrap();
        let audit = mesh.audit().unwrap();
        assert!(audit.closed && audit.euler_characteristic == 2, "2^{exponent}: {audit:?}");
    }
}

fn sphere_field_net() -> impl Iterator<Item = f64> {
    // (x − ½)² = ¼ − x + x²: coefficients ¼, −¼, ¼.
    let c = [0.25, -0.25, 0.25];
    (0..27).map(move |i| c[i / 9] + c[i / 3 % 3] + c[i % 3])
}

/// |p − ½|² over the unit cube.
fn sphere_field() -> SolidField {
    SolidField::hexahedron([2; 3], sphere_field_net().collect::<Vec<_>>()).unwrap()
}

#[test]
fn iso_surfaces_of_a_quadratic_field_are_spheres() {
    let cube = Hexahedron::unit_cube();
    for tolerance in [1e-2, 1e-3] {
        let options = SectionOptions::tolerance(tolerance);
        for radius in [0.1, 0.37, 0.45] {
            let level = radius * radius;
            let (mesh, report) =
                iso_surface(&[&cube], &[sphere_field()], level, &options, &mut no_progress).unwrap();
            assert_surface(&mesh, "sphere");
            let audit = mesh.audit().unwrap();
            assert!(audit.closed && audit.manifold && audit.euler_characteristic == 2, "{audit:?}");
            assert!(report.chord_error <= tolerance);
            let volume = mesh.signed_volume().unwrap();
            let exact = 4.0 / 3.0 * PI * radius.powi(3);
            // Outward is where the field rises.
            assert!((volume - exact).abs() <= tolerance * 4.0 * PI * radius * radius, "{volume} {exact}");
            for (p, n) in mesh.positions.iter().zip(&mesh.normals) {
                let out = *p - DVec3::splat(0.5);
                assert!((out.length() - radius).abs() < 1e-14 && (out / radius).distance(*n) < 1e-12);
            }
            // Everywhere: a triangle is farthest inside at its middle.
            for t in &mesh.triangles {
                let [a, b, c] = t.map(|v| mesh.positions[v as usize] - DVec3::splat(0.5));
                assert!(radius - ((a + b + c) / 3.0).length() <= tolerance);
            }
        }
        // Beyond the cube's faces the sphere is open, six circles.
        let (mesh, report) =
            iso_surface(&[&cube], &[sphere_field()], 0.36, &options, &mut no_progress).unwrap();
        assert_surface(&mesh, "open sphere");
        assert_eq!(mesh.boundary_loops().unwrap().len(), 6);
        assert_boundary_on_faces(&mesh, &report, &[(&cube).into()]);
        let cap = 2.0 * PI * 0.6 * 0.1;
        assert!((mesh.area().unwrap() - (4.0 * PI * 0.36 - 6.0 * cap)).abs() < 10.0 * tolerance);
    }
}

#[test]
fn a_surface_crosses_solids_of_one_field_without_a_gap() {
    let cube = Hexahedron::unit_cube();
    let (left, right) = cube.split(Axis::U, 0.5).unwrap();
    // x² + y² over each half, in its own parameters; the second one turned about.
    let square = [0.0, 0.0, 1.0];
    let halves = [[0.0, 0.0, 0.25], [0.25, 0.5, 1.0]];
    let field = |half: [f64; 3]| {
        SolidField::hexahedron([2, 2, 0], (0..9).map(|i| half[i / 3] + square[i % 3]).collect::<Vec<_>>())
            .unwrap()
    };
    let right = right.permuted([Axis::V, Axis::W, Axis::U]).unwrap();
    let turned = SolidField::hexahedron(
        [2, 0, 2],
        (0..9).map(|i| square[i / 3] + halves[1][i % 3]).collect::<Vec<_>>(),
    );
    let options = SectionOptions::tolerance(1e-3);
    let fields = [field(halves[0]), turned.unwrap()];
    let (mesh, report) = iso_surface(&[&left, &right], &fields, 0.64, &options, &mut no_progress).unwrap();
    assert_surface(&mesh, "halves");
    assert_eq!((mesh.boundary_loops().unwrap().len(), mesh.audit().unwrap().components), (1, 1));
    assert!((mesh.area().unwrap() - 0.4 * PI).abs() < 2e-3);
    for v in mesh.boundary_loops().unwrap().into_iter().flatten() {
        let p = mesh.positions[v as usize];
        assert!(p.to_array().iter().any(|x| *x == 0.0 || *x == 1.0), "{p} {:?}", report.origins[v as usize]);
    }
}

#[test]
fn a_field_that_only_touches_has_no_surface() {
    // −(w − ½)²: zero on the middle layer, below it on both sides.
    let cube = Hexahedron::unit_cube();
    let field = SolidField::hexahedron([0, 0, 2], [-0.25, 0.25, -0.25]).unwrap();
    let (mesh, _) =
        iso_surface(&[&cube], &[field], 0.0, &SectionOptions::tolerance(1e-2), &mut no_progress).unwrap();
    assert!(mesh.triangles.is_empty());
}

#[test]
fn what_cannot_be_found_is_said() {
    let cube = Hexahedron::unit_cube();
    let ask = |normal, tolerance| {
        slice(&[&cube], normal, 0.5, &SectionOptions::tolerance(tolerance), &mut no_progress).unwrap_err()
    };
    assert!(matches!(ask(DVec3::NAN, 1e-3), TessError::Plane { .. }));
    assert!(matches!(ask(DVec3::Z, 0.0), TessError::Tolerance { .. }));
    let few = SectionOptions { max_vertices: 10, ..SectionOptions::tolerance(1e-3) };
    let refused = slice(&[&ball()], DVec3::Z, 0.5, &few, &mut no_progress);
    assert!(matches!(refused, Err(TessError::TooManySolidVertices { solid: 0, limit: 10, .. })));
    let refused = iso_surface(&[&cube], &[], 0.5, &few, &mut no_progress);
    assert!(matches!(refused, Err(TessError::Field { what: "number of fields", .. })));
    let stop = slice(&[&ball()], DVec3::Z, 0.5, &SectionOptions::tolerance(1e-2), &mut |_| {
        std::ops::ControlFlow::Break(())
    });
    assert!(matches!(stop, Err(TessError::Cancelled { .. })));
}

#[test]
fn huge_and_tiny_planes_are_the_same() {
    let cube = Tetrahedron::new(1, [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ZERO]).unwrap();
    let plain = cut(&[(&cube).into()], DVec3::ONE, 0.5, 1e-2).0;
    for scale in [1e-200, 1e200] {
        let scaled = cut(&[(&cube).into()], DVec3::ONE * scale, 0.5 * scale, 1e-2).0;
        assert_eq!(scaled.triangles, plain.triangles);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn random_slices_are_watertight(
        solid in any_solid(),
        normal in (-1.0..1.0, -1.0..1.0, -1.0..1.0),
        share in 0.1..0.9,
    ) {
        let normal = dvec3(normal.0, normal.1, normal.2);
        prop_assume!(normal.length() > 0.1);
        let (low, high, size) = extent(&solid, normal);
        let offset = low + (high - low) * share;
        let tolerance = 5e-3 * size;
        let (whole, report) = cut(&[solid.solid()], normal, offset, tolerance);
        assert_surface(&whole, "whole");
        assert_boundary_on_faces(&whole, &report, &[solid.solid()]);
        prop_assert!(!whole.triangles.is_empty() && whole.audit().unwrap().manifold);
        let unit = normal.normalize();
        for p in &whole.positions {
            let bound = 8.0 * f64::EPSILON * (offset.abs() / normal.length() + p.length());
            prop_assert!((p.dot(unit) - offset / normal.length()).abs() <= bound);
        }
        // Halves have the same slice, the wall between them crossed without a gap.
        let halves = solid.halves();
        let both: Vec<Solid<'_>> = halves.iter().map(Any::solid).collect();
        let (parts, report) = cut(&both, normal, offset, tolerance);
        assert_surface(&parts, "halves");
        prop_assert_eq!(parts.boundary_loops().unwrap().len(), whole.boundary_loops().unwrap().len());
        assert_boundary_on_faces(&parts, &report, &both);
        let outline: f64 = whole.boundary_loops().unwrap().iter().map(|row| length(&whole, row)).sum();
        let apart = (whole.area().unwrap() - parts.area().unwrap()).abs();
        prop_assert!(apart <= 2.0 * tolerance * outline, "{} {}", apart, tolerance * outline);
    }
}

fn length(mesh: &TriangleMesh, row: &[u32]) -> f64 {
    let ends = row.iter().zip(row.iter().cycle().skip(1));
    ends.map(|(&a, &b)| mesh.positions[a as usize].distance(mesh.positions[b as usize])).sum()
}

/// Range of n·x over the corners, and the size of the solid.
fn extent(solid: &Any, normal: DVec3) -> (f64, f64, f64) {
    let parametric = solid.solid();
    let at = |x: f64, y: f64, z: f64| parametric.parametric().try_point([x, y, z]).unwrap();
    let corners = [at(0., 0., 0.), at(1., 0., 0.), at(0., 1., 0.), at(0., 0., 1.)];
    let along = corners.map(|p| p.dot(normal));
    let size = casteljau_mesh::BoundingBox::from_points(corners).unwrap().diagonal();
    let (low, high) = (
        along.iter().copied().fold(f64::INFINITY, f64::min),
        along.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    );
    (low, high, size)
}
