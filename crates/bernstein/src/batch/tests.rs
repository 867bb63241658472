//! The same bits from every instruction set, and wherever a point stands in its batch.

use std::fmt::Debug;

use super::simd::{FORCED, Path};
use super::{
    BoxBatch, BoxGridBatch, CurveBatch, GridBatch, PatchBatch, TetrahedronBatch, TriangleBatch, WedgeBatch,
    elevate_many, subdivide_many, to_power_many,
};
use crate::BernsteinError;
use crate::glam::{DVec2, DVec3, DVec4};

/// Numbers without a pattern: multiples of 2⁻³² in [−1, 1).
fn numbers(count: usize, mut seed: u64) -> Vec<f64> {
    let mut next = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 32) as f64 / 2_f64.powi(31) - 1.0
    };
    (0..count).map(|_| next()).collect()
}

/// Inside, outside, at the ends and next to them.
fn parameters(count: usize, seed: u64) -> Vec<f64> {
    let special =
        [0.0, 1.0, 0.5, f64::EPSILON, 1.0 - f64::EPSILON / 2.0, 1.0 + f64::EPSILON, 1e-300, -0.3, 2.5];
    let place = |(i, x): (usize, f64)| if i % 3 == 1 { special[i / 3 % 9] } else { 0.5 * x + 0.5 };
    numbers(count, seed).into_iter().enumerate().map(place).collect()
}

fn points(count: usize, seed: u64) -> Vec<DVec4> {
    let at = |x: &[f64]| DVec4::new(x[0], 1e6 * x[1], x[2], 1.0 + 0.9 * x[3]);
    numbers(4 * count, seed).chunks(4).map(at).collect()
}

fn space(points: &[DVec4]) -> Vec<DVec3> {
    points.iter().map(|p| p.truncate()).collect()
}

/// Runs `batch` on every path that this processor has, and compares the bits of what it makes.
fn on_every_path<T: PartialEq + Debug>(what: &str, batch: impl Fn() -> Vec<T>) -> Vec<T> {
    FORCED.set(Some(Path::Portable));
    let expected = batch();
    let mut tried = 0;
    for path in Path::available() {
        FORCED.set(Some(path));
        // -0 and 0 are told apart by their text.
        assert_eq!(format!("{:?}", batch()), format!("{expected:?}"), "{what} by {path:?}");
        tried += 1;
    }
    FORCED.set(None);
    assert!(tried > 0);
    expected
}

#[test]
fn this_processor_takes_more_than_one_path_or_says_so() {
    let paths: Vec<Path> = Path::available().collect();
    println!("paths compared: {paths:?}");
    assert_eq!(paths.last(), Some(&Path::Portable));
}

#[test]
fn curves() {
    for degree in [0, 1, 2, 3, 5, 9, 10, 25, 60] {
        let net = points(degree + 1, degree as u64);
        for count in [1, 3, 7, 8, 9, 24, 61] {
            let t = parameters(count, 7);
            let what = format!("degree {degree}, {count} parameters");
            let plain = |net: &[DVec3], t: &[f64]| {
                let [mut a, mut b, mut c] = [(); 3].map(|()| vec![DVec3::ZERO; t.len()]);
                CurveBatch::new(net).unwrap().evaluate(t, [&mut a, &mut b, &mut c]).unwrap();
                (0..t.len()).map(|i| [a[i], b[i], c[i]]).collect::<Vec<_>>()
            };
            let all = on_every_path(&what, || plain(&space(&net), &t));
            let alone: Vec<_> = t.iter().flat_map(|&t| plain(&space(&net), &[t])).collect();
            assert_eq!(all, alone, "{what}: each alone");
            let mut values = vec![DVec3::ZERO; count];
            CurveBatch::new(&space(&net)).unwrap().evaluate(&t, [&mut values]).unwrap();
            assert_eq!(values, all.iter().map(|jet| jet[0]).collect::<Vec<_>>(), "{what}: values alone");
            on_every_path(&what, || {
                let [mut a, mut b, mut c] = [(); 3].map(|()| vec![DVec3::ZERO; t.len()]);
                let answer = CurveBatch::new(&net).unwrap().evaluate_rational(&t, [&mut a, &mut b, &mut c]);
                a.extend(b);
                a.extend(c);
                vec![(answer, a)]
            });
            let x: Vec<f64> = net.iter().map(|p| p.x).collect();
            on_every_path(&what, || {
                let mut out = vec![0.0; count];
                CurveBatch::new(&x).unwrap().evaluate(&t, [&mut out]).unwrap();
                let mut pairs = vec![DVec2::ZERO; count];
                let net: Vec<DVec2> = x.iter().map(|&x| DVec2::new(x, -x)).collect();
                CurveBatch::new(&net).unwrap().evaluate(&t, [&mut pairs]).unwrap();
                assert_eq!(pairs.iter().map(|p| p.x).collect::<Vec<_>>(), out);
                out
            });
        }
    }
}

