//! Shapes and queries of which the answer is known.

use casteljau_shape::geom::Interval;
use casteljau_shape::geom::glam::{DVec3, DVec4};
use casteljau_shape::{Curve, CurveProjector, Patch, PatchProjector, RationalCurve, ShapeError};

use crate::brute::{curve, patch};

/// A quarter of the unit circle, by its homogeneous control points.
fn quarter() -> [DVec4; 3] {
    let w = 0.5_f64.sqrt();
    [DVec4::new(1.0, 0.0, 0.0, 1.0), DVec4::new(w, w, 0.0, w), DVec4::new(0.0, 1.0, 0.0, 1.0)]
}

/// An octant of the unit sphere: the quarter circle turned about the z axis. The side v = 1 is the north pole.
fn octant() -> Vec<DVec4> {
    let (ring, arc) = (quarter(), quarter());
    let points = ring.iter().flat_map(|p| {
        // A meridian's point (r, z) with weight s, carried along the ring.
        arc.map(|m| DVec4::new(p.x * m.x, p.y * m.x, p.w * m.y, p.w * m.w))
    });
    points.collect()
}

#[test]
fn all_points_equally_close() {
    let projector = patch([2, 2], &octant());
    let answer = projector.closest_point(DVec3::ZERO).unwrap();
    assert!((answer.distance - 1.0).abs() < 1e-15 && answer.lower_bound > 1.0 - 1e-12, "{answer:?}");
    let arc = curve(&quarter());
    let answer = arc.closest_point(DVec3::ZERO).unwrap();
    assert!((answer.distance - 1.0).abs() < 1e-15 && answer.lower_bound > 1.0 - 1e-12, "{answer:?}");
    // From the axis of the circle.
    let answer = arc.closest_point(DVec3::Z).unwrap();
    assert!((answer.distance - 2_f64.sqrt()).abs() < 1e-15 && answer.lower_bound > 2_f64.sqrt() - 1e-12);
}

/// A query on the axis of a surface of revolution: a circle of closest points. The proof may stay open by a
/// little, and says so.
#[test]
fn circle_of_closest_points() {
    let cylinder: Vec<DVec4> =
        quarter().iter().flat_map(|&p| [-1.0, 1.0].map(|z| DVec4::new(p.x, p.y, z * p.w, p.w))).collect();
    let projector = patch([2, 1], &cylinder);
    let answer = projector.closest_point(DVec3::new(0.0, 0.0, 0.3)).unwrap();
    assert!((answer.distance - 1.0).abs() < 1e-14 && answer.lower_bound <= 1.0, "{answer:?}");
    assert!(answer.lower_bound > 1.0 - 1e-5, "{answer:?}");
}

#[test]
fn distance_to_the_sphere_is_exact() {
    let projector = patch([2, 2], &octant());
    for k in 1..200 {
        let [x, y, z] = [0.31, 0.47, 0.73].map(|a| (a * f64::from(k)).fract() + 1e-3);
        let q = DVec3::new(x, y, z) * 1.7;
        let answer = projector.closest_point(q).unwrap();
        let exact = (q.length() - 1.0).abs();
        assert!((answer.distance - exact).abs() < 1e-14, "{q}: {answer:?}");
        assert!(
            answer.lower_bound > exact - 1e-12 && answer.point.distance(q.normalize()) < 1e-7,
            "{q}: {answer:?}"
        );
    }
    // Straight above the pole, to which a side is collapsed.
    let above = projector.closest_point(DVec3::Z * 3.0).unwrap();
    assert!((above.distance - 2.0).abs() < 1e-15 && above.parameters[1] > 1.0 - 1e-7, "{above:?}");
}

/// The cusp of (t², t³) is the closest point for all q on the negative x axis.
#[test]
fn at_a_cusp() {
    let cusp = Curve::new(vec![
        DVec3::new(1.0, -1.0, 0.0),
        DVec3::new(-1.0 / 3.0, 1.0, 0.0),
        DVec3::new(-1.0 / 3.0, -1.0, 0.0),
        DVec3::new(1.0, 1.0, 0.0),
    ])
    .unwrap();
    let projector = CurveProjector::new(&cusp).unwrap();
    for x in [1e-9, 1e-3, 1.0, 1e3] {
        let answer = projector.closest_point(DVec3::new(-x, 0.0, 0.0)).unwrap();
        assert!((answer.distance - x).abs() <= 1e-14 * (1.0 + x), "{x}: {answer:?}");
        assert!(answer.lower_bound >= x - 1e-12 * (1.0 + x), "{x}: {answer:?}");
    }
}

#[test]
fn points_and_lines() {
    let point = PatchProjector::new(&Patch::new([2, 1], vec![DVec3::ONE; 6]).unwrap()).unwrap();
    let answer = point.closest_point(DVec3::ZERO).unwrap();
    assert!((answer.distance - 3_f64.sqrt()).abs() < 1e-15 && answer.lower_bound > 1.732_050_8);
    let zero = CurveProjector::new(&Curve::new(vec![DVec3::ZERO]).unwrap()).unwrap();
    assert_eq!(zero.closest_point(DVec3::X).unwrap().distance, 1.0);
    let line = CurveProjector::new(&Curve::new(vec![DVec3::ZERO, DVec3::X]).unwrap()).unwrap();
    let answer = line.closest_point(DVec3::new(0.25, 1.0, 0.0)).unwrap();
    assert_eq!((answer.parameters, answer.distance), ([0.25], 1.0));
    let beyond = line.closest_point(DVec3::new(3.0, 0.0, 0.0)).unwrap();
    assert_eq!((beyond.parameters, beyond.distance), ([1.0], 2.0));
}

