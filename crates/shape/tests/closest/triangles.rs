//! Triangles: nothing found by brute force is closer, the certified bound is below it, and all minima among samples
//! are accounted for.

use casteljau_shape::bernstein::{TriangleNet, last_barycentric};
use casteljau_shape::geom::UNIT_ROUNDOFF;
use casteljau_shape::geom::glam::{DVec3, DVec4, Vec4Swizzles};
use casteljau_shape::{ParametricSurface, RationalTriangle, ShapeError, Triangle, TriangleProjector};

use crate::minima::{accounted, each_is_least};
use crate::random::Random;

const GRID: usize = 24;
const SHAPES: usize = 500;
const QUERIES: usize = 10;

#[derive(Debug, Clone)]
struct Net {
    degree: usize,
    points: Vec<DVec4>,
}

impl Net {
    fn point(&self, [u, v]: [f64; 2]) -> DVec3 {
        let p = TriangleNet::validated(&self.points, self.degree).value([u, v, last_barycentric(&[u, v])]);
        p.xyz() / p.w
    }

    fn projector(&self) -> TriangleProjector {
        let triangle = RationalTriangle::from_homogeneous(self.degree, &self.points[..]).unwrap();
        TriangleProjector::new(&triangle).unwrap()
    }

    fn largest(&self) -> f64 {
        self.points.iter().map(|p| (p.xyz() / p.w).abs().max_element()).fold(0.0, f64::max)
    }

    /// Rounding of the points and the distances, on both sides of a comparison: in the square the degree is 2n.
    fn slack(&self, q: DVec3) -> f64 {
        8.0 * (2 * self.degree + 2) as f64 * UNIT_ROUNDOFF * (self.largest() + q.abs().max_element())
    }

    fn transformed(&self, scale: f64, shift: DVec3) -> Self {
        let map = |p: &DVec4| ((p.xyz() + shift * p.w) * scale).extend(p.w);
        Self { points: self.points.iter().map(map).collect(), ..*self }
    }

    /// Moves to better neighbours inside the triangle, and halves the step where there is none.
    fn refined(&self, q: DVec3, (mut least, mut at): (f64, [f64; 2]), steps: usize) -> (f64, [f64; 2]) {
        let mut step = 1.0 / GRID as f64;
        for _ in 0..steps {
            if step <= 1e-9 {
                break;
            }
            let mut moved = false;
            for [a, b] in
                [[1., 0.], [0., 1.], [-1., 0.], [0., -1.], [1., -1.], [-1., 1.], [1., 1.], [-1., -1.]]
            {
                let u = (at[0] + a * step).clamp(0.0, 1.0);
                let next = [u, (at[1] + b * step).clamp(0.0, 1.0 - u)];
                let distance = self.point(next).distance(q);
                // Light vertices are left far behind by what λ₃ is rounded to.
                if distance < least && last_barycentric(&next) >= 0.0 {
                    (least, at, moved) = (distance, next, true);
                }
            }
            if !moved {
                step *= 0.5;
            }
        }
        (least, at)
    }

    fn samples(&self, q: DVec3, n: usize) -> Vec<(f64, [usize; 2])> {
        let place = |i: usize| (0..=n - i).map(move |j| [i, j]);
        let at = |[i, j]: [usize; 2]| [i as f64 / n as f64, j as f64 / n as f64];
        (0..=n).flat_map(place).map(|ij| (self.point(at(ij)).distance(q), ij)).collect()
    }

    fn least_distance(&self, q: DVec3) -> f64 {
        let mut found = self.samples(q, GRID);
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let refined =
            |&(d, at): &(f64, [usize; 2])| self.refined(q, (d, at.map(|i| i as f64 / GRID as f64)), 400).0;
        found.iter().take(4).map(refined).fold(f64::INFINITY, f64::min)
    }
}

