//! Values and derivatives on the interval against exact arithmetic.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use num_traits::Signed;

use casteljau_bernstein::{basis, de_casteljau, derivatives, value};
use support::exact::{
    Hunter, absolute_basis, absolutes, assert_within, choose, differentiate, dot, exact, exacts, factor,
    integer, scale,
};
use support::exact::{basis as exact_basis, value as exact_value};

#[test]
fn values_on_the_interval() {
    let mut hunter = Hunter::new(1);
    for _ in 0..2000 {
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
    for _ in 0..1000 {
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
