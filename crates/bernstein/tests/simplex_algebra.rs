//! Elevation, reduction, restriction, sums and products over simplices: exact cases and exact arithmetic.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_bernstein::{
    BernsteinError, SimplexNet, SimplexSpace, TETRAHEDRON_EIGHTHS, TRIANGLE_QUARTERS, TetrahedronNet,
    TriangleNet, WedgeNet, WedgeSpace, compose, compose_simplex, restrict, simplex_count, simplex_index,
    value,
};
use num_traits::{One, Zero};
use support::exact::{
    Hunter, Q, absolutes, assert_within, choose, dot, exact, exacts, factor, integer, rounds,
};
use support::simplices::{absolute, basis, blossom, floor, indices, place};
use support::{U, assert_accurate, cases, numbers, size};

fn net<const V: usize>(points: &[f64], degree: usize) -> SimplexNet<'_, f64, V> {
    SimplexNet::new(points, degree).unwrap()
}

fn magnitudes(points: &[f64]) -> Vec<f64> {
    points.iter().map(|x| x.abs()).collect()
}

fn elevated<const V: usize>(points: &[f64], n: usize, to: usize) -> Vec<f64> {
    let mut out = vec![f64::NAN; simplex_count::<V>(to)];
    net::<V>(points, n).elevate(to, &mut out).unwrap();
    out
}

fn restricted<const V: usize>(points: &[f64], n: usize, corners: [[f64; V]; V]) -> Vec<f64> {
    let mut out = vec![f64::NAN; points.len()];
    net::<V>(points, n).restrict(corners, &mut out, &mut vec![f64::NAN; V * points.len()]).unwrap();
    out
}

fn golden_elevation<const V: usize>(case: &serde_json::Value) {
    let (n, to) = (size(&case["degree"]), size(&case["degree"]) + size(&case["raise"]));
    let points = numbers(&case["coefficients"]);
    let (out, scale) = (elevated::<V>(&points, n, to), elevated::<V>(&magnitudes(&points), n, to));
    for ((got, exact), scale) in out.into_iter().zip(numbers(&case["expected"])).zip(scale) {
        assert_accurate(got, exact, to, 0, scale, &format!("{n} to {to} over {V} vertices"));
    }
}

fn golden_restriction<const V: usize>(case: &serde_json::Value) {
    let n = size(&case["degree"]);
    let corners: [[f64; V]; V] = std::array::from_fn(|a| numbers(&case["vertices"][a]).try_into().unwrap());
    let points = numbers(&case["coefficients"]);
    let (out, scale) = (restricted(&points, n, corners), restricted(&magnitudes(&points), n, corners));
    for ((got, exact), scale) in out.into_iter().zip(numbers(&case["expected"])).zip(scale) {
        assert_accurate(got, exact, n, 0, scale, &format!("{} of degree {n}", case["name"]));
    }
}

#[test]
fn exact_cases() {
    for case in cases("degree_elevation.json").iter().filter(|case| case["kind"] == "simplex") {
        match size(&case["dim"]) {
            2 => golden_elevation::<3>(case),
            _ => golden_elevation::<4>(case),
        }
    }
    for case in cases("subdivision.json") {
        match case["kind"].as_str().unwrap() {
            "triangle_subdomain" => golden_restriction::<3>(&case),
            "tetra_subdomain" => golden_restriction::<4>(&case),
            _ => {}
        }
    }
}

/// Degrees up to 5; one case in a hundred up to 40.
fn elevation<const V: usize>(seed: u64, cases: usize) {
    let mut hunter = Hunter::new(seed);
    for round in 0..rounds(cases) {
        let n = if round == 0 { 38 } else { hunter.degree_of(5, 38, 100) };
        let by = if n > 5 { 1 + hunter.below(2) } else { hunter.below(5) };
        let points = hunter.numbers(simplex_count::<V>(n));
        let (q, sizes) = (exacts(&points), absolutes(&exacts(&points)));
        let out = elevated::<V>(&points, n, n + by);
        let whole = choose(n + by, n);
        for (at, index) in places(&mut hunter, V, n + by) {
            // β = γ − δ over all δ ≤ γ of degree `by`.
            let (mut truth, mut scale) = (Q::zero(), Q::zero());
            for (below, weight) in shares(&index, by) {
                truth += &weight * &q[below];
                scale += weight * &sizes[below];
            }
            assert_within(out[at], &(truth / &whole), &(scale / &whole), (V + 1) * by, "elevation");
        }
    }
}

