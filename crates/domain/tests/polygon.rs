//! Validation, measures and location of polygons, against exact and brute-force answers.
#![allow(clippy::unwrap_used, clippy::panic)]

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use casteljau_domain::glam::{DVec2, dvec2};
use casteljau_domain::{DomainError, Location, Orientation, Polygon};
use proptest::prelude::*;

fn polygon(points: &[(f64, f64)]) -> Result<Polygon, DomainError> {
    Polygon::new(points.iter().map(|p| dvec2(p.0, p.1)).collect())
}

/// An L, counter-clockwise, one concave corner (3) and one straight one (1).
const ELL: [(f64, f64); 7] = [(0., 0.), (1., 0.), (3., 0.), (3., 1.), (1., 1.), (1., 2.), (0., 2.)];

#[test]
fn measures_of_an_ell() {
    let p = polygon(&ELL).unwrap();
    assert_eq!(p.orientation(), Orientation::CounterClockwise);
    assert_eq!((p.len(), p.signed_area(), p.perimeter(), p.clearance()), (7, 4.0, 10.0, 1.0));
    assert_eq!(p.diameter(), 13f64.sqrt());
    assert_eq!(p.bounding_box(), [dvec2(0., 0.), dvec2(3., 2.)]);
    assert_eq!(p.side(0), [dvec2(0., 2.), dvec2(0., 0.)]);
    assert_eq!(p.side(8), p.side(1));
    let angles: Vec<f64> = (0..7).map(|i| p.interior_angle(i)).collect();
    assert_eq!(angles, [FRAC_PI_2, PI, FRAC_PI_2, FRAC_PI_2, 3.0 * FRAC_PI_2, FRAC_PI_2, FRAC_PI_2]);
    assert!(!p.is_convex() && (0..7).all(|i| p.is_concave(i) == (i == 4)));
}

#[test]
fn clockwise_polygons_are_kept_and_measured_alike() {
    let reversed: Vec<(f64, f64)> = ELL.iter().rev().copied().collect();
    let p = polygon(&reversed).unwrap();
    assert_eq!(p.orientation(), Orientation::Clockwise);
    assert_eq!((p.signed_area(), p.vertices()[0]), (-4.0, dvec2(0., 2.)));
    assert!((p.interior_angle(2) - 3.0 * FRAC_PI_2).abs() < 1e-15 && p.is_concave(2) && !p.is_concave(3));
    assert_eq!(p.locate(dvec2(0.5, 0.5)), Location::Inside(dvec2(0.5, 0.5)));
    assert_eq!(p.locate(dvec2(2.0, 1.5)), Location::Outside);
}

#[test]
fn what_is_no_polygon_is_refused_with_the_place() {
    let touching = polygon(&[(0., 0.), (4., 0.), (4., 2.), (2., 0.), (0., 2.)]).unwrap_err();
    assert_eq!(touching, DomainError::SidesMeet { first: 1, second: 3, position: [2.0, 0.0] });
    let corner_twice =
        polygon(&[(0., 0.), (1., -1.), (2., 0.), (1., 1.), (0., 0.), (-1., 1.), (-1., -1.)]).unwrap_err();
    assert!(matches!(corner_twice, DomainError::SidesMeet { position: [0.0, 0.0], .. }), "{corner_twice:?}");
    let overlapping =
        polygon(&[(0., 0.), (4., 0.), (4., 1.), (3., 1.), (3., 0.), (1., 0.), (1., 1.), (0., 1.)])
            .unwrap_err();
    assert!(matches!(overlapping, DomainError::SidesMeet { first: 1, .. }), "{overlapping:?}");
    let spike = polygon(&[(0., 0.), (2., 0.), (4., 0.), (2., 0.), (2., 2.)]).unwrap_err();
    assert_eq!(spike, DomainError::FoldBack { side: 2, corner: 2, position: [4.0, 0.0] });
    let flat = polygon(&[(0., 0.), (1., 1.), (3., 3.)]).unwrap_err();
    assert!(matches!(flat, DomainError::FoldBack { .. }));
    let double = polygon(&[(0., 0.), (1., 0.), (1., 0.), (0., 1.)]).unwrap_err();
    assert_eq!(double, DomainError::ZeroSide { side: 2, position: [1.0, 0.0, 0.0] });
    assert_eq!(polygon(&ELL[..2]).unwrap_err(), DomainError::TooFewSides { count: 2 });
    let nan = polygon(&[(0., 0.), (1., f64::NAN), (0., 1.)]).unwrap_err();
    assert!(matches!(nan, DomainError::NotFinite { corner: 1, .. }));
    assert!(matches!(polygon(&[(0., 0.), (1e80, 0.), (0., 1e80)]), Err(DomainError::OutOfRange { .. })));
    assert!(matches!(polygon(&[(0., 0.), (1e-80, 0.), (0., 1e-80)]), Err(DomainError::OutOfRange { .. })));
}

