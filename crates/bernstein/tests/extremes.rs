//! Bounds, extremes and roots: certified answers against exact arithmetic.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_bernstein::{
    BernsteinError, BoxNet, Root, RootKind, TensorNet, extremes, hull_bounds, product, roots, value,
};
use support::exact::{Hunter, exact, exacts, rounds, value as exact_value};

#[test]
fn hulls() {
    assert_eq!(hull_bounds([]), None);
    assert_eq!(hull_bounds([f64::NAN, 1.0]), None);
    assert_eq!(hull_bounds([2.0]), Some([2.0, 2.0]));
}

/// Values at samples are never outside, and the nearest of them is close.
#[test]
fn extremes_on_the_interval() {
    let mut hunter = Hunter::new(41);
    for _ in 0..rounds(1000) {
        let n = hunter.degree(30);
        let points: Vec<f64> = (0..=n).map(|_| hunter.unit() * 2.0 - 1.0).collect();
        let found = extremes(&points, [n], 1e-10).unwrap();
        for [low, high] in [found.minimum, found.maximum] {
            assert!(low <= high && high - low <= 1e-10, "degree {n}: {found:?}");
        }
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for i in 0..=1000 {
            let p = value(&points, f64::from(i) / 1000.0);
            (least, most) = (least.min(p), most.max(p));
            assert!(p >= found.minimum[0] - 1e-14 && p <= found.maximum[1] + 1e-14);
        }
        // Between samples the polynomial moves by at most h²/8·|p″| ≤ 4n²·h²/8.
        let gap = 0.5 * (n * n) as f64 * 1e-6;
        assert!(least - found.minimum[1] <= gap && found.maximum[0] - most <= gap, "degree {n}");
    }
}

#[test]
fn extremes_over_square_and_cube() {
    // (u − ¼)² + (v − ½)² − 1, whose minimum is inside: exact coefficients.
    let [x, y] = [0.25_f64, 0.5].map(|c| [c * c, c * c - c, (1.0 - c) * (1.0 - c)]);
    let net: Vec<f64> = x.iter().flat_map(|a| y.iter().map(move |b| a + b - 1.0)).collect();
    let found = extremes(&net, [2, 2], 1e-12).unwrap();
    assert!(
        found.minimum[0] <= -1.0 && -1.0 <= found.minimum[1] && found.minimum[1] - found.minimum[0] <= 1e-12
    );
    assert!((found.maximum[1] - (0.5625 + 0.25 - 1.0)).abs() <= 1e-12);
    let mut hunter = Hunter::new(42);
    for _ in 0..rounds(1000) {
        let degrees = [0; 3].map(|_: usize| hunter.below(4));
        let points: Vec<f64> =
            (0..degrees.iter().map(|d| d + 1).product()).map(|_| hunter.unit() * 2.0 - 1.0).collect();
        let found = extremes(&points, degrees, 1e-6).unwrap();
        let net = BoxNet::new(&points, degrees).unwrap();
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for i in 0..9 * 9 * 9 {
            let at = [i / 81, i / 9 % 9, i % 9].map(|k| f64::from(k) / 8.0);
            let p = net.value(at[0], at[1], at[2]);
            (least, most) = (least.min(p), most.max(p));
        }
        for [low, high] in [found.minimum, found.maximum] {
            assert!(low <= high && high - low <= 1e-6, "{degrees:?}: {found:?}");
        }
        assert!(found.minimum[0] <= least + 1e-14 && found.maximum[1] >= most - 1e-14);
        assert!(least - found.minimum[1] < 0.5 && found.maximum[0] - most < 0.5);
    }
    // A tolerance that cannot be reached ends, with what can be known.
    let wave: Vec<f64> = (0..81).map(|i| f64::from(i * 37 % 11) - 5.3).collect();
    let found = extremes(&wave, [8, 8], 1e-30).unwrap();
    assert!(found.minimum[1] - found.minimum[0] < 1e-12);
    let value = TensorNet::new(&wave, [8, 8]).unwrap().value(0.5, 0.5);
    assert!(found.minimum[0] <= value && value <= found.maximum[1]);
    // A constant, and the zero net.
    assert_eq!(extremes(&[3.5; 8], [1, 1, 1], 1e-9).unwrap().maximum, [3.5, 3.5]);
    assert_eq!(extremes(&[0.0], [0], 1e-9).unwrap().minimum, [0.0, 0.0]);
    assert!(matches!(extremes(&[1.0], [0], f64::NAN), Err(BernsteinError::Tolerance { .. })));
    assert!(matches!(extremes(&[f64::NAN], [0], 1.0), Err(BernsteinError::Coefficient { place: 0, .. })));
    assert!(matches!(extremes(&[1.0], [1], 1.0), Err(BernsteinError::BufferLength { .. })));
}

/// The polynomial with these roots, exactly, if their products fit: factors t − r.
fn with_roots(list: &[f64]) -> Vec<f64> {
    list.iter().fold(vec![1.0], |p, &r| {
        let mut out = vec![0.0; p.len() + 1];
        product(&[-r, 1.0 - r], &p, &mut out).unwrap();
        out
    })
}

