//! Tensor kernels (box nets, blossoms, elevation, subdivision, restriction) against exact cases and exact
//! arithmetic.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_bernstein::{
    BernsteinError, BoxNet, TensorNet, blossom, blossom_tensor, box_partial_count, box_partial_index,
    de_casteljau_scheme, elevate_along, elevate_tensor, restrict, restrict_along, restrict_tensor,
    scheme_count, subdivide_along, tensor_scheme_count, value,
};
use support::exact::{
    Hunter, Q, absolute_basis, absolute_pair, absolutes, along, assert_within, basis, blossom_of, choose,
    differentiate, exact, exacts, factor, integer, pair, power, tensor_sum,
};
use support::{assert_accurate, cases, flat, number, numbers, size};

/// Degrees of a box: small, now and then 20 along one axis.
fn box_degrees(hunter: &mut Hunter) -> [usize; 3] {
    let mut degrees = [0; 3].map(|_: usize| hunter.below(4));
    if hunter.below(40) == 0 {
        degrees[hunter.below(3)] = 20;
    }
    degrees
}

fn count(degrees: &[usize]) -> usize {
    degrees.iter().map(|d| d + 1).product()
}

/// The points whose basis sums are the derivative of order k along a line, and the scale of it.
fn derivative_line(line: &[Q], k: usize, absolute: bool) -> Vec<Q> {
    let n = line.len() - 1;
    if k > n {
        return vec![integer(0)];
    }
    if !absolute {
        return (0..k).fold(line.to_vec(), |line, _| differentiate(&line));
    }
    let falling = (n - k + 1..=n).fold(integer(1), |f, m| f * integer(m));
    let spread = |i: usize| (0..=k).map(|j| choose(k, j) * line[i + j].abs()).sum::<Q>();
    (0..=n - k).map(|i| &falling * spread(i)).collect()
}

#[test]
fn box_values_and_partials() {
    let mut hunter = Hunter::new(3);
    for round in 0..1000 {
        let degrees = if round == 0 { [8, 8, 1] } else { box_degrees(&mut hunter) };
        let at = [hunter.parameter(), hunter.parameter(), hunter.parameter()];
        let points = hunter.numbers(count(&degrees));
        let net = BoxNet::new(&points, degrees).unwrap();
        let order = hunter.below(5);
        let mut partials = vec![0.0; box_partial_count(order) + 1];
        net.partials(at[0], at[1], at[2], &mut partials);
        assert_eq!(partials[0], net.value(at[0], at[1], at[2]));
        assert_eq!(partials.last(), Some(&0.0));
        let q = exacts(&points);
        let orders = [hunter.below(order + 1), 0, 0];
        let orders = [orders[0], hunter.below(order - orders[0] + 1), 0];
        let orders = [orders[0], orders[1], hunter.below(order - orders[0] - orders[1] + 1)];
        let (mut truth, mut scale) = (q.clone(), absolutes(&q));
        let mut lower = degrees;
        let (mut weights, mut absolute) = (vec![], vec![]);
        for axis in 0..3 {
            truth = along(&truth, &lower, axis, |line| derivative_line(line, orders[axis], false));
            scale = along(&scale, &lower, axis, |line| derivative_line(line, orders[axis], true));
            lower[axis] = degrees[axis].saturating_sub(orders[axis]);
            weights.push(basis(lower[axis], &exact(at[axis])));
            absolute.push(absolute_basis(lower[axis], &exact(at[axis])));
        }
        let got = partials[box_partial_index(orders[0], orders[1], orders[2])];
        let factor = factor(degrees.iter().sum(), orders.iter().sum());
        let what = format!("{degrees:?} {orders:?} at {at:?}");
        assert_within(got, &tensor_sum(&truth, &weights), &tensor_sum(&scale, &absolute), factor, &what);
    }
}

#[test]
fn partials_come_by_order_then_descending() {
    let mut place = 0;
    for order in 0..6 {
        for a in (0..=order).rev() {
            for b in (0..=order - a).rev() {
                assert_eq!(box_partial_index(a, b, order - a - b), place);
                place += 1;
            }
        }
        assert_eq!(box_partial_count(order), place);
    }
}

