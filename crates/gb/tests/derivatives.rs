//! Jets against differences of the surface, inside and on sides.
#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod common;

use casteljau_gb::glam::{DVec2, DVec3, dvec2};
use casteljau_gb::{CenterWeight, ConcavePatch, CoordinateKind, Location, SurfaceJet};
use common::*;

/// One derivative of a jet.
type Part = fn(&SurfaceJet) -> DVec3;

/// Fourth-order central differences, extrapolated once.
fn difference(f: impl Fn(f64) -> DVec3, h: f64) -> DVec3 {
    let at = |h: f64| (f(h) - f(-h)) / (2.0 * h);
    let (a, b, c) = (at(h), at(h / 2.0), at(h / 4.0));
    let (first, second) = ((b * 4.0 - a) / 3.0, (c * 4.0 - b) / 3.0);
    (second * 16.0 - first) / 15.0
}

fn check(patch: &ConcavePatch, uv: DVec2, step: f64) {
    let jet = patch.jet(uv).unwrap();
    assert!(jet.point.distance(patch.point(uv).unwrap()) < 1e-14);
    let value = |d: DVec2| move |h: f64| patch.point(uv + d * h).unwrap();
    let slope =
        |d: DVec2, part: fn(&SurfaceJet) -> DVec3| move |h: f64| part(&patch.jet(uv + d * h).unwrap());
    let pairs = [
        (jet.du, difference(value(DVec2::X), step)),
        (jet.dv, difference(value(DVec2::Y), step)),
        (jet.duu, difference(slope(DVec2::X, |j| j.du), step)),
        (jet.duv, difference(slope(DVec2::Y, |j| j.du), step)),
        (jet.duv, difference(slope(DVec2::X, |j| j.dv), step)),
        (jet.dvv, difference(slope(DVec2::Y, |j| j.dv), step)),
    ];
    let scale = [jet.du.length() + jet.dv.length(), jet.duu.length() + jet.duv.length() + jet.dvv.length()];
    for (which, (found, expected)) in pairs.into_iter().enumerate() {
        let scale = scale[usize::from(which > 1)];
        let error = found.distance(expected) / scale;
        assert!(error < 1e-6, "{uv} derivative {which}: {error:e}");
    }
}

/// Whether no λ changes its sign near uv: mean value coordinates may be negative, and the patch has a crease there.
fn same_signs(patch: &ConcavePatch, uv: DVec2, step: f64) -> bool {
    let n = patch.sides();
    let around = [DVec2::ZERO, DVec2::X, DVec2::Y, -DVec2::X, -DVec2::Y].map(|d| uv + d * step);
    let mut lambda = vec![0.0; 5 * n];
    patch.coordinates().evaluate(&around, 0, &mut lambda).unwrap();
    (0..n).all(|i| (1..5).all(|k| (lambda[i] > 0.0) == (lambda[k * n + i] > 0.0)))
}

#[test]
fn inside_mean_value_and_wachspress() {
    let mut random = Random(11);
    for (polygon, kind, shapes) in [
        (l_shape(), CoordinateKind::MeanValue, vec![(3, 2)]),
        (l_shape(), CoordinateKind::MeanValue, vec![(5, 3), (2, 2), (4, 1)]),
        (regular(5), CoordinateKind::Wachspress, vec![(3, 2), (7, 4)]),
        (regular(4), CoordinateKind::Wachspress, vec![(3, 2), (1, 1)]),
    ] {
        for p in [1, 2, 3] {
            for weight in
                [CenterWeight::None, CenterWeight::Deficiency, CenterWeight::Nth, CenterWeight::Harmonic]
            {
                let patch = ConcavePatch::builder(ribbons_over(&polygon, &shapes))
                    .domain(polygon.clone())
                    .coordinates(kind)
                    .blend_power(p)
                    .center(DVec3::ONE)
                    .center_weight(weight)
                    .build()
                    .unwrap();
                for uv in inside(&polygon, 20, &mut random) {
                    let near = (0..polygon.len()).map(|i| {
                        let [a, b] = polygon.side(i);
                        (b - a).normalize().perp_dot(uv - a).abs()
                    });
                    let near = near.fold(f64::INFINITY, f64::min);
                    let step = (near / 8.0).min(0.01);
                    if near > 0.02 && same_signs(&patch, uv, step) {
                        check(&patch, uv, step);
                    }
                }
            }
        }
    }
}

