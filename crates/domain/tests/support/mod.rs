//! Double-double numbers, slow reference coordinates over them, and polygons to try.
#![allow(dead_code, clippy::unwrap_used, clippy::needless_range_loop)]

use std::ops::{Add, Div, Mul, Neg, Sub};

use casteljau_domain::Polygon;
use casteljau_domain::glam::{DVec2, dvec2};

/// A number as the unevaluated sum of two doubles: about 31 digits.
#[derive(Clone, Copy, Debug)]
pub struct Dd(pub f64, pub f64);

fn two_sum(a: f64, b: f64) -> Dd {
    let s = a + b;
    let t = s - a;
    Dd(s, (a - (s - t)) + (b - t))
}

impl From<f64> for Dd {
    fn from(x: f64) -> Self {
        Self(x, 0.0)
    }
}

impl Add for Dd {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        let (s, t) = (two_sum(self.0, o.0), two_sum(self.1, o.1));
        let c = two_sum(s.0, s.1 + t.0);
        two_sum(c.0, c.1 + t.1)
    }
}

impl Neg for Dd {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl Sub for Dd {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        self + -o
    }
}

impl Mul for Dd {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        let p = self.0 * o.0;
        two_sum(p, self.0.mul_add(o.0, -p) + (self.0 * o.1 + self.1 * o.0))
    }
}

impl Div for Dd {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let q1 = self.0 / o.0;
        let r = self - o * Self::from(q1);
        let q2 = r.0 / o.0;
        let r = r - o * Self::from(q2);
        two_sum(q1, q2) + Self::from(r.0 / o.0)
    }
}

impl Dd {
    pub fn sqrt(self) -> Self {
        let r = Self::from(self.0.sqrt());
        let half = Self::from(0.5);
        let r = half * (r + self / r);
        half * (r + self / r)
    }
    pub fn to_f64(self) -> f64 {
        self.0 + self.1
    }
}

pub type Plane = [Dd; 2];

fn minus(a: Plane, b: Plane) -> Plane {
    [a[0] - b[0], a[1] - b[1]]
}
fn cross(a: Plane, b: Plane) -> Dd {
    a[0] * b[1] - a[1] * b[0]
}
fn dot(a: Plane, b: Plane) -> Dd {
    a[0] * b[0] + a[1] * b[1]
}

fn lift(p: DVec2) -> Plane {
    [p.x.into(), p.y.into()]
}

fn normalised(weights: Vec<Dd>) -> Vec<Dd> {
    let sum = weights.iter().fold(Dd::from(0.0), |s, w| s + *w);
    weights.into_iter().map(|w| w / sum).collect()
}

/// Mean value coordinates from the sine and cosine of the angles: tan(α/2) = (1 − cos α)/sin α.
pub fn mean_value(polygon: &Polygon, x: Plane) -> Vec<Dd> {
    let n = polygon.len();
    let d: Vec<Plane> = polygon.vertices().iter().map(|v| minus(lift(*v), x)).collect();
    let r: Vec<Dd> = d.iter().map(|d| dot(*d, *d).sqrt()).collect();
    let tangent = |i: usize| {
        let (a, b) = (d[i % n], d[(i + 1) % n]);
        (r[i % n] * r[(i + 1) % n] - dot(a, b)) / cross(a, b)
    };
    normalised((0..n).map(|i| (tangent(i + n - 1) + tangent(i)) / r[i]).collect())
}

/// Wachspress coordinates as products of the areas to all other sides.
pub fn wachspress(polygon: &Polygon, x: Plane) -> Vec<Dd> {
    let n = polygon.len();
    let v: Vec<Plane> = polygon.vertices().iter().map(|v| lift(*v)).collect();
    let area = |j: usize| cross(minus(v[(j + n - 1) % n], x), minus(v[j % n], x));
    let weight = |i: usize| {
        let corner = cross(minus(v[i], v[(i + n - 1) % n]), minus(v[(i + 1) % n], v[i]));
        (0..n).filter(|j| *j != i && *j != (i + 1) % n).fold(corner, |p, j| p * area(j))
    };
    normalised((0..n).map(weight).collect())
}

/// All six rows by central differences of order 8 in double-double arithmetic, step `h`.
pub fn rows_by_differences(f: &dyn Fn(Plane) -> Vec<Dd>, p: DVec2, h: f64) -> Vec<f64> {
    const FIRST: [(f64, f64); 4] = [(4.0, 5.0), (-1.0, 5.0), (4.0, 105.0), (-1.0, 280.0)];
    const SECOND: [(f64, f64); 4] = [(8.0, 5.0), (-1.0, 5.0), (8.0, 315.0), (-1.0, 560.0)];
    let at = |i: f64, j: f64| f([Dd::from(p.x) + Dd::from(i * h), Dd::from(p.y) + Dd::from(j * h)]);
    let ratio = |(a, b): (f64, f64)| Dd::from(a) / Dd::from(b);
    let value = at(0.0, 0.0);
    let n = value.len();
    let hd = Dd::from(h);
    let first = |shift: &dyn Fn(f64) -> Vec<Dd>| {
        let mut sum = vec![Dd::from(0.0); n];
        for (k, c) in FIRST.iter().enumerate() {
            let s = (k + 1) as f64;
            let (plus, minus) = (shift(s), shift(-s));
            for i in 0..n {
                sum[i] = sum[i] + ratio(*c) * (plus[i] - minus[i]) / hd;
            }
        }
        sum
    };
    let second = |shift: &dyn Fn(f64) -> Vec<Dd>| {
        let mut sum: Vec<Dd> = value.iter().map(|v| -(ratio((205.0, 72.0)) * *v) / (hd * hd)).collect();
        for (k, c) in SECOND.iter().enumerate() {
            let s = (k + 1) as f64;
            let (plus, minus) = (shift(s), shift(-s));
            for i in 0..n {
                sum[i] = sum[i] + ratio(*c) * (plus[i] + minus[i]) / (hd * hd);
            }
        }
        sum
    };
    let du = first(&|s| at(s, 0.0));
    let dv = first(&|s| at(0.0, s));
    let duu = second(&|s| at(s, 0.0));
    let dvv = second(&|s| at(0.0, s));
    let duv = first(&|s| first(&|q| at(s, q)));
    [value, du, dv, duu, duv, dvv].concat().into_iter().map(Dd::to_f64).collect()
}