#[test]
fn grids() {
    for degrees in [[0, 0], [1, 2], [3, 3], [5, 5], [2, 12]] {
        let size = (degrees[0] + 1) * (degrees[1] + 1);
        let nets = points(2 * size, 11);
        for (rows, columns) in [(1, 1), (3, 5), (4, 8), (2, 19)] {
            let (u, v) = (parameters(rows, 1), parameters(columns, 2));
            let what = format!("{degrees:?} on {rows} × {columns}");
            let jets = |u: &[f64], v: &[f64]| {
                let grid = GridBatch::new(degrees, u, v, 2).unwrap();
                let mut out = [(); 6].map(|()| vec![DVec3::ZERO; 2 * grid.points_per_net()]);
                grid.evaluate(&space(&nets), out.each_mut().map(|out| &mut out[..])).unwrap();
                (0..out[0].len()).map(|i| out.each_ref().map(|out| out[i])).collect::<Vec<_>>()
            };
            let all = on_every_path(&what, || jets(&u, &v));
            for (i, &u) in u.iter().enumerate() {
                for (j, &v) in v.iter().enumerate() {
                    let place = i * columns + j;
                    let found = [all[place], all[rows * columns + place]];
                    assert_eq!(jets(&[u], &[v]), found, "{what}: place {place} alone");
                }
            }
            on_every_path(&what, || {
                let grid = GridBatch::new(degrees, &u, &v, 2).unwrap();
                let mut out = [(); 6].map(|()| vec![DVec3::ZERO; 2 * grid.points_per_net()]);
                let answer = grid.evaluate_rational(&nets, out.each_mut().map(|out| &mut out[..]));
                vec![(answer, out)]
            });
            on_every_path(&what, || {
                let grid = GridBatch::new(degrees, &u, &v, 1).unwrap();
                let mut out = [(); 2].map(|()| vec![DVec3::ZERO; 2 * grid.points_per_net()]);
                let [points, normals] = &mut out;
                grid.normals(&space(&nets), points, normals).unwrap();
                vec![out]
            });
        }
    }
}

#[test]
fn scattered() {
    for degrees in [[0, 0], [1, 2], [3, 3], [4, 5], [5, 5], [2, 12], [2, 33]] {
        let net = points((degrees[0] + 1) * (degrees[1] + 1), 5);
        for count in [1, 7, 8, 21, 70] {
            let (u, v) = (parameters(count, 3), parameters(count + 1, 4));
            let uv: Vec<DVec2> =
                u.into_iter().zip(v.into_iter().skip(1)).map(|(u, v)| DVec2::new(u, v)).collect();
            let what = format!("{degrees:?} at {count} places");
            let jets = |uv: &[DVec2]| {
                let mut out = [(); 6].map(|()| vec![DVec3::ZERO; uv.len()]);
                let patch = PatchBatch::new(&space(&net), degrees).unwrap();
                patch.evaluate(uv, out.each_mut().map(|out| &mut out[..])).unwrap();
                (0..uv.len()).map(|i| out.each_ref().map(|out| out[i])).collect::<Vec<_>>()
            };
            let all = on_every_path(&what, || jets(&uv));
            let alone: Vec<_> = uv.iter().flat_map(|&uv| jets(&[uv])).collect();
            assert_eq!(all, alone, "{what}: each alone");
            on_every_path(&what, || {
                let mut out = [(); 6].map(|()| vec![DVec3::ZERO; uv.len()]);
                let patch = PatchBatch::new(&net, degrees).unwrap();
                let answer = patch.evaluate_rational(&uv, out.each_mut().map(|out| &mut out[..]));
                vec![(answer, out)]
            });
        }
    }
}