/// The places to compare of a net, with their multi-indices: all of a small one, of a large one some at random.
fn places(hunter: &mut Hunter, vertices: usize, degree: usize) -> Vec<(usize, Vec<usize>)> {
    let all: Vec<_> = indices(vertices, degree).into_iter().enumerate().collect();
    if all.len() <= 300 {
        return all;
    }
    (0..40).map(|_| all[hunter.below(all.len())].clone()).collect()
}

/// All β = γ − δ with δ ≤ γ of a degree: their places, and `Π C(γₐ, βₐ)`.
fn shares(index: &[usize], taken: usize) -> Vec<(usize, Q)> {
    let parts = indices(index.len(), taken).into_iter();
    let left = parts.filter_map(|part| {
        let rest: Option<Vec<usize>> = index.iter().zip(&part).map(|(c, d)| c.checked_sub(*d)).collect();
        rest.map(|rest| (place(&rest), index.iter().zip(&rest).map(|(&c, &b)| choose(c, b)).product()))
    });
    left.collect()
}

#[test]
fn elevation_is_exact_to_its_bound() {
    elevation::<3>(61, 1000);
    elevation::<4>(62, 1000);
}

/// Degrees up to `usual`; once `most` and one case in 200 up to half of it, where a point or two of each net are
/// compared.
fn restriction<const V: usize>(seed: u64, cases: usize, usual: usize, most: usize) {
    let mut hunter = Hunter::new(seed);
    for round in 0..rounds(cases) {
        let n = if round == 0 { most } else { hunter.degree_of(usual, most / 2, 200) };
        let points = hunter.numbers(simplex_count::<V>(n));
        let corners: [[f64; V]; V] = std::array::from_fn(|_| hunter.barycentric::<V>());
        let (q, sizes) = (exacts(&points), absolutes(&exacts(&points)));
        let all = indices(V, n);
        let compared: Vec<usize> = if n <= usual {
            (0..all.len()).collect()
        } else {
            (0..if n < most { 2 } else { 1 }).map(|_| hunter.below(all.len())).collect()
        };
        let check = |corners: &[[f64; V]; V], got: &[f64]| {
            let by_corner = corners.map(|c| exacts(&c));
            for &at in &compared {
                let of = |size: bool| -> Vec<Vec<Q>> {
                    let pairs = all[at].iter().zip(&by_corner);
                    let corners = pairs.flat_map(|(&b, c)| std::iter::repeat_n(c, b));
                    corners.map(|c| if size { absolute(c) } else { c.clone() }).collect()
                };
                let scale = blossom(&sizes, n, &of(true)) + floor(&q);
                assert_within(got[at], &blossom(&q, n, &of(false)), &scale, factor(n, 0), "restriction");
            }
        };
        check(&corners, &restricted(&points, n, corners));
        if points.len() > 2000 {
            continue; // one exact blossom takes a second
        }

        // A split is a restriction with one vertex replaced, and so is that of an edge.
        let whole: [[f64; V]; V] =
            std::array::from_fn(|a| std::array::from_fn(|b| f64::from(u8::from(a == b))));
        let mut parts = vec![f64::NAN; V * points.len()];
        net::<V>(&points, n).split_at(corners[0], &mut parts).unwrap();
        for (vertex, part) in parts.chunks(points.len()).enumerate() {
            let mut replaced = whole;
            replaced[vertex] = corners[0];
            check(&replaced, part);
            assert_eq!(part, restricted(&points, n, replaced), "to the bit");
        }
        let (a, t) = (hunter.below(V), hunter.parameter());
        let b = (a + 1 + hunter.below(V - 1)) % V;
        let (mut near_a, mut near_b) = (points.clone(), points.clone());
        net::<V>(&points, n).split_edge([a, b], t, &mut near_a, &mut near_b).unwrap();
        let mut point = [0.0; V];
        (point[a], point[b]) = (1.0 - t, t);
        for (vertex, part) in [(b, near_a), (a, near_b)] {
            let mut replaced = whole;
            replaced[vertex] = point;
            check(&replaced, &part);
        }
    }
}

