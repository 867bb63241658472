//! Collapsed, flat, folded, tiny, huge and far-away solids, and questions without an answer.

use casteljau_solid::geom::glam::{DVec3, DVec4};
use casteljau_solid::shape::ShapeError;
use casteljau_solid::{DEFAULT_OPERATIONS, JacobianVerdict, SolidError, SolidNet, jacobian_verdict};

use crate::support::{Chance, homogeneous};

fn hexahedron(points: &[DVec3], n: usize) -> JacobianVerdict {
    jacobian_verdict(&SolidNet::Hexahedron { points, degrees: [n; 3] }, DEFAULT_OPERATIONS).unwrap()
}

fn rational(points: &[DVec4], n: usize) -> JacobianVerdict {
    jacobian_verdict(&SolidNet::Hexahedron { points, degrees: [n; 3] }, DEFAULT_OPERATIONS).unwrap()
}

fn cube(n: usize) -> Vec<DVec3> {
    let index = |p: usize| [p / (n + 1).pow(2), p / (n + 1) % (n + 1), p % (n + 1)];
    (0..(n + 1).pow(3)).map(|p| DVec3::from(index(p).map(|i| i as f64))).collect()
}

fn names(verdict: &JacobianVerdict) -> Vec<String> {
    assert!(verdict.is_valid(), "{verdict:?}");
    verdict.exceptions().iter().map(ToString::to_string).collect()
}

#[test]
fn collapsed_hexahedra() {
    let mut wedge = cube(1);
    (wedge[6], wedge[7]) = (wedge[4], wedge[5]); // the face u = 1 becomes an edge along w: a wedge
    assert_eq!(names(&hexahedron(&wedge, 1)), ["face u = 1"]);
    let mut pyramid = cube(1);
    for c in [1, 3, 5, 7] {
        pyramid[c] = DVec3::new(0.5, 0.5, 1.0);
    }
    assert_eq!(names(&hexahedron(&pyramid, 1)), ["face w = 1"]);
    // A tetrahedron: the face u = 1 becomes an edge and the face w = 1 a point.
    let mut tetrahedron = pyramid;
    tetrahedron[6] = tetrahedron[4];
    assert_eq!(names(&hexahedron(&tetrahedron, 1)), ["face u = 1", "face w = 1"]);
    // A corner that is pressed flat: its three edges lie in a plane.
    let mut corner: Vec<DVec3> = cube(1).iter().map(|p| 3.0 * p).collect();
    corner[7] = DVec3::splat(2.0);
    assert_eq!(names(&hexahedron(&corner, 1)), ["corner (1, 1, 1)"]);
    let lifted = homogeneous(&corner, &[1.0, 2.0, 0.5, 1.0, 1.0, 4.0, 1.0, 2.0]);
    assert_eq!(names(&rational(&lifted, 1)), ["corner (1, 1, 1)"]);
    // An edge shared by two faces that meet in one plane.
    let mut edge = cube(1);
    for c in [0, 1] {
        edge[c] += DVec3::new(0.5, 0.5, 0.0);
    }
    assert_eq!(names(&hexahedron(&edge, 1)), ["edge u = 0, v = 0"]);
}

#[test]
fn collapsed_simplices_and_wedges() {
    // A quadratic tetrahedron: det J is zero at vertex 3 where two edges leave it in one direction.
    let grid = |n: usize| {
        let indices = (0..=n).rev().flat_map(move |i| {
            (0..=n - i).rev().flat_map(move |j| (0..=n - i - j).rev().map(move |k| [i, j, k]))
        });
        indices.map(|i| DVec3::from(i.map(|x| x as f64))).collect::<Vec<_>>()
    };
    let tetrahedron = |points: &[DVec3], degree| {
        jacobian_verdict(&SolidNet::Tetrahedron { points, degree }, DEFAULT_OPERATIONS).unwrap()
    };
    assert_eq!(tetrahedron(&grid(1), 1), JacobianVerdict::Positive);
    let mut points = grid(2);
    assert_eq!(tetrahedron(&points, 2), JacobianVerdict::Positive);
    points[3] = points[9]; // P(1,0,0,1) on P(0,0,0,2): the derivative along the edge 0–3 is zero at vertex 3
    assert_eq!(names(&tetrahedron(&points, 2)), ["vertex 3"]);
    let lifted: Vec<DVec4> =
        points.iter().enumerate().map(|(i, p)| p.extend(1.0) * (1 + i % 3) as f64).collect();
    let net = SolidNet::Tetrahedron { points: &lifted, degree: 2 };
    assert_eq!(names(&jacobian_verdict(&net, DEFAULT_OPERATIONS).unwrap()), ["vertex 3"]);
    points.swap(0, 4);
    assert!(!tetrahedron(&points, 2).is_valid());

    let wedge = |points: &[DVec3]| {
        jacobian_verdict(&SolidNet::Wedge { points, degrees: [1, 1] }, DEFAULT_OPERATIONS).unwrap()
    };
    // (λ₁, λ₂, w) as coordinates.
    let mut points: Vec<DVec3> = [[1, 0, 0], [1, 0, 1], [0, 1, 0], [0, 1, 1], [0, 0, 0], [0, 0, 1]]
        .map(|p| DVec3::from(p.map(f64::from)))
        .to_vec();
    assert_eq!(wedge(&points), JacobianVerdict::Positive);
    points[5] = points[4]; // a pyramid
    assert_eq!(names(&wedge(&points)), ["edge along w at vertex 2"]);
    points[3] = points[2]; // a tetrahedron
    assert_eq!(names(&wedge(&points)), ["face opposite vertex 0"]);
    let mut cone = points.clone();
    (cone[1], cone[3], cone[5]) = (DVec3::Z, DVec3::Z, DVec3::Z);
    assert_eq!(names(&wedge(&cone)), ["face w = 1"]);
}