/// The number of sign changes of exact values along the ends of enclosures: the certificate checked.
fn check(points: &[f64], found: &[Root], tolerance: f64) {
    let q = exacts(points);
    let sign = |t: f64| exact_value(&q, &exact(t)).signum();
    for pair in found.windows(2) {
        assert!(pair[0].end <= pair[1].start, "{found:?}");
    }
    for root in found {
        assert!((0.0..=1.0).contains(&root.start) && root.start <= root.end && root.end <= 1.0);
        let change = sign(root.start) * sign(root.end);
        match root.kind {
            RootKind::Simple | RootKind::SignChange => {
                assert!(change <= 0, "{root:?} of {points:?}");
                assert!(root.end - root.start <= tolerance, "{root:?} of {points:?}");
            }
            RootKind::End(_) => assert!(sign(root.start) == 0),
            RootKind::Touch => {}
        }
    }
}

#[test]
fn simple_roots_are_found_and_enclosed() {
    let mut hunter = Hunter::new(43);
    for _ in 0..rounds(1500) {
        let n = 1 + hunter.below(8);
        // Multiples of 1/64, apart: the polynomial is exact or nearly so.
        let mut list: Vec<f64> = (0..n).map(|_| hunter.below(192) as f64 / 64.0 - 1.0).collect();
        list.sort_by(f64::total_cmp);
        list.dedup();
        let points = with_roots(&list);
        let found = roots(&points, 1e-9).unwrap();
        check(&points, &found, 1e-9);
        let inside: Vec<f64> = list.iter().copied().filter(|r| (0.0..=1.0).contains(r)).collect();
        assert_eq!(found.len(), inside.len(), "{list:?}: {found:?}");
        for (root, truth) in found.iter().zip(inside) {
            // Rounded coefficients have moved roots.
            assert!(root.start - 1e-7 <= truth && truth <= root.end + 1e-7, "{list:?}: {found:?}");
        }
    }
}

/// Random coefficients: wherever exact values change their sign there is an enclosure, and as many sign
/// changes as there are simple roots between.
#[test]
fn no_root_is_missed() {
    let mut hunter = Hunter::new(44);
    for _ in 0..rounds(1000) {
        let n = hunter.degree(40);
        let points: Vec<f64> = if hunter.below(2) == 0 {
            hunter.numbers(n + 1)
        } else {
            (0..=n).map(|_| hunter.unit() * 2.0 - 1.0).collect()
        };
        if points.iter().all(|&p| p == 0.0) {
            assert_eq!(roots(&points, 1e-10), Err(BernsteinError::ZeroPolynomial));
            continue;
        }
        let found = roots(&points, 1e-10).unwrap();
        if points.iter().all(|p| p.abs() > 1e-3) {
            check(&points, &found, 1e-10);
        }
        let samples = 60;
        let mut last: Option<(f64, f64)> = None;
        for i in 0..=samples {
            let t = i as f64 / samples as f64;
            let p = value(&points, t);
            let scale: f64 = points.iter().fold(0.0, |m, p| m.max(p.abs()));
            if p.abs() <= 1e-12 * scale {
                continue;
            }
            if let Some((s, q)) = last
                && q * p < 0.0
            {
                assert!(found.iter().any(|r| r.end >= s && r.start <= t), "{points:?} in [{s}, {t}]");
            }
            last = Some((t, p));
        }
    }
}

#[test]
fn multiple_roots_and_ends() {
    let end = |at: f64, multiplicity| Root { start: at, end: at, kind: RootKind::End(multiplicity) };
    assert_eq!(roots(&[0.0, 1.0], 1e-9).unwrap(), [end(0.0, 1)]);
    assert_eq!(roots(&[0.0, 0.0, 1.0, 0.0], 1e-9).unwrap(), [end(0.0, 2), end(1.0, 1)]);
    assert_eq!(roots(&[2.0], 1e-9).unwrap(), []);
    assert_eq!(roots(&[1.0, 0.5, 1.0], 1e-9).unwrap(), []);
    // At ½, where every halving meets it.
    let found = roots(&[-1.0, 1.0], 1e-9).unwrap();
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].kind, RootKind::Simple);
    assert!(found[0].start <= 0.5 && found[0].end >= 0.5 && found[0].end - found[0].start <= 1e-9);
    // A double root touches, a triple one changes the sign; both are blurred by rounding.
    let double = roots(&with_roots(&[0.25, 0.25]), 1e-9).unwrap();
    assert_eq!((double.len(), double[0].kind), (1, RootKind::Touch), "{double:?}");
    assert!((double[0].middle() - 0.25).abs() < 1e-7);
    let triple = roots(&with_roots(&[0.3125, 0.3125, 0.3125]), 1e-9).unwrap();
    assert_eq!((triple.len(), triple[0].kind), (1, RootKind::SignChange));
    assert!((triple[0].middle() - 0.3125).abs() < 1e-4);
    // Near zero of tiny and of huge polynomials.
    for factor in [1e-300, 1e-150, 1e150, 1e300] {
        let found = roots(&[-0.125 * factor, 0.875 * factor], 1e-12).unwrap();
        assert_eq!(found.len(), 1);
        assert!((found[0].middle() - 0.125).abs() < 1e-12, "{found:?}");
    }
    let p = [-1.0, 2.0, -1.0, 2.0, -1.0, 2.0];
    let found = roots(&p, 1e-300).unwrap();
    assert!(found.iter().all(|r| r.end - r.start < 1e-14), "{found:?}");
    assert_eq!(roots(&[], 1e-9), Err(BernsteinError::NoPoints));
}
