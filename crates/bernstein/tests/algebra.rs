//! Sums, products, conversions, integrals, matrices and reduction against exact cases and exact arithmetic.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_bernstein::{
    BernsteinError, MAX_DEGREE, antiderivative, antiderivative_along, binomial, elevate, elevation_matrix,
    from_power, from_power_tensor, integral, integral_over, integral_over_tensor, inverse_power_matrix,
    moment, moment_tensor, power_matrix, product, product_tensor, reduce, reduce_along, restrict,
    restriction_matrix, sum, sum_tensor, to_power, to_power_tensor, value,
};
use support::exact::{
    Hunter, Q, absolutes, assert_within, choose, dot, exact, exacts, factor, factorial, integer, power,
    powers, product as product_line, rounds, value as exact_value,
};
use support::{U, assert_accurate, cases, count, flat, numbers, size};

#[test]
fn products_on_the_interval() {
    let mut hunter = Hunter::new(21);
    for round in 0..rounds(1000) {
        let (m, n) = match round {
            0 => (100, 100),
            1 => (3, 197),
            _ => (hunter.degree(40), hunter.degree(40)),
        };
        let (a, b) = (hunter.numbers(m + 1), hunter.numbers(n + 1));
        let mut out = vec![0.0; m + n + 1];
        product(&a, &b, &mut out).unwrap();
        let (a, b) = (exacts(&a), exacts(&b));
        let truth = product_line(&a, &b);
        let scale = product_line(&absolutes(&a), &absolutes(&b));
        for k in 0..=m + n {
            assert_within(out[k], &truth[k], &scale[k], factor(m + n, 0), &format!("{m} × {n}, {k}"));
        }
    }
    let large = vec![1e150; 251];
    let mut out = vec![0.0; MAX_DEGREE + 1];
    product(&[1.0; 251], &large, &mut out).unwrap();
    assert!(out.iter().all(|x| (x / 1e150 - 1.0).abs() <= factor(MAX_DEGREE, 0) as f64 * U));
    assert!(matches!(product(&[1.0; 251], &[1.0; 252], &mut [0.0; 502]), Err(BernsteinError::Degree { .. })));
    assert_eq!(product::<f64>(&[1.0], &[], &mut []), Err(BernsteinError::NoPoints));
}

/// Tensor products of polynomials by their values: exact weights are products of those of the axes.
#[test]
fn products_of_nets() {
    let mut hunter = Hunter::new(22);
    for round in 0..rounds(1000) {
        // One in a hundred of degree 20 along an axis.
        let [mut a_degrees, mut b_degrees] = [0; 2].map(|_: usize| [0; 3].map(|_: usize| hunter.below(3)));
        if round % 100 == 0 {
            let axis = hunter.below(3);
            (a_degrees[axis], b_degrees[axis]) = (10, 10);
        }
        let (a, b) = (hunter.numbers(count(&a_degrees)), hunter.numbers(count(&b_degrees)));
        let degrees = [0, 1, 2].map(|axis| a_degrees[axis] + b_degrees[axis]);
        let mut out = vec![0.0; count(&degrees)];
        product_tensor(&a, a_degrees, &b, b_degrees, &mut out).unwrap();
        let mut truth = vec![integer(0); out.len()];
        let mut scale = truth.clone();
        let index = |place: usize, d: [usize; 3]| {
            [place / (d[2] + 1) / (d[1] + 1), place / (d[2] + 1) % (d[1] + 1), place % (d[2] + 1)]
        };
        for (p, a) in a.iter().enumerate() {
            for (q, b) in b.iter().enumerate() {
                let (i, j) = (index(p, a_degrees), index(q, b_degrees));
                let (mut weight, mut place) = (integer(1), 0);
                for axis in 0..3 {
                    let k = i[axis] + j[axis];
                    weight *= choose(a_degrees[axis], i[axis]) * choose(b_degrees[axis], j[axis])
                        / choose(degrees[axis], k);
                    place = place * (degrees[axis] + 1) + k;
                }
                let term = weight * exact(*a) * exact(*b);
                scale[place] += term.abs();
                truth[place] += term;
            }
        }
        let meet: usize = (0..3).map(|axis| a_degrees[axis].min(b_degrees[axis]) + 1).product();
        for k in 0..out.len() {
            assert_within(out[k], &truth[k], &scale[k], meet + 24, "tensor product");
        }
    }
}

