//! Polygons that are easy, hard and too hard, and what all the tests do with them.

use std::f64::consts::{PI, TAU};
use std::sync::OnceLock;
use std::time::Instant;

use casteljau_domain::glam::{DVec2, dvec2};
use casteljau_domain::{Coordinates, HarmonicOptions, Location, Polygon};

use crate::support::{Random, inside};

/// Whether the long run is asked for.
pub fn long() -> bool {
    std::env::var_os("CASTELJAU_LONG").is_some_and(|v| v != "0")
}

pub fn polygon(points: &[(f64, f64)]) -> Polygon {
    Polygon::new(points.iter().map(|p| dvec2(p.0, p.1)).collect()).unwrap()
}

pub fn regular(n: usize) -> Polygon {
    Polygon::new((0..n).map(|i| DVec2::from_angle(i as f64 * TAU / n as f64)).collect()).unwrap()
}

pub fn star(tips: usize, inner: f64) -> Polygon {
    let radius = |i: usize| if i.is_multiple_of(2) { 1.0 } else { inner };
    let corner = |i: usize| DVec2::from_angle(i as f64 * PI / tips as f64) * radius(i);
    Polygon::new((0..2 * tips).map(corner).collect()).unwrap()
}

/// The strip of the given width about a polyline, mitred at its bends.
fn corridor(path: &[(f64, f64)], width: f64) -> Polygon {
    let p: Vec<DVec2> = path.iter().map(|p| dvec2(p.0, p.1)).collect();
    let normals: Vec<DVec2> = p.windows(2).map(|w| (w[1] - w[0]).normalize().perp()).collect();
    let offset = |i: usize| {
        let (a, b) = (normals[i.saturating_sub(1)], normals[i.min(normals.len() - 1)]);
        (a + b) / (1.0 + a.dot(b)) * (0.5 * width)
    };
    let right = (0..p.len()).map(|i| p[i] - offset(i));
    let left = (0..p.len()).rev().map(|i| p[i] + offset(i));
    Polygon::new(right.chain(left).collect()).unwrap()
}

/// A square of side 1 with a slot of the given width and of depth 5/6 in its upper side.
pub fn slot(width: f64) -> Polygon {
    let (a, b, h) = (0.5 - 0.5 * width, 0.5 + 0.5 * width, 1.0 / 6.0);
    polygon(&[(0., 0.), (1., 0.), (1., 1.), (b, 1.), (b, h), (a, h), (a, 1.), (0., 1.)])
}

/// A comb of the given number of teeth, each as wide as the gaps, of the given length.
fn comb(teeth: usize, length: f64) -> Polygon {
    let width = (2 * teeth - 1) as f64;
    let mut points = vec![(0., 0.), (width, 0.)];
    for tooth in (0..teeth).rev() {
        let left = 2.0 * tooth as f64;
        points.extend([(left + 1., 1. + length), (left, 1. + length)]);
        if tooth > 0 {
            points.extend([(left, 1.), (left - 1., 1.)]);
        }
    }
    polygon(&points)
}

/// A square of side 2 with a wedge of the given angle cut out down to its centre, which leaves a corner of 2π less it.
fn notch(angle: f64) -> Polygon {
    let x = (0.5 * angle).tan();
    polygon(&[(-1., -1.), (1., -1.), (1., 1.), (x, 1.), (0., 0.), (-x, 1.), (-1., 1.)])
}

/// Polygons without any difficulty.
pub fn plain() -> Vec<(&'static str, Polygon)> {
    vec![
        ("triangle", polygon(&[(0., 0.), (3., 0.2), (1., 2.)])),
        ("quadrilateral, clockwise", polygon(&[(0., 0.), (0., 2.), (3., 2.5), (3.5, 0.)])),
        ("dart", polygon(&[(0., 0.), (2., -1.), (0.8, 0.), (2., 1.)])),
        ("octagon", regular(8)),
        ("decagon", regular(10)),
        ("l", polygon(&[(0., 0.), (2., 0.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)])),
        ("u", polygon(&[(0., 0.), (3., 0.), (3., 2.), (2., 2.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)])),
        ("star", star(5, 0.4)),
    ]
}

