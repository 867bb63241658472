//! Sides, corners, and the order to which the patch follows its ribbons.
#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod common;

use casteljau_gb::glam::DVec3;
use casteljau_gb::{
    CenterWeight, ConcavePatch, ContactLimit, ContinuityReport, CoordinateKind, GbError, Location, Ribbon,
};
use common::*;

fn curve(ribbon: &Ribbon, t: f64) -> DVec3 {
    ribbon.row(0).iter().enumerate().map(|(j, &c)| c * bernstein(ribbon.degree(), j, t)).sum()
}

/// Sides and corners are the ribbons' to rounding, whatever the weights.
#[test]
fn sides_and_corners_are_reproduced() {
    for shapes in [vec![(3, 2)], vec![(1, 1), (20, 6), (2, 2), (5, 1), (3, 3), (8, 4)]] {
        for p in [1, 2, 5] {
            let patch = patch_over(l_shape(), CoordinateKind::MeanValue, &shapes, p);
            let size = patch.bounding_box().diagonal();
            for (side, ribbon) in patch.ribbons().iter().enumerate() {
                for t in [1e-300, 1e-17, 1e-9, 0.1, 0.5, 0.7, 1.0 - 1e-9, 1.0 - 1e-16] {
                    let found = patch.point_at(Location::Side { side, t }).unwrap();
                    assert!(found.distance(curve(ribbon, t)) < 1e-13 * size, "side {side} t {t}");
                }
                let corner = patch.point_at(Location::Corner(side)).unwrap();
                assert_eq!(corner, ribbon.point(ribbon.degree(), 0).unwrap());
            }
        }
    }
}

/// Coming from inside, nearest corners included, the surface meets the curve. Mean value coordinates are exact but for
/// rounding, so the distance is that along the surface: at most the slope times the distance in the domain.
#[test]
fn approaching_the_boundary() {
    for p in [1, 2, 3] {
        let patch = patch_over(l_shape(), CoordinateKind::MeanValue, &[(3, 2), (4, 3)], p);
        for side in 0..6 {
            let [a, b] = patch.domain().side(side);
            let inward = (b - a).perp().normalize();
            for t in [1e-9, 1e-6, 1e-3, 0.3, 0.5, 0.9, 1.0 - 1e-3, 1.0 - 1e-6] {
                for gap in [1e-4, 1e-7, 1e-10] {
                    let uv = a.lerp(b, t) + inward * gap;
                    let Location::Inside(_) = patch.domain().locate(uv) else { continue };
                    let found = patch.point(uv).unwrap();
                    let expected = curve(&patch.ribbons()[side], t);
                    assert!(found.distance(expected) < 40.0 * gap + 1e-13, "side {side} t {t} gap {gap}");
                }
            }
        }
    }
}

/// Errors of λ of a certificate's size, of either sign, move the surface at a side by no more than the bound says.
#[test]
fn approximate_coordinates_keep_the_bound() {
    let mut random = Random(99);
    let certificate = 1e-8;
    for p in [1, 2, 3] {
        for shapes in [vec![(3, 2)], vec![(5, 3), (2, 1), (4, 2)]] {
            let patch = patch_over(l_shape(), CoordinateKind::MeanValue, &shapes, p);
            let size = patch.bounding_box().diagonal();
            for _ in 0..2000 {
                let side = ((random.number() + 1.0) * 3.0) as usize % 6;
                let t = 0.5 + 0.5 * random.number().powi(9);
                let mut lambda: Vec<f64> = (0..6).map(|_| random.number() * certificate).collect();
                lambda[(side + 5) % 6] += 1.0 - t;
                lambda[side] += t;
                let ribbon = &patch.ribbons()[side];
                let found = patch.point_from_coordinates(&lambda).unwrap();
                let most = patch.ribbons().iter().map(|r| r.degree().max(2 * r.layers() - 1)).max().unwrap();
                let bound = 4.0 * most as f64 * certificate * size;
                let error = found.distance(curve(ribbon, t));
                assert!(error <= bound, "p {p} side {side} t {t}: {error:e} > {bound:e}");
            }
        }
    }
}

/// Decay of the distance to the ribbon's surface: the exponent of gap ↦ |S − R|.
fn measured_order(patch: &ConcavePatch, side: usize, t: f64, gaps: [f64; 2]) -> f64 {
    let n = patch.sides();
    let [a, b] = patch.domain().side(side);
    let inward = (b - a).perp().normalize() * a.distance(b);
    let distance = |gap: f64| {
        let uv = a.lerp(b, t) + inward * gap;
        let mut lambda = vec![0.0; n];
        patch.coordinates().evaluate(&[uv], 0, &mut lambda).unwrap();
        let (x, y) = (lambda[(side + n - 1) % n], lambda[side]);
        let own = patch.ribbons()[side].jet(y / (x + y), 1.0 - x - y).unwrap().point;
        patch.point(uv).unwrap().distance(own)
    };
    (distance(gaps[0]) / distance(gaps[1])).ln() / (gaps[0] / gaps[1]).ln()
}

