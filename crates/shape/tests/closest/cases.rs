//! Ten thousand random cases of curves and as many of patches: nothing found by brute force is closer, and the
//! certified bound is below it.

use casteljau_shape::geom::UNIT_ROUNDOFF;
use casteljau_shape::geom::glam::DVec3;

use crate::brute::{Net, curve, patch};
use crate::random::Random;

const SHAPES: usize = 500;
const QUERIES: usize = 20;

/// Difficult nets of the given degrees, in turns.
pub fn net(random: &mut Random, kind: usize, degrees: [usize; 2]) -> Net {
    let [m, n] = degrees;
    let count = (m + 1) * (n + 1);
    let mut points: Vec<DVec3> = (0..count).map(|_| random.point()).collect();
    let mut weights = vec![1.0; count];
    let grid = |place: usize| {
        DVec3::new((place / (n + 1)) as f64 / m as f64, (place % (n + 1)) as f64 / n.max(1) as f64, 0.0)
    };
    match kind {
        0 => {}
        1 => points = points.iter().enumerate().map(|(k, p)| grid(k) + 0.3 * p).collect(), // like a surface
        2 => weights.iter_mut().for_each(|w| *w = random.spread(-3.0, 3.0)),
        3 => {
            // Cusps: points that repeat, and lines that turn back.
            for k in 1..count {
                match random.below(3) {
                    0 => points[k] = points[k - 1],
                    1 if k > 1 => points[k] = points[k - 2],
                    _ => {}
                }
            }
        }
        4 => {
            // A side that is a point.
            for k in 0..=n {
                points[k] = points[0];
            }
            weights.iter_mut().for_each(|w| *w = random.spread(-1.0, 1.0));
        }
        5 => points.iter_mut().for_each(|p| p.z = 0.0),
        6 => {
            // Symmetric in u: minima come in pairs.
            for k in 0..count {
                let (i, j) = (k / (n + 1), k % (n + 1));
                if 2 * i > m {
                    let p = points[(m - i) * (n + 1) + j];
                    points[k] = DVec3::new(-p.x, p.y, p.z);
                } else if 2 * i == m {
                    points[k].x = 0.0;
                }
            }
        }
        _ => points.iter_mut().for_each(|p| *p = DVec3::splat(p.x)), // back and forth on a line
    }
    Net { degrees, points: points.iter().zip(weights).map(|(p, w)| (*p * w).extend(w)).collect() }
}

/// A query near, on, or far from the net.
fn query(random: &mut Random, net: &Net) -> DVec3 {
    let at = [random.unit(), random.unit()];
    match random.below(6) {
        0 => net.point(at),
        1 => net.point(at.map(f64::round)),
        2 => net.point(at) + 1e-6 * random.point(),
        3 => 1e6 * random.point(),
        _ => 2.0 * random.point(),
    }
}

/// What rounding makes of a distance, measured by us and by brute force: points are within `4(d+2)·u` of their
/// scale each, distances within some u of that of the query.
fn slack(net: &Net, q: DVec3) -> f64 {
    let degree = (net.degrees[0] + net.degrees[1] + 2) as f64;
    8.0 * degree * UNIT_ROUNDOFF * (net.largest() + q.abs().max_element())
}

#[derive(Default)]
struct Tally {
    cases: usize,
    /// Cases with a larger gap between distance and bound than is stated.
    open: usize,
}

impl Tally {
    /// Judges one answer; `scale` is the size of the numbers.
    fn judge(&mut self, net: &Net, q: DVec3, distance: f64, lower_bound: f64, what: &str) {
        let brute = net.least_distance(q);
        let slack = slack(net, q);
        assert!(distance <= brute + slack, "{what}: {distance:e}, brute force {brute:e}, {q} {net:?}");
        assert!(lower_bound <= brute, "{what}: bound {lower_bound:e} above {brute:e}, {q} {net:?}");
        assert!(lower_bound <= distance);
        self.cases += 1;
        // The stated resolution, 100(d+2)·u: a few weights apart make it worse only near the ends.
        let degree = (net.degrees[0] + net.degrees[1] + 2) as f64;
        let resolution = 100.0 * degree * UNIT_ROUNDOFF * (net.largest() + distance);
        if distance - lower_bound > resolution {
            println!("{what}: open by {:.1e} at {distance:e}, {q}", distance - lower_bound);
            self.open += 1;
            assert!(distance - lower_bound < 1e-2 * (net.largest() + distance));
        }
    }
}

