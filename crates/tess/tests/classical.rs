//! Bézier patches and triangles, polynomial and rational: closed bodies, chord errors, poles, collapsed edges.
#![allow(missing_docs, clippy::unwrap_used, clippy::panic)]

mod common;

use std::f64::consts::PI;

use casteljau_geom::Interval;
use casteljau_geom::glam::{DVec3, DVec4, dvec3};
use casteljau_mesh::{TriangleMesh, TriangleTree};
use casteljau_shape::{
    ParametricSurface, Patch, PatchEdge, PowerPatch, RationalCurve, RationalPatch, RationalTriangle,
    SurfaceDomain, Triangle,
};
use casteljau_tess::{Face, Report, Seams, TessError, TessellationOptions, no_progress, tessellate};

fn requests() -> Vec<TessellationOptions> {
    let mut all: Vec<_> = [2, 3, 8, 17].map(TessellationOptions::resolution).into();
    all.extend([1e-1, 1e-2, 1e-3].map(TessellationOptions::tolerance));
    all
}

fn mesh(faces: &[Face<'_>], options: &TessellationOptions) -> (TriangleMesh, Report) {
    tessellate(faces, options, &mut no_progress).unwrap_or_else(|e| panic!("{options:?}: {e}"))
}

fn faces<'a, S>(shapes: &'a [S]) -> Vec<Face<'a>>
where
    Face<'a>: From<&'a S>,
{
    shapes.iter().map(Face::from).collect()
}

fn assert_closed(mesh: &TriangleMesh, euler: isize, what: &str) {
    let audit = mesh.audit().unwrap();
    assert!(audit.closed && audit.manifold && audit.oriented, "{what}: {audit:?}");
    assert_eq!((audit.euler_characteristic as isize, audit.components), (euler, 1), "{what}");
    assert_eq!((audit.degenerate, audit.unreferenced_vertices), (0, 0), "{what}");
    assert!(mesh.signed_volume().unwrap() > 0.0, "{what}");
}

/// Largest distance from the mesh of points spread over the faces, denser toward the sides.
fn measured(faces: &[&dyn ParametricSurface], mesh: &TriangleMesh) -> f64 {
    let tree = TriangleTree::new(mesh).unwrap();
    let mut worst = 0.0f64;
    let n = 60;
    for face in faces {
        for i in 0..=n {
            for j in 0..=n {
                let graded = |k: i32| 0.5 - 0.5 * (PI * f64::from(k) / f64::from(n)).cos();
                let (x, y) = (graded(i), graded(j));
                let [u, v] = match face.domain() {
                    SurfaceDomain::Rectangle([u, v]) => [u.at(x), v.at(y)],
                    SurfaceDomain::Triangle => [x * (1.0 - y), y],
                };
                let point = face.try_point(u, v).unwrap();
                worst = worst.max(tree.closest(point).unwrap().distance);
            }
        }
    }
    worst
}

fn surfaces<S: ParametricSurface>(shapes: &[S]) -> Vec<&dyn ParametricSurface> {
    shapes.iter().map(|s| s as &dyn ParametricSurface).collect()
}

fn check_body<'a, S: ParametricSurface>(name: &str, shapes: &'a [S], euler: isize)
where
    Face<'a>: From<&'a S>,
{
    for options in requests() {
        let (mesh, report) = mesh(&faces(shapes), &options);
        let what = format!("{name}, {:?}", options.density);
        println!("{what}: {} triangles, {:?}", mesh.triangles.len(), report.space);
        assert_closed(&mesh, euler, &what);
        assert!(report.is_closed(), "{what}: {report:?}");
        assert!(mesh.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-12), "{what}");
        if let casteljau_tess::Density::Tolerance(tolerance) = options.density {
            let worst = measured(&surfaces(shapes), &mesh);
            println!("    chord error {worst:.3e} of {tolerance:e}, reported {:?}", report.chord_error);
            assert!(worst <= tolerance, "{what}: {worst:e}");
            assert!(report.chord_error.unwrap() <= tolerance, "{what}");
        }
        // Each patch keeping its own, positions agree to the bit.
        let separate = TessellationOptions { seams: Seams::Separate, ..options };
        let (apart, _) = tessellate(&faces(shapes), &separate, &mut no_progress).unwrap();
        assert_closed(&apart.welded().unwrap().mesh, euler, &what);
    }
}

fn sphere() -> Vec<RationalPatch> {
    RationalPatch::sphere(dvec3(0.3, -0.2, 0.7), 1.0).unwrap()
}

fn octants() -> Vec<RationalTriangle> {
    let ring = [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y, DVec3::X];
    let make = |a: DVec3, b: DVec3, c: DVec3| RationalTriangle::sphere_octant(DVec3::ZERO, a, b, c).unwrap();
    let north = ring.windows(2).map(|q| make(q[0], q[1], DVec3::Z));
    let south = ring.windows(2).map(|q| make(q[1], q[0], DVec3::NEG_Z));
    north.chain(south).collect()
}

