//! Operations that must not change the shape, on polynomial and rational curves and patches alike.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_geom::glam::{DAffine3, DMat3, DVec3, DVec4};
use casteljau_geom::{Interval, UNIT_ROUNDOFF, laws};
use casteljau_shape::{
    Curve, ParametricCurve, ParametricSurface, Patch, PatchEdge, PowerCurve, PowerPatch, RationalCurve,
    RationalPatch, RationalTriangle, ShapeError, Triangle,
};
use proptest::collection::vec;
use proptest::prelude::*;
use support::{space_point, weight};

fn interval() -> impl Strategy<Value = Interval> {
    prop_oneof![
        Just(Interval::UNIT),
        (-3.0..3.0, 0.1..4.0).prop_map(|(a, length)| Interval::new(a, a + length).unwrap()),
        (-1.0..1.0, -20..20i32).prop_map(|(a, e)| {
            let length = 2_f64.powi(e);
            Interval::new(a * length, a * length + length).unwrap()
        }),
    ]
}

/// Control points with weights of one sign, and how far rounding may move a point of their shape: u times the
/// largest coordinate and the ratio of the weights, times a constant a degree that covers two evaluations and an
/// operation in between, 2·4(n+2) + 4(n+2), and as much again for the parameters.
fn weighted(count: std::ops::Range<usize>) -> impl Strategy<Value = (Vec<DVec3>, Vec<f64>)> {
    vec((space_point(), weight()), count).prop_map(|pairs| pairs.into_iter().unzip())
}

fn allowed(points: &[DVec3], weights: &[f64], degree: usize) -> f64 {
    let size: f64 = points.iter().map(|p| p.length()).fold(0.0, f64::max);
    let (least, most) = weights.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), &w| (a.min(w), b.max(w)));
    24.0 * (degree + 2) as f64 * (degree + 1) as f64 * UNIT_ROUNDOFF * size * most / least
}

