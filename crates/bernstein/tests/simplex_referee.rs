//! Simplices and wedges against exact arithmetic: values, derivatives, basis, blossom.
#![allow(clippy::unwrap_used, clippy::expect_used)] // helpers of tests

mod support;

use num_traits::{One, Zero};

use casteljau_bernstein::{
    SimplexNet, WedgeNet, last_barycentric, simplex_basis, simplex_basis_partials, simplex_count,
};
use support::U;
use support::exact::{
    Hunter, Q, absolute_pair, absolutes, assert_within, differentiate, dot, exact, exacts, factor, integer,
    pair, rounds,
};
use support::simplices::{absolute, basis, blossom, differentiated, floor, indices, place};

#[test]
fn places_of_the_referee_count_up() {
    for (vertices, degree) in [(2, 9), (3, 0), (3, 12), (4, 11)] {
        let places: Vec<usize> = indices(vertices, degree).iter().map(|index| place(index)).collect();
        assert!(places.iter().copied().eq(0..places.len()), "{vertices} {degree}: {places:?}");
    }
}

fn values<const V: usize>(seed: u64, cases: usize, most: usize) {
    let mut hunter = Hunter::new(seed);
    for case in 0..rounds(cases) {
        // One in a hundred up to the limit.
        let n = if case == 0 { most } else { hunter.degree_of(9, most, 100) };
        let (points, lambda) = (hunter.numbers(simplex_count::<V>(n)), hunter.barycentric::<V>());
        let (q, l) = (exacts(&points), exacts(&lambda));
        let truth = dot(&basis(n, &l), &q);
        let absolute_basis = basis(n, &absolute(&l));
        let scale = dot(&absolute_basis, &absolutes(&q)) + floor(&q);
        let net = SimplexNet::<_, V>::new(&points, n).unwrap();
        let what = format!("degree {n} at {lambda:?}");
        assert_within(net.value(lambda), &truth, &scale, factor(n, 0), &what);
        let mut scratch = vec![0.0; points.len()];
        assert_within(net.de_casteljau(lambda, &mut scratch), &truth, &scale, factor(n, 0), &what);
        if n > 20 {
            continue;
        }
        let mut b = vec![0.0; points.len()];
        simplex_basis(n, lambda, &mut b).unwrap();
        for (b, truth) in b.iter().zip(basis(n, &l)) {
            assert_within(*b, &truth, &truth.abs(), factor(n, 0), &what);
        }
    }
}

#[test]
fn values_over_triangles() {
    values::<3>(11, 1000, 40);
}

#[test]
fn values_over_tetrahedra() {
    values::<4>(12, 1000, 40);
}

#[test]
fn values_over_intervals() {
    values::<2>(13, 1000, 100);
}

/// Degrees up to `most`, one in `rarely` of them; of a high one derivatives to order 2.
fn partials<const V: usize>(seed: u64, cases: usize, most: usize, rarely: usize) {
    let mut hunter = Hunter::new(seed);
    for case in 0..rounds(cases) {
        let n = if case == 0 { most } else { hunter.degree_of(5, most, rarely) };
        let order = if n > 5 { 2 } else { hunter.below(5) };
        let (points, lambda) = (hunter.numbers(simplex_count::<V>(n)), hunter.barycentric::<V>());
        let (q, l) = (exacts(&points), exacts(&lambda));
        let net = SimplexNet::<_, V>::new(&points, n).unwrap();
        let mut out = vec![f64::NAN; simplex_count::<V>(order) + 1];
        net.partials(lambda, &mut out);
        assert_eq!(out.pop(), Some(0.0), "places beyond are set to zero");
        let mut rows = vec![f64::NAN; out.len() * points.len()];
        simplex_basis_partials(n, lambda, order, &mut rows).unwrap();
        for ((orders, got), row) in indices(V, order).iter().zip(out).zip(rows.chunks(points.len())) {
            let (total, orders) = (order - orders[0], &orders[1..]);
            let what = format!("{orders:?} of degree {n} at {lambda:?}");
            let lower = n.saturating_sub(total);
            let (weights, sizes) = (basis(lower, &l), basis(lower, &absolute(&l)));
            let of = |points: &[Q], sign| differentiated(points, n, V, orders, sign);
            let scale = dot(&sizes, &of(&absolutes(&q), 1)) + floor(&q) * integer(n * n * n + 1);
            assert_within(got, &dot(&weights, &of(&q, -1)), &scale, factor(n, total), &what);
            if n > 3 {
                continue;
            }
            for (place, &b) in row.iter().enumerate() {
                let mut unit = vec![Q::zero(); points.len()];
                unit[place] = Q::one();
                let scale = dot(&sizes, &of(&unit, 1));
                assert_within(b, &dot(&weights, &of(&unit, -1)), &scale, factor(n, total), &what);
            }
        }
    }
}

