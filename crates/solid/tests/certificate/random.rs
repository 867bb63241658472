//! Verdicts by chance, each against the exact referee. `CASTELJAU_LONG=1` tries 100,000 solids.

use std::collections::BTreeMap;

use casteljau_solid::geom::glam::{DVec3, DVec4};
use casteljau_solid::shape::ControlPoint;
use casteljau_solid::{JacobianCoefficients, JacobianVerdict, SolidDegrees, SolidNet, jacobian_verdict};
use num_rational::BigRational;
use num_traits::Signed;

use crate::referee::{Determinant, Truth};
use crate::support::Chance;

const OPERATIONS: u64 = 5_000_000;

const KINDS: [SolidDegrees; 9] = [
    SolidDegrees::Hexahedron([1, 1, 1]),
    SolidDegrees::Tetrahedron(2),
    SolidDegrees::Wedge([1, 1]),
    SolidDegrees::Hexahedron([1, 1, 1]),
    SolidDegrees::Hexahedron([2, 1, 1]),
    SolidDegrees::Tetrahedron(3),
    SolidDegrees::Wedge([2, 1]),
    SolidDegrees::Tetrahedron(1),
    SolidDegrees::Hexahedron([2, 2, 2]),
];

/// The points of the unit cell, the solid whose det J is constant, times a factor for each axis.
fn cell(degrees: SolidDegrees, size: f64) -> Vec<DVec3> {
    let mut points = Vec::new();
    match degrees {
        SolidDegrees::Hexahedron([l, m, n]) => {
            for i in 0..=l {
                for j in 0..=m {
                    points.extend((0..=n).map(|k| DVec3::new(i as f64, j as f64, k as f64)));
                }
            }
        }
        SolidDegrees::Tetrahedron(n) => {
            for i in (0..=n).rev() {
                for j in (0..=n - i).rev() {
                    points.extend((0..=n - i - j).rev().map(|k| DVec3::new(i as f64, j as f64, k as f64)));
                }
            }
        }
        SolidDegrees::Wedge([n, o]) => {
            for i in (0..=n).rev() {
                for j in (0..=n - i).rev() {
                    points.extend((0..=o).map(|k| DVec3::new(i as f64, j as f64, k as f64)));
                }
            }
        }
    }
    points.into_iter().map(|p| p * size).collect()
}

fn judge<P: ControlPoint>(points: &[P], degrees: SolidDegrees) -> (JacobianVerdict, f64) {
    let net = match degrees {
        SolidDegrees::Hexahedron(degrees) => SolidNet::Hexahedron { points, degrees },
        SolidDegrees::Tetrahedron(degree) => SolidNet::Tetrahedron { points, degree },
        SolidDegrees::Wedge(degrees) => SolidNet::Wedge { points, degrees },
    };
    let coefficients = JacobianCoefficients::new(&net).unwrap();
    let largest = coefficients
        .values()
        .iter()
        .zip(coefficients.tolerances())
        .fold(0.0, |m: f64, (v, t)| m.max(v.abs() / t));
    (jacobian_verdict(&net, OPERATIONS).unwrap(), largest)
}

