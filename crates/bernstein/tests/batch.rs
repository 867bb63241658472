//! Batches against exact cases, exact rational arithmetic, and single evaluation.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_bernstein::glam::{DVec2, DVec3, DVec4};
use casteljau_bernstein::{
    BernsteinError, CurveBatch, GridBatch, PatchBatch, TensorNet, basis, binomial, derivatives, partial_index,
};
use proptest::collection::vec;
use proptest::prelude::*;
use serde_json::Value;
use support::exact::{Q, choose, differentiate, exact, exacts, integer, power, rounds, value as exact_value};
use support::{U, assert_accurate, cases, component, hunting, number, parameter, size};

/// `n!/(n−k)! Σᵢ |Bᵢⁿ⁻ᵏ(t)| Σⱼ C(k,j) |Pᵢ₊ⱼ|`: the sum of the absolute contributions to a derivative.
fn scale(points: &[f64], t: f64, k: usize) -> f64 {
    let Some(lower) = (points.len() - 1).checked_sub(k) else { return 0.0 };
    let mut b = vec![0.0; lower + 1];
    basis(t, &mut b);
    let spread = |i: usize| (0..=k).map(|j| binomial(k, j) * points[i + j].abs()).sum::<f64>();
    let factor: f64 = (lower + 1..points.len()).map(|m| m as f64).product();
    factor * b.iter().enumerate().map(|(i, b)| b.abs() * spread(i)).sum::<f64>()
}

fn net_scale(net: &[f64], columns: usize, [u, v]: [f64; 2], [a, b]: [usize; 2]) -> f64 {
    let rows: Vec<f64> = net.chunks(columns).map(|row| scale(row, v, b)).collect();
    scale(&rows, u, a)
}

/// The derivative of order k, exactly.
fn exact_derivative(points: &[Q], t: &Q, k: usize) -> Q {
    if k >= points.len() {
        return integer(0);
    }
    exact_value(&(0..k).fold(points.to_vec(), |q, _| differentiate(&q)), t)
}

fn exact_partial(net: &[f64], columns: usize, [u, v]: [f64; 2], [a, b]: [usize; 2]) -> f64 {
    let v = exact(v);
    let rows: Vec<Q> = net.chunks(columns).map(|row| exact_derivative(&exacts(row), &v, b)).collect();
    exact_derivative(&rows, &exact(u), a).to_f64()
}

fn curve_jets(points: &[f64], t: &[f64]) -> Vec<[f64; 3]> {
    let mut out = [(); 3].map(|()| vec![0.0; t.len()]);
    CurveBatch::new(points).unwrap().evaluate(t, out.each_mut().map(|out| &mut out[..])).unwrap();
    (0..t.len()).map(|i| out.each_ref().map(|out| out[i])).collect()
}

fn patch_jets(net: &[f64], degrees: [usize; 2], uv: &[DVec2]) -> Vec<[f64; 6]> {
    let mut out = [(); 6].map(|()| vec![0.0; uv.len()]);
    let patch = PatchBatch::new(net, degrees).unwrap();
    patch.evaluate(uv, out.each_mut().map(|out| &mut out[..])).unwrap();
    (0..uv.len()).map(|i| out.each_ref().map(|out| out[i])).collect()
}

fn grid_jets(net: &[f64], degrees: [usize; 2], u: &[f64], v: &[f64]) -> Vec<[f64; 6]> {
    let mut out = [(); 6].map(|()| vec![0.0; u.len() * v.len()]);
    let grid = GridBatch::new(degrees, u, v, 2).unwrap();
    grid.evaluate(net, out.each_mut().map(|out| &mut out[..])).unwrap();
    (0..out[0].len()).map(|i| out.each_ref().map(|out| out[i])).collect()
}

/// Orders (a, b) in the order of the buffers.
const ORDERS: [[usize; 2]; 6] = [[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2]];