/// p = l = m + 1 and degree 2m + 1: order m + 1.
#[test]
fn order_of_contact() {
    for m in 1..=3u32 {
        let (layers, degree) = (m as usize + 1, 2 * m as usize + 1);
        for polygon in [regular(4), regular(5), regular(6)] {
            let ribbons = shaken(ribbons_over(&polygon, &[(degree, layers)]), &mut Random(u64::from(m)));
            let patch = ConcavePatch::builder(ribbons)
                .domain(polygon)
                .coordinates(CoordinateKind::Wachspress)
                .blend_power(m + 1)
                .build()
                .unwrap();
            for side in 0..patch.sides() {
                assert_eq!(patch.continuity()[side].order, layers);
                for t in [0.25, 0.5, 0.6] {
                    let order = measured_order(&patch, side, t, [0.006, 0.003]);
                    assert!(order > f64::from(m) + 0.9, "m {m} side {side} t {t}: {order}");
                }
            }
        }
    }
}

/// The same beside a concave corner, with harmonic coordinates.
#[test]
fn order_of_contact_on_an_l() {
    for m in 1..=3u32 {
        let ribbons = ribbons_over(&l_shape(), &[(2 * m as usize + 1, m as usize + 1)]);
        let patch = ConcavePatch::builder(shaken(ribbons, &mut Random(u64::from(m))))
            .domain(l_shape())
            .coordinates(CoordinateKind::Harmonic)
            .accuracy(casteljau_gb::HIGH_ACCURACY)
            .blend_power(m + 1)
            .build()
            .unwrap();
        for side in 0..6 {
            // Small enough to see the leading term, large enough to stand out of the error of λ.
            let gap = 0.004 * f64::from(m);
            let order = measured_order(&patch, side, 0.5, [gap, gap / 2.0]);
            assert!(order > f64::from(m) + 0.9, "m {m} side {side}: {order}");
        }
        let report = ContinuityReport::measure(&patch, 33).unwrap();
        let certificate = patch.coordinates().certificate();
        let most = (2 * m as usize + 1) as f64;
        for side in report.sides {
            assert!(side.g0.value <= 4.0 * most * certificate * patch.bounding_box().diagonal());
            assert!(side.g1.unwrap().value < 1e-6, "{side:?}");
        }
    }
}

/// The promise is neither too large nor too small: what limits it is what is measured, in every one of these cases.
#[test]
fn promised_order_is_the_measured_one() {
    let base = || vec![(7usize, 4usize); 6];
    let changed = |changes: &[(usize, (usize, usize))]| {
        let mut shapes = base();
        changes.iter().for_each(|&(i, shape)| shapes[i] = shape);
        shapes
    };
    let none = CenterWeight::None;
    let cases = [
        (base(), 4, none, false, 4, ContactLimit::Layers),
        (base(), 3, none, false, 3, ContactLimit::BlendPower),
        (changed(&[(0, (7, 2))]), 4, CenterWeight::Deficiency, false, 2, ContactLimit::Layers),
        (changed(&[(1, (3, 4))]), 4, none, false, 2, ContactLimit::NeighbourDegree { side: 1 }),
        (changed(&[(5, (4, 4))]), 4, none, false, 2, ContactLimit::NeighbourDegree { side: 5 }),
        (changed(&[(1, (2, 4))]), 4, none, false, 1, ContactLimit::NeighbourDegree { side: 1 }),
        (changed(&[(3, (7, 1))]), 4, none, false, 1, ContactLimit::OtherLayers { side: 3 }),
        (changed(&[(2, (7, 2))]), 4, none, false, 2, ContactLimit::OtherLayers { side: 2 }),
        (changed(&[(1, (7, 1))]), 4, none, false, 4, ContactLimit::Layers),
        (base(), 4, CenterWeight::Deficiency, false, 4, ContactLimit::Layers),
        (base(), 4, CenterWeight::Nth, false, 2, ContactLimit::CenterWeight),
        (base(), 4, CenterWeight::Harmonic, false, 2, ContactLimit::CenterWeight),
        // A corner point between sides 1 and 2: on side 0 only the layers of side 2 let its weight vanish, to order 4.
        (changed(&[(2, (7, 3))]), 4, none, true, 3, ContactLimit::OtherLayers { side: 2 }),
        (base(), 4, none, true, 4, ContactLimit::Layers),
    ];
    for (shapes, p, weight, corner, expected, limit) in cases {
        let polygon = regular(6);
        let ribbons = shaken(ribbons_over(&polygon, &shapes), &mut Random(6));
        let mut builder = ConcavePatch::builder(ribbons)
            .domain(polygon)
            .coordinates(CoordinateKind::Wachspress)
            .blend_power(p)
            .center(DVec3::new(0.3, 0.1, 2.0))
            .center_weight(weight);
        if corner {
            builder = builder.corner_point(1, DVec3::new(3.0, 2.0, 2.0));
        }
        let patch = builder.build().unwrap();
        let promise = patch.continuity()[0];
        assert_eq!((promise.order, promise.limit), (expected, limit), "{shapes:?} {p} {weight:?}");
        let order = measured_order(&patch, 0, 0.4, [0.004, 0.002]);
        assert!((order - expected as f64).abs() < 0.3, "{shapes:?} {p} {weight:?}: {order} for {expected}");
    }
}