/// Sizes from 1e-130 to 1e130, and degrees far from daily use.
#[test]
fn extremes() {
    for scale in [1e-300, 1e-130, 1e-6, 1e6, 1e130] {
        let net = [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::ONE].map(|p| p * scale);
        let patch = PatchProjector::new(&Patch::new([1, 1], net).unwrap()).unwrap();
        let answer = patch.closest_point(DVec3::new(-1.0, 0.5, 0.0) * scale).unwrap();
        assert!((answer.distance / scale - 1.0).abs() < 1e-14, "{scale:e}: {answer:?}");
        assert!(answer.lower_bound / scale > 1.0 - 1e-12, "{scale:e}: {answer:?}");
    }
    let long: Vec<DVec3> =
        (0..=200).map(|i| DVec3::new(f64::from(i), f64::from(i % 7), f64::from(i % 3))).collect();
    let long = Curve::new(long).unwrap();
    let projector = CurveProjector::new(&long).unwrap();
    let q = DVec3::new(80.0, 10.0, 0.0);
    let answer = projector.closest_point(q).unwrap();
    let brute =
        (0..=20_000).map(|i| long.point(f64::from(i) / 2e4).distance(q)).fold(f64::INFINITY, f64::min);
    assert!(
        answer.distance <= brute + 1e-9 && answer.lower_bound > answer.distance - 1e-9,
        "{answer:?} {brute}"
    );
    let wide: Vec<DVec3> =
        (0..441).map(|k| DVec3::new(f64::from(k / 21), f64::from(k % 21), f64::from(k * 7 % 5))).collect();
    let patch = Patch::new([20, 20], wide).unwrap();
    let answer = PatchProjector::new(&patch).unwrap().closest_point(DVec3::new(7.3, 4.1, 5.0)).unwrap();
    assert!(answer.distance - answer.lower_bound < 1e-10 * answer.distance, "{answer:?}");
}

#[test]
fn doors() {
    let line = CurveProjector::new(&Curve::new(vec![DVec3::ZERO, DVec3::X]).unwrap()).unwrap();
    assert!(matches!(line.closest_point(DVec3::NAN), Err(ShapeError::Query { axis: 0, .. })));
    assert!(matches!(
        line.local_minima(DVec3::new(0.0, 0.0, f64::INFINITY)),
        Err(ShapeError::Query { axis: 2, .. })
    ));
    assert!(matches!(line.closest_point(DVec3::Y * 1e141), Err(ShapeError::Query { axis: 1, .. })));
    assert!(matches!(line.closest_point_from(DVec3::Y, f64::NAN), Err(ShapeError::Parameter { .. })));
    assert!(line.closest_point_from(DVec3::Y, -7.0).unwrap().converged);
    for w in [-1.0, 0.0, -0.0] {
        let mixed = RationalCurve::from_homogeneous([DVec4::W, DVec4::W * w]).unwrap();
        assert!(matches!(CurveProjector::new(&mixed), Err(ShapeError::Weight { place: 1, .. })), "{w}");
    }
    // All negative is as good as all positive.
    let negative = RationalCurve::new(&[DVec3::ZERO, DVec3::X], &[-2.0, -1.0]).unwrap();
    assert_eq!(CurveProjector::new(&negative).unwrap().closest_point(DVec3::Y).unwrap().distance, 1.0);
    let tiny = CurveProjector::new(&Curve::new(vec![DVec3::ZERO, DVec3::X * 1e-100]).unwrap()).unwrap();
    assert!(matches!(tiny.closest_point(DVec3::X * 1e60), Err(ShapeError::Query { .. })));
}

/// Parameters are those of the shape's own intervals.
#[test]
fn intervals() {
    let over = |a, b| Interval::new(a, b).unwrap();
    let line = Curve::new([DVec3::ZERO, DVec3::X]).unwrap().with_interval(over(-3.0, 5.0));
    let projector = CurveProjector::new(&line).unwrap();
    let q = DVec3::new(0.25, 1.0, 0.0);
    assert_eq!(projector.closest_point(q).unwrap().parameters, [-1.0]);
    assert_eq!(projector.closest_point_from(q, 4.0).unwrap().parameters, [-1.0]);
    assert_eq!(projector.local_minima(q).unwrap().minima[0].parameters, [-1.0]);
    let square = [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::X + DVec3::Y];
    let square = Patch::new([1, 1], square).unwrap().with_intervals([over(2.0, 4.0), over(-1.0, 0.0)]);
    let answer = PatchProjector::new(&square).unwrap().closest_point(DVec3::new(0.5, 0.25, 7.0)).unwrap();
    assert_eq!((answer.parameters, answer.distance), ([3.0, -0.75], 7.0));
}