#[test]
fn golden_curves() {
    for case in cases("curves.json") {
        let n = size(&case["degree"]);
        let samples = case["samples"].as_array().unwrap();
        let t: Vec<f64> = samples.iter().map(|s| number(&s["params"][0])).collect();
        for axis in 0..size(&case["dim"]) {
            let points = component(&case["control_points"], axis);
            for ((sample, jet), &t) in samples.iter().zip(curve_jets(&points, &t)).zip(&t) {
                for (k, got) in jet.into_iter().enumerate() {
                    let exact = &sample["partials"][k.to_string()][axis];
                    if !exact.is_null() {
                        let what = format!("{} order {k} at {t}", case["name"]);
                        assert_accurate(got, number(exact), n, k, scale(&points, t, k), &what);
                    }
                }
            }
        }
    }
}

#[test]
fn golden_patches() {
    for case in cases("patches.json") {
        let degrees = [size(&case["degree"][0]), size(&case["degree"][1])];
        let samples = case["samples"].as_array().unwrap();
        let at = |sample: &Value, i: usize| number(&sample["params"][i]);
        let uv: Vec<DVec2> = samples.iter().map(|s| DVec2::new(at(s, 0), at(s, 1))).collect();
        for axis in 0..size(&case["dim"]) {
            let rows = case["control_points"].as_array().unwrap();
            let net: Vec<f64> = rows.iter().flat_map(|row| component(row, axis)).collect();
            for ((sample, jet), &uv) in samples.iter().zip(patch_jets(&net, degrees, &uv)).zip(&uv) {
                let of_grid = grid_jets(&net, degrees, &[uv.x], &[uv.y]);
                for (k, [a, b]) in ORDERS.into_iter().enumerate() {
                    let exact = &sample["partials"][format!("{a},{b}")][axis];
                    if exact.is_null() {
                        continue;
                    }
                    let exact = number(exact);
                    let scale = net_scale(&net, degrees[1] + 1, uv.to_array(), [a, b]);
                    let what = format!("{} order {a},{b} at {uv}", case["name"]);
                    assert_accurate(jet[k], exact, degrees[0] + degrees[1], a + b, scale, &what);
                    assert_accurate(of_grid[0][k], exact, degrees[0] + degrees[1], a + b, scale, &what);
                }
            }
        }
    }
}

/// Homogeneous control points of a case: a flat list of nets' points.
fn homogeneous(points: &[&Value], weights: &[f64]) -> Vec<DVec4> {
    let at = |p: &Value, i: usize| p.get(i).map_or(0.0, number);
    let lift = |(p, w): (&&Value, &f64)| (DVec3::new(at(p, 0), at(p, 1), at(p, 2)) * *w).extend(*w);
    points.iter().zip(weights).map(lift).collect()
}

#[test]
fn golden_rational_curves() {
    for case in cases("rational_curves.json").iter().filter(|case| case["weights"].is_array()) {
        let (n, dim) = (size(&case["degree"]), size(&case["dim"]));
        let weights: Vec<f64> = case["weights"].as_array().unwrap().iter().map(number).collect();
        let points: Vec<&Value> = case["control_points"].as_array().unwrap().iter().collect();
        let curve = CurveBatch::new(&homogeneous(&points, &weights)).unwrap();
        let samples = case["samples"].as_array().unwrap();
        let t: Vec<f64> = samples.iter().map(|s| number(&s["params"][0])).collect();
        let mut out = [(); 3].map(|()| vec![DVec3::ZERO; t.len()]);
        curve.evaluate_rational(&t, out.each_mut().map(|out| &mut out[..])).unwrap();
        for (i, sample) in samples.iter().enumerate() {
            for (k, out) in out.iter().enumerate() {
                for axis in 0..dim {
                    let key = k.to_string();
                    let (exact, scale) = (&sample["partials"][&key][axis], &sample["scale"][&key][axis]);
                    let what = format!("{} order {k} at {}", case["name"], t[i]);
                    assert_accurate(out[i][axis], number(exact), n, k, number(scale), &what);
                }
            }
        }
    }
}

