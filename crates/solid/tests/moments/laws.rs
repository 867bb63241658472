//! Laws of volume and moments: subdivision adds up, affine maps and changes of parameters act as they must.

use casteljau_solid::bernstein::{TetrahedronNet, WedgeNet, subdivide_along};
use casteljau_solid::geom::glam::{DMat3, DVec3, DVec4};
use casteljau_solid::shape::ControlPoint;
use casteljau_solid::{MassProperties, SolidDegrees, SolidNet, mass_properties};

use crate::support::{Chance, homogeneous};

fn measured<P: ControlPoint>(points: &[P], degrees: SolidDegrees) -> MassProperties {
    let net = match degrees {
        SolidDegrees::Hexahedron(degrees) => SolidNet::Hexahedron { points, degrees },
        SolidDegrees::Tetrahedron(degree) => SolidNet::Tetrahedron { points, degree },
        SolidDegrees::Wedge(degrees) => SolidNet::Wedge { points, degrees },
    };
    mass_properties(&net, 1e-12).unwrap()
}

const KINDS: [SolidDegrees; 4] = [
    SolidDegrees::Hexahedron([1, 2, 1]),
    SolidDegrees::Tetrahedron(2),
    SolidDegrees::Wedge([2, 1]),
    SolidDegrees::Hexahedron([1, 1, 1]),
];

fn halves<P: ControlPoint>(points: &[P], degrees: SolidDegrees, t: f64) -> [Vec<P>; 2] {
    let (mut a, mut b) = (points.to_vec(), points.to_vec());
    match degrees {
        SolidDegrees::Hexahedron(d) => subdivide_along(points, d, 1, t, &mut a, &mut b),
        SolidDegrees::Tetrahedron(n) => {
            TetrahedronNet::validated(points, n).split_edge([1, 3], t, &mut a, &mut b)
        }
        SolidDegrees::Wedge(d) => WedgeNet::validated(points, d).split_edge([0, 2], t, &mut a, &mut b),
    }
    .unwrap();
    [a, b]
}

/// Sizes of what is compared: solids of size 1 about the origin, folded perhaps.
fn assert_same(a: &MassProperties, b: &MassProperties, what: &str) {
    let at = DVec3::ZERO;
    assert!((a.volume - b.volume).abs() < 1e-11, "{what}: {} {}", a.volume, b.volume);
    let off = (a.first_moment_about(at) - b.first_moment_about(at)).abs().max_element();
    assert!(off < 1e-11, "{what}: {off:e}");
    let off = (a.second_moment_about(at) - b.second_moment_about(at)).to_cols_array();
    assert!(off.into_iter().all(|x| x.abs() < 1e-11), "{what}: {off:?}");
}

fn sum(parts: &[MassProperties]) -> MassProperties {
    let mut whole = parts[0];
    for part in &parts[1..] {
        whole.volume += part.volume;
        whole.first_moment += part.first_moment_about(whole.reference);
        whole.second_moment += part.second_moment_about(whole.reference);
    }
    whole
}

#[test]
fn parts_add_up() {
    let mut chance = Chance(21);
    for round in 0..24 {
        let degrees = KINDS[round % 4];
        let points: Vec<DVec3> = (0..degrees.count()).map(|_| chance.point(1.0)).collect();
        let t = chance.between(0.2, 0.8);
        let parts = halves(&points, degrees, t).map(|part| measured(&part, degrees));
        assert_same(&measured(&points, degrees), &sum(&parts), "polynomial");
        let weights: Vec<f64> = points.iter().map(|_| chance.between(0.5, 2.0)).collect();
        let points = homogeneous(&points, &weights);
        let parts = halves(&points, degrees, t).map(|part| measured(&part, degrees));
        assert_same(&measured(&points, degrees), &sum(&parts), "rational");
    }
}

#[test]
fn affine_images() {
    let mut chance = Chance(22);
    for round in 0..24 {
        let degrees = KINDS[round % 4];
        let points: Vec<DVec3> = (0..degrees.count()).map(|_| chance.point(1.0)).collect();
        let weights: Vec<f64> = points.iter().map(|_| chance.between(0.5, 2.0)).collect();
        // Not so flat that rounding is all that is left.
        let map =
            std::iter::repeat_with(|| DMat3::from_cols_array(&[0; 9].map(|_| chance.between(-1.0, 1.0))))
                .find(|map| map.determinant().abs() > 0.2)
                .unwrap();
        let shift = chance.point(2.0);
        let image: Vec<DVec3> = points.iter().map(|&p| map * p + shift).collect();
        let expected = |before: MassProperties| {
            let factor = map.determinant();
            MassProperties {
                volume: before.volume * factor,
                reference: map * before.reference + shift,
                first_moment: map * before.first_moment * factor,
                second_moment: map * before.second_moment * map.transpose() * factor,
                ..before
            }
        };
        assert_same(&measured(&image, degrees), &expected(measured(&points, degrees)), "polynomial");
        let before = measured(&homogeneous(&points, &weights), degrees);
        assert_same(&measured(&homogeneous(&image, &weights), degrees), &expected(before), "rational");
    }
}

