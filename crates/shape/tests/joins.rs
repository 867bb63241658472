//! Joins: reports that tell what was built, and neighbours that meet as wanted.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_bernstein::{elevate, value};
use casteljau_geom::Interval;
use casteljau_geom::glam::DVec3;
use casteljau_shape::{
    CurvatureCondition, Curve, JoinReport, JoinTolerance, ParametricCurve, ParametricSurface, Patch,
    PatchEdge, RationalCurve, RationalPatch, RationalTriangle, ShapeError, SurfaceEdge,
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

    /// The condition on control points and weights tells of curvatures what jets tell.
    #[test]
    fn rational_conditions_are_those_of_jets(
        c in curve(), bump in vec(0.3..3.0, 8), ratio in 0.2..5.0, slide in -2.0..2.0, v1 in 0.3..3.0, v2 in 0.3..3.0,
        free in vec(point(), 1..4), bent in 0.1..4.0_f64, negative in any::<bool>(), common in 0.3..3.0_f64,
    ) {
        let points = c.control_points();
        let first = RationalCurve::new(points, &bump[..points.len()]).unwrap();
        let lifted: Vec<_> = free.iter().zip(&bump).map(|(p, w)| (*p * *w).extend(*w)).collect();
        let right = first.continued_with_curvature(ratio, slide, [v1, v2], &lifted).unwrap();
        let condition = CurvatureCondition::measure(&first, &right).unwrap();
        let jets = [first.try_jet(first.interval().end()).unwrap(), right.try_jet(right.interval().start()).unwrap()];
        let [k, l] = jets.map(|jet| jet.curvature().unwrap());
        prop_assume!(k > 0.01);
        prop_assert!(condition.is_sufficient(1e-9) && (k - l).abs() < 1e-9 * k, "{condition:?} {k} {l}");
        // The weight of Q₂ is a factor of the curvature, so another one spoils that and nothing else; a negative one
        // turns it over.
        let mut net = right.control_points().to_vec();
        let place: DVec3 = net[2].truncate() / net[2].w;
        let weight = net[2].w * bent * if negative { -1.0 } else { 1.0 };
        net[2] = (place * weight).extend(weight);
        let other = RationalCurve::from_homogeneous(net).unwrap();
        let condition = CurvatureCondition::measure(&first, &other).unwrap();
        let jet = other.try_jet(0.0).unwrap();
        let l = jet.curvature().unwrap();
        prop_assert!((condition.ratio - (k - l).abs() / k.max(l)).abs() < 1e-9, "{condition:?} {k} {l}");
        prop_assert!((l - k * bent).abs() < 1e-9 * k.max(l));
        prop_assert_eq!(condition.is_necessary(1e-9), !negative, "{:?}", condition);
        // What multiplies all weights, or the i-th by cⁱ, changes the curve's parameters at most.
        let again = |curve: &RationalCurve| {
            let net = curve.control_points().iter().enumerate().map(|(i, p)| *p * common.powi(i as i32 + 1));
            RationalCurve::from_homogeneous(net.collect::<Vec<_>>()).unwrap()
        };
        let same = CurvatureCondition::measure(&again(&first), &again(&right)).unwrap();
        prop_assert!(same.is_sufficient(1e-9), "{same:?}");
        let negated = RationalCurve::from_homogeneous(first.control_points().iter().map(|p| *p * -1.0).collect::<Vec<_>>()).unwrap();
        prop_assert!(CurvatureCondition::measure(&negated, &right).unwrap().is_sufficient(1e-9));
        // A curve that is polynomial is one with equal weights.
        let plain = CurvatureCondition::measure(&c, &other).unwrap();
        let lifted = CurvatureCondition::measure(&RationalCurve::from(c.clone()), &other).unwrap();
        prop_assert_eq!(plain, lifted);
    }

    /// α is k(t − c)² + ε, elevated: it is positive if and only if ε is, whatever the signs of its coefficients.
    #[test]
    fn ratios_are_refused_where_they_are_not_positive(
        c in 0.05..0.95_f64, k in 0.5..20.0_f64, exponent in -9.0..-0.5_f64, raised in 2..9usize,
    ) {
        let flat = Patch::new([1, 1], [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::new(1.0, 1.0, 0.3)]).unwrap();
        let alpha = |epsilon: f64| {
            let quadratic = [k * c * c + epsilon, -k * c * (1.0 - c) + epsilon, k * (1.0 - c).powi(2) + epsilon];
            let mut out = vec![0.0; raised + 1];
            elevate(&quadratic, &mut out).unwrap();
            out
        };
        let epsilon = 10_f64.powf(exponent);
        let continued = |alpha: &[f64]| flat.continued_varying(PatchEdge::UEnd, alpha, &[], &[]);
        let next = continued(&alpha(epsilon));
        prop_assert!(next.is_ok(), "{next:?}");
        let below = alpha(-epsilon);
        match continued(&below) {
            Err(ShapeError::Ratio { at, value: found }) => {
                prop_assert!((0.0..=1.0).contains(&at) && found <= 0.0 && found == value(&below, at));
                prop_assert!(k * (at - c).powi(2) <= epsilon * (1.0 + 1e-6) || below[0] <= 0.0, "{at} {c}");
            }
            other => prop_assert!(false, "{other:?}"),
        }
    }

    /// The report gives back the ratio that a patch was continued with, divided by its first value as the interval is.
    #[test]
    fn reports_give_the_ratio_along_the_edge(
        points in vec(point(), 16), weights in vec(0.5..2.0, 16), alpha in vec(0.3..3.0, 1..5),
        beta in vec(-1.0..1.0, 0..4), edge in 0..4usize, length in 0.1..10.0_f64,
    ) {
        let net: Vec<DVec3> = (0..16).map(|k| DVec3::new((k / 4) as f64, (k % 4) as f64, points[k].z)).collect();
        let patch = RationalPatch::new([3, 3], &net, &weights).unwrap();
        let edge = PatchEdge::ALL[edge];
        let next = patch.continued_varying(edge, &alpha, &beta, &[]).unwrap();
        let ratio = |next: &RationalPatch, samples: usize| {
            let (a, b) = (SurfaceEdge::of_patch(&patch, edge).unwrap(), SurfaceEdge::of_patch(next, PatchEdge::UStart).unwrap());
            JoinReport::along_edge(&a, &b, samples).unwrap().ratio.unwrap()
        };
        let found = ratio(&next, 17);
        for (got, at) in [(found.least, found.least_at), (found.largest, found.largest_at)] {
            let exact = value(&alpha, at) / alpha[0];
            prop_assert!((got - exact).abs() < 1e-10 * (1.0 + exact), "{got} instead of {exact} at {at}");
        }
        for k in 0..=16 {
            let at = (std::f64::consts::FRAC_PI_2 * f64::from(k) / 16.0).sin().powi(2);
            let exact = value(&alpha, at) / alpha[0];
            prop_assert!(found.least <= exact + 1e-10 && exact <= found.largest + 1e-10, "{found:?} {exact} at {at}");
        }
        let spread = alpha.iter().fold(0.0, |most: f64, a| most.max((a - alpha[0]).abs()));
        prop_assert!(alpha.len() > 1 || found.is_constant(1e-10));
        prop_assert!(spread < 0.1 || !found.is_constant(1e-6), "{found:?}");
        // Over an interval that is longer, the derivatives across are shorter.
        let [across, along] = next.intervals();
        let longer = next.clone().with_intervals([Interval::new(0.0, across.length() * length).unwrap(), along]);
        let scaled = ratio(&longer, 17);
        prop_assert!((scaled.largest * length - found.largest).abs() < 1e-10 * found.largest);
        // Folded back the ratio is negative.
        let (a, back) = (SurfaceEdge::of_patch(&patch, edge).unwrap(), SurfaceEdge::of_patch(&patch, edge).unwrap());
        let fold = JoinReport::along_edge(&a, &back, 5).unwrap().ratio.unwrap();
        prop_assert!((fold.least + 1.0).abs() < 1e-12 && fold.is_constant(1e-12));
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
        // Across the joint the derivative is α of that before it and β of that along it, by the formula.
        for k in 0..=8 {
            let t = f64::from(k) / 8.0;
            let (u, v, sign) = match edge {
                PatchEdge::UStart => (0.0, t, -1.0),
                PatchEdge::UEnd => (1.0, t, 1.0),
                PatchEdge::VStart => (t, 0.0, -1.0),
                PatchEdge::VEnd => (t, 1.0, 1.0),
            };
            let jet = patch.jet(u, v).unwrap();
            let (out, along) = match edge {
                PatchEdge::UStart | PatchEdge::UEnd => (jet.du * sign, jet.dv),
                _ => (jet.dv * sign, jet.du),
            };
            let slide = if beta.is_empty() { 0.0 } else { value(&beta, t) };
            let wanted = out * (value(&alpha, t) / 3.0) + along * slide;
            let got = next.jet(0.0, t).unwrap().du * next.intervals()[0].length();
            prop_assert!(got.distance(wanted) < 1e-12 * (1.0 + wanted.length()), "{got} instead of {wanted} at {t}");
        }
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
    assert!(!report.continuity(&TIGHT).g1 && report.ratio.is_some_and(|ratio| ratio.largest == 0.0));
    assert_eq!(JoinReport::of_curves(&dot, &line).unwrap().ratio, None);
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
    // (1 − 2t)² touches 0 in the middle, t² at the start; 1 − 2t changes its sign; −1 is never positive.
    let refused = |alpha: &[f64]| flat.continued_varying(PatchEdge::UEnd, alpha, &[], &[]).unwrap_err();
    assert!(
        matches!(refused(&[1.0, -1.0, 1.0]), ShapeError::Ratio { at, value } if (at - 0.5).abs() < 1e-6 && value.abs() < 1e-12)
    );
    assert_eq!(refused(&[0.0, 0.0, 1.0]), ShapeError::Ratio { at: 0.0, value: 0.0 });
    assert_eq!(refused(&[1.0, 0.0, 0.0]), ShapeError::Ratio { at: 1.0, value: 0.0 });
    assert!(matches!(refused(&[1.0, -1.0]), ShapeError::Ratio { at, value } if at > 0.5 && value < 0.0));
    assert_eq!(refused(&[-1.0, -1.0, -1.0]), ShapeError::Ratio { at: 0.0, value: -1.0 });
    assert!(matches!(refused(&[1.0, f64::NAN]), ShapeError::Construction { .. }));
    let triangle = RationalTriangle::new(0, &[DVec3::X], &[1.0]).unwrap();
    assert!(SurfaceEdge::of_patch(&triangle, PatchEdge::UEnd).is_err());
    assert!(SurfaceEdge::of_triangle(&triangle, 3).is_err() && SurfaceEdge::of_triangle(&flat, 0).is_err());
    assert!(flat.try_normal(0.5, 0.5).is_ok());
}
