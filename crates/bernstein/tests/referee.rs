//! Values and derivatives on the interval against exact arithmetic, and the exact arithmetic itself.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive};

use casteljau_bernstein::{basis, de_casteljau, derivatives, value};
use support::exact::{
    Hunter, Q, absolute_basis, absolutes, assert_within, choose, differentiate, dot, exact, exacts, factor,
    integer, rounds, scale,
};
use support::exact::{basis as exact_basis, value as exact_value};

#[test]
fn values_on_the_interval() {
    let mut hunter = Hunter::new(1);
    for _ in 0..rounds(2000) {
        let (n, t) = (hunter.degree(100), hunter.parameter());
        let points = hunter.numbers(n + 1);
        let (q, x) = (exacts(&points), exact(t));
        let (truth, scale) = (exact_value(&q, &x), scale(&q, &x));
        assert_within(value(&points, t), &truth, &scale, factor(n, 0), "value");
        let by_levels = de_casteljau(&points, t, &mut vec![0.0; n + 1]);
        assert_within(by_levels, &truth, &scale, factor(n, 0), "de Casteljau");
        let mut b = vec![0.0; n + 1];
        basis(t, &mut b);
        for (b, truth) in b.iter().zip(exact_basis(n, &x)) {
            assert_within(*b, &truth, &truth.abs(), factor(n, 0), &format!("basis of degree {n} at {t:e}"));
        }
    }
}

#[test]
fn derivatives_on_the_interval() {
    let mut hunter = Hunter::new(2);
    for _ in 0..rounds(2000) {
        let (n, t) = (hunter.degree(100), hunter.parameter());
        let points = hunter.numbers(n + 1);
        let mut jet = [0.0; 4];
        derivatives(&points, t, &mut jet);
        let (mut q, x) = (exacts(&points), exact(t));
        let absolute = absolutes(&q);
        for (k, got) in jet.into_iter().enumerate().take(n + 1) {
            let spread: Vec<_> =
                (0..=n - k).map(|i| (0..=k).map(|j| choose(k, j) * &absolute[i + j]).sum()).collect();
            let falling = (n - k + 1..=n).fold(integer(1), |f, m| f * integer(m));
            let scale = falling * dot(&absolute_basis(n - k, &x), &spread);
            assert_within(got, &exact_value(&q, &x), &scale, factor(n, k), "derivative");
            q = differentiate(&q);
        }
    }
}

/// Numbers of the referee are fractions of a library of fractions, through every operation and comparison.
#[test]
fn exact_numbers_are_fractions() {
    let mut hunter = Hunter::new(3);
    for _ in 0..rounds(1000) {
        let mut q: Vec<Q> = hunter.numbers(4).into_iter().map(exact).collect();
        let mut f: Vec<BigRational> = q.iter().map(|q| q.fraction().reduced()).collect();
        for _ in 0..8 {
            let (i, j) = (hunter.below(q.len()), hunter.below(q.len()));
            let (x, y) = (&q[i], &q[j]);
            let (a, b) = (&f[i], &f[j]);
            assert_eq!(x.cmp(y), a.cmp(b));
            assert_eq!((x == y, i64::from(x.signum())), (a == b, a.signum().to_i64().unwrap()));
            let (x, a) = match hunter.below(6) {
                0 => (x + y, a + b),
                1 => (x - y, a - b),
                2 => (x * y, a * b),
                3 if y.signum() != 0 => (x / y, a / b),
                4 => (-x, -a),
                _ => (x.abs(), a.abs()),
            };
            assert_eq!(x.fraction().reduced(), a);
            if a.to_f64().is_some_and(f64::is_finite) {
                assert_eq!(x.to_f64(), a.to_f64().unwrap());
            }
            q.push(x);
            f.push(a);
        }
    }
}
