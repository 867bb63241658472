//! Arc lengths against closed forms, and against plain summation that knows nothing of adaptivity.
#![allow(clippy::unwrap_used)] // helpers of tests

use casteljau_geom::UNIT_ROUNDOFF;
use casteljau_geom::glam::{DAffine3, DQuat, DVec3};
use casteljau_shape::{Curve, ShapeError};
use proptest::collection::vec;
use proptest::prelude::*;

fn curve(points: &[[f64; 2]]) -> Curve {
    Curve::new(points.iter().map(|&[x, y]| DVec3::new(x, y, 0.0)).collect::<Vec<_>>()).unwrap()
}

/// `relative` accuracies from coarse to fine, each honoured.
#[track_caller]
fn assert_length(curve: &Curve, exact: f64) {
    for relative in [1e-3, 1e-6, 1e-10, 1e-12, 1e-13] {
        for c in [curve, &curve.reversed(), &curve.elevated(1).unwrap(), &curve.elevated(7).unwrap()] {
            let length = c.arc_length(relative).unwrap();
            assert!(
                (length - exact).abs() <= relative * exact,
                "{length:e} instead of {exact:e} at {relative:e}, degree {}",
                c.degree()
            );
        }
    }
}

#[test]
fn line() {
    assert_length(&curve(&[[1.0, 2.0], [4.0, 6.0]]), 5.0);
    // The same stretch at an uneven speed.
    assert_length(&curve(&[[1.0, 2.0], [1.3, 2.4], [4.0, 6.0]]), 5.0);
}

