//! Polygons drawn at random, nearly degenerate ones among them.

use std::f64::consts::TAU;

use casteljau_domain::glam::{DVec2, dvec2};
use casteljau_domain::{Coordinates, DomainError, HarmonicOptions, Polygon};

use crate::shapes::{Clock, long, points, residual};
use crate::support::{Random, convex, wild};

/// A ring of unevenly spread corners with mild radii: the usual domain of a patch.
fn mild(random: &mut Random, n: usize) -> Option<Polygon> {
    let corner = |i: usize, random: &mut Random| {
        let angle = (i as f64 + 0.7 * random.unit()) * TAU / n as f64;
        DVec2::from_angle(angle) * random.within(0.35, 1.0)
    };
    Polygon::new((0..n).map(|i| corner(i, random)).collect()).ok()
}

/// Corners on a small grid, so that collinear vertices, equal angles and touching features abound.
fn grid(random: &mut Random, n: usize) -> Option<Polygon> {
    let point = |r: &mut Random| dvec2(r.below(5) as f64, r.below(5) as f64);
    (0..200).find_map(|_| Polygon::new((0..n).map(|_| point(random)).collect()).ok())
}

/// A corner moved to within 1e-1 to 1e-14 of another side or corner.
fn squeezed(random: &mut Random, n: usize) -> Option<Polygon> {
    let polygon = mild(random, n)?;
    let mut vertices = polygon.vertices().to_vec();
    let (i, j) = (random.below(n), random.below(n));
    let [a, b] = polygon.side(j);
    let target = if random.below(2) == 0 { a } else { a.lerp(b, random.unit()) };
    vertices[i] = target.lerp(vertices[i], 10f64.powf(random.within(-14.0, -1.0)));
    Polygon::new(vertices).ok()
}

/// One in twelve is nearly degenerate in the normal run, since each of these takes seconds; one in four in the long one.
fn any(random: &mut Random) -> Option<(&'static str, Polygon)> {
    let n = 3 + random.below(6);
    let (kind, polygon) = match random.below(if long() { 8 } else { 24 }) {
        0 => ("wild", wild(random, n)),
        1 => ("squeezed", squeezed(random, n)),
        2 | 3 => ("grid", grid(random, n)),
        4 => ("convex", convex(random, n)),
        _ => ("mild", mild(random, n)),
    };
    Some((kind, polygon?))
}

#[test]
fn random_polygons_give_a_certified_result_or_a_typed_error() {
    let wanted = if long() { 5000 } else { 300 };
    let options = HarmonicOptions { target: 1e-6, limit: 1e-4 };
    let mut random = Random(51);
    let mut tally = std::collections::BTreeMap::new();
    let mut slowest = (0.0, String::new());
    let mut tried = 0;
    while tried < wanted {
        let Some((kind, polygon)) = any(&mut random) else { continue };
        tried += 1;
        let clock = Clock::start();
        let answer = Coordinates::harmonic(polygon.clone(), &options);
        let seconds = clock.seconds();
        if seconds > slowest.0 {
            slowest = (seconds, format!("{kind} {:?}", polygon.vertices()));
        }
        if seconds > 3.0 {
            let outcome = answer.as_ref().map(Coordinates::certificate);
            println!("{seconds:.1} s, {kind}, {outcome:?}: {:?}", polygon.vertices());
        }
        let (given, refused, time) = tally.entry(kind).or_insert((0, 0, 0.0));
        *time += seconds;
        match answer {
            Ok(c) => {
                *given += 1;
                assert!(c.certificate() <= options.limit);
                let (worst, side, t) = residual(&c, &mut random, 200);
                let certificate = c.certificate();
                assert!(worst <= certificate, "{worst:e} > {certificate:e}, side {side} at {t}: {polygon:?}");
                let points = points(&mut random, &polygon, 20);
                let mut out = vec![f64::NAN; points.len() * c.stride(2)];
                c.evaluate(&points, 2, &mut out).unwrap();
                assert!(out.iter().all(|x| x.is_finite()), "{polygon:?}");
                for row in out.chunks_exact(c.stride(2)) {
                    let least = row[..c.len()].iter().copied().fold(f64::INFINITY, f64::min);
                    assert!(least >= -certificate, "{least:e}: {polygon:?}");
                }
            }
            Err(DomainError::HarmonicAccuracy { reached, limit }) => {
                *refused += 1;
                assert!(reached > limit, "{polygon:?}");
                assert!(!matches!(kind, "mild"), "reached {reached:e} on a mild polygon: {polygon:?}");
            }
            Err(other) => panic!("{other}: {polygon:?}"),
        }
    }
    for (kind, (given, refused, seconds)) in tally {
        println!("{kind:10} {given:5} given, {refused:4} refused, {seconds:7.2} s");
    }
    println!("slowest {:.2} s: {}", slowest.0, slowest.1);
    assert!(slowest.0 < 60.0, "{} s for {}", slowest.0, slowest.1);
}