/// The operations on one curve.
macro_rules! curve_operations {
    ($curve:expr, $tolerance:expr, $cut:expr, $by:expr) => {{
        let (c, tolerance) = ($curve, $tolerance);
        let whole = c.interval();
        let at = |t: f64| c.try_point(t).unwrap();
        let over = |s: f64| at(whole.at(s));
        let higher = c.elevated($by).unwrap();
        laws::equal_curves_law("elevation", over, |s| higher.try_point(whole.at(s)).unwrap(), tolerance)
            .unwrap();
        let back = c.reversed();
        laws::equal_curves_law("reversal", over, |s| back.try_point(whole.at(1.0 - s)).unwrap(), tolerance)
            .unwrap();
        let (left, right) = c.split(whole.at($cut)).unwrap();
        let (l, r) = (|s| left.try_point(s).unwrap(), |s| right.try_point(s).unwrap());
        laws::subdivision_law(over, l, r, $cut, tolerance).unwrap();
        let part = Interval::new(whole.at(0.25 * $cut), whole.at(0.5 + 0.5 * $cut)).unwrap();
        let middle = c.restricted(part).unwrap();
        laws::equal_curves_law(
            "restriction",
            |s| at(part.at(s)),
            |s| middle.try_point(part.at(s)).unwrap(),
            tolerance,
        )
        .unwrap();
        let moved = c.clone().with_interval(Interval::new(-5.0, 3.0).unwrap());
        laws::equal_curves_law("interval", over, |s| moved.try_point(-5.0 + 8.0 * s).unwrap(), tolerance)
            .unwrap();
        // Derivatives go with the power of the ratio of the intervals.
        let (a, b) = (c.try_jet(whole.at($cut)).unwrap(), moved.try_jet(-5.0 + 8.0 * $cut).unwrap());
        let ratio = whole.length() / 8.0;
        let n = c.degree() as f64;
        assert!((a.d1 * ratio).distance(b.d1) <= 4.0 * n * tolerance / 8.0, "{} {}", a.d1 * ratio, b.d1);
        assert!((a.d2 * ratio * ratio).distance(b.d2) <= 16.0 * n * n * tolerance / 64.0);
        assert_eq!(c.try_jet_of_order(whole.at($cut), 3).unwrap().get([2]), Some(a.d2));
    }};
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn curves((points, weights) in weighted(1..12), over in interval(), cut in 0.0..=1.0, by in 0..5usize) {
        let n = points.len() - 1;
        let c = Curve::new(points.clone()).unwrap().with_interval(over);
        curve_operations!(&c, 16.0 * allowed(&points, &[1.0], n + by), cut, by);
        let r = RationalCurve::new(&points, &weights).unwrap().with_interval(over);
        let tolerance = allowed(&points, &weights, n + by);
        // Derivatives of quotients grow with the ratio of the weights once an order, splitting spreads weights.
        if weights.iter().all(|w| (0.4..2.5).contains(w)) {
            curve_operations!(&r, 100.0 * tolerance, cut, by);
        }
        laws::hull_law(r.hull_box().unwrap(), |s| r.point(over.at(s)).unwrap(), tolerance).unwrap();
        // Another pace: c(t) = s(ct/(1 − t + ct)).
        let c = 1.5;
        let paced = r.repaced(c).unwrap();
        let pace = |s: f64| c * s / (1.0 - s + c * s);
        laws::equal_curves_law("pace", |s| paced.point(over.at(s)).unwrap(), |s| r.point(over.at(pace(s))).unwrap(), 100.0 * tolerance).unwrap();
        let standard = r.standard_form().unwrap();
        let ends = [standard.weights().next().unwrap(), standard.weights().last().unwrap()];
        prop_assert!(ends.iter().all(|w| (w - 1.0).abs() < 1e-12), "{ends:?}");
    }

    #[test]
    fn reduction((points, weights) in weighted(2..9), by in 1..4usize, s in 0.0..=1.0) {
        let tolerance = 1e3 * allowed(&points, &[1.0], points.len() + by);
        let c = Curve::new(points.clone()).unwrap();
        let (same, error) = c.elevated(by).unwrap().reduced(c.degree()).unwrap();
        prop_assert!(error <= tolerance && same.point(s).distance(c.point(s)) <= tolerance);
        let (near, error) = c.reduced(c.degree() - 1).unwrap();
        prop_assert!(near.point(s).distance(c.point(s)) <= error * (1.0 + 1e-9) + tolerance);
        let gentle: Vec<f64> = weights.iter().map(|w| w.clamp(0.5, 2.0)).collect();
        let r = RationalCurve::new(&points, &gentle).unwrap();
        if let Ok((near, error)) = r.reduced(r.degree() - 1) {
            let off = near.point(s).unwrap().distance(r.point(s).unwrap());
            prop_assert!(off <= error * (1.0 + 1e-9) + tolerance, "{off:e} {error:e}");
        }
    }

    #[test]
    fn patches(
        m in 0..5usize, n in 0..5usize,
        points in vec(space_point(), 25), weights in vec(0.5..2.0, 25),
        over in (interval(), interval()), cut in 0.0..=1.0, by in (0..3usize, 0..3usize),
    ) {
        let (points, weights) = (&points[..(m + 1) * (n + 1)], &weights[..(m + 1) * (n + 1)]);
        let over = [over.0, over.1];
        let tolerance = 100.0 * allowed(points, weights, m + n + by.0 + by.1);
        let patch = RationalPatch::new([m, n], points, weights).unwrap().with_intervals(over);
        let at = |s: f64, t: f64| patch.point(over[0].at(s), over[1].at(t)).unwrap();
        let same = |law, other: &RationalPatch, map: fn(f64, f64) -> [f64; 2]| {
            let [u, v] = other.intervals();
            laws::equal_surfaces_law(law, false, at, |s, t| {
                let [s, t] = map(s, t);
                other.point(u.at(s), v.at(t)).unwrap()
            }, tolerance).unwrap();
        };
        same("elevation", &patch.elevated([by.0, by.1]).unwrap(), |s, t| [s, t]);
        same("swap", &patch.swapped(), |s, t| [t, s]);
        same("u reversed", &patch.reversed_u(), |s, t| [1.0 - s, t]);
        same("v reversed", &patch.reversed_v(), |s, t| [s, 1.0 - t]);
        let (back, error) = patch.elevated([by.0, by.1]).unwrap().reduced([m, n]).unwrap();
        prop_assert!(error <= 100.0 * tolerance);
        same("reduction", &back, |s, t| [s, t]);
        let (left, right) = patch.split_u(over[0].at(cut)).unwrap();
        laws::subdivision_law(|s| at(s, 0.3), |s| left.point(s, over[1].at(0.3)).unwrap(), |s| right.point(s, over[1].at(0.3)).unwrap(), cut, tolerance).unwrap();
        let (left, right) = patch.split_v(over[1].at(cut)).unwrap();
        laws::subdivision_law(|s| at(0.3, s), |s| left.point(over[0].at(0.3), s).unwrap(), |s| right.point(over[0].at(0.3), s).unwrap(), cut, tolerance).unwrap();
        let part = over.map(|i| Interval::new(i.at(0.2), i.at(0.7)).unwrap());
        let middle = patch.restricted(part).unwrap();
        laws::equal_surfaces_law("restriction", false, |s, t| at(0.2 + 0.5 * s, 0.2 + 0.5 * t),
            |s, t| middle.point(part[0].at(s), part[1].at(t)).unwrap(), tolerance).unwrap();
        let (cu, cv) = (patch.curve_at_u(over[0].at(cut)), patch.curve_at_v(over[1].at(cut)));
        laws::equal_curves_law("u constant", |s| at(cut, s), |s| cu.point(over[1].at(s)).unwrap(), tolerance).unwrap();
        laws::equal_curves_law("v constant", |s| at(s, cut), |s| cv.point(over[0].at(s)).unwrap(), tolerance).unwrap();
        let edge = patch.edge(PatchEdge::UEnd);
        prop_assert_eq!(edge.control_points(), &patch.control_points()[m * (n + 1)..]);
    }

    /// Every kind of shape is what its derivatives say, with respect to its own parameters.
    #[test]
    fn derivatives(points in vec(space_point(), 15), weights in vec(0.5..2.0, 15), over in (interval(), interval()), s in 0.1..0.4, t in 0.1..0.4) {
        // In the unit of the parameters: steps of 1/128 of the interval; the polynomials have degree 4 at most,
        // where the differences are exact. Those of quotients have their next pole a whole interval away.
        let size: f64 = points.iter().map(|p| p.length()).sum::<f64>() + f64::MIN_POSITIVE;
        let over = [over.0, over.1];
        // Third derivatives over one interval: up to 4·3·2·8 times the size, and 3 more orders of quotients.
        let rounding = 1e4 * 128.0 * 64.0 * UNIT_ROUNDOFF * size;
        let [a, b] = [over[0].at(s), over[1].at(t)];
        let unit = |length: f64| length.max(1.0 / length).powi(3);
        let curves: [Box<dyn ParametricCurve>; 3] = [
            Box::new(Curve::new(&points[..5]).unwrap().with_interval(over[0])),
            Box::new(RationalCurve::new(&points[..5], &weights[..5]).unwrap().with_interval(over[0])),
            Box::new(PowerCurve::new(&points[..5]).unwrap()),
        ];
        for (k, c) in curves.iter().enumerate() {
            let (interval, quotient) = (c.interval(), if k == 1 { 1e6 } else { 1.0 });
            let tolerance = rounding * unit(interval.length()) * quotient;
            laws::curve_derivative_law(|t| c.try_jet(t).unwrap(), interval.at(s), interval.length() / 128.0, tolerance).unwrap();
        }
        let surfaces: [Box<dyn ParametricSurface>; 5] = [
            Box::new(Patch::new([2, 4], points.clone()).unwrap().with_intervals(over)),
            Box::new(RationalPatch::new([2, 4], &points, &weights).unwrap().with_intervals(over)),
            Box::new(PowerPatch::new([4, 2], points.clone()).unwrap()),
            Box::new(Triangle::new(4, points.clone()).unwrap()),
            Box::new(RationalTriangle::new(4, &points, &weights).unwrap()),
        ];
        for (k, c) in surfaces.iter().enumerate() {
            let (place, lengths, quotient) = match k {
                0 | 1 => ([a, b], over.map(|i| i.length()), if k == 1 { 1e6 } else { 1.0 }),
                _ => ([s, t], [1.0; 2], if k == 4 { 1e6 } else { 1.0 }),
            };
            // One step serves both parameters.
            let step = lengths[0].min(lengths[1]) / 128.0;
            let stretch = unit(lengths[0]) * unit(lengths[1]) * (lengths[0] / lengths[1]).max(lengths[1] / lengths[0]);
            let jet = |u, v| c.try_jet(u, v).unwrap();
            laws::surface_derivative_law(jet, place, step, rounding * quotient * stretch).unwrap();
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Cutting, turning and elevating a triangle does not change it.
    #[test]
    fn triangles(n in 0..5usize, points in vec(space_point(), 15), weights in vec(0.5..2.0, 15), by in 0..4usize, u in 0.1..0.4, v in 0.1..0.4) {
        let count = (n + 1) * (n + 2) / 2;
        let (points, weights) = (&points[..count], &weights[..count]);
        let tolerance = 100.0 * allowed(points, weights, n + by);
        let triangle = RationalTriangle::new(n, points, weights).unwrap();
        let at = |s: f64, t: f64| triangle.point(s, t).unwrap();
        let same = |law, other: &RationalTriangle, map: &dyn Fn(f64, f64) -> [f64; 2]| {
            laws::equal_surfaces_law(law, true, |s, t| { let [s, t] = map(s, t); at(s, t) }, |s, t| other.point(s, t).unwrap(), tolerance).unwrap();
        };
        let higher = triangle.elevated(by).unwrap();
        same("elevation", &higher, &|s, t| [s, t]);
        let (back, error) = higher.reduced(n).unwrap();
        let slack = 1e4 * tolerance;
        prop_assert!(error <= slack, "{error:e} {slack:e}");
        laws::equal_surfaces_law("reduction", true, at, |s, t| back.point(s, t).unwrap(), slack).unwrap();
        same("permutation", &triangle.permuted([2, 0, 1]).unwrap(), &|s, t| [t, 1.0 - s - t]);
        let corners = [[u, v], [1.0 - u, v], [u, 0.5]];
        let inside = |s: f64, t: f64| {
            let r = 1.0 - s - t;
            [0, 1].map(|axis| s * corners[0][axis] + t * corners[1][axis] + r * corners[2][axis])
        };
        same("restriction", &triangle.restricted(corners).unwrap(), &inside);
        let [a, _, c] = triangle.split_at(u, v).unwrap();
        same("split, part 0", &a, &|s, t| [s * u, s * v + t]);
        same("split, part 2", &c, &|s, t| { let r = 1.0 - s - t; [s + r * u, t + r * v] });
        let (a, b) = triangle.split_edge([0, 2], u).unwrap();
        same("edge, first", &a, &|s, t| [s + (1.0 - s - t) * (1.0 - u), t]);
        same("edge, second", &b, &|s, t| [s * (1.0 - u), t]);
        for (opposite, place) in [|s: f64| [0.0, 1.0 - s], |s: f64| [s, 0.0], |s: f64| [1.0 - s, s]].into_iter().enumerate() {
            let edge = triangle.edge(opposite).unwrap();
            laws::equal_curves_law("edge", |s| { let [s, t] = place(s); at(s, t) }, |s| edge.point(s).unwrap(), tolerance).unwrap();
        }
        let size = triangle.hull_box().unwrap().diagonal();
        let tight = triangle.tight_box(1e-4 * size + f64::MIN_POSITIVE).unwrap();
        prop_assert!(tight.grown(1e-11 * size + f64::MIN_POSITIVE).contains(at(u, v)));
    }

    /// Mapping the control points maps the shape, at scales from 1e-6 to 1e6, whatever the weights.
    #[test]
    fn affine_invariance(points in vec(space_point(), 15), weights in vec(weight(), 15), entries in vec(-2.0..2.0, 9), shift in space_point(), exponent in -6..=6i32, u in 0.0..=0.5, v in 0.0..=0.5) {
        let scale = 10_f64.powi(exponent);
        let map = DAffine3 { matrix3: DMat3::from_cols_slice(&entries) * scale, translation: shift * scale };
        // The map multiplies lengths by at most 6 times the scale; both evaluations and the map round.
        let far = shift.length() * scale;
        let tolerance = |w: &[f64]| 12.0 * scale * allowed(&points, w, 4) + 12.0 * allowed(&[DVec3::X * far], w, 4);
        let gentle: Vec<f64> = weights.iter().map(|w| w.clamp(0.25, 4.0)).collect();
        laws::affine_invariance_law(&points[..5], map, |p| Curve::new(p).unwrap().point(u), tolerance(&[1.0])).unwrap();
        laws::affine_invariance_law(&points, map, |p| Patch::new([2, 4], p).unwrap().point(u, v), 4.0 * tolerance(&[1.0])).unwrap();
        laws::affine_invariance_law(&points, map, |p| Triangle::new(4, p).unwrap().point(u, v), 4.0 * tolerance(&[1.0])).unwrap();
        for w in [&weights, &gentle] {
            laws::affine_invariance_law(&points[..5], map, |p| RationalCurve::new(p, &w[..5]).unwrap().point(u).unwrap(), tolerance(w)).unwrap();
            laws::affine_invariance_law(&points, map, |p| RationalPatch::new([4, 2], p, w).unwrap().point(u, v).unwrap(), 4.0 * tolerance(w)).unwrap();
            laws::affine_invariance_law(&points, map, |p| RationalTriangle::new(4, p, w).unwrap().point(u, v).unwrap(), 4.0 * tolerance(w)).unwrap();
        }
    }

    /// Both bases are one polynomial, over any interval.
    #[test]
    fn conversion(points in vec(space_point(), 12), over in (interval(), interval()), s in 0.0..=1.0, t in 0.0..=1.0) {
        let over = [over.0, over.1];
        let size: f64 = points.iter().map(|p| p.length()).sum();
        let far = |i: Interval| (1.0 + 2.0 * i.start().abs().max(i.end().abs()) / i.length()).powi(5);
        let c = Curve::new(&points[..6]).unwrap().with_interval(over[0]);
        let power = c.to_power().unwrap();
        let tolerance = 1e3 * UNIT_ROUNDOFF * size * far(over[0]);
        let [a, b] = [over[0].at(s), over[1].at(t)];
        prop_assert!(power.point(a).distance(c.point(a)) <= tolerance);
        prop_assert!(power.to_bezier().unwrap().point(a).distance(c.point(a)) <= 10.0 * tolerance);
        let patch = Patch::new([2, 3], points.clone()).unwrap().with_intervals(over);
        let power = patch.to_power().unwrap();
        let tolerance = 1e4 * UNIT_ROUNDOFF * size * far(over[0]) * far(over[1]);
        prop_assert!(power.point(a, b).distance(patch.point(a, b)) <= tolerance);
        prop_assert!(power.to_bezier().unwrap().point(a, b).distance(patch.point(a, b)) <= 10.0 * tolerance);
    }

    /// The tight box contains the shape, lies in the hull's, and is touched.
    #[test]
    fn tight_boxes((points, weights) in weighted(1..8), net in vec(space_point(), 12), even in vec(0.5..2.0, 12)) {
        let r = RationalCurve::new(&points, &weights).unwrap();
        let size = r.hull_box().unwrap().diagonal() + r.hull_box().unwrap().center().length();
        let slack = 1e-11 * size + f64::MIN_POSITIVE;
        let tight = r.tight_box(1e-6 * size + f64::MIN_POSITIVE).unwrap();
        for k in 0..=200 {
            let p = r.point(f64::from(k) / 200.0).unwrap();
            prop_assert!(tight.grown(slack).contains(p), "{p} {tight:?}");
        }
        prop_assert!(r.hull_box().unwrap().grown(slack).contains(tight.max));
        let patch = RationalPatch::new([2, 3], &net, &even).unwrap();
        let size = patch.hull_box().unwrap().diagonal();
        let tight = patch.tight_box(1e-3 * size + f64::MIN_POSITIVE).unwrap();
        let mut reached = patch.point(0.0, 0.0).unwrap();
        for i in 0..=40 {
            for j in 0..=40 {
                let p = patch.point(f64::from(i) / 40.0, f64::from(j) / 40.0).unwrap();
                prop_assert!(tight.grown(1e-11 * size).contains(p));
                reached = reached.max(p);
            }
        }
        // The grid misses an extreme by a quarter of a hundredth of the second derivative at most.
        prop_assert!((tight.max - reached).max_element() <= 0.05 * size, "{tight:?} {reached}");
    }
}

#[test]
fn boxes_of_known_shapes() {
    let circle = RationalCurve::full_circle(DVec3::ONE, DVec3::X, DVec3::Y).unwrap();
    let tight = circle.tight_box(1e-9).unwrap();
    assert!(tight.max.distance(DVec3::new(2.0, 2.0, 1.0)) < 2e-9 && tight.min.distance(DVec3::Z) < 2e-9);
    // Three quarters of a circle in one piece, with a negative weight: no hull, a box all the same.
    let arc = RationalCurve::conic(DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y, -0.5_f64.sqrt()).unwrap();
    assert_eq!(arc.hull_box(), None);
    let tight = arc.tight_box(1e-9).unwrap();
    assert!(
        tight.max.distance(DVec3::new(1.0, 1.0, 0.0)) < 2e-9
            && tight.min.distance(DVec3::new(-1.0, -1.0, 0.0)) < 2e-9
    );
    for patch in RationalPatch::torus(DVec3::ZERO, DVec3::Z, 3.0, 1.0).unwrap() {
        let tight = patch.tight_box(1e-6).unwrap();
        let reach = tight.max.abs().max(tight.min.abs());
        assert!((reach.x.max(reach.y) - 4.0).abs() < 1e-5 || reach.x.max(reach.y) < 3.0 + 1e-5, "{reach}");
        assert!((reach.z - 1.0).abs() < 1e-5);
    }
    let octant = RationalTriangle::sphere_octant(DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z).unwrap();
    let tight = octant.tight_box(1e-8).unwrap();
    assert!(tight.min.length() < 2e-8 && tight.max.distance(DVec3::ONE) < 2e-8, "{tight:?}");
    let pole = RationalCurve::new(&[DVec3::ZERO, DVec3::X], &[1.0, -1.0]).unwrap();
    assert_eq!(pole.tight_box(1e-3), Err(ShapeError::Unbounded));
    assert!(matches!(circle.tight_box(0.0), Err(ShapeError::Construction { .. })));
}

#[test]
fn poles_are_errors() {
    // w = 1 − 2t, the double root (1 − 2t)², and 0 in the middle of a patch and of a triangle.
    let line = RationalCurve::new(&[DVec3::ZERO, DVec3::X], &[1.0, -1.0]).unwrap();
    let double = RationalCurve::new(&[DVec3::ZERO, DVec3::X, DVec3::Y], &[1.0, -1.0, 1.0]).unwrap();
    for curve in [&line, &double] {
        for t in [0.5, 0.5 + 1e-17, 0.5 - UNIT_ROUNDOFF / 2.0] {
            assert!(matches!(curve.point(t), Err(ShapeError::Evaluation { .. })), "{t}");
        }
        for t in [0.0, 0.25, 0.4999, 0.5001, 1.0, 7.0, -3.0] {
            assert!(curve.jet(t).is_ok(), "{t}");
        }
        assert!(matches!(curve.point(f64::NAN), Err(ShapeError::Parameter { .. })));
    }
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE];
    let patch = RationalPatch::new([1, 1], &corners, &[1.0, -1.0, -1.0, 1.0]).unwrap(); // (1−2u)(1−2v)
    for x in [0.0, 0.3, 1.0, -2.0] {
        assert!(patch.point(0.5, x).is_err() && patch.jet(x, 0.5).is_err() && patch.normal(0.5, x).is_err());
    }
    assert!(patch.point(0.3, 0.9).is_ok());
    let triangle = RationalTriangle::new(1, &corners[..3], &[1.0, -1.0, 0.0]).unwrap(); // λ₁ − λ₂
    assert!(triangle.point(0.25, 0.25).is_err() && triangle.point(0.0, 0.0).is_err());
    assert!(triangle.point(0.5, 0.25).is_ok());
    assert_eq!(triangle.hull_box(), None);
}

#[test]
fn weight_zero_and_infinity() {
    // A control point of weight 0 contributes nothing, wherever it is.
    for far in [DVec3::ZERO, DVec3::splat(1e100)] {
        let c = RationalCurve::new(&[DVec3::X, far, DVec3::Y], &[1.0, 0.0, 1.0]).unwrap();
        assert_eq!(c.point(0.5).unwrap(), DVec3::new(0.5, 0.5, 0.0));
        assert_eq!(c.hull_box(), None);
    }
    let ray = RationalCurve::from_homogeneous([DVec4::new(1.0, 0.0, 0.0, 0.0), DVec4::W]).unwrap();
    assert_eq!((ray.start(), ray.start_tangent(), ray.end()), (None, None, Some(DVec3::ZERO)));
    assert!(ray.point(0.0).is_err());
    assert_eq!(ray.point(0.5).unwrap(), DVec3::X);
    assert_eq!(ray.end_tangent(), Some(DVec3::NEG_X));
    // Tangents where the weights' signs differ.
    let c = RationalCurve::new(&[DVec3::ZERO, DVec3::X, DVec3::Y], &[1.0, -0.5, 1.0]).unwrap();
    assert!(c.jet(1e-9).unwrap().tangent().unwrap().distance(c.start_tangent().unwrap()) < 1e-6);
    assert_eq!(c.start_tangent(), Some(DVec3::NEG_X));
}

#[test]
fn doors() {
    let (points, long) = ([DVec3::ZERO, DVec3::X], vec![DVec3::ZERO; 502]);
    assert_eq!(RationalCurve::new(&[], &[]), Err(ShapeError::NoControlPoints));
    assert_eq!(RationalCurve::from_homogeneous(vec![]), Err(ShapeError::NoControlPoints));
    assert!(matches!(RationalCurve::new(&long, &[1.0; 502]), Err(ShapeError::Degree { degree: 501, .. })));
    assert!(matches!(
        RationalCurve::new(&points, &[1.0, f64::NAN]),
        Err(ShapeError::Coordinate { place: 1, axis: 3, .. })
    ));
    assert!(matches!(
        RationalCurve::new(&[DVec3::splat(1e100)], &[1e100]),
        Err(ShapeError::Coordinate { .. })
    ));
    assert!(matches!(RationalPatch::new([1, 0], &points, &[0.0; 2]), Err(ShapeError::NoWeight { .. })));
    assert!(matches!(
        RationalPatch::new([usize::MAX, 0], &points, &[0.0; 2]),
        Err(ShapeError::Degree { .. })
    ));
    assert!(matches!(Triangle::new(usize::MAX, points), Err(ShapeError::Degree { .. })));
    assert!(matches!(Triangle::new(0, []), Err(ShapeError::TriangleSize { needed: 1, given: 0, .. })));
    assert!(matches!(RationalTriangle::new(1, &points, &[1.0; 2]), Err(ShapeError::TriangleSize { .. })));
    assert_eq!(PowerCurve::new([]), Err(ShapeError::NoControlPoints));
    assert!(matches!(PowerCurve::new(long), Err(ShapeError::Degree { .. })));
    assert!(matches!(PowerPatch::new([1, 1], points), Err(ShapeError::NetSize { .. })));
    assert!(matches!(PowerPatch::new([1, 0], [DVec3::NAN; 2]), Err(ShapeError::Coordinate { .. })));
    let c = RationalCurve::new(&points, &[1.0; 2]).unwrap();
    for ratio in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(c.repaced(ratio), Err(ShapeError::Construction { .. })));
    }
    assert!(c.reduced(2).is_err() && c.split(f64::INFINITY).is_err() && c.elevated(500).is_err());
    let signs = RationalCurve::new(&points, &[1.0, -1.0]).unwrap();
    assert!(matches!(signs.standard_form(), Err(ShapeError::Construction { .. })));
    // Degree 0 everywhere.
    let point = RationalCurve::new(&points[1..], &[-3.0]).unwrap();
    assert_eq!(
        (point.point(0.7).unwrap(), point.standard_form().unwrap().weights().next()),
        (DVec3::X, Some(1.0))
    );
    assert_eq!(
        RationalTriangle::new(0, &points[1..], &[2.0]).unwrap().jet(0.1, 0.2).unwrap().point,
        DVec3::X
    );
    // A parameter far out, where the polynomial leaves the range of numbers.
    let cubic = Curve::new([DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE]).unwrap();
    assert!(matches!(cubic.try_point(1e200), Err(ShapeError::Evaluation { .. })));
}

