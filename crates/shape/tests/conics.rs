//! Circles, conics and quadrics lie where they should, at every scale.
#![allow(clippy::unwrap_used)] // helpers of tests

use std::f64::consts::{FRAC_PI_2, PI};

use casteljau_geom::glam::DVec3;
use casteljau_geom::{UNIT_ROUNDOFF, angle_degrees};
use casteljau_shape::{
    ParametricCurve, ParametricSurface, RationalCurve, RationalPatch, RationalTriangle, ShapeError,
};
use proptest::prelude::*;

const SCALES: [f64; 5] = [1e-6, 1e-3, 1.0, 1e3, 1e6];

proptest! {
    #[test]
    fn arcs_are_circles(sweep in prop_oneof![-20.0..20.0_f64, Just(PI), Just(-FRAC_PI_2), Just(1e-2)], scale in 0..5usize, t in 0.0..=1.0_f64) {
        prop_assume!(sweep != 0.0);
        let r = SCALES[scale];
        let center = DVec3::new(1.0, -2.0, 0.5) * r;
        let (x, y) = (DVec3::new(0.6, 0.8, 0.0) * r, DVec3::Z * r);
        let arcs = RationalCurve::arc(center, x, y, sweep).unwrap();
        prop_assert!(arcs.len() as f64 >= sweep.abs() / (FRAC_PI_2 * 1.001));
        for pair in arcs.windows(2) {
            prop_assert_eq!(pair[0].end(), pair[1].start());
        }
        let place = (t * arcs.len() as f64).min(arcs.len() as f64 - 1.0).floor() as usize;
        let (arc, interval) = (&arcs[place], arcs[place].interval());
        let s = t.clamp(interval.start(), interval.end());
        let point = arc.point(s).unwrap() - center;
        prop_assert!((point.length() - r).abs() <= 40.0 * UNIT_ROUNDOFF * r, "{}", point.length() / r - 1.0);
        let frame = arc.try_frenet_frame(s).unwrap();
        prop_assert!((frame.curvature * r - 1.0).abs() <= 1e-12 / sweep.abs().min(1.0).powi(2), "{}", frame.curvature * r);
        prop_assert!(angle_degrees(frame.binormal, x.cross(y) * sweep.signum()) < 1e-9 / sweep.abs().min(1.0).powi(2));
        let end = center + x * sweep.cos() + y * sweep.sin();
        prop_assert!(arcs[arcs.len() - 1].end().unwrap().distance(end) <= 64.0 * UNIT_ROUNDOFF * r);
    }

    #[test]
    fn conics_pass_through_their_point(w in 1e-3..1e3_f64, t in 0.05..0.95_f64) {
        let (a, b, c) = (DVec3::new(1.0, 2.0, 0.5), DVec3::new(2.0, 3.0, -1.0), DVec3::new(4.0, 0.0, 1.0));
        let conic = RationalCurve::conic(a, b, c, w).unwrap();
        let through = RationalCurve::conic_through(a, b, c, conic.point(t).unwrap()).unwrap();
        let got = through.weights().nth(1).unwrap();
        // Rounding of the point counts (1 + w)/τ₀τ₂ᵗ-fold.
        prop_assert!((got / w - 1.0).abs() < 1e-13 * (1.0 + w) * (1.0 + 1.0 / w) / (t * (1.0 - t)), "{} {}", got, w);
        let shoulder = ((a + c) * 0.5 + b * w) / (1.0 + w);
        prop_assert!(conic.point(0.5).unwrap().distance(shoulder) < 1e-14);
    }

    #[test]
    fn three_points_make_an_arc(alpha in 0.1..6.0_f64, beta in 0.05..0.95, r in 1e-3..1e3_f64) {
        let at = |angle: f64| DVec3::new(r * angle.cos() + 1.0, 2.0, r * angle.sin());
        let arcs = RationalCurve::arc_through(at(0.0), at(alpha * beta), at(alpha)).unwrap();
        let tolerance = 1e-11 * (1.0 + r) / (beta * (1.0 - beta)) / alpha.min(1.0).powi(2);
        for arc in &arcs {
            let interval = arc.interval();
            for k in 0..=4 {
                let p = arc.point(interval.at(f64::from(k) / 4.0)).unwrap();
                prop_assert!((p.distance(DVec3::new(1.0, 2.0, 0.0)) - r).abs() < tolerance);
            }
        }
        let length: f64 = arcs.len() as f64;
        prop_assert!(length >= alpha / FRAC_PI_2 - 1e-9 && length <= alpha / FRAC_PI_2 + 1.0 + 1e-9);
        prop_assert!(arcs[0].start().unwrap().distance(at(0.0)) < tolerance);
        prop_assert!(arcs[arcs.len() - 1].end().unwrap().distance(at(alpha)) < tolerance);
    }
}

#[test]
fn circles_close() {
    let circle = RationalCurve::circle(DVec3::ONE, DVec3::X, DVec3::Y).unwrap();
    assert_eq!((circle.len(), circle[0].start()), (4, circle[3].end()));
    let whole = RationalCurve::full_circle(DVec3::ONE, DVec3::X, DVec3::Y).unwrap();
    for k in 0..=32 {
        let p = whole.point(f64::from(k) / 32.0).unwrap();
        assert!((p.distance(DVec3::ONE) - 1.0).abs() < 64.0 * UNIT_ROUNDOFF);
    }
    assert!(matches!(
        RationalCurve::arc(DVec3::ZERO, DVec3::X, DVec3::Y, 0.0),
        Err(ShapeError::Construction { .. })
    ));
    assert!(RationalCurve::arc(DVec3::ZERO, DVec3::X, DVec3::Y, f64::NAN).is_err());
    assert!(RationalCurve::arc(DVec3::ZERO, DVec3::X, DVec3::Y, 1e300).is_err());
    assert!(RationalCurve::arc_through(DVec3::ZERO, DVec3::X, 2.0 * DVec3::X).is_err());
    assert!(RationalCurve::arc_through(DVec3::ZERO, DVec3::ZERO, DVec3::X).is_err());
    assert!(RationalCurve::conic_through(DVec3::X, 2.0 * DVec3::X, DVec3::ZERO, DVec3::Y).is_err());
    assert!(RationalCurve::conic_through(DVec3::X, DVec3::ZERO, DVec3::Y, -DVec3::X).is_err());
}

