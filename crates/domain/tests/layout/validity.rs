//! Every outline gets a valid polygon.

use std::f64::consts::{FRAC_PI_2, PI};

use casteljau_domain::glam::DVec3;
use casteljau_domain::layout::{self, LayoutOptions, required_clearance};
use casteljau_domain::{DomainError, Orientation};
use proptest::prelude::*;

use crate::brute::assert_valid;

/// Angles that hunt: cusps, straight corners, right angles, within a few ulps of these, and everything
/// between.
fn angle() -> impl Strategy<Value = f64> {
    let special = prop_oneof![
        Just(0.0),
        Just(PI),
        Just(-PI),
        Just(FRAC_PI_2),
        Just(-FRAC_PI_2),
        Just(1e-8),
        Just(-1e-8)
    ];
    let near = (special, -32i64..=32).prop_map(|(a, ulps): (f64, i64)| {
        f64::from_bits((a.to_bits() as i64).saturating_add(ulps).max(0) as u64 | a.to_bits() & (1 << 63))
            .clamp(-PI, PI)
    });
    prop_oneof![near, -PI..PI, -PI..PI, 0.0..PI]
}

fn length() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(1.0),
        0.1..10.0,
        (-6.0..6.0).prop_map(|e: f64| 10f64.powf(e)),
        (-300.0..300.0).prop_map(|e: f64| 10f64.powf(e))
    ]
}

fn sides(most: usize) -> impl Strategy<Value = Vec<(f64, f64)>> {
    prop::collection::vec((length(), angle()), 3..most)
}

fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(0.0),
        Just(1.0),
        Just(1.0 + f64::EPSILON),
        -1.0..1.0,
        -1.0..1.0,
        (-12.0..0.0).prop_map(|e: f64| 10f64.powf(e))
    ]
}

fn corners() -> impl Strategy<Value = Vec<DVec3>> {
    let point = (coordinate(), coordinate(), coordinate()).prop_map(|(x, y, z)| DVec3::new(x, y, z));
    prop::collection::vec(point, 3..14)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_lengths_and_angles_give_a_valid_polygon(sides in sides(16), clearance in prop_oneof![Just(0.02), 0.0..1.0]) {
        let (lengths, turning): (Vec<f64>, Vec<f64>) = sides.into_iter().unzip();
        let options = LayoutOptions { clearance };
        let layout = layout::heuristic(&lengths, &turning, &options).unwrap();
        assert_valid(&layout, required_clearance(lengths.len(), &options), &format!("{lengths:?} {turning:?}"));
        if turning.iter().filter(|a| **a >= -layout::STRAIGHT).count() >= 3 {
            let asked: Vec<bool> = turning.iter().map(|a| *a < -layout::STRAIGHT).collect();
            prop_assert_eq!(layout.concave, asked);
        }
    }

    #[test]
    fn any_corners_give_a_valid_polygon(
        corners in corners(), flags in prop::collection::vec(any::<bool>(), 14), given in any::<bool>(), scale in -100.0..100.0f64,
    ) {
        let n = corners.len();
        prop_assume!((0..n).all(|i| corners[i] != corners[(i + 1) % n]));
        let corners: Vec<DVec3> = corners.into_iter().map(|p| p * 10f64.powf(scale)).collect();
        let flags = given.then_some(&flags[..n]);
        let options = LayoutOptions::default();
        let layout = layout::projection(&corners, flags, &options).unwrap();
        assert_valid(&layout, required_clearance(n, &options), &format!("{corners:?} {flags:?}"));
        if let Some(flags) = flags.filter(|f| f.iter().filter(|c| !**c).count() >= 3) {
            prop_assert_eq!(&layout.concave[..], flags);
        }
    }
}

/// A cusp beside an all but straight corner: rounding decides the sign of the cusp's turning angle.
#[test]
fn flags_hold_at_cusps() {
    let corners = [
        DVec3::new(1.0000000000000002, 2.0526577101717584e-7, 0.0),
        DVec3::new(1.0, -0.748594957778198, 1.0000000000000002),
        DVec3::new(1.0, 0.0, 0.0),
        DVec3::new(1.0000000000000002, 0.45429889082633035, 0.0),
    ]
    .map(|p| p * 10f64.powf(-26.338026476633342));
    let flags = [true, false, false, false];
    let layout = layout::projection(&corners, Some(&flags), &LayoutOptions::default()).unwrap();
    assert_eq!(layout.concave, flags);
}

