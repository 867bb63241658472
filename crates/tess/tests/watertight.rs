//! Closed models give closed meshes, and sides are sampled by their curves alone.
#![allow(missing_docs, clippy::unwrap_used)]

mod common;

use std::collections::{HashMap, HashSet};

use casteljau_gb::glam::DVec3;
use casteljau_gb::{ConcavePatch, Ribbon};
use casteljau_mesh::TriangleMesh;
use casteljau_shape::Curve;
use casteljau_tess::{Density, Seams, SideSamples, TessellationOptions, no_progress, tessellate};
use common::{cube, l_polygon, pillow, star_polygon, u_polygon};
use proptest::prelude::*;

fn assert_closed(mesh: &TriangleMesh, what: &str) {
    let audit = mesh.audit().unwrap();
    assert!(audit.closed && audit.manifold && audit.oriented, "{what}: {audit:?}");
    assert_eq!((audit.euler_characteristic, audit.components), (2, 1), "{what}");
    assert_eq!((audit.degenerate, audit.unreferenced_vertices), (0, 0), "{what}");
    assert!(mesh.signed_volume().unwrap() > 0.0, "{what}");
}

#[test]
fn closed_bodies_give_closed_meshes() {
    let bodies: [(&str, Vec<ConcavePatch>); 4] = [
        ("cube", cube()),
        ("pillow over an L", pillow(&l_polygon()).into()),
        ("pillow over a U", pillow(&u_polygon()).into()),
        ("pillow over a star", pillow(&star_polygon()).into()),
    ];
    for (name, body) in bodies {
        for options in [1, 2, 3, 7, 16].map(TessellationOptions::resolution) {
            let (mesh, report) = tessellate(&body, &options, &mut no_progress).unwrap();
            assert_closed(&mesh, &format!("{name}, {options:?}"));
            assert!(report.is_closed(), "{name}: {report:?}");
        }
        for tolerance in [0.1, 0.01, 0.001] {
            let options = TessellationOptions::tolerance(tolerance);
            let (mesh, report) = tessellate(&body, &options, &mut no_progress).unwrap();
            assert_closed(&mesh, &format!("{name}, {tolerance}"));
            assert!(report.is_closed() && report.chord_error.unwrap() <= tolerance, "{name}: {report:?}");
        }
    }
}

/// The bits of the vertices on the boundary of a mesh.
fn boundary_bits(mesh: &TriangleMesh) -> HashSet<[u64; 3]> {
    let loops = mesh.boundary_loops().unwrap();
    loops.iter().flatten().map(|&v| mesh.positions[v as usize].to_array().map(f64::to_bits)).collect()
}

#[test]
fn patches_meshed_in_separate_calls_meet_to_the_bit() {
    for options in [TessellationOptions::resolution(13), TessellationOptions::tolerance(2e-3)] {
        let [above, below] = pillow(&u_polygon());
        let alone = |patch: &ConcavePatch| {
            tessellate(std::slice::from_ref(patch), &options, &mut no_progress).unwrap().0
        };
        let (above, below) = (boundary_bits(&alone(&above)), boundary_bits(&alone(&below)));
        assert_eq!(above, below);
        assert!(above.len() > 50);
    }
}

#[test]
fn separate_seams_keep_vertices_and_weld_closed() {
    let options = TessellationOptions { seams: Seams::Separate, ..TessellationOptions::resolution(9) };
    let body = cube();
    let (mesh, _) = tessellate(&body, &options, &mut no_progress).unwrap();
    assert_eq!(mesh.audit().unwrap().components, 6);
    assert_closed(&mesh.welded().unwrap().mesh, "welded");
    let (merged, _) = tessellate(&body, &TessellationOptions::resolution(9), &mut no_progress).unwrap();
    assert_eq!(mesh.welded().unwrap().mesh.positions.len(), merged.positions.len());
    // On an edge of the cube the two faces' normals differ; each keeps its own.
    let mut normals: HashMap<[u64; 3], Vec<DVec3>> = HashMap::new();
    for (p, n) in mesh.positions.iter().zip(&mesh.normals) {
        normals.entry(p.to_array().map(f64::to_bits)).or_default().push(*n);
    }
    assert!(normals.values().any(|n| n.len() == 2 && n[0].dot(n[1]) < 0.9));
}

#[test]
fn a_side_that_nobody_shares_is_open_and_one_run_twice_the_same_way_is_reported() {
    let mut body = cube();
    let removed = body.pop().unwrap();
    let options = TessellationOptions::resolution(4);
    let (mesh, report) = tessellate(&body, &options, &mut no_progress).unwrap();
    assert_eq!(report.open_sides.len(), 4);
    assert_eq!(mesh.boundary_loops().unwrap().len(), 1);
    // The same face inside out: its ribbons in reverse order.
    let ribbons: Vec<Ribbon> = removed.ribbons().iter().rev().map(Ribbon::reversed).collect();
    let wrong = ConcavePatch::builder(ribbons)
        .layout(casteljau_gb::LayoutKind::Regular)
        .coordinates(casteljau_gb::CoordinateKind::MeanValue)
        .build()
        .unwrap();
    body.push(wrong);
    let (mesh, report) = tessellate(&body, &options, &mut no_progress).unwrap();
    assert_eq!((report.open_sides.len(), report.misoriented.len()), (0, 4), "{report:?}");
    let audit = mesh.audit().unwrap();
    assert!(audit.closed && !audit.oriented);
    // A third patch on the sides of another.
    let extra = body[0].clone();
    body.push(extra);
    let report = tessellate(&body, &options, &mut no_progress).unwrap().1;
    assert_eq!(report.crowded_sides.len(), 12);
}

