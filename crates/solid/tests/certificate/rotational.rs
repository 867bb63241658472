//! Solids of revolution: det J is a product of a function of (u, v), zero at the four corners only, and of
//! `(x² + y²)·(Z′R − ZR′)`.

use casteljau_solid::bernstein::{restrict, value};
use casteljau_solid::geom::glam::{DMat3, DVec3, DVec4};
use casteljau_solid::{DEFAULT_OPERATIONS, Feature, JacobianVerdict, SolidNet, jacobian_verdict};

use crate::support::{Chance, rotational};

fn verdict(meridian: &[DVec3], weights: &[f64], middle: f64) -> JacobianVerdict {
    let points = rotational(meridian, weights, middle);
    let net = SolidNet::Hexahedron { points: &points, degrees: [2, 2, meridian.len() - 1] };
    jacobian_verdict(&net, DEFAULT_OPERATIONS).unwrap()
}

fn edges() -> Vec<Feature> {
    [[0, 0], [0, 1], [1, 0], [1, 1]].into_iter().map(|at| Feature::Edge { axis: 2, at }).collect()
}

#[test]
fn rising_meridians() {
    let mut chance = Chance(7);
    for round in 0..600 {
        let n = 1 + round % 5;
        let turn = DVec3::new(chance.between(-1.0, 1.0), chance.between(-1.0, 1.0), 0.0);
        let mut z = chance.between(-3.0, 3.0);
        // z rises, and weights of one size keep Z′R − ZR′ positive; the meridian winds around the axis, but keeps away.
        let meridian: Vec<DVec3> = (0..=n)
            .map(|_| {
                z += chance.between(0.5, 1.0);
                let mut q = turn + chance.point(0.3 * turn.length());
                q.z = z;
                q
            })
            .collect();
        let weights: Vec<f64> =
            (0..=n).map(|_| if round % 2 == 0 { 1.0 } else { chance.between(0.9, 1.1) }).collect();
        let middle = [4.0, 1.0, 0.25, 16.0, chance.between(0.1, 10.0)][round % 5];
        let scale = 10_f64.powi(round as i32 % 13 - 6);
        let meridian: Vec<DVec3> = meridian.into_iter().map(|q| q * scale).collect();
        let got = verdict(&meridian, &weights, middle);
        assert_eq!(
            got,
            JacobianVerdict::PositiveExcept(edges()),
            "round {round}: {meridian:?} {weights:?} {middle}"
        );
    }
}

/// The function of w that det J is proportional to, with its least and largest value at 2000 places.
fn along_meridian(meridian: &[DVec3], weights: &[f64]) -> [f64; 2] {
    let n = meridian.len() - 1;
    let homogeneous: Vec<DVec4> = meridian.iter().zip(weights).map(|(&q, &r)| (q * r).extend(r)).collect();
    let slopes: Vec<DVec4> = homogeneous.windows(2).map(|w| (w[1] - w[0]) * n as f64).collect();
    let values = (0..=2000).map(|step| {
        let t = f64::from(step) / 2000.0;
        let [q, slope] = [value(&homogeneous, t), value(&slopes, t)];
        (q.x * q.x + q.y * q.y) * (slope.z * q.w - q.z * slope.w)
    });
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], k| [low.min(k), high.max(k)])
}