#[test]
fn restriction_is_the_blossom() {
    restriction::<2>(70, 1000, 8, 100);
    restriction::<3>(71, 1000, 5, 40);
    restriction::<4>(72, 1000, 3, 40);
}

#[test]
fn restriction_over_two_vertices_is_that_of_the_interval() {
    let points: Vec<f64> = (0..20).map(|i| f64::from(i * i % 7) - 2.0).collect();
    let mut out = vec![0.0; 20];
    restrict(&points, [0.25, 0.75], &mut out).unwrap();
    for (a, b) in out.into_iter().zip(restricted(&points, 19, [[0.75, 0.25], [0.25, 0.75]])) {
        assert_accurate(a, b, 2 * 19, 0, 5.0, "both ways");
    }
}

/// Parts of a uniform split meet with the same bits, in a common edge or face whatever its place in each.
#[test]
fn uniform_splits_meet() {
    let mut hunter = Hunter::new(81);
    let n = 7;
    let points: Vec<f64> = (0..simplex_count::<4>(n)).map(|_| hunter.unit()).collect();
    let of_triangle = &points[..simplex_count::<3>(n)];
    let mut quarters = vec![0.0; 4 * of_triangle.len()];
    let mut scratch = vec![0.0; 4 * points.len()];
    TriangleNet::new(of_triangle, n).unwrap().split_uniform(&mut quarters, &mut scratch).unwrap();
    let mut eighths = vec![0.0; 8 * points.len()];
    TetrahedronNet::new(&points, n).unwrap().split_uniform(&mut eighths, &mut scratch).unwrap();
    let met =
        meeting::<3>(&TRIANGLE_QUARTERS, &quarters, n) + meeting::<4>(&TETRAHEDRON_EIGHTHS, &eighths, n);
    assert!(met > 100, "{met}");
}

/// The number of control points that two parts have in common; each is compared.
fn meeting<const V: usize>(parts: &[[[f64; V]; V]], nets: &[f64], n: usize) -> usize {
    let count = simplex_count::<V>(n);
    let mut met = 0;
    for (x, first) in parts.iter().zip(nets.chunks(count)) {
        for (y, second) in parts.iter().zip(nets.chunks(count)) {
            for index in indices(V, n) {
                // The same arguments of the blossom, if the second part has the corners that are used.
                let mut other = [0; V];
                let found = index.iter().enumerate().filter(|(_, b)| **b > 0).all(|(corner, &b)| {
                    y.iter().position(|c| *c == x[corner]).is_some_and(|place| {
                        other[place] = b;
                        true
                    })
                });
                if found {
                    let index: [usize; V] = index.try_into().unwrap();
                    assert_eq!(first[simplex_index(index)], second[simplex_index(other)]);
                    met += 1;
                }
            }
        }
    }
    met
}

/// Degrees of the factors up to 5, and one in a hundred up to 20.
fn products<const V: usize>(seed: u64, cases: usize) {
    let mut hunter = Hunter::new(seed);
    for round in 0..rounds(cases) {
        let [n, m] = [0; 2].map(|_: usize| if round == 0 { 20 } else { hunter.degree_of(5, 20, 100) });
        let (p, f) = (hunter.numbers(simplex_count::<V>(n)), hunter.numbers(simplex_count::<V>(m)));
        let (of_p, of_f) = (exacts(&p), exacts(&f));
        let (mut out, mut swapped) =
            (vec![f64::NAN; simplex_count::<V>(n + m)], vec![f64::NAN; simplex_count::<V>(n + m)]);
        net::<V>(&p, n).product(&net(&f, m), &mut out).unwrap();
        net::<V>(&f, m).product(&net(&p, n), &mut swapped).unwrap();
        let in_f = indices(V, m);
        let whole = choose(n + m, n);
        for (at, index) in places(&mut hunter, V, n + m) {
            let (mut truth, mut scale) = (Q::zero(), Q::zero());
            for (other, x) in in_f.iter().zip(&of_f) {
                let own: Option<Vec<usize>> =
                    index.iter().zip(other).map(|(g, b)| g.checked_sub(*b)).collect();
                let Some(own) = own else { continue };
                let ways: Q = index.iter().zip(&own).map(|(&g, &b)| choose(g, b)).product();
                let term = x * &of_p[place(&own)] * ways;
                scale += term.abs();
                truth += term;
            }
            let (truth, scale) = (truth / &whole, scale / &whole + exact(f64::MIN_POSITIVE) / exact(U));
            assert_within(out[at], &truth, &scale, factor(n + m, 0), "product");
            assert_within(swapped[at], &truth, &scale, factor(n + m, 0), "product the other way");
        }
        // The sum, in the larger degree: values agree.
        let degree = n.max(m);
        let mut sum = vec![f64::NAN; simplex_count::<V>(degree)];
        net::<V>(&p, n).sum(&net(&f, m), &mut sum).unwrap();
        let lambda = exacts(&hunter.barycentric::<V>());
        let value = |points: &[Q], n: usize, lambda: &[Q]| dot(&basis(n, lambda), points);
        let total: Q = lambda.iter().sum();
        if total == Q::one() {
            let truth = value(&of_p, n, &lambda) + value(&of_f, m, &lambda);
            let l = absolute(&lambda);
            let size: Q = l.iter().sum();
            let outside = num_traits::pow(size, degree);
            let scale = (value(&absolutes(&of_p), n, &l) + value(&absolutes(&of_f), m, &l)) * outside;
            let off = (value(&exacts(&sum), degree, &lambda) - truth).abs();
            assert!(off <= scale * exact(U) * integer(factor(degree + V, 0)), "sum");
        }
    }
}

