//! Solids whose volume and moments are known.

use std::f64::consts::PI;

use casteljau_solid::geom::glam::{DMat3, DVec3, DVec4};
use casteljau_solid::shape::{ControlPoint, ShapeError};
use casteljau_solid::{MassProperties, SolidError, SolidNet, mass_properties};

use crate::support::rotational;

fn hexahedron<P: ControlPoint>(points: &[P], degrees: [usize; 3]) -> MassProperties {
    mass_properties(&SolidNet::Hexahedron { points, degrees }, 1e-12).unwrap()
}

fn revolved(meridian: &[[f64; 2]], weights: &[f64]) -> MassProperties {
    let meridian: Vec<DVec3> = meridian.iter().map(|&[x, z]| DVec3::new(x, 0.0, z)).collect();
    hexahedron(&rotational(&meridian, weights, 4.0), [2, 2, meridian.len() - 1])
}

/// Within 1e-12 of the size given for each, and within the stated errors.
#[track_caller]
fn assert_is(found: &MassProperties, volume: f64, centroid: DVec3, second_about_centroid: DMat3) {
    let size = second_about_centroid.col(0).x.max(second_about_centroid.col(2).z);
    assert!((found.volume - volume).abs() <= 1e-12 * volume, "{} for {volume}", found.volume);
    assert!(found.volume_error <= 1e-11 * volume, "{:e}", found.volume_error);
    let at = found.centroid.unwrap();
    let length = (size / volume).sqrt();
    assert!(at.distance(centroid) <= 1e-12 * length, "{at} for {centroid}");
    let second = found.second_moment_about(centroid);
    let off =
        (second - second_about_centroid).to_cols_array().into_iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    assert!(off <= 2e-12 * size, "{second} for {second_about_centroid}");
}

fn diagonal(x: f64, y: f64, z: f64) -> DMat3 {
    DMat3::from_diagonal(DVec3::new(x, y, z))
}

#[test]
fn boxes() {
    let [a, b, c] = [2.0, 3.0, 0.5];
    let corner = DVec3::new(10.0, -20.0, 5.0);
    let at = |p: usize| corner + DVec3::new((p >> 2) as f64 * a, (p >> 1 & 1) as f64 * b, (p & 1) as f64 * c);
    let points: Vec<DVec3> = (0..8).map(at).collect();
    let volume = a * b * c;
    let second = diagonal(a * a, b * b, c * c) * (volume / 12.0);
    assert_is(&hexahedron(&points, [1; 3]), volume, corner + 0.5 * DVec3::new(a, b, c), second);
    // The same box with its parameters running unevenly: weights 1, s along an axis.
    for s in [0.01_f64, 0.3, 100.0] {
        let weights = |p: usize| s.powi((p >> 2) as i32) * (1.0 / s).powi((p & 1) as i32);
        let lifted: Vec<DVec4> =
            points.iter().enumerate().map(|(p, q)| (*q * weights(p)).extend(weights(p))).collect();
        assert_is(&hexahedron(&lifted, [1; 3]), volume, corner + 0.5 * DVec3::new(a, b, c), second);
    }
}

#[test]
fn solids_of_revolution() {
    let [r, h] = [1.5, 2.0];
    let cylinder = revolved(&[[r, 0.0], [r, h]], &[1.0; 2]);
    let volume = PI * r * r * h;
    let across = volume * r * r / 4.0;
    assert_is(&cylinder, volume, DVec3::Z * h / 2.0, diagonal(across, across, volume * h * h / 12.0));

    let cone = revolved(&[[r, 0.0], [0.0, h]], &[1.0; 2]);
    let volume = PI * r * r * h / 3.0;
    let across = volume * 3.0 * r * r / 20.0;
    assert_is(&cone, volume, DVec3::Z * h / 4.0, diagonal(across, across, volume * 3.0 * h * h / 80.0));

    // The whole ball: half a circle as a rational cubic.
    let third = 1.0 / 3.0;
    let ball = revolved(&[[0.0, -r], [2.0 * r, -r], [2.0 * r, r], [0.0, r]], &[1.0, third, third, 1.0]);
    let volume = 4.0 * PI / 3.0 * r.powi(3);
    assert_is(&ball, volume, DVec3::ZERO, diagonal(1.0, 1.0, 1.0) * (4.0 * PI / 15.0 * r.powi(5)));

    // A torus' piece: the ring under the upper half of a circle, revolved; here the solid between z = 0 and the meridian's
    // disc swept about the axis, as the difference of two solids of revolution about the same axis.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let [big, small] = [3.0, 1.0];
    let quarter = |sign: f64| [[big + sign * small, 0.0], [big + sign * small, small], [big, small]];
    let outer = revolved(&quarter(1.0), &[1.0, half, 1.0]);
    let inner = revolved(&quarter(-1.0), &[1.0, half, 1.0]);
    let upper_half_torus = PI * PI * big * small * small;
    let found = outer.volume - inner.volume;
    assert!((found - upper_half_torus).abs() <= 1e-12 * outer.volume, "{found} for {upper_half_torus}");
}

