//! Patches to test with, and the formula in plain loops, written apart from the crate.
#![allow(dead_code, clippy::unwrap_used)]

use casteljau_gb::glam::{DVec2, DVec3, dvec2, dvec3};
use casteljau_gb::{CenterWeight, ConcavePatch, CoordinateKind, Polygon, Ribbon};

/// A repeatable source of numbers in [-1, 1].
pub struct Random(pub u64);

impl Random {
    pub fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((self.0 >> 11) as f64) / (1u64 << 52) as f64 - 1.0
    }
    pub fn point(&mut self) -> DVec3 {
        dvec3(self.number(), self.number(), self.number())
    }
    /// λ of a point inside: positive, of sum 1.
    pub fn simplex(&mut self, n: usize) -> Vec<f64> {
        let raw: Vec<f64> = (0..n).map(|_| -(0.5 + 0.5 * self.number()).max(1e-9).ln()).collect();
        let sum: f64 = raw.iter().sum();
        raw.iter().map(|x| x / sum).collect()
    }
}

/// An L with one concave corner, vertex 3.
pub fn l_shape() -> Polygon {
    let v = [(0., 0.), (2., 0.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)];
    Polygon::new(v.iter().map(|&(x, y)| dvec2(x, y)).collect()).unwrap()
}

pub fn regular(n: usize) -> Polygon {
    casteljau_domain::layout::regular(n).unwrap()
}

/// A wavy surface over the plane.
pub fn height(p: DVec2) -> DVec3 {
    dvec3(p.x + 0.1 * p.y * p.y, p.y - 0.05 * p.x * p.y, 0.3 * (1.3 * p.x + 0.4).sin() + 0.2 * p.x * p.y)
}

/// Ribbons over the sides of a polygon, lifted to the wavy surface: one (degree, layers) a side, used in turn. The layers of
/// a ribbon lean along the neighbouring sides, as those of a tensor-product patch do, so that ribbons agree at the
/// corners to first order roughly.
pub fn ribbons_over(polygon: &Polygon, shapes: &[(usize, usize)]) -> Vec<Ribbon> {
    let n = polygon.len();
    let v = |i: usize| polygon.vertices()[i % n];
    (0..n)
        .map(|i| {
            let (degree, layers) = shapes[i % shapes.len()];
            let (a, b) = (v(i + n - 1), v(i));
            let (before, after) = (v(i + n - 2) - a, v(i + 1) - b);
            let concave = |corner: usize| if polygon.is_concave(corner % n) { -1.0 } else { 1.0 };
            let (before, after) = (before * concave(i + n - 1), after * concave(i));
            let mut points = Vec::new();
            for k in 0..layers {
                for j in 0..=degree {
                    let (s, h) = (j as f64 / degree as f64, k as f64 / (2 * layers - 1) as f64);
                    points.push(height(a.lerp(b, s) + before.lerp(after, s) * h));
                }
            }
            Ribbon::new(degree, layers, points).unwrap()
        })
        .collect()
}

/// Moves the inner layers at random, so that nothing about two ribbons agrees but their common corner.
pub fn shaken(mut ribbons: Vec<Ribbon>, random: &mut Random) -> Vec<Ribbon> {
    for ribbon in &mut ribbons {
        for k in 1..ribbon.layers() {
            for j in 0..=ribbon.degree() {
                let moved = ribbon.point(j, k).unwrap() + random.point() * 0.1;
                ribbon.set_point(j, k, moved).unwrap();
            }
        }
        for j in 1..ribbon.degree() {
            let moved = ribbon.point(j, 0).unwrap() + random.point() * 0.1;
            ribbon.set_point(j, 0, moved).unwrap();
        }
    }
    ribbons
}

pub fn patch_over(polygon: Polygon, kind: CoordinateKind, shapes: &[(usize, usize)], p: u32) -> ConcavePatch {
    let ribbons = ribbons_over(&polygon, shapes);
    ConcavePatch::builder(ribbons).domain(polygon).coordinates(kind).blend_power(p).build().unwrap()
}

fn binomial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |b, i| b * (n - i) as f64 / (i + 1) as f64)
}

pub fn bernstein(n: usize, k: usize, t: f64) -> f64 {
    binomial(n, k) * t.powi(k as i32) * (1.0 - t).powi((n - k) as i32)
}

/// The formula of the design, term by term, for λ inside.
pub fn plain(patch: &ConcavePatch, lambda: &[f64]) -> DVec3 {
    let n = patch.sides();
    let p = patch.blend_power() as i32;
    let h = |i: usize| 1.0 - lambda[(i + n - 1) % n] - lambda[i % n];
    let s = |i: usize| lambda[i % n] / (lambda[(i + n - 1) % n] + lambda[i % n]);
    let share = |a: f64, b: f64| a.powi(p) / (a.powi(p) + b.powi(p));
    let (mut sum, mut total) = (DVec3::ZERO, 0.0);
    for (i, ribbon) in patch.ribbons().iter().enumerate() {
        let (alpha, beta) = (share(h(i + n - 1), h(i)), share(h(i + 1), h(i)));
        let (d, l) = (ribbon.degree(), ribbon.layers());
        for k in 0..l {
            for j in 0..=d {
                let mu = match (2 * j).cmp(&d) {
                    std::cmp::Ordering::Less => alpha,
                    std::cmp::Ordering::Equal => 1.0,
                    std::cmp::Ordering::Greater => beta,
                };
                let weight = mu * bernstein(d, j, s(i)) * bernstein(2 * l - 1, k, h(i));
                sum += ribbon.point(j, k).unwrap() * weight;
                total += weight;
            }
        }
    }
    for extra in patch.corner_points() {
        let i = extra.corner;
        let beta = share(h(i + 1), h(i));
        let m = |i: usize| 2 * patch.ribbons()[i % n].layers() - 1;
        let weight = 4.5 * beta * (1.0 - beta) * bernstein(m(i), 1, h(i)) * bernstein(m(i + 1), 1, h(i + 1));
        sum += extra.point * weight;
        total += weight;
    }
    let n_real = n as f64;
    let square = |i: usize| (h(i) * (1.0 - h(i))).powi(2);
    let center = match patch.center_weight() {
        CenterWeight::Deficiency => 1.0 - total,
        CenterWeight::Nth => n_real * (0..n).map(|i| square(i) * square(i + 1)).sum::<f64>(),
        CenterWeight::Harmonic => {
            2.0 / 9.0
                * (1.0 - 2.0 / n_real).powf(-2.0 * n_real)
                * (0..n).map(|i| h(i).powi(2)).product::<f64>()
        }
        _ => 0.0,
    };
    (sum + patch.center().unwrap_or(DVec3::ZERO) * center) / (total + center)
}

/// A few points inside a polygon, by rejection.
pub fn inside(polygon: &Polygon, count: usize, random: &mut Random) -> Vec<DVec2> {
    let [low, high] = polygon.bounding_box();
    let mut points = Vec::new();
    while points.len() < count {
        let t = dvec2(random.number(), random.number()) * 0.5 + 0.5;
        let p = low + (high - low) * t;
        if matches!(polygon.locate(p), casteljau_gb::Location::Inside(_)) {
            points.push(p);
        }
    }
    points
}