/// Polygons that are hard and for which 1e-7 is promised all the same.
pub fn hard() -> Vec<(&'static str, Polygon)> {
    let spiral = [(0., 0.), (6., 0.), (6., 6.), (0., 6.), (0., 2.), (4., 2.), (4., 4.), (2., 4.)];
    let longer = [
        (-2., -2.),
        (8., -2.),
        (8., 8.),
        (-2., 8.),
        (-2., 0.),
        (6., 0.),
        (6., 6.),
        (0., 6.),
        (0., 2.),
        (4., 2.),
        (4., 4.),
        (2., 4.),
    ];
    let zigzag = [(0., 0.), (1., 3.), (2., 0.), (3., 3.), (4., 0.), (5., 3.)];
    let e = 1e-3;
    vec![
        ("slot 1/30", slot(1.0 / 30.0)),
        (
            "bent slot 1/30",
            polygon(&[
                (0., 0.),
                (3., 0.),
                (3., 3.),
                (1.6, 3.),
                (1.6, 1.6),
                (2.4, 1.6),
                (2.4, 1.5),
                (1.5, 1.5),
                (1.5, 3.),
                (0., 3.),
            ]),
        ),
        ("spiral of 16 sides", corridor(&spiral, 1.0)),
        ("spiral of 24 sides", corridor(&longer, 1.0)),
        ("spiral, thin", corridor(&spiral, 0.3)),
        ("zigzag", corridor(&zigzag, 0.4)),
        ("comb of 4 teeth", comb(4, 2.0)),
        ("comb of 6 long teeth", comb(6, 6.0)),
        (
            "arm 1/30",
            polygon(&[(0., 0.), (1., 0.), (1., 0.4), (5., 0.4), (5., 0.6), (1., 0.6), (1., 1.), (0., 1.)]),
        ),
        ("thin l", polygon(&[(0., 0.), (10., 0.), (10., 0.5), (0.5, 0.5), (0.5, 6.), (0., 6.)])),
        (
            "cross of thin arms",
            polygon(&[
                (-0.1, -0.1),
                (-0.1, -2.),
                (0.1, -2.),
                (0.1, -0.1),
                (2., -0.1),
                (2., 0.1),
                (0.1, 0.1),
                (0.1, 2.),
                (-0.1, 2.),
                (-0.1, 0.1),
                (-2., 0.1),
                (-2., -0.1),
            ]),
        ),
        ("corner of 300 degrees", notch(PI / 3.0)),
        ("corner of 340 degrees", notch(PI / 9.0)),
        (
            "two corners of 300 degrees",
            polygon(&[
                (-2., -1.),
                (-1.3, -1.),
                (-1., -0.48),
                (-0.7, -1.),
                (2., -1.),
                (2., 1.),
                (1.3, 1.),
                (1., 0.48),
                (0.7, 1.),
                (-2., 1.),
            ]),
        ),
        (
            "collinear vertices",
            polygon(&[
                (0., 0.),
                (0.4, 0.),
                (1., 0.),
                (2., 0.),
                (2., 1.),
                (1.5, 1.),
                (1., 1.),
                (1., 1.3),
                (1., 2.),
                (0., 2.),
                (0., 0.7),
            ]),
        ),
        (
            "collinear short side",
            polygon(&[(0., 0.), (0.5, 0.), (0.5 + e, 0.), (1., 0.), (1., 1.), (0., 1.)]),
        ),
        ("convex bevel", polygon(&[(0., 0.), (1. - e, 0.), (1., e), (1., 1.), (0., 1.)])),
        (
            "concave bevel",
            polygon(&[
                (0., 0.),
                (2., 0.),
                (2., 1.),
                (1. + 2. * e, 1.),
                (1., 1. + 2. * e),
                (1., 2.),
                (0., 2.),
            ]),
        ),
        (
            "step of short sides",
            polygon(&[(0., 0.), (1., 0.), (1., 0.5), (1. - e, 0.5), (1. - e, 1.), (0., 1.)]),
        ),
        ("sharp star", star(7, 0.15)),
        ("sliver 1/100", polygon(&[(0., 0.), (1., 0.), (1., 0.01), (0., 0.012)])),
        ("needle 1/100", polygon(&[(0., 0.), (1., 0.), (0.3, 0.01)])),
    ]
}

/// Time this thread has worked: other programs and tests on the same cores do not count where the system can tell.
pub struct Clock {
    wall: Instant,
    work: Option<f64>,
}

impl Clock {
    pub fn start() -> Self {
        Self { wall: Instant::now(), work: Self::work() }
    }

    pub fn seconds(&self) -> f64 {
        match (self.work, Self::work()) {
            (Some(before), Some(now)) => now - before,
            _ => self.wall.elapsed().as_secs_f64(),
        }
    }

    /// Linux counts the nanoseconds of each thread.
    fn work() -> Option<f64> {
        let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
        let nanoseconds: f64 = text.split_whitespace().next()?.parse().ok()?;
        Some(nanoseconds * 1e-9)
    }
}

/// A shape with its coordinates and the seconds of work they took.
pub struct Solved {
    pub name: &'static str,
    pub coordinates: Coordinates,
    pub seconds: f64,
}