#[test]
fn products_are_exact_to_their_bound() {
    products::<2>(90, 1000);
    products::<3>(91, 1000);
    products::<4>(92, 1000);
}

/// Powers of 1 stay 1 to degree 200, and points of 10¹⁰⁰ do not overflow.
#[test]
fn products_to_degree_200() {
    let ones = vec![1e100; simplex_count::<3>(100)];
    let mut out = vec![0.0; simplex_count::<3>(200)];
    net::<3>(&ones, 100).product(&net(&ones, 100), &mut out).unwrap();
    for got in out {
        assert_accurate(got / 1e100, 1e100, 200, 0, 1e100, "1·1");
    }
    let few = vec![1.0; simplex_count::<4>(2)];
    let many = vec![1.0; simplex_count::<4>(58)];
    let mut out = vec![0.0; simplex_count::<4>(60)];
    net::<4>(&many, 58).product(&net(&few, 2), &mut out).unwrap();
    for got in out {
        assert_accurate(got, 1.0, 60, 0, 1.0, "1·1");
    }
}

fn reduction<const V: usize>(seed: u64, pairs: &[(usize, usize)]) {
    let mut hunter = Hunter::new(seed);
    for &(from, to) in pairs {
        let low: Vec<f64> = (0..simplex_count::<V>(to)).map(|_| hunter.unit() * 4.0 - 2.0).collect();
        let high = elevated::<V>(&low, to, from);
        let mut out = vec![f64::NAN; low.len()];
        let mut scratch = vec![f64::NAN; 4 * high.len()];
        let bound = net::<V>(&high, from).reduce(to, &mut out, &mut scratch).unwrap();
        // The square of the smallest singular value of elevation, from m to n on the interval.
        let condition =
            (to + 1..=from).fold(1.0, |c, j| c / (1.0 - (to * (to + 1)) as f64 / (j * (j + 1)) as f64));
        let allowed = (4 * (from + 2)) as f64 * U * condition * (2.0 * (high.len() as f64).sqrt());
        let off = low.iter().zip(&out).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
        assert!(off <= allowed, "{from} to {to} over {V}: off {off:e}, allowed {allowed:e}");
        assert!(bound <= allowed, "{from} to {to}: bound {bound:e}");

        // Any other polynomial: the bound holds, vertices stay, and neighbours of the answer are farther away.
        let any: Vec<f64> = (0..high.len()).map(|_| hunter.unit()).collect();
        let bound = net::<V>(&any, from).reduce(to, &mut out, &mut scratch).unwrap();
        let distance = |q: &[f64]| -> (f64, f64) {
            let again = elevated::<V>(q, to, from);
            let off = again.iter().zip(&any).map(|(a, b)| (a - b).abs());
            (off.clone().fold(0.0, f64::max), off.map(|x| x * x).sum())
        };
        let (largest, squares) = distance(&out);
        assert!(largest <= bound && bound <= largest * (1.0 + 1e-12) + 1e-14, "{largest} {bound}");
        for (place, index) in indices(V, to).iter().enumerate() {
            if let Some(vertex) = index.iter().position(|&b| b == to && to > 0) {
                let mut corner = [0; V];
                corner[vertex] = from;
                assert_eq!(out[place], any[simplex_index(corner)], "vertex {vertex}");
                continue;
            }
            for shift in [1e-3, -1e-3] {
                let mut moved = out.clone();
                moved[place] += shift;
                assert!(distance(&moved).1 > squares, "{from} to {to}: point {place} is not at the minimum");
            }
        }
        for _ in 0..20 {
            let mut lambda = [0.0; V];
            lambda.fill_with(|| hunter.unit());
            let sum: f64 = lambda.iter().sum();
            lambda = lambda.map(|l| l / sum);
            let off = (net::<V>(&any, from).value(lambda) - net::<V>(&out, to).value(lambda)).abs();
            assert!(off <= bound, "{off} {bound}");
        }
    }
}

