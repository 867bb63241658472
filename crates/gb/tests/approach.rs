//! Harmonic patches approached from inside: beside sides and around corners, down to rounding.
#![allow(clippy::panic, clippy::unwrap_used)]

mod common;

use casteljau_domain::HarmonicOptions;
use casteljau_gb::glam::DVec2;
use casteljau_gb::{ConcavePatch, Coordinates, Location, Polygon};
use common::*;

/// Distances from the boundary, in units of the polygon's diameter.
const GAPS: [f64; 7] = [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13, 1e-14];
/// Slope of λ per diameter away from corners, for the polygons below: measured, the surface uses a fifth of what it allows.
const SLOPE: f64 = 2.0;
/// Rounding of points, in units of the model's size.
const ROUNDING: f64 = 1e-13;

fn polygon(vertices: &[[f64; 2]]) -> Polygon {
    Polygon::new(vertices.iter().map(|&v| DVec2::from(v)).collect()).unwrap()
}

/// A U with two concave corners, its slot a sixth of its width.
fn u_shape() -> Polygon {
    polygon(&[[0., 0.], [3., 0.], [3., 2.], [1.75, 2.], [1.75, 0.8], [1.25, 0.7], [1.2, 2.2], [0., 2.]])
}

/// Radii drawn at random around a centre: simple, and concave at about a third of the corners.
fn star(n: usize, random: &mut Random) -> Polygon {
    let vertex = |i: usize| {
        let angle = (i as f64 + 0.3 * random.number()) / n as f64 * std::f64::consts::TAU;
        DVec2::from_angle(angle) * (1.0 + 0.5 * random.number())
    };
    Polygon::new((0..n).map(vertex).collect()).unwrap()
}

/// Places just inside, the point of the boundary that each approaches, and the distance from it.
fn approaches(domain: &Polygon) -> Vec<(DVec2, Location, f64)> {
    let n = domain.len();
    let turn = domain.signed_area().signum();
    let mut places = Vec::new();
    for side in 0..n {
        let [a, b] = domain.side(side);
        let inward = (b - a).perp().normalize() * turn;
        for gap in GAPS {
            let distance = gap * domain.diameter();
            for near in GAPS.into_iter().chain([0.1, 0.3, 0.5]) {
                for t in [near, 1.0 - near] {
                    places.push((a.lerp(b, t) + inward * distance, Location::Side { side, t }, distance));
                }
            }
            let leaving = domain.side((side + 1) % n)[1] - b;
            for share in [0.01, 0.3, 0.5, 0.7, 0.99] {
                let angle = domain.interior_angle(side) * share * turn;
                let direction = DVec2::from_angle(angle).rotate(leaving.normalize());
                places.push((b + direction * distance, Location::Corner(side), distance));
            }
        }
    }
    places.retain(|(uv, ..)| matches!(domain.locate(*uv), Location::Inside(_)));
    places
}

/// Bound on how far λ changes over a distance, in units of the diameter, from a point of the boundary: toward a corner of
/// angle ω its gradient grows like r^(π/ω − 1), toward the others it stays bounded.
fn change(domain: &Polygon, at: Location, distance: f64) -> f64 {
    let n = domain.len();
    let growth = |corner: usize, away: f64| {
        away.powf((std::f64::consts::PI / domain.interior_angle(corner) - 1.0).min(0.0))
    };
    let slope = match at {
        Location::Side { side, t } => {
            let length = (domain.side(side)[1] - domain.side(side)[0]).length() / domain.diameter();
            growth((side + n - 1) % n, t * length + distance).max(growth(side, (1.0 - t) * length + distance))
        }
        Location::Corner(corner) => growth(corner, distance),
        _ => panic!("{at:?} is not on the boundary"),
    };
    SLOPE * slope * distance
}

/// The surface is within 4·max(d, 2l−1)·(certificate + change of λ)·size of the ribbon.
fn check(patch: &ConcavePatch, name: &str) {
    let domain = patch.domain();
    let size = patch.bounding_box().diagonal();
    let certificate = patch.coordinates().certificate();
    let degrees = patch.ribbons().iter().map(|r| r.degree().max(2 * r.layers() - 1));
    let factor = 4.0 * degrees.max().unwrap() as f64 * size;
    let mut decided = 0;
    for (uv, at, distance) in approaches(domain) {
        let expected = patch.point_at(at).unwrap();
        let found = patch.point(uv).unwrap();
        let change = change(domain, at, distance / domain.diameter());
        let error = found.distance(expected);
        let bound = factor * (certificate + change) + ROUNDING * size;
        assert!(error <= bound, "{name}: {at:?} at {distance:e}: {error:e} > {bound:e}");
        decided += usize::from(change < certificate);
    }
    // On a triangle the coordinates are exact, and nothing but rounding is left.
    assert!(
        decided > 0 || certificate < ROUNDING,
        "{name}: no place is near enough for the certificate to matter"
    );
}

fn patches(domain: &Polygon, name: &str) {
    for target in [1e-4, 1e-8] {
        let options = HarmonicOptions { target, limit: 1e-4 };
        let coordinates = Coordinates::harmonic(domain.clone(), &options).unwrap();
        for shapes in
            [vec![(3, 2)], vec![(1, 1)], vec![(5, 3), (2, 1), (4, 2)], vec![(20, 6), (1, 1), (3, 2)]]
        {
            for p in [1, 2, 3, 64] {
                let ribbons = shaken(ribbons_over(domain, &shapes), &mut Random(u64::from(p)));
                let patch = ConcavePatch::builder(ribbons)
                    .prepared_coordinates(coordinates.clone())
                    .blend_power(p)
                    .build()
                    .unwrap();
                check(&patch, &format!("{name}, {shapes:?}, p {p}, target {target:e}"));
            }
        }
    }
}

#[test]
fn an_l_and_a_u() {
    patches(&l_shape(), "L");
    patches(&u_shape(), "U");
    let clockwise = l_shape().vertices().iter().rev().copied().collect();
    patches(&Polygon::new(clockwise).unwrap(), "L, clockwise");
}

#[test]
fn polygons_drawn_at_random() {
    let mut random = Random(2018);
    for n in [3, 4, 5, 7, 9, 12] {
        let domain = star(n, &mut random);
        patches(&domain, &format!("{n} sides {:?}", domain.vertices()));
    }
}