/// Coordinates that hunt: zeros of both signs, repeats, neighbours, spread exponents.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(0.0),
        Just(-0.0),
        Just(1.0),
        (-3..=3i32).prop_map(f64::from),
        (-1.0..1.0),
        (-1.0..1.0, -12..6i32).prop_map(|(x, e)| x * 10f64.powi(e)),
        (0..32u64).prop_map(|ulps| f64::from_bits(1f64.to_bits() + ulps)),
    ]
}

fn curve() -> impl Strategy<Value = Curve> {
    prop::collection::vec([coordinate(), coordinate(), coordinate()], 2..9)
        .prop_map(|points| Curve::new(points.into_iter().map(DVec3::from).collect::<Vec<_>>()).unwrap())
}

/// C(t) = C(1−t): the curve and its reverse are one, and so the samples read the same both ways.
#[test]
fn a_curve_that_runs_back_on_itself_has_the_same_samples_both_ways() {
    for height in [1.0, 0.1, 1.0 / 3.0] {
        let [a, b, c] = [DVec3::splat(0.7), DVec3::new(0.3, 1.1, height), DVec3::new(-0.2, height, 0.9)];
        for net in [vec![DVec3::ZERO, DVec3::Z * height, DVec3::ZERO], vec![a, b, b, a], vec![a, b, c, b, a]]
        {
            let curve = Curve::new(net).unwrap();
            for density in
                [1e-2, 1e-4, 1e-5].map(Density::Tolerance).into_iter().chain([3, 10].map(Density::Resolution))
            {
                let samples = SideSamples::new(&curve, density, 100_000).unwrap();
                assert!(samples.points().iter().eq(samples.points().iter().rev()), "{curve:?} {density:?}");
                let back: Vec<f64> = samples.parameters().iter().rev().map(|t| 1.0 - t).collect();
                assert_eq!(samples.parameters(), back);
            }
        }
    }
}

/// Distance from p to the segment ab.
fn distance(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let along = b - a;
    let t = if along == DVec3::ZERO { 0.0 } else { (p - a).dot(along) / along.length_squared() };
    p.distance(a + along * t.clamp(0.0, 1.0))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn a_curve_and_its_reverse_have_the_same_samples(
        curve in curve(), tolerance in prop_oneof![1e-5..1e-1f64, Just(10.0)], count in 1..70usize,
    ) {
        for density in [Density::Tolerance(tolerance), Density::Resolution(count)] {
            let there = SideSamples::new(&curve, density, 1_000_000).unwrap();
            let back = SideSamples::new(&curve.reversed(), density, 1_000_000).unwrap();
            let flipped: Vec<DVec3> =
                curve.control_points().iter().map(|p| -(-*p + DVec3::ZERO)).collect();
            let flipped = SideSamples::new(&Curve::new(flipped).unwrap(), density, 1_000_000).unwrap();
            let bits = |p: &DVec3| p.to_array().map(f64::to_bits);
            prop_assert!(there.points().iter().map(bits).eq(back.points().iter().rev().map(bits)));
            prop_assert!(there.points().iter().map(bits).eq(flipped.points().iter().map(bits)));
            prop_assert_eq!(there.points()[0], curve.control_points()[0]);
            prop_assert_eq!(there.points().last(), curve.control_points().last());
            prop_assert!(there.parameters().windows(2).all(|w| w[0] < w[1]));
            prop_assert_eq!((there.parameters()[0], there.parameters().last()), (0.0, Some(&1.0)));
            let scale = curve.control_points().iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
            for (&t, &p) in there.parameters().iter().zip(there.points()) {
                // Twice the error of an evaluation, and a parameter rounded to 2^-53.
                let bound = (8 * (curve.degree() + 2) + 2 * curve.degree()) as f64 * f64::EPSILON * scale;
                prop_assert!(curve.point(t).distance(p) <= bound);
            }
            let Density::Resolution(count) = density else { continue };
            // A curve that is a point, within rounding, has its two ends only.
            let spread = curve.control_points().iter().map(|p| p.distance(curve.start())).fold(0.0, f64::max);
            if spread == 0.0 {
                prop_assert_eq!(there.points().len(), 2);
            } else if spread > 64.0 * f64::EPSILON * scale {
                prop_assert_eq!(there.points().len(), count + 1);
            }
        }
    }

    #[test]
    fn chords_keep_the_tolerance(curve in curve(), tolerance in 1e-5..1e-1f64) {
        let samples = SideSamples::new(&curve, Density::Tolerance(tolerance), 1_000_000).unwrap();
        prop_assert!(samples.chord_error() <= tolerance);
        for (t, p) in samples.parameters().windows(2).zip(samples.points().windows(2)) {
            for i in 1..8 {
                let at = curve.point(t[0] + (t[1] - t[0]) * f64::from(i) / 8.0);
                prop_assert!(distance(at, p[0], p[1]) <= tolerance * (1.0 + 1e-9) + 1e-13);
            }
        }
    }
}