/// A gap of one ulp is a gap, and no gap is none: the predicates are exact.
#[test]
fn touching_is_decided_to_the_last_bit() {
    let notch = |y: f64| polygon(&[(0., 0.), (3., 1.), (3., 4.), (1.5, y), (0., 4.)]);
    assert!(matches!(notch(0.5), Err(DomainError::SidesMeet { .. })));
    assert!(matches!(notch(0.5f64.next_down()), Err(DomainError::SidesMeet { .. })));
    let p = notch(0.5f64.next_up()).unwrap();
    assert!(p.clearance() > 0.9e-16 && p.clearance() < 1.2e-16);
}

#[test]
fn boundary_points_are_located_on_the_boundary() {
    for (scale, offset) in
        [(1.0, 0.0), (1e-6, 0.0), (1e6, 0.0), (1e60, 0.0), (1e-60, 0.0), (1.0, 1e3), (1e-3, 7.0)]
    {
        let points: Vec<(f64, f64)> =
            ELL.iter().map(|p| (p.0 * scale * 0.7 + offset, p.1 * scale * 1.3 - offset)).collect();
        let p = polygon(&points).unwrap();
        for side in 0..p.len() {
            assert_eq!(p.locate(p.vertices()[side]), Location::Corner(side));
            for step in 1..100 {
                let t = f64::from(step) / 100.0;
                let on = p.at(Location::Side { side, t }).unwrap();
                let Location::Side { side: found, t: place } = p.locate(on) else {
                    panic!("{on} of side {side}: {:?}", p.locate(on))
                };
                let slack = 1e-14 * (offset.abs() + scale) / p.side_length(side);
                assert!(found == side && (place - t).abs() <= slack, "{found} {place} for {side} {t}");
            }
        }
    }
    let p = polygon(&ELL).unwrap();
    for far in [f64::NAN, f64::INFINITY, f64::MAX, -1e300] {
        assert_eq!(p.locate(dvec2(far, 0.5)), Location::Outside);
        assert_eq!(p.locate(dvec2(0.5, far)), Location::Outside);
    }
    assert_eq!(p.at(Location::Outside), None);
    assert_eq!(p.at(Location::Side { side: 3, t: 1.0 }), Some(dvec2(3., 1.)));
}

/// Ten thousand sides, as a comb (all sides overlap in x with many others) and as a star.
#[test]
fn ten_thousand_sides_take_no_minutes() {
    let n = 10_000;
    let star: Vec<DVec2> =
        (0..n).map(|i| DVec2::from_angle(TAU * i as f64 / n as f64) * (1.0 + 0.5 * (i % 2) as f64)).collect();
    let mut comb: Vec<DVec2> =
        (0..n - 2).map(|i| dvec2(if i % 2 == 0 { 0.0 } else { 1.0 }, i as f64 / n as f64)).collect();
    comb.extend([dvec2(-1.0, 1.0), dvec2(-1.0, 0.0)]);
    for vertices in [star, comb] {
        let start = std::time::Instant::now();
        let p = Polygon::new(vertices).unwrap();
        let (checked, clearance) = (start.elapsed(), p.clearance());
        println!("checked in {checked:?}, clearance in {:?}", start.elapsed() - checked);
        assert!(clearance > 0.0 && clearance < 2e-3 && start.elapsed().as_secs() < 30);
    }
}