#[test]
fn spheres_are_closed_without_degenerate_triangles_at_the_poles() {
    check_body("sphere of patches", &sphere(), 2);
    check_body("sphere of triangles", &octants(), 2);
    for options in [TessellationOptions::resolution(20), TessellationOptions::tolerance(1e-3)] {
        let center = dvec3(0.3, -0.2, 0.7);
        let (mesh, report) = mesh(&faces(&sphere()), &options);
        assert_eq!(report.without_normal, 0);
        for (&p, &n) in mesh.positions.iter().zip(&mesh.normals) {
            assert!(n.distance(p - center) < 1e-9, "{p}: {n}");
        }
        // Nor are the angles at the poles poor.
        assert!(report.space.interior_least > 19f64.to_radians(), "{:?}", report.space);
        assert!(report.space.boundary_least > 10f64.to_radians(), "{:?}", report.space);
    }
}

/// The side of a triangle that a neighbour leaves open has the number of its edge.
#[test]
fn sides_of_triangles_are_numbered_as_edges() {
    let triangle = Triangle::new(1, [DVec3::X, DVec3::Y, DVec3::ZERO]).unwrap();
    for edge in 0..3 {
        let shared = triangle.edge(edge).unwrap();
        let [start, end] = [shared.start(), shared.end()];
        let beside = Triangle::new(1, [end, start, start + end + DVec3::Z]).unwrap();
        let (_, report) =
            mesh(&[Face::from(&triangle), Face::from(&beside)], &TessellationOptions::resolution(3));
        let mut open: Vec<_> = report.open_sides.iter().filter(|s| s.patch == 0).map(|s| s.side).collect();
        open.sort_unstable();
        assert_eq!(open, (0..3).filter(|&side| side != edge).collect::<Vec<_>>());
    }
}

#[test]
fn a_torus_is_closed() {
    check_body("torus", &RationalPatch::torus(DVec3::ONE, DVec3::new(1.0, 2.0, 2.0), 2.0, 0.7).unwrap(), 0);
}

/// The disc in the plane of a quarter's four control nets: a quadrant as a patch with a collapsed edge at the centre.
fn cap(quarter: &RationalPatch, edge: PatchEdge, center: DVec3, up: bool) -> RationalPatch {
    let rim = quarter.edge(edge);
    let net = rim.control_points().iter().flat_map(|&p| {
        let middle = (center * p.w).extend(p.w);
        if up { [p, middle] } else { [middle, p] }
    });
    RationalPatch::from_homogeneous([2, 1], net.collect::<Vec<DVec4>>()).unwrap()
}

#[test]
fn a_cylinder_with_caps_is_closed() {
    let (base, axis) = (dvec3(0.1, 0.2, 0.3), dvec3(0.0, 1.0, 2.0));
    let mut body = RationalPatch::cylinder(base, axis, 0.8).unwrap();
    for side in body.clone() {
        body.push(cap(&side, PatchEdge::VEnd, base + axis, true));
        body.push(cap(&side, PatchEdge::VStart, base, false));
    }
    check_body("cylinder", &body, 2);
    let cone = RationalPatch::cone(base, axis, 0.8).unwrap();
    let caps = cone.iter().map(|side| cap(side, PatchEdge::VStart, base, false));
    let body: Vec<_> = cone.iter().cloned().chain(caps).collect();
    check_body("cone", &body, 2);
}

/// A box whose side walls are one patch that closes on itself.
#[test]
fn a_patch_that_meets_itself_is_closed() {
    // A tube of degree 9 around z, its first and last control points the same.
    let around = |i: usize| {
        let angle = PI * 2.0 * (i % 9) as f64 / 9.0;
        dvec3(3.0 * angle.cos(), 3.0 * angle.sin(), 0.0)
    };
    let net = (0..=9).flat_map(|i| [around(i), around(i) + DVec3::Z]);
    let wall = Patch::new([9, 1], net.collect::<Vec<_>>()).unwrap();
    for options in
        [3, 8].map(TessellationOptions::resolution).into_iter().chain([TessellationOptions::tolerance(1e-3)])
    {
        let (mesh, report) = mesh(&[Face::from(&wall)], &options);
        let audit = mesh.audit().unwrap();
        assert!(audit.manifold && audit.oriented && audit.degenerate == 0, "{audit:?}");
        assert_eq!((audit.euler_characteristic, audit.closed), (0, false), "{options:?}");
        assert_eq!(report.open_sides.len(), 2);
    }
}

