//! Parameters of points.
#![allow(clippy::unwrap_used)] // helpers of tests

#[path = "../../shape/tests/support/mod.rs"]
mod support;

use casteljau_geom::Interval;
use casteljau_geom::glam::DVec3;
use casteljau_shape::{Patch, RationalCurve};
use casteljau_solid::{
    BezierHexahedron, Hexahedron, ParametricSolid, RationalHexahedron, RationalTetrahedron, SolidError,
    SolidLocator, Tetrahedron, Wedge,
};
use proptest::prelude::*;
use support::{U, cases, numbers, point, size, weighted_net};

/// Numbers in [0, 1), the same in every run.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn point(&mut self) -> [f64; 3] {
        [self.roll(), self.roll(), self.roll()]
    }
}

/// A million points where CASTELJAU_LONG is set.
fn count() -> usize {
    if std::env::var_os("CASTELJAU_LONG").is_some() { 1_000_000 } else { 20_000 }
}

/// A ball of radius 1 in one hexahedron: the meridian is a half circle.
fn ball() -> RationalHexahedron {
    let points =
        [DVec3::new(0.0, 0.0, -1.0), DVec3::new(2.0, 0.0, -1.0), DVec3::new(2.0, 0.0, 1.0), DVec3::Z];
    let meridian = RationalCurve::new(&points, &[1.0, 1.0 / 3.0, 1.0 / 3.0, 1.0]).unwrap();
    RationalHexahedron::rotational(&meridian).unwrap()
}

#[track_caller]
fn assert_found(locator: &mut SolidLocator, solid: &dyn ParametricSolid, p: DVec3) -> [f64; 3] {
    let found = locator.locate(p).unwrap();
    assert!(found.is_some(), "{p} is not found");
    let found = found.unwrap();
    assert!(solid.domain().contains(found.parameters), "{:?} for {p}", found.parameters);
    let allowed = 1e-13 * locator.size() + 16.0 * U * p.abs().max_element();
    let residual = solid.try_point(found.parameters).unwrap().distance(p);
    // Evaluated where the coordinates are, not where the locator has its origin.
    assert!(residual <= allowed, "{residual:e} at {:?} for {p}", found.parameters);
    found.parameters
}

#[test]
fn goldens() {
    for case in cases("inversion.json") {
        let degrees = [0, 1, 2].map(|axis| size(&case["degree"][axis]));
        let (points, weights) = weighted_net(&case);
        let solid = RationalHexahedron::new(degrees, &points, &weights).unwrap();
        let mut locator = SolidLocator::of_hexahedron(&solid).unwrap();
        for sample in case["samples"].as_array().unwrap() {
            let exact = numbers(&sample["params"]);
            let found = assert_found(&mut locator, &solid, point(&sample["point"]));
            let jacobian = support::number(&sample["jacobian_det"]);
            for (got, exact) in found.iter().zip(exact) {
                assert!(
                    (got - exact).abs() <= 1e-11 / jacobian.abs().min(1.0),
                    "{} {got} {exact}",
                    case["name"]
                );
            }
        }
    }
    for file in ["tensor_solids.json", "constructions.json"] {
        for case in cases(file) {
            let degrees = [0, 1, 2].map(|axis| size(&case["degree"][axis]));
            let (points, weights) = weighted_net(&case);
            if weights.iter().any(|&w| w <= 0.0) || degrees[0] > 4 {
                continue;
            }
            let solid = RationalHexahedron::new(degrees, &points, &weights).unwrap();
            let mut locator = SolidLocator::of_hexahedron(&solid).unwrap();
            for sample in case["samples"].as_array().unwrap() {
                let at: [f64; 3] = numbers(&sample["params"]).try_into().unwrap();
                if at.iter().all(|t| (0.0..=1.0).contains(t)) {
                    assert_found(&mut locator, &solid, solid.point(at).unwrap());
                }
            }
        }
    }
    for case in cases("tetrahedra.json") {
        let (points, weights) = weighted_net(&case);
        if weights.iter().any(|&w| w <= 0.0) || size(&case["degree"]) > 5 {
            continue;
        }
        let solid = RationalTetrahedron::new(size(&case["degree"]), &points, &weights).unwrap();
        let mut locator = SolidLocator::of_tetrahedron(&solid).unwrap();
        for sample in case["samples"].as_array().unwrap() {
            let at: [f64; 3] = numbers(&sample["lambda_first"]).try_into().unwrap();
            if solid.domain().contains(at) {
                assert_found(&mut locator, &solid, solid.point(at).unwrap());
            }
        }
    }
}