#[test]
fn triangles() {
    for degree in [0, 1, 2, 3, 9, 40, 43] {
        let net = points((degree + 1) * (degree + 2) / 2, 5);
        for count in [1, 7, 8, 21] {
            let (u, v) = (parameters(count, 3), parameters(count + 1, 4));
            let at: Vec<DVec2> =
                u.into_iter().zip(v.into_iter().skip(1)).map(|(u, v)| DVec2::new(u, v)).collect();
            let what = format!("degree {degree} at {count} places");
            let jets = |at: &[DVec2]| {
                let mut out = [(); 6].map(|()| vec![DVec3::ZERO; at.len()]);
                let triangle = TriangleBatch::new(&space(&net), degree).unwrap();
                triangle.evaluate(at, out.each_mut().map(|out| &mut out[..])).unwrap();
                (0..at.len()).map(|i| out.each_ref().map(|out| out[i])).collect::<Vec<_>>()
            };
            let all = on_every_path(&what, || jets(&at));
            let alone: Vec<_> = at.iter().flat_map(|&at| jets(&[at])).collect();
            assert_eq!(all, alone, "{what}: each alone");
            let mut values = vec![DVec3::ZERO; count];
            TriangleBatch::new(&space(&net), degree).unwrap().evaluate(&at, [&mut values]).unwrap();
            assert_eq!(values, all.iter().map(|jet| jet[0]).collect::<Vec<_>>(), "{what}: values alone");
            on_every_path(&what, || {
                let mut out = [(); 6].map(|()| vec![DVec3::ZERO; at.len()]);
                let triangle = TriangleBatch::new(&net, degree).unwrap();
                let answer = triangle.evaluate_rational(&at, out.each_mut().map(|out| &mut out[..]));
                vec![(answer, out)]
            });
        }
    }
}

/// A batch of the net given first.
type Plain<'a, const K: usize> = &'a dyn Fn(&[DVec3], &[DVec3], [&mut [DVec3]; K]);
type Rational<'a> = &'a dyn Fn(&[DVec3], [&mut [DVec3]; 4]) -> Result<(), BernsteinError>;

#[test]
fn solids() {
    fn check(what: &str, net: &[DVec4], plain: Plain<'_, 4>, values: Plain<'_, 1>, rational: Rational<'_>) {
        for count in [1, 7, 8, 21] {
            let [u, v, w] = [3, 4, 5].map(|seed| parameters(count + seed as usize, seed));
            let at = |i: usize| DVec3::new(u[i + 3], v[i + 1], w[i]);
            let at: Vec<DVec3> = (0..count).map(at).collect();
            let what = format!("{what} at {count} places");
            let jets = |at: &[DVec3]| {
                let mut out = [(); 4].map(|()| vec![DVec3::ZERO; at.len()]);
                plain(&space(net), at, out.each_mut().map(|out| &mut out[..]));
                (0..at.len()).map(|i| out.each_ref().map(|out| out[i])).collect::<Vec<_>>()
            };
            let all = on_every_path(&what, || jets(&at));
            let alone: Vec<_> = at.iter().flat_map(|&at| jets(&[at])).collect();
            assert_eq!(all, alone, "{what}: each alone");
            let mut alone = vec![DVec3::ZERO; count];
            values(&space(net), &at, [&mut alone]);
            assert_eq!(alone, all.iter().map(|jet| jet[0]).collect::<Vec<_>>(), "{what}: values alone");
            on_every_path(&what, || {
                let mut out = [(); 4].map(|()| vec![DVec3::ZERO; at.len()]);
                let answer = rational(&at, out.each_mut().map(|out| &mut out[..]));
                vec![(answer, out)]
            });
        }
    }
    macro_rules! check {
        ($batch:ident, $degrees:expr, $count:expr) => {{
            let (degrees, net) = ($degrees, points($count, 5));
            check(
                &format!("{} of degree {degrees:?}", stringify!($batch)),
                &net,
                &|net, at, out| $batch::new(net, degrees).unwrap().evaluate(at, out).unwrap(),
                &|net, at, out| $batch::new(net, degrees).unwrap().evaluate(at, out).unwrap(),
                &|at, out| $batch::new(&net, degrees).unwrap().evaluate_rational(at, out),
            );
        }};
    }
    for [l, m, n] in [[0, 0, 0], [1, 2, 3], [3, 3, 3], [2, 2, 5], [5, 6, 7], [1, 40, 3], [2, 59, 1]] {
        check!(BoxBatch, [l, m, n], (l + 1) * (m + 1) * (n + 1));
    }
    for n in [0, 1, 2, 4, 9, 20] {
        check!(TetrahedronBatch, n, (n + 1) * (n + 2) * (n + 3) / 6);
    }
    for [n, o] in [[0, 0], [1, 2], [4, 3], [10, 12], [1, 61]] {
        check!(WedgeBatch, [n, o], (n + 1) * (n + 2) / 2 * (o + 1));
    }
}

