//! Translated, rotated and twisted solids against their closed forms.
#![allow(clippy::unwrap_used)] // helpers of tests

#[path = "../../shape/tests/support/mod.rs"]
mod support;

use casteljau_geom::glam::{DMat3, DVec2, DVec3};
use casteljau_geom::{Interval, rounding_bound};
use casteljau_shape::{
    Curve, ParametricCurve, ParametricSurface, Patch, RationalCurve, RationalPatch, ShapeError,
};
use casteljau_solid::{
    Axis, Hexahedron, HexahedronFace, ParametricSolid, RationalHexahedron, SolidError, rational_rotation,
};
use proptest::prelude::*;
use support::U;
use support::rational::Q;

fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![4 => -2.0..2.0, 1 => Just(0.0), 1 => Just(1.0), 1 => -1e-8..1e-8]
}

fn space_point() -> impl Strategy<Value = DVec3> {
    (coordinate(), coordinate(), coordinate()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

/// Weights within a decade: conditions stay out of the bounds.
fn weights(count: usize) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(prop_oneof![Just(1.0), 0.5..5.0], count)
}

fn patch() -> impl Strategy<Value = RationalPatch> {
    (1..4_usize, 1..3_usize).prop_flat_map(|(m, n)| {
        let count = (m + 1) * (n + 1);
        (prop::collection::vec(space_point(), count), weights(count))
            .prop_map(move |(points, weights)| RationalPatch::new([m, n], &points, &weights).unwrap())
    })
}

fn curve() -> impl Strategy<Value = RationalCurve> {
    (1..5_usize).prop_flat_map(|n| {
        (prop::collection::vec(space_point(), n + 1), weights(n + 1))
            .prop_map(|(points, weights)| RationalCurve::new(&points, &weights).unwrap())
    })
}

fn parameters() -> impl Strategy<Value = [f64; 3]> {
    let t = || prop_oneof![4 => 0.0..=1.0, 1 => Just(0.0), 1 => Just(1.0)];
    [t(), t(), t()]
}

/// `Σ B w x / Σ B w` at t, rounded once.
fn exact_radius(points: &[DVec3], weights: &[f64], t: f64) -> f64 {
    let n = points.len() - 1;
    let exact = |x: f64| Q::from_float(x).unwrap();
    let rest = exact(1.0) - exact(t);
    let (mut above, mut below) = (exact(0.0), exact(0.0));
    for (i, p) in points.iter().enumerate() {
        let mut b = exact(casteljau_bernstein::binomial(n, i)) * exact(weights[i]);
        for k in 0..n {
            b *= if k < i { exact(t) } else { rest.clone() };
        }
        above += b.clone() * exact(p.x);
        below += b;
    }
    let ratio = above.fraction() / below.fraction();
    num_traits::ToPrimitive::to_f64(&ratio).unwrap()
}

/// No coordinate of these shapes is larger, nor a ratio of weights.
const SIZE: f64 = 8.0;
const RATIO: f64 = 10.0;

/// What a value may be off, for degree d in all and derivatives of order k: coordinates of at most [`SIZE`], sums
/// divided by weights at most [`RATIO`]² times smaller than those in them, for the solid and for what it is compared
/// with.
fn allowed(degree: usize, order: usize) -> f64 {
    let slope = (2.0 * degree as f64 * RATIO * RATIO).powi(order as i32);
    2.0 * rounding_bound(degree, order, SIZE * RATIO * RATIO * slope)
}

proptest! {
    /// F = S + C − Q₀, and its Jacobian is that of the parts.
    #[test]
    fn transitional_is_a_sum(patch in patch(), curve in curve(), at in parameters()) {
        let solid = RationalHexahedron::transitional(&patch, &curve).unwrap();
        let degree: usize = solid.degrees().iter().sum();
        let [u, v, w] = at;
        let (s, c) = (patch.try_jet(u, v).unwrap(), curve.try_jet(w).unwrap());
        let jet = solid.jet(at).unwrap();
        prop_assert!(jet.point.distance(s.point + c.point - curve.start().unwrap()) <= 3.0 * allowed(degree, 0));
        for (got, exact) in [(jet.du, s.du), (jet.dv, s.dv), (jet.dw, c.d1)] {
            prop_assert!(got.distance(exact) <= allowed(degree, 1), "{got} {exact}");
        }
        let exact = s.du.cross(s.dv).dot(c.d1);
        let slopes = s.du.length() + s.dv.length() + c.d1.length();
        prop_assert!((jet.jacobian() - exact).abs() <= 8.0 * allowed(degree, 1) * (1.0 + slopes).powi(2));
        // The patch itself is the first face, to the bit where the curve starts with weight 1.
        let face = solid.face(HexahedronFace { axis: Axis::W, at_end: false }).unwrap();
        if curve.control_points()[0].w == 1.0 {
            prop_assert_eq!(face.control_points(), patch.control_points());
        }
    }

    /// The section at w is the disc of the meridian's point; the sides lie on its circle.
    #[test]
    fn rotational_is_the_solid_of_revolution(curve in curve(), at in parameters(), center in 0.2..5.0_f64) {
        let solid = RationalHexahedron::rotational_with_center(&curve, center).unwrap();
        let n = curve.degree();
        let [u, v, w] = at;
        let meridian = curve.point(w).unwrap();
        let radius = meridian.truncate().length();
        let p = solid.point(at).unwrap();
        prop_assert!((p.z - meridian.z).abs() <= allowed(n + 4, 0));
        prop_assert!(p.truncate().length() <= radius + allowed(n + 4, 0));
        for side in [[u, 0.0, w], [u, 1.0, w], [0.0, v, w], [1.0, v, w]] {
            let p = solid.point(side).unwrap();
            prop_assert!((p.truncate().length() - radius).abs() <= allowed(n + 4, 0), "{p} {radius}");
        }
        // (u, v) covers the disc: the quarter circles begin and end at Q, Q turned by a quarter, a half, three quarters.
        let turned = |quarter: usize| {
            let q = meridian.truncate();
            [q, DVec2::new(q.y, -q.x), -q, DVec2::new(-q.y, q.x)][quarter]
        };
        for (corner, quarter) in [([0.0, 0.0], 0), ([0.0, 1.0], 1), ([1.0, 1.0], 2), ([1.0, 0.0], 3)] {
            let p = solid.point([corner[0], corner[1], w]).unwrap();
            prop_assert!(p.truncate().distance(turned(quarter)) <= allowed(n + 4, 0), "{corner:?}");
        }
    }

    /// Meridians in one half-plane through the axis: nothing cancels, and eight roundings of the radius are enough.
    #[test]
    fn sides_lie_on_the_circle(
        polar in prop::collection::vec((0.1..3.0_f64, -2.0..2.0_f64), 2..6),
        w in prop::collection::vec(0.5..5.0_f64, 6),
        t in 0.0..=1.0_f64,
        s in 0.0..=1.0_f64,
    ) {
        let points: Vec<DVec3> = polar.iter().map(|&(r, z)| DVec3::new(r, 0.0, z)).collect();
        let curve = RationalCurve::new(&points, &w[..points.len()]).unwrap();
        let solid = RationalHexahedron::rotational(&curve).unwrap();
        let radius = exact_radius(&points, &w, t);
        for side in [[s, 0.0, t], [s, 1.0, t], [0.0, s, t], [1.0, s, t]] {
            let p = solid.point(side).unwrap();
            let off = (p.truncate().length() - radius).abs();
            prop_assert!(off <= 8.0 * U * radius, "{} u", off / radius / U);
        }
    }

    /// det J ≥ 0 where z rises along the meridian, as 8 z′|q|² sin(θ+φ) cos(θ−φ) … ≥ 0.
    #[test]
    fn rotational_jacobian_is_not_negative(
        polar in prop::collection::vec((-2.0..2.0_f64, -2.0..2.0_f64, 0.0..1.0_f64), 2..6),
        w in prop::collection::vec(0.5..5.0_f64, 6),
        at in parameters(),
    ) {
        let mut z = 0.0;
        let points: Vec<DVec3> = polar.iter().map(|&(x, y, dz)| { z += dz; DVec3::new(x, y, z) }).collect();
        let curve = RationalCurve::new(&points, &w[..points.len()]).unwrap();
        let slope = curve.try_jet(at[2]).unwrap().d1.z;
        // A rational z rises where its derivative does, not where its control points do.
        prop_assume!(slope >= 0.0);
        let solid = RationalHexahedron::rotational(&curve).unwrap();
        let jet = solid.jet(at).unwrap();
        let sizes = jet.du.length() * jet.dv.length() * jet.dw.length();
        prop_assert!(jet.jacobian() >= -8.0 * allowed(curve.degree() + 4, 1) * (1.0 + sizes), "{}", jet.jacobian());
        let edge = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]].map(|[u, v]| [u, v, at[2]]);
        for at in edge {
            let jet = solid.jet(at).unwrap();
            // ∂u and ∂v are parallel there.
            let sizes = jet.du.length() * jet.dv.length() * jet.dw.length();
            prop_assert!(jet.jacobian().abs() <= 8.0 * allowed(curve.degree() + 4, 1) * (1.0 + sizes));
        }
    }

    /// Layer k of the control points is that of the swept solid, rotated by kα.
    #[test]
    fn layers_are_rotated(patch in patch(), curve in curve(), angle in -7.0..7.0_f64) {
        let (swept, twisted) = (
            RationalHexahedron::transitional(&patch, &curve).unwrap(),
            RationalHexahedron::twisted(&patch, &curve, angle).unwrap(),
        );
        let layers = curve.degree() + 1;
        for (place, (p, q)) in swept.control_points().iter().zip(twisted.control_points()).enumerate() {
            let rotation = DMat3::from_rotation_z((place % layers) as f64 * angle);
            prop_assert!((rotation * p.truncate()).distance(q.truncate()) <= 16.0 * U * p.truncate().length());
            prop_assert_eq!(p.w, q.w);
        }
    }

    /// Every section is that of the swept solid, rotated as a rigid body by the angle that the formula says.
    #[test]
    fn rigid_sections_are_congruent(patch in patch(), curve in curve(), angle in -9.0..9.0_f64, at in parameters()) {
        let (swept, twisted) = (
            RationalHexahedron::transitional(&patch, &curve).unwrap(),
            RationalHexahedron::rigidly_twisted(&patch, &curve, angle).unwrap(),
        );
        let k = (angle.abs() / std::f64::consts::PI).floor() as usize + 1;
        let degree = twisted.degrees().iter().sum();
        // φ = 2k arg((1−t) + t e^{iθ/2k})
        let (t, share) = (at[2], angle / (2 * k) as f64);
        let phi = (2 * k) as f64 * (t * share.sin()).atan2(1.0 - t + t * share.cos());
        let exact = DMat3::from_rotation_z(phi) * swept.point(at).unwrap();
        // |q|²ᵏ may be as small as cos(θ/4k)²ᵏ: the weights cancel so far.
        let cancelled = (share.cos() / 2.0 + 0.5).powi(-(k as i32));
        let off = twisted.point(at).unwrap().distance(exact);
        prop_assert!(off <= cancelled * allowed(degree, 0), "{off:e}");
        prop_assert!(twisted.weights().all(|w| w > 0.0));
    }
}

