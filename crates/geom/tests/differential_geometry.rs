//! Normals, curvatures and the quotient rule on surfaces whose answers are known.
#![allow(clippy::unwrap_used)] // helpers of tests

use casteljau_geom::glam::{DAffine3, DQuat, DVec2, DVec3, DVec4};
use casteljau_geom::{
    CurveJet, GeomError, ScalarJet, SurfaceJet, UNIT_ROUNDOFF, angle_degrees, quotient_curve_jet,
    quotient_jet, quotient_partials,
};
use proptest::prelude::*;

/// Jet of the sphere of radius r, u the longitude and v the latitude.
fn sphere(r: f64, u: f64, v: f64) -> SurfaceJet {
    let ((su, cu), (sv, cv)) = (u.sin_cos(), v.sin_cos());
    SurfaceJet {
        point: DVec3::new(cu * cv, su * cv, sv) * r,
        du: DVec3::new(-su * cv, cu * cv, 0.0) * r,
        dv: DVec3::new(-cu * sv, -su * sv, cv) * r,
        duu: DVec3::new(-cu * cv, -su * cv, 0.0) * r,
        duv: DVec3::new(su * sv, -cu * sv, 0.0) * r,
        dvv: DVec3::new(-cu * cv, -su * cv, -sv) * r,
    }
}

/// Jet of the torus with radii R > r, u around the axis, v around the tube.
fn torus(big: f64, small: f64, u: f64, v: f64) -> SurfaceJet {
    let ((su, cu), (sv, cv)) = (u.sin_cos(), v.sin_cos());
    let rho = big + small * cv;
    SurfaceJet {
        point: DVec3::new(rho * cu, rho * su, small * sv),
        du: DVec3::new(-rho * su, rho * cu, 0.0),
        dv: DVec3::new(-small * sv * cu, -small * sv * su, small * cv),
        duu: DVec3::new(-rho * cu, -rho * su, 0.0),
        duv: DVec3::new(small * sv * su, -small * sv * cu, 0.0),
        dvv: DVec3::new(-small * cv * cu, -small * cv * su, -small * sv),
    }
}

/// The same surface under the parameters (u + k v, v/s): other derivatives, same geometry.
fn sheared(j: SurfaceJet, k: f64, s: f64) -> SurfaceJet {
    // S(u, v) with u = x + k y, v = s y.
    SurfaceJet {
        dv: j.du * k + j.dv * s,
        duv: j.duu * k + j.duv * s,
        dvv: j.duu * (k * k) + j.duv * (2.0 * k * s) + j.dvv * (s * s),
        ..j
    }
}

#[test]
fn sphere_seen_from_outside_has_negative_curvature() {
    for r in [1e-6, 1.0, 1e6] {
        for (u, v) in [(0.3, 0.4), (2.0, -1.1), (5.0, 1.5)] {
            let c = sphere(r, u, v).curvatures().unwrap();
            // The frame magnifies rounding by 1/cos²v at most, 200 here.
            for k in c.principal {
                assert!((k * r + 1.0).abs() < 1000.0 * UNIT_ROUNDOFF, "{k} {r}");
            }
            assert!((c.gaussian * r * r - 1.0).abs() < 2000.0 * UNIT_ROUNDOFF);
        }
    }
}