/// Weights from 1e-2 to 1e2 by chance move points about inside the unit cell and each of its faces, and change none of its
/// integrals: 1e-12 is reached, and the stated errors hold.
#[test]
fn wild_weights() {
    let mut chance = Chance(23);
    let kinds = [
        SolidDegrees::Hexahedron([1, 1, 1]),
        SolidDegrees::Tetrahedron(2),
        SolidDegrees::Wedge([2, 1]),
        SolidDegrees::Hexahedron([2, 1, 2]),
        SolidDegrees::Hexahedron([2, 2, 3]),
        SolidDegrees::Tetrahedron(1),
    ];
    for round in 0..30 {
        let degrees = kinds[round % kinds.len()];
        let mut points = degrees_points(degrees);
        // What is not on a face may go anywhere, folds included; on a face, anywhere in its plane.
        if matches!(degrees, SolidDegrees::Hexahedron(_)) {
            for p in &mut points {
                let inside = |x: f64, noise: f64| if x == 0.0 || x == 1.0 { x } else { x + noise };
                *p =
                    DVec3::from_array(std::array::from_fn(|axis| inside(p[axis], chance.between(-0.3, 0.3))));
            }
        }
        let weights: Vec<f64> = points.iter().map(|_| 10_f64.powf(chance.between(-2.0, 2.0))).collect();
        let found = measured(&homogeneous(&points, &weights), degrees);
        // ∫ xᵃ yᵇ zᶜ over the cube, the tetrahedron and the wedge.
        let exact = |powers: [u32; 3]| {
            let [a, b, c] = powers.map(f64::from);
            let factorial = |n: f64| (1..=n as u32).map(f64::from).product::<f64>();
            let above = factorial(a) * factorial(b);
            match degrees {
                SolidDegrees::Hexahedron(_) => 1.0 / ((a + 1.0) * (b + 1.0) * (c + 1.0)),
                SolidDegrees::Tetrahedron(_) => above * factorial(c) / factorial(a + b + c + 3.0),
                SolidDegrees::Wedge(_) => above / factorial(a + b + 2.0) / (c + 1.0),
            }
        };
        let what = format!("{degrees:?} {weights:?}: {found:?}");
        let volume = exact([0; 3]);
        let off = (found.volume - volume).abs();
        assert!(off <= 1e-12 * volume && off <= found.volume_error, "{off:e} {what}");
        let unit = |axis: usize| [0, 1, 2].map(|a| u32::from(a == axis));
        for i in 0..3 {
            let off = (found.first_moment_about(DVec3::ZERO)[i] - exact(unit(i))).abs();
            assert!(off <= 1e-12 * volume && off <= found.first_error, "{off:e} {what}");
            for j in 0..3 {
                let powers = [0, 1, 2].map(|a| unit(i)[a] + unit(j)[a]);
                let off = (found.second_moment_about(DVec3::ZERO).col(i)[j] - exact(powers)).abs();
                assert!(off <= 1e-12 * volume && off <= found.second_error, "{off:e} {what}");
            }
        }
    }
}

fn degrees_points(degrees: SolidDegrees) -> Vec<DVec3> {
    let [l, m, n] = degrees.along();
    let mut points = Vec::new();
    match degrees {
        SolidDegrees::Hexahedron(_) => {
            for i in 0..=l {
                for j in 0..=m {
                    points.extend((0..=n).map(|k| [i, j, k]));
                }
            }
        }
        SolidDegrees::Tetrahedron(_) => {
            for i in (0..=n).rev() {
                for j in (0..=n - i).rev() {
                    points.extend((0..=n - i - j).rev().map(|k| [i, j, k]));
                }
            }
        }
        SolidDegrees::Wedge([_, o]) => {
            for i in (0..=l).rev() {
                for j in (0..=l - i).rev() {
                    points.extend((0..=o).map(|k| [i, j, k]));
                }
            }
        }
    }
    points
        .into_iter()
        .map(|p| DVec3::from(p.map(|x| x as f64)) / DVec3::new(l as f64, m as f64, n as f64))
        .collect()
}

/// Homogeneous factors `aⁱ bʲ cᵏ` change the parameters and not the solid.
#[test]
fn changes_of_parameters() {
    let mut chance = Chance(24);
    for _ in 0..10 {
        let degrees = SolidDegrees::Hexahedron([1, 2, 1]);
        let points: Vec<DVec4> = (0..12).map(|_| (chance.point(1.0)).extend(1.0)).collect();
        let [a, b, c] = [0; 3].map(|_| 10_f64.powf(chance.between(-1.5, 1.5)));
        let changed: Vec<DVec4> = points
            .iter()
            .enumerate()
            .map(|(p, q)| *q * (a.powi((p / 6) as i32) * b.powi((p / 2 % 3) as i32) * c.powi((p % 2) as i32)))
            .collect();
        assert_same(&measured(&points, degrees), &measured(&changed, degrees), "parameters");
    }
}
