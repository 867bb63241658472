//! The formula against an independent implementation, and against the tensor-product patch that it generalizes.
#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod common;

use casteljau_gb::glam::{DVec3, dvec3};
use casteljau_gb::{CenterWeight, ConcavePatch, CoordinateKind, LayoutKind, Location, Ribbon};
use common::*;

/// Mixed degrees and layers, every center weight and power, a corner point: the plain loops agree to rounding.
#[test]
fn agrees_with_plain_loops() {
    let mut random = Random(1);
    for (polygon, shapes) in [
        (l_shape(), vec![(3, 2)]),
        (l_shape(), vec![(1, 2), (4, 3), (5, 2), (2, 4), (7, 2), (20, 6)]),
        (regular(3), vec![(3, 2), (4, 1), (5, 3)]),
        (regular(5), vec![(5, 3), (2, 2), (3, 2)]),
        (regular(11), vec![(3, 2), (6, 4)]),
    ] {
        let ribbons = ribbons_over(&polygon, &shapes);
        let n = polygon.len();
        for p in [1, 2, 3, 4, 7] {
            for weight in
                [CenterWeight::None, CenterWeight::Deficiency, CenterWeight::Nth, CenterWeight::Harmonic]
            {
                if n == 3 && weight == CenterWeight::Nth {
                    continue;
                }
                let mut builder = ConcavePatch::builder(ribbons.clone())
                    .domain(polygon.clone())
                    .coordinates(CoordinateKind::MeanValue)
                    .blend_power(p)
                    .center(dvec3(0.3, -0.2, 1.7))
                    .center_weight(weight);
                if n > 3 {
                    builder = builder.corner_point(3, dvec3(2.0, 1.0, -1.0));
                }
                let patch = builder.build().unwrap();
                for _ in 0..20 {
                    let lambda = random.simplex(n);
                    let found = patch.point_from_coordinates(&lambda).unwrap();
                    let error = found.distance(plain(&patch, &lambda));
                    assert!(error < 4e-14, "n {n} p {p} {weight:?}: {error:e}");
                }
            }
        }
    }
}

/// On the square with shared points the patch is the tensor-product patch, for every blend power.
///
/// Shared means: every ribbon carries the l layers of the net next to its side, l = (d+1)/2; a corner's l × l block is in
/// both of its ribbons, and α + β = 1 shares it out.
#[test]
fn square_is_tensor_product() {
    let mut random = Random(7);
    for degree in [3usize, 5, 7] {
        let (layers, last) = (degree.div_ceil(2), degree);
        let net: Vec<Vec<DVec3>> =
            (0..=degree).map(|_| (0..=degree).map(|_| random.point()).collect()).collect();
        // Net index (a, b) along u and v. The square runs (1,1), (−1,1), (−1,−1), (1,−1); side i ends at vertex i.
        let at = |side: usize, j: usize, k: usize| match side {
            0 => net[last - k][j],
            1 => net[last - j][last - k],
            2 => net[k][last - j],
            _ => net[j][k],
        };
        let ribbons: Vec<Ribbon> = (0..4)
            .map(|side| {
                let points = (0..layers).flat_map(|k| (0..=degree).map(move |j| at(side, j, k))).collect();
                Ribbon::new(degree, layers, points).unwrap()
            })
            .collect();
        for p in [1, 2, 3, 5] {
            let patch = ConcavePatch::builder(ribbons.clone())
                .layout(LayoutKind::Regular)
                .coordinates(CoordinateKind::Wachspress)
                .blend_power(p)
                .build()
                .unwrap();
            for _ in 0..200 {
                let uv = random.point().truncate();
                let (s, t) = (0.5 + 0.5 * uv.x, 0.5 + 0.5 * uv.y);
                let mut expected = DVec3::ZERO;
                for (a, row) in net.iter().enumerate() {
                    for (b, &point) in row.iter().enumerate() {
                        expected += point * bernstein(degree, a, s) * bernstein(degree, b, t);
                    }
                }
                let error = patch.point(uv).unwrap().distance(expected);
                assert!(error < 1e-13 * patch.bounding_box().diagonal(), "{degree} {p}: {error:e}");
            }
        }
    }
}

