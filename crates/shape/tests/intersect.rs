//! Curves with planes, patches with lines: known cases, and points through which the plane or line is laid.
#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests

use casteljau_shape::bernstein::RootKind;
use casteljau_shape::geom::glam::{DVec3, DVec4};
use casteljau_shape::geom::{Interval, TangentPlane, UNIT_ROUNDOFF};
use casteljau_shape::{
    Curve, LineIntersection, LinePoint, Patch, PlaneIntersection, PlanePoint, RationalCurve, RationalPatch,
    ShapeError, StraightLine,
};
use proptest::collection::vec;
use proptest::prelude::*;

fn point() -> impl Strategy<Value = DVec3> {
    (-1.0..1.0, -1.0..1.0, -1.0..1.0).prop_map(DVec3::from)
}

fn weight() -> impl Strategy<Value = f64> {
    (-3.0..3.0_f64).prop_map(f64::exp2)
}

fn plane(normal: DVec3, through: DVec3) -> TangentPlane {
    TangentPlane { normal, offset: normal.dot(through) }
}

fn points(found: PlaneIntersection) -> Vec<PlanePoint> {
    match found {
        PlaneIntersection::Points(points) => points,
        PlaneIntersection::Contained => panic!("contained"),
    }
}

fn hits(found: LineIntersection) -> Vec<LinePoint> {
    match found {
        LineIntersection::Points(points) => points,
        other => panic!("{other:?}"),
    }
}

/// z = x² + y² over [−1, 1]², with x = 2u − 1, y = 2v − 1.
fn bowl() -> Patch {
    let height = [1.0, -1.0, 1.0];
    let at = |k: usize| DVec3::new((k / 3) as f64 - 1.0, (k % 3) as f64 - 1.0, height[k / 3] + height[k % 3]);
    Patch::new([2, 2], (0..9).map(at).collect::<Vec<_>>()).unwrap()
}

/// What the rounding of coefficients makes of the parameters of a transversal point, at most.
///
/// The two equations `Σ B w n·(A − p) = 0` have coefficients within 8(16 + 8(m+n+2))u of their size, and the slopes
/// w·n·S_u, w·n·S_v. The bound by row sums and by boxes of sides 1 : 2 may lose a factor of 4; if the box is not 64
/// times as wide as what rounding makes of the place, it is itself what is stated.
fn rounded_parameters(patch: &RationalPatch, line: &StraightLine, at: [f64; 2]) -> f64 {
    let jet = patch.jet(at[0], at[1]).unwrap();
    let degree = (patch.degrees()[0] + patch.degrees()[1] + 2) as f64;
    let size = |w: f64| w * (2.0 + line.origin().length());
    let largest = patch.weights().map(size).fold(0.0, f64::max);
    let least_weight = patch.weights().fold(f64::INFINITY, f64::min);
    let across = line.direction().normalize();
    let slopes = [jet.du, jet.dv].map(|s| s - s.dot(across) * across);
    let spread = slopes[0].cross(slopes[1]).length() / slopes[0].length().max(slopes[1].length());
    4.0 * 64.0 * 8.0 * (16.0 + 8.0 * degree) * UNIT_ROUNDOFF * largest / (least_weight * spread)
}