/// The surface of the literature: r(u,v) = (3v, 2u, 3v(1−v)).
#[test]
fn quadratic_cubic_patch() {
    let row = |y: f64| [[0., y, 0.], [1., y, 1.], [2., y, 1.], [3., y, 0.]].map(DVec3::from_array);
    let patch = Patch::new([2, 3], [row(0.0), row(1.0), row(2.0)].concat()).unwrap();
    let [u, v] = [0.5, 0.5];
    assert_eq!(patch.point(u, v), DVec3::new(1.5, 1.0, 0.75));
    assert_eq!(patch.normal(u, v), Some(DVec3::NEG_Z));
    let plane = patch.try_tangent_plane(u, v).unwrap();
    assert_eq!((plane.normal, plane.offset), (DVec3::NEG_Z, -0.75));
    let c = patch.try_curvatures(u, v).unwrap();
    assert_eq!(c.gaussian, 0.0);
    assert!((c.mean - 1.0 / 3.0).abs() < 4.0 * UNIT_ROUNDOFF);
    assert!(c.principal[0].abs() < UNIT_ROUNDOFF && (c.principal[1] - 2.0 / 3.0).abs() < 4.0 * UNIT_ROUNDOFF);
    assert!(
        c.directions[0].cross(DVec3::Y).length() < 1e-15 && c.directions[1].cross(DVec3::X).length() < 1e-15
    );
    // The same surface over other intervals has the same geometry.
    for length in [1e-9, 1e-3, 1e9] {
        let over = [Interval::new(0.0, length).unwrap(), Interval::new(0.0, 1.0).unwrap()];
        let stretched = patch.clone().with_intervals(over);
        let same = stretched.try_curvatures(0.5 * length, 0.5).unwrap();
        assert!((same.mean - c.mean).abs() < 1e-14 && same.gaussian.abs() < 1e-14);
        assert_eq!(stretched.normal(0.5 * length, 0.5), Some(DVec3::NEG_Z));
    }
}
