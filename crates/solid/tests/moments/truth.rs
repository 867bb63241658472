//! Polynomial solids against exact integrals, and the goldens.

use casteljau_solid::geom::UNIT_ROUNDOFF as U;
use casteljau_solid::geom::glam::{DVec3, DVec4};
use casteljau_solid::{MassProperties, SolidDegrees, SolidNet, mass_properties};
use num_rational::BigRational;
use num_traits::ToPrimitive;

use crate::referee::{Polynomial, coordinates};
use crate::support::{Chance, cases, flat, homogeneous, points, sizes};

fn net<P>(points: &[P], degrees: SolidDegrees) -> SolidNet<'_, P> {
    match degrees {
        SolidDegrees::Hexahedron(degrees) => SolidNet::Hexahedron { points, degrees },
        SolidDegrees::Tetrahedron(degree) => SolidNet::Tetrahedron { points, degree },
        SolidDegrees::Wedge(degrees) => SolidNet::Wedge { points, degrees },
    }
}

#[test]
fn goldens() {
    for case in cases("jacobian.json").iter().filter(|case| !case["volume"].is_null()) {
        let points = points(&case["control_points"]);
        let degrees = match sizes(&case["degree"])[..] {
            [n] => SolidDegrees::Tetrahedron(n),
            [l, m, n] => SolidDegrees::Hexahedron([l, m, n]),
            _ => panic!(),
        };
        let exact = flat(&case["volume"])[0];
        let polynomial = mass_properties(&net(&points, degrees), 1e-12).unwrap();
        assert!((polynomial.volume - exact).abs() <= polynomial.volume_error + U * exact.abs());
        assert!(polynomial.volume_error <= 1e-12 * exact.abs());
        // The same as a rational solid, by another way.
        let lifted: Vec<DVec4> = points.iter().map(|p| p.extend(1.0)).collect();
        let rational = mass_properties(&net(&lifted, degrees), 1e-12).unwrap();
        assert!((rational.volume - exact).abs() <= 1e-12 * exact.abs(), "{} for {exact}", rational.volume);
        if case["first_moments"].is_array() {
            let exact = DVec3::from_slice(&flat(&case["first_moments"]));
            for (found, error) in [(polynomial, polynomial.first_error), (rational, 1e-12)] {
                let off = (found.first_moment_about(DVec3::ZERO) - exact).abs().max_element();
                assert!(off <= error + 4.0 * U, "{off:e}");
            }
        }
    }
    for case in cases("constructions.json").iter().filter(|case| !case["signed_volume"].is_null()) {
        let points = homogeneous(&points(&case["control_points"]), &flat(&case["weights"]));
        let degrees = SolidDegrees::Hexahedron(sizes(&case["degree"]).try_into().unwrap());
        let exact = flat(&case["signed_volume"])[0];
        let found = mass_properties(&net(&points, degrees), 1e-12).unwrap();
        assert!((found.volume - exact).abs() <= 1e-12 * exact.abs(), "{}: {}", case["name"], found.volume);
        assert!(found.volume_error <= 2e-12 * exact.abs());
    }
}

/// Each of the ten integrals is within its stated bound of the exact one, and the bound is small.
fn check(points: &[DVec3], degrees: SolidDegrees, second_too: bool) -> f64 {
    let found = mass_properties(&net(points, degrees), 1e-12).unwrap();
    // Exactly about the same point.
    let local: Vec<DVec4> = points.iter().map(|p| p.extend(1.0)).collect();
    let (coordinates, factor) = coordinates(&local, degrees);
    let exact_reference = found.reference.to_array().map(|c| BigRational::from_float(c).unwrap());
    let jacobian = Polynomial::jacobian(&coordinates);
    let cube = &factor * &factor * &factor;
    let of = |p: &Polynomial| p.integral(degrees);
    let volume = of(&jacobian) / &cube;
    // ∫ x J and ∫ x y J about the origin, then by Steiner's theorem, all exact.
    let first: Vec<BigRational> =
        coordinates.iter().map(|x| of(&x.product(&jacobian)) / (&cube * &factor)).collect();
    let (mut largest, mut allowed) = (0.0_f64, 0.0_f64);
    let mut compare = |got: f64, exact: &BigRational, bound: f64| {
        let off = (BigRational::from_float(got).unwrap() - exact).to_f64().unwrap().abs();
        assert!(off <= bound, "{degrees:?} {points:?}: off {off:e}, bound {bound:e}");
        largest = largest.max(off);
        allowed = allowed.max(bound);
    };
    compare(found.volume, &volume, found.volume_error);
    for a in 0..3 {
        let about = &first[a] - &exact_reference[a] * &volume;
        compare(found.first_moment[a], &about, found.first_error);
        for b in (0..3).filter(|_| second_too) {
            let second = of(&coordinates[a].product(&coordinates[b]).product(&jacobian));
            let second = second / (&cube * &factor * &factor);
            let about = second - &exact_reference[a] * &first[b] - &exact_reference[b] * &first[a]
                + &exact_reference[a] * &exact_reference[b] * &volume;
            compare(found.second_moment.col(a)[b], &about, found.second_error);
        }
    }
    allowed
}

#[test]
fn polynomial_solids_are_exact_within_their_bounds() {
    let kinds = [
        SolidDegrees::Hexahedron([1, 1, 1]),
        SolidDegrees::Tetrahedron(1),
        SolidDegrees::Tetrahedron(2),
        SolidDegrees::Wedge([1, 1]),
        SolidDegrees::Hexahedron([1, 2, 1]),
        SolidDegrees::Wedge([2, 1]),
        SolidDegrees::Tetrahedron(3),
    ];
    let mut chance = Chance(5);
    for round in 0..1100 {
        let degrees = kinds[round % kinds.len()];
        // Of size 1, at the origin or far away.
        let far = [0.0, 10.0, 1e6][chance.below(3)];
        let points: Vec<DVec3> = (0..degrees.count()).map(|_| chance.point(1.0) + far).collect();
        // Exact second moments take long.
        let allowed = check(&points, degrees, round % 5 == 0);
        assert!(allowed <= 1e-12, "{allowed:e}");
    }
    for degrees in [SolidDegrees::Hexahedron([2, 2, 2]), SolidDegrees::Wedge([2, 2])] {
        let points: Vec<DVec3> = (0..degrees.count()).map(|_| chance.point(1.0)).collect();
        assert!(check(&points, degrees, true) <= 1e-11);
    }
}

#[test]
fn sizes_at_the_ends_of_the_range() {
    let unit: Vec<DVec3> =
        (0..8).map(|c| DVec3::new((c >> 2) as f64, (c >> 1 & 1) as f64, (c & 1) as f64)).collect();
    for size in [1e-90, 1e-6, 1e6, 1e100] {
        let scaled: Vec<DVec3> = unit.iter().map(|&p| p * size).collect();
        let lifted: Vec<DVec4> = scaled.iter().map(|p| p.extend(1.0)).collect();
        let degrees = SolidDegrees::Hexahedron([1; 3]);
        let both: [MassProperties; 2] = [
            mass_properties(&net(&scaled, degrees), 1e-12).unwrap(),
            mass_properties(&net(&lifted, degrees), 1e-12).unwrap(),
        ];
        for found in both {
            assert!((found.volume / size / size / size - 1.0).abs() < 1e-13, "{size:e}: {found:?}");
            assert!((found.centroid.unwrap() / size).distance(DVec3::splat(0.5)) < 1e-13);
        }
    }
}