/// An affine image of the ball is an ellipsoid anywhere.
#[test]
fn ellipsoids() {
    let third = 1.0 / 3.0;
    let half_circle: Vec<DVec3> =
        [[0.0, -1.0], [2.0, -1.0], [2.0, 1.0], [0.0, 1.0]].map(|[x, z]| DVec3::new(x, 0.0, z)).to_vec();
    let ball = rotational(&half_circle, &[1.0, third, third, 1.0], 4.0);
    let map =
        DMat3::from_cols(DVec3::new(2.0, 0.3, -0.5), DVec3::new(-0.4, 1.0, 0.2), DVec3::new(0.1, 0.6, 0.5));
    for center in [DVec3::ZERO, DVec3::new(1e3, -2e3, 5e2)] {
        let image: Vec<DVec4> =
            ball.iter().map(|p| (map * p.truncate() + center * p.w).extend(p.w)).collect();
        let found = hexahedron(&image, [2, 2, 3]);
        let volume = 4.0 * PI / 3.0 * map.determinant();
        // Control points far away are themselves rounded.
        let far = 1.0 + 4e-4 * center.length();
        assert!((found.volume - volume).abs() <= 1e-12 * far * volume, "{}", found.volume / volume - 1.0);
        assert!(found.centroid.unwrap().distance(center) <= 1e-12 * far);
        let second = map * map.transpose() * (volume / 5.0);
        let off = (found.second_moment_about(center) - second).to_cols_array();
        assert!(off.into_iter().all(|x| x.abs() <= 4e-12 * far * volume), "{off:?}");
    }
}

#[test]
fn no_volume_no_centroid() {
    // A bow tie: one half is the mirror image of the other.
    let points: Vec<DVec3> = (0..12)
        .map(|p| {
            let [i, j, k] = [p / 4, p / 2 % 2, p % 2];
            DVec3::new([0.0, 1.0, 0.0][i], j as f64, k as f64)
        })
        .collect();
    let found = hexahedron(&points, [2, 1, 1]);
    assert!(found.volume.abs() <= found.volume_error && found.centroid.is_none());
    let lifted: Vec<DVec4> = points.iter().map(|p| p.extend(1.0)).collect();
    let found = hexahedron(&lifted, [2, 1, 1]);
    assert!(found.volume.abs() <= found.volume_error && found.centroid.is_none(), "{found:?}");
    // Mirrored: negative, with the same centroid.
    let mirrored: Vec<DVec3> =
        (0..8).map(|c| DVec3::new(-((c >> 2) as f64), (c >> 1 & 1) as f64, (c & 1) as f64)).collect();
    let found = hexahedron(&mirrored, [1; 3]);
    assert_eq!(found.volume, -1.0);
    assert!(found.centroid.unwrap().distance(DVec3::new(-0.5, 0.5, 0.5)) < 1e-15);
}

#[test]
fn what_is_refused() {
    let points = [DVec4::W, DVec4::X + DVec4::W, DVec4::Y + DVec4::W, DVec4::Z - DVec4::W];
    let net = SolidNet::Tetrahedron { points: &points, degree: 1 };
    assert!(matches!(mass_properties(&net, 1e-10), Err(SolidError::WeightZero { .. })));
    for relative in [0.0, 1.0, -1.0, f64::NAN] {
        let refused = mass_properties(&net, relative);
        assert!(matches!(refused, Err(SolidError::Shape(ShapeError::Accuracy { .. }))));
    }
}