fn solve(shapes: Vec<(&'static str, Polygon)>) -> Vec<Solved> {
    let solve = |(name, polygon): (&'static str, Polygon)| {
        let clock = Clock::start();
        match Coordinates::harmonic(polygon, &HarmonicOptions::default()) {
            Ok(coordinates) => Some(Solved { name, coordinates, seconds: clock.seconds() }),
            Err(error) => {
                println!("{name}: {error}");
                None
            }
        }
    };
    shapes.into_iter().filter_map(solve).collect()
}

/// The plain shapes by default options; those that fail are left out (and missed by the test of the certificate).
pub fn plain_solved() -> &'static [Solved] {
    static ALL: OnceLock<Vec<Solved>> = OnceLock::new();
    ALL.get_or_init(|| solve(plain()))
}

/// The hard shapes by default options; those that fail are left out (and missed by the test of the certificate).
pub fn hard_solved() -> &'static [Solved] {
    static ALL: OnceLock<Vec<Solved>> = OnceLock::new();
    ALL.get_or_init(|| solve(hard()))
}

/// Rows at one point, not located.
pub fn rows(coordinates: &Coordinates, p: DVec2, order: usize) -> Vec<f64> {
    let mut out = vec![f64::NAN; coordinates.stride(order)];
    coordinates.evaluate_inside(&[p], order, &mut out).unwrap();
    out
}

/// Distance to the boundary.
pub fn clearance(polygon: &Polygon, p: DVec2) -> f64 {
    let distance = |i: usize| {
        let [a, b] = polygon.side(i);
        let d = b - a;
        let t = ((p - a).dot(d) / d.length_squared()).clamp(0.0, 1.0);
        p.distance(a + d * t)
    };
    (0..polygon.len()).map(distance).fold(f64::INFINITY, f64::min)
}

/// Points of the inside, every third of them close to a side or a corner.
pub fn points(random: &mut Random, polygon: &Polygon, count: usize) -> Vec<DVec2> {
    let mut points = Vec::new();
    for k in 0..10 * count {
        if points.len() == count {
            break;
        }
        let Some(p) = inside(random, polygon) else { continue };
        let [a, b] = polygon.side(random.below(polygon.len()));
        let target = match k % 6 {
            0 => a.lerp(b, random.unit()),
            3 => b,
            _ => p,
        };
        let q = target.lerp(p, 10f64.powf(-6.0 * random.unit()));
        if matches!(polygon.locate(q), Location::Inside(_)) {
            points.push(q);
        }
    }
    points
}

/// A place on the boundary: side and parameter; every tenth lies within 1e-9 to 1e-1 of an end of its side, relative
/// to the side's length.
pub fn place(random: &mut Random, polygon: &Polygon) -> (usize, f64) {
    let side = random.below(polygon.len());
    let t = match random.below(20) {
        0 => 10f64.powf(random.within(-9.0, -1.0)),
        1 => 1.0 - 10f64.powf(random.within(-9.0, -1.0)),
        _ => random.unit(),
    };
    (side, t)
}

/// Largest difference from the hat functions at random places of the boundary, by plain evaluation, and where it is.
///
/// The rounding of the places themselves, which are off the boundary by an ulp, is taken off.
pub fn residual(coordinates: &Coordinates, random: &mut Random, count: usize) -> (f64, usize, f64) {
    const BATCH: usize = 1000;
    let (polygon, n) = (coordinates.polygon(), coordinates.len());
    let [low, high] = polygon.bounding_box();
    let reach = low.abs().max(high.abs()).max_element();
    let mut worst = (0.0, 0, 0.0);
    let mut out = vec![0.0; BATCH * n];
    for _ in 0..count.div_ceil(BATCH) {
        let places: Vec<(usize, f64)> = (0..BATCH).map(|_| place(random, polygon)).collect();
        let at = |&(side, t): &(usize, f64)| {
            let [a, b] = polygon.side(side);
            if t < 0.5 { a + (b - a) * t } else { b - (b - a) * (1.0 - t) }
        };
        let points: Vec<DVec2> = places.iter().map(at).collect();
        coordinates.evaluate_inside(&points, 0, &mut out).unwrap();
        for (&(side, t), row) in places.iter().zip(out.chunks_exact(n)) {
            let before = (side + n - 1) % n;
            let slack = 2.0 * f64::EPSILON * (1.0 + reach / polygon.side_length(side));
            for (j, value) in row.iter().enumerate() {
                let exact = if j == side {
                    t
                } else if j == before {
                    1.0 - t
                } else {
                    0.0
                };
                let error = (value - exact).abs() - slack;
                assert!(error.is_finite(), "{value} on side {side} at {t} of {polygon:?}");
                if error > worst.0 {
                    worst = (error, side, t);
                }
            }
        }
    }
    worst
}
