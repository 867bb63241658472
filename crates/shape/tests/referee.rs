//! Shapes against exact arithmetic: value and derivatives to order 3, of rational ones by the quotient rule in
//! rational numbers, and poles where the exact denominator is small. Degrees are small, and one in a hundred goes up to 100
//! of curves, 20 of patches and 40 of triangles.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_geom::glam::{DVec3, DVec4};
use casteljau_geom::{Partials, UNIT_ROUNDOFF, multi_indices, partial_count, partial_index};
use casteljau_shape::{
    Curve, ParametricCurve, ParametricSurface, Patch, RationalCurve, RationalPatch, RationalTriangle,
    ShapeError, Triangle,
};
use num_traits::{One, Zero};
use proptest::collection::vec;
use proptest::prelude::*;
use support::exact::{Q, assert_within, choose, exact, factor, factorial, power, rounds};
use support::homogeneous_point;

const ORDER: usize = 3;

/// The k-th derivative of a Bernstein polynomial, and the sum of the absolute values of its parts:
/// `n!/(n−k)! Σⱼ (−1)ᵏ⁻ʲ C(k,j) Bᵢ₋ⱼⁿ⁻ᵏ`.
fn bernstein(n: usize, i: usize, k: usize, t: &Q) -> [Q; 2] {
    if k > n {
        return [Q::zero(), Q::zero()];
    }
    let (m, s) = (n - k, Q::one() - t);
    let factor = factorial(n) / factorial(m);
    let mut sums = [Q::zero(), Q::zero()];
    for j in (0..=k).filter(|&j| j <= i && i - j <= m) {
        let b = choose(m, i - j) * power(t, i - j) * power(&s, m + j - i) * choose(k, j) * &factor;
        sums[1] += b.abs();
        sums[0] += if (k - j).is_multiple_of(2) { b } else { -b };
    }
    sums
}

/// A derivative of a triangle's basis function, and the sum of the absolute values of its parts.
fn triangle_basis(n: usize, index: [usize; 3], orders: [usize; 2], lambda: &[Q; 3]) -> [Q; 2] {
    let total = orders[0] + orders[1];
    if total > n {
        return [Q::zero(), Q::zero()];
    }
    let mut sums = [Q::zero(), Q::zero()];
    // (∂₁ − ∂₃)ᵃ (∂₂ − ∂₃)ᵇ, multiplied out.
    for a in 0..=orders[0] {
        for b in 0..=orders[1] {
            let lowered = [a, b, total - a - b];
            if (0..3).any(|c| lowered[c] > index[c]) {
                continue;
            }
            let rest: [usize; 3] = std::array::from_fn(|c| index[c] - lowered[c]);
            let mut term = choose(orders[0], a) * choose(orders[1], b) * factorial(n);
            for c in 0..3 {
                term *= power(&lambda[c], rest[c]) / factorial(rest[c]);
            }
            sums[1] += term.abs();
            sums[0] += if (total - a - b).is_multiple_of(2) { term } else { -term };
        }
    }
    sums
}

/// Derivatives of some orders of the homogeneous coordinates, and their scales. `basis` gives those of a basis
/// function.
fn derivatives<const N: usize>(
    net: &[DVec4],
    basis: impl Fn(usize, [usize; N]) -> [Q; 2],
    orders: [usize; N],
) -> [[Q; 2]; 4] {
    let mut sums: [[Q; 2]; 4] = std::array::from_fn(|_| [Q::zero(), Q::zero()]);
    for (place, p) in net.iter().enumerate() {
        let [b, absolute] = basis(place, orders);
        for (axis, sum) in sums.iter_mut().enumerate() {
            sum[0] += exact(p[axis]) * &b;
            sum[1] += exact(p[axis]).abs() * &absolute;
        }
    }
    sums
}

/// Compares a polynomial shape's answer with the exact one.
fn judge_polynomial<const N: usize>(
    net: &[DVec4],
    degree: usize,
    basis: impl Fn(usize, [usize; N]) -> [Q; 2],
    got: &Partials<N>,
) {
    for orders in multi_indices::<N>(ORDER) {
        let sums = derivatives(net, &basis, orders);
        let factor = factor(degree, orders.iter().sum());
        for (axis, [truth, scale]) in sums.iter().enumerate().take(3) {
            let what = format!("{orders:?} of degree {degree}, axis {axis}");
            assert_within(got.get(orders).unwrap()[axis], truth, scale, factor, &what);
        }
    }
}

