//! What triangulations promise.
#![allow(clippy::unwrap_used)]

mod support;

use std::collections::HashMap;

use casteljau_domain::glam::DVec2;
use casteljau_domain::triangulation::{
    POOR_BOUNDARY_ANGLE, POOR_INNER_ANGLE, Triangulation, TriangulationOptions, triangulate,
};
use casteljau_domain::{DomainError, Polygon};
use support::{Random, convex, gallery, wild};

/// Spacings of boundary samples.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Spacing {
    Even,
    EverySecondSideFiveTimesDenser,
    Squared,
}

fn sampled(polygon: &Polygon, h: f64, spacing: Spacing) -> Polygon {
    let mut points = Vec::new();
    for i in 0..polygon.len() {
        let [a, b] = polygon.side(i);
        let mut n = (a.distance(b) / h).ceil() as usize;
        if spacing == Spacing::EverySecondSideFiveTimesDenser && i % 2 == 0 {
            n *= 5;
        }
        for k in 1..n {
            let t = k as f64 / n as f64;
            points.push(a.lerp(b, if spacing == Spacing::Squared { t * t } else { t }));
        }
        points.push(b);
    }
    Polygon::new(points).unwrap()
}

fn default(boundary: &Polygon, h: f64) -> Triangulation {
    triangulate(boundary, &|_| h, &TriangulationOptions::default()).unwrap()
}

/// Covers the polygon once, with the polygon's sides as its only free edges, all triangles counter-clockwise.
fn audit(mesh: &Triangulation, boundary: &Polygon) {
    let n = boundary.len();
    assert_eq!(mesh.boundary, n);
    assert!(mesh.points.iter().zip(boundary.vertices()).all(|(a, b)| a.to_array() == b.to_array()));
    let mut edges: HashMap<(u32, u32), usize> = HashMap::new();
    let mut area = 0.0;
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|i| mesh.points[i as usize]);
        let twice = (b - a).perp_dot(c - a);
        assert!(twice > 0.0, "{t:?}: {a} {b} {c}");
        area += 0.5 * twice;
        for k in 0..3 {
            *edges.entry((t[k], t[(k + 1) % 3])).or_default() += 1;
        }
    }
    let whole = boundary.signed_area().abs();
    assert!((area - whole).abs() < 1e-12 * mesh.triangles.len() as f64 * boundary.diameter().powi(2));
    let mut free = 0;
    for (&(a, b), &count) in &edges {
        assert_eq!(count, 1);
        if !edges.contains_key(&(b, a)) {
            let (a, b) = (a as usize, b as usize);
            assert!(a < n && b < n && ((a + 1) % n == b || (b + 1) % n == a), "{a} {b}");
            free += 1;
        }
    }
    assert_eq!(free, n);
    assert!(mesh.triangles.is_sorted() && mesh.triangles.iter().all(|t| t[0] < t[1] && t[0] < t[2]));
}

/// The report once more, from angles by the law of cosines.
fn poor(mesh: &Triangulation) -> [usize; 2] {
    let mut poor = [0; 2];
    for t in &mesh.triangles {
        let p = t.map(|i| mesh.points[i as usize]);
        let angle = |i: usize| (p[(i + 1) % 3] - p[i]).angle_to(p[(i + 2) % 3] - p[i]).abs();
        let least = (0..3).map(angle).fold(f64::INFINITY, f64::min);
        let touches = t.iter().any(|i| (*i as usize) < mesh.boundary);
        let limit = if touches { POOR_BOUNDARY_ANGLE } else { POOR_INNER_ANGLE };
        poor[usize::from(touches)] += usize::from(least < limit);
    }
    poor
}

#[test]
fn gallery_is_covered_and_inner_angles_are_kept() {
    for (name, polygon) in gallery() {
        for spacing in [Spacing::Even, Spacing::EverySecondSideFiveTimesDenser, Spacing::Squared] {
            for part in [0.3, 0.05, 0.02] {
                let h = part * polygon.diameter();
                let boundary = sampled(&polygon, h, spacing);
                let mesh = default(&boundary, h);
                audit(&mesh, &boundary);
                let report = mesh.report;
                assert!(report.complete);
                assert_eq!([report.inner_poor, report.boundary_poor], poor(&mesh));
                assert_eq!(report.inner_triangles + report.boundary_triangles, mesh.triangles.len());
                assert_eq!(report.inner_poor, 0, "{name} {spacing:?} {part}: {report:?}");
            }
        }
    }
}