proptest! {
    /// A plane through a point of the curve meets it there, and all sign changes between samples are found.
    #[test]
    fn planes_meet_curves_where_they_must(p in vec(point(), 2..9), w in vec(weight(), 9), n in point(), t in 0.0..=1.0) {
        prop_assume!(n.length() > 0.1);
        let curve = RationalCurve::new(&p, &w[..p.len()]).unwrap();
        let on = curve.point(t).unwrap();
        let plane = plane(n, on);
        let PlaneIntersection::Points(found) = curve.intersect_plane(&plane, 1e-10).unwrap() else { return Ok(()) };
        // The place of a contact is blurred by the root of what rounding makes of its height.
        let near = |t: f64, reach: f64| found.iter().any(|f| f.enclosure[0] - reach <= t && t <= f.enclosure[1] + reach);
        prop_assert!(near(t, 1e-6), "{t}: {found:?}");
        for f in &found {
            prop_assert!(plane.distance(f.point).abs() < 1e-7);
        }
        let side = |i: i32| plane.distance(curve.point(f64::from(i) / 500.0).unwrap());
        for i in 0..500 {
            if side(i) * side(i + 1) < -1e-20 {
                let between = found.iter().any(|f| f.enclosure[1] >= f64::from(i) / 500.0 - 1e-9 && f.enclosure[0] <= f64::from(i + 1) / 500.0 + 1e-9);
                prop_assert!(between, "between samples {i} and {}: {found:?}", i + 1);
            }
        }
    }

    /// A line through a point of the patch meets it there; each hit lies on both.
    #[test]
    fn lines_meet_patches_where_they_must(
        p in vec(point(), 16), w in vec(weight(), 16), d in point(), m in 1..4usize, n in 1..4usize, u in 0.0..=1.0, v in 0.0..=1.0,
    ) {
        prop_assume!(d.length() > 0.1);
        let count = (m + 1) * (n + 1);
        let patch = RationalPatch::new([m, n], &p[..count], &w[..count]).unwrap();
        let on = patch.point(u, v).unwrap();
        let line = StraightLine::line(on - 2.0 * d, d).unwrap();
        let found = hits(patch.intersect_line(&line, 1e-7).unwrap());
        let near = |f: &LinePoint| {
            let reach = |k: usize| f.uncertainty[k] + 1e-7;
            (f.parameters[0] - u).abs() <= reach(0) && (f.parameters[1] - v).abs() <= reach(1)
        };
        prop_assert!(found.iter().any(near), "{u} {v}: {found:?}");
        for f in &found {
            prop_assert!(f.distance < if f.transversal { 1e-12 } else { 1e-6 }, "{f:?}");
            let allowed = rounded_parameters(&patch, &line, f.parameters);
            prop_assert!(!f.transversal || f.uncertainty.iter().all(|&r| r < allowed), "{f:?}, {allowed:e}");
        }
        // A segment that ends before the point, and one that ends beyond it.
        let (before, beyond) = (StraightLine::segment(on - 2.0 * d, on - 1e-3 * d), StraightLine::segment(on - 2.0 * d, on + 1e-3 * d));
        let short = hits(patch.intersect_line(&before.unwrap(), 1e-7).unwrap());
        let long = hits(patch.intersect_line(&beyond.unwrap(), 1e-7).unwrap());
        prop_assert!(long.iter().any(near) && short.len() < long.len());
    }
}

/// A point found on a box on which the Jacobian changes much is enclosed as tightly as rounding lets, all the same.
#[test]
fn enclosures_are_as_tight_as_rounding() {
    let points = [
        [-0.3297687460633977, 0.3939804038736902, 0.20235042661816438],
        [-0.04850094275905013, 0.0, 0.31261979527452544],
        [0.0, 0.21826611128346932, -0.6803762894293299],
        [0.5896476668789609, -0.9098050298134857, -0.9987368500436014],
        [-0.04678595747712766, 0.0465566413879799, 0.06324835773800153],
        [0.0255771763502575, 0.5822820638720992, 0.6498484707496874],
        [-0.09155386184058235, 0.07736576176233226, -0.7411150112005039],
        [0.22666101022999877, 0.5310632201569592, -0.4142710285770343],
        [0.020696988556872256, -0.9707150173474111, 0.12862549201045187],
        [0.5122600766525217, -0.6392685248831187, -0.35429370565897483],
        [-0.46060508937922967, 0.0037859054204326652, -0.16563989297485188],
        [0.6115568208157491, -0.6033332046132774, -0.8256933101414724],
    ];
    let weights = [
        0.16275354290876204,
        0.151559304350992,
        0.18543669276970762,
        0.16680624240058697,
        0.2503740423424934,
        0.8950212734938162,
        0.1641069703652801,
        1.7648526512789382,
        0.5321500617438083,
        0.13606269867577292,
        2.9017227089246753,
        0.15515198689232668,
    ];
    let patch = RationalPatch::new([2, 3], &points.map(DVec3::from), &weights).unwrap();
    let [u, v] = [0.8525182106170675, 0.4991569980893894];
    let d = DVec3::new(0.33302460730555816, -0.571041274316352, 0.5790460219581598);
    let line = StraightLine::line(patch.point(u, v).unwrap() - 2.0 * d, d).unwrap();
    let found = hits(patch.intersect_line(&line, 1e-7).unwrap());
    let point = found.iter().find(|f| (f.parameters[0] - u).abs() < 1e-9).unwrap();
    let allowed = rounded_parameters(&patch, &line, point.parameters);
    assert!(point.transversal && point.uncertainty.iter().all(|&r| r < allowed), "{point:?}, {allowed:e}");
}

