//! The coordinates belong to the shape, not to where it lies, how large it is or where its numbering begins.

use casteljau_domain::glam::{DVec2, dvec2};
use casteljau_domain::{Coordinates, HarmonicOptions, Polygon};

use crate::shapes::{plain, points, rows};
use crate::support::Random;

fn harmonic(vertices: Vec<DVec2>) -> Coordinates {
    Coordinates::harmonic(Polygon::new(vertices).unwrap(), &HarmonicOptions::default()).unwrap()
}

/// Both are within their certificates of the truth; the moved points are rounded, which at the distance r of a corner
/// of angle ω changes values by u·reach·r^(π/ω−1)/size: below 1e-11 for the points and motions here.
fn same(name: &str, a: &[f64], b: &[f64], first: &Coordinates, second: &Coordinates) {
    let slack = first.certificate() + second.certificate() + 1e-11;
    for (x, y) in a.iter().zip(b) {
        assert!((x - y).abs() <= slack, "{name}: {x} and {y} differ by {:e} > {slack:e}", (x - y).abs());
    }
}

#[test]
fn motions_and_scales_change_nothing() {
    let mut random = Random(31);
    for (name, polygon) in plain() {
        let plain = harmonic(polygon.vertices().to_vec());
        for (scale, turn, shift) in [
            (1e-6, 0.3, dvec2(0.0, 0.0)),
            (1e6, -2.0, dvec2(3e5, -1e6)),
            (1.0, 1.0, dvec2(100.0, -30.0)),
            (1e-3, 0.0, dvec2(0.0, 0.01)),
        ] {
            let map = |p: DVec2| DVec2::from_angle(turn).rotate(p) * scale + shift;
            let moved = harmonic(polygon.vertices().iter().map(|p| map(*p)).collect());
            for p in points(&mut random, &polygon, 40) {
                same(name, &rows(&plain, p, 0), &rows(&moved, map(p), 0), &plain, &moved);
            }
        }
        // A power of two is exact throughout, and derivatives scale with it.
        let doubled = harmonic(polygon.vertices().iter().map(|p| *p * 1024.0).collect());
        for p in points(&mut random, &polygon, 10) {
            let (a, b) = (rows(&plain, p, 2), rows(&doubled, p * 1024.0, 2));
            let order = |k: usize| [0, 1, 1, 2, 2, 2][k / polygon.len()];
            for (k, (a, b)) in a.iter().zip(&b).enumerate() {
                assert_eq!(*a, b * 1024f64.powi(order(k)), "{name} {p}");
            }
        }
    }
}

#[test]
fn numbering_and_orientation_change_nothing() {
    let mut random = Random(32);
    for (name, polygon) in plain() {
        let n = polygon.len();
        let plain = harmonic(polygon.vertices().to_vec());
        let turned: Vec<Coordinates> = (1..n)
            .step_by(2)
            .map(|by| {
                let mut vertices = polygon.vertices().to_vec();
                vertices.rotate_left(by);
                harmonic(vertices)
            })
            .collect();
        let reversed = harmonic(polygon.vertices().iter().rev().copied().collect());
        let mirrored = harmonic(polygon.vertices().iter().map(|p| *p * dvec2(-1.0, 1.0)).collect());
        for p in points(&mut random, &polygon, 40) {
            let wanted = rows(&plain, p, 0);
            for (k, turned) in turned.iter().enumerate() {
                let mut row = rows(turned, p, 0);
                row.rotate_right(2 * k + 1);
                same(name, &wanted, &row, &plain, turned);
            }
            let mut row = rows(&reversed, p, 0);
            row.reverse();
            same(name, &wanted, &row, &plain, &reversed);
            same(name, &wanted, &rows(&mirrored, p * dvec2(-1.0, 1.0), 0), &plain, &mirrored);
        }
        // Gradients turn with the mirror.
        let p = points(&mut random, &polygon, 1)[0];
        let (a, b) = (rows(&plain, p, 2), rows(&mirrored, p * dvec2(-1.0, 1.0), 2));
        let r = crate::shapes::clearance(&polygon, p);
        let both = plain.certificate() + mirrored.certificate();
        for (row, sign) in [1.0, -1.0, 1.0, 1.0, -1.0, 1.0].into_iter().enumerate() {
            for j in 0..n {
                let slack =
                    (both + 1e-11) * [1.0, 1.3, 1.3, 2.6, 2.6, 2.6][row] / r.powi([0, 1, 1, 2, 2, 2][row]);
                let error = (a[row * n + j] - sign * b[row * n + j]).abs();
                assert!(error <= slack, "{name} {p} row {row}: {error:e} of {slack:e}");
            }
        }
    }
}