/// Difficult nets in turns.
fn net(random: &mut Random, kind: usize, degree: usize) -> Net {
    let indices: Vec<[usize; 3]> =
        (0..=degree).flat_map(|r| (0..=r).map(move |k| [degree - r, r - k, k])).collect();
    let mut points: Vec<DVec3> = indices.iter().map(|_| random.point()).collect();
    let mut weights = vec![1.0; points.len()];
    match kind {
        0 => {}
        1 => {
            for (p, [i, j, _]) in points.iter_mut().zip(&indices) {
                *p = DVec3::new(*i as f64, *j as f64, 0.0) / degree as f64 + 0.3 * *p; // like a surface
            }
        }
        2 => weights.iter_mut().for_each(|w| *w = random.spread(-3.0, 3.0)),
        3 => {
            // Cusps: points that repeat, and lines that turn back.
            for k in 1..points.len() {
                match random.below(3) {
                    0 => points[k] = points[k - 1],
                    1 if k > 1 => points[k] = points[k - 2],
                    _ => {}
                }
            }
        }
        4 => {
            // An edge that is a point.
            let edge = random.below(3);
            let common = random.point();
            for (p, _) in points.iter_mut().zip(&indices).filter(|(_, index)| index[edge] == 0) {
                *p = common;
            }
            weights.iter_mut().for_each(|w| *w = random.spread(-1.0, 1.0));
        }
        5 => points.iter_mut().for_each(|p| p.z = 0.0),
        6 => {
            // Symmetric: minima come in pairs.
            for k in 0..points.len() {
                let [i, j, l] = indices[k];
                let twin = indices.iter().position(|&x| x == [i, l, j]).unwrap();
                if j > l {
                    points[k] = points[twin] * DVec3::new(-1.0, 1.0, 1.0);
                } else if j == l {
                    points[k].x = 0.0;
                }
            }
            for k in 0..points.len() {
                let [i, j, l] = indices[k];
                let twin = indices.iter().position(|&x| x == [i, l, j]).unwrap();
                if j < l {
                    points[k] = points[twin] * DVec3::new(-1.0, 1.0, 1.0);
                }
            }
        }
        _ => points.iter_mut().for_each(|p| *p = DVec3::splat(p.x)), // back and forth on a line
    }
    Net { degree, points: points.iter().zip(weights).map(|(p, w)| (*p * w).extend(w)).collect() }
}

fn place(random: &mut Random) -> [f64; 2] {
    let (a, b) = (random.unit(), random.unit());
    if a + b <= 1.0 { [a, b] } else { [1.0 - a, 1.0 - b] }
}

/// A query near, on, or far from the net.
fn query(random: &mut Random, net: &Net) -> DVec3 {
    let at = place(random);
    let vertex = [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]][random.below(3)];
    match random.below(8) {
        0 => net.point(at),
        1 => net.point(vertex),
        2 => net.point(at) + 1e-6 * random.point(),
        3 => 1e6 * random.point(),
        4 => net.point(vertex) + random.spread(-9.0, -1.0) * random.point(),
        5 => net.point([at[0], if random.unit() < 0.5 { 0.0 } else { 1.0 - at[0] }]),
        _ => 2.0 * random.point(),
    }
}

#[test]
fn against_brute_force() {
    let mut random = Random::new(21);
    let (mut cases, mut open, mut on_lines) = (0, 0, 0);
    for shape in 0..SHAPES {
        let degree = 1 + random.below(5);
        let scale = if shape % 3 == 0 { random.spread(-6.0, 6.0) } else { 1.0 };
        let kind = if shape % 8 == 7 && shape % 80 != 7 { 1 } else { shape % 8 };
        let net = net(&mut random, kind, degree);
        let shift = random.point() * if shape % 5 == 0 { 100.0 } else { 0.0 };
        let moved = net.transformed(scale, shift);
        let projector = moved.projector();
        for _ in 0..QUERIES {
            let q = (query(&mut random, &net) + shift) * scale;
            let answer = projector.closest_point(q).unwrap();
            assert_eq!(answer, projector.closest_point(q).unwrap());
            assert_eq!(answer.point, moved.point(answer.parameters));
            let [u, v] = answer.parameters;
            assert!(u >= 0.0 && v >= 0.0 && last_barycentric(&[u, v]) >= -UNIT_ROUNDOFF, "{answer:?}");
            let (brute, slack) = (moved.least_distance(q), moved.slack(q));
            assert!(
                answer.distance <= brute + slack,
                "{shape}: {answer:?}, brute force {brute:e}, {q} {moved:?}"
            );
            assert!(
                answer.lower_bound <= brute && answer.lower_bound <= answer.distance,
                "{shape}: {answer:?}"
            );
            let scale = moved.largest() + answer.distance;
            let resolution = 100.0 * (2 * degree + 2) as f64 * UNIT_ROUNDOFF * scale;
            let is_open = answer.distance - answer.lower_bound > resolution;
            assert!(answer.distance - answer.lower_bound < 1e-2 * scale, "{shape}: {answer:?}");
            // A triangle on a line has whole curves of closest points; only the others promise a small gap.
            cases += 1;
            *(if kind == 7 { &mut on_lines } else { &mut open }) += usize::from(is_open);
            if is_open && kind != 7 {
                println!(
                    "{shape} kind {kind}: open by {:.1e} at {:e}",
                    answer.distance - answer.lower_bound,
                    answer.distance
                );
            }
        }
    }
    println!("{cases} cases, {open} open; on lines {on_lines} open");
    assert!(cases == SHAPES * QUERIES && 100 * open <= 3 * cases, "{open} of {cases} open");
}