#[test]
fn curves_and_planes() {
    let cubic =
        Curve::new([DVec3::ZERO, DVec3::new(1.0, 1.0, 0.0), DVec3::new(2.0, -1.0, 0.0), DVec3::X * 3.0])
            .unwrap();
    let across = points(cubic.intersect_plane(&plane(DVec3::Y, DVec3::ZERO), 1e-12).unwrap());
    // y = 3t(1−t)(1−2t): both ends, and the middle.
    assert_eq!(across.len(), 3, "{across:?}");
    assert_eq!((across[0].kind, across[2].kind), (RootKind::End(1), RootKind::End(1)));
    assert!(across[1].kind == RootKind::Simple && (across[1].parameter - 0.5).abs() < 1e-12);
    // The plane of the curve.
    assert_eq!(
        cubic.intersect_plane(&plane(DVec3::Z, DVec3::ZERO), 1e-12).unwrap(),
        PlaneIntersection::Contained
    );
    // In any position, within rounding.
    let tilted: Vec<DVec3> = cubic
        .control_points()
        .iter()
        .map(|p| DVec3::new(0.3, 0.1, 0.7) * p.x + DVec3::new(0.9, 0.2, -0.6) * p.y + DVec3::splat(0.1))
        .collect();
    let normal = DVec3::new(0.3, 0.1, 0.7).cross(DVec3::new(0.9, 0.2, -0.6));
    let tilted = Curve::new(tilted).unwrap();
    assert_eq!(
        tilted.intersect_plane(&plane(normal, DVec3::splat(0.1)), 1e-12).unwrap(),
        PlaneIntersection::Contained
    );
    // A contact, and none.
    let parabola = Curve::new([DVec3::new(-1.0, 1.0, 0.0), DVec3::NEG_Y, DVec3::new(1.0, 1.0, 0.0)]).unwrap();
    let contact = points(parabola.intersect_plane(&plane(DVec3::Y, DVec3::ZERO), 1e-12).unwrap());
    assert_eq!(contact.len(), 1, "{contact:?}");
    assert!(contact[0].kind == RootKind::Touch && (contact[0].parameter - 0.5).abs() < 1e-7);
    assert!(points(parabola.intersect_plane(&plane(DVec3::Y, DVec3::NEG_Y), 1e-12).unwrap()).is_empty());
    // Over another interval, with a huge normal.
    let moved = parabola.with_interval(Interval::new(-1.0, 3.0).unwrap());
    let found = points(moved.intersect_plane(&plane(DVec3::X * 1e300, DVec3::ZERO), 1e-12).unwrap());
    assert!(found.len() == 1 && (found[0].parameter - 1.0).abs() < 1e-11, "{found:?}");
}

#[test]
fn lines_and_patches() {
    let bowl = bowl();
    let through = |p: DVec3, d: DVec3| bowl.intersect_line(&StraightLine::line(p, d).unwrap(), 1e-7).unwrap();
    // Straight down, twice through, past it, touching the bottom.
    let down = hits(through(DVec3::new(0.25, 0.5, 4.0), DVec3::NEG_Z));
    assert!(down.len() == 1 && down[0].transversal && down[0].parameters == [0.625, 0.75], "{down:?}");
    let twice = hits(through(DVec3::Z * 0.25, DVec3::X));
    assert_eq!(twice.len(), 2, "{twice:?}");
    assert!((twice[0].line_parameter + 0.5).abs() < 1e-14 && (twice[1].line_parameter - 0.5).abs() < 1e-14);
    assert!(hits(through(DVec3::Z * -0.1, DVec3::X)).is_empty());
    let contact = hits(through(DVec3::ZERO, DVec3::X));
    assert!(contact.len() == 1 && !contact[0].transversal && contact[0].distance < 1e-12, "{contact:?}");
    assert!(contact[0].parameters.iter().all(|x| (x - 0.5).abs() < 1e-6), "{contact:?}");
    // Through a corner and along a side's plane: counted once.
    let corner = hits(through(DVec3::new(1.0, 1.0, 2.0), DVec3::new(1.0, 2.0, -3.0)));
    assert!(corner.iter().any(|f| f.parameters == [1.0, 1.0] && f.transversal), "{corner:?}");
    assert_eq!(corner.iter().filter(|f| f.point.distance(DVec3::new(1.0, 1.0, 2.0)) < 1e-6).count(), 1);
    // Rays and segments stop.
    let ray = StraightLine::ray(DVec3::Z * 0.25, DVec3::X).unwrap();
    assert_eq!(hits(bowl.intersect_line(&ray, 1e-7).unwrap()).len(), 1);
    let segment = StraightLine::segment(DVec3::new(-0.4, 0.0, 0.25), DVec3::new(0.4, 0.0, 0.25)).unwrap();
    assert!(hits(bowl.intersect_line(&segment, 1e-7).unwrap()).is_empty());
}