/// A solid by chance, barely valid or invalid in half of all rounds.
fn solid(chance: &mut Chance, round: usize) -> (Vec<DVec4>, SolidDegrees, bool) {
    let degrees = KINDS[round % KINDS.len()];
    let rational = chance.below(3) == 0;
    let style = chance.below(8);
    // Products with the weights are exact, so that points that coincide do so homogeneously too.
    let coarse = |p: DVec3| (p * 2_f64.powi(30)).round() * 2_f64.powi(-30);
    let mut points = match style {
        // On a small grid, where zeros are exact and many.
        0..=3 => {
            let size = [1.0, 2.0, 3.0, 4.0][style];
            let noise = 1 + chance.below(2);
            let mut points = cell(degrees, size);
            for p in &mut points {
                *p += chance.grid_point(noise);
            }
            points
        }
        _ => {
            let size = chance.between(0.1, 0.7);
            cell(degrees, 1.0).into_iter().map(|p| coarse(p + chance.point(size))).collect::<Vec<_>>()
        }
    };
    // Points that coincide.
    if chance.below(4) == 0 {
        for _ in 0..=chance.below(2) {
            let (a, b) = (chance.below(points.len()), chance.below(points.len()));
            points[a] = points[b];
        }
    }
    let weight = |chance: &mut Chance| match style {
        0..=3 => (1 + chance.below(3)) as f64,
        _ => (chance.between(16.0, 144.0)).round() / 64.0,
    };
    let lift = |points: &[DVec3], weights: &[f64]| -> Vec<DVec4> {
        points.iter().zip(weights).map(|(&p, &w)| (p * w).extend(w)).collect()
    };
    let weights: Vec<f64> = points.iter().map(|_| if rational { weight(chance) } else { 1.0 }).collect();
    if style >= 6 {
        // From a plain cell to this one: somewhere on the way the verdict changes. Stay near.
        let (start, end) = (cell(degrees, 1.0), points.clone());
        let at = |t: f64| -> Vec<DVec3> {
            start.iter().zip(&end).map(|(a, b)| coarse(*a + (*b - *a) * t)).collect()
        };
        let (mut low, mut high) = (0.0, 4.0);
        for _ in 0..5 + chance.below(25) {
            let middle = 0.5 * (low + high);
            let verdict = if rational {
                judge(&lift(&at(middle), &weights), degrees).0
            } else {
                judge(&at(middle), degrees).0
            };
            if verdict.is_valid() { low = middle } else { high = middle }
        }
        points = at(if chance.below(2) == 0 { low } else { high });
    }
    let points = lift(&points, &weights);
    (points, degrees, rational)
}

#[test]
fn no_verdict_is_wrong() {
    let long = std::env::var("CASTELJAU_LONG").is_ok_and(|v| v == "1");
    let rounds = if long { 100_000 } else { 2_400 };
    let mut chance = Chance(2024);
    let mut tally: BTreeMap<String, usize> = BTreeMap::new();
    for round in 0..rounds {
        let (points, degrees, rational) = solid(&mut chance, round);
        let (verdict, clear) = if rational {
            judge(&points, degrees)
        } else {
            judge(&points.iter().map(|p| p.truncate()).collect::<Vec<_>>(), degrees)
        };
        let exact = Determinant::new(&points, degrees, rational);
        let what = || format!("round {round}, {degrees:?}, rational {rational}, {verdict:?}, {points:?}");
        // At the witness the determinant is negative without any doubt.
        if let JacobianVerdict::Invalid { witness, value } = verdict {
            let at = witness.map(|x| BigRational::from_float(x).unwrap());
            if value < 0.0 {
                assert!(exact.polynomial.value(&at).is_negative(), "{}", what());
            } else {
                // Flat: zero, or below what rounding of the points makes.
                assert!(exact.truth(2) == Truth::Zero || clear <= 1.0, "{}", what());
            }
            *tally.entry(if value < 0.0 { "invalid" } else { "flat" }.into()).or_default() += 1;
            continue;
        }
        let truth = exact.truth(400);
        let name = match (&verdict, truth) {
            (JacobianVerdict::Positive, Truth::Positive) => "positive",
            (JacobianVerdict::PositiveExcept(features), Truth::NonNegative) => {
                for &feature in features {
                    assert!(exact.vanishes_on(feature), "{feature}: {}", what());
                }
                "positive except"
            }
            (JacobianVerdict::Undecided { .. }, Truth::NonNegative) => "undecided, touching zero",
            (JacobianVerdict::Undecided { .. }, Truth::Unknown) => "undecided by both",
            (JacobianVerdict::Undecided { .. }, Truth::Positive | Truth::Negative) => "undecided",
            (_, Truth::Unknown) => "referee undecided",
            _ => panic!("{truth:?}: {}", what()),
        };
        if name.contains("undecided") {
            println!("{name}: {}", what());
        }
        *tally.entry(name.into()).or_default() += 1;
    }
    println!("{tally:#?}");
    let count = |name: &str| tally.get(name).copied().unwrap_or(0);
    assert!(count("undecided") * 500 <= rounds, "{tally:?}");
    assert!(count("referee undecided") * 100 <= rounds, "{tally:?}");
    for name in ["positive", "positive except", "invalid"] {
        assert!(count(name) * 50 >= rounds, "{name}: {tally:?}");
    }
}