/// A wavy bicubic patch over other intervals.
fn wavy() -> Patch {
    let height = |i: usize, j: usize| ((3 * i + 5 * j) % 4) as f64 * 0.4;
    let net = (0..16).map(|k| dvec3((k / 4) as f64, 1.5 * (k % 4) as f64, height(k / 4, k % 4)));
    let intervals = [Interval::new(-3.0, 4.0).unwrap(), Interval::new(10.0, 10.5).unwrap()];
    Patch::new([3, 3], net.collect::<Vec<_>>()).unwrap().with_intervals(intervals)
}

#[test]
fn chord_errors_hold_over_any_intervals_and_in_the_power_basis() {
    let patch = wavy();
    // x = u, y = 2v, z = u² v over [1, 3] × [−1, 1].
    let mut coefficients = vec![DVec3::ZERO; 6];
    (coefficients[2], coefficients[1], coefficients[5]) = (DVec3::X, DVec3::Y * 2.0, DVec3::Z);
    let intervals = [Interval::new(1.0, 3.0).unwrap(), Interval::new(-1.0, 1.0).unwrap()];
    let power = PowerPatch::new([2, 1], coefficients).unwrap().with_intervals(intervals);
    let net: Vec<DVec3> =
        (0..21).map(|k| dvec3((k * 7 % 10) as f64, (k * 3 % 11) as f64, (k * 5 % 13) as f64 * 0.1)).collect();
    let triangle = Triangle::new(
        2,
        [
            DVec3::X * 3.0,
            dvec3(1.5, 1.5, 1.0),
            dvec3(1.5, 0.0, 1.0),
            DVec3::Y * 3.0,
            dvec3(0.0, 1.5, 1.0),
            DVec3::ZERO,
        ],
    )
    .unwrap();
    let wild = Triangle::new(5, net).unwrap();
    let all: [(&dyn ParametricSurface, Face<'_>); 3] =
        [(&patch, Face::from(&patch)), (&power, Face::from(&power)), (&triangle, Face::from(&triangle))];
    for (surface, face) in all {
        for tolerance in [3e-2, 1e-3, 1e-4] {
            let (mesh, report) = mesh(&[face], &TessellationOptions::tolerance(tolerance));
            let worst = measured(&[surface], &mesh);

            println!("{} triangles, {worst:.3e} of {tolerance:e}, {:?}", mesh.triangles.len(), report.space);
            assert!(worst <= tolerance, "{worst:e} of {tolerance:e}");
            assert!(worst >= 0.05 * tolerance, "too fine: {worst:e} of {tolerance:e}");
            assert!(1000 * report.space.interior_below_19 <= report.space.interior, "{:?}", report.space);
            assert!(100 * report.space.boundary_below_10 <= report.space.boundary + 99, "{:?}", report.space);
        }
    }
    // A folded one is meshed too.
    for tolerance in [3e-2, 1e-2, 4e-3] {
        let (mesh, _) = mesh(&[Face::from(&wild)], &TessellationOptions::tolerance(tolerance));
        assert!(measured(&[&wild], &mesh) <= tolerance);
    }
}

#[test]
fn triangles_are_not_folded() {
    let patch = wavy();
    for options in [TessellationOptions::resolution(10), TessellationOptions::tolerance(1e-2)] {
        let (mesh, report) = mesh(&[Face::from(&patch)], &options);
        assert!(report.domain.interior_least > 0.05 && report.domain.boundary_least > 0.05);
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
            let flat = (b - a).cross(c - a);
            for &v in t {
                assert!(flat.dot(mesh.normals[v as usize]) > 0.0);
            }
        }
    }
}

/// Neighbours of every kind around one curve: its points must be those of each.
#[test]
fn neighbours_of_all_kinds_agree_to_the_bit() {
    // The curve from (0, 0, 0) to (3, 0, 0) along y = 0.
    let rim = [DVec3::ZERO, dvec3(1.0, 0.0, 0.7), dvec3(2.0, 0.0, -0.3), dvec3(3.0, 0.0, 0.1)];
    let above: Vec<DVec3> = rim.iter().flat_map(|&p| [p, p + DVec3::Y]).collect();
    let patch = Patch::new([3, 1], above).unwrap();
    let below: Vec<DVec4> =
        rim.iter().rev().flat_map(|&p| [(p * 4.0).extend(4.0), (p - DVec3::Y).extend(1.0)]).collect();
    let rational = RationalPatch::from_homogeneous([3, 1], below).unwrap();
    // λ₃ = 0 is the rim.
    let mut net = vec![DVec3::NEG_Y; 10];
    for (place, point) in [0, 1, 3, 6].into_iter().zip(rim) {
        net[place] = point;
    }
    (net[2], net[4], net[5], net[7], net[8]) = (
        dvec3(0.2, -0.4, 0.0),
        dvec3(1.5, -0.4, 0.0),
        dvec3(0.5, -0.8, 0.0),
        dvec3(2.4, -0.4, 0.0),
        dvec3(1.2, -0.8, 0.0),
    );
    let triangle = Triangle::new(3, net).unwrap();
    let gb = common::patch_with_side(&rim);
    let options = TessellationOptions::tolerance(1e-3);
    let points = |face: Face<'_>| {
        let (mesh, _) = mesh(&[face], &options);
        let mut on: Vec<[u64; 3]> = mesh
            .positions
            .iter()
            .filter(|p| p.y == 0.0 && (-0.1..3.1).contains(&p.x))
            .map(|p| p.to_array().map(f64::to_bits))
            .collect();
        on.sort_unstable();
        on
    };
    let first = points(Face::from(&patch));
    assert!(first.len() > 5);
    for face in [Face::from(&rational), Face::from(&triangle), Face::from(&gb)] {
        assert_eq!(points(face), first, "{face:?}");
        let (_, report) = mesh(&[Face::from(&patch), face], &options);
        let sides = if matches!(face, Face::Triangle(_)) { 5 } else { 6 };
        assert_eq!(report.open_sides.len(), sides, "{face:?}");
    }
}