/// A small generator of repeatable numbers (SplitMix64).
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * 2f64.powi(-53)
    }
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }
}

/// Named polygons with one kind of difficulty each.
pub fn gallery() -> Vec<(&'static str, Polygon)> {
    let p = |v: &[(f64, f64)]| Polygon::new(v.iter().map(|p| dvec2(p.0, p.1)).collect()).unwrap();
    let star = |n: usize, inner: f64| {
        let v = (0..2 * n).map(|i| {
            let r = if i % 2 == 0 { 1.0 } else { inner };
            DVec2::from_angle(i as f64 * std::f64::consts::PI / n as f64) * r
        });
        Polygon::new(v.collect()).unwrap()
    };
    vec![
        ("triangle", p(&[(0., 0.), (3., 0.2), (1., 2.)])),
        ("square", p(&[(0., 0.), (1., 0.), (1., 1.), (0., 1.)])),
        ("clockwise", p(&[(0., 0.), (0., 2.), (3., 2.5), (3.5, 0.)])),
        ("l", p(&[(0., 0.), (2., 0.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)])),
        ("u", p(&[(0., 0.), (3., 0.), (3., 2.), (2., 2.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)])),
        ("star", star(5, 0.4)),
        ("sharp star", star(7, 0.15)),
        (
            "slot",
            p(&[(0., 0.), (2., 0.), (2., 2.), (1.02, 2.), (1.02, 0.5), (0.98, 0.5), (0.98, 2.), (0., 2.)]),
        ),
        ("sliver", p(&[(0., 0.), (1., 0.), (1., 0.01), (0., 0.012)])),
        ("straight corner", p(&[(0., 0.), (1., 0.), (2., 0.), (2., 1.), (0., 1.)])),
        ("short side", p(&[(0., 0.), (1., 0.), (1.001, 0.001), (1., 1.), (0., 1.)])),
        ("decagon", star(5, 0.95)),
        ("wedge", p(&[(0., 0.), (4., 0.0), (4., 0.3)])),
        (
            "comb",
            p(&[
                (0., 0.),
                (7., 0.),
                (7., 2.),
                (6., 2.),
                (6., 1.),
                (5., 1.),
                (5., 2.),
                (4., 2.),
                (4., 1.),
                (3., 1.),
                (3., 2.),
                (2., 2.),
                (2., 1.),
                (1., 1.),
                (1., 2.),
                (0., 2.),
            ]),
        ),
        (
            "thin arm",
            p(&[(0., 0.), (1., 0.), (1., 0.45), (5., 0.45), (5., 0.5), (1., 0.5), (1., 1.), (0., 1.)]),
        ),
        ("thorn", p(&[(0., 0.), (4., 0.), (2.1, 0.1), (2., 3.), (1.9, 0.1)])),
    ]
}

/// A convex polygon of `n` corners on an ellipse, unevenly spread; turns differ from zero.
pub fn convex(random: &mut Random, n: usize) -> Option<Polygon> {
    let squash = random.within(0.05, 1.0);
    let mut angles: Vec<f64> = (0..n).map(|_| random.within(0.0, std::f64::consts::TAU)).collect();
    angles.sort_by(f64::total_cmp);
    let turn = DVec2::from_angle(random.within(0.0, 6.0));
    let v = angles.into_iter().map(|a| turn.rotate(dvec2(a.cos(), squash * a.sin()))).collect();
    Polygon::new(v).ok()
}

/// A star-shaped polygon about the origin with wild radii: some corners nearly coincide, some are needles.
pub fn wild(random: &mut Random, n: usize) -> Option<Polygon> {
    let mut angles: Vec<f64> = (0..n).map(|_| random.within(0.0, std::f64::consts::TAU)).collect();
    for i in 1..n {
        if random.below(4) == 0 {
            angles[i] = angles[i - 1] + 10f64.powf(random.within(-16.0, -1.0));
        }
    }
    angles.sort_by(f64::total_cmp);
    let v = angles.into_iter().map(|a| {
        let r = match random.below(4) {
            0 => 10f64.powf(random.within(-8.0, 0.0)),
            1 => 1.0,
            _ => random.within(0.2, 1.0),
        };
        DVec2::from_angle(a) * r
    });
    let mut v: Vec<DVec2> = v.collect();
    if random.below(2) == 0 {
        v.reverse();
    }
    Polygon::new(v).ok()
}

/// A point of the inside, found by throwing darts into the box; `None` after too many misses.
pub fn inside(random: &mut Random, polygon: &Polygon) -> Option<DVec2> {
    let [low, high] = polygon.bounding_box();
    (0..2000)
        .map(|_| dvec2(random.within(low.x, high.x), random.within(low.y, high.y)))
        .find(|p| matches!(polygon.locate(*p), casteljau_domain::Location::Inside(_)))
}