/// Along a line p(u + h·d) a directional derivative is the derivative of a polynomial in h, whose points are
/// blossoms.
#[test]
fn directional_derivatives() {
    let mut hunter = Hunter::new(4);
    for _ in 0..300 {
        let degrees = [0; 3].map(|_: usize| hunter.below(4));
        let points: Vec<f64> = (0..count(&degrees)).map(|_| hunter.unit() * 2.0 - 1.0).collect();
        let [at, direction] = [0; 2].map(|_: usize| [0; 3].map(|_: usize| hunter.unit() * 2.0 - 0.5));
        let order = hunter.below(5);
        let mut work = vec![0.0; order];
        let box_net = BoxNet::new(&points, degrees).unwrap();
        let mut got = box_net.directional(at, direction, &mut work);
        let total: usize = degrees.iter().sum();
        // Exactly: r!·(coefficient of hʳ) of Σ P Π B(u + h d), by polynomials in h.
        let along_line = |axis: usize, n: usize| -> Vec<Vec<Q>> {
            let t = vec![exact(at[axis]), exact(direction[axis])];
            let s = vec![integer(1) - exact(at[axis]), -exact(direction[axis])];
            (0..=n)
                .map(|i| {
                    let mut product = vec![choose(n, i)];
                    for k in 0..n {
                        product = multiply(&product, if k < i { &t } else { &s });
                    }
                    product
                })
                .collect()
        };
        let by_axis: Vec<_> = (0..3).map(|axis| along_line(axis, degrees[axis])).collect();
        let coefficient = |absolute: bool, flat: bool| -> Q {
            let mut sum = integer(0);
            for (place, p) in points.iter().enumerate() {
                let k = place % (degrees[2] + 1);
                let j = place / (degrees[2] + 1) % (degrees[1] + 1);
                let i = place / (degrees[2] + 1) / (degrees[1] + 1);
                let mut product = multiply(&by_axis[0][i], &by_axis[1][j]);
                if !flat {
                    product = multiply(&product, &by_axis[2][k]);
                }
                let term = exact(*p) * product.get(order).cloned().unwrap_or(integer(0));
                sum += if absolute { term.abs() } else { term };
            }
            sum * support::exact::factorial(order)
        };
        // Bounded from above: |Bᵢⁿ(u)| ≤ 3ⁿ there, differences double, directions are at most 1.5.
        let scale = power(&integer(9), total) * power(&integer(3 * total.max(1)), order);
        assert_within(got, &coefficient(false, false), &scale, 4, "box");
        if degrees[2] == 0 {
            let net = TensorNet::new(&points, [degrees[0], degrees[1]]).unwrap();
            got = net.directional([at[0], at[1]], [direction[0], direction[1]], &mut work);
            assert_within(got, &coefficient(false, true), &scale, 4, "quad");
        }
    }
}

fn multiply(a: &[Q], b: &[Q]) -> Vec<Q> {
    let mut out = vec![integer(0); a.len() + b.len() - 1];
    for (i, a) in a.iter().enumerate() {
        for (j, b) in b.iter().enumerate() {
            out[i + j] += a * b;
        }
    }
    out
}

