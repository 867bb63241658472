//! Areas against closed forms, and under operations that keep them.
#![allow(clippy::unwrap_used)] // helpers of tests

use std::f64::consts::PI;

use casteljau_geom::Interval;
use casteljau_geom::glam::DVec3;
use casteljau_shape::{ParametricSurface, Patch, RationalPatch, RationalTriangle, ShapeError, Triangle};
use proptest::collection::vec;
use proptest::prelude::*;

fn total(patches: &[RationalPatch], relative: f64) -> f64 {
    patches.iter().map(|p| p.area(relative).unwrap()).sum()
}

#[test]
fn closed_forms() {
    for r in [1e-6, 1.0, 1e6] {
        let center = DVec3::new(1.0, 2.0, 3.0) * r;
        let close = |area: f64, exact: f64| assert!((area - exact).abs() <= 2e-12 * exact, "{area} {exact}");
        close(total(&RationalPatch::sphere(center, r).unwrap(), 1e-12), 4.0 * PI * r * r);
        close(
            total(&RationalPatch::cylinder(center, DVec3::ONE * r, r).unwrap(), 1e-12),
            2.0 * PI * r * r * 3_f64.sqrt(),
        );
        close(
            total(&RationalPatch::cone(center, DVec3::Z * (2.0 * r), 1.5 * r).unwrap(), 1e-12),
            PI * 1.5 * r * 2.5 * r,
        );
        close(
            total(&RationalPatch::torus(center, DVec3::X, 3.0 * r, r).unwrap(), 1e-12),
            12.0 * PI * PI * r * r,
        );
        let octant =
            RationalTriangle::sphere_octant(center, DVec3::X * r, DVec3::Y * r, DVec3::Z * r).unwrap();
        close(octant.area(1e-12).unwrap(), 0.5 * PI * r * r);
        let flat = Triangle::new(1, [DVec3::ZERO, DVec3::X * r, DVec3::Y * r]).unwrap();
        close(flat.area(1e-12).unwrap(), 0.5 * r * r);
    }
}

#[test]
fn folds_and_nothing() {
    // x = u(2 − 3u)…: a sheet that turns back on itself along u = 1/3 has 2·4/27 more than its extent.
    let x = [0.0, 1.0, -1.0];
    let sheet = Patch::new(
        [2, 1],
        x.iter().flat_map(|&x| [DVec3::X * x, DVec3::new(x, 1.0, 0.0)]).collect::<Vec<_>>(),
    )
    .unwrap();
    // x = 2u − 3u²: up to 1/3 at u = 1/3, down to −1.
    let exact = 1.0 / 3.0 + 4.0 / 3.0;
    assert!((sheet.area(1e-6).unwrap() - exact).abs() <= 1e-6 * exact);
    let line = Patch::new([1, 1], [DVec3::ZERO, DVec3::X, DVec3::X, 2.0 * DVec3::X]).unwrap();
    assert!(matches!(line.area(1e-3), Err(ShapeError::Area { .. })));
    for relative in [0.0, 1.0, f64::NAN] {
        assert!(matches!(sheet.area(relative), Err(ShapeError::Accuracy { .. })));
    }
    let pole = RationalPatch::new([1, 0], &[DVec3::ZERO, DVec3::X], &[1.0, -1.0]).unwrap();
    assert!(pole.area(1e-3).is_err());
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE];
    let infinite = RationalPatch::new([1, 1], &corners, &[1.0, 1.0, -1.0, -1.0]).unwrap();
    assert!(infinite.area(1e-3).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn parts_add_up(heights in vec(-1.0..1.0, 12), weights in vec(0.5..2.0, 12), cut in 0.2..0.8) {
        let net: Vec<DVec3> = heights.iter().enumerate().map(|(k, &z)| DVec3::new((k / 4) as f64, (k % 4) as f64, z)).collect();
        let patch = RationalPatch::new([2, 3], &net, &weights).unwrap();
        let whole = patch.area(1e-9).unwrap();
        let (left, right) = patch.split_v(cut).unwrap();
        prop_assert!((left.area(1e-9).unwrap() + right.area(1e-9).unwrap() - whole).abs() <= 3e-9 * whole);
        let other = patch.swapped().with_intervals([Interval::new(-1e3, 1e3).unwrap(), Interval::new(0.0, 1e-3).unwrap()]);
        prop_assert!((other.area(1e-9).unwrap() - whole).abs() <= 2e-9 * whole);
        // A graph is no smaller than its shadow.
        let shadow: Vec<DVec3> = net.iter().map(|p| p.with_z(0.0)).collect();
        prop_assert!(RationalPatch::new([2, 3], &shadow, &weights).unwrap().area(1e-9).unwrap() <= whole * (1.0 + 1e-8));
    }
}
