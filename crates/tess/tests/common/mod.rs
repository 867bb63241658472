//! Patches to tessellate.
#![allow(dead_code, clippy::unwrap_used)]

pub mod solids;

use std::path::PathBuf;

use casteljau_domain::layout;
use casteljau_gb::glam::{DVec2, DVec3, dvec2, dvec3};
use casteljau_gb::{CenterWeight, ConcavePatch, CoordinateKind, LayoutKind, Polygon, Ribbon};

pub fn polygon(vertices: &[(f64, f64)]) -> Polygon {
    Polygon::new(vertices.iter().map(|&(x, y)| dvec2(x, y)).collect()).unwrap()
}

pub fn l_polygon() -> Polygon {
    polygon(&[(0., 0.), (2., 0.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)])
}

pub fn u_polygon() -> Polygon {
    polygon(&[(0., 0.), (3., 0.), (3., 3.), (2., 3.), (2., 1.), (1., 1.), (1., 3.), (0., 3.)])
}

/// Five-pointed star.
pub fn star_polygon() -> Polygon {
    let at = |i: usize| {
        DVec2::from_angle(i as f64 * std::f64::consts::PI / 5.0)
            * if i.is_multiple_of(2) { 1.0 } else { 0.45 }
    };
    Polygon::new((0..10).map(at).collect()).unwrap()
}

/// A gently curved surface over the plane.
pub fn lifted(p: DVec2) -> DVec3 {
    dvec3(p.x + 0.05 * p.y * p.y, p.y - 0.03 * p.x * p.y, 0.25 * (1.1 * p.x + 0.4).sin() + 0.1 * p.x * p.y)
}

/// Cubic ribbons of two layers over the sides of a polygon, whose layers lean along the neighbouring sides.
pub fn ribbons_over(polygon: &Polygon, lift: &dyn Fn(DVec2) -> DVec3) -> Vec<Ribbon> {
    let n = polygon.len();
    let v = |i: usize| polygon.vertices()[i % n];
    (0..n)
        .map(|i| {
            let (a, b) = (v(i + n - 1), v(i));
            let sign = |corner: usize| if polygon.is_concave(corner % n) { -1.0 } else { 1.0 };
            let before = (v(i + n - 2) - a) * sign(i + n - 1);
            let after = (v(i + 1) - b) * sign(i);
            let row = |k: f64| {
                (0..4).map(move |j| {
                    let s = j as f64 / 3.0;
                    lift(a.lerp(b, s) + before.lerp(after, s) * (k / 3.0))
                })
            };
            Ribbon::new(3, 2, row(0.0).chain(row(1.0)).collect()).unwrap()
        })
        .collect()
}

pub fn patch_over(polygon: Polygon) -> ConcavePatch {
    let ribbons = ribbons_over(&polygon, &lifted);
    ConcavePatch::builder(ribbons).domain(polygon).coordinates(CoordinateKind::Harmonic).build().unwrap()
}

/// The cubic between two corners of the cube [-1, 1]³, bulging outward, the same from both ends.
fn cube_edge(a: DVec3, b: DVec3) -> [DVec3; 4] {
    let bulge = (a + b) * 0.15 + a.cross(b) * 0.03;
    [a, a.lerp(b, 1.0 / 3.0) + bulge, a.lerp(b, 2.0 / 3.0) + bulge, b]
}

/// A closed body of six four-sided patches with curved sides, outside out.
///
/// Every second patch stores its sides from another corner on, so shared sides meet in all ways.
pub fn cube() -> Vec<ConcavePatch> {
    let x = |i: usize| if i & 1 == 0 { -1.0 } else { 1.0 };
    let corner = |i: usize| dvec3(x(i), x(i >> 1), x(i >> 2));
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    faces
        .iter()
        .enumerate()
        .map(|(f, face)| {
            let at = |i: usize| corner(face[(i + f) % 4]);
            let ribbons = (0..4)
                .map(|i| {
                    let (a, b) = (at(i + 3), at(i));
                    // One direction along each edge of the cube, so that both faces have the same points.
                    let forward = a.to_array().partial_cmp(&b.to_array()) == Some(std::cmp::Ordering::Less);
                    let mut side = if forward { cube_edge(a, b) } else { cube_edge(b, a) };
                    if !forward {
                        side.reverse();
                    }
                    let center = (at(0) + at(1) + at(2) + at(3)) * 0.45;
                    let second = side.map(|p| p.lerp(center, 0.3));
                    Ribbon::new(3, 2, side.into_iter().chain(second).collect()).unwrap()
                })
                .collect();
            ConcavePatch::builder(ribbons)
                .layout(LayoutKind::Regular)
                .coordinates(CoordinateKind::Harmonic)
                .build()
                .unwrap()
        })
        .collect()
}

