//! A motion, a scale or a renumbering changes a layout by rounding only.

use std::f64::consts::{PI, TAU};

use casteljau_domain::glam::{DQuat, DVec3, EulerRot};
use casteljau_domain::layout::{self, Layout, LayoutOptions};
use proptest::prelude::*;

use crate::brute::misfit;

/// Promise of the layouts, in units of their size.
const BOUND: f64 = 1e-12;

/// Corners about a circle, so that the projection is simple, some moved inward; heights say how planar they
/// are.
fn wavy(radii: &[f64], heights: &[f64]) -> Vec<DVec3> {
    let n = radii.len();
    let at = |i: usize| {
        let angle = TAU * i as f64 / n as f64;
        DVec3::new(1.3 * radii[i] * angle.cos(), radii[i] * angle.sin(), heights[i])
    };
    (0..n).map(at).collect()
}

/// Eigenvalues of the covariance that differ by more than 1e-3 of the largest, by the characteristic
/// polynomial's roots in trigonometric form, with a margin for the error of this form.
fn distinct(corners: &[DVec3]) -> bool {
    let n = corners.len() as f64;
    let mean = corners.iter().sum::<DVec3>() / n;
    let entry = |i: usize, j: usize| corners.iter().map(|p| (*p - mean)[i] * (*p - mean)[j]).sum::<f64>() / n;
    let m = [
        [entry(0, 0), entry(0, 1), entry(0, 2)],
        [entry(1, 0), entry(1, 1), entry(1, 2)],
        [entry(2, 0), entry(2, 1), entry(2, 2)],
    ];
    let q = (m[0][0] + m[1][1] + m[2][2]) / 3.0;
    let off = m[0][1] * m[0][1] + m[0][2] * m[0][2] + m[1][2] * m[1][2];
    let p = (((0..3).map(|i| (m[i][i] - q).powi(2)).sum::<f64>() + 2.0 * off) / 6.0).sqrt();
    let b = |i: usize, j: usize| (m[i][j] - if i == j { q } else { 0.0 }) / p;
    let det = b(0, 0) * (b(1, 1) * b(2, 2) - b(1, 2) * b(2, 1))
        - b(0, 1) * (b(1, 0) * b(2, 2) - b(1, 2) * b(2, 0))
        + b(0, 2) * (b(1, 0) * b(2, 1) - b(1, 1) * b(2, 0));
    let phi = (det / 2.0).clamp(-1.0, 1.0).acos() / 3.0;
    let largest = q + 2.0 * p * phi.cos();
    let least = q + 2.0 * p * (phi + TAU / 3.0).cos();
    let middle = 3.0 * q - largest - least;
    largest - middle > 1.01e-3 * largest && middle - least > 1.01e-3 * largest
}

fn assert_same(a: &Layout, b: &Layout, shift: usize, context: &str) -> Result<(), TestCaseError> {
    let mut moved = b.polygon.vertices().to_vec();
    moved.rotate_right(shift);
    let worst = misfit(a.polygon.vertices(), &moved, false);
    prop_assert!(worst <= BOUND, "{}: {:e}", context, worst);
    prop_assert_eq!(a.repaired, b.repaired);
    prop_assert_eq!(a.blend, b.blend);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 5_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn projection_is_invariant(
        (radii, heights) in (3usize..12).prop_flat_map(|n| (prop::collection::vec(0.3..1.0, n), prop::collection::vec(-0.5..0.5, n))),
        flatness in prop_oneof![Just(0.0), 0.0..1.0],
        angles in [-PI..PI, -PI..PI, -PI..PI],
        shift in 0usize..12,
        scale in -6.0..6.0,
        offset in [-1.0..1.0, -1.0..1.0, -1.0..1.0],
    ) {
        let heights: Vec<f64> = heights.iter().map(|h| h * flatness).collect();
        let corners = wavy(&radii, &heights);
        prop_assume!(distinct(&corners));
        let shift = shift % corners.len();
        let turn = DQuat::from_euler(EulerRot::XYZ, angles[0], angles[1], angles[2]);
        let mut moved: Vec<DVec3> = corners.iter().map(|p| (turn * *p + DVec3::from(offset)) * 10f64.powf(scale)).collect();
        moved.rotate_left(shift);
        let options = LayoutOptions::default();
        let a = layout::projection(&corners, None, &options).unwrap();
        let b = layout::projection(&moved, None, &options).unwrap();
        assert_same(&a, &b, shift, "projection")?;
    }

    #[test]
    fn heuristic_is_invariant(
        sides in prop::collection::vec((prop_oneof![0.3..1.0, (-6.0..6.0).prop_map(|e: f64| 10f64.powf(e))], prop_oneof![-PI..PI, 0.3..2.0]), 3..14),
        shift in 0usize..14,
        scale in -6.0..6.0,
    ) {
        let (lengths, turning): (Vec<f64>, Vec<f64>) = sides.into_iter().unzip();
        let shift = shift % lengths.len();
        let mut moved: Vec<f64> = lengths.iter().map(|l| l * 10f64.powf(scale)).collect();
        let mut moved_turning = turning.clone();
        moved.rotate_left(shift);
        moved_turning.rotate_left(shift);
        let options = LayoutOptions::default();
        let a = layout::heuristic(&lengths, &turning, &options).unwrap();
        let b = layout::heuristic(&moved, &moved_turning, &options).unwrap();
        assert_same(&a, &b, shift, &format!("heuristic, blend {}", a.blend))?;
    }
}

/// Regular polygons, cubes' hexagons and the like have equal principal values: the tie-breaks are equivariant
/// too.
#[test]
fn ties_are_broken_the_same_way_in_every_position() {
    let octahedral = [DVec3::X, DVec3::Y, -DVec3::Z, -DVec3::X, -DVec3::Y, DVec3::Z];
    let tetrahedral = [
        DVec3::new(1., 1., 1.),
        DVec3::new(-1., -1., 1.),
        DVec3::new(-1., 1., -1.),
        DVec3::new(1., -1., -1.),
    ];
    let regular =
        wavy(&[1.0; 7], &[0.0; 7]).iter().map(|p| DVec3::new(p.x / 1.3, p.y, p.z)).collect::<Vec<_>>();
    let long = [
        DVec3::new(-3., 0., 0.),
        DVec3::new(0., -1., 0.2),
        DVec3::new(3., 0., 0.),
        DVec3::new(0., 0., 1.),
        DVec3::new(0., 0.3, 0.6),
    ];
    for corners in [&octahedral[..], &tetrahedral[..], &regular[..], &long[..]] {
        let a = layout::projection(corners, None, &LayoutOptions::default()).unwrap();
        for shift in 0..corners.len() {
            let turn = DQuat::from_euler(EulerRot::XYZ, 0.7 + shift as f64, -1.1, 2.3);
            let mut moved: Vec<DVec3> = corners.iter().map(|p| turn * *p * 37.0).collect();
            moved.rotate_left(shift);
            let b = layout::projection(&moved, None, &LayoutOptions::default()).unwrap();
            let mut back = b.polygon.vertices().to_vec();
            back.rotate_right(shift);
            let worst = misfit(a.polygon.vertices(), &back, false);
            assert!(worst < BOUND, "{corners:?}: {worst:e}");
        }
    }
}