#[test]
fn partials_over_triangles() {
    partials::<3>(21, 1000, 40, 100);
}

#[test]
fn partials_over_tetrahedra() {
    partials::<4>(22, 1000, 40, 400);
}

/// Blossoms, and directional derivatives as blossoms with vectors among the arguments.
fn blossoms<const V: usize>(seed: u64, cases: usize) {
    let mut hunter = Hunter::new(seed);
    for _ in 0..rounds(cases) {
        let n = hunter.degree_of(6, 40, if V == 3 { 100 } else { 400 });
        let points = hunter.numbers(simplex_count::<V>(n));
        let q = exacts(&points);
        let net = SimplexNet::<_, V>::new(&points, n).unwrap();
        let mut scratch = vec![0.0; points.len()];
        let arguments: Vec<[f64; V]> = (0..n).map(|_| hunter.barycentric::<V>()).collect();
        let l: Vec<Vec<Q>> = arguments.iter().map(|a| exacts(a)).collect();
        let sizes: Vec<Vec<Q>> = l.iter().map(|l| absolute(l)).collect();
        let scale = blossom(&absolutes(&q), n, &sizes) + floor(&q);
        let got = net.blossom(&arguments, &mut scratch).unwrap();
        assert_within(got, &blossom(&q, n, &l), &scale, factor(n, 0), "blossom");

        let order = hunter.below(n.min(4) + 1);
        let lambda = hunter.barycentric::<V>();
        let directions = &arguments[..order];
        let got = net.directional(lambda, directions, &mut scratch).unwrap();
        let vectors = |implied: fn(Q) -> Q, size: fn(&[Q]) -> Vec<Q>| {
            let mut list = vec![size(&exacts(&lambda)); n];
            for (place, direction) in list.iter_mut().zip(directions) {
                *place = size(&exacts(direction));
                let sum = place[..V - 1].iter().sum();
                place[V - 1] = implied(sum);
            }
            list
        };
        let falling = (n - order + 1..=n).fold(Q::one(), |f, m| f * integer(m));
        let truth = &falling * blossom(&q, n, &vectors(|sum| -sum, <[Q]>::to_vec));
        let scale = falling * (blossom(&absolutes(&q), n, &vectors(|sum| sum, absolute)) + floor(&q));
        assert_within(got, &truth, &scale, factor(n, order), "directional derivative");
    }
}

#[test]
fn blossoms_over_triangles() {
    blossoms::<3>(31, 1000);
}

#[test]
fn blossoms_over_tetrahedra() {
    blossoms::<4>(32, 1000);
}

#[test]
fn the_last_barycentric_keeps_its_digits() {
    let mut hunter = Hunter::new(41);
    for _ in 0..rounds(5000) {
        let free = [hunter.parameter(), hunter.parameter() - 0.5, hunter.parameter()];
        for free in [&free[..1], &free[..2], &free] {
            let truth = Q::one() - free.iter().map(|&x| exact(x)).sum::<Q>();
            let all = Q::one() + free.iter().map(|&x| exact(x).abs()).sum::<Q>();
            let scale = truth.abs() + all * exact(U) * integer(2 * free.len());
            assert_within(last_barycentric(free), &truth, &scale, 2, "last barycentric");
        }
    }
}