#[test]
fn reduction_is_exact_where_it_can_be_and_the_nearest_elsewhere() {
    reduction::<2>(100, &[(3, 2), (10, 5), (20, 10)]);
    reduction::<3>(101, &[(1, 0), (2, 1), (3, 2), (5, 4), (8, 3), (12, 8), (20, 18)]);
    reduction::<4>(102, &[(2, 1), (3, 2), (5, 3), (7, 4)]);
}

/// Whatever is elevated comes back, points of very different size included.
fn reduction_of_elevated<const V: usize>(seed: u64) {
    let mut hunter = Hunter::new(seed);
    for _ in 0..rounds(1000) {
        let to = 1 + hunter.degree_of(4, 10, 100);
        let from = to + 1 + hunter.below(3);
        let low = hunter.numbers(simplex_count::<V>(to));
        let high = elevated::<V>(&low, to, from);
        let mut out = vec![f64::NAN; low.len()];
        let bound = net::<V>(&high, from).reduce(to, &mut out, &mut vec![f64::NAN; 4 * high.len()]).unwrap();
        // κ² is the product over the degrees; κ²·n·u times the length of P, at most √count of its largest point.
        let condition =
            (to + 1..=from).fold(1.0, |c, j| c / (1.0 - (to * (to + 1)) as f64 / (j * (j + 1)) as f64));
        let largest = high.iter().fold(f64::MIN_POSITIVE, |m: f64, p| m.max(p.abs()));
        let length = largest * high.iter().map(|p| (p / largest).powi(2)).sum::<f64>().sqrt();
        let allowed = (4 * (from + 2)) as f64 * U * condition * length + f64::MIN_POSITIVE;
        let off = low.iter().zip(&out).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
        assert!(off <= allowed, "{from} to {to} over {V}: off {off:e}, allowed {allowed:e}");
        assert!(bound <= allowed, "{from} to {to}: bound {bound:e}");
    }
}

#[test]
fn reduction_undoes_elevation() {
    reduction_of_elevated::<3>(103);
    reduction_of_elevated::<4>(104);
}