#[test]
fn patches() {
    let mut random = Random::new(1);
    let (mut tally, mut folded) = (Tally::default(), Tally::default());
    for shape in 0..SHAPES {
        let degrees = [1 + random.below(4), 1 + random.below(4)];
        let scale = if shape % 3 == 0 { random.spread(-6.0, 6.0) } else { 1.0 };
        let kind = if shape % 8 == 7 && shape % 80 != 7 { 1 } else { shape % 8 };
        let net = net(&mut random, kind, degrees);
        let shift = random.point() * if shape % 5 == 0 { 100.0 } else { 0.0 };
        let moved = net.transformed(scale, shift * scale);
        let projector = patch(degrees, &moved.points);
        for _ in 0..QUERIES {
            let q = (query(&mut random, &net) + shift) * scale;
            let answer = projector.closest_point(q).unwrap();
            assert_eq!(answer, projector.closest_point(q).unwrap());
            assert_eq!(answer.point, moved.point(answer.parameters));
            // A patch on a line has whole curves of closest points; only the others promise a small gap.
            let tally = if kind == 7 { &mut folded } else { &mut tally };
            tally.judge(&moved, q, answer.distance, answer.lower_bound, &format!("patch {shape}"));
        }
    }
    println!(
        "{} patch cases, {} open; {} on lines, {} open",
        tally.cases, tally.open, folded.cases, folded.open
    );
    assert!(
        tally.cases + folded.cases == 10_000 && tally.open <= 200,
        "{} of {} open",
        tally.open,
        tally.cases
    );
}

#[test]
fn curves() {
    let mut random = Random::new(2);
    let mut tally = Tally::default();
    for shape in 0..SHAPES {
        let degrees = [1 + random.below(8), 0];
        let scale = if shape % 3 == 0 { random.spread(-6.0, 6.0) } else { 1.0 };
        let net = net(&mut random, shape % 8, degrees);
        let moved = net.transformed(scale, DVec3::ZERO);
        let projector = curve(&moved.points);
        for _ in 0..QUERIES {
            let q = query(&mut random, &net) * scale;
            let answer = projector.closest_point(q).unwrap();
            assert_eq!(answer, projector.closest_point(q).unwrap());
            tally.judge(&moved, q, answer.distance, answer.lower_bound, &format!("curve {shape}"));
        }
    }
    println!("{} curve cases, {} open", tally.cases, tally.open);
    assert!(tally.cases == 10_000 && tally.open == 0, "{} of {} open", tally.open, tally.cases);
}

/// From a start that is nearly right Newton's method comes to the same point.
#[test]
fn good_starts_converge() {
    let mut random = Random::new(3);
    let mut converged = 0;
    for shape in 0..100 {
        let degrees = [3, 3];
        let net = net(&mut random, shape % 3, degrees);
        let projector = patch(degrees, &net.points);
        for _ in 0..10 {
            let q = query(&mut random, &net);
            let global = projector.closest_point(q).unwrap();
            let near = global.parameters.map(|x| x + random.between(-1e-4, 1e-4));
            let local = projector.closest_point_from(q, near).unwrap();
            if local.converged {
                converged += 1;
                assert!(local.distance <= global.distance + slack(&net, q), "{local:?} {global:?}");
            }
            assert!(
                local.distance <= net.point(near.map(|x| x.clamp(0.0, 1.0))).distance(q) + slack(&net, q)
            );
        }
    }
    assert!(converged > 950, "{converged} of 1000");
}