#[test]
fn line_that_runs_back() {
    // x = 2t(1−t) goes to ½ and returns; x = 3t − 9t² + 7t³ turns twice.
    assert_length(&curve(&[[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]]), 1.0);
    let x = |t: f64| 3.0 * t - 9.0 * t * t + 7.0 * t * t * t;
    // x′ = 3 − 18t + 21t² = 0
    let (a, b) = ((9.0 - 18_f64.sqrt()) / 21.0, (9.0 + 18_f64.sqrt()) / 21.0);
    assert_length(
        &curve(&[[0.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [1.0, 0.0]]),
        x(a) + (x(a) - x(b)) + (1.0 - x(b)),
    );
}

#[test]
fn parabola() {
    // y = x² over [0, b]: ½b√(1+4b²) + ¼ asinh 2b. With b large, the vertex is nearly a cusp seen from afar.
    for b in [0.1_f64, 1.0, 50.0, 1e4, 1e7] {
        let exact = 0.5 * b * (1.0 + 4.0 * b * b).sqrt() + 0.25 * (2.0 * b).asinh();
        assert_length(&curve(&[[0.0, 0.0], [0.5 * b, 0.0], [b, b * b]]), exact);
        assert_length(&curve(&[[-b, b * b], [0.0, -b * b], [b, b * b]]), 2.0 * exact);
    }
}

#[test]
fn cusps() {
    // Semicubical parabola (t², t³) over [−1, 1] has its cusp inside: L = 2·(13√13 − 8)/27.
    let half = (13.0 * 13_f64.sqrt() - 8.0) / 27.0;
    let whole = curve(&[[1.0, -1.0], [-1.0 / 3.0, 1.0], [-1.0 / 3.0, -1.0], [1.0, 1.0]]);
    assert_length(&whole, 2.0 * half);
    // The cusp at the end, at a dyadic parameter, and at one that no halving meets.
    let (left, right) = whole.split(0.5).unwrap();
    assert_length(&left, half);
    assert_length(&right, half);
    let part = whole.split(1.0 / 3.0).unwrap().1; // over t from −1/3 to 1
    let s: f64 = 1.0 / 3.0;
    let third = ((4.0 + 9.0 * s * s).powf(1.5) - 8.0) / 27.0;
    assert_length(&part, half + third);
}

#[test]
fn nearly_a_cusp() {
    // With a Pythagorean hodograph, C′ = (a² − b², 2ab) and |C′| = a² + b², the length is a polynomial. Here
    // a = t − ½ and b = ε, so C′ comes within ε² of 0 and turns around there: L = ∫ (t−½)² + ε² dt = 1/12 + ε².
    for e in [1e-1, 1e-3, 1e-6, 1e-9, 0.0] {
        let mut points = vec![[0.0, 0.0]];
        // The control vectors of C′, a third each.
        for (k, [dx, dy]) in [[0.25, -e], [-0.25, 0.0], [0.25, e]].into_iter().enumerate() {
            let [x, y] = points[k];
            points.push([x + (dx - e * e) / 3.0, y + dy / 3.0]);
        }
        assert_length(&curve(&points), 1.0 / 12.0 + e * e);
    }
}

#[test]
fn tiny_huge_and_far_away() {
    let exact = 5_f64.sqrt() / 2.0 + 2_f64.asinh() / 4.0;
    for scale in [1e-140, 1e-6, 1.0, 1e6, 1e100] {
        assert_length(&curve(&[[0.0, 0.0], [0.5 * scale, 0.0], [scale, scale]]), exact * scale);
    }
    // Powers of two far from the origin: the control points are still exact.
    let far = 2_f64.powi(40);
    let length = curve(&[[far, 0.0], [far + 0.5, 0.0], [far + 1.0, 1.0]]).arc_length(1e-13).unwrap();
    assert!((length - exact).abs() <= 1e-13 * exact);
}

#[test]
fn high_degree() {
    // An evenly run line of degree 400, and a zigzag of degree 100 against the sum below.
    let even: Vec<[f64; 2]> = (0..=400).map(|i| [f64::from(i), 0.0]).collect();
    let length = curve(&even).arc_length(1e-11).unwrap();
    assert!((length - 400.0).abs() < 1e-11 * 400.0);
    let zigzag: Vec<[f64; 2]> = (0..=100).map(|i| [f64::from(i), 10.0 * f64::from(i * i % 17)]).collect();
    let c = curve(&zigzag);
    let (length, sum) = (c.arc_length(1e-11).unwrap(), simpson(&c, 20_000));
    assert!((length - sum).abs() < 1e-10 * sum, "{length} {sum}");
}

#[test]
fn length_zero_and_nonsense_are_errors() {
    let point = Curve::new(vec![DVec3::ONE; 3]).unwrap();
    assert_eq!(point.arc_length(1e-10), Err(ShapeError::ZeroLength { control_points: 3 }));
    assert_eq!(
        Curve::new(vec![DVec3::ONE]).unwrap().arc_length(1e-10),
        Err(ShapeError::ZeroLength { control_points: 1 })
    );
    let c = curve(&[[0.0, 0.0], [1.0, 0.0]]);
    for relative in [0.0, -1.0, 1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(c.arc_length(relative), Err(ShapeError::Accuracy { .. })), "{relative}");
    }
    assert_eq!(c.arc_length_by_rule(&[]), 0.0);
    // The certificate counts rounding: 16(n+4)u and more is never promised away.
    let bent = curve(&[[0.0, 0.0], [0.5, 0.0], [1.0, 1.0]]);
    let refused = bent.arc_length(1e-15);
    assert!(matches!(refused, Err(ShapeError::ArcLength { reached, .. }) if reached > 5e-15), "{refused:?}");
}

#[test]
fn four_point_rule() {
    // The rule of the published program is exact for parabolas run at polynomial speed, and off by a little
    // elsewhere.
    let rule = [
        (-0.861136312, 0.347854845),
        (-0.339981044, 0.652145155),
        (0.339981044, 0.652145155),
        (0.861136312, 0.347854845),
    ];
    let straight = curve(&[[0.0, 0.0], [1.0, 0.0], [3.0, 0.0]]);
    assert!((straight.arc_length_by_rule(&rule) - 3.0).abs() < 1e-8);
    let bent = curve(&[[0.0, 0.0], [0.5, 0.0], [1.0, 1.0]]);
    let off = (bent.arc_length_by_rule(&rule) / bent.arc_length(1e-12).unwrap() - 1.0).abs();
    assert!(off > 1e-7 && off < 1e-3, "{off:e}");
}

/// Simpson's rule in as many steps, over speeds: converges like steps⁻⁴ where the speed is smooth, steps⁻² at
/// a kink.
fn simpson(c: &Curve, steps: usize) -> f64 {
    let speed = |k: usize| c.jet(k as f64 / (2 * steps) as f64).d1.length();
    let sum: f64 = (0..steps).map(|k| speed(2 * k) + 4.0 * speed(2 * k + 1) + speed(2 * k + 2)).sum();
    sum / (6 * steps) as f64
}

