//! Shapes carried into space by solids, against the solid's own points.
#![allow(clippy::unwrap_used)] // helpers of tests

#[path = "../../shape/tests/support/mod.rs"]
mod support;

use casteljau_geom::glam::DVec3;
use casteljau_geom::{Interval, rounding_bound};
use casteljau_shape::{
    Curve, ParametricCurve, ParametricSurface, Patch, RationalCurve, RationalPatch, RationalTriangle,
    Triangle,
};
use casteljau_solid::{
    Deformation, Hexahedron, LARGEST_COMPOSED_DEGREE, ParametricSolid, RationalHexahedron,
    RationalTetrahedron, RationalWedge, SolidError, Tetrahedron, Wedge,
};
use proptest::prelude::*;

fn points(count: usize) -> impl Strategy<Value = Vec<DVec3>> {
    prop::collection::vec([-1.0..1.0_f64, -1.0..1.0, -1.0..1.0].prop_map(DVec3::from_array), count)
}

/// Points inside the unit tetrahedron, which all three domains contain.
fn inner_points(count: usize) -> impl Strategy<Value = Vec<DVec3>> {
    prop::collection::vec([0.0..0.33_f64, 0.0..0.33, 0.0..0.33].prop_map(DVec3::from_array), count)
}

fn weights(count: usize) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(0.5..2.0_f64, count)
}

/// The composition is exact up to 4(D(c+2)+2) roundings of its terms, at most 1 in size but for weights of up to 2 that
/// are divided by at least ½, once for the solid and D times for the shape; the other side is as far off.
fn allowed(total: usize, count: usize) -> f64 {
    let ratio = 4_f64.powi(total as i32 + 1);
    2.0 * rounding_bound(total * (count + 2), 0, ratio)
}

#[track_caller]
fn same(got: Result<DVec3, impl std::fmt::Debug>, exact: Result<DVec3, impl std::fmt::Debug>, allowed: f64) {
    let (got, exact) = (got.unwrap(), exact.unwrap());
    assert!(got.distance(exact) <= allowed, "{got} {exact} {allowed:e}");
}