#[test]
fn good_starts_converge() {
    let mut random = Random::new(22);
    let mut found = 0;
    for shape in 0..100 {
        let net = net(&mut random, shape % 3, 3);
        let projector = net.projector();
        for _ in 0..10 {
            let q = query(&mut random, &net);
            let global = projector.closest_point(q).unwrap();
            let near = global.parameters.map(|x| x + random.between(-1e-4, 1e-4));
            let local = projector.closest_point_from(q, near).unwrap();
            assert!(local.distance >= global.lower_bound);
            if near[0] >= 0.0 && near[1] >= 0.0 && near[0] + near[1] <= 1.0 {
                assert!(local.distance <= net.point(near).distance(q) + net.slack(q), "{local:?} {global:?}");
            }
            // Heavy weights make the surface fast: the start is then near another minimum.
            found += usize::from(local.converged && local.distance <= global.distance + net.slack(q));
        }
    }
    assert!(found > 950, "{found} of 1000");
}

#[test]
fn all_minima() {
    const N: usize = 100;
    let mut random = Random::new(23);
    let (mut minima, mut unresolved) = (0, 0);
    for shape in 0..160 {
        let kind = [0, 1, 2, 6][shape % 4];
        let degree = 2 + random.below(2);
        let net = net(&mut random, kind, degree);
        let projector = net.projector();
        let q = 1.5 * random.point();
        let found = projector.local_minima(q).unwrap();
        assert_eq!(found, projector.local_minima(q).unwrap());
        minima += found.minima.len();
        unresolved += if kind == 2 { 0 } else { found.unresolved.len() };
        let inside = |[u, v]: [f64; 2]| {
            let u = u.clamp(0.0, 1.0);
            net.point([u, v.clamp(0.0, 1.0 - u)])
        };
        each_is_least(&found, &projector.closest_point(q).unwrap(), q, inside);
        let samples = net.samples(q, N);
        let at = |i: usize, j: usize| samples[i * (N + 1) - i * i.saturating_sub(1) / 2 + j];
        for &(distance, [i, j]) in &samples {
            let mut around = (i.saturating_sub(2)..=(i + 2).min(N))
                .flat_map(|a| (j.saturating_sub(2)..=(j + 2).min(N)).map(move |b| (a, b)))
                .filter(|&(a, b)| a + b <= N && (a, b) != (i, j));
            if around.all(|(a, b)| {
                assert_eq!(at(a, b).1, [a, b]);
                at(a, b).0 > distance
            }) {
                let start = (distance, [i, j].map(|i| i as f64 / N as f64));
                let (_, end) = net.refined(q, start, 100_000);
                assert!(accounted(&found, end, 0.02), "{shape}: sample {end:?} of {found:?}");
            }
        }
    }
    println!("{minima} minima, {unresolved} unresolved boxes");
    assert!(minima > 160 && unresolved <= 16, "{minima} {unresolved}");
}

/// An octant of the sphere: the distance is known, from the centre and elsewhere.
#[test]
fn sphere() {
    let octant = RationalTriangle::sphere_octant(DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z).unwrap();
    let projector = TriangleProjector::new(&octant).unwrap();
    let answer = projector.closest_point(DVec3::ZERO).unwrap();
    assert!((answer.distance - 1.0).abs() < 1e-14 && answer.lower_bound > 1.0 - 1e-12, "{answer:?}");
    for k in 1..200 {
        let q = DVec3::from([0.31, 0.47, 0.73].map(|a| (a * f64::from(k)).fract() + 1e-3)) * 1.7;
        let answer = projector.closest_point(q).unwrap();
        let exact = (q.length() - 1.0).abs();
        assert!(
            (answer.distance - exact).abs() < 1e-14 && answer.lower_bound > exact - 1e-12,
            "{q}: {answer:?}"
        );
    }
}