#[test]
fn golden_solids() {
    for case in cases("tensor_solids.json") {
        let degrees = [0, 1, 2].map(|i| size(&case["degree"][i]));
        let net = flat(&case["control_points"], 4);
        let weights = case["weights"].is_array().then(|| flat(&case["weights"], 3));
        for sample in case["samples"].as_array().unwrap() {
            let at = numbers(&sample["params"]);
            for axis in 0..3 {
                let mut points: Vec<f64> = net.iter().skip(axis).step_by(3).copied().collect();
                let mut weight = 1.0;
                if let Some(w) = &weights {
                    points.iter_mut().zip(w).for_each(|(p, w)| *p *= w);
                    weight = number(&sample["weight"]);
                    let got = BoxNet::new(w, degrees).unwrap().value(at[0], at[1], at[2]);
                    let scale = w.iter().map(|w| w.abs()).sum();
                    assert_accurate(got, weight, degrees.iter().sum(), 0, scale, "weight");
                }
                let mut partials = [0.0; 20];
                BoxNet::new(&points, degrees).unwrap().partials(at[0], at[1], at[2], &mut partials);
                for (orders, exact) in sample["partials"].as_object().unwrap() {
                    let o: Vec<usize> = orders.split(',').map(|o| o.parse().unwrap()).collect();
                    let order = o.iter().sum();
                    if weights.is_some() && order > 0 || exact.is_null() {
                        continue; // the quotient rule belongs to the crate geom
                    }
                    let q = absolutes(&exacts(&points));
                    let (mut scale, mut lower, mut absolute) = (q, degrees, vec![]);
                    for axis in 0..3 {
                        scale = along(&scale, &lower, axis, |line| derivative_line(line, o[axis], true));
                        lower[axis] = degrees[axis].saturating_sub(o[axis]);
                        absolute.push(absolute_basis(lower[axis], &support::exact::exact(at[axis])));
                    }
                    let scale = tensor_sum(&scale, &absolute).to_f64();
                    let got = partials[box_partial_index(o[0], o[1], o[2])];
                    let what = format!("{} {orders} at {at:?}", case["name"]);
                    let exact = number(&exact[axis]) * weight;
                    assert_accurate(got, exact, degrees.iter().sum(), order, scale, &what);
                }
            }
        }
    }
}

#[test]
fn blossoms() {
    let mut hunter = Hunter::new(5);
    for _ in 0..1000 {
        let n = hunter.degree(60);
        let (points, arguments) = (hunter.numbers(n + 1), (0..n).map(|_| hunter.parameter()));
        let arguments: Vec<f64> = arguments.collect();
        let mut work = vec![0.0; n + 1];
        let got = blossom(&points, &arguments, &mut work).unwrap();
        let q = exacts(&points);
        let pairs: Vec<_> = arguments.iter().map(|&t| pair(&exact(t))).collect();
        let absolute: Vec<_> = arguments.iter().map(|&t| absolute_pair(&exact(t))).collect();
        let scale = blossom_of(&absolutes(&q), &absolute);
        assert_within(got, &blossom_of(&q, &pairs), &scale, factor(n, 0), "blossom");
    }
    // u v w, polarised.
    let net = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    assert_eq!(blossom_tensor(&net, [1, 1, 1], [&[0.5], &[3.0], &[-1.0]], &mut [0.0; 8]), Ok(-1.5));
    let refused = blossom_tensor(&net, [1, 1, 1], [&[0.5], &[], &[-1.0]], &mut [0.0; 8]);
    assert_eq!(refused, Err(BernsteinError::BufferLength { buffer: "arguments", needed: 1, given: 0 }));
}

#[test]
fn tensor_blossoms_are_blossoms_of_blossoms() {
    let mut hunter = Hunter::new(6);
    for _ in 0..300 {
        let degrees = box_degrees(&mut hunter);
        let points = hunter.numbers(count(&degrees));
        let arguments = degrees.map(|n| (0..n).map(|_| hunter.parameter()).collect::<Vec<_>>());
        let mut work = vec![0.0; points.len()];
        let lists = [&arguments[0][..], &arguments[1], &arguments[2]];
        let got = blossom_tensor(&points, degrees, lists, &mut work).unwrap();
        let (mut truth, mut scale, mut left) = (exacts(&points), absolutes(&exacts(&points)), degrees);
        for axis in 0..3 {
            let pairs: Vec<_> = arguments[axis].iter().map(|&t| pair(&exact(t))).collect();
            let absolute: Vec<_> = arguments[axis].iter().map(|&t| absolute_pair(&exact(t))).collect();
            truth = along(&truth, &left, axis, |line| vec![blossom_of(line, &pairs)]);
            scale = along(&scale, &left, axis, |line| vec![blossom_of(line, &absolute)]);
            left[axis] = 0;
        }
        assert_within(got, &truth[0], &scale[0], factor(degrees.iter().sum(), 0), "blossom");
    }
}

