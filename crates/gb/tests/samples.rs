//! Kept coordinates and kept blends give the same surface.
#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod common;

use casteljau_gb::glam::{DVec3, dvec2, dvec3};
use casteljau_gb::{
    BlendMatrix, CenterWeight, ConcavePatch, CoordinateKind, GbError, Location, SampleSet, SurfaceJet,
};
use common::*;

fn patch() -> ConcavePatch {
    let polygon = l_shape();
    ConcavePatch::builder(ribbons_over(&polygon, &[(3, 2), (4, 3), (2, 1)]))
        .domain(polygon)
        .coordinates(CoordinateKind::MeanValue)
        .center(DVec3::ONE)
        .center_weight(CenterWeight::Nth)
        .corner_point(0, dvec3(0.5, 0.5, 1.0))
        .build()
        .unwrap()
}

fn locations(patch: &ConcavePatch, count: usize) -> Vec<Location> {
    let mut all: Vec<Location> =
        inside(patch.domain(), count, &mut Random(21)).into_iter().map(Location::Inside).collect();
    for side in 0..patch.sides() {
        all.insert(7 * side, Location::Side { side, t: 0.37 });
        all.insert(11 * side, Location::Corner(side));
    }
    all
}

/// Bits of a point do not depend on the batch, its split, or the number of threads.
#[test]
fn same_bits_as_one_at_a_time() {
    let patch = patch();
    let at = locations(&patch, 5000);
    let set = SampleSet::new(patch.coordinates(), &at, 0).unwrap();
    let mut points = vec![DVec3::ZERO; at.len()];
    patch.evaluate_samples(&set, &mut points).unwrap();
    for (found, &location) in points.iter().zip(&at) {
        assert_eq!(*found, patch.point_at(location).unwrap(), "{location:?}");
    }
    for start in [0, 1, 5, 4090] {
        let part = SampleSet::new(patch.coordinates(), &at[start..start + 13], 0).unwrap();
        let mut again = vec![DVec3::ZERO; 13];
        patch.evaluate_samples(&part, &mut again).unwrap();
        assert_eq!(again, points[start..start + 13]);
    }
}

#[test]
fn jets_and_normals_from_samples() {
    let patch = patch();
    let at: Vec<Location> =
        locations(&patch, 500).into_iter().filter(|l| !matches!(l, Location::Corner(_))).collect();
    let set = SampleSet::new(patch.coordinates(), &at, 2).unwrap();
    let zero = DVec3::ZERO;
    let empty = SurfaceJet { point: zero, du: zero, dv: zero, duu: zero, duv: zero, dvv: zero };
    let mut jets = vec![empty; at.len()];
    patch.evaluate_sample_jets(&set, &mut jets).unwrap();
    let (mut points, mut normals) = (vec![zero; at.len()], vec![zero; at.len()]);
    patch.evaluate_sample_normals(&set, &mut points, &mut normals).unwrap();
    for (i, &location) in at.iter().enumerate() {
        assert_eq!(jets[i], patch.jet_at(location).unwrap(), "{location:?}");
        assert_eq!(points[i], jets[i].point);
        assert!(normals[i].distance(patch.normal_at(location).unwrap()) < 1e-15);
    }
}

/// Setting control points and evaluating, and the product with the moved points, agree.
#[test]
fn editing() {
    let mut patch = patch();
    let at = locations(&patch, 3000);
    let set = SampleSet::new(patch.coordinates(), &at, 0).unwrap();
    let matrix = BlendMatrix::new(&patch, &set).unwrap();
    assert_eq!((matrix.rows(), matrix.columns()), (at.len(), patch.control_point_count()));
    let mut random = Random(5);
    let mut net = vec![DVec3::ZERO; matrix.columns()];
    let (mut fresh, mut product) = (vec![DVec3::ZERO; at.len()], vec![DVec3::ZERO; at.len()]);
    patch.control_points(&mut net).unwrap();
    matrix.apply(&net, &mut product).unwrap();
    let mut moved = product.clone();
    for (side, j, k) in [(0, 1, 1), (1, 2, 0), (4, 4, 0), (5, 0, 0), (3, 3, 1)] {
        let before = net.clone();
        let target = random.point();
        patch.set_control_point(side, j, k, target).unwrap();
        assert_eq!(patch.ribbons()[side].point(j, k), Some(target));
        // A moved corner moves in both its ribbons.
        for i in 0..6 {
            assert_eq!(patch.ribbons()[i].row(0).last(), patch.ribbons()[(i + 1) % 6].row(0).first());
        }
        patch.control_points(&mut net).unwrap();
        for (column, (new, old)) in net.iter().zip(&before).enumerate() {
            if new != old {
                matrix.move_column(column, *new - *old, &mut moved).unwrap();
            }
        }
        patch.evaluate_samples(&set, &mut fresh).unwrap();
        matrix.apply(&net, &mut product).unwrap();
        for ((a, b), c) in fresh.iter().zip(&product).zip(&moved) {
            assert!(a.distance(*b) < 1e-13 && a.distance(*c) < 1e-13);
        }
    }
    patch.set_center(DVec3::ZERO).unwrap();
    patch.set_corner_point(0, DVec3::ZERO).unwrap();
    patch.control_points(&mut net).unwrap();
    patch.evaluate_samples(&set, &mut fresh).unwrap();
    matrix.apply(&net, &mut product).unwrap();
    assert!(fresh.iter().zip(&product).all(|(a, b)| a.distance(*b) < 1e-13));
    for row in 0..40 {
        let sum: f64 = (0..matrix.columns()).map(|c| matrix.weight(row, c).unwrap()).sum();
        assert!((sum - 1.0).abs() < 1e-14, "row {row}");
    }
}