#[test]
fn golden_products() {
    for case in cases("products.json") {
        if case["kind"] == "curve_product" {
            let (a, b) = (numbers(&case["a"]), numbers(&case["b"]));
            let mut out = vec![0.0; a.len() + b.len() - 1];
            product(&a, &b, &mut out).unwrap();
            let absolute = |list: &[f64]| list.iter().map(|x| x.abs()).collect::<Vec<_>>();
            let mut scale = out.clone();
            product(&absolute(&a), &absolute(&b), &mut scale).unwrap();
            for (k, exact) in numbers(&case["expected"]).into_iter().enumerate() {
                assert_accurate(out[k], exact, out.len() - 1, 0, scale[k], "product");
            }
            let exact = support::number(&case["integral"]);
            assert_accurate(
                integral(&out),
                exact,
                out.len() + 4,
                0,
                integral(&scale),
                "integral of a product",
            );
        } else {
            let [a_degrees, b_degrees] = [0, 1].map(|i| [0, 1, 2].map(|j| size(&case["degrees"][i][j])));
            let (a, b, expected) = (flat(&case["a"], 3), flat(&case["b"], 3), flat(&case["expected"], 3));
            let mut out = vec![0.0; expected.len()];
            product_tensor(&a, a_degrees, &b, b_degrees, &mut out).unwrap();
            let largest = |list: &[f64]| list.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            let scale = largest(&a) * largest(&b);
            for (got, exact) in out.iter().zip(expected) {
                assert_accurate(*got, exact, 6, 0, scale, "tensor product");
            }
            let exact = support::number(&case["integral"]);
            assert_accurate(integral(&out), exact, 6, 0, scale, "integral of a product");
        }
    }
}

#[test]
fn sums_of_different_degrees() {
    let mut hunter = Hunter::new(23);
    for _ in 0..rounds(1000) {
        let (a, b) = (hunter.degree(100), hunter.degree(100));
        let (a, b) = (hunter.numbers(a + 1), hunter.numbers(b + 1));
        let mut out = vec![0.0; a.len().max(b.len())];
        sum(&a, &b, &mut out).unwrap();
        let ones = |n: usize| vec![integer(1); n];
        let lift = |list: &[Q]| product_line(&ones(out.len() - list.len() + 1), list);
        let (a, b) = (exacts(&a), exacts(&b));
        let (truth, scale) = ((lift(&a), lift(&b)), (lift(&absolutes(&a)), lift(&absolutes(&b))));
        for (k, &got) in out.iter().enumerate() {
            let (truth, scale) = (&truth.0[k] + &truth.1[k], &scale.0[k] + &scale.1[k]);
            assert_within(got, &truth, &scale, factor(out.len() - 1, 0), "sum");
        }
    }
    // u² + v, where neither net has the degrees of the sum.
    let (mut out, mut work) = ([0.0; 6], [0.0; 6]);
    sum_tensor(&[0.0, 0.0, 1.0], [2, 0], &[0.0, 1.0], [0, 1], &mut out, &mut work).unwrap();
    assert_eq!(out, [0.0, 1.0, 0.0, 1.0, 1.0, 2.0]);
    let refused = sum_tensor(&[0.0, 1.0], [1, 0], &[0.0, 1.0], [0, 1], &mut [0.0; 4], &mut [0.0; 3]);
    assert_eq!(refused, Err(BernsteinError::BufferLength { buffer: "work", needed: 4, given: 3 }));
    assert!(sum(&[0.0, 1.0], &[1.0], &mut [0.0; 3]).is_err());
}