/// What the ball holds is known without it.
#[test]
fn ball_and_beyond() {
    let solid = ball();
    let mut locator = SolidLocator::of_hexahedron(&solid).unwrap();
    let mut dice = Dice(1);
    for _ in 0..count() {
        let p = DVec3::from_array(dice.point().map(|x| 2.4 * x - 1.2));
        if p.length() < 1.0 {
            assert_found(&mut locator, &solid, p);
        } else {
            assert_eq!(locator.locate(p).unwrap(), None, "{p}");
        }
    }
    // On the sphere, near it, at the poles, on the axis.
    for _ in 0..count() / 10 {
        let direction = DVec3::from_array(dice.point().map(|x| x - 0.5)).normalize();
        assert_found(&mut locator, &solid, direction * (1.0 - 1e-15));
        for gap in [1e-2, 1e-4, 1e-6, 1e-8, 1e-10] {
            assert_found(&mut locator, &solid, direction * (1.0 - gap));
            assert_eq!(locator.locate(direction * (1.0 + gap)).unwrap(), None, "{direction} {gap}");
        }
        let z = 2.0 * dice.roll() - 1.0;
        assert_found(&mut locator, &solid, DVec3::Z * z);
        assert_found(&mut locator, &solid, solid.point([0.0, 0.0, dice.roll()]).unwrap());
        assert_found(&mut locator, &solid, solid.point([1.0, 0.0, dice.roll()]).unwrap());
    }
    for p in [DVec3::Z, -DVec3::Z, DVec3::X, DVec3::ZERO] {
        assert_found(&mut locator, &solid, p);
    }
}

#[test]
fn points_of_random_solids() {
    let mut dice = Dice(2);
    for round in 0..count() / 500 {
        // Cubes of degree (3,2,1) with their points shaken, but not folded; far from the origin every other time.
        let away = if round % 2 == 0 { DVec3::ZERO } else { DVec3::new(1e3, -2e3, 5e2) };
        let scale = [1.0, 1e-6, 1e6][round % 3];
        let cube = Hexahedron::unit_cube().elevated([2, 1, 0]).unwrap();
        let mut shaken = |points: &[DVec3]| -> Vec<DVec3> {
            let shake = |p: &DVec3| (*p + 0.1 * (DVec3::from_array(dice.point()) - 0.5) + away) * scale;
            points.iter().map(shake).collect()
        };
        let hexahedron = Hexahedron::new([3, 2, 1], shaken(cube.control_points())).unwrap();
        let corner =
            Tetrahedron::new(1, [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ZERO]).unwrap().elevated(1).unwrap();
        let tetrahedron = Tetrahedron::new(2, shaken(corner.control_points())).unwrap();
        let prism = [DVec3::X, DVec3::X + DVec3::Z, DVec3::Y, DVec3::Y + DVec3::Z, DVec3::ZERO, DVec3::Z];
        let prism = Wedge::new([1, 1], prism).unwrap().elevated([1, 1]).unwrap();
        let wedge = Wedge::new([2, 2], shaken(prism.control_points())).unwrap();
        let mut locators = [
            SolidLocator::of_hexahedron(&hexahedron).unwrap(),
            SolidLocator::of_tetrahedron(&tetrahedron).unwrap(),
            SolidLocator::of_wedge(&wedge).unwrap(),
        ];
        let solids: [&dyn ParametricSolid; 3] = [&hexahedron, &tetrahedron, &wedge];
        for (locator, solid) in locators.iter_mut().zip(solids) {
            for _ in 0..60 {
                let mut at = dice.point();
                let domain = solid.domain();
                if !domain.contains(at) {
                    at = [at[0] / 3.0, at[1] / 3.0, at[2] / 3.0];
                }
                // A share of them on the boundary.
                if dice.roll() < 0.2 {
                    at[0] = 0.0;
                }
                let p = solid.try_point(at).unwrap();
                let found = assert_found(locator, solid, p);
                // The map is one to one, with a Jacobian that is not small.
                let off = (0..3).map(|axis| (found[axis] - at[axis]).abs()).fold(0.0, f64::max);
                assert!(off <= 1e-11 * (1.0 + away.length()), "{off:e}");
                // The same point is outside a solid moved away.
                assert_eq!(locator.locate(p + DVec3::splat(3.0 * locator.size())).unwrap(), None);
            }
        }
    }
}

