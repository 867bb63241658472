//! Cells that fill solids: conforming, right side out, within the tolerance, to the bit across solids.
#![allow(missing_docs, clippy::unwrap_used, clippy::panic)]

mod common;

use std::f64::consts::PI;

use casteljau_geom::glam::{DVec3, dvec3};
use casteljau_mesh::VolumeMesh;
use casteljau_solid::{Axis, Hexahedron, RationalHexahedron};
use casteljau_tess::{
    CellKind, Density, Solid, TessError, VolumeOptions, VolumeReport, no_progress, volume_mesh,
};
use common::solids::{Any, any_solid, ball, cone, cylinder, folded_hexahedron, ring};
use proptest::prelude::*;

const KINDS: [CellKind; 2] = [CellKind::Own, CellKind::Tetrahedra];

fn mesh(solids: &[Solid<'_>], options: VolumeOptions) -> (VolumeMesh, VolumeReport) {
    volume_mesh(solids, &options, &mut no_progress).unwrap_or_else(|e| panic!("{options:?}: {e}"))
}

fn assert_valid(mesh: &VolumeMesh, report: &VolumeReport, what: &str) {
    let audit = mesh.audit().unwrap();
    assert!(audit.is_valid() && audit.boundary.manifold, "{what}: {audit:?}");
    assert_eq!((audit.unreferenced_vertices, report.not_positive), (0, 0), "{what}");
    // What is inside and what its surface encloses are the same; bilinear faces are cut either way.
    let (volume, enclosed) = (mesh.volume().unwrap(), mesh.boundary().unwrap().signed_volume().unwrap());
    if audit.cells[1..] == [0; 3] {
        assert!((volume - enclosed).abs() <= 1e-11 * volume, "{what}: {volume} {enclosed}");
    }
}

/// Cubes of weights and squares of lengths would leave the range of numbers; the mesh is the same.
#[test]
fn a_common_factor_of_weights_or_lengths_changes_nothing() {
    let ball = ball();
    let (plain, of_plain) = mesh(&[(&ball).into()], VolumeOptions::tolerance(0.125));
    assert!(of_plain.counts[0][0] > 1);
    for (in_space, in_weight) in [(0, -400), (0, 400), (-200, 0), (200, 0), (-200, 400)] {
        let (length, weight) = (2f64.powi(in_space), 2f64.powi(in_weight));
        let net = ball.control_points().iter().map(|p| (p.truncate() * length * weight).extend(p.w * weight));
        let scaled = RationalHexahedron::from_homogeneous(ball.degrees(), net.collect::<Vec<_>>()).unwrap();
        let (mesh, report) = mesh(&[(&scaled).into()], VolumeOptions::tolerance(0.125 * length));
        assert_eq!(report.counts, of_plain.counts, "{in_space} {in_weight}");
        assert_eq!(report.chord_error.map(|e| e / length), of_plain.chord_error);
        assert_eq!(mesh.positions.len(), plain.positions.len());
    }
}

#[test]
fn solids_of_revolution_converge_to_their_volumes() {
    let bodies =
        [("ball", ball(), 4.0 * PI / 3.0), ("cone", cone(), PI / 3.0), ("cylinder", cylinder(), 2.0 * PI)];
    for (name, solid, exact) in &bodies {
        for cells in KINDS {
            let mut before = f64::INFINITY;
            for resolution in [4, 8, 16] {
                let options = VolumeOptions { cells, ..VolumeOptions::resolution(resolution) };
                let (mesh, report) = mesh(&[solid.into()], options);
                assert_valid(&mesh, &report, name);
                let error = (mesh.volume().unwrap() - exact).abs();
                println!("{name} {cells:?} {resolution}: {} cells, off by {error:.2e}", mesh.cells.len());
                // Second order: a quarter with every halving, less what coarse meshes lack of that.
                assert!(error < 0.3 * before, "{name} {resolution}: {error} {before}");
                before = error;
            }
        }
        let options = VolumeOptions::tolerance(2e-2);
        let (mesh, report) = mesh(&[solid.into()], options);
        assert_valid(&mesh, &report, name);
        // All points of the boundary are within the tolerance of the exact one.
        let allowed = 2e-2 * mesh.boundary().unwrap().area().unwrap();
        assert!((mesh.volume().unwrap() - exact).abs() < allowed, "{name}");
    }
}

#[test]
fn poles_have_pyramids_and_edges_wedges() {
    let (mesh, report) = mesh(&[(&ball()).into()], VolumeOptions::resolution(4));
    let audit = mesh.audit().unwrap();
    assert_eq!((audit.cells, report.dropped, audit.repeated), ([0, 32, 0, 32], 0, 0));
    let (mesh, report) = self::mesh(&[(&folded_hexahedron()).into()], VolumeOptions::resolution(3));
    assert_valid(&mesh, &report, "folded");
    assert_eq!(mesh.audit().unwrap().cells, [0, 0, 9, 18]);
}

#[test]
fn a_ring_closes_on_itself() {
    let quarters = ring();
    for cells in KINDS {
        let solids: Vec<Solid<'_>> = quarters.iter().map(Solid::from).collect();
        let (mesh, report) = mesh(&solids, VolumeOptions { cells, ..VolumeOptions::tolerance(1e-2) });
        assert_valid(&mesh, &report, "ring");
        let boundary = mesh.boundary().unwrap();
        assert_eq!(boundary.audit().unwrap().euler_characteristic, 0);
        assert!((mesh.volume().unwrap() - 5.0 * PI).abs() < 1e-2 * boundary.area().unwrap());
    }
}

#[test]
fn counts_spread_through_shared_edges() {
    // A bent block on a straight one: the straight one is divided as the bent one needs.
    let bent = |p: DVec3| dvec3(p.x, p.y + 0.5 * p.x * p.x * p.z, p.z);
    let net = (0..27).map(|n| dvec3((n / 9) as f64 / 2.0, (n / 3 % 3) as f64 / 2.0, (n % 3) as f64 / 2.0));
    let block = Hexahedron::new([2, 2, 2], net.map(bent).collect::<Vec<_>>()).unwrap();
    let below = Hexahedron::unit_cube().elevated([1, 1, 1]).unwrap();
    let below =
        Hexahedron::new([2, 2, 2], below.control_points().iter().map(|p| *p - DVec3::Z).collect::<Vec<_>>());
    let below = below.unwrap();
    let (mesh, report) = mesh(&[(&block).into(), (&below).into()], VolumeOptions::tolerance(1e-3));
    assert_valid(&mesh, &report, "blocks");
    assert_eq!(report.counts[0][..2], report.counts[1][..2]);
    assert!(report.counts[1][0] > 4 && report.counts[1][2] == 1, "{:?}", report.counts);
    assert_eq!(mesh.boundary().unwrap().audit().unwrap().components, 1);
}

#[test]
fn what_cannot_be_meshed_is_said() {
    let cube = Hexahedron::unit_cube();
    let ask = |solids: &[Solid<'_>], options| volume_mesh(solids, &options, &mut no_progress).unwrap_err();
    assert_eq!(ask(&[], VolumeOptions::resolution(1)), TessError::Empty);
    assert!(matches!(
        ask(&[(&cube).into()], VolumeOptions::resolution(0)),
        TessError::Resolution { value: 0 }
    ));
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-15] {
        let refused = ask(&[(&cube).into()], VolumeOptions::tolerance(tolerance));
        assert!(matches!(refused, TessError::Tolerance { .. }), "{refused}");
    }
    assert!(matches!(
        ask(&[(&ball()).into()], VolumeOptions::tolerance(1e-9)),
        TessError::TooManySolidVertices { solid: 0, .. }
    ));
    let weights = [1.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0];
    let pole = RationalHexahedron::new([1; 3], cube.control_points(), &weights).unwrap();
    let (left, _) = pole.split(Axis::U, 0.25).unwrap();
    assert!(volume_mesh(&[left], &VolumeOptions::resolution(3), &mut no_progress).is_ok());
    let (part, _) = pole.split(Axis::U, 0.75).unwrap();
    let refused = volume_mesh(&[part], &VolumeOptions::resolution(3), &mut no_progress).unwrap_err();
    // An edge finds it first.
    assert!(matches!(refused, TessError::Solid { solid: 0, .. }), "{refused}");
    let net = cube.elevated([1; 3]).unwrap();
    let mut weights = [1.0; 27];
    weights[13] = -9.0; // the middle, seen by no face
    let pole = RationalHexahedron::new([2; 3], net.control_points(), &weights).unwrap();
    let refused = volume_mesh(&[pole], &VolumeOptions::resolution(3), &mut no_progress).unwrap_err();
    assert!(matches!(refused, TessError::SolidPole { solid: 0, .. }), "{refused}");
    let stop = volume_mesh(&[cube], &VolumeOptions::resolution(3), &mut |_| std::ops::ControlFlow::Break(()));
    assert!(matches!(stop, Err(TessError::Cancelled { .. })));
}

#[test]
fn a_solid_that_folds_has_cells_that_say_so() {
    // The middle layer of control points is pulled through the first.
    let mut net: Vec<DVec3> =
        (0..12).map(|n| dvec3((n / 4) as f64, (n / 2 % 2) as f64, (n % 2) as f64)).collect();
    net[4..8].iter_mut().for_each(|p| p.x = -3.0);
    net[4].y = 0.3;
    let folded = Hexahedron::new([2, 1, 1], net).unwrap();
    let (mesh, report) = mesh(&[(&folded).into()], VolumeOptions::resolution(6));
    assert!(report.not_positive > 0);
    assert!(!mesh.audit().unwrap().is_valid());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn random_solids_are_filled(solid in any_solid()) {
        let size = size(&solid);
        for cells in KINDS {
            for density in [Density::Resolution(1), Density::Resolution(3), Density::Tolerance(4e-3 * size)] {
                let options = VolumeOptions { cells, ..VolumeOptions::new(density) };
                let (whole, report) = mesh(&[solid.solid()], options);
                assert_valid(&whole, &report, "whole");
                let halves = solid.halves();
                let both: Vec<Solid<'_>> = halves.iter().map(Any::solid).collect();
                let (parts, report) = mesh(&both, options);
                assert_valid(&parts, &report, "halves");
                // One body: the wall between the halves is inside.
                prop_assert_eq!(parts.boundary().unwrap().audit().unwrap().euler_characteristic, 2);
                if let Density::Tolerance(tolerance) = density {
                    prop_assert!(report.chord_error.unwrap() <= tolerance);
                    let area = whole.boundary().unwrap().area().unwrap();
                    let apart = (whole.volume().unwrap() - parts.volume().unwrap()).abs();
                    prop_assert!(apart <= 2.0 * tolerance * area, "{} {}", apart, tolerance * area);
                }
            }
        }
    }
}

fn size(solid: &Any) -> f64 {
    let parametric = solid.solid();
    let at = |x: f64, y: f64, z: f64| parametric.parametric().try_point([x, y, z]).unwrap();
    let corners = [at(0., 0., 0.), at(1., 0., 0.), at(0., 1., 0.), at(0., 0., 1.)];
    casteljau_mesh::BoundingBox::from_points(corners).unwrap().diagonal()
}