/// On a side the jet is the limit from inside, also for sides opposite to a ribbon of one or two layers, whose blends are
/// 0/0 there.
#[test]
fn limits_on_sides() {
    for (layers, p) in [(1, 2), (2, 2), (3, 3), (1, 1)] {
        let patch = patch_over(regular(5), CoordinateKind::Wachspress, &[(3, layers)], p);
        for side in 0..5 {
            for t in [0.2, 0.5, 0.71] {
                let on = patch.jet_at(Location::Side { side, t }).unwrap();
                let [a, b] = patch.domain().side(side);
                let at = a.lerp(b, t);
                let inward = (b - a).perp().normalize();
                let near = |h: f64| patch.jet(at + inward * h).unwrap();
                let scale = [1.0, on.du.length() + on.dv.length(), on.duu.length() + on.dvv.length() + 1.0];
                let parts: [(Part, f64); 6] = [
                    (|j| j.point, scale[0]),
                    (|j| j.du, scale[1]),
                    (|j| j.dv, scale[1]),
                    (|j| j.duu, scale[2]),
                    (|j| j.duv, scale[2]),
                    (|j| j.dvv, scale[2]),
                ];
                for (which, (part, scale)) in parts.into_iter().enumerate() {
                    // Extrapolated to the side.
                    let h = 1e-3;
                    let [x, y, z] = [h, h / 2.0, h / 4.0].map(|h| part(&near(h)));
                    let (first, second) = (y * 2.0 - x, z * 2.0 - y);
                    let limit = (second * 4.0 - first) / 3.0;
                    let error = part(&on).distance(limit) / scale;
                    assert!(error < 2e-5, "l {layers} p {p} side {side} t {t} part {which}: {error:e}");
                }
            }
        }
    }
}

/// One formula for all kinds of number: the value of a jet has the bits of the point.
#[test]
fn same_bits_with_derivatives() {
    let mut random = Random(31);
    for (p, weight) in [(1, CenterWeight::None), (2, CenterWeight::Nth), (5, CenterWeight::Deficiency)] {
        let patch = ConcavePatch::builder(ribbons_over(&l_shape(), &[(3, 2), (5, 3), (2, 1)]))
            .domain(l_shape())
            .coordinates(CoordinateKind::MeanValue)
            .blend_power(p)
            .center(DVec3::ONE)
            .center_weight(weight)
            .build()
            .unwrap();
        for round in 0..200 {
            let mut rows = random.simplex(6);
            if round % 4 == 0 {
                rows[round % 6] = 0.0;
            }
            rows.extend((0..30).map(|_| random.number()));
            let jet = patch.jet_from_coordinates(&rows).unwrap();
            assert_eq!(jet.point, patch.point_from_coordinates(&rows[..6]).unwrap());
        }
    }
}

#[test]
fn corners_have_no_jet() {
    let patch = patch_over(l_shape(), CoordinateKind::MeanValue, &[(3, 2)], 2);
    let corner = patch.domain().vertices()[3];
    assert_eq!(patch.jet(corner), Err(casteljau_gb::GbError::CornerDerivative { corner: 3 }));
    assert_eq!(patch.point(corner).unwrap(), patch.ribbons()[3].point(3, 0).unwrap());
    assert!(patch.normal(corner).is_ok());
    assert!(patch.point(dvec2(1.5, 1.5)).is_err());
}