/// `None` is a proof: against sampling, at a distance that the samples resolve.
#[test]
fn nothing_is_missed_in_folded_solids() {
    let mut dice = Dice(3);
    for _ in 0..count() / 1000 {
        let points: Vec<DVec3> = (0..27).map(|_| DVec3::from_array(dice.point())).collect();
        let weights: Vec<f64> = (0..27).map(|_| 10_f64.powf(2.0 * dice.roll() - 1.0)).collect();
        let solid = RationalHexahedron::new([2; 3], &points, &weights).unwrap();
        let mut locator = SolidLocator::of_hexahedron(&solid).unwrap();
        for _ in 0..40 {
            let p = solid.point(dice.point()).unwrap();
            assert_found(&mut locator, &solid, p);
        }
    }
}

#[test]
fn intervals_are_those_of_the_solid() {
    let cube = Hexahedron::unit_cube();
    let interval = Interval::new(2.0, 4.0).unwrap();
    let mut locator = SolidLocator::of_hexahedron(&cube.with_intervals([interval; 3])).unwrap();
    let found = locator.locate(DVec3::splat(0.25)).unwrap().unwrap();
    assert!(found.parameters.iter().all(|t| (t - 2.5).abs() < 1e-12));
}

#[test]
fn weights_of_both_signs_and_nonsense() {
    let square = [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::new(1.0, 1.0, 0.0)];
    let points: Vec<DVec3> = square.iter().flat_map(|&p| [p, p + 0.5 * DVec3::Z, p + DVec3::Z]).collect();
    let weights: Vec<f64> = [1.0, -0.2, 1.0].repeat(4); // w = 1 − 2.4 t(1−t) ≥ 0.4
    let solid = RationalHexahedron::new([1, 1, 2], &points, &weights).unwrap();
    let mut locator = SolidLocator::of_hexahedron(&solid).unwrap();
    let p = solid.point([0.3, 0.7, 0.4]).unwrap();
    assert_found(&mut locator, &solid, p);
    assert_eq!(locator.locate(DVec3::new(0.3, -0.7, 0.4)).unwrap(), None);
    assert!(locator.locate(DVec3::new(f64::NAN, 0.0, 0.0)).is_err());
    assert!(matches!(locator.locate_within(p, 0.0), Err(SolidError::Construction { .. })));
}