/// Cusps everywhere, and lengths over 600 orders of magnitude.
#[test]
fn every_pattern_of_corners_has_a_polygon_for_the_worst_of_lengths() {
    for n in 3..=9usize {
        for pattern in 0..1u32 << n {
            let turning: Vec<f64> = (0..n).map(|i| if pattern >> i & 1 == 1 { -PI } else { PI }).collect();
            if (pattern.count_ones() as usize) + 3 > n {
                continue;
            }
            let lengths: Vec<f64> = (0..n).map(|i| 10f64.powi(if i == 0 { 300 } else { -300 })).collect();
            let layout = layout::heuristic(&lengths, &turning, &LayoutOptions { clearance: 1.0 }).unwrap();
            assert_valid(&layout, layout::GUARANTEED_CLEARANCE / n as f64, &format!("{n} {pattern:b}"));
        }
    }
}

#[test]
fn large_loops_end() {
    // A closed spiral of 2,000 sides whose plain outline crosses itself, and 2,000 sides with random corners.
    let n = 2000;
    let wave = |i: usize| (i as f64 * 12.9898).sin() * 43758.5453;
    let random: Vec<f64> = (0..n).map(|i| PI * (2.0 * (wave(i) - wave(i).floor()) - 1.0)).collect();
    let spiral: Vec<f64> = (0..n).map(|i| if i < n / 2 { 0.1 } else { -0.1 }).collect();
    for turning in [random, spiral] {
        let layout = layout::heuristic(&vec![1.0; n], &turning, &LayoutOptions::default()).unwrap();
        assert_valid(&layout, layout::GUARANTEED_CLEARANCE / n as f64, "large");
    }
}

#[test]
fn loops_with_too_few_convex_corners_keep_the_least_concave_ones() {
    let turning = [-0.1, -1.0, 0.5, -0.2, -2.0, -1.5];
    let layout = layout::heuristic(&[1.0; 6], &turning, &LayoutOptions::default()).unwrap();
    assert_eq!(layout.concave, [false, true, false, false, true, true]);
    let layout = layout::heuristic(&[1.0; 5], &[-1.0; 5], &LayoutOptions::default()).unwrap();
    assert_eq!(layout.concave, [false; 5]);
    assert!(layout.polygon.is_convex());
}

#[test]
fn a_mild_repair_stays_close_to_what_was_asked_for() {
    // A rectangle one hundred times as long as wide is too narrow for the default, and no more is done than
    // needed.
    let lengths = [100.0, 1.0, 100.0, 1.0];
    let layout = layout::heuristic(&lengths, &[FRAC_PI_2; 4], &LayoutOptions::default()).unwrap();
    assert!(layout.repaired && layout.blend < 0.3, "{}", layout.blend);
    let p = &layout.polygon;
    assert!(p.side_length(0) > 20.0 * p.side_length(1));
    assert!((0..4).all(|i| (p.interior_angle(i) - FRAC_PI_2).abs() < 1e-12));
    let narrow = layout::heuristic(&lengths, &[FRAC_PI_2; 4], &LayoutOptions { clearance: 0.005 }).unwrap();
    assert!(!narrow.repaired && narrow.blend == 0.0);
}