#[test]
fn box_grids() {
    for degrees in [[0, 0, 0], [1, 0, 2], [3, 3, 3], [2, 2, 5], [1, 2, 12]] {
        let size: usize = degrees.iter().map(|d| d + 1).product();
        let nets = points(2 * size, 11);
        for [i, j, k] in [[1, 1, 1], [2, 3, 5], [3, 1, 8], [1, 2, 19]] {
            let (u, v, w) = (parameters(i, 1), parameters(j, 2), parameters(k, 3));
            let what = format!("{degrees:?} on {i} × {j} × {k}");
            let jets = |u: &[f64], v: &[f64], w: &[f64]| {
                let grid = BoxGridBatch::new(degrees, u, v, w, 1).unwrap();
                let mut out = [(); 4].map(|()| vec![DVec3::ZERO; 2 * grid.points_per_net()]);
                grid.evaluate(&space(&nets), out.each_mut().map(|out| &mut out[..])).unwrap();
                (0..out[0].len()).map(|i| out.each_ref().map(|out| out[i])).collect::<Vec<_>>()
            };
            let all = on_every_path(&what, || jets(&u, &v, &w));
            for place in 0..i * j * k {
                let (u, v, w) = (u[place / (j * k)], v[place / k % j], w[place % k]);
                let found = [all[place], all[i * j * k + place]];
                assert_eq!(jets(&[u], &[v], &[w]), found, "{what}: place {place} alone");
            }
            on_every_path(&what, || {
                let grid = BoxGridBatch::new(degrees, &u, &v, &w, 1).unwrap();
                let mut out = [(); 4].map(|()| vec![DVec3::ZERO; 2 * grid.points_per_net()]);
                let answer = grid.evaluate_rational(&nets, out.each_mut().map(|out| &mut out[..]));
                vec![(answer, out)]
            });
        }
    }
}

#[test]
fn many() {
    for (m, n) in [(0, 0), (1, 4), (3, 3), (5, 2)] {
        let nets = space(&points(5 * (m + 1) * (n + 1), 21));
        on_every_path(&format!("{m} × {n} cut"), || {
            let (mut left, mut right) = (nets.clone(), nets.clone());
            subdivide_many(&nets, m, n + 1, 0.3, &mut left, &mut right).unwrap();
            left.extend(right);
            left
        });
        on_every_path(&format!("{m} × {n} elevated"), || {
            let mut out = vec![DVec3::ZERO; 5 * (m + 2) * (n + 3)];
            elevate_many(&nets, [m, n], [m + 1, n + 2], &mut out).unwrap();
            out
        });
        on_every_path(&format!("degree {n} to the power basis"), || {
            let mut out = nets.clone();
            to_power_many(&nets, n, &mut out).unwrap();
            out
        });
    }
}