#[test]
fn schemes_of_surface_points() {
    let mut hunter = Hunter::new(7);
    for _ in 0..200 {
        let [m, n] = [hunter.below(5), hunter.below(5)];
        let points = hunter.numbers((m + 1) * (n + 1));
        let (u, v) = (hunter.parameter(), hunter.parameter());
        let net = TensorNet::new(&points, [m, n]).unwrap();
        let mut out = vec![0.0; tensor_scheme_count([m, n])];
        net.scheme(u, v, &mut out).unwrap();
        let (curves, across) = out.split_at((m + 1) * scheme_count(n));
        let mut one = vec![0.0; scheme_count(n)];
        for ((row, scheme), point) in points.chunks(n + 1).zip(curves.chunks(one.len())).zip(across) {
            de_casteljau_scheme(row, v, &mut one).unwrap();
            assert_eq!(scheme, one);
            assert_eq!(one.last(), Some(point));
        }
        let mut last = vec![0.0; scheme_count(m)];
        de_casteljau_scheme(&across[..=m], u, &mut last).unwrap();
        assert_eq!(across, last);
        let weights = [absolute_basis(m, &exact(u)), absolute_basis(n, &exact(v))];
        let truth = tensor_sum(&exacts(&points), &[basis(m, &exact(u)), basis(n, &exact(v))]);
        let scale = tensor_sum(&absolutes(&exacts(&points)), &weights);
        assert_within(*out.last().unwrap(), &truth, &scale, factor(m + n, 0), "scheme");
    }
    let net = TensorNet::new(&[1.0], [0, 0]).unwrap();
    assert!(net.scheme(0.5, 0.5, &mut [0.0; 3]).is_err());
    assert!(TensorNet::validated(&[1.0], [3, 0]).scheme(0.5, 0.5, &mut [0.0; 3]).is_err());
}

/// Degree elevation written out: `Qⱼ = Σ C(n,i) C(r,j−i)/C(n+r,j) Pᵢ`.
fn elevated_line(line: &[Q], to: usize) -> Vec<Q> {
    let (n, r) = (line.len() - 1, to + 1 - line.len());
    let weight = |i: usize, j: usize| choose(n, i) * choose(r, j - i) / choose(to, j);
    (0..=to).map(|j| (0..=n.min(j)).map(|i| weight(i, j) * &line[i]).sum()).collect()
}

#[test]
fn elevation_of_nets() {
    let mut hunter = Hunter::new(8);
    for round in 0..500 {
        let (degrees, to) = if round < 2 {
            ([30 * round, 1, 0], [60, 2, 1])
        } else {
            let degrees = box_degrees(&mut hunter);
            (degrees, degrees.map(|d| d + hunter.below(3)))
        };
        let points = hunter.numbers(count(&degrees));
        let mut out = vec![0.0; count(&to)];
        elevate_tensor(&points, degrees, to, &mut out).unwrap();
        let (mut truth, mut done) = (exacts(&points), degrees);
        let mut scale = absolutes(&truth);
        for axis in 0..3 {
            truth = along(&truth, &done, axis, |line| elevated_line(line, to[axis]));
            scale = along(&scale, &done, axis, |line| elevated_line(line, to[axis]));
            done[axis] = to[axis];
        }
        for ((got, truth), scale) in out.iter().zip(&truth).zip(&scale) {
            assert_within(*got, truth, scale, factor(to.iter().sum(), 0), "elevated");
        }
    }
}

/// Restriction written out: the blossoms with n − i times a and i times b.
fn restricted_line(line: &[Q], [a, b]: [f64; 2], absolute: bool) -> Vec<Q> {
    let n = line.len() - 1;
    let [a, b] = [a, b].map(|t| if absolute { absolute_pair(&exact(t)) } else { pair(&exact(t)) });
    let arguments =
        |i: usize| (0..n).map(|k| if k < n - i { a.clone() } else { b.clone() }).collect::<Vec<_>>();
    (0..=n).map(|i| blossom_of(line, &arguments(i))).collect()
}