#[test]
fn golden_rational_patches() {
    for case in cases("rational_patches.json") {
        let degrees = [size(&case["degree"][0]), size(&case["degree"][1])];
        let rows = |key: &str| case[key].as_array().unwrap().clone();
        let weights: Vec<f64> =
            rows("weights").iter().flat_map(|r| r.as_array().unwrap()).map(number).collect();
        let nested = rows("control_points");
        let points: Vec<&Value> = nested.iter().flat_map(|r| r.as_array().unwrap()).collect();
        let net = homogeneous(&points, &weights);
        let patch = PatchBatch::new(&net, degrees).unwrap();
        for sample in case["samples"].as_array().unwrap() {
            let [u, v] = [0, 1].map(|i| number(&sample["params"][i]));
            let mut out = [(); 6].map(|()| [DVec3::ZERO]);
            patch.evaluate_rational(&[DVec2::new(u, v)], out.each_mut().map(|out| &mut out[..])).unwrap();
            let mut on_grid = out;
            let grid = GridBatch::new(degrees, &[u], &[v], 2).unwrap();
            grid.evaluate_rational(&net, on_grid.each_mut().map(|out| &mut out[..])).unwrap();
            for (k, [a, b]) in ORDERS.into_iter().enumerate() {
                let key = format!("{a},{b}");
                for axis in 0..3 {
                    let (exact, scale) = (&sample["partials"][&key][axis], &sample["scale"][&key][axis]);
                    let what = format!("{} order {key} at {u}, {v}", case["name"]);
                    for got in [out[k][0][axis], on_grid[k][0][axis]] {
                        let degree = degrees[0] + degrees[1];
                        assert_accurate(got, number(exact), degree, a + b, number(scale), &what);
                    }
                }
            }
        }
    }
}

