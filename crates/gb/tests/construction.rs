//! What a patch is refused for, and how its domain is made.
#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod common;

use casteljau_gb::glam::{DVec3, dvec2, dvec3};
use casteljau_gb::{
    CenterWeight, ConcavePatch, ConcavePatchBuilder, CoordinateKind, GbError, LayoutKind, Polygon, Ribbon,
    turning_angles,
};
use common::*;
use proptest::prelude::*;

fn builder(ribbons: Vec<Ribbon>) -> ConcavePatchBuilder {
    ConcavePatch::builder(ribbons).coordinates(CoordinateKind::MeanValue)
}

fn sample() -> Vec<Ribbon> {
    ribbons_over(&l_shape(), &[(3, 2)])
}

#[test]
fn refusals() {
    let error = |b: ConcavePatchBuilder| b.build().unwrap_err();
    assert_eq!(error(builder(vec![])), GbError::TooFewSides { count: 0 });
    assert_eq!(error(builder(sample()[..2].to_vec())), GbError::TooFewSides { count: 2 });

    let mut open = sample();
    let end = open[1].point(3, 0).unwrap();
    open[1].set_point(3, 0, end + DVec3::Z * 0.1).unwrap();
    let Err(GbError::CornerGap { side: 1, next: 2, gap, allowed }) = builder(open).build() else { panic!() };
    assert!((gap - 0.1).abs() < 1e-15 && allowed < 1e-8);

    let mut collapsed = sample();
    let start = collapsed[2].point(0, 0).unwrap();
    for j in 0..4 {
        collapsed[2].set_point(j, 0, start).unwrap();
    }
    assert_eq!(error(builder(collapsed)), GbError::ZeroLengthSide { side: 2, at: start });

    let mut pinched = sample();
    let corner = pinched[0].point(3, 0).unwrap();
    pinched[3].set_point(3, 0, corner).unwrap();
    pinched[4].set_point(0, 0, corner).unwrap();
    assert!(matches!(error(builder(pinched)), GbError::EqualCorners { first: 0, second: 3, .. }));

    assert_eq!(error(builder(sample()).blend_power(0)), GbError::BlendPower { power: 0 });
    assert_eq!(error(builder(sample()).blend_power(65)), GbError::BlendPower { power: 65 });
    let weight = CenterWeight::Harmonic;
    assert_eq!(error(builder(sample()).center_weight(weight)), GbError::MissingCenter { weight });
    assert!(matches!(error(builder(sample()).center(DVec3::NAN)), GbError::Point { .. }));
    let nowhere = builder(sample()).corner_point(6, DVec3::ZERO);
    assert_eq!(error(nowhere), GbError::NoSuchCorner { corner: 6, sides: 6 });
    let twice = builder(sample()).corner_point(3, DVec3::ZERO).corner_point(3, DVec3::ONE);
    assert_eq!(error(twice), GbError::RepeatedCornerPoint { corner: 3 });
    let small = builder(sample()).domain(regular(5));
    assert_eq!(error(small), GbError::DomainSize { vertices: 5, sides: 6 });
    assert!(matches!(error(builder(sample()).corner_tolerance(f64::NAN)), GbError::Tolerance { .. }));
    assert!(matches!(
        error(builder(sample()).coordinates(CoordinateKind::Wachspress).domain(l_shape())),
        GbError::Domain(_)
    ));
}

/// Ends that meet within the tolerance become one point half way; ends that meet exactly are not touched.
#[test]
fn corners_are_joined() {
    let mut loose = sample();
    let end = loose[1].point(3, 0).unwrap();
    loose[1].set_point(3, 0, end + DVec3::Z * 1e-10).unwrap();
    let patch = builder(loose.clone()).domain(l_shape()).build().unwrap();
    let joined = patch.ribbons()[1].point(3, 0).unwrap();
    assert_eq!(joined, patch.ribbons()[2].point(0, 0).unwrap());
    assert!((joined.z - end.z - 0.5e-10).abs() < 1e-15);
    assert_eq!(patch.ribbons()[3..], loose[3..]);
    assert!(matches!(builder(loose).corner_tolerance(0.0).build(), Err(GbError::CornerGap { .. })));
}