#[test]
fn lines_within() {
    let square = Patch::new([1, 1], [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::X + DVec3::Y]).unwrap();
    let inside = StraightLine::line(DVec3::new(0.5, 0.5, 0.0), DVec3::new(1.0, 2.0, 0.0)).unwrap();
    let LineIntersection::Coplanar { normal } = square.intersect_line(&inside, 1e-7).unwrap() else {
        panic!()
    };
    assert!(normal.z.abs() > 1.0 - 1e-15);
    // Parallel to the plane: no point, and not coplanar.
    let above = StraightLine::line(DVec3::Z, DVec3::X).unwrap();
    assert!(hits(square.intersect_line(&above, 1e-7).unwrap()).is_empty());
    // A ruling of z = xy.
    let saddle = Patch::new([1, 1], [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::ONE]).unwrap();
    let ruling = StraightLine::line(DVec3::new(0.5, 0.0, 0.0), DVec3::new(0.0, 1.0, 0.5)).unwrap();
    let LineIntersection::Stretches { stretches, .. } = saddle.intersect_line(&ruling, 1e-7).unwrap() else {
        panic!()
    };
    let [[[a, b], [c, d]]] = stretches[..] else { panic!("{stretches:?}") };
    assert!(a > 0.49 && b < 0.51 && c == 0.0 && d == 1.0, "{stretches:?}");
    // A patch that is a point, on the line.
    let point = Patch::new([0, 0], [DVec3::X]).unwrap();
    let axis = StraightLine::line(DVec3::ZERO, DVec3::X).unwrap();
    assert!(matches!(point.intersect_line(&axis, 1e-7).unwrap(), LineIntersection::Coplanar { .. }));
}

#[test]
fn a_sphere_is_pierced_at_its_radius() {
    let w = 0.5_f64.sqrt();
    let arc = [(1.0, 0.0, 1.0), (w, w, w), (0.0, 1.0, 1.0)];
    let octant: Vec<DVec4> = arc
        .iter()
        .flat_map(|p| arc.map(|m| DVec4::new(p.0 * m.0, p.1 * m.0, p.2 * m.1, p.2 * m.2)))
        .collect();
    let octant = RationalPatch::from_homogeneous([2, 2], octant).unwrap();
    for k in 1..100 {
        let d = DVec3::from([0.31, 0.47, 0.73].map(|a| (a * f64::from(k)).fract() + 0.01));
        let found = hits(octant.intersect_line(&StraightLine::ray(DVec3::ZERO, d).unwrap(), 1e-7).unwrap());
        assert!(found.len() == 1 && found[0].transversal, "{d}: {found:?}");
        assert!((found[0].line_parameter * d.length() - 1.0).abs() < 1e-14, "{d}: {found:?}");
    }
}

#[test]
fn sizes_and_doors() {
    for scale in [1e-100, 1e-6, 1e6, 1e100] {
        let patch = Patch::new([2, 2], bowl().control_points().iter().map(|p| p * scale).collect::<Vec<_>>())
            .unwrap();
        let line = StraightLine::line(DVec3::Z * 0.25 * scale, DVec3::X).unwrap();
        let found = hits(patch.intersect_line(&line, 1e-7).unwrap());
        assert_eq!(found.len(), 2, "{scale:e}");
        assert!((found[1].line_parameter / scale - 0.5).abs() < 1e-14);
    }
    let bowl = bowl();
    let line = StraightLine::line(DVec3::ZERO, DVec3::X).unwrap();
    for resolution in [0.0, -1.0, f64::NAN, 1.0] {
        assert!(matches!(bowl.intersect_line(&line, resolution), Err(ShapeError::Accuracy { .. })));
    }
    assert!(matches!(StraightLine::line(DVec3::NAN, DVec3::X), Err(ShapeError::Query { .. })));
    assert!(matches!(StraightLine::segment(DVec3::X, DVec3::X), Err(ShapeError::Direction { .. })));
    let curve = Curve::new([DVec3::ZERO, DVec3::X]).unwrap();
    let refused =
        |normal, offset, resolution| curve.intersect_plane(&TangentPlane { normal, offset }, resolution);
    assert!(matches!(refused(DVec3::ZERO, 0.0, 1e-9), Err(ShapeError::Direction { .. })));
    assert!(matches!(refused(DVec3::X, f64::NAN, 1e-9), Err(ShapeError::Parameter { .. })));
    assert!(matches!(refused(DVec3::X, 0.5, 0.0), Err(ShapeError::Kernel(_))));
}