/// Coordinates on a coarse grid touch and overlap often, and everything about them is exact in integers.
fn grid_points() -> impl Strategy<Value = Vec<(i64, i64)>> {
    prop::collection::vec((0i64..7, 0i64..7), 3..9)
}

/// Whether the outline is simple, in integers: neighbours meet in their common end only, others nowhere.
fn simple(p: &[(i64, i64)]) -> bool {
    let n = p.len();
    let cross =
        |a: (i64, i64), b: (i64, i64), c: (i64, i64)| (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0);
    let on = |q: (i64, i64), a: (i64, i64), b: (i64, i64)| {
        cross(a, b, q) == 0 && (q.0 - a.0) * (q.0 - b.0) <= 0 && (q.1 - a.1) * (q.1 - b.1) <= 0
    };
    (0..n).all(|i| p[i] != p[(i + 1) % n])
        && (0..n).all(|i| {
            let (a, b) = (p[i], p[(i + 1) % n]);
            let neighbour = p[(i + 2) % n];
            let clear = (2..n - 1).all(|step| {
                let (c, d) = (p[(i + step) % n], p[(i + step + 1) % n]);
                let proper = cross(a, b, c).signum() * cross(a, b, d).signum() < 0
                    && cross(c, d, a).signum() * cross(c, d, b).signum() < 0;
                !(proper || on(a, c, d) || on(b, c, d) || on(c, a, b) || on(d, a, b))
            });
            clear && !on(neighbour, a, b) && !on(a, b, neighbour)
        })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 30_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn simplicity_and_area_agree_with_integers(points in grid_points(), scale in -70..70i32, shift in 0..1000i64) {
        let factor = 2f64.powi(scale);
        let vertices: Vec<(f64, f64)> = points.iter().map(|p| ((p.0 + shift) as f64 * factor, p.1 as f64 * factor)).collect();
        let built = polygon(&vertices);
        prop_assert_eq!(built.is_ok(), simple(&points), "{:?}", built);
        if let Ok(p) = built {
            let n = points.len();
            let twice: i64 = (0..n).map(|i| points[i].0 * points[(i + 1) % n].1 - points[i].1 * points[(i + 1) % n].0).sum();
            prop_assert_eq!(p.signed_area(), 0.5 * twice as f64 * factor * factor);
            let angles: f64 = (0..n).map(|i| p.interior_angle(i)).sum();
            prop_assert!((angles - (n as f64 - 2.0) * PI).abs() < 1e-13);
        }
    }

    #[test]
    fn locations_agree_with_the_winding_number(points in grid_points(), x in -1.0..7.0f64, y in -1.0..7.0f64, snap in any::<bool>()) {
        if !simple(&points) {
            return Ok(());
        }
        let q = if snap { dvec2(x.round(), y.round()) } else { dvec2(x, y) };
        let p = polygon(&points.iter().map(|p| (p.0 as f64, p.1 as f64)).collect::<Vec<_>>()).unwrap();
        let v = p.vertices();
        let n = v.len();
        let gap = (0..n).map(|i| {
            let (a, b) = (v[i], v[(i + 1) % n]);
            let s = ((q - a).dot(b - a) / (b - a).dot(b - a)).clamp(0.0, 1.0);
            (a + (b - a) * s - q).length()
        }).fold(f64::INFINITY, f64::min);
        let turns: f64 = (0..n).map(|i| { let (a, b) = (v[i] - q, v[(i + 1) % n] - q); a.perp_dot(b).atan2(a.dot(b)) }).sum();
        match p.locate(q) {
            Location::Inside(at) => prop_assert!(at == q && gap > 0.0 && turns.abs() > 6.0),
            Location::Outside => prop_assert!(gap > 0.0 && turns.abs() < 0.1),
            on => {
                prop_assert!(gap < 1e-14);
                prop_assert!(p.at(on).unwrap().distance(q) < 1e-14);
                prop_assert_eq!(matches!(on, Location::Corner(_)), v.contains(&q));
            }
        }
    }
}
