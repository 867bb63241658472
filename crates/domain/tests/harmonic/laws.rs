//! Identities that hold at every point inside.

use casteljau_domain::glam::DVec2;
use casteljau_domain::{Coordinates, HarmonicOptions};

use crate::shapes::{Solved, clearance, hard_solved, plain, plain_solved, points, rows};
use crate::support::Random;

fn all() -> impl Iterator<Item = &'static Solved> {
    plain_solved().iter().chain(hard_solved())
}

#[test]
fn values_are_a_convex_combination_that_reproduces_the_point() {
    let mut random = Random(21);
    for Solved { name, coordinates: c, .. } in all() {
        let (polygon, n) = (c.polygon(), c.len());
        let size = polygon.diameter();
        for p in points(&mut random, polygon, 120) {
            let row = rows(c, p, 0);
            let bound = c.certificate();
            assert!(row.iter().all(|l| (-bound..=1.0 + bound).contains(l)), "{name} {p}: {row:?}");
            let sum: f64 = row.iter().sum();
            assert!((sum - 1.0).abs() <= 1e-12, "{name} {p}: sum off by {:e}", sum - 1.0);
            let q: DVec2 = (0..n).map(|i| polygon.vertex(i) * row[i]).sum();
            assert!(q.distance(p) <= 1e-12 * size, "{name} {p}: off by {:e}", q.distance(p));
        }
    }
}

/// Derivative rows differentiate the same identities; their rounding is relative to the largest entry.
#[test]
fn derivative_rows_reproduce_and_are_harmonic() {
    let mut random = Random(22);
    for Solved { name, coordinates: c, .. } in all() {
        let (polygon, n) = (c.polygon(), c.len());
        let size = polygon.diameter();
        for p in points(&mut random, polygon, 60) {
            let out = rows(c, p, 2);
            assert!(out.iter().all(|x| x.is_finite()), "{name} {p}");
            for (row, moment) in
                [DVec2::X, DVec2::Y, DVec2::ZERO, DVec2::ZERO, DVec2::ZERO].into_iter().enumerate()
            {
                let row = &out[(row + 1) * n..][..n];
                let scale = row.iter().fold(1.0 / size, |m: f64, x| m.max(x.abs()));
                let sum: f64 = row.iter().sum();
                assert!(sum.abs() <= 1e-12 * scale, "{name} {p}: sum {sum:e} of {scale:e}");
                let q: DVec2 = (0..n).map(|i| polygon.vertex(i) * row[i]).sum();
                assert!(q.distance(moment) <= 1e-12 * (1.0 + scale * size), "{name} {p}: {q} for {moment}");
            }
            for i in 0..n {
                assert_eq!(out[3 * n + i] + out[5 * n + i], 0.0, "{name} {p}: Laplacian");
            }
            // Lower orders have the same numbers.
            assert_eq!(rows(c, p, 1), out[..3 * n], "{name} {p}: orders 1 and 2");
            assert_eq!(rows(c, p, 0), out[..n], "{name} {p}: orders 0 and 2");
        }
    }
}

/// Differences of order 8 over the step h = r/100, r the distance to the boundary. Their truncation is
/// h⁸/630·9!·(4/π)/r⁹ < 1e-13/r by the bound on the derivatives of harmonic functions within [0, 1]; an error of the
/// values, where a chord is crossed at most the certificate, is enlarged by Σ|cₖ|/h < 200/r.
#[test]
fn derivatives_agree_with_differences() {
    const STENCIL: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let mut random = Random(23);
    for (name, polygon) in plain() {
        let c = Coordinates::harmonic(polygon, &HarmonicOptions::high_accuracy()).unwrap();
        let n = c.len();
        let mut worst = 0.0_f64;
        for p in points(&mut random, c.polygon(), 60) {
            let r = clearance(c.polygon(), p);
            let size = c.polygon().diameter();
            if r < 1e-4 * size {
                continue;
            }
            let h = 0.01 * r;
            let difference = |axis: DVec2, row: usize, j: usize| -> f64 {
                let value = |s: f64| rows(&c, p + axis * (s * h), 1)[row * n + j];
                let terms = STENCIL.iter().zip(1..);
                terms.map(|(w, k)| w * (value(f64::from(k)) - value(-f64::from(k)))).sum::<f64>() / h
            };
            let out = rows(&c, p, 2);
            let noise = 200.0 * (c.certificate() + f64::EPSILON * size / r) + 1e-12;
            let pairs = [
                (1, DVec2::X, 0),
                (2, DVec2::Y, 0),
                (3, DVec2::X, 1),
                (4, DVec2::Y, 1),
                (4, DVec2::X, 2),
                (5, DVec2::Y, 2),
            ];
            for (row, axis, from) in pairs {
                // First derivatives of values in [0, 1] are below (4/π)/r, and their noise scales alike.
                let slack = if from == 0 { noise / r } else { 2.0 * noise / (r * r) };
                for j in [0, n / 2, n - 1] {
                    let error = (out[row * n + j] - difference(axis, from, j)).abs();
                    assert!(error <= slack, "{name} {p} row {row}: {error:e} of {slack:e}");
                    worst = worst.max(error / slack);
                }
            }
        }
        println!("{name:28} {worst:.1e} of the tolerance, certificate {:.1e}", c.certificate());
    }
}

#[test]
fn repetition_and_batches_change_no_bit() {
    let mut random = Random(24);
    let bits = |v: &[f64]| v.iter().map(|x| x.to_bits()).collect::<Vec<u64>>();
    for (name, polygon) in plain() {
        let options = HarmonicOptions::default();
        let first = Coordinates::harmonic(polygon.clone(), &options).unwrap();
        let second = std::thread::scope(|scope| {
            scope.spawn(|| Coordinates::harmonic(polygon.clone(), &options).unwrap()).join().unwrap()
        });
        assert_eq!(first.certificate().to_bits(), second.certificate().to_bits(), "{name}");
        let points = points(&mut random, &polygon, 41);
        for order in 0..3 {
            let stride = first.stride(order);
            let mut whole = vec![0.0; points.len() * stride];
            first.evaluate(&points, order, &mut whole).unwrap();
            let mut again = vec![f64::NAN; points.len() * stride];
            second.evaluate(&points, order, &mut again).unwrap();
            assert_eq!(bits(&whole), bits(&again), "{name} order {order}");
            for size in [1, 2, 3, 7, 16] {
                let mut parts = vec![f64::NAN; points.len() * stride];
                for (p, out) in points.chunks(size).zip(parts.chunks_mut(size * stride)) {
                    first.evaluate_inside(p, order, out).unwrap();
                }
                assert_eq!(bits(&whole), bits(&parts), "{name} order {order}, batches of {size}");
            }
        }
    }
    // Cut into cells, too.
    let Some(cut) = hard_solved().iter().find(|s| s.name == "slot 1/30") else { panic!("the slot failed") };
    let again =
        Coordinates::harmonic(cut.coordinates.polygon().clone(), &HarmonicOptions::default()).unwrap();
    for p in points(&mut random, again.polygon(), 50) {
        assert_eq!(bits(&rows(&cut.coordinates, p, 2)), bits(&rows(&again, p, 2)), "{p}");
    }
}