#[test]
fn wedges() {
    let mut hunter = Hunter::new(51);
    for case in 0..rounds(1000) {
        let (n, o) = match case {
            0 => (20, 20),
            _ => (hunter.degree_of(4, 20, 50), hunter.degree_of(4, 20, 50)),
        };
        let order = if n.max(o) > 4 { 1 } else { hunter.below(4) };
        let points = hunter.numbers(WedgeNet::<f64>::count([n, o]));
        let (lambda, w) = (hunter.barycentric::<3>(), hunter.parameter());
        let net = WedgeNet::new(&points, [n, o]).unwrap();
        let mut out = vec![f64::NAN; simplex_count::<4>(order)];
        net.partials(lambda, w, &mut out);
        assert_eq!(out[0], net.value(lambda, w));
        let (q, l, x) = (exacts(&points), exacts(&lambda), exact(w));
        // Along the height first, for each multi-index; then over the triangle.
        let exact_partial = |q: &[Q], [a, b, c]: [usize; 3], size: bool| -> Q {
            if a + b > n || c > o {
                return Q::zero();
            }
            let (s, t) = if size { absolute_pair(&x) } else { pair(&x) };
            let in_height = support::exact::basis_of(o - c, &s, &t);
            let curve: Vec<Q> = q
                .chunks(o + 1)
                .map(|row| {
                    let mut row = row.to_vec();
                    for _ in 0..c {
                        row = if size {
                            let degree = integer(row.len() - 1);
                            row.windows(2).map(|w| (&w[1] + &w[0]) * &degree).collect()
                        } else {
                            differentiate(&row)
                        };
                    }
                    dot(&in_height, &row)
                })
                .collect();
            let l = if size { absolute(&l) } else { l.clone() };
            let net = differentiated(&curve, n, 3, &[a, b], if size { 1 } else { -1 });
            dot(&basis(n - a - b, &l), &net)
        };
        for (orders, got) in indices(4, order).into_iter().zip(out) {
            let orders = [orders[1], orders[2], orders[3]];
            let scale = exact_partial(&absolutes(&q), orders, true) + floor(&q) * integer(1000);
            let what = format!("{orders:?} of {n} × {o} at {lambda:?}, {w:e}");
            let k = orders.iter().sum();
            assert_within(got, &exact_partial(&q, orders, false), &scale, factor(n + o, k), &what);
        }

        // Along one direction: the same, by the multinomial expansion in the partial derivatives.
        let (d, e) = ([hunter.number(), hunter.number(), 0.0], hunter.number());
        let mut scratch = vec![0.0; points.len() + o + 2 + order];
        let got = net.directional((lambda, w), (d, e), order, &mut scratch).unwrap();
        let expansion = |size: bool| -> Q {
            let q = if size { absolutes(&q) } else { q.clone() };
            let d = exacts(&[d[0], d[1], e]);
            let d = if size { absolute(&d) } else { d };
            let terms = indices(3, order).into_iter().zip(basis(order, &d));
            terms.map(|(a, weight)| weight * exact_partial(&q, [a[0], a[1], a[2]], size)).sum()
        };
        let scale = expansion(true) + floor(&q) * integer(1000);
        assert_within(got, &expansion(false), &scale, factor(n + o, order), "along a direction");

        // The scheme ends at the value; the blossom with equal arguments is the value.
        let mut scheme = vec![f64::NAN; simplex_count::<4>(n) * (o + 1) + o * (o + 1) / 2];
        net.scheme(lambda, w, &mut scheme).unwrap();
        let blossom = net.blossom(&vec![lambda; n], &vec![w; o], &mut scratch).unwrap();
        let truth = exact_partial(&q, [0; 3], false);
        let scale = exact_partial(&absolutes(&q), [0; 3], true) + floor(&q);
        for got in [blossom, *scheme.last().unwrap()] {
            assert_within(got, &truth, &scale, factor(n + o, 0), "by levels");
        }
        assert_eq!(scheme[..points.len()], points);
    }
}