#[test]
fn shrinking_at_mid_height() {
    let square = [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 0.0));
    let square = Patch::new([1, 1], square).unwrap();
    for n in 1..6 {
        let line = Curve::new([DVec3::ZERO, DVec3::Z]).unwrap().elevated(n - 1).unwrap();
        let solid = Hexahedron::twisted(&square, &line, 0.7).unwrap();
        let p = solid.point([1.0, 1.0, 0.5]);
        let exact = 2_f64.sqrt() * (0.35_f64).cos().powi(n as i32);
        assert!((p.truncate().length() - exact).abs() < 4e-15, "{n}");
        let turned = (p.y.atan2(p.x) - std::f64::consts::FRAC_PI_4 - 0.35 * n as f64)
            .rem_euclid(std::f64::consts::TAU);
        assert!(turned.min(std::f64::consts::TAU - turned) < 4e-15 * n as f64, "{n} {turned}");
        let rigid = RationalHexahedron::rigidly_twisted(&square.clone().into(), &line.into(), 0.7 * n as f64)
            .unwrap();
        let p = rigid.point([1.0, 1.0, 0.5]).unwrap();
        assert!((p.truncate().length() - 2_f64.sqrt()).abs() < 4e-15);
    }
}

#[test]
fn rotation_deviates_as_stated() {
    for (angle, k) in [(std::f64::consts::FRAC_PI_2, 1), (std::f64::consts::PI, 2), (9.4, 3), (-20.0, 7)] {
        let [cosine, sine, weight] = rational_rotation(angle, k).unwrap();
        let net = (0..=2 * k).map(|j| casteljau_geom::glam::DVec4::new(cosine[j], sine[j], 0.0, weight[j]));
        let curve = RationalCurve::from_homogeneous(net.collect::<Vec<_>>()).unwrap();
        let mut turned = 0.0;
        let mut last = 0.0;
        for i in 0..=1000 {
            let t = f64::from(i) / 1000.0;
            let p = curve.point(t).unwrap();
            assert!((p.length() - 1.0).abs() < 1e-13);
            let next = p.y.atan2(p.x);
            let step: f64 = next - last;
            turned += step - std::f64::consts::TAU * (step / std::f64::consts::TAU).round();
            last = next;
            assert!((turned - t * angle).abs() < 0.143 * k as f64, "{angle} {t}");
        }
        assert!((turned - angle).abs() < 1e-12);
    }
}

