//! Solids on grids of parameters against exact arithmetic and scattered evaluation, and their poles.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_bernstein::glam::{DVec3, DVec4};
use casteljau_bernstein::{BatchPoint, BernsteinError, BoxBatch, BoxGridBatch};
use support::U;
use support::exact::{
    Hunter, absolute_basis, absolutes, along, assert_within, basis, exact, exacts, factor, integer, rounds,
    tensor_sum,
};
use support::simplices::floor;

fn count(degrees: [usize; 3]) -> usize {
    degrees.iter().map(|d| d + 1).product()
}

fn jets<P: BatchPoint>(degrees: [usize; 3], nets: &[P], [u, v, w]: [&[f64]; 3]) -> Vec<[P; 4]> {
    let grid = BoxGridBatch::new(degrees, u, v, w, 1).unwrap();
    let mut out = [(); 4].map(|()| vec![P::NAN; nets.len() / count(degrees) * grid.points_per_net()]);
    grid.evaluate(nets, out.each_mut().map(|out| &mut out[..])).unwrap();
    (0..out[0].len()).map(|i| out.each_ref().map(|out| out[i])).collect()
}

fn places([u, v, w]: [&[f64]; 3]) -> Vec<DVec3> {
    let mut all = Vec::new();
    for &u in u {
        for &v in v {
            all.extend(w.iter().map(|&w| DVec3::new(u, v, w)));
        }
    }
    all
}

fn parameters(hunter: &mut Hunter, most: usize) -> [Vec<f64>; 3] {
    [0; 3].map(|_: usize| (0..1 + hunter.below(most)).map(|_| hunter.parameter()).collect())
}

#[test]
fn against_exact_arithmetic() {
    let mut hunter = Hunter::new(51);
    for case in 0..rounds(1200) {
        let degrees = match case % 50 {
            0 => [3, 3, 3],
            1 => [2, 2, 5],
            2 => [1, 20, 0],
            3 => [0, 2, 20],
            _ => [hunter.below(4), hunter.below(4), hunter.below(5)],
        };
        let nets = hunter.numbers((1 + case % 2) * count(degrees));
        let [u, v, w] = parameters(&mut hunter, 2);
        let at = places([&u, &v, &w]);
        let found = jets(degrees, &nets, [&u, &v, &w]);
        assert_eq!(found.len(), (1 + case % 2) * at.len());
        let total: usize = degrees.iter().sum();
        for (net, found) in nets.chunks(count(degrees)).zip(found.chunks(at.len())) {
            let q = exacts(net);
            let floor = floor(&q) * integer((total + 1).pow(2));
            for (jet, at) in found.iter().zip(&at) {
                for (kind, &got) in jet.iter().enumerate() {
                    let what = format!("{degrees:?}, kind {kind} at {at}");
                    let (mut lower, mut net, mut sizes) = (degrees, q.clone(), absolutes(&q));
                    if let Some(axis) = kind.checked_sub(1) {
                        if degrees[axis] == 0 {
                            assert_eq!(got, 0.0, "{what}");
                            continue;
                        }
                        lower[axis] -= 1;
                        let degree = integer(degrees[axis]);
                        net = along(&net, &degrees, axis, |line| {
                            line.windows(2).map(|pair| (&pair[1] - &pair[0]) * &degree).collect()
                        });
                        sizes = along(&sizes, &degrees, axis, |line| {
                            line.windows(2).map(|pair| (&pair[1] + &pair[0]) * &degree).collect()
                        });
                    }
                    let t = at.to_array().map(exact);
                    let truth = tensor_sum(&net, &[0, 1, 2].map(|axis| basis(lower[axis], &t[axis])));
                    let scale =
                        tensor_sum(&sizes, &[0, 1, 2].map(|axis| absolute_basis(lower[axis], &t[axis])));
                    assert_within(got, &truth, &(scale + &floor), factor(total, kind.min(1)), &what);
                }
            }
        }
    }
}

#[test]
fn scattered_evaluation_agrees() {
    let mut hunter = Hunter::new(52);
    for _ in 0..rounds(1000) {
        let degrees = [hunter.degree_of(4, 12, 20), hunter.degree_of(4, 12, 20), hunter.degree_of(5, 30, 20)];
        let net: Vec<DVec4> = (0..count(degrees))
            .map(|_| DVec4::new(hunter.unit(), hunter.unit(), hunter.unit(), 0.5 + hunter.unit()))
            .collect();
        let [u, v, w] =
            [0; 3].map(|_: usize| (0..1 + hunter.below(3)).map(|_| hunter.unit()).collect::<Vec<_>>());
        let at = places([&u, &v, &w]);
        let of = BoxBatch::new(&net, degrees).unwrap();
        let (mut expected, mut found) =
            ([(); 4].map(|()| vec![DVec3::NAN; at.len()]), [(); 4].map(|()| vec![DVec3::NAN; at.len()]));
        of.evaluate_rational(&at, expected.each_mut().map(|out| &mut out[..])).unwrap();
        let grid = BoxGridBatch::new(degrees, &u, &v, &w, 1).unwrap();
        grid.evaluate_rational(&net, found.each_mut().map(|out| &mut out[..])).unwrap();
        let total = degrees.iter().sum::<usize>() as f64;
        for kind in 0..4 {
            for (a, b) in found[kind].iter().zip(&expected[kind]) {
                // Of numbers up to 1 over weights from ½ to 3/2: points up to 2, differences of both up to degree·1.5, and each
                // order divided by a weight once more. Numerator and denominator have an error, in both.
                let error = factor(total as usize, kind.min(1)) as f64 * U;
                let allowed = if kind == 0 {
                    2.0 * error * (2.0 + 4.0 * 1.5)
                } else {
                    2.0 * error * total * 3.0 * 2.0 * (2.0 + 4.0 * 1.5) * 2.0
                };
                let off = (*a - *b).abs().max_element();
                assert!(off <= allowed, "{degrees:?} kind {kind}: {off:e}, allowed {allowed:e}");
            }
        }
    }
}