#[test]
fn poles_are_errors_that_name_the_place() {
    let net = [DVec3::ZERO, DVec3::Y, DVec3::X, dvec3(1.0, 1.0, 0.0)];
    // Weights −1 beside 1: the pole is at u = ½, where resolution 5 has no sample.
    let edges = RationalPatch::new([1, 1], &net, &[1.0, 1.0, -1.0, -1.0]).unwrap();
    // A pole inside only, where the weights of the middle row outweigh the others.
    let middle: Vec<DVec3> = (0..9).map(|k| dvec3((k / 3) as f64, (k % 3) as f64, 0.0)).collect();
    let inside = RationalPatch::new([2, 2], &middle, &[1., 1., 1., 1., -7., 1., 1., 1., 1.]).unwrap();
    let six: Vec<DVec3> =
        [[2., 0.], [1., 1.], [1., 0.], [0., 2.], [0., 1.], [0., 0.]].map(|[x, y]| dvec3(x, y, 0.0)).into();
    let triangle = RationalTriangle::new(2, &six, &[1., -2., 1., 1., -2., 1.]).unwrap();
    for face in [Face::from(&edges), Face::from(&inside), Face::from(&triangle)] {
        for options in [TessellationOptions::resolution(5), TessellationOptions::tolerance(1e-2)] {
            let refused = tessellate(&[Face::from(&wavy()), face], &options, &mut no_progress).unwrap_err();
            assert!(matches!(refused, TessError::Shape { patch: 1, .. }), "{refused}");
        }
    }
    // Negative throughout is no pole; a weight of 0 is none either.
    let negative = RationalPatch::new([1, 1], &net, &[-1.0; 4]).unwrap();
    let zero = RationalPatch::new([2, 2], &middle, &[1., 1., 1., 1., 0., 1., 1., 1., 1.]).unwrap();
    let faces = [Face::from(&negative), Face::from(&zero)];
    assert!(tessellate(&faces, &TessellationOptions::resolution(5), &mut no_progress).is_ok());
}

#[test]
fn limits_and_cancelling() {
    let patch = wavy();
    for density in [TessellationOptions::resolution(1_000_000_000), TessellationOptions::tolerance(1e-12)] {
        let refused = tessellate(&[&patch], &density, &mut no_progress).unwrap_err();
        assert!(matches!(refused, TessError::TooManyVertices { .. }), "{refused}");
    }
    let mut calls = 0;
    let stopped = tessellate(&[&patch], &TessellationOptions::tolerance(1e-5), &mut |_| {
        calls += 1;
        if calls > 5 { std::ops::ControlFlow::Break(()) } else { std::ops::ControlFlow::Continue(()) }
    });
    assert!(matches!(stopped, Err(TessError::Cancelled { .. })));
}

#[test]
fn points_and_lines_make_no_triangles_out_of_nothing() {
    // A patch that is a point, one that is a line, one of degree 0.
    let point = Patch::new([1, 1], vec![DVec3::ONE; 4]).unwrap();
    let nothing = Patch::new([0, 0], vec![DVec3::ONE]).unwrap();
    let line = Patch::new([1, 1], vec![DVec3::ZERO, DVec3::ZERO, DVec3::X, DVec3::X]).unwrap();
    let circle = RationalCurve::circle(DVec3::ZERO, DVec3::X, DVec3::Y).unwrap();
    assert_eq!(circle.len(), 4);
    for patch in [point, nothing, line] {
        for options in [TessellationOptions::resolution(4), TessellationOptions::tolerance(1e-2)] {
            match tessellate(&[&patch], &options, &mut no_progress) {
                Ok((mesh, _)) => assert!(mesh.validate().is_ok() && mesh.area().unwrap() < 1e-12),
                Err(error) => println!("{error}"),
            }
        }
    }
}