#[test]
fn flat_folded_and_mirrored_solids() {
    let mut chance = Chance(3);
    for n in [1, 2] {
        for _ in 0..40 {
            // In a plane of any direction, with what rounding makes of it.
            let (a, b, origin) = (chance.point(1.0), chance.point(1.0), chance.point(2.0));
            let flat: Vec<DVec3> =
                cube(n).iter().map(|_| origin + a * chance.unit() + b * chance.unit()).collect();
            assert!(matches!(hexahedron(&flat, n), JacobianVerdict::Invalid { value: 0.0, .. }));
            let weights: Vec<f64> = flat.iter().map(|_| chance.between(0.5, 2.0)).collect();
            let verdict = rational(&homogeneous(&flat, &weights), n);
            assert!(matches!(verdict, JacobianVerdict::Invalid { value: 0.0, .. }), "{verdict:?}");

            let plain: Vec<DVec3> = cube(n).into_iter().map(|p| p + chance.point(0.1)).collect();
            assert_eq!(hexahedron(&plain, n), JacobianVerdict::Positive);
            let mirrored: Vec<DVec3> = plain.iter().map(|p| DVec3::new(-p.x, p.y, p.z)).collect();
            assert!(
                matches!(hexahedron(&mirrored, n), JacobianVerdict::Invalid { value, .. } if value < -0.1)
            );
            // One half lies upon the other.
            let half = 0.5 * n as f64;
            let folded: Vec<DVec3> = plain.iter().map(|p| p.with_z((p.z - half).powi(2))).collect();
            if n == 2 {
                assert!(
                    matches!(hexahedron(&folded, n), JacobianVerdict::Invalid { value, .. } if value < 0.0)
                );
            }
        }
    }
    let point = vec![DVec3::ONE; 8];
    assert!(matches!(hexahedron(&point, 1), JacobianVerdict::Invalid { value: 0.0, .. }));
    // Of degree 0 in a direction: a surface.
    let net = SolidNet::Hexahedron { points: &cube(1)[..4], degrees: [0, 1, 1] };
    let verdict = jacobian_verdict(&net, DEFAULT_OPERATIONS).unwrap();
    assert!(matches!(verdict, JacobianVerdict::Invalid { value: 0.0, .. }));
}

/// The verdict is that of the shape, not of its size and place.
#[test]
fn size_and_place() {
    let mut chance = Chance(11);
    let (mut valid, mut invalid) = (0, 0);
    for round in 0..400 {
        let n = 1 + round % 2;
        let noise = chance.between(0.2, 0.6);
        let coarse = |p: DVec3| (p * 1024.0).round() / 1024.0;
        let mut points: Vec<DVec3> = cube(n).into_iter().map(|p| coarse(p + chance.point(noise))).collect();
        if round % 3 == 0 {
            points[1] = points[0];
        }
        let weights: Vec<f64> = points.iter().map(|_| (1 + chance.below(8)) as f64 / 4.0).collect();
        let verdicts =
            |points: &[DVec3]| (hexahedron(points, n), rational(&homogeneous(points, &weights), n));
        let kind = |v: &JacobianVerdict| match v {
            JacobianVerdict::Invalid { witness, .. } => format!("invalid at {witness:?}"),
            other => format!("{other:?}"),
        };
        let kinds = |points: &[DVec3]| {
            let (a, b) = verdicts(points);
            (kind(&a), kind(&b))
        };
        let plain = kinds(&points);
        if plain.0.starts_with("invalid") {
            invalid += 1
        } else {
            valid += 1
        }
        for size in [1e-6, 1e-3, 1e3, 1e6] {
            let scaled: Vec<DVec3> = points.iter().map(|&p| p * size).collect();
            assert_eq!(kinds(&scaled), plain, "size {size}, round {round}");
        }
        let far = DVec3::new(1e6, -1e6, 1e6);
        let moved: Vec<DVec3> = points.iter().map(|&p| p + far).collect();
        assert_eq!(kinds(&moved), plain, "far away, round {round}");
        // Weights of one sign: the sign does not matter.
        let negative: Vec<DVec4> = homogeneous(&points, &weights).iter().map(|&p| -1e-4 * p).collect();
        assert_eq!(kind(&rational(&negative, n)), plain.1, "round {round}");
    }
    assert!(valid > 50 && invalid > 50, "{valid} {invalid}");
}