/// A place that is not inside, though it was said to be, gives the error of the single evaluation and no NaN.
#[test]
fn no_silent_infinities() {
    let polygon = l_shape();
    let ribbons = ribbons_over(&polygon, &[(3, 2)]);
    let patch = ConcavePatch::builder(ribbons).domain(polygon).build().unwrap();
    let zero = DVec3::ZERO;
    let empty = SurfaceJet { point: zero, du: zero, dv: zero, duu: zero, duv: zero, dvv: zero };
    let (inner, concave, far) = (dvec2(0.5, 0.5), dvec2(1.0, 1.0), dvec2(1e200, 1.0));
    let set = |at| SampleSet::new(patch.coordinates(), &[inner, at].map(Location::Inside), 2).unwrap();
    // At a corner jets have no meaning: what comes is finite, or the error.
    let mut jets = [empty; 2];
    match patch.evaluate_sample_jets(&set(concave), &mut jets) {
        Ok(()) => assert!(jets.iter().all(SurfaceJet::is_finite), "{jets:?}"),
        Err(error) => assert!(matches!(error, GbError::Overflow { uv } if uv == concave), "{error:?}"),
    }
    let found = patch.evaluate_samples(&set(far), &mut [zero; 2]);
    assert!(matches!(found, Err(GbError::Overflow { uv }) if uv == far), "{found:?}");
    let found = patch.evaluate_sample_normals(&set(far), &mut [zero; 2], &mut [zero; 2]);
    assert!(matches!(found, Err(GbError::Overflow { uv }) if uv == far), "{found:?}");
}

#[test]
fn refusals() {
    let mut patch = patch();
    let set = SampleSet::new(patch.coordinates(), &[Location::Corner(0)], 2).unwrap();
    let wrong = |r: Result<(), GbError>| assert!(matches!(r, Err(GbError::Length { .. })), "{r:?}");
    wrong(patch.evaluate_samples(&set, &mut []));
    let matrix = BlendMatrix::new(&patch, &set).unwrap();
    wrong(matrix.apply(&[], &mut [DVec3::ZERO]));
    assert!(matches!(
        patch.evaluate_sample_jets(&set, &mut [patch.jet(casteljau_gb::glam::dvec2(0.5, 0.5)).unwrap()]),
        Err(GbError::CornerDerivative { corner: 0 })
    ));
    let other = patch_over(regular(5), CoordinateKind::Wachspress, &[(3, 2)], 2);
    assert!(matches!(other.evaluate_samples(&set, &mut [DVec3::ZERO]), Err(GbError::Structure { .. })));
    for bad in [
        Location::Outside,
        Location::Corner(6),
        Location::Side { side: 0, t: 1.5 },
        Location::Side { side: 0, t: f64::NAN },
        Location::Side { side: 9, t: 0.5 },
        Location::Inside(casteljau_gb::glam::DVec2::NAN),
    ] {
        assert!(SampleSet::new(patch.coordinates(), &[bad], 0).is_err(), "{bad:?}");
        assert!(patch.point_at(bad).is_err() && patch.jet_at(bad).is_err() && patch.normal_at(bad).is_err());
    }
    assert!(patch.set_control_point(0, 9, 0, DVec3::ZERO).is_err());
    assert!(patch.set_control_point(9, 0, 0, DVec3::ZERO).is_err());
    assert!(patch.set_control_point(0, 0, 0, DVec3::INFINITY).is_err());
    // Start of side 0 is the last corner; it may not come to lie on corner 1.
    let (before, taken) = (patch.clone(), patch.point_at(Location::Corner(1)).unwrap());
    let refused = patch.set_control_point(0, 0, 0, taken).unwrap_err();
    let last = patch.sides() - 1;
    assert!(
        matches!(refused, GbError::EqualCorners { first: 1, second, distance: 0.0, .. } if second == last),
        "{refused:?}"
    );
    assert_eq!(patch.ribbons(), before.ribbons());
    let none = SampleSet::new(patch.coordinates(), &[], 0).unwrap();
    assert!(none.is_empty() && patch.evaluate_samples(&none, &mut []).is_ok());
    assert!(
        BlendMatrix::new(&patch, &none)
            .unwrap()
            .apply(&vec![DVec3::ZERO; patch.control_point_count()], &mut [])
            .is_ok()
    );
}