#[test]
fn corners_are_met_to_the_bit() {
    for degrees in [[0; 3], [1, 2, 3], [3; 3], [2, 2, 5], [4, 3, 40]] {
        let net: Vec<f64> = (0..count(degrees)).map(|i| (1.7 * i as f64).sin() + 2.0).collect();
        let ends = [0.0, 1.0];
        let found = jets(degrees, &net, [&ends; 3]);
        let [l, m, n] = degrees;
        for (bits, jet) in found.iter().enumerate() {
            let [i, j, k] = [(bits >> 2) * l, (bits >> 1 & 1) * m, (bits & 1) * n];
            assert_eq!(jet[0], net[(i * (m + 1) + j) * (n + 1) + k], "{degrees:?} {bits}");
        }
    }
}

#[test]
fn poles_are_errors_with_their_first_place_and_never_not_a_number() {
    // The weight is w − ½, in the second net it is u − v.
    let net = |weight: &dyn Fn(usize, usize, usize) -> f64| -> Vec<DVec4> {
        (0..8).map(|i| DVec4::new(i as f64, 1.0, 2.0, weight(i >> 2, i >> 1 & 1, i & 1))).collect()
    };
    let mut nets = net(&|_, _, k| k as f64 - 0.5);
    nets.extend(net(&|i, j, _| i as f64 - j as f64));
    let axis: Vec<f64> = (0..=8).map(|i| f64::from(i) / 8.0).collect();
    let grid = BoxGridBatch::new([1; 3], &axis, &axis, &axis, 1).unwrap();
    let mut out = [(); 4].map(|()| vec![DVec3::NAN; 2 * 729]);
    let answer = grid.evaluate_rational(&nets, out.each_mut().map(|out| &mut out[..]));
    assert_eq!(answer, Err(BernsteinError::Pole { index: 4 }));
    for (place, at) in places([&axis; 3]).into_iter().enumerate() {
        for out in &out {
            assert!(out[place].is_finite() && out[729 + place].is_finite());
            assert!(at.z != 0.5 || out[place] == DVec3::ZERO);
            assert!(at.x != at.y || out[729 + place] == DVec3::ZERO);
        }
        assert!(at.z == 0.5 || out[0][place] != DVec3::ZERO);
        assert!(at.x == at.y || out[0][729 + place] != DVec3::ZERO);
    }
    let mut out = [DVec3::NAN; 4];
    let outside = BoxGridBatch::new([1; 3], &[0.5], &[2.5], &[0.25, 0.5, 0.75, 1.5], 0).unwrap();
    assert_eq!(outside.evaluate_rational(&nets[..8], [&mut out]), Err(BernsteinError::Pole { index: 1 }));
    assert!(out[1] == DVec3::ZERO && out[3] != DVec3::ZERO);
}

#[test]
#[cfg(feature = "rayon")]
fn nothing_depends_on_the_number_of_threads() {
    let net: Vec<DVec4> =
        (0..64).map(f64::from).map(|i| DVec4::new(i, i.sin(), i.cos(), 2.0 + i.sin())).collect();
    let axis = |count: i32| -> Vec<f64> { (0..count).map(|i| (f64::from(i) * 0.618).fract()).collect() };
    let (u, v, w) = (axis(37), axis(41), axis(43));
    let run = || {
        let mut out = [(); 4].map(|()| vec![DVec3::NAN; 37 * 41 * 43]);
        let grid = BoxGridBatch::new([3; 3], &u, &v, &w, 1).unwrap();
        grid.evaluate_rational(&net, out.each_mut().map(|out| &mut out[..])).unwrap();
        out
    };
    let with = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(run);
    assert_eq!(with(1), with(3));
}

#[test]
fn wrong_input_is_refused() {
    let two = [0.0, 1.0];
    let grid = BoxGridBatch::new([1; 3], &[0.5], &two, &two, 0).unwrap();
    let net = [0.0; 8];
    assert_eq!((grid.points_per_net(), grid.degrees()), (4, [1; 3]));
    let length = Err(BernsteinError::BoxNetLength { degrees: [1; 3], given: 7 });
    assert_eq!(grid.evaluate(&net[..7], [&mut [0.0; 4]]), length);
    let short = Err(BernsteinError::BufferLength { buffer: "out", needed: 4, given: 3 });
    assert_eq!(grid.evaluate(&net, [&mut [0.0; 3]]), short);
    let [mut a, mut b, mut c, mut d] = [[0.0; 4]; 4];
    let order = BernsteinError::Order { order: 1, limit: 0 };
    assert_eq!(grid.evaluate(&net, [&mut a, &mut b, &mut c, &mut d]), Err(order));
    let order = BernsteinError::Order { order: 2, limit: 1 };
    assert_eq!(BoxGridBatch::new([1; 3], &two, &two, &two, 2).err(), Some(order));
    let degree = BernsteinError::Degree { degree: 501, limit: 500 };
    assert_eq!(BoxGridBatch::new([1, 501, 1], &two, &two, &two, 0).err(), Some(degree));
    grid.evaluate::<f64, 1>(&[], [&mut []]).unwrap();
    for empty in [[&[][..], &two, &two], [&two, &[], &two], [&two, &two, &[]]] {
        let grid = BoxGridBatch::new([1; 3], empty[0], empty[1], empty[2], 1).unwrap();
        grid.evaluate(&net, [&mut [], &mut [], &mut [], &mut []]).unwrap();
    }
}