/// Determinants below and above the range of numbers keep their signs.
#[test]
fn sizes_at_the_ends_of_the_range() {
    for size in [1e-130, 1e-100, 1e100, 1e139] {
        let points: Vec<DVec3> = cube(1).iter().map(|&p| p * size).collect();
        assert_eq!(hexahedron(&points, 1), JacobianVerdict::Positive);
        let lifted: Vec<DVec4> = points.iter().map(|p| p.extend(1.0)).collect();
        assert_eq!(rational(&lifted, 1), JacobianVerdict::Positive);
        let mirrored: Vec<DVec3> = points.iter().map(|p| DVec3::new(-p.x, p.y, p.z)).collect();
        let lifted: Vec<DVec4> = mirrored.iter().map(|p| p.extend(1.0)).collect();
        for verdict in [hexahedron(&mirrored, 1), rational(&lifted, 1)] {
            assert!(
                matches!(verdict, JacobianVerdict::Invalid { value, .. } if value < 0.0 && value.is_finite())
            );
        }
    }
}

#[test]
fn weights_with_zeros() {
    // 1 at all corners but −1 in the middle of an edge: zero on the way there.
    let index = |p: usize| [p / 9, p / 3 % 3, p % 3];
    let weights: Vec<f64> = (0..27).map(|p| if index(p) == [0, 1, 0] { -3.0 } else { 1.0 }).collect();
    let points = homogeneous(&cube(2), &weights);
    let net = SolidNet::Hexahedron { points: &points, degrees: [2; 3] };
    let Err(SolidError::WeightZero { at }) = jacobian_verdict(&net, DEFAULT_OPERATIONS) else { panic!() };
    // On that edge the weight is 1 − 8v(1 − v).
    let [u, v, w] = at;
    let bump = |t: f64, i: usize| [(1.0 - t).powi(2), 2.0 * t * (1.0 - t), t * t][i];
    assert!((1.0 - 4.0 * bump(u, 0) * bump(v, 1) * bump(w, 0)).abs() < 1e-12, "{at:?}");
    // A negative coefficient alone is no zero: 1 − 1.5·2v(1 − v) > 0.
    let weights: Vec<f64> = (0..27).map(|p| if index(p) == [0, 1, 0] { -0.5 } else { 1.0 }).collect();
    let mut weighted = homogeneous(&cube(2), &weights);
    weighted[3] = DVec4::new(0.0, 1.0, 0.0, -0.5);
    let net = SolidNet::Hexahedron { points: &weighted, degrees: [2; 3] };
    assert!(jacobian_verdict(&net, DEFAULT_OPERATIONS).is_ok());
}

#[test]
fn what_is_refused_and_what_is_left_open() {
    let mut points = cube(1);
    points[3].y = f64::NAN;
    let net = SolidNet::Hexahedron { points: &points, degrees: [1; 3] };
    let refused = jacobian_verdict(&net, DEFAULT_OPERATIONS);
    assert!(matches!(refused, Err(SolidError::Shape(ShapeError::Coordinate { place: 3, axis: 1, .. }))));
    let net = SolidNet::Wedge { points: &points[..5], degrees: [1, 1] };
    let refused = jacobian_verdict(&net, DEFAULT_OPERATIONS);
    assert_eq!(refused, Err(SolidError::NetLength { needed: 6, given: 5 }));

    // x = (u − ⅓)³ + …: det J touches zero on a plane inside, which no number of operations decides.
    let third: f64 = 1.0 / 3.0;
    let in_u = [
        -third.powi(3),
        third.powi(2) * (1.0 - third),
        -third * (1.0 - third).powi(2),
        (1.0 - third).powi(3),
    ];
    let points: Vec<DVec3> =
        (0..16).map(|p| DVec3::new(in_u[p / 4], (p / 2 % 2) as f64, (p % 2) as f64)).collect();
    let net = SolidNet::Hexahedron { points: &points, degrees: [3, 1, 1] };
    for operations in [0, 1_000_000, 10_000_000] {
        let verdict = jacobian_verdict(&net, operations).unwrap();
        let JacobianVerdict::Undecided { near: [u, ..], least, largest } = verdict else {
            panic!("{verdict:?}")
        };
        assert!(least <= 0.0 && largest > 0.0);
        assert!(operations == 0 || (u - third).abs() < 1e-3, "{u}");
    }
}