/// `Pⱼ = Σᵢ aᵢ / C(n,i) Σ_l C(j,l) C(n−j,i−l) bˡ aⁱ⁻ˡ`, with everything taken absolutely for the scale.
fn from_power_line(coefficients: &[Q], a: &Q, b: &Q) -> Vec<Q> {
    let n = coefficients.len() - 1;
    let (a, b) = (powers(a, n), powers(b, n));
    let symmetric = |j: usize, i: usize| -> Q {
        (i.saturating_sub(n - j)..=i.min(j))
            .map(|l| choose(j, l) * choose(n - j, i - l) * &b[l] * &a[i - l])
            .sum()
    };
    (0..=n).map(|j| (0..=n).map(|i| &coefficients[i] / choose(n, i) * symmetric(j, i)).sum()).collect()
}

/// Coefficients of `Σ C(n,j) Pⱼ ((b−t)/(b−a))ⁿ⁻ʲ ((t−a)/(b−a))ʲ`; for the scale with −a, b and signs of
/// differences taken absolutely.
fn to_power_line(points: &[Q], [a, b]: [&Q; 2], absolute: bool) -> Vec<Q> {
    let n = points.len() - 1;
    let length = if absolute { (b - a).abs() } else { b - a };
    let (s, t) = if absolute { (b.abs(), a.abs()) } else { (b.clone(), -a) };
    let minus = integer(1) * if absolute { integer(1) } else { -integer(1) };
    (0..=n)
        .map(|i| {
            let difference = |j: usize| -> Q {
                (0..=i).map(|l| power(&minus, i - l) * choose(i, l) * &points[j + l]).sum()
            };
            let sum: Q = (0..=n - i)
                .map(|j| choose(n - i, j) * power(&s, n - i - j) * power(&t, j) * difference(j))
                .sum();
            choose(n, i) * sum / power(&length, n)
        })
        .collect()
}

#[test]
fn conversion_from_and_to_the_power_basis() {
    let mut hunter = Hunter::new(24);
    for round in 0..rounds(1000) {
        let n = [100, 60, 40].get(round).copied().unwrap_or_else(|| hunter.degree(40));
        let list = hunter.numbers(n + 1);
        let interval = match hunter.below(4) {
            0 => [0.0, 1.0],
            1 => [-1.0, 1.0],
            _ => [hunter.unit() * 4.0 - 2.0, hunter.unit() * 4.0 - 2.0],
        };
        let [a, b] = interval.map(exact);
        let mut out = vec![0.0; n + 1];
        from_power(&list, interval, &mut out).unwrap();
        let q = exacts(&list);
        let (truth, scale) =
            (from_power_line(&q, &a, &b), from_power_line(&absolutes(&q), &a.abs(), &b.abs()));
        for i in 0..=n {
            assert_within(out[i], &truth[i], &scale[i], factor(n, 0), &format!("degree {n}, {interval:?}"));
        }
        if n <= 60 {
            to_power(&list, interval, &mut out).unwrap();
            let truth = to_power_line(&q, [&a, &b], false);
            let scale = to_power_line(&absolutes(&q), [&a, &b], true);
            for i in 0..=n {
                assert_within(out[i], &truth[i], &scale[i], factor(n, 0), &format!("to {n}, {interval:?}"));
            }
        }
    }
    // Nets: (1 + 2u)(3 − v) over [0, 2] × [−1, 1], and back.
    let (mut points, mut back) = ([0.0; 4], [0.0; 4]);
    let intervals = [[0.0, 2.0], [-1.0, 1.0]];
    from_power_tensor(&[3.0, -1.0, 6.0, -2.0], [1, 1], intervals, &mut points).unwrap();
    assert_eq!(points, [4.0, 2.0, 20.0, 10.0]);
    to_power_tensor(&points, [1, 1], intervals, &mut back).unwrap();
    assert_eq!(back, [3.0, -1.0, 6.0, -2.0]);
    assert!(from_power(&[1.0], [0.0, 1.0], &mut []).is_err());
    assert_eq!(to_power::<f64>(&[], [0.0, 1.0], &mut []), Err(BernsteinError::NoPoints));
}