#[test]
fn golden_normals() {
    for case in cases("patches.json").iter().filter(|case| case["dim"] == 3) {
        let degrees = [size(&case["degree"][0]), size(&case["degree"][1])];
        let rows = case["control_points"].as_array().unwrap();
        let axes = [0, 1, 2].map(|axis| rows.iter().flat_map(|row| component(row, axis)).collect::<Vec<_>>());
        let net: Vec<DVec3> =
            (0..axes[0].len()).map(|i| DVec3::from(axes.each_ref().map(|x| x[i]))).collect();
        for sample in case["samples"].as_array().unwrap() {
            let [u, v] = [0, 1].map(|i| number(&sample["params"][i]));
            let grid = GridBatch::new(degrees, &[u], &[v], 1).unwrap();
            let [mut point, mut normal] = [[DVec3::ZERO]; 2];
            grid.normals(&net, &mut point, &mut normal).unwrap();
            let Some(exact) = sample["normal"].as_array() else { continue };
            let exact = DVec3::new(number(&exact[0]), number(&exact[1]), number(&exact[2]));
            // The error of each derivative, over its length, over the sine of the angle between them.
            let part = |key: &str, axis: usize| number(&sample["partials"][key][axis]);
            let [du, dv] = ["1,0", "0,1"].map(|key| DVec3::new(part(key, 0), part(key, 1), part(key, 2)));
            let error = |order: [usize; 2]| {
                let of_axis = |x: &Vec<f64>| net_scale(x, degrees[1] + 1, [u, v], order).powi(2);
                let degree = (degrees[0] + degrees[1] + 4) as f64;
                4.0 * degree * U * axes.iter().map(of_axis).sum::<f64>().sqrt()
            };
            let sine = du.cross(dv).length() / (du.length() * dv.length());
            let allowed = (error([1, 0]) / du.length() + error([0, 1]) / dv.length() + 8.0 * U) / sine;
            let off = normal[0].distance(exact);
            assert!(off <= allowed, "{} at {u}, {v}: {off:e}, allowed {allowed:e}", case["name"]);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(rounds(1000) as u32))]

    #[test]
    fn curves_against_exact_arithmetic(
        p in prop_oneof![4 => vec(hunting(), 1..12), 1 => vec(hunting(), 12..=101)], t in vec(parameter(), 1..12),
    ) {
        let points = exacts(&p);
        for (jet, &t) in curve_jets(&p, &t).into_iter().zip(&t) {
            for (k, got) in jet.into_iter().enumerate() {
                let truth = exact_derivative(&points, &exact(t), k).to_f64();
                assert_accurate(got, truth, p.len() - 1, k, scale(&p, t, k), &format!("order {k} at {t:e} of {p:?}"));
            }
        }
    }

    #[test]
    fn patches_against_exact_arithmetic(
        m in 0..7usize, n in 0..7usize, p in vec(hunting(), 49), u in vec(parameter(), 1..4), v in vec(parameter(), 1..4),
    ) {
        let net = &p[..(m + 1) * (n + 1)];
        let uv: Vec<DVec2> = u.iter().flat_map(|&u| v.iter().map(move |&v| DVec2::new(u, v))).collect();
        let (scattered, on_grid) = (patch_jets(net, [m, n], &uv), grid_jets(net, [m, n], &u, &v));
        for (place, uv) in uv.iter().enumerate() {
            for (k, [a, b]) in ORDERS.into_iter().enumerate() {
                let exact = exact_partial(net, n + 1, uv.to_array(), [a, b]);
                let scale = net_scale(net, n + 1, uv.to_array(), [a, b]);
                let what = format!("order {a},{b} at {uv:?} of {m} × {n} {net:?}");
                assert_accurate(scattered[place][k], exact, m + n, a + b, scale, &what);
                assert_accurate(on_grid[place][k], exact, m + n, a + b, scale, &what);
            }
        }
    }

    #[test]
    fn batches_equal_single_evaluation(
        m in 0..21usize, n in 0..21usize, seed in any::<u64>(), u in vec(parameter(), 1..9), v in parameter(),
    ) {
        let net: Vec<f64> =
            (0..(m + 1) * (n + 1)).map(|i| ((i as f64 + 1.0) * (seed % 1000) as f64).sin()).collect();
        let uv: Vec<DVec2> = u.iter().map(|&u| DVec2::new(u, v)).collect();
        let batches = [patch_jets(&net, [m, n], &uv), grid_jets(&net, [m, n], &u, &[v])];
        for (place, uv) in uv.iter().enumerate() {
            let mut single = [0.0; 6];
            TensorNet::new(&net, [m, n]).unwrap().partials(uv.x, uv.y, &mut single);
            for [a, b] in ORDERS {
                let k = partial_index(a, b);
                let scale = net_scale(&net, n + 1, uv.to_array(), [a, b]);
                for batch in &batches {
                    // Both have an error.
                    let what = format!("order {a},{b} at {uv:?} of {m} × {n}, {seed}");
                    assert_accurate(batch[place][k], single[k], 2 * (m + n + 2 * (a + b) + 1), 0, scale, &what);
                }
            }
            let (mut jet, row) = ([0.0; 3], &net[..=n]);
            derivatives(row, uv.x, &mut jet);
            for (k, got) in curve_jets(row, &[uv.x])[0].into_iter().enumerate() {
                assert_accurate(got, jet[k], 2 * (n + 2 * k + 1), 0, scale(row, uv.x, k), &format!("curve, order {k}"));
            }
        }
    }
}

#[test]
fn ends_are_met_to_the_bit() {
    for degree in [0, 1, 4, 9, 10, 30, 100] {
        let p: Vec<DVec3> =
            (0..=degree).map(|i| DVec3::new(0.1, -3.7, 1e8) * (f64::from(i) - 2.3).sin()).collect();
        let mut out = [DVec3::ZERO; 2];
        CurveBatch::new(&p).unwrap().evaluate(&[0.0, 1.0], [&mut out]).unwrap();
        assert_eq!(out, [p[0], p[p.len() - 1]]);
    }
}