proptest! {
    /// Principal curvatures −1/r (around the tube) and −cos v/(R + r cos v), whatever the parameters.
    #[test]
    fn torus_curvatures(u in 0.0..6.3, v in 0.0..6.3, k in -2.0..2.0, s in 0.2..5.0) {
        let (big, small) = (3.0, 1.25);
        let plain = torus(big, small, u, v);
        let c = sheared(plain, k, s).curvatures().unwrap();
        let (tube, ring) = (-1.0 / small, -v.cos() / (big + small * v.cos()));
        let tolerance = 1e4 * UNIT_ROUNDOFF;
        prop_assert!((c.principal[0] - tube).abs() < tolerance, "{:?} {tube}", c.principal);
        prop_assert!((c.principal[1] - ring).abs() < tolerance, "{:?} {ring}", c.principal);
        prop_assert!((c.gaussian - tube * ring).abs() < tolerance);
        prop_assert!((c.mean - 0.5 * (tube + ring)).abs() < tolerance);
        // Directions, up to sign: around the tube, and around the axis.
        prop_assert!(c.directions[0].cross(plain.dv.normalize()).length() < 1e-10);
        prop_assert!(c.directions[1].cross(plain.du.normalize()).length() < 1e-10);
        let normal = plain.normal().unwrap();
        prop_assert!((c.directions[0].cross(c.directions[1]) - normal).length() < 1e-10);
    }

    /// Normal and curvatures move along with a rigid motion and scale as lengths do.
    #[test]
    fn motions(u in 0.0..6.3, v in 0.0..6.3, angle in -3.0..3.0, scale in 0.001..1000.0) {
        let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -2.0) / 3.0, angle);
        let map = DAffine3::from_scale_rotation_translation(DVec3::splat(scale), turn, DVec3::new(5.0, -7.0, 1.0));
        let j = torus(2.0, 0.5, u, v);
        let [du, dv, duu, duv, dvv] = [j.du, j.dv, j.duu, j.duv, j.dvv].map(|d| map.transform_vector3(d));
        let moved = SurfaceJet { point: map.transform_point3(j.point), du, dv, duu, duv, dvv };
        let (a, b) = (j.curvatures().unwrap(), moved.curvatures().unwrap());
        prop_assert!(angle_degrees(turn * j.normal().unwrap(), moved.normal().unwrap()) < 1e-12);
        for i in 0..2 {
            prop_assert!((a.principal[i] - b.principal[i] * scale).abs() < 1e-12);
        }
        let plane = moved.tangent_plane().unwrap();
        prop_assert!(plane.distance(moved.point).abs() <= 16.0 * UNIT_ROUNDOFF * moved.point.length());
    }
}

#[test]
fn forms() {
    let j = sheared(torus(3.0, 1.0, 0.4, 0.9), 0.7, 1.3);
    let (one, two) = (j.first_form(), j.second_form().unwrap());
    assert_eq!(one.e, j.du.dot(j.du));
    let det = one.e * one.g - one.f * one.f;
    let gaussian = (two.l * two.n - two.m * two.m) / det;
    let mean = (one.e * two.n - 2.0 * one.f * two.m + one.g * two.l) / (2.0 * det);
    let c = j.curvatures().unwrap();
    assert!((c.gaussian - gaussian).abs() < 1e-13 && (c.mean - mean).abs() < 1e-13);
}

#[test]
fn normal_of_collapsed_edges_is_the_limit() {
    // A cone with its tip at v = 0, S = v·(cos u, sin u, 2): ∂u vanishes at the tip, and the limit is that of
    // v → 0⁺.
    let cone = |u: f64, v: f64| {
        let (s, c) = u.sin_cos();
        SurfaceJet {
            point: DVec3::new(c, s, 2.0) * v,
            du: DVec3::new(-s, c, 0.0) * v,
            dv: DVec3::new(c, s, 2.0),
            duu: DVec3::new(-c, -s, 0.0) * v,
            duv: DVec3::new(-s, c, 0.0),
            dvv: DVec3::ZERO,
        }
    };
    for u in [0.0, 0.4, 3.0] {
        let tip = cone(u, 0.0);
        assert_eq!((tip.normal(), tip.curvatures(), tip.tangent_plane()), (None, None, None));
        for v in [1e-3, -1e-3] {
            let near = cone(u, v).normal().unwrap();
            let limit = tip.normal_toward(DVec2::new(0.3, v)).unwrap();
            assert!(angle_degrees(near, limit) < 1e-12, "{u} {v}");
        }
        // All but collapsed by rounding.
        let noisy = SurfaceJet { du: DVec3::new(1e-17, -3e-17, 2e-17), ..tip };
        assert!(
            angle_degrees(noisy.normal_toward(DVec2::Y).unwrap(), cone(u, 1.0).normal().unwrap()) < 1e-11
        );
    }
    // Parallel first derivatives, S = (u + v, uv, 0) near the origin: ∂u × ∂v = u − v.
    let fold = SurfaceJet { du: DVec3::X, dv: DVec3::X, duv: DVec3::Y, ..SurfaceJet::default() };
    assert_eq!(fold.normal_toward(DVec2::X), Some(DVec3::Z));
    assert_eq!(fold.normal_toward(DVec2::Y), Some(DVec3::NEG_Z));
    assert_eq!(fold.normal_toward(DVec2::ONE), None);
    // Both vanish, S = (u², v², 0): ∂u × ∂v = 4uv.
    let corner = SurfaceJet { duu: 2.0 * DVec3::X, dvv: 2.0 * DVec3::Y, ..SurfaceJet::default() };
    assert_eq!(corner.normal_toward(DVec2::new(1.0, -1.0)), Some(DVec3::NEG_Z));
    assert_eq!(corner.normal_toward(DVec2::X), None);
    assert_eq!(SurfaceJet::default().normal_toward(DVec2::ONE), None);
    assert_eq!(fold.normal_toward(DVec2::ZERO), None);
}