#[test]
fn golden_conversion() {
    for case in cases("conversion.json") {
        let kind = case["kind"].as_str().unwrap();
        if kind.starts_with("matrix_cubic") {
            let mut matrix = [0.0; 16];
            power_matrix(3, &mut matrix).unwrap();
            assert_eq!(matrix.to_vec(), flat(&case["expected"], 2));
            continue;
        }
        let (input, n) = (numbers(&case["input"]), size(&case["degree"]));
        let interval = if case["interval"].is_array() { numbers(&case["interval"]) } else { vec![0.0, 1.0] };
        let q = absolutes(&exacts(&input));
        let [a, b] = [0, 1].map(|i| exact(interval[i]));
        match kind {
            "power_to_bernstein" | "power_to_bernstein_on_interval" => {
                let mut out = vec![0.0; n + 1];
                from_power(&input, [interval[0], interval[1]], &mut out).unwrap();
                let scale = from_power_line(&q, &a.abs(), &b.abs());
                for (i, exact) in numbers(&case["expected"]).into_iter().enumerate() {
                    assert_accurate(out[i], exact, n, 0, scale[i].to_f64(), kind);
                }
            }
            _ => {
                let mut out = vec![0.0; n + 1];
                to_power(&input, [interval[0], interval[1]], &mut out).unwrap();
                let scale = to_power_line(&q, [&a, &b], true);
                for (i, exact) in numbers(&case["expected"]).into_iter().enumerate() {
                    assert_accurate(out[i], exact, n, 0, scale[i].to_f64(), kind);
                }
            }
        }
    }
}