fn coordinate() -> impl Strategy<Value = f64> {
    // Half of the values from a few, so that points repeat and lines fold.
    prop_oneof![prop_oneof![Just(0.0), Just(1.0), Just(-1.0), Just(1.0 + 1e-9)], -1.0..1.0]
}

fn random_curve() -> impl Strategy<Value = Curve> {
    let point = (coordinate(), coordinate(), prop_oneof![3 => Just(0.0), 1 => coordinate()]);
    vec(point.prop_map(|(x, y, z)| DVec3::new(x, y, z)), 2..9).prop_map(|p| Curve::new(p).unwrap())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// The length is additive, whatever the place of the cut: a cut through a cusp changes the pieces entirely.
    #[test]
    fn additive(c in random_curve(), t in 0.05..0.95) {
        prop_assume!(c.arc_length(1e-12).is_ok());
        let whole = c.arc_length(1e-12).unwrap();
        let (left, right) = c.split(t).unwrap();
        let sum: f64 = [left, right].iter().map(|c| c.arc_length(1e-12).unwrap_or(0.0)).sum();
        // The control points of the pieces are rounded, each within 4(d+2)u of their size.
        let size: f64 = c.control_points().iter().map(|p| p.length()).sum();
        let rounding = 4.0 * ((c.degree() + 2) * 4 * c.degree()) as f64 * UNIT_ROUNDOFF * size;
        prop_assert!((whole - sum).abs() <= 3e-12 * whole + rounding, "{} {}", whole, sum);
    }

    /// Every curve that is not a point gets its length, at 1e-10 and near the limit of rounding.
    #[test]
    fn always_reached(c in random_curve()) {
        let points = c.control_points();
        prop_assume!(points.iter().any(|p| *p != points[0]));
        let (rough, fine) = (c.arc_length(1e-10).unwrap(), c.arc_length(1e-13).unwrap());
        prop_assert!((rough - fine).abs() <= 1e-10 * fine);
    }

    /// A rigid motion keeps the length, a uniform scale multiplies it.
    #[test]
    fn motion(c in random_curve(), angle in -3.0..3.0, scale in 1e-3..1e3) {
        prop_assume!(c.bounding_box().diagonal() > 0.1);
        let turn = DQuat::from_axis_angle(DVec3::new(2.0, -1.0, 2.0) / 3.0, angle);
        let map = DAffine3::from_scale_rotation_translation(DVec3::splat(scale), turn, DVec3::ZERO);
        let moved = Curve::new(c.control_points().iter().map(|&p| map.transform_point3(p)).collect::<Vec<_>>()).unwrap();
        let (a, b) = (c.arc_length(1e-12).unwrap() * scale, moved.arc_length(1e-12).unwrap());
        // Rounding of the moved points adds some u of the diagonal, which is no longer than a few lengths.
        prop_assert!((a - b).abs() <= 5e-12 * a, "{} {}", a, b);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// Against plain summation over 2¹⁶ intervals with a chord in each: below the length by at most
    /// h²/24·∫κ²|C′|³, and at a cusp by h² times the acceleration; after one step of Richardson's
    /// extrapolation well below 1e-8 of the size.
    #[test]
    fn brute_force(c in random_curve()) {
        let chords = |count: usize| {
            let at = |k: usize| c.point(k as f64 / count as f64);
            (0..count).map(|k| at(k).distance(at(k + 1))).sum::<f64>()
        };
        let (coarse, fine) = (chords(1 << 15), chords(1 << 16));
        let length = c.arc_length(1e-10).unwrap_or(0.0);
        let allowed = 1e-8 * c.control_points().iter().map(|p| p.length()).sum::<f64>();
        prop_assert!(((4.0 * fine - coarse) / 3.0 - length).abs() <= allowed, "{} {}", fine, length);
        prop_assert!(length >= fine - 1e-10 * length - 1e-12, "no shorter than its chords");
    }
}

/// Rational curves: closed forms, poles, and agreement with the polynomial ones.
mod rational {
    use super::*;
    use casteljau_geom::glam::DVec4;
    use casteljau_shape::RationalCurve;
    use std::f64::consts::PI;

    #[test]
    fn circles() {
        for scale in [1e-6, 1.0, 1e6] {
            for far in [0.0, 1e3] {
                let center = DVec3::splat(far * scale);
                let (x, y) = (DVec3::X * scale, DVec3::Y * scale);
                let whole = RationalCurve::full_circle(center, x, y).unwrap();
                // Control points far away are rounded: the circle is one to u·far only.
                let relative = 1e-12 * (1.0 + far);
                let length = whole.arc_length(relative).unwrap();
                assert!((length / scale - 2.0 * PI).abs() <= 2.0 * PI * relative, "{scale} {far} {length}");
                for sweep in [0.01, 1.0, 3.0] {
                    let sum: f64 = RationalCurve::arc(center, x, y, sweep)
                        .unwrap()
                        .iter()
                        .map(|a| a.arc_length(relative).unwrap())
                        .sum();
                    assert!((sum / scale - sweep).abs() <= relative * (1.0 + sweep), "{sum} {sweep}");
                }
            }
        }
        // A half circle through infinity, and weights that are all negative.
        let half = RationalCurve::from_homogeneous([
            DVec4::new(1., 0., 0., 1.),
            DVec4::Y,
            DVec4::new(-1., 0., 0., 1.),
        ])
        .unwrap();
        assert!((half.arc_length(1e-12).unwrap() - PI).abs() < 4e-12);
        let negative =
            RationalCurve::from_homogeneous(half.control_points().iter().map(|&p| -p).collect::<Vec<_>>())
                .unwrap();
        assert!((negative.arc_length(1e-12).unwrap() - PI).abs() < 4e-12);
    }

    #[test]
    fn poles_and_points() {
        let pole = RationalCurve::new(&[DVec3::ZERO, DVec3::X], &[1.0, -1.0]).unwrap();
        assert_eq!(pole.arc_length(1e-9), Err(ShapeError::Unbounded));
        let infinite = RationalCurve::from_homogeneous([DVec4::X, DVec4::W]).unwrap();
        assert_eq!(infinite.arc_length(1e-9), Err(ShapeError::Unbounded));
        let point = RationalCurve::new(&[DVec3::ONE; 3], &[1.0, 2.0, 3.0]).unwrap();
        assert_eq!(point.arc_length(1e-9), Err(ShapeError::ZeroLength { control_points: 3 }));
        assert!(matches!(point.arc_length(0.0), Err(ShapeError::Accuracy { .. })));
        // A line run through at an uneven pace, there and back in part where a weight is negative.
        let line = RationalCurve::new(&[DVec3::ZERO, DVec3::X, 2.0 * DVec3::X], &[1.0, 1e3, 1e-3]).unwrap();
        assert!((line.arc_length(1e-10).unwrap() - 2.0).abs() < 2e-10);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(500))]

        /// The same curve with equal weights, at another pace, and cut in two has the same length.
        #[test]
        fn same_length(c in random_curve(), pace in 0.2..5.0, t in 0.1..0.9, weights in vec(0.1..10.0, 9)) {
            prop_assume!(c.arc_length(1e-10).is_ok());
            let polynomial = c.arc_length(1e-10).unwrap();
            let rational = RationalCurve::from(c.clone());
            let size: f64 = c.control_points().iter().map(|p| p.length()).sum();
            for r in [rational.clone(), rational.repaced(pace).unwrap()] {
                let length = r.arc_length(1e-9).unwrap();
                prop_assert!((length - polynomial).abs() <= 2e-9 * polynomial + 1e-13 * size, "{length} {polynomial}");
            }
            let r = RationalCurve::new(c.control_points(), &weights[..c.degree() + 1]).unwrap();
            let whole = r.arc_length(1e-9).unwrap();
            let (left, right) = r.split(t).unwrap();
            let sum: f64 = [left, right].iter().map(|c| c.arc_length(1e-9).unwrap_or(0.0)).sum();
            // What rounding of points, each within 4(d+2)u of its size, makes of a length of many chords.
            let rounding = 1e3 * 8.0 * (c.degree() + 2) as f64 * UNIT_ROUNDOFF * size;
            prop_assert!((whole - sum).abs() <= 4e-9 * whole + rounding, "{} {}", whole, sum);
            let chords: f64 = (0..1000).map(|k| r.point(f64::from(k) / 1e3).unwrap().distance(r.point(f64::from(k + 1) / 1e3).unwrap())).sum();
            prop_assert!(whole >= chords * (1.0 - 1e-9) - rounding && whole <= chords * 1.01 + rounding, "{whole} {chords}");
        }
    }
}