#[test]
fn restriction_to_intervals() {
    let mut hunter = Hunter::new(9);
    for round in 0..1000 {
        let n = if round == 0 { 30 } else { hunter.degree(10) };
        let points = hunter.numbers(n + 1);
        let interval = [hunter.parameter(), hunter.parameter()];
        let mut out = vec![0.0; n + 1];
        restrict(&points, interval, &mut out).unwrap();
        assert_eq!(
            [out[0], out[n]],
            interval.map(|t| value(&points, t)).map(|end| if n == 0 { points[0] } else { end })
        );
        let q = exacts(&points);
        let (truth, scale) =
            (restricted_line(&q, interval, false), restricted_line(&absolutes(&q), interval, true));
        for ((got, truth), scale) in out.iter().zip(&truth).zip(&scale) {
            assert_within(*got, truth, scale, factor(n, 0), &format!("degree {n} on {interval:?}"));
        }
        restrict(&points, [1.0, 0.0], &mut out).unwrap();
        out.reverse();
        assert_eq!(out, points);
    }
}

#[test]
fn restriction_of_nets() {
    let mut hunter = Hunter::new(10);
    for _ in 0..150 {
        let degrees = [0; 3].map(|_: usize| hunter.below(4));
        let points = hunter.numbers(count(&degrees));
        let intervals = [0; 3].map(|_: usize| {
            if hunter.below(3) == 0 { [0.0, 1.0] } else { [hunter.parameter(), hunter.parameter()] }
        });
        let mut out = vec![0.0; points.len()];
        restrict_tensor(&points, degrees, intervals, &mut out).unwrap();
        let mut truth = exacts(&points);
        let mut scale = absolutes(&truth);
        for (axis, &interval) in intervals.iter().enumerate() {
            truth = along(&truth, &degrees, axis, |line| restricted_line(line, interval, false));
            scale = along(&scale, &degrees, axis, |line| restricted_line(line, interval, true));
        }
        for ((got, truth), scale) in out.iter().zip(&truth).zip(&scale) {
            assert_within(*got, truth, scale, factor(degrees.iter().sum(), 0), "restricted");
        }
    }
}

#[test]
fn subdivision_of_nets_is_restriction() {
    let mut hunter = Hunter::new(11);
    for _ in 0..200 {
        let degrees = [0; 3].map(|_: usize| hunter.below(4));
        let points = hunter.numbers(count(&degrees));
        let (axis, t) = (hunter.below(3), hunter.parameter());
        let (mut left, mut right) = (vec![0.0; points.len()], vec![0.0; points.len()]);
        subdivide_along(&points, degrees, axis, t, &mut left, &mut right).unwrap();
        let q = exacts(&points);
        for (part, interval) in [(&left, [0.0, t]), (&right, [t, 1.0])] {
            let truth = along(&q, &degrees, axis, |line| restricted_line(line, interval, false));
            let scale = along(&absolutes(&q), &degrees, axis, |line| restricted_line(line, interval, true));
            for ((got, truth), scale) in part.iter().zip(&truth).zip(&scale) {
                assert_within(*got, truth, scale, factor(degrees[axis], 0), "part");
            }
        }
    }
}

#[test]
fn golden_rational_elevation() {
    for case in cases("degree_elevation.json").iter().filter(|c| c["kind"] == "rational_curve") {
        let (n, raise) = (size(&case["degree"]), size(&case["raise"]));
        let weights = numbers(&case["weights"]);
        let lift = |points: &[f64]| {
            let mut out = vec![0.0; n + raise + 1];
            elevate_along(points, [n], 0, n + raise, &mut out).unwrap();
            out
        };
        let lifted = lift(&weights);
        for (got, exact) in lifted.iter().zip(numbers(&case["expected_weights"])) {
            assert_accurate(*got, exact, n + raise, 0, exact.abs(), "weight");
        }
        for axis in 0..2 {
            let points = support::component(&case["control_points"], axis);
            let products: Vec<f64> = points.iter().zip(&weights).map(|(p, w)| p * w).collect();
            let expected = support::component(&case["expected_points"], axis);
            let scale = lift(&products.iter().map(|x| x.abs()).collect::<Vec<_>>());
            for (i, got) in lift(&products).into_iter().enumerate() {
                let what = "point of a rational curve";
                assert_accurate(got / lifted[i], expected[i], n + raise + 2, 0, scale[i] / lifted[i], what);
            }
        }
    }
}