/// All weight on one control point after another, where the scale is smallest, on both sides of the parameters where
/// the method changes.
#[test]
fn large_coordinates_and_small_distances_to_the_end() {
    for degree in (1..=26).chain([60, 150, 238, 239, 300]) {
        let places: Vec<usize> =
            if degree <= 26 { (0..=degree).collect() } else { vec![0, 1, degree / 2, degree] };
        for at in places {
            let mut p = vec![0.0; degree + 1];
            p[at] = 1e150;
            let near = (1..=53).map(|e| 1.0 - 2_f64.powi(-e)).chain((1..=52).map(|e| 1.0 + 2_f64.powi(-e)));
            let t: Vec<f64> = near.chain([U, -U, 1e-20, 0.3, 0.49, 1.0 - 1e-9]).collect();
            for (jet, &t) in curve_jets(&p, &t).into_iter().zip(&t) {
                let x = exact(t);
                let term = choose(degree, at) * power(&x, at) * power(&(integer(1) - x), degree - at);
                let exact = (term * exact(1e150)).to_f64();
                // A single term is its own scale.
                assert_accurate(jet[0], exact, degree, 0, exact.abs(), &format!("{degree} {at} {t:e}"));
            }
        }
    }
}

/// Enough points for several chunks: one thread and several give the same bits.
#[test]
#[cfg(feature = "rayon")]
fn nothing_depends_on_the_number_of_threads() {
    let count = 40_003;
    let net: Vec<DVec4> =
        (0..16).map(|i| DVec4::new(f64::from(i).sin(), f64::from(i).cos(), 1.0, 2.0)).collect();
    let t: Vec<f64> = (0..count).map(|i| (f64::from(i) * 0.618).fract()).collect();
    let uv: Vec<DVec2> = t.iter().map(|&t| DVec2::new(t, (t * 17.3).fract())).collect();
    let run = || {
        let [mut a, mut b, mut c] = [(); 3].map(|()| vec![DVec3::ZERO; 40_003]);
        CurveBatch::new(&net).unwrap().evaluate_rational(&t, [&mut a, &mut b]).unwrap();
        PatchBatch::new(&net, [3, 3]).unwrap().evaluate_rational(&uv, [&mut c]).unwrap();
        let mut d = vec![DVec3::ZERO; 199 * 211];
        GridBatch::new([3, 3], &t[..199], &t[..211], 0).unwrap().evaluate_rational(&net, [&mut d]).unwrap();
        [a, b, c, d]
    };
    let with = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(run);
    assert_eq!(with(1), with(3));
}

#[test]
fn poles_are_errors_with_their_first_place_and_never_not_a_number() {
    // w = (1 − 2t)·(1 − 4t): its zeros at ¼ and ½ are exact, at weights ±1e-8 and ±1e8 alike.
    for size in [1e-8, 1.0, 1e8] {
        let weights = [1.0, -2.0, 3.0].map(|w| w * size);
        let net: Vec<DVec4> = weights.iter().map(|&w| DVec4::new(size, 2.0 * size, w, w)).collect();
        let mut t: Vec<f64> = (0..20_000).map(|i| 0.6 + f64::from(i) * 1e-5).collect();
        t[17_003] = 0.25;
        t[19_999] = 0.5;
        let mut out = [(); 3].map(|()| vec![DVec3::NAN; t.len()]);
        let curve = CurveBatch::new(&net).unwrap();
        let answer = curve.evaluate_rational(&t, out.each_mut().map(|out| &mut out[..]));
        assert_eq!(answer, Err(BernsteinError::Pole { index: 17_003 }));
        for out in &out {
            assert!(out.iter().all(|p| p.is_finite()));
            assert_eq!((out[17_003], out[19_999]), (DVec3::ZERO, DVec3::ZERO));
        }
        assert_eq!(out[0][0].z, 1.0);
        // As a patch that does not depend on v.
        let net: Vec<DVec4> = net.iter().flat_map(|&p| [p, p]).collect();
        let uv: Vec<DVec2> = t.iter().map(|&t| DVec2::new(t, 0.3)).collect();
        let mut out = vec![DVec3::NAN; t.len()];
        let answer = PatchBatch::new(&net, [2, 1]).unwrap().evaluate_rational(&uv, [&mut out]);
        assert_eq!(answer, Err(BernsteinError::Pole { index: 17_003 }));
        assert!(out.iter().all(|p| p.is_finite()));
        let mut out = [DVec3::NAN; 12];
        let grid = GridBatch::new([2, 1], &[0.0, 0.5, 0.25], &[0.0, 0.1, 0.2, 0.3], 0).unwrap();
        let answer = grid.evaluate_rational(&net, [&mut out]);
        assert_eq!(answer, Err(BernsteinError::Pole { index: 4 }));
        assert!(out.iter().all(|p| p.is_finite()));
    }
    // A quotient out of range.
    let far = [DVec4::new(1e200, 0.0, 0.0, 1e-200); 2];
    let mut out = [DVec3::NAN; 2];
    let answer = CurveBatch::new(&far).unwrap().evaluate_rational(&[0.3, 0.4], [&mut out]);
    assert_eq!((answer, out), (Err(BernsteinError::Pole { index: 0 }), [DVec3::ZERO; 2]));
}

