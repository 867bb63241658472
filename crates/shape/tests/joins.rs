//! Joins: reports that tell what was built, and neighbours that meet as wanted.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_geom::Interval;
use casteljau_geom::glam::DVec3;
use casteljau_shape::{
    CurvatureCondition, Curve, JoinReport, JoinTolerance, ParametricSurface, Patch, PatchEdge, RationalCurve,
    RationalPatch, RationalTriangle, ShapeError, SurfaceEdge,
};
use proptest::collection::vec;
use proptest::prelude::*;

const TIGHT: JoinTolerance = JoinTolerance { gap: 1e-9, angle: 1e-7, relative: 1e-8 };

fn point() -> impl Strategy<Value = DVec3> {
    (-1.0..1.0, -1.0..1.0, -1.0..1.0_f64).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

/// Curves whose last legs are no shorter than a tenth, so that directions are sure to 1e-14.
fn curve() -> impl Strategy<Value = Curve> {
    vec(point(), 3..8)
        .prop_filter("legs", |p| p.windows(2).all(|w| w[0].distance(w[1]) > 0.1))
        .prop_map(|p| Curve::new(p).unwrap())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    /// A curve cut in two joins itself with every continuity; with other intervals geometrically only.
    #[test]
    fn cut_curves(c in curve(), cut in 0.2..0.8) {
        let part = |a: f64, b: f64| c.restricted(Interval::new(a, b).unwrap()).unwrap();
        let (left, right) = (part(0.0, cut), part(cut, 1.0));
        prop_assume!(c.jet(cut).d1.length() > 0.1);
        let met = JoinReport::of_curves(&left, &right).unwrap().continuity(&TIGHT);
        prop_assert!(met.c0 && met.c1 && met.g1 && met.c2 && met.g2, "{met:?}");
        let other = right.clone().with_interval(Interval::new(0.0, 3.0).unwrap());
        let met = JoinReport::of_curves(&left, &other).unwrap().continuity(&TIGHT);
        prop_assert!(met.c0 && !met.c1 && met.g1 && !met.c2 && met.g2, "{met:?}");
        let met = JoinReport::of_curves(&left, &right.reversed()).unwrap().continuity(&TIGHT);
        prop_assert!(!met.g1);
    }

    #[test]
    fn continued_curves(c in curve(), ratio in 0.2..5.0, slide in -2.0..2.0, free in vec(point(), 1..4)) {
        let next = c.continued(ratio, &free).unwrap();
        let report = JoinReport::of_curves(&c, &next).unwrap();
        let met = report.continuity(&TIGHT);
        prop_assert!(met.c1 && met.g1 && report.gap.value == 0.0, "{report:?}");
        prop_assert!((next.control_points()[1] - next.start()).length() - ratio * (c.end() - c.control_points()[c.degree() - 1]).length() < 1e-12);
        // Any other interval: still G1.
        let met = JoinReport::of_curves(&c, &next.with_interval(Interval::UNIT)).unwrap().continuity(&TIGHT);
        prop_assert!(met.g1);
        let bent = c.continued_with_curvature(ratio, slide, &free).unwrap();
        let report = JoinReport::of_curves(&c, &bent).unwrap();
        let met = report.continuity(&TIGHT);
        prop_assert!(met.c1 && met.g1 && met.g2, "{report:?}");
        prop_assert!(CurvatureCondition::measure(&c, &bent).unwrap().is_sufficient(1e-9));
        // Coplanar alone is not enough: another distance from the tangent spoils the curvature only.
        let mut points = bent.control_points().to_vec();
        let offset = points[2] - points[1] - (points[1] - points[0]) * slide;
        prop_assume!(offset.length() > 1e-3);
        points[2] += offset;
        let wrong = Curve::new(points).unwrap();
        let condition = CurvatureCondition::measure(&c, &wrong).unwrap();
        prop_assert!(condition.is_necessary(1e-9) && !condition.is_sufficient(1e-9), "{condition:?}");
        prop_assert!((condition.ratio - 0.5).abs() < 1e-9);
        prop_assert!(!JoinReport::of_curves(&c, &wrong).unwrap().continuity(&TIGHT).g2);
        // Homogeneously, too.
        let rational = RationalCurve::from(c.clone());
        let free: Vec<_> = free.iter().map(|p| (*p * 0.7).extend(0.7)).collect();
        let report = JoinReport::of_curves(&rational, &rational.continued(ratio, &free).unwrap()).unwrap();
        prop_assert!(report.continuity(&TIGHT).c1, "{report:?}");
    }

    /// Weights of both curves at will, and equal ones, where it is the rule for polynomials.
    #[test]
    fn continued_rational_curves(
        c in curve(), bump in vec(0.3..3.0, 8), ratio in 0.2..5.0, slide in -2.0..2.0,
        v1 in 0.3..3.0, v2 in 0.3..3.0, free in vec(point(), 0..4),
    ) {
        let points = c.control_points();
        let rational = RationalCurve::new(points, &bump[..points.len()]).unwrap();
        let lifted: Vec<_> = free.iter().zip(&bump).map(|(p, w)| (*p * *w).extend(*w)).collect();
        let next = rational.continued_with_curvature(ratio, slide, [v1, v2], &lifted).unwrap();
        let report = JoinReport::of_curves(&rational, &next).unwrap();
        let met = report.continuity(&JoinTolerance { gap: 1e-12, angle: 1e-5, relative: 1e-7 });
        prop_assert!(met.c1 && met.g1 && met.g2, "{report:?}");
        let (plain, lifted) = (RationalCurve::from(c.clone()), free.iter().map(|p| p.extend(1.0)).collect::<Vec<_>>());
        let same = plain.continued_with_curvature(ratio, slide, [1.0, 1.0], &lifted).unwrap();
        let polynomial = RationalCurve::from(c.continued_with_curvature(ratio, slide, &free).unwrap());
        for (p, q) in same.control_points().iter().zip(polynomial.control_points()) {
            prop_assert!(p.distance(*q) < 1e-9 * (1.0 + q.length()), "{p} {q}");
        }
    }

    /// Tangent planes agree where the ratio varies; a constant one is the plain rule.
    #[test]
    fn continued_varying_patches(
        points in vec(point(), 16), weights in vec(0.5..2.0, 16), alpha in vec(0.3..3.0, 1..4),
        beta in vec(-1.0..1.0, 0..4), edge in 0..4usize,
    ) {
        let net: Vec<DVec3> = (0..16).map(|k| DVec3::new((k / 4) as f64, (k % 4) as f64, points[k].z)).collect();
        let patch = RationalPatch::new([3, 3], &net, &weights).unwrap();
        let edge = PatchEdge::ALL[edge];
        let next = patch.continued_varying(edge, &alpha, &beta, &[]).unwrap();
        let (a, b) = (SurfaceEdge::of_patch(&patch, edge).unwrap(), SurfaceEdge::of_patch(&next, PatchEdge::UStart).unwrap());
        let report = JoinReport::along_edge(&a, &b, 17).unwrap();
        prop_assert!(report.gap.value < 1e-13 && report.angle.unwrap().value < 1e-4, "{report:?}");
        let constant = patch.continued_varying(edge, &alpha[..1], &[], &[]).unwrap();
        let plain = patch.continued(edge, alpha[0], &[]).unwrap();
        for (p, q) in constant.control_points().iter().zip(plain.control_points()) {
            prop_assert!(p.distance(*q) < 1e-14 * (1.0 + q.length()), "{p} {q}");
        }
    }

    /// A patch cut in two, each half turned in every way: the right edges meet with every continuity.
    #[test]
    fn cut_patches(points in vec(point(), 16), bump in vec(0.5..2.0, 16), cut in 0.3..0.7, turn in 0..8usize, other in 0..8usize) {
        // A graph over the square, so that no normal is near to collapse.
        let net: Vec<DVec3> = (0..16).map(|k| DVec3::new((k / 4) as f64, (k % 4) as f64, points[k].z)).collect();
        let patch = RationalPatch::new([3, 3], &net, &bump).unwrap();
        let halves = [(0.0, cut), (cut, 1.0)].map(|(a, b)| patch.restricted([Interval::new(a, b).unwrap(), Interval::UNIT]).unwrap());
        let ((a, from, back), (b, to, again)) = (turned(&halves[0], turn, true), turned(&halves[1], other, false));
        let edge = |patch, edge, back: bool| {
            let edge = SurfaceEdge::of_patch(patch, edge).unwrap();
            if back { edge.reversed() } else { edge }
        };
        let (first, second) = (edge(&a, from, back), edge(&b, to, again));
        let report = JoinReport::along_edge(&first, &second, 9).unwrap();
        let met = report.continuity(&TIGHT);
        prop_assert!(met.c0 && met.c1 && met.g1 && met.c2 && met.g2, "{report:?}");
        prop_assert_eq!(report.undecided, 0);
        // The wrong way round, or folded back, it is seen.
        let report = JoinReport::along_edge(&first, &second.reversed(), 9).unwrap();
        prop_assert!(!report.continuity(&TIGHT).c0);
        let report = JoinReport::along_edge(&first, &first, 9).unwrap();
        prop_assert!(report.gap.value == 0.0 && (report.angle.unwrap().value - 180.0).abs() < 1e-6);
    }

    #[test]
    fn continued_patches(points in vec(point(), 16), ratio in 0.2..5.0, edge in 0..4usize, free in vec(point(), 8)) {
        let net: Vec<DVec3> = (0..16).map(|k| DVec3::new((k / 4) as f64, (k % 4) as f64, points[k].z)).collect();
        let patch = Patch::new([3, 3], net).unwrap();
        let edge = PatchEdge::ALL[edge];
        let next = patch.continued(edge, ratio, &free).unwrap();
        let (a, b) = (SurfaceEdge::of_patch(&patch, edge).unwrap(), SurfaceEdge::of_patch(&next, PatchEdge::UStart).unwrap());
        let report = JoinReport::along_edge(&a, &b, 17).unwrap();
        let met = report.continuity(&TIGHT);
        prop_assert!(report.gap.value == 0.0 && met.c1 && met.g1 && !met.g2, "{report:?}");
        let longer = next.clone().with_intervals([Interval::new(0.0, 7.0).unwrap(), Interval::UNIT]);
        let b = SurfaceEdge::of_patch(&longer, PatchEdge::UStart).unwrap();
        prop_assert!(JoinReport::along_edge(&a, &b, 17).unwrap().continuity(&TIGHT).g1);
    }
}

/// The same patch in one of its eight orientations, with the edge that was u = b (or u = a) and whether it is run
/// through backwards now.
fn turned(patch: &RationalPatch, way: usize, end: bool) -> (RationalPatch, PatchEdge, bool) {
    let (mut p, mut at_end, mut back) = (patch.clone(), end, false);
    if way & 1 != 0 {
        (p, at_end) = (mirrored(&p, 0), !at_end);
    }
    if way & 2 != 0 {
        (p, back) = (mirrored(&p, 1), !back);
    }
    let swapped = way & 4 != 0;
    if swapped {
        p = p.swapped();
    }
    let edge = match (swapped, at_end) {
        (false, false) => PatchEdge::UStart,
        (false, true) => PatchEdge::UEnd,
        (true, false) => PatchEdge::VStart,
        (true, true) => PatchEdge::VEnd,
    };
    (p, edge, back)
}

fn mirrored(p: &RationalPatch, axis: usize) -> RationalPatch {
    if axis == 0 { p.reversed_u() } else { p.reversed_v() }
}

#[test]
fn figures() {
    // A corner of 30° and a gap of ¼.
    let line = Curve::new([DVec3::ZERO, DVec3::X]).unwrap();
    let (s, c) = 30_f64.to_radians().sin_cos();
    let other = Curve::new([DVec3::new(1.0, 0.0, 0.25), DVec3::new(1.0 + 2.0 * c, 2.0 * s, 0.25)]).unwrap();
    let report = JoinReport::of_curves(&line, &other).unwrap();
    assert_eq!(report.gap.value, 0.25);
    assert!((report.angle.unwrap().value - 30.0).abs() < 1e-12);
    let back = JoinReport::of_curves(&line, &line.reversed()).unwrap();
    assert_eq!((back.gap.value, back.angle.unwrap().value), (0.0, 180.0));
    // A point has no tangent: nothing is claimed.
    let dot = Curve::new([DVec3::X]).unwrap();
    let report = JoinReport::of_curves(&line, &dot).unwrap();
    assert_eq!((report.angle, report.undecided), (None, 1));
    assert!(!report.continuity(&TIGHT).g1);
    // A circle goes on as another of twice the radius: G1, and the curvatures 1 and ½.
    let quarter =
        |r: f64| RationalCurve::arc(DVec3::X * (1.0 - r), DVec3::X * r, DVec3::Y * r, 1.0).unwrap().remove(0);
    let report = JoinReport::of_curves(&quarter(1.0).reversed(), &quarter(2.0)).unwrap();
    assert!((report.angle.unwrap().value - 180.0).abs() < 1e-6);
    let before = RationalCurve::arc(DVec3::ZERO, DVec3::X, DVec3::NEG_Y, 1.0).unwrap().remove(0).reversed();
    let report = JoinReport::of_curves(&before, &quarter(2.0)).unwrap();
    assert!(report.continuity(&TIGHT).g1 && (report.curvature.unwrap().value - 0.5).abs() < 1e-12);
}

#[test]
fn spheres_cylinders_and_a_fold() {
    let sphere = RationalPatch::sphere(DVec3::ONE, 2.0).unwrap();
    // Neighbours around, a meridian each, the collapsed pole at its end.
    let edge = |p, e| SurfaceEdge::of_patch(p, e).unwrap();
    let report =
        JoinReport::along_edge(&edge(&sphere[0], PatchEdge::UEnd), &edge(&sphere[1], PatchEdge::UStart), 17)
            .unwrap();
    let met = report.continuity(&JoinTolerance { gap: 1e-12, angle: 1e-5, relative: 1e-9 });
    assert!(met.g2 && report.undecided == 1, "{report:?}");
    // Across the equator; the southern octants run the other way.
    let report = JoinReport::along_edge(
        &edge(&sphere[0], PatchEdge::VStart),
        &edge(&sphere[4], PatchEdge::VStart).reversed(),
        17,
    )
    .unwrap();
    assert!(report.continuity(&TIGHT).g2, "{report:?}");
    let triangle =
        RationalTriangle::sphere_octant(DVec3::ONE, DVec3::X * 2.0, DVec3::Y * 2.0, DVec3::NEG_Z * 2.0)
            .unwrap();
    // Its edge λ₃ = 0 runs from x to y; a sphere's quarter circles are run through alike in their middle and ends.
    let below = SurfaceEdge::of_triangle(&triangle, 2).unwrap();
    let report = JoinReport::along_edge(&edge(&sphere[0], PatchEdge::VStart), &below, 3).unwrap();
    assert!(
        report.gap.value < 1e-14
            && report.angle.unwrap().value < 1e-5
            && report.curvature.unwrap().value < 1e-9,
        "{report:?}"
    );
    assert_eq!(report.first, None);
    // A cylinder and its tangent plane: the curvature ½ goes to 0.
    let wall = RationalPatch::cylinder(DVec3::ZERO, DVec3::Z, 2.0).unwrap().remove(0);
    let rim = wall.edge(PatchEdge::UStart);
    let (low, high) = (rim.start().unwrap(), rim.end().unwrap());
    let out = wall.jet(0.0, 0.0).unwrap().du * -1.0;
    let plane = Patch::new([1, 1], [low, high, low + out, high + out]).unwrap();
    let report =
        JoinReport::along_edge(&edge(&wall, PatchEdge::UStart), &edge(&plane, PatchEdge::UStart), 5).unwrap();
    assert!(
        report.continuity(&TIGHT).g1 && (report.curvature.unwrap().value - 1.0).abs() < 1e-9,
        "{report:?}"
    );
    // A plane folded by 40° along an edge.
    let (s, c) = 40_f64.to_radians().sin_cos();
    let across = out.normalize() * c + out.normalize().cross(high - low).normalize() * s;
    let folded = Patch::new([1, 1], [low, high, low + across, high + across]).unwrap();
    let turned = Patch::new([1, 1], [low - out, high - out, low, high]).unwrap();
    let report =
        JoinReport::along_edge(&edge(&turned, PatchEdge::UEnd), &edge(&folded, PatchEdge::UStart), 5)
            .unwrap();
    assert!((report.angle.unwrap().value - 40.0).abs() < 1e-9, "{report:?}");
}

#[test]
fn doors() {
    let c = Curve::new([DVec3::ZERO, DVec3::X]).unwrap();
    for ratio in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(c.continued(ratio, &[]), Err(ShapeError::Construction { .. })));
        assert!(c.continued_with_curvature(ratio, 0.0, &[]).is_err());
    }
    assert!(c.continued(1.0, &[DVec3::NAN]).is_err() && c.continued(1.0, &[DVec3::ZERO; 600]).is_err());
    assert!(c.continued_with_curvature(1.0, 0.0, &[]).is_err()); // of degree 1 there is no curvature
    assert!(Curve::new([DVec3::ZERO]).unwrap().continued(1.0, &[]).is_err());
    let still = Curve::new([DVec3::ZERO, DVec3::X, DVec3::X]).unwrap();
    assert!(still.continued_with_curvature(1.0, 0.0, &[]).is_err());
    let bent = RationalCurve::from(Curve::new([DVec3::ZERO, DVec3::X, DVec3::ONE]).unwrap());
    for weights in [[0.0, 1.0], [1.0, -1.0], [f64::NAN, 1.0]] {
        assert!(bent.continued_with_curvature(1.0, 0.0, weights, &[]).is_err());
    }
    let patch = Patch::new([0, 1], [DVec3::ZERO, DVec3::X]).unwrap();
    assert!(patch.continued(PatchEdge::UEnd, 1.0, &[]).is_err());
    assert!(matches!(patch.continued(PatchEdge::VEnd, 1.0, &[]).map(|p| p.degrees()), Ok([1, 0])));
    let flat = Patch::new([1, 1], [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE]).unwrap();
    assert!(matches!(flat.continued(PatchEdge::UEnd, 1.0, &[DVec3::X]), Err(ShapeError::NetSize { .. })));
    for (alpha, beta) in [(&[][..], &[][..]), (&[1.0, -1.0], &[]), (&[1.0], &[f64::NAN])] {
        assert!(flat.continued_varying(PatchEdge::UEnd, alpha, beta, &[]).is_err());
    }
    assert!(flat.continued_varying(PatchEdge::UEnd, &[1.0, 2.0], &[], &[DVec3::X]).is_err());
    let triangle = RationalTriangle::new(0, &[DVec3::X], &[1.0]).unwrap();
    assert!(SurfaceEdge::of_patch(&triangle, PatchEdge::UEnd).is_err());
    assert!(SurfaceEdge::of_triangle(&triangle, 3).is_err() && SurfaceEdge::of_triangle(&flat, 0).is_err());
    assert!(flat.try_normal(0.5, 0.5).is_ok());
}