#[test]
fn integrals_and_moments() {
    let mut hunter = Hunter::new(25);
    for _ in 0..rounds(1000) {
        let n = hunter.degree(100);
        let points = hunter.numbers(n + 1);
        let (q, absolute) = (exacts(&points), absolutes(&exacts(&points)));
        let mean = |list: &[Q]| list.iter().sum::<Q>() / integer(n + 1);
        assert_within(integral(&points), &mean(&q), &mean(&absolute), 12, "integral");
        // The antiderivative, and through it the integral over an interval.
        let mut whole = vec![0.0; n + 2];
        antiderivative(&points, &mut whole).unwrap();
        let running = |list: &[Q]| -> Vec<Q> {
            (0..=n + 1).map(|i| list[..i].iter().sum::<Q>() / integer(n + 1)).collect()
        };
        let (exact_whole, scale) = (running(&q), running(&absolute));
        for i in 0..=n + 1 {
            assert_within(whole[i], &exact_whole[i], &scale[i], n + 2, "antiderivative");
        }
        let interval = [hunter.parameter(), hunter.parameter()];
        let mut work = vec![0.0; n + 1];
        let got = integral_over(&points, interval, &mut work).unwrap();
        let truth =
            exact_value(&exact_whole, &exact(interval[1])) - exact_value(&exact_whole, &exact(interval[0]));
        // The scale from above: every combination by the larger of its sums.
        let grow = interval.map(|t| t.abs().max((1.0 - t).abs())).into_iter().fold(1.0, f64::max);
        let spread = interval.map(|t| t.abs() + (1.0 - t).abs()).into_iter().fold(1.0, f64::max);
        assert!(grow <= spread);
        let scale = power(&exact(spread), n)
            * absolute.iter().max().unwrap()
            * exact(interval[1] - interval[0]).abs();
        assert_within(got, &truth, &scale, 4 * (n + 4), &format!("integral over {interval:?}"));
        let k = hunter.below(6);
        let weight = |i: usize| choose(n, i) / choose(n + k, i + k) / integer(n + k + 1);
        let weights: Vec<Q> = (0..=n).map(weight).collect();
        let got = moment(&points, k).unwrap();
        assert_within(got, &dot(&weights, &q), &dot(&weights, &absolute), factor(n + k, 0), "moment");
    }
    // u v² over the square, its halves and its moments.
    let net = [0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    assert_eq!(integral(&net), 1.0 / 6.0);
    let part = integral_over_tensor(&net, [1, 2], [[0.0, 1.0], [1.0, 0.0]], &mut [0.0; 6]).unwrap();
    assert_eq!(part, -1.0 / 6.0);
    assert_accurate(moment_tensor(&net, [1, 2], [2, 1]).unwrap(), 1.0 / 16.0, 6, 0, 1.0 / 16.0, "moment");
    let mut out = [0.0; 8];
    antiderivative_along(&net, [1, 2], 1, &mut out).unwrap();
    assert_eq!(out, [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0 / 3.0]);
    assert!(integral_over(&[1.0, 2.0], [0.0, 1.0], &mut [0.0]).is_err());
    assert_eq!(moment::<f64>(&[], 0), Err(BernsteinError::NoPoints));
}

#[test]
fn matrices() {
    for n in [0, 1, 3, 10, 33] {
        let mut to = vec![0.0; (n + 1) * (n + 1)];
        let mut from = to.clone();
        power_matrix(n, &mut to).unwrap();
        inverse_power_matrix(n, &mut from).unwrap();
        for k in 0..=n {
            for i in 0..=n {
                let sign = if (k + i) % 2 == 0 { integer(1) } else { -integer(1) };
                let truth = sign * choose(n, k) * choose(k, i);
                assert_eq!(exact(to[k * (n + 1) + i]), truth, "degree {n}");
                let truth = choose(k, i) / choose(n, i);
                assert_within(from[k * (n + 1) + i], &truth, &truth, 1, "inverse");
            }
        }
    }
    let mut hunter = Hunter::new(26);
    let points = hunter.numbers(6);
    let apply = |matrix: &[f64]| -> Vec<f64> {
        matrix.chunks(6).map(|row| row.iter().zip(&points).map(|(m, p)| m * p).sum()).collect()
    };
    let scale = points.iter().map(|p| p.abs()).sum::<f64>();
    let (mut matrix, mut direct) = (vec![0.0; 9 * 6], vec![0.0; 9]);
    elevation_matrix(5, 8, &mut matrix).unwrap();
    elevate(&points, &mut direct).unwrap();
    for (a, b) in apply(&matrix).into_iter().zip(direct) {
        assert_accurate(a, b, 2 * 8, 0, scale, "elevation");
    }
    let (mut matrix, mut direct) = (vec![0.0; 36], vec![0.0; 6]);
    restriction_matrix(5, [0.25, 1.5], &mut matrix).unwrap();
    restrict(&points, [0.25, 1.5], &mut direct).unwrap();
    for (a, b) in apply(&matrix).into_iter().zip(direct) {
        assert_accurate(a, b, 2 * 5, 0, 32.0 * scale, "restriction"); // (1.5 + 0.5)⁵
    }
    assert!(power_matrix(2, &mut [0.0; 8]).is_err());
    assert!(matches!(
        elevation_matrix(3, 2, &mut [0.0; 12]),
        Err(BernsteinError::ElevatedDegree { from: 3, to: 2 })
    ));
    assert!(matches!(power_matrix(usize::MAX, &mut []), Err(BernsteinError::Degree { .. })));
}

/// The condition of reduction, `κ² = n! (n+1)! (2m+1)! / ((n+m+1)! (n−m)! m! (m+1)!)`.
fn condition(n: usize, m: usize) -> f64 {
    let square = factorial(n) * factorial(n + 1) * factorial(2 * m + 1)
        / (factorial(n + m + 1) * factorial(n - m) * factorial(m) * factorial(m + 1));
    square.to_f64().sqrt()
}

#[test]
fn reduction_undoes_elevation() {
    let mut hunter = Hunter::new(27);
    for round in 0..rounds(1000) {
        let n = if round < 5 { 40 } else { 2 + hunter.below(29) };
        let m = 1 + hunter.below(n);
        let points: Vec<f64> = (0..=m).map(|_| hunter.unit() * 2.0 - 1.0).collect();
        let (mut high, mut low, mut work) = (vec![0.0; n + 1], vec![0.0; m + 1], vec![0.0; n + 1]);
        elevate(&points, &mut high).unwrap();
        let deviation = reduce(&high, &mut low, &mut work).unwrap();
        let norm = high.iter().map(|x| x * x).sum::<f64>().sqrt();
        let allowed = 4.0 * (n + 2) as f64 * condition(n, m) * U * norm;
        assert_eq!([low[0], low[m]], [points[0], points[m]]);
        for (got, p) in low.iter().zip(&points) {
            assert!((got - p).abs() <= allowed, "{n} to {m}: off {:e}, allowed {allowed:e}", (got - p).abs());
        }
        assert!(deviation <= 4.0 * (n + 2) as f64 * U * 8.0, "{n} to {m}: {deviation:e}");
    }
    assert!((1..30).all(|m| condition(30, m) < 364.0));
}

/// What reduction answers is the minimiser: the loss is orthogonal to everything that the lower degree offers, in
/// the integral, that is to t(1−t)tᵏ for k ≤ m − 2.
#[test]
fn reduction_is_the_best_one_and_its_bound_holds() {
    let mut hunter = Hunter::new(28);
    for _ in 0..rounds(1000) {
        let n = 2 + hunter.below(20);
        let m = hunter.below(n + 1);
        let points: Vec<f64> = (0..=n).map(|_| hunter.unit() * 2.0 - 1.0).collect();
        let (mut low, mut work) = (vec![0.0; m + 1], vec![0.0; n + 1]);
        let deviation = reduce(&points, &mut low, &mut work).unwrap();
        for i in 0..=50 {
            let t = f64::from(i) / 50.0;
            assert!(
                (value(&points, t) - value(&low, t)).abs() <= deviation + 4.0 * n as f64 * U,
                "{n} to {m}"
            );
        }
        let ones = vec![integer(1); n - m + 1];
        let lifted = product_line(&ones, &exacts(&low));
        let lost: Vec<Q> = exacts(&points).iter().zip(&lifted).map(|(p, q)| p - q).collect();
        let largest = lost.iter().map(Q::abs).max().unwrap();
        assert!(largest <= exact(deviation), "the bound is that of the polygons");
        if m == 0 {
            // n additions and a division, each off by u of Σ|Pᵢ| at most; the mean is taken n + 1 times.
            let all: Q = absolutes(&exacts(&points)).iter().sum();
            assert!(lost.iter().sum::<Q>().abs() <= all * exact((n + 2) as f64 * U));
            continue;
        }
        for k in 0..m.saturating_sub(1) {
            // t(1−t)tᵏ in Bernstein form of degree k + 2: one coefficient, 1/(k+2), at the last but one.
            let mut test = vec![integer(0); k + 3];
            test[k + 1] = integer(1) / integer(k + 2);
            let inner = product_line(&test, &lost);
            let inner = inner.iter().sum::<Q>() / integer(inner.len());
            let allowed = 4.0 * (n + 2) as f64 * condition(n, m) * U * (n as f64).sqrt();
            assert!(inner.abs() <= exact(allowed), "{n} to {m}, {k}: {:e}", inner.to_f64());
        }
    }
}

#[test]
fn reduction_of_nets() {
    let mut hunter = Hunter::new(29);
    let low: Vec<f64> = (0..24).map(|_| hunter.unit()).collect();
    for axis in 0..3 {
        let degrees = [1, 2, 3];
        let mut higher = degrees;
        higher[axis] += 4;
        let mut high = vec![0.0; count(&higher)];
        casteljau_bernstein::elevate_along(&low, degrees, axis, higher[axis], &mut high).unwrap();
        let (mut back, mut work) = (vec![0.0; 24], vec![0.0; higher[axis] + 1]);
        let deviation = reduce_along(&high, higher, axis, degrees[axis], &mut back, &mut work).unwrap();
        assert!(deviation < 1e-14);
        for (a, b) in back.iter().zip(&low) {
            assert!((a - b).abs() < 1e-13);
        }
    }
    // The same degree again is the same net.
    let (mut back, mut work) = (vec![0.0; 24], vec![0.0; 3]);
    assert_eq!(reduce_along(&low, [1, 2, 3], 1, 2, &mut back, &mut work), Ok(0.0));
    assert_eq!(back, low);
    assert!(reduce(&[1.0, 2.0], &mut [], &mut [0.0; 2]).is_err());
    assert!(reduce(&[1.0, 2.0], &mut [0.0], &mut [0.0; 3]).is_err());
    let mut work = vec![0.0; MAX_DEGREE + 1];
    let high: Vec<f64> = (0..=MAX_DEGREE).map(|i| (i as f64).sin()).collect();
    assert!(reduce(&high, &mut [0.0; 3], &mut work).unwrap().is_finite());
    assert!(binomial(2 * MAX_DEGREE, MAX_DEGREE - 2).is_finite());
}