/// Points of the domain, edges and corners included.
fn grid() -> impl Iterator<Item = [f64; 2]> {
    (0..=8).flat_map(|i| (0..=8).map(move |j| [f64::from(i) / 8.0, f64::from(j) / 8.0]))
}

#[test]
fn spheres() {
    for r in SCALES {
        let center = DVec3::new(0.25, -0.5, 2.0) * r;
        for octant in RationalPatch::sphere(center, r).unwrap() {
            for [u, v] in grid() {
                let p = octant.point(u, v).unwrap() - center;
                assert!((p.length() - r).abs() < 64.0 * UNIT_ROUNDOFF * r);
                // At the pole too, where the edge v = 1 collapses: the limit.
                assert!(angle_degrees(octant.normal(u, v).unwrap(), p) < 1e-12, "{u} {v}");
                let plane = octant.try_tangent_plane(u, v).unwrap();
                assert!((plane.distance(center) + r).abs() < 128.0 * UNIT_ROUNDOFF * r);
                if v < 1.0 {
                    let c = octant.try_curvatures(u, v).unwrap();
                    assert!((c.gaussian * r * r - 1.0).abs() < 1e-11 && (c.mean * r + 1.0).abs() < 1e-11);
                }
            }
            assert!(matches!(octant.try_curvatures(0.5, 1.0), Err(ShapeError::NoTangentPlane { .. })));
        }
        let net = RationalTriangle::sphere_octant(center, DVec3::X * r, DVec3::Y * r, DVec3::Z * r).unwrap();
        assert!(net.point(1.0, 0.0).unwrap().distance(center + DVec3::X * r) < 8.0 * UNIT_ROUNDOFF * r);
        assert!(net.point(0.0, 1.0).unwrap().distance(center + DVec3::Y * r) < 8.0 * UNIT_ROUNDOFF * r);
        for [u, v] in grid().filter(|[u, v]| u + v <= 1.0) {
            let p = net.point(u, v).unwrap() - center;
            assert!((p.length() - r).abs() < 128.0 * UNIT_ROUNDOFF * r, "{u} {v}: {}", p.length() / r - 1.0);
            assert!(angle_degrees(net.normal(u, v).unwrap(), p) < 1e-12, "{u} {v}");
            assert!((net.try_curvatures(u, v).unwrap().gaussian * r * r - 1.0).abs() < 1e-11);
        }
    }
}

#[test]
fn surfaces_of_revolution() {
    let (base, axis) = (DVec3::new(3.0, -1.0, 0.5), DVec3::new(0.0, 3.0, 4.0));
    let up = axis / 5.0;
    let radial = |p: DVec3| (p - base) - up * up.dot(p - base);
    for patch in RationalPatch::cylinder(base, axis, 0.75).unwrap() {
        for [u, v] in grid() {
            let p = patch.point(u, v).unwrap();
            assert!((radial(p).length() - 0.75).abs() < 1e-14);
            assert!(angle_degrees(patch.normal(u, v).unwrap(), radial(p)) < 1e-12);
            let c = patch.try_curvatures(u, v).unwrap();
            assert!(c.gaussian.abs() < 1e-12 && (c.principal[0] + 4.0 / 3.0).abs() < 1e-12);
        }
    }
    for patch in RationalPatch::cone(base, axis, 1.0).unwrap() {
        for [u, v] in grid() {
            let p = patch.point(u, v).unwrap();
            let height = up.dot(p - base);
            assert!((radial(p).length() - (1.0 - height / 5.0)).abs() < 1e-14);
            // Five parts up and one part out is the slope; at the tip the limit along the ruling.
            let out = radial(patch.point(u, 0.0).unwrap());
            assert!(angle_degrees(patch.normal(u, v).unwrap(), out * 5.0 + up) < 1e-6, "{u} {v}");
        }
    }
    let (big, small) = (2.0, 0.5);
    let torus = RationalPatch::torus(base, axis, big, small).unwrap();
    assert_eq!(torus.len(), 16);
    for patch in &torus {
        for [u, v] in grid() {
            let p = patch.point(u, v).unwrap();
            let ring = radial(p).normalize() * big;
            let tube = p - base - ring;
            assert!((tube.length() - small).abs() < 1e-14);
            assert!(angle_degrees(patch.normal(u, v).unwrap(), tube) < 1e-12);
            let cos = tube.dot(ring) / big / small;
            let exact = cos / (small * (big + small * cos));
            assert!((patch.try_curvatures(u, v).unwrap().gaussian - exact).abs() < 1e-12);
        }
    }
    for k in 0..4 {
        let (patch, next) = (&torus[k], &torus[(k + 1) % 4]);
        assert_eq!(patch.control_points()[6..], next.control_points()[..3]);
    }
    for refused in [
        RationalPatch::cylinder(base, DVec3::ZERO, 1.0),
        RationalPatch::cone(base, axis, 0.0),
        RationalPatch::torus(base, axis, f64::NAN, 1.0),
        RationalPatch::sphere(base, f64::INFINITY),
    ] {
        assert!(matches!(refused, Err(ShapeError::Construction { .. })));
    }
}