/// A flat triangle: feet inside, on each edge and at each vertex, which are told exactly.
#[test]
fn flat() {
    let corners = [DVec3::ZERO, DVec3::new(4.0, 0.0, 0.0), DVec3::new(0.0, 4.0, 0.0)];
    let flat = Triangle::new(1, corners).unwrap().elevated(2).unwrap();
    let projector = TriangleProjector::new(&flat).unwrap();
    let cases = [
        ([1.0, 1.0, 2.0], [0.5, 0.25], 2.0),
        ([1.0, -3.0, 0.0], [0.75, 0.25], 3.0),
        ([-1.0, 3.0, 0.0], [0.25, 0.0], 1.0),
        ([5.0, 5.0, 0.0], [0.0, 0.5], 18_f64.sqrt()),
        ([-3.0, -4.0, 0.0], [1.0, 0.0], 5.0),
        ([7.0, -4.0, 0.0], [0.0, 1.0], 5.0),
        ([-4.0, 7.0, 0.0], [0.0, 0.0], 5.0),
    ];
    for (q, [u, v], distance) in cases {
        let q = DVec3::from(q);
        let answer = projector.closest_point(q).unwrap();
        let at = answer.parameters;
        assert!((at[0] - u).abs() < 1e-14 && (at[1] - v).abs() < 1e-14, "{q}: {answer:?}");
        assert!(
            (answer.distance - distance).abs() < 1e-14 && answer.lower_bound > distance - 1e-12,
            "{answer:?}"
        );
        // Zeros are told exactly.
        let (lambda, exact) = ([at[0], at[1], last_barycentric(&at)], [u, v, 1.0 - u - v]);
        assert!((0..3).all(|k| (lambda[k] == 0.0) == (exact[k] == 0.0)), "{q}: {answer:?}");
        for start in [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0], [0.3, 0.3], [-7.0, 2.0]] {
            let local = projector.closest_point_from(q, start).unwrap();
            assert!(
                local.converged && (local.distance - distance).abs() < 1e-13,
                "{q}, {start:?}: {local:?}"
            );
        }
        let found = projector.local_minima(q).unwrap();
        assert!(found.minima.len() == 1 && found.unresolved.is_empty(), "{q}: {found:?}");
        assert!(found.minima[0].parameters.iter().zip([u, v]).all(|(a, b)| (a - b).abs() < 1e-14));
    }
    assert!((flat.try_point(0.5, 0.25).unwrap() - DVec3::new(1.0, 1.0, 0.0)).length() < 1e-14);
}

#[test]
fn doors() {
    let point = TriangleProjector::new(&Triangle::new(0, [DVec3::X]).unwrap()).unwrap();
    assert_eq!(point.closest_point(DVec3::ZERO).unwrap().distance, 1.0);
    let still = TriangleProjector::new(&Triangle::new(2, [DVec3::ONE; 6]).unwrap()).unwrap();
    assert!((still.closest_point(DVec3::ZERO).unwrap().distance - 3_f64.sqrt()).abs() < 1e-15);
    let flat = TriangleProjector::new(&Triangle::new(1, [DVec3::ZERO, DVec3::X, DVec3::Y]).unwrap()).unwrap();
    assert!(matches!(flat.closest_point(DVec3::NAN), Err(ShapeError::Query { axis: 0, .. })));
    assert!(matches!(flat.local_minima(DVec3::Z * 1e141), Err(ShapeError::Query { axis: 2, .. })));
    assert!(matches!(flat.closest_point_from(DVec3::Z, [0.0, f64::NAN]), Err(ShapeError::Parameter { .. })));
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let mixed = RationalTriangle::new(1, &corners, &[1.0, 1.0, -1.0]).unwrap();
    assert!(matches!(TriangleProjector::new(&mixed), Err(ShapeError::Weight { place: 2, .. })));
    let negative = RationalTriangle::new(1, &corners, &[-1.0, -2.0, -1.0]).unwrap();
    assert_eq!(TriangleProjector::new(&negative).unwrap().closest_point(DVec3::Z).unwrap().distance, 1.0);
}