/// Two patches over the same polygon that share all sides: one above, one below.
pub fn pillow(polygon: &Polygon) -> [ConcavePatch; 2] {
    let above = ribbons_over(polygon, &|p| lifted(p));
    let n = above.len();
    let top: Vec<Ribbon> = above.iter().map(|r| raised(r, 0.3)).collect();
    let bottom: Vec<Ribbon> = (0..n).map(|i| raised(&above[(2 * n - 1 - i) % n].reversed(), -0.3)).collect();
    // Reversed side i now starts at vertex i and ends at vertex i − 1; the vertices run backwards.
    let vertices: Vec<DVec2> = (0..n).map(|i| polygon.vertices()[(2 * n - 2 - i) % n]).collect();
    let mirrored = vertices.iter().map(|p| dvec2(-p.x, p.y)).collect();
    let build = |ribbons, domain| {
        ConcavePatch::builder(ribbons).domain(domain).coordinates(CoordinateKind::Harmonic).build().unwrap()
    };
    [build(top, polygon.clone()), build(bottom, Polygon::new(mirrored).unwrap())]
}

/// The ribbon with its second layer moved along z.
fn raised(ribbon: &Ribbon, by: f64) -> Ribbon {
    let mut moved = ribbon.clone();
    for j in 0..=ribbon.degree() {
        moved.set_point(j, 1, ribbon.point(j, 1).unwrap() + DVec3::Z * by).unwrap();
    }
    moved
}

/// A model beside the project, if there is one.
pub fn shared_model(name: &str) -> Option<ConcavePatch> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/models").join(name);
    let Ok(text) = std::fs::read_to_string(&path) else {
        println!("{} is absent", path.display());
        return None;
    };
    let mut numbers = text.split_whitespace().map(|word| word.parse::<f64>().unwrap());
    let mut next = || numbers.next().unwrap();
    let weight = [CenterWeight::Deficiency, CenterWeight::None, CenterWeight::Nth, CenterWeight::Harmonic]
        [next() as usize];
    let layout = if next() == 0.0 { LayoutKind::Projection } else { LayoutKind::Heuristic };
    next();
    next();
    let sides = next() as usize;
    let center = dvec3(next(), next(), next());
    let ribbons = (0..sides)
        .map(|_| {
            let (degree, layers) = (next() as usize, next() as usize);
            let points = (0..layers * (degree + 1)).map(|_| dvec3(next(), next(), next())).collect();
            Ribbon::new(degree, layers, points).unwrap()
        })
        .collect();
    let builder = ConcavePatch::builder(ribbons).layout(layout).center(center).center_weight(weight);
    Some(builder.build().unwrap())
}

pub fn regular(n: usize) -> Polygon {
    layout::regular(n).unwrap()
}

/// A four-sided patch on the side y < 0 of a curve from x = 0 to x = 3, which is its first side, run backwards.
pub fn patch_with_side(rim: &[DVec3; 4]) -> ConcavePatch {
    let [start, .., end] = *rim;
    let back: Vec<DVec3> = rim.iter().rev().copied().collect();
    let line = |a: DVec3, b: DVec3| Ribbon::new(1, 1, vec![a, b]).unwrap();
    let (left, right) = (start - DVec3::Y, end - DVec3::Y);
    let ribbons =
        vec![Ribbon::new(3, 1, back).unwrap(), line(start, left), line(left, right), line(right, end)];
    let builder = ConcavePatch::builder(ribbons).layout(LayoutKind::Regular);
    builder.coordinates(CoordinateKind::MeanValue).build().unwrap()
}