/// Concave corner, quadratic neighbours, mixed layers: on every side that promises G1 the jet's own normal, which does
/// not know the rule for sides, is the ribbon's.
#[test]
fn normals_on_sides() {
    for shapes in [vec![(3, 2)], vec![(5, 3), (3, 2)]] {
        let patch = patch_over(regular(6), CoordinateKind::Wachspress, &shapes, 2);
        let report = ContinuityReport::measure(&patch, 33).unwrap();
        for side in &report.sides {
            assert!(side.promised.geometric() >= 1);
            let angle = side.g1.unwrap().value;
            assert!(angle < 1e-6, "side {}: {angle:e} degrees", side.side);
        }
    }
    // A neighbour of degree 2 leaves a crease, and both the promise and the report say so.
    let patch = patch_over(regular(6), CoordinateKind::Wachspress, &[(3, 2), (2, 2)], 2);
    let report = ContinuityReport::measure(&patch, 33).unwrap();
    assert_eq!(report.sides[0].promised.geometric(), 0);
    assert!(report.sides[0].g1.unwrap().value > 1e-3);
    assert!(report.sides[0].g0.value < 1e-13);
}

/// Curvature across the sides agrees with the ribbons' where G2 is promised, and not where only G1 is.
#[test]
fn curvature_on_sides() {
    let with_power = |p| {
        ConcavePatch::builder(shaken(ribbons_over(&regular(5), &[(5, 3)]), &mut Random(6)))
            .domain(regular(5))
            .coordinates(CoordinateKind::Wachspress)
            .blend_power(p)
            .build()
            .unwrap()
    };
    let (smooth, tangent) = (with_power(3), with_power(2));
    let worst = |patch: &ConcavePatch| {
        let report = ContinuityReport::measure(patch, 17).unwrap();
        report.sides.iter().filter_map(|s| s.g2).map(|m| m.value).fold(0.0, f64::max)
    };
    assert!(worst(&smooth) < 1e-9, "{:e}", worst(&smooth));
    assert!(worst(&tangent) > 1e-3, "{:e}", worst(&tangent));
}

/// At corners: perpendicular to both tangents, and pointing as the normals beside the corner do.
#[test]
fn normals_at_corners() {
    let patch = patch_over(l_shape(), CoordinateKind::MeanValue, &[(3, 2)], 2);
    for corner in 0..6 {
        let normal = patch.normal_at(Location::Corner(corner)).unwrap();
        let arriving = patch.ribbons()[corner].jet(1.0, 0.0).unwrap().du;
        let leaving = patch.ribbons()[(corner + 1) % 6].jet(0.0, 0.0).unwrap().du;
        assert!(normal.dot(arriving).abs() < 1e-14 && normal.dot(leaving).abs() < 1e-14);
        let beside = patch.normal_at(Location::Side { side: corner, t: 0.99 }).unwrap();
        assert!(normal.dot(beside) > 0.9, "corner {corner}");
    }
}

/// Weights that would stay on a side are refused, because the patch would miss its own boundary.
#[test]
fn weights_that_stay_on_sides() {
    let triangle = || {
        ConcavePatch::builder(ribbons_over(&regular(3), &[(3, 2)]))
            .domain(regular(3))
            .coordinates(CoordinateKind::Wachspress)
    };
    let nth = triangle().center(DVec3::ONE).center_weight(CenterWeight::Nth).build();
    assert!(matches!(nth, Err(GbError::CenterWeightOnBoundary { sides: 3, .. })));
    let corner = triangle().corner_point(0, DVec3::ONE).build();
    assert!(matches!(corner, Err(GbError::CornerPointOnBoundary { corner: 0, side: 2, .. })));
    let thin = ConcavePatch::builder(ribbons_over(&l_shape(), &[(3, 2), (3, 2), (3, 2), (3, 1)]))
        .domain(l_shape())
        .coordinates(CoordinateKind::MeanValue)
        .corner_point(3, DVec3::ONE)
        .build();
    assert!(matches!(thin, Err(GbError::CornerPointOnBoundary { corner: 3, side: 5, .. })));
}