/// Products of three derivatives would leave the range of numbers: a pyramid made of a cube, its apex the face u = 1.
#[test]
fn sizes_at_the_ends_of_the_range() {
    let mut dice = Dice(4);
    for exponent in [-130, -110, -60, 0, 60, 110, 130] {
        let (scale, apex) = (10_f64.powi(exponent), DVec3::new(1.0, 0.5, 0.5));
        let cube = Hexahedron::unit_cube();
        let points = cube.control_points().iter().map(|p| if p.x == 1.0 { apex } else { *p } * scale);
        let solid = Hexahedron::new([1; 3], points.collect::<Vec<_>>()).unwrap();
        let mut locator = SolidLocator::of_hexahedron(&solid).unwrap();
        for _ in 0..200 {
            let mut at = dice.point();
            at[0] = 1.0 - 10_f64.powf(-16.0 * at[0]);
            assert_found(&mut locator, &solid, solid.point(at));
            let beyond = apex * scale + DVec3::X * (scale * 10_f64.powf(-12.0 * at[1]));
            assert_eq!(locator.locate(beyond).unwrap(), None, "{beyond}");
        }
    }
}

/// The size, and with it the tolerance, is that of the solid, however far apart the weights are.
#[test]
fn wild_weights_do_not_loosen_the_tolerance() {
    let mut dice = Dice(5);
    for _ in 0..20 {
        let points: Vec<DVec3> = (0..8).map(|_| DVec3::from_array(dice.point())).collect();
        let weights: Vec<f64> = (0..8).map(|_| 10_f64.powf(16.0 * dice.roll() - 8.0)).collect();
        let solid = RationalHexahedron::new([1; 3], &points, &weights).unwrap();
        let hull = solid.hull_box().unwrap();
        let locator = SolidLocator::of_hexahedron(&solid).unwrap();
        assert!(locator.size() <= (1.0 + 1e-12) * (hull.max - hull.min).length(), "{}", locator.size());
    }
}

/// A corner of weight 0 is no point; what is outside is outside all the same.
#[test]
fn corners_without_weight() {
    let points: Vec<DVec3> = Hexahedron::unit_cube().control_points().to_vec();
    let weights = [0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0];
    let solid = RationalHexahedron::new([1; 3], &points, &weights).unwrap();
    let mut locator = SolidLocator::of_hexahedron(&solid).unwrap();
    assert_found(&mut locator, &solid, solid.point([0.2, 0.3, 0.4]).unwrap());
    for p in [DVec3::splat(2.0), DVec3::splat(-1.0), DVec3::new(0.5, 0.5, 1.001)] {
        assert_eq!(locator.locate(p).unwrap(), None, "{p}");
    }
}

/// A point, a line, a sheet: every point of them is found, nothing else.
#[test]
fn flat_solids() {
    let sheet = Patch::new([1, 1], [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::new(1.0, 1.0, 0.0)]).unwrap();
    let points: Vec<DVec3> = sheet.control_points().iter().flat_map(|&p| [p, p]).collect();
    let flat: BezierHexahedron<DVec3> = Hexahedron::new([1; 3], points).unwrap();
    let mut locator = SolidLocator::of_hexahedron(&flat).unwrap();
    assert_found(&mut locator, &flat, DVec3::new(0.3, 0.8, 0.0));
    assert_eq!(locator.locate(DVec3::new(0.3, 0.8, 1e-9)).unwrap(), None);
    let dot = Hexahedron::new([0; 3], [DVec3::ONE]).unwrap();
    let mut locator = SolidLocator::of_hexahedron(&dot).unwrap();
    assert_found(&mut locator, &dot, DVec3::ONE);
    assert_eq!(locator.locate(DVec3::X).unwrap(), None);
}

proptest! {
    #[test]
    fn never_a_panic(points in prop::collection::vec(support::homogeneous_point(), 12), p in support::space_point()) {
        if let Ok(solid) = RationalHexahedron::from_homogeneous([1, 1, 2], points)
            && let Ok(mut locator) = SolidLocator::of_hexahedron(&solid)
            && let Ok(Some(found)) = locator.locate(p)
        {
            prop_assert!(found.residual.is_finite());
            prop_assert!(solid.domain().contains(found.parameters));
        }
    }
}