/// Compares a rational shape's answer with the exact one.
fn judge<const N: usize>(
    net: &[DVec4],
    degree: usize,
    basis: impl Fn(usize, [usize; N]) -> [Q; 2],
    got: Result<Partials<N>, ShapeError>,
) -> Result<(), TestCaseError> {
    let number = |q: &Q| q.to_f64();
    let homogeneous: Vec<_> =
        multi_indices::<N>(ORDER).map(|orders| derivatives(net, &basis, orders)).collect();
    let [w, w_scale] = &homogeneous[0][3];
    let bound = 4.0 * (degree + 2) as f64 * UNIT_ROUNDOFF * number(w_scale);
    let got = match got {
        Ok(got) => got,
        Err(error) => {
            prop_assert!(
                number(&w.abs()) <= 2.0 * bound,
                "{error} though w = {:e}, within {bound:e}",
                number(w)
            );
            return Ok(());
        }
    };
    prop_assert!(!w.is_zero(), "a point at a pole");
    // Far from the pole only: nearer the errors themselves change the denominator.
    if number(&w.abs()) < 1e3 * bound {
        return Ok(());
    }
    for axis in 0..3 {
        let (mut quotient, mut scale) = (vec![Q::zero(); partial_count::<N>(ORDER)], Vec::new());
        for alpha in multi_indices::<N>(ORDER) {
            let place = partial_index(alpha);
            let [mut value, absolute] = homogeneous[place][axis].clone();
            let mut parts = number(&absolute);
            for beta in multi_indices::<N>(ORDER).skip(1) {
                if (0..N).any(|i| beta[i] > alpha[i]) {
                    continue;
                }
                let rest: [usize; N] = std::array::from_fn(|i| alpha[i] - beta[i]);
                let binomial: Q = (0..N).map(|i| choose(alpha[i], beta[i])).product();
                let [weight, weight_scale] = &homogeneous[partial_index(beta)][3];
                value -= &binomial * weight * &quotient[partial_index(rest)];
                let lower: f64 = scale[partial_index(rest)];
                parts += number(&binomial) * number(weight_scale) * lower;
            }
            quotient[place] = value / w;
            let own = number(w_scale) * number(&quotient[place].abs());
            scale.push((parts + own) / number(&w.abs()));
            let order: usize = alpha.iter().sum();
            let allowed = 4.0 * (degree + 2 * order + 2) as f64 * UNIT_ROUNDOFF * scale[place];
            // Below the smallest normal number everything is absolute.
            let allowed = allowed + 1e-280 * number(w_scale).max(1.0) / number(&w.abs()).min(1.0).powi(4);
            let off = number(&(exact(got.get(alpha).unwrap()[axis]) - &quotient[place]).abs());
            prop_assert!(off <= allowed, "{alpha:?} axis {axis}: off {off:e}, allowed {allowed:e}");
        }
    }
    Ok(())
}

fn parameter() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => 0.0..=1.0,
        1 => prop_oneof![Just(0.0), Just(1.0), Just(0.5)],
        1 => (0..64i32).prop_map(|k| 1.0 - f64::from(k) * UNIT_ROUNDOFF),
        1 => (0..100i32).prop_map(|e| 2_f64.powi(-e)),
        1 => -1.0..2.0,
    ]
}

/// A degree: up to `usual`, one in a hundred up to `most`.
fn degree(usual: usize, most: usize) -> impl Strategy<Value = usize> {
    prop_oneof![99 => 0..=usual, 1 => 0..=most]
}

fn curve_net() -> impl Strategy<Value = Vec<DVec4>> {
    degree(10, 100).prop_flat_map(|n| vec(homogeneous_point(), n + 1))
}

fn patch_net() -> impl Strategy<Value = ([usize; 2], Vec<DVec4>)> {
    [degree(3, 20), degree(3, 20)]
        .prop_flat_map(|[m, n]| (Just([m, n]), vec(homogeneous_point(), (m + 1) * (n + 1))))
}