/// Moving, turning and stretching the control points moves, turns and stretches the surface.
#[test]
fn affine_invariance() {
    let map = casteljau_gb::glam::DAffine3::from_cols_array(&[
        2.0, 0.3, -1.0, 0.1, 1.5, 0.7, -0.4, 0.2, 3.0, 5.0, -7.0, 11.0,
    ]);
    let polygon = l_shape();
    let shapes = [(3, 2), (5, 3), (4, 1)];
    let mut ribbons = ribbons_over(&polygon, &shapes);
    let build = |ribbons: Vec<Ribbon>, f: &dyn Fn(DVec3) -> DVec3| {
        ConcavePatch::builder(ribbons)
            .domain(polygon.clone())
            .coordinates(CoordinateKind::MeanValue)
            .center(f(DVec3::ONE))
            .center_weight(CenterWeight::Deficiency)
            .build()
            .unwrap()
    };
    let before = build(ribbons.clone(), &|p| p);
    for ribbon in &mut ribbons {
        let points = ribbon.control_points().iter().map(|&p| map.transform_point3(p)).collect();
        *ribbon = Ribbon::new(ribbon.degree(), ribbon.layers(), points).unwrap();
    }
    let after = build(ribbons, &|p| map.transform_point3(p));
    for uv in inside(&polygon, 200, &mut Random(3)) {
        let expected = map.transform_point3(before.point(uv).unwrap());
        let error = after.point(uv).unwrap().distance(expected);
        assert!(error < 1e-13 * after.bounding_box().diagonal(), "{error:e}");
    }
}

/// Which side is called 0 does not matter.
#[test]
fn renumbering_the_sides() {
    let polygon = l_shape();
    let shapes = [(3, 2), (5, 3), (4, 2), (2, 1), (3, 2), (6, 2)];
    let ribbons = ribbons_over(&polygon, &shapes);
    let first = patch_over(polygon.clone(), CoordinateKind::MeanValue, &shapes, 2);
    for turn in 1..6 {
        let mut vertices = polygon.vertices().to_vec();
        let mut turned = ribbons.clone();
        vertices.rotate_left(turn);
        turned.rotate_left(turn);
        let patch = ConcavePatch::builder(turned)
            .domain(casteljau_gb::Polygon::new(vertices).unwrap())
            .coordinates(CoordinateKind::MeanValue)
            .build()
            .unwrap();
        for uv in inside(&polygon, 50, &mut Random(4)) {
            assert!(patch.point(uv).unwrap().distance(first.point(uv).unwrap()) < 1e-13);
        }
        assert_eq!(
            patch.continuity()[0].order,
            first.continuity()[turn].order,
            "the promise moves with the side"
        );
    }
}

/// Running round the other way (a mirrored, clockwise domain, kept as given) gives the mirror-parametrised surface, and
/// the same normals.
#[test]
fn clockwise_domain() {
    let polygon = l_shape();
    let first = patch_over(polygon.clone(), CoordinateKind::MeanValue, &[(3, 2), (4, 3)], 2);
    let mirrored: Vec<_> = polygon.vertices().iter().map(|v| casteljau_gb::glam::dvec2(-v.x, v.y)).collect();
    let mirrored = casteljau_gb::Polygon::new(mirrored).unwrap();
    let second = ConcavePatch::builder(first.ribbons().to_vec())
        .domain(mirrored.clone())
        .coordinates(CoordinateKind::MeanValue)
        .build()
        .unwrap();
    assert_eq!(second.domain().vertices(), mirrored.vertices());
    for uv in inside(&polygon, 100, &mut Random(5)) {
        let twin = casteljau_gb::glam::dvec2(-uv.x, uv.y);
        assert!(first.point(uv).unwrap().distance(second.point(twin).unwrap()) < 1e-13);
        assert!(first.normal(uv).unwrap().distance(second.normal(twin).unwrap()) < 1e-10);
    }
    for side in 0..6 {
        let at = Location::Side { side, t: 0.3 };
        assert!(first.normal_at(at).unwrap().distance(second.normal_at(at).unwrap()) < 1e-13);
        let corner = Location::Corner(side);
        assert!(first.normal_at(corner).unwrap().distance(second.normal_at(corner).unwrap()) < 1e-13);
    }
}