#[test]
fn quotient_rule_gives_the_sphere() {
    // Stereographic: N = (2u, 2v, u²+v²−1), w = 1+u²+v²; the sphere of radius 1.
    let at = |u: f64, v: f64| {
        let n = SurfaceJet {
            point: DVec3::new(2.0 * u, 2.0 * v, u * u + v * v - 1.0),
            du: DVec3::new(2.0, 0.0, 2.0 * u),
            dv: DVec3::new(0.0, 2.0, 2.0 * v),
            duu: DVec3::new(0.0, 0.0, 2.0),
            duv: DVec3::ZERO,
            dvv: DVec3::new(0.0, 0.0, 2.0),
        };
        let w =
            ScalarJet { value: 1.0 + u * u + v * v, du: 2.0 * u, dv: 2.0 * v, duu: 2.0, duv: 0.0, dvv: 2.0 };
        quotient_jet(&n, &w, 0.0).unwrap()
    };
    for (u, v) in [(0.0, 0.0), (0.7, -0.2), (-3.0, 2.0)] {
        let jet = at(u, v);
        assert!((jet.point.length() - 1.0).abs() < 8.0 * UNIT_ROUNDOFF);
        let c = jet.curvatures().unwrap();
        assert!((c.gaussian - 1.0).abs() < 1e-13 && (c.mean.abs() - 1.0).abs() < 1e-13);
        // Truncation h⁸/630 times a tenth derivative of about 2·10!, 1.2e-12; rounding is a tenth of that.
        casteljau_geom::laws::surface_derivative_law(at, [u, v], 1e-2, 5e-12).unwrap();
    }
}

#[test]
fn quotient_rule_of_curves() {
    // (1, t, t²)/(1 + t + t³) against differences, order by order.
    let at = |t: f64| {
        let n = CurveJet {
            point: DVec3::new(1.0, t, t * t),
            d1: DVec3::new(0.0, 1.0, 2.0 * t),
            d2: DVec3::new(0.0, 0.0, 2.0),
            d3: DVec3::ZERO,
        };
        let w = [1.0 + t + t * t * t, 1.0 + 3.0 * t * t, 6.0 * t, 6.0];
        quotient_curve_jet(&n, w, 0.0).unwrap()
    };
    use casteljau_geom::laws::derivative_law;
    for t in [0.1, 0.5, 2.0] {
        derivative_law(|t| at(t).point, |t| at(t).d1, t, 1e-2, 1e-11).unwrap();
        derivative_law(|t| at(t).d1, |t| at(t).d2, t, 1e-2, 1e-10).unwrap();
        derivative_law(|t| at(t).d2, |t| at(t).d3, t, 1e-2, 1e-9).unwrap();
    }
}

#[test]
fn poles_are_errors() {
    let n = SurfaceJet { point: DVec3::X, ..SurfaceJet::default() };
    for (value, uncertainty) in [(0.0, 0.0), (-0.0, 0.0), (1e-17, 1e-16), (-1e-17, 1e-16), (f64::NAN, 0.0)] {
        let w = ScalarJet { value, du: 1.0, ..ScalarJet::default() };
        let refused = quotient_jet(&n, &w, uncertainty);
        assert!(matches!(refused, Err(GeomError::Pole { .. })), "{value} {uncertainty}: {refused:?}");
    }
    let w = ScalarJet { value: 1e-200, du: 1.0, ..ScalarJet::default() };
    assert_eq!(quotient_jet(&n, &w, 0.0), Err(GeomError::Overflow { denominator: 1e-200 }));
}