#[test]
fn any_meridians() {
    let mut chance = Chance(99);
    let (mut valid, mut invalid, mut between) = (0, 0, 0);
    for round in 0..1000 {
        let n = 1 + chance.below(5);
        let spread = chance.between(0.5, 2.0);
        let start = DVec3::new(1.0, 0.5, 0.0);
        let mut meridian: Vec<DVec3> = (0..=n)
            .map(|k| start + chance.point(spread) + DVec3::Z * (k as f64 * chance.between(0.3, 1.5)))
            .collect();
        // Half of them meet the axis at an end or both.
        let at_end = [chance.below(4) == 0, chance.below(4) == 0];
        for (end, place) in at_end.into_iter().zip([0, n]) {
            if end {
                (meridian[place].x, meridian[place].y) = (0.0, 0.0);
            }
        }
        if at_end[0] && at_end[1] && n == 1 {
            continue;
        }
        let weights: Vec<f64> = (0..=n).map(|_| 10_f64.powf(chance.between(-0.5, 0.5))).collect();
        let middle = 10_f64.powf(chance.between(-1.0, 1.5));
        let [low, high] = along_meridian(&meridian, &weights);
        let got = verdict(&meridian, &weights, middle);
        let what = || format!("round {round}: {low:e} {high:e} {got:?} {meridian:?} {weights:?} {middle}");
        // The zeros at ends on the axis are no zeros between: the smallest of the others decides.
        let inner = {
            let values = |a: f64, b: f64| {
                let cut = |points: &[DVec4]| {
                    let mut part = points.to_vec();
                    restrict(points, [a, b], &mut part).unwrap();
                    part
                };
                let homogeneous: Vec<DVec4> =
                    meridian.iter().zip(&weights).map(|(&q, &r)| (q * r).extend(r)).collect();
                let part = cut(&homogeneous);
                let points: Vec<DVec3> = part.iter().map(|p| p.truncate() / p.w).collect();
                let weights: Vec<f64> = part.iter().map(|p| p.w).collect();
                along_meridian(&points, &weights)[0]
            };
            values(if at_end[0] { 0.02 } else { 0.0 }, if at_end[1] { 0.98 } else { 1.0 })
        };
        if low < -1e-9 * high.abs() {
            assert!(matches!(got, JacobianVerdict::Invalid { value, .. } if value < 0.0), "{}", what());
            invalid += 1;
        } else if inner > 1e-6 * high {
            let mut expected = Vec::new();
            expected.extend(at_end[0].then_some(Feature::Face { axis: 2, at: 0 }));
            expected.extend(at_end[1].then_some(Feature::Face { axis: 2, at: 1 }));
            expected.extend(edges());
            assert_eq!(got, JacobianVerdict::PositiveExcept(expected), "{}", what());
            valid += 1;
        } else {
            between += 1;
        }
    }
    println!("{valid} valid, {invalid} invalid, {between} in between");
    assert!(valid > 250 && invalid > 250 && between < 20, "{valid} {invalid} {between}");
}

/// The whole ball as one hexahedron of degrees 2 × 2 × 3, and a meridian that comes back to the same height.
#[test]
fn ball_and_fold() {
    let third = 1.0 / 3.0;
    let half_circle = [[0.0, -1.0], [2.0, -1.0], [2.0, 1.0], [0.0, 1.0]].map(|[x, z]| DVec3::new(x, 0.0, z));
    let got = verdict(&half_circle, &[1.0, third, third, 1.0], 4.0);
    let names: Vec<String> = got.exceptions().iter().map(ToString::to_string).collect();
    assert_eq!(names[..2], ["face w = 0", "face w = 1"]);
    assert_eq!(got.exceptions()[2..], edges());
    let fold = [[1.0, 0.0], [1.0, 2.0], [2.0, -1.0], [2.0, 1.0]].map(|[x, z]| DVec3::new(x, 0.0, z));
    let JacobianVerdict::Invalid { witness, value } = verdict(&fold, &[1.0; 4], 4.0) else { panic!() };
    assert!(value < 0.0 && witness[2] > 0.2 && witness[2] < 0.8, "{witness:?}");
}

/// About any axis anywhere: the control points are rounded by what the rotation and the distance make of them, and the
/// edges are still found.
#[test]
fn turned_and_far_away() {
    let mut chance = Chance(5);
    for round in 0..300 {
        let n = 1 + round % 4;
        let mut z = 0.0;
        let meridian: Vec<DVec3> = (0..=n)
            .map(|_| {
                z += chance.between(0.3, 1.0);
                DVec3::new(chance.between(0.7, 1.0), chance.between(-0.3, 0.3), z)
            })
            .collect();
        let weights: Vec<f64> = (0..=n).map(|_| chance.between(0.9, 1.1)).collect();
        let turn = DMat3::from_axis_angle(chance.point(1.0).normalize(), chance.between(-3.0, 3.0));
        let far = chance.point([1.0, 1e3, 1e6][round % 3]);
        let points: Vec<DVec4> = rotational(&meridian, &weights, [1.0, 4.0][round % 2])
            .iter()
            .map(|p| (turn * (p.truncate() / p.w) + far, p.w))
            .map(|(p, w)| (p * w).extend(w))
            .collect();
        let net = SolidNet::Hexahedron { points: &points, degrees: [2, 2, n] };
        let got = jacobian_verdict(&net, DEFAULT_OPERATIONS).unwrap();
        assert_eq!(got, JacobianVerdict::PositiveExcept(edges()), "round {round}: {points:?}");
    }
}