#[test]
fn golden_nets() {
    for case in cases("degree_elevation.json").iter().filter(|c| c["kind"] == "tensor") {
        let d: Vec<usize> = case["degree"].as_array().unwrap().iter().map(size).collect();
        let (axis, raise) = (size(&case["axis"]), size(&case["raise"]));
        let points = flat(&case["coefficients"], d.len());
        let expected = flat(&case["expected"], d.len());
        let mut out = vec![0.0; expected.len()];
        match d[..] {
            [m, n] => elevate_along(&points, [m, n], axis, d[axis] + raise, &mut out).unwrap(),
            [l, m, n] => elevate_along(&points, [l, m, n], axis, d[axis] + raise, &mut out).unwrap(),
            _ => panic!("{d:?}"),
        }
        for (got, exact) in out.into_iter().zip(expected) {
            assert_accurate(got, exact, d[axis] + raise, 0, 4.0, "tensor elevation");
        }
    }
    for case in cases("subdivision.json").iter().filter(|c| c["kind"] == "tensor_split") {
        let d: Vec<usize> = case["degree"].as_array().unwrap().iter().map(size).collect();
        let (axis, t) = (size(&case["axis"]), number(&case["t"]));
        let points = flat(&case["coefficients"], d.len());
        let [mut left, mut right] = [points.clone(), points.clone()];
        match d[..] {
            [m, n] => subdivide_along(&points, [m, n], axis, t, &mut left, &mut right).unwrap(),
            [l, m, n] => subdivide_along(&points, [l, m, n], axis, t, &mut left, &mut right).unwrap(),
            _ => panic!("{d:?}"),
        }
        for (part, key) in [(left, "left"), (right, "right")] {
            for (got, exact) in part.into_iter().zip(flat(&case[key], d.len())) {
                assert_accurate(got, exact, d[axis], 0, 4.0, "tensor split");
            }
        }
    }
    for case in cases("subdivision.json").iter().filter(|c| c["kind"] == "curve_restrict") {
        let points = numbers(&case["coefficients"]);
        let interval = numbers(&case["interval"]);
        let mut out = points.clone();
        restrict(&points, [interval[0], interval[1]], &mut out).unwrap();
        for (got, exact) in out.into_iter().zip(numbers(&case["expected"])) {
            assert_accurate(got, exact, points.len() - 1, 0, 4.0, "restriction");
        }
    }
}

#[test]
fn wrong_sizes_are_refused() {
    let length = |buffer, needed, given| Err(BernsteinError::BufferLength { buffer, needed, given });
    assert_eq!(restrict::<f64>(&[], [0.0, 1.0], &mut []), Err(BernsteinError::NoPoints));
    assert_eq!(restrict(&[1.0], [0.0, 1.0], &mut []), length("out", 1, 0));
    assert_eq!(restrict_along(&[1.0; 3], [1, 1], 0, [0.0, 1.0], &mut [0.0; 4]), length("points", 4, 3));
    let axis = Err(BernsteinError::Axis { axis: 2, dimension: 2 });
    assert_eq!(subdivide_along(&[1.0; 4], [1, 1], 2, 0.5, &mut [0.0; 4], &mut [0.0; 4]), axis);
    assert_eq!(
        subdivide_along(&[1.0; 4], [1, 1], 1, 0.5, &mut [0.0; 4], &mut [0.0; 3]),
        length("right", 4, 3)
    );
    assert_eq!(elevate_along(&[1.0; 4], [1, 1], 1, 3, &mut [0.0; 7]), length("out", 8, 7));
    let huge = [usize::MAX, 0, 1];
    assert!(matches!(
        BoxNet::new(&[0.0], huge),
        Err(BernsteinError::Degree { degree: usize::MAX, limit: 500 })
    ));
    BoxNet::validated(&[1.0], huge).partials(0.5, 0.5, 0.5, &mut [0.0; 11]);
    BoxNet::validated(&[1.0; 7], [1, 1, 1]).partials(0.5, 0.5, 0.5, &mut [0.0; 21]);
    BoxNet::<f64>::validated(&[], [0, 0, 0]).partials(0.5, 0.5, 0.5, &mut []);
}