#[test]
fn intervals_are_kept() {
    let of = |a, b| Interval::new(a, b).unwrap();
    let square = Patch::new([1, 1], [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::new(1.0, 1.0, 0.0)]).unwrap();
    let square = square.with_intervals([of(0.0, 2.0), of(-1.0, 1.0)]);
    let line = Curve::new([DVec3::ZERO, DVec3::Z]).unwrap().with_interval(of(3.0, 5.0));
    let solid = Hexahedron::transitional(&square, &line).unwrap();
    assert_eq!(solid.point([1.0, 0.0, 4.0]), DVec3::splat(0.5));
    let meridian = RationalCurve::from(line);
    assert_eq!(RationalHexahedron::rotational(&meridian).unwrap().intervals()[2], of(3.0, 5.0));
}

#[test]
fn nonsense_is_refused() {
    let square = Patch::new([1, 1], [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::new(1.0, 1.0, 0.0)]).unwrap();
    let line = Curve::new([DVec3::ZERO, DVec3::Z]).unwrap();
    for angle in [f64::NAN, f64::INFINITY] {
        assert!(matches!(Hexahedron::twisted(&square, &line, angle), Err(SolidError::Construction { .. })));
    }
    let (square, line) = (RationalPatch::from(square), RationalCurve::from(line));
    let refused = RationalHexahedron::rigidly_twisted(&square, &line, 1e6);
    assert!(matches!(refused, Err(SolidError::Kernel(_))), "{refused:?}");
    let refused = RationalHexahedron::rigidly_twisted(&square, &line, 1e300);
    assert!(matches!(refused, Err(SolidError::Kernel(_))), "{refused:?}");
    let infinite = RationalCurve::from_homogeneous([
        casteljau_geom::glam::DVec4::new(1.0, 0.0, 0.0, 0.0),
        casteljau_geom::glam::DVec4::W,
    ])
    .unwrap();
    assert!(matches!(
        RationalHexahedron::transitional(&square, &infinite),
        Err(SolidError::Construction { .. })
    ));
    // A meridian may have points at infinity.
    assert!(RationalHexahedron::rotational(&infinite).is_ok());
    let far = Curve::new([DVec3::ZERO, DVec3::new(9e139, 0.0, 0.0)]).unwrap();
    let wide = Patch::new([0, 1], [DVec3::ZERO, DVec3::new(9e139, 0.0, 0.0)]).unwrap();
    let refused = Hexahedron::transitional(&wide, &far);
    assert!(matches!(refused, Err(SolidError::Shape(ShapeError::Coordinate { .. }))), "{refused:?}");
}

#[test]
fn twisted_solids_have_their_jacobian() {
    // Against a difference quotient along the height.
    let square = Patch::new([1, 1], [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::new(1.0, 1.0, 0.3)]).unwrap();
    let line = Curve::new([DVec3::ZERO, DVec3::new(0.1, 0.0, 1.0), DVec3::new(0.0, 0.2, 2.0)]).unwrap();
    let solid = RationalHexahedron::rigidly_twisted(&square.into(), &line.into(), 4.0).unwrap();
    let at = [0.3, 0.6, 0.4];
    let jet = solid.jet(at).unwrap();
    let h = 1e-5;
    for (axis, exact) in [jet.du, jet.dv, jet.dw].into_iter().enumerate() {
        let (mut before, mut after) = (at, at);
        before[axis] -= h;
        after[axis] += h;
        let slope = (solid.try_point(after).unwrap() - solid.try_point(before).unwrap()) / (2.0 * h);
        // The third derivative is below 100; half a rounding of the points over h.
        assert!(slope.distance(exact) < 100.0 * h * h + 8.0 * U / h, "{axis}");
    }
}