#[test]
fn projections_that_are_no_valid_polygon_are_repaired() {
    let options = LayoutOptions::default();
    let project = |corners: &[DVec3], flags: Option<&[bool]>| {
        let layout = layout::projection(corners, flags, &options).unwrap();
        assert_valid(&layout, required_clearance(corners.len(), &options), &format!("{corners:?} {flags:?}"));
        layout
    };
    // A bow tie, corners on a line, corners at two points only.
    let bow_tie = [DVec3::ZERO, DVec3::new(1., 1., 0.), DVec3::X, DVec3::Y];
    assert!(project(&bow_tie, None).repaired);
    assert!(project(&[DVec3::ZERO, DVec3::X, DVec3::X * 3.0, DVec3::X * 2.0, DVec3::X * 7.0], None).repaired);
    assert!(project(&[DVec3::ZERO, DVec3::X, DVec3::ZERO, DVec3::X], None).repaired);
    // A square of which one corner has to be concave.
    let square = [DVec3::ZERO, DVec3::X, DVec3::new(1., 1., 0.), DVec3::Y];
    let dart = project(&square, Some(&[false, true, false, false]));
    assert!(dart.repaired && dart.polygon.is_concave(1) && dart.concave == [false, true, false, false]);
    assert!(!project(&square, Some(&[false; 4])).repaired);
    // A side one thousandth as long as the others grows to what the clearance needs.
    let cut = [DVec3::ZERO, DVec3::X, DVec3::new(1., 0.999, 0.), DVec3::new(0.999, 1., 0.), DVec3::Y];
    let layout = project(&cut, None);
    assert!(layout.repaired && layout.blend <= 0.5, "{}", layout.blend);
    let thin = LayoutOptions { clearance: 1e-4 };
    assert!(!layout::projection(&cut, None, &thin).unwrap().repaired);
}

#[test]
fn regular_polygons_are_where_the_formula_puts_them() {
    for n in [3, 5, 6, 7, 100] {
        let polygon = layout::regular(n).unwrap();
        for (i, p) in polygon.vertices().iter().enumerate() {
            let angle = 2.0 * PI * i as f64 / n as f64;
            assert!((p.x - angle.cos()).abs() < 4e-16 && (p.y - angle.sin()).abs() < 4e-16);
        }
        assert_eq!(polygon.orientation(), Orientation::CounterClockwise);
    }
    let square: Vec<[f64; 2]> = layout::regular(4).unwrap().vertices().iter().map(|p| p.to_array()).collect();
    assert_eq!(square, [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]]);
    assert_eq!(layout::regular(2).unwrap_err(), DomainError::TooFewSides { count: 2 });
}

#[test]
fn errors_name_the_place_and_the_value() {
    let options = LayoutOptions::default();
    let heuristic =
        |lengths: &[f64], turning: &[f64]| layout::heuristic(lengths, turning, &options).unwrap_err();
    assert_eq!(heuristic(&[1.0, 0.0, 1.0], &[2.0; 3]), DomainError::BadLength { side: 1, length: 0.0 });
    assert!(matches!(heuristic(&[1.0, 1.0, f64::NAN], &[2.0; 3]), DomainError::BadLength { side: 2, .. }));
    assert!(matches!(heuristic(&[1.0; 3], &[2.0, f64::NAN, 2.0]), DomainError::BadAngle { corner: 1, .. }));
    assert_eq!(heuristic(&[1.0; 3], &[2.0, 2.0, -4.0]), DomainError::BadAngle { corner: 2, angle: -4.0 });
    assert_eq!(heuristic(&[1.0; 2], &[2.0; 2]), DomainError::TooFewSides { count: 2 });
    assert_eq!(
        heuristic(&[1.0; 3], &[2.0; 4]),
        DomainError::CountMismatch { what: "turning angles", given: 4, wanted: 3 }
    );
    let bad = layout::heuristic(&[1.0; 3], &[2.0; 3], &LayoutOptions { clearance: -1.0 }).unwrap_err();
    assert_eq!(bad, DomainError::BadOption { option: "clearance", value: -1.0, least: 0.0, most: 1.0 });
    let mut corners = [DVec3::ZERO, DVec3::X, DVec3::X, DVec3::Y];
    let zero = layout::projection(&corners, None, &options).unwrap_err();
    assert_eq!(zero, DomainError::ZeroSide { side: 2, position: [1.0, 0.0, 0.0] });
    corners[2].z = f64::INFINITY;
    let infinite = layout::projection(&corners, None, &options).unwrap_err();
    assert_eq!(infinite, DomainError::NotFinite { corner: 2, position: [1.0, 0.0, f64::INFINITY] });
}