#[test]
fn wrong_lengths_and_degrees_are_refused() {
    let points = [0.0; 6];
    let net = TriangleNet::new(&points, 2).unwrap();
    let length = |buffer, needed, given| Err(BernsteinError::BufferLength { buffer, needed, given });
    assert_eq!(net.elevate(3, &mut [0.0; 9]), length("out", 10, 9));
    assert_eq!(net.elevate(1, &mut [0.0; 3]), Err(BernsteinError::ElevatedDegree { from: 2, to: 1 }));
    assert_eq!(
        net.elevate(501, &mut []),
        Err(BernsteinError::Degree { degree: 501, limit: casteljau_bernstein::MAX_DEGREE })
    );
    let refused = net.reduce(3, &mut [0.0; 10], &mut [0.0; 24]);
    assert_eq!(refused, Err(BernsteinError::ReducedDegree { from: 2, to: 3 }));
    let refused = net.reduce(1, &mut [0.0; 3], &mut [0.0; 23]);
    assert_eq!(refused.err(), length("scratch", 24, 23).err());
    let corners = TRIANGLE_QUARTERS[0];
    assert_eq!(net.restrict(corners, &mut [0.0; 5], &mut [0.0; 18]), length("out", 6, 5));
    assert_eq!(net.restrict(corners, &mut [0.0; 6], &mut [0.0; 17]), length("scratch", 18, 17));
    assert_eq!(net.split_at([1.0, 0.0, 0.0], &mut [0.0; 12]), length("out", 18, 12));
    assert_eq!(
        net.split_edge([1, 1], 0.5, &mut [0.0; 6], &mut [0.0; 6]),
        Err(BernsteinError::Vertices { vertex: 1, vertices: 3 })
    );
    assert_eq!(net.product(&net, &mut [0.0; 14]), length("out", 15, 14));
    assert_eq!(net.sum(&net, &mut [0.0; 7]), length("out", 6, 7));
    assert_eq!(net.scheme([0.0; 3], &mut [0.0; 9]), length("out", 10, 9));
    let refused = net.blossom(&[[0.0; 3]], &mut [0.0; 6]);
    assert_eq!(refused.err(), length("arguments", 2, 1).err());
    // A net that does not fit its degree gives meaningless values, but no panic.
    let broken = TriangleNet::validated(&points[..2], 4);
    assert_eq!(broken.value([0.2, 0.3, 0.5]), 0.0);
    broken.partials([0.2, 0.3, 0.5], &mut [0.0; 7]);
    assert!(broken.split_at([0.2, 0.3, 0.5], &mut [0.0; 45]).is_ok());
    let broken = TriangleNet::validated(&points[..2], usize::MAX);
    assert!(broken.value([0.2, 0.3, 0.5]).is_nan());
    assert!(broken.split_at([0.2, 0.3, 0.5], &mut [0.0; 45]).is_err());
    assert!(broken.scheme([0.2, 0.3, 0.5], &mut [0.0; 45]).is_err());
    assert!(broken.product(&broken, &mut [0.0; 45]).is_err());
    assert!(broken.de_casteljau([0.2, 0.3, 0.5], &mut [0.0; 45]).is_nan());
}

/// Composition with arguments over a triangle and over a wedge, and of a triangle with such arguments.
#[test]
fn compositions() {
    let mut hunter = Hunter::new(110);
    for _ in 0..rounds(1000) {
        let (n, d) = (hunter.below(5), hunter.below(4));
        let outer: Vec<f64> = (0..simplex_count::<3>(n)).map(|_| hunter.unit() - 0.5).collect();
        let mut argument =
            || -> Vec<f64> { (0..simplex_count::<3>(d)).map(|_| hunter.unit() / 2.0).collect() };
        let (first, second) = (argument(), argument());
        let third: Vec<f64> = first.iter().zip(&second).map(|(a, b)| 1.0 - a - b).collect();
        let mut out = vec![f64::NAN; simplex_count::<3>(n * d)];
        compose_simplex(&outer, n, &[&first, &second, &third], SimplexSpace::<3>(d), &mut out).unwrap();
        let (a, b) = (hunter.unit() / 2.0, hunter.unit() / 2.0);
        let lambda = [a, b, 1.0 - a - b];
        let inner = [&first, &second, &third].map(|q| net::<3>(q, d).value(lambda));
        let got = net::<3>(&out, n * d).value(lambda);
        // Coordinates are rounded by 4(d+2)u, and |p′| ≤ 2n; the rest is the bound of the composition.
        assert_accurate(
            got,
            net::<3>(&outer, n).value(inner),
            4 * n * (d + 2) + n * d,
            0,
            1.0,
            "triangle in triangle",
        );

        let curve = &outer[..n + 1];
        compose(curve, [n], [&first], SimplexSpace::<3>(d), &mut out).unwrap();
        let got = net::<3>(&out, n * d).value(lambda);
        assert_accurate(got, value(curve, inner[0]), 4 * n * (d + 2) + n * d, 0, 1.0, "curve in triangle");

        let degrees = [d, 1];
        let height: Vec<f64> = first.iter().flat_map(|&q| [q, 1.0 - q]).collect();
        let mut out = vec![f64::NAN; WedgeNet::<f64>::count([n * d, n])];
        compose(curve, [n], [&height], WedgeSpace(degrees), &mut out).unwrap();
        let inner = WedgeNet::new(&height, degrees).unwrap().value(lambda, a);
        let got = WedgeNet::new(&out, [n * d, n]).unwrap().value(lambda, a);
        assert_accurate(got, value(curve, inner), 4 * n * (d + 3) + n * (d + 1), 0, 1.0, "curve in wedge");
    }
}