/// Derivatives of `xyz/w` made of monomials, each of which the quotient rule must give back: with N = S·w the
/// Leibniz rule forwards, with the same integers throughout, so that everything is exact.
fn quotient_undoes_the_product<const N: usize>(order: usize) {
    use casteljau_geom::{multi_indices, partial_count, partial_index};
    let count = partial_count::<N>(order);
    let surface: Vec<DVec3> =
        (0..count).map(|k| DVec3::new((k * k % 7) as f64, k as f64 - 3.0, (5 * k % 11) as f64)).collect();
    let weight: Vec<f64> = (0..count).map(|k| (k * 3 % 5) as f64 + 2.0).collect();
    let factorial = |k: usize| (1..=k).product::<usize>() as f64;
    let mut net = vec![DVec4::ZERO; count];
    for alpha in multi_indices::<N>(order) {
        for beta in multi_indices::<N>(order) {
            if (0..N).any(|i| beta[i] > alpha[i]) {
                continue;
            }
            let rest: [usize; N] = std::array::from_fn(|i| alpha[i] - beta[i]);
            let choose: f64 =
                (0..N).map(|i| factorial(alpha[i]) / factorial(beta[i]) / factorial(rest[i])).product();
            let w = weight[partial_index(beta)];
            net[partial_index(alpha)] += (surface[partial_index(rest)] * w).extend(0.0) * choose;
        }
        net[partial_index(alpha)].w = weight[partial_index(alpha)];
    }
    let mut out = vec![DVec3::NAN; count];
    quotient_partials::<N>(&net, 0.0, &mut out).unwrap();
    assert_eq!(out, surface);
    // A buffer that is no whole jet gets the jet that fits and zeros.
    let mut short = vec![DVec3::NAN; count - 1];
    quotient_partials::<N>(&net, 0.0, &mut short).unwrap();
    let fits = partial_count::<N>(order - 1);
    assert_eq!(short[..fits], surface[..fits]);
    assert!(short[fits..].iter().all(|&p| p == DVec3::ZERO));
}

#[test]
fn quotient_of_any_order() {
    quotient_undoes_the_product::<1>(9);
    quotient_undoes_the_product::<2>(5);
    quotient_undoes_the_product::<3>(4);
    let refused = quotient_partials::<2>(&[DVec4::X], 0.0, &mut [DVec3::ZERO]);
    assert!(matches!(refused, Err(GeomError::Pole { .. })));
    let refused = quotient_partials::<2>(&[DVec4::new(1.0, 0.0, 0.0, 1e-310)], 0.0, &mut [DVec3::ZERO]);
    assert!(matches!(refused, Err(GeomError::Overflow { .. })));
    assert_eq!(quotient_partials::<3>(&[], 0.0, &mut []), Ok(()));
}

#[test]
fn frames_of_a_helix() {
    // (r cos t, r sin t, ht) at any scale: κ = r/(r²+h²), τ = h/(r²+h²), the normal points to the axis.
    for scale in [1e-140, 1e-6, 1.0, 1e6, 1e140] {
        for (r, h) in [(3.0, 4.0), (3.0, -4.0), (1.0, 1e-3)] {
            for t in [0.0, 0.7, 4.0_f64] {
                let (s, c) = t.sin_cos();
                let at = |x: f64, y: f64, z: f64| DVec3::new(r * x, r * y, h * z) * scale;
                let jet = CurveJet::from([at(c, s, t), at(-s, c, 1.0), at(-c, -s, 0.0), at(s, -c, 0.0)]);
                let frame = jet.frenet_frame().unwrap();
                let square = r * r + h * h;
                assert!(frame.normal.distance(DVec3::new(-c, -s, 0.0)) < 8.0 * UNIT_ROUNDOFF);
                assert!(frame.tangent.cross(frame.normal).distance(frame.binormal) < 8.0 * UNIT_ROUNDOFF);
                assert!((frame.curvature * scale * square / r - 1.0).abs() < 16.0 * UNIT_ROUNDOFF);
                assert!((frame.torsion * scale * square / h - 1.0).abs() < 1e-12, "{scale} {h} {t}");
            }
        }
    }
    let straight = CurveJet { d1: DVec3::ONE, d2: DVec3::splat(-2.0), ..CurveJet::default() };
    assert_eq!(straight.frenet_frame(), None);
}