fn triangle_net() -> impl Strategy<Value = (usize, Vec<DVec4>)> {
    degree(4, 40).prop_flat_map(|n| (Just(n), vec(homogeneous_point(), (n + 1) * (n + 2) / 2)))
}

/// The points of a net as they stand, without weights.
fn polynomial(net: &[DVec4]) -> (Vec<DVec4>, Vec<DVec3>) {
    (net.iter().map(|p| p.truncate().extend(1.0)).collect(), net.iter().map(|p| p.truncate()).collect())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(rounds(2000) as u32))]

    #[test]
    fn curves(net in curve_net(), t in parameter()) {
        let n = net.len() - 1;
        let exact_t = exact(t);
        let basis = |i: usize, [k]: [usize; 1]| bernstein(n, i, k, &exact_t);
        let (lifted, points) = polynomial(&net);
        judge_polynomial(&lifted, n, basis, &Curve::new(points).unwrap().try_jet_of_order(t, ORDER).unwrap());
        prop_assume!(net.iter().any(|p| p.w != 0.0));
        let curve = RationalCurve::from_homogeneous(net.clone()).unwrap();
        judge(&net, n, basis, curve.try_jet_of_order(t, ORDER))?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(rounds(1000) as u32))]

    #[test]
    fn patches(([m, n], net) in patch_net(), u in parameter(), v in parameter()) {
        let table = |n: usize, t: f64| -> Vec<Vec<[Q; 2]>> {
            let t = exact(t);
            (0..=n).map(|i| (0..=ORDER).map(|k| bernstein(n, i, k, &t)).collect()).collect()
        };
        let (in_u, in_v) = (table(m, u), table(n, v));
        let basis = |place: usize, [a, b]: [usize; 2]| {
            let (p, q) = (&in_u[place / (n + 1)][a], &in_v[place % (n + 1)][b]);
            [&p[0] * &q[0], &p[1] * &q[1]]
        };
        let (lifted, points) = polynomial(&net);
        let patch = Patch::new([m, n], points).unwrap();
        judge_polynomial(&lifted, m + n, basis, &patch.try_jet_of_order(u, v, ORDER).unwrap());
        prop_assume!(net.iter().any(|p| p.w != 0.0));
        let patch = RationalPatch::from_homogeneous([m, n], &net[..]).unwrap();
        judge(&net, m + n, basis, patch.try_jet_of_order(u, v, ORDER))?;
    }

    #[test]
    fn triangles((n, net) in triangle_net(), u in parameter(), v in parameter()) {
        let lambda = [exact(u), exact(v), Q::one() - exact(u) - exact(v)];
        let mut indices = Vec::new();
        for i in (0..=n).rev() {
            indices.extend((0..=n - i).rev().map(|j| [i, j, n - i - j]));
        }
        let basis = |place: usize, orders: [usize; 2]| triangle_basis(n, indices[place], orders, &lambda);
        let (lifted, points) = polynomial(&net);
        let triangle = Triangle::new(n, points).unwrap();
        judge_polynomial(&lifted, n, basis, &triangle.try_jet_of_order(u, v, ORDER).unwrap());
        prop_assume!(net.iter().any(|p| p.w != 0.0));
        let triangle = RationalTriangle::from_homogeneous(n, &net[..]).unwrap();
        judge(&net, n, basis, triangle.try_jet_of_order(u, v, ORDER))?;
    }
}

/// High degrees, positive weights; the exact cases go to the design's limit.
#[test]
fn high_degrees() {
    let wave = |k: usize| {
        let x = (k as f64 * 0.7 + 0.1).sin();
        DVec4::new(x, x * x - 0.3, 1.0 + 0.1 * x, 1.0 + 0.5 * (k as f64).cos())
    };
    for n in [20, 40] {
        let net: Vec<DVec4> = (0..=n).map(wave).collect();
        let curve = RationalCurve::from_homogeneous(net.clone()).unwrap();
        for t in [0.0, 0.3, 1.0] {
            let exact_t = exact(t);
            judge::<1>(&net, n, |i, [k]| bernstein(n, i, k, &exact_t), curve.try_jet_of_order(t, ORDER))
                .unwrap();
        }
    }
}