/// All kinds of shapes through one solid.
fn carries(solid: &impl Deformation, inner: &[DVec3], w: &[f64], at: [f64; 3]) {
    let d = solid.total_degree();
    let [s, t, r] = at;
    let (ts, tt, tr) = (s / 3.0, t / 3.0, r / 3.0);
    let through = |p: DVec3| solid.try_point(p.to_array());

    let interval = Interval::new(-1.0, 3.0).unwrap();
    let curve = Curve::new(&inner[..3]).unwrap().with_interval(interval);
    let parameter = interval.at(s);
    let bent = solid.deform_curve(&curve).unwrap();
    assert_eq!((bent.degree(), bent.interval()), (2 * d, interval));
    same(bent.try_point(parameter), through(curve.point(parameter)), allowed(d, 3));
    let curve = RationalCurve::new(&inner[..3], &w[..3]).unwrap();
    let bent = solid.deform_rational_curve(&curve).unwrap();
    same(bent.try_point(s), through(curve.point(s).unwrap()), allowed(d, 3));

    let patch = Patch::new([1, 2], &inner[..6]).unwrap();
    let bent = solid.deform_patch(&patch).unwrap();
    assert_eq!(bent.degrees(), [d, 2 * d]);
    same(bent.try_point(s, t), through(patch.point(s, t)), allowed(d, 6));
    let patch = RationalPatch::new([1, 2], &inner[..6], &w[..6]).unwrap();
    let bent = solid.deform_rational_patch(&patch).unwrap();
    same(bent.try_point(s, t), through(patch.point(s, t).unwrap()), allowed(d, 6));

    let triangle = Triangle::new(2, &inner[..6]).unwrap();
    let bent = solid.deform_triangle(&triangle).unwrap();
    same(bent.try_point(ts, tt), through(triangle.point(ts, tt)), allowed(d, 6));
    let triangle = RationalTriangle::new(2, &inner[..6], &w[..6]).unwrap();
    let bent = solid.deform_rational_triangle(&triangle).unwrap();
    same(bent.try_point(ts, tt), through(triangle.point(ts, tt).unwrap()), allowed(d, 6));

    let hexahedron = Hexahedron::new([1; 3], &inner[..8]).unwrap();
    let bent = solid.deform_hexahedron(&hexahedron).unwrap();
    assert_eq!(bent.degrees(), [d; 3]);
    same(bent.try_point(at), through(hexahedron.point(at)), allowed(d, 8));
    let hexahedron = RationalHexahedron::new([1; 3], &inner[..8], &w[..8]).unwrap();
    let bent = solid.deform_rational_hexahedron(&hexahedron).unwrap();
    same(bent.try_point(at), through(hexahedron.point(at).unwrap()), allowed(d, 8));

    let local = [ts, tt, tr];
    let tetrahedron = Tetrahedron::new(1, &inner[..4]).unwrap();
    let bent = solid.deform_tetrahedron(&tetrahedron).unwrap();
    assert_eq!(bent.degree(), d);
    same(bent.try_point(local), through(tetrahedron.point(local)), allowed(d, 4));
    let tetrahedron = RationalTetrahedron::new(1, &inner[..4], &w[..4]).unwrap();
    let bent = solid.deform_rational_tetrahedron(&tetrahedron).unwrap();
    same(bent.try_point(local), through(tetrahedron.point(local).unwrap()), allowed(d, 4));

    let wedge = Wedge::new([1, 1], &inner[..6]).unwrap();
    let bent = solid.deform_wedge(&wedge).unwrap();
    assert_eq!(bent.degrees(), [d, d]);
    same(bent.try_point([ts, tt, r]), through(wedge.point([ts, tt, r])), allowed(d, 6));
    let wedge = RationalWedge::new([1, 1], &inner[..6], &w[..6]).unwrap();
    let bent = solid.deform_rational_wedge(&wedge).unwrap();
    same(bent.try_point([ts, tt, r]), through(wedge.point([ts, tt, r]).unwrap()), allowed(d, 6));

    let mut cloud = inner[..4].to_vec();
    solid.deform_points(&mut cloud).unwrap();
    for (p, q) in cloud.iter().zip(inner) {
        assert_eq!(*p, solid.try_point(q.to_array()).unwrap());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn hexahedra(net in points(12), w in weights(12), inner in inner_points(8), iw in weights(8), at in [0.0..1.0_f64, 0.0..1.0, 0.0..1.0]) {
        carries(&Hexahedron::new([1, 2, 1], &net[..]).unwrap(), &inner, &iw, at);
        let rational = RationalHexahedron::new([1, 2, 1], &net, &w).unwrap();
        carries(&rational, &inner, &iw, at);
        let interval = Interval::new(-1.0, 1.5).unwrap();
        let shifted = rational.with_intervals([interval, Interval::UNIT, interval]);
        carries(&shifted, &inner, &iw, at);
    }

    #[test]
    fn tetrahedra(net in points(10), w in weights(10), inner in inner_points(8), iw in weights(8), at in [0.0..1.0_f64, 0.0..1.0, 0.0..1.0]) {
        carries(&Tetrahedron::new(2, &net[..]).unwrap(), &inner, &iw, at);
        carries(&RationalTetrahedron::new(2, &net, &w).unwrap(), &inner, &iw, at);
    }

    #[test]
    fn wedges(net in points(12), w in weights(12), inner in inner_points(8), iw in weights(8), at in [0.0..1.0_f64, 0.0..1.0, 0.0..1.0]) {
        carries(&Wedge::new([2, 1], &net[..]).unwrap(), &inner, &iw, at);
        let rational = RationalWedge::new([2, 1], &net, &w).unwrap();
        carries(&rational, &inner, &iw, at);
        carries(&rational.with_height(Interval::new(-2.0, 2.0).unwrap()), &inner, &iw, at);
    }
}

/// The identity changes nothing but the degree; degrees go to 200, not beyond.
#[test]
fn degrees_to_the_limit() {
    let identity = Hexahedron::unit_cube(); // D = 3
    let high: Vec<DVec3> =
        (0..=66).map(|k| DVec3::new(f64::from(k) / 66.0, (f64::from(k)).sin().abs(), 0.5)).collect();
    let curve = Curve::new(high).unwrap();
    let carried = identity.deform_curve(&curve).unwrap();
    assert_eq!(carried.degree(), 198);
    for k in 0..=20 {
        let t = f64::from(k) / 20.0;
        assert!(carried.point(t).distance(curve.point(t)) <= rounding_bound(3 * 69, 0, 2.0), "{t}");
    }
    let higher = Curve::new(vec![DVec3::ZERO; 68]).unwrap();
    assert!(matches!(identity.deform_curve(&higher), Err(SolidError::Kernel(_))));
    assert_eq!(LARGEST_COMPOSED_DEGREE, 200);
}
