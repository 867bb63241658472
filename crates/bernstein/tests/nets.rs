//! Tensor kernels, values, derivatives, blossoms and schemes, against exact cases and exact arithmetic.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_bernstein::{
    BernsteinError, BoxNet, TensorNet, blossom, blossom_tensor, box_partial_count, box_partial_index,
    de_casteljau_scheme, partial_count, partial_index, scheme_count, tensor_scheme_count,
};
use support::exact::{
    Hunter, Q, absolute_basis, absolute_pair, absolutes, along, assert_within, basis, blossom_of, choose,
    differentiate, exact, exacts, factor, integer, pair, rounds, tensor_sum,
};
use support::simplices::{basis as simplex_basis, indices};
use support::{U, assert_accurate, cases, count, flat, number, numbers, size};

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

/// A partial derivative of a tensor product; with absolute values its scale.
fn partial(points: &[Q], degrees: &[usize], at: &[f64], orders: &[usize], absolute: bool) -> Q {
    let (mut net, mut lower, mut weights) = (points.to_vec(), degrees.to_vec(), vec![]);
    for axis in 0..degrees.len() {
        net = along(&net, &lower, axis, |line| derivative_line(line, orders[axis], absolute));
        lower[axis] = degrees[axis].saturating_sub(orders[axis]);
        let t = exact(at[axis]);
        weights.push(if absolute { absolute_basis(lower[axis], &t) } else { basis(lower[axis], &t) });
    }
    tensor_sum(&net, &weights)
}

#[test]
fn box_values_and_partials() {
    let mut hunter = Hunter::new(3);
    for round in 0..rounds(1000) {
        let degrees = if round == 0 { [20, 20, 2] } else { hunter.box_degrees() };
        let at = [hunter.parameter(), hunter.parameter(), hunter.parameter()];
        let points = hunter.numbers(count(&degrees));
        let net = BoxNet::new(&points, degrees).unwrap();
        let order = hunter.below(5);
        let mut partials = vec![0.0; box_partial_count(order) + 1];
        net.partials(at[0], at[1], at[2], &mut partials);
        assert_eq!(partials[0], net.value(at[0], at[1], at[2]));
        assert_eq!(partials.last(), Some(&0.0));
        let (q, sizes) = (exacts(&points), absolutes(&exacts(&points)));
        let one = indices(4, order).swap_remove(hunter.below(box_partial_count(order)));
        for orders in [[0; 3], [one[1], one[2], one[3]]] {
            let (truth, scale) =
                (partial(&q, &degrees, &at, &orders, false), partial(&sizes, &degrees, &at, &orders, true));
            let got = partials[box_partial_index(orders[0], orders[1], orders[2])];
            let factor = factor(degrees.iter().sum(), orders.iter().sum());
            assert_within(got, &truth, &scale, factor, &format!("{degrees:?} {orders:?} at {at:?}"));
        }
    }
}

#[test]
fn quad_values_and_partials() {
    let mut hunter = Hunter::new(12);
    for round in 0..rounds(1000) {
        let degrees = if round == 0 { [20; 2] } else { [0; 2].map(|_: usize| hunter.degree_of(6, 20, 50)) };
        let at = [hunter.parameter(), hunter.parameter()];
        let points = hunter.numbers(count(&degrees));
        let order = if round == 0 { 2 } else { hunter.below(4) };
        let mut partials = vec![0.0; partial_count(order)];
        TensorNet::new(&points, degrees).unwrap().partials(at[0], at[1], &mut partials);
        let (q, sizes) = (exacts(&points), absolutes(&exacts(&points)));
        for a in 0..=order {
            for b in 0..=order - a {
                let (truth, scale) = (
                    partial(&q, &degrees, &at, &[a, b], false),
                    partial(&sizes, &degrees, &at, &[a, b], true),
                );
                let factor = factor(degrees[0] + degrees[1], a + b);
                let what = format!("{degrees:?} {a} {b} at {at:?}");
                assert_within(partials[partial_index(a, b)], &truth, &scale, factor, &what);
            }
        }
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

/// `Σ r!/(a! b! c!) dᵤᵃ dᵥᵇ d_wᶜ ∂ᵃ⁺ᵇ⁺ᶜp/∂uᵃ∂vᵇ∂wᶜ`, in as many variables as there are degrees.
#[test]
fn directional_derivatives() {
    let mut hunter = Hunter::new(4);
    for round in 0..rounds(1000) {
        let degrees = if round == 0 { [20, 3, 20] } else { hunter.box_degrees() };
        let points = hunter.numbers(count(&degrees));
        let at = [hunter.parameter(), hunter.parameter(), hunter.parameter()];
        let direction = [hunter.number(), hunter.number(), hunter.number()];
        let order = if round == 0 { 2 } else { hunter.below(5) };
        let mut work = vec![0.0; order];
        let (q, sizes) = (exacts(&points), absolutes(&exacts(&points)));
        let (d, lengths) = (exacts(&direction), absolutes(&exacts(&direction)));
        let expansion = |axes: usize, absolute: bool| -> Q {
            let (q, d) = if absolute { (&sizes, &lengths) } else { (&q, &d) };
            let terms = indices(axes, order).into_iter().zip(simplex_basis(order, &d[..axes]));
            terms.map(|(a, weight)| weight * partial(q, &degrees[..axes], &at, &a, absolute)).sum()
        };
        let total: usize = degrees.iter().sum();
        let got = BoxNet::new(&points, degrees).unwrap().directional(at, direction, &mut work);
        // Products of numbers near 10⁻³⁰⁸ may vanish.
        let scale = expansion(3, true) + exact(1e-290) / exact(U);
        assert_within(got, &expansion(3, false), &scale, factor(total, order), "box");
        if degrees[2] == 0 {
            let net = TensorNet::new(&points, [degrees[0], degrees[1]]).unwrap();
            let got = net.directional([at[0], at[1]], [direction[0], direction[1]], &mut work);
            let scale = expansion(2, true) + exact(1e-290) / exact(U);
            assert_within(got, &expansion(2, false), &scale, factor(total, order), "quad");
        }
    }
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
                    let scale = partial(&absolutes(&exacts(&points)), &degrees, &at, &o, true).to_f64();
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
    for _ in 0..rounds(1000) {
        let n = hunter.degree(100);
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
    for _ in 0..rounds(1000) {
        let degrees = hunter.box_degrees();
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
    for _ in 0..rounds(1000) {
        let [m, n] = [hunter.degree_of(4, 20, 50), hunter.degree_of(4, 20, 50)];
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

#[test]
fn wrong_sizes_are_refused() {
    let huge = [usize::MAX, 0, 1];
    assert!(matches!(
        BoxNet::new(&[0.0], huge),
        Err(BernsteinError::Degree { degree: usize::MAX, limit: 500 })
    ));
    BoxNet::validated(&[1.0], huge).partials(0.5, 0.5, 0.5, &mut [0.0; 11]);
    BoxNet::validated(&[1.0; 7], [1, 1, 1]).partials(0.5, 0.5, 0.5, &mut [0.0; 21]);
    BoxNet::<f64>::validated(&[], [0, 0, 0]).partials(0.5, 0.5, 0.5, &mut []);
}
