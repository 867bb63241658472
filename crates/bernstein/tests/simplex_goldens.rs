//! Triangles and tetrahedra against exact cases.
#![allow(clippy::unwrap_used, clippy::expect_used)] // helpers of tests

mod support;

use casteljau_bernstein::{
    SimplexNet, last_barycentric, multi_indices, simplex_basis, simplex_count, simplex_index,
};
use serde_json::Value;
use support::{assert_accurate, cases, component, number, numbers, size};

/// All barycentric coordinates from all but the last.
fn barycentric<const V: usize>(free: &Value) -> [f64; V] {
    let free = numbers(free);
    std::array::from_fn(|vertex| free.get(vertex).copied().unwrap_or_else(|| last_barycentric(&free)))
}

/// The sum of the absolute contributions to a derivative: the net of absolute values, differences turned to sums.
fn scale<const V: usize>(points: &[f64], n: usize, lambda: [f64; V], orders: &[usize]) -> f64 {
    let mut net: Vec<f64> = points.iter().map(|x| x.abs()).collect();
    let mut degree = n;
    let mut factor = 1.0;
    for (axis, &order) in orders.iter().enumerate() {
        for _ in 0..order {
            let Some(lower) = degree.checked_sub(1) else { return 0.0 };
            factor *= degree as f64;
            degree = lower;
            net = multi_indices::<V>(degree)
                .map(|index| {
                    let raised = |vertex: usize| {
                        let mut index = index;
                        index[vertex] += 1;
                        net[simplex_index(index)]
                    };
                    raised(axis) + raised(V - 1)
                })
                .collect();
        }
    }
    factor * SimplexNet::<_, V>::new(&net, degree).unwrap().value(lambda.map(f64::abs))
}

fn values_and_partials<const V: usize>(file: &str) {
    for case in cases(file) {
        let n = size(&case["degree"]);
        let weights = case["weights"].as_array().map(|w| w.iter().map(number).collect::<Vec<_>>());
        for sample in case["samples"].as_array().unwrap() {
            let lambda = barycentric::<V>(&sample["lambda_first"]);
            let exact = |orders: &str, axis: usize| number(&sample["partials"][orders][axis]);
            let zero = vec!["0"; V - 1].join(",");
            for axis in 0..case["control_points"][0].as_array().unwrap().len() {
                let mut points = component(&case["control_points"], axis);
                let what = format!("{file} {} axis {axis} at {lambda:?}", case["name"]);
                if let Some(weights) = &weights {
                    // Rational: the value is the quotient of two forms, each within its own bound.
                    points.iter_mut().zip(weights).for_each(|(p, w)| *p *= w);
                    let form = |points: &[f64]| {
                        let net = SimplexNet::<_, V>::new(points, n).unwrap();
                        (net.value(lambda), scale(points, n, lambda, &[]))
                    };
                    let ((top, top_scale), (weight, weight_scale)) = (form(&points), form(weights));
                    let point = exact(&zero, axis);
                    let quotient_scale = (top_scale + weight_scale * point.abs()) / weight.abs();
                    assert_accurate(weight, number(&sample["weight"]), n, 0, weight_scale, &what);
                    // The product w·x was rounded once, the quotient once.
                    assert_accurate(top / weight, point, n + 1, 0, quotient_scale, &what);
                    continue;
                }
                let net = SimplexNet::<_, V>::new(&points, n).unwrap();
                let mut partials = vec![0.0; simplex_count::<V>(3)];
                net.partials(lambda, &mut partials);
                assert_eq!(partials[0], net.value(lambda), "{what}");
                for (key, exact) in sample["partials"].as_object().unwrap() {
                    let orders: Vec<usize> = key.split(',').map(|k| k.parse().unwrap()).collect();
                    let mut homogeneous = [0; V];
                    homogeneous[1..].copy_from_slice(&orders);
                    let place = simplex_index(homogeneous);
                    let total = orders.iter().sum();
                    let scale = scale(&points, n, lambda, &orders);
                    assert_accurate(
                        partials[place],
                        number(&exact[axis]),
                        n,
                        total,
                        scale,
                        &format!("{what} {key}"),
                    );
                }
            }
        }
    }
}

#[test]
fn triangles() {
    values_and_partials::<3>("triangles.json");
}

#[test]
fn tetrahedra() {
    values_and_partials::<4>("tetrahedra.json");
}

fn basis<const V: usize>() {
    for case in cases("simplex_basis.json").iter().filter(|case| size(&case["dim"]) + 1 == V) {
        let (n, lambda) = (size(&case["degree"]), barycentric::<V>(&case["lambda_first"]));
        let mut b = vec![0.0; simplex_count::<V>(n)];
        simplex_basis(n, lambda, &mut b).unwrap();
        let exact = numbers(&case["values"]);
        assert_eq!(exact.len(), b.len());
        for (place, (b, exact)) in b.into_iter().zip(exact).enumerate() {
            // A single product: the scale is the value itself.
            assert_accurate(
                b,
                exact,
                n,
                0,
                exact.abs(),
                &format!("place {place} of degree {n} at {lambda:?}"),
            );
        }
    }
}

#[test]
fn bases() {
    basis::<3>();
    basis::<4>();
}