#[test]
fn boundary_angles_are_kept_where_the_boundary_lets_them() {
    // Samples even, no corner below 30 degrees, no passage narrower than two samples.
    for (name, polygon) in gallery() {
        let sharpest = (0..polygon.len()).map(|i| polygon.interior_angle(i)).fold(f64::INFINITY, f64::min);
        if sharpest < 0.5 || polygon.clearance() < 0.01 * polygon.diameter() {
            continue;
        }
        for part in [0.1, 0.05, 0.01] {
            let h = (part * polygon.diameter()).min(0.5 * polygon.clearance());
            let report = default(&sampled(&polygon, h, Spacing::Even), h).report;
            assert_eq!(report.boundary_poor, 0, "{name} {part}: {report:?}");
        }
    }
}

#[test]
fn edges_follow_the_size_field() {
    let square = gallery().swap_remove(1).1;
    let boundary = sampled(&square, 0.02, Spacing::Even);
    let size = |p: DVec2| 0.02 + 0.3 * p.x.min(1.0 - p.x).min(p.y).min(1.0 - p.y);
    let mesh = triangulate(&boundary, &size, &TriangulationOptions::default()).unwrap();
    audit(&mesh, &boundary);
    for t in &mesh.triangles {
        let p = t.map(|i| mesh.points[i as usize]);
        let longest = (0..3).map(|i| p[i].distance(p[(i + 1) % 3])).fold(0.0, f64::max);
        assert!(longest < 1.3 * size((p[0] + p[1] + p[2]) / 3.0), "{p:?}");
    }
    let even = default(&boundary, 0.02);
    assert!(mesh.triangles.len() * 3 < even.triangles.len(), "the field saves triangles");
    assert_eq!(mesh.report.inner_poor, 0);
}

#[test]
fn the_limit_on_points_holds() {
    let square = gallery().swap_remove(1).1;
    let boundary = sampled(&square, 0.1, Spacing::Even);
    let options = TriangulationOptions { max_points: 100, ..Default::default() };
    let mesh = triangulate(&boundary, &|_| 1e-3, &options).unwrap();
    audit(&mesh, &boundary);
    assert!(!mesh.report.complete && mesh.points.len() == 100);
}

#[test]
fn scale_by_powers_of_two_and_orientation() {
    for (_, polygon) in gallery() {
        let h = 0.1 * polygon.diameter();
        let boundary = sampled(&polygon, h, Spacing::Even);
        let mesh = default(&boundary, h);
        let s = 2f64.powi(-100);
        let small = Polygon::new(boundary.vertices().iter().map(|p| *p * s).collect()).unwrap();
        let other = default(&small, h * s);
        assert_eq!(mesh.triangles, other.triangles);
        assert!(mesh.points.iter().zip(&other.points).all(|(a, b)| *a * s == *b));
        let reversed = Polygon::new(boundary.vertices().iter().rev().copied().collect()).unwrap();
        audit(&default(&reversed, h), &reversed);
    }
}

#[test]
fn wrong_options_are_typed_errors() {
    let square = gallery().swap_remove(1).1;
    let go = |size: f64, options| triangulate(&square, &|_| size, &options).map(|m| m.points.len());
    let bad = |r: Result<usize, DomainError>, name| matches!(r, Err(DomainError::BadOption { option, .. }) if option == name);
    let options = TriangulationOptions::default();
    assert!(bad(go(0.0, options), "size"));
    assert!(bad(go(f64::NAN, options), "size"));
    assert!(bad(go(1.0, TriangulationOptions { max_points: 3, ..options }), "max_points"));
    assert!(bad(go(1.0, TriangulationOptions { angle: 0.7, ..options }), "angle"));
    assert!(bad(go(1.0, TriangulationOptions { angle: f64::NAN, ..options }), "angle"));
    assert!(go(f64::INFINITY, TriangulationOptions { angle: 0.0, ..options }).unwrap() == 4);
}

#[test]
fn random_polygons_never_panic() {
    let mut random = Random(11);
    let (mut done, mut inner, mut inner_poor) = (0, 0, 0);
    for round in 0..2500 {
        let n = 3 + random.below(12);
        let polygon = if round % 5 == 0 { convex(&mut random, n) } else { wild(&mut random, n) };
        let Some(polygon) = polygon else { continue };
        let h = random.within(0.05, 0.5);
        let options = TriangulationOptions { max_points: 20_000, ..Default::default() };
        match triangulate(&polygon, &|_| h, &options) {
            Ok(mesh) => {
                let report = mesh.report;
                assert_eq!(poor(&mesh).map(|p| p > 0), [report.inner_poor > 0, report.boundary_poor > 0]);
                done += 1;
                inner += report.inner_triangles;
                inner_poor += report.inner_poor;
                assert!(report.complete, "{polygon:?}");
            }
            Err(DomainError::Unresolved { .. }) => {}
            Err(other) => panic!("{other}"),
        }
    }
    println!("{done} polygons, {inner} inner triangles, {inner_poor} poor");
    assert!(done > 500);
    // These boundaries have sides of 1e-16 beside sides of 1 and are not sampled.
    assert!(inner_poor * 30 < inner, "{inner_poor} of {inner}");
}