#[test]
fn normals_of_collapsed_edges_are_zero_and_sizes_do_not_matter() {
    // The edge u = 0 is one point.
    let cone = |size: f64| -> Vec<DVec3> {
        [(0.0, 0.0), (0.0, 0.0), (1.0, 0.0), (1.0, 1.0)].map(|(x, y)| DVec3::new(x, y, x) * size).to_vec()
    };
    for size in [1e-150, 1.0, 1e150] {
        let [mut points, mut normals] = [[DVec3::NAN; 6]; 2];
        let grid = GridBatch::new([1, 1], &[0.0, 0.5, 1.0], &[0.0, 1.0], 1).unwrap();
        grid.normals(&cone(size), &mut points, &mut normals).unwrap();
        assert_eq!(normals[..2], [DVec3::ZERO; 2], "{size:e}");
        let expected = DVec3::new(-1.0, 0.0, 1.0).normalize();
        assert!(normals[2..].iter().all(|n| n.distance(expected) < 4.0 * U), "{size:e} {normals:?}");
    }
}

#[test]
fn wrong_buffers_are_refused() {
    let curve = CurveBatch::new(&[0.0, 1.0]).unwrap();
    let short = BernsteinError::BufferLength { buffer: "out", needed: 2, given: 1 };
    assert_eq!(curve.evaluate(&[0.0, 1.0], [&mut [0.0]]), Err(short));
    assert_eq!(CurveBatch::<f64>::new(&[]).err(), Some(BernsteinError::NoPoints));
    assert!(CurveBatch::new(&[0.0; 502]).is_err());
    assert!(PatchBatch::new(&[0.0; 5], [1, 1]).is_err());
    let grid = GridBatch::new([1, 1], &[0.0], &[0.0, 1.0], 0).unwrap();
    let nets = [0.0; 8];
    assert_eq!(
        grid.evaluate(&nets[..7], [&mut [0.0; 4]]),
        Err(BernsteinError::NetLength { degrees: [1, 1], given: 7 })
    );
    assert!(grid.evaluate(&nets, [&mut [0.0; 3]]).is_err());
    let [mut a, mut b, mut c] = [[0.0; 4]; 3];
    let refused = grid.evaluate(&nets, [&mut a, &mut b, &mut c]);
    assert_eq!(refused, Err(BernsteinError::Order { order: 1, limit: 0 }));
    grid.evaluate::<f64, 1>(&[], [&mut []]).unwrap();
    curve.evaluate(&[], [&mut []]).unwrap();
    GridBatch::new([1, 1], &[], &[], 2).unwrap().evaluate(&nets, [&mut []]).unwrap();
    PatchBatch::new(&[0.0; 4], [1, 1]).unwrap().evaluate(&[], [&mut []]).unwrap();
}