#[test]
fn layouts() {
    let turning = turning_angles(&sample());
    let concave: Vec<bool> = turning.iter().map(|&a| a < 0.0).collect();
    assert_eq!(concave, [false, false, false, true, false, false]);
    for layout in [LayoutKind::Projection, LayoutKind::Heuristic] {
        let patch = builder(sample()).layout(layout).build().unwrap();
        assert_eq!(patch.layout(), layout);
        assert!(!patch.layout_repaired());
        let kept: Vec<bool> = (0..6).map(|i| patch.domain().is_concave(i)).collect();
        assert_eq!(kept, concave, "{layout:?}");
    }
    let regular = builder(sample()).layout(LayoutKind::Regular).build().unwrap();
    assert!(regular.domain().vertices()[0].distance(dvec2(1.0, 0.0)) < 1e-15);
    // One layer everywhere: nothing says which corner is concave.
    let thin = ribbons_over(&l_shape(), &[(3, 1)]);
    assert!(turning_angles(&thin).iter().all(|&a| a > 0.0));
}

/// A number that is ordinary, tiny, huge or no number at all.
fn hunting() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -1.0..1.0f64,
        1 => Just(0.0),
        1 => Just(1.0),
        1 => (-30i32..30).prop_map(|e| 10f64.powi(e)),
        1 => Just(1.0 + f64::EPSILON),
        1 => prop_oneof![Just(f64::NAN), Just(f64::INFINITY), Just(1e300), Just(5e-324)],
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Whatever the numbers, building ends in a patch or in an error, and a patch answers with finite points.
    #[test]
    fn nothing_panics(
        n in 3usize..7,
        shape in (1usize..6, 1usize..4),
        numbers in prop::collection::vec(hunting(), 400),
        p in 0u32..5,
        layout in 0usize..3,
    ) {
        let mut next = numbers.iter().copied().cycle();
        let mut point = || dvec3(next.next().unwrap(), next.next().unwrap(), next.next().unwrap());
        let (degree, layers) = shape;
        let corners: Vec<DVec3> = (0..n).map(|_| point()).collect();
        let ribbons: Result<Vec<Ribbon>, GbError> = (0..n).map(|i| {
            let mut points: Vec<DVec3> = (0..layers * (degree + 1)).map(|_| point()).collect();
            points[0] = corners[(i + n - 1) % n];
            points[degree] = corners[i];
            Ribbon::new(degree, layers, points)
        }).collect();
        let Ok(ribbons) = ribbons else { return Ok(()) };
        let layout = [LayoutKind::Projection, LayoutKind::Heuristic, LayoutKind::Regular][layout];
        let Ok(patch) = builder(ribbons).layout(layout).blend_power(p).build() else { return Ok(()) };
        for uv in inside(patch.domain(), 5, &mut Random(2)) {
            prop_assert!(patch.point(uv).unwrap().is_finite());
            if let Ok(jet) = patch.jet(uv) {
                prop_assert!(jet.is_finite());
            }
            let _ = patch.normal(uv);
        }
    }

    /// Whatever λ of sum 1, zeros, tiny and slightly negative ones included, the formula answers; with no negative one it
    /// is a convex combination, and negative ones count by no more than the bound for approximate coordinates.
    #[test]
    fn any_coordinates(raw in prop::collection::vec(prop_oneof![
        Just(0.0), 0.0..1.0f64, (0i32..320).prop_map(|e| 10f64.powi(-e)), (1i32..20).prop_map(|e| -10f64.powi(-8 - e)),
    ], 6), p in 1u32..9) {
        let sum: f64 = raw.iter().sum();
        prop_assume!(sum > 1e-3);
        let lambda: Vec<f64> = raw.iter().map(|x| x / sum).collect();
        let patch = patch_over(l_shape(), CoordinateKind::MeanValue, &[(3, 2), (1, 1), (6, 4)], p);
        let found = patch.point_from_coordinates(&lambda).unwrap();
        let negative: f64 = lambda.iter().filter(|&&x| x < 0.0).map(|x| -x).sum();
        let slack = (1e-14 + 4.0 * 7.0 * negative) * patch.bounding_box().diagonal();
        prop_assert!(patch.bounding_box().grown(slack).contains(found), "{found} of {lambda:?}");
    }
}

/// A domain of any size, and a model of any size, gives the same shape.
#[test]
fn scales() {
    let reference = builder(sample()).domain(l_shape()).build().unwrap();
    for exponent in [-20, 20] {
        let factor = 2f64.powi(exponent);
        let scaled: Vec<Ribbon> = sample()
            .iter()
            .map(|r| {
                let points = r.control_points().iter().map(|&p| p * factor).collect();
                Ribbon::new(r.degree(), r.layers(), points).unwrap()
            })
            .collect();
        let polygon = Polygon::new(l_shape().vertices().iter().map(|&v| v * factor).collect()).unwrap();
        let patch = builder(scaled).domain(polygon).build().unwrap();
        for uv in inside(&l_shape(), 50, &mut Random(8)) {
            let found = patch.point(uv * factor).unwrap() / factor;
            assert!(found.distance(reference.point(uv).unwrap()) < 1e-14);
        }
    }
}
