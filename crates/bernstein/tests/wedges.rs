//! The algebra of wedges against exact arithmetic, and against that of triangles and intervals.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_bernstein::{
    BernsteinError, TRIANGLE_QUARTERS, TensorNet, TriangleNet, WedgeNet, simplex_count, wedge_from_power,
};
use num_traits::{One, Zero};
use support::exact::{
    Hunter, Q, absolutes, assert_within, choose, dot, exact, exacts, factor, factorial, integer, power,
    powers, rounds,
};
use support::simplices::{indices, multinomial, place, wedge_value};
use support::{U, assert_accurate};

/// A random wedge of degrees up to `usual`, one in a hundred up to `most`.
fn wedge(hunter: &mut Hunter, usual: usize, most: usize) -> ([usize; 2], Vec<f64>) {
    let degrees = [0; 2].map(|_: usize| hunter.degree_of(usual, most, 100));
    (degrees, hunter.numbers(WedgeNet::<f64>::count(degrees)))
}

fn largest(points: &[f64]) -> f64 {
    points.iter().fold(0.0, |m: f64, p| m.max(p.abs()))
}

/// A point of the wedge.
fn inside(hunter: &mut Hunter) -> ([f64; 3], f64) {
    let (a, b) = (hunter.unit(), hunter.unit());
    let lambda = if a + b > 1.0 { [1.0 - a, 1.0 - b, a + b - 1.0] } else { [a, b, 1.0 - a - b] };
    (lambda, hunter.unit())
}

/// Exact value of a net at a point inside.
fn exact_value(points: &[Q], degrees: [usize; 2], (lambda, w): (&[Q], &Q)) -> Q {
    wedge_value(points, degrees, lambda, (&(Q::one() - w), w))
}

/// What was computed of the points of a net, `4(n+o+2)·u` of their scales at most, in its exact value at a point
/// inside: `truth`, off by as much of the value of the scales.
fn check_value(net: &[f64], degrees: [usize; 2], at: (&[Q], &Q), truth: &Q, scale: &Q, what: &str) {
    let off = (exact_value(&exacts(net), degrees, at) - truth).abs();
    let allowed = (scale + exact(f64::MIN_POSITIVE) / exact(U))
        * exact(U)
        * integer(factor(degrees[0] + degrees[1], 0));
    assert!(off <= allowed, "{what} of {degrees:?}: off {:e}, allowed {:e}", off.to_f64(), allowed.to_f64());
}

#[test]
fn elevation_and_reduction() {
    let mut hunter = Hunter::new(300);
    for _ in 0..rounds(1000) {
        let ([n, o], points) = wedge(&mut hunter, 5, 17);
        let net = WedgeNet::new(&points, [n, o]).unwrap();
        let to = [n + hunter.below(4), o + hunter.below(4)];
        let mut high = vec![f64::NAN; WedgeNet::<f64>::count(to)];
        net.elevate(to, &mut high).unwrap();
        let again = WedgeNet::new(&high, to).unwrap();
        let size = largest(&points);
        let (q, sizes) = (exacts(&points), absolutes(&exacts(&points)));
        for _ in 0..2 {
            let (lambda, w) = inside(&mut hunter);
            // The identity holds where λ add up to 1, exactly.
            let [a, b] = [lambda[0], lambda[1]].map(exact);
            let lambda = [a.clone(), b.clone(), Q::one() - a - b];
            let at = (&lambda[..], &exact(w));
            let [truth, scale] = [&q, &sizes].map(|points| exact_value(points, [n, o], at));
            check_value(&high, to, at, &truth, &scale, "elevated");
        }
        assert_eq!(again.value([0.0, 1.0, 0.0], 1.0), net.value([0.0, 1.0, 0.0], 1.0));
        let mut low = vec![f64::NAN; points.len()];
        let mut scratch = vec![f64::NAN; (to[1] + 7) * simplex_count::<3>(to[0]) + to[1] + 1];
        let bound = again.reduce([n, o], &mut low, &mut scratch).unwrap();
        // Conditions of elevation from 5 to 8, squared, one for each direction.
        let condition = |from: usize, to: usize| -> f64 {
            (from + 1..=to).map(|j| 1.0 / (1.0 - (from * (from + 1)) as f64 / (j * (j + 1)) as f64)).product()
        };
        let allowed = 4.0
            * (to[0] + to[1] + 2) as f64
            * U
            * condition(n, to[0])
            * condition(o, to[1])
            * size
            * (high.len() as f64).sqrt();
        for (a, b) in low.iter().zip(&points) {
            assert!((a - b).abs() <= allowed, "{n} {o} to {to:?}: {a} {b}, allowed {allowed:e}");
        }
        assert!(bound <= allowed);

        // Lower degrees than it has: the bound holds.
        let to = [hunter.below(n + 1), hunter.below(o + 1)];
        let mut low = vec![f64::NAN; WedgeNet::<f64>::count(to)];
        let bound = net.reduce(to, &mut low, &mut scratch).unwrap();
        let low = WedgeNet::new(&low, to).unwrap();
        for _ in 0..5 {
            let (lambda, w) = inside(&mut hunter);
            let off = (low.value(lambda, w) - net.value(lambda, w)).abs();
            assert!(off <= bound + 4.0 * (n + o + 2) as f64 * U * size, "{off:e} {bound:e}");
        }
    }
}

/// A case where gradients of the last rounds are rounding errors only, and a step along them must not run away.
#[test]
fn reduction_ends_where_it_is_exact() {
    let points = [
        0.999999999999997,
        1.0000000000000036,
        1.0000000000000036,
        -1.6877628551918797,
        -123427.20377646628,
        1.9811390152293344,
        -1.5128316183692667,
        -0.6809500109554838,
        -0.6809500109554838,
        -0.6809500109554838,
        -1.5912360665335652,
        -1.5912360665335652,
        1.5727034016608719,
        -1.5672351199010004,
        0.31331221079471616,
        -5.791323142155062e-5,
        -0.0,
        1.8172278732963898,
        -7.275957614183389e-12,
        0.2624685675074905,
        -511.9999999999985,
        -511.9999999999985,
        7.42964010566659e-10,
        0.0,
        -1.3057606722855581,
        1.8081282866408181,
        1.454375900092442,
        1.0159534207684868,
        -0.02597513065171997,
        -0.02597513065171997,
    ];
    let mut high = [f64::NAN; 120];
    WedgeNet::new(&points, [2, 4]).unwrap().elevate([4, 7], &mut high).unwrap();
    let (mut low, mut scratch) = ([f64::NAN; 30], [f64::NAN; 218]);
    let bound = WedgeNet::new(&high, [4, 7]).unwrap().reduce([2, 4], &mut low, &mut scratch).unwrap();
    assert!(bound < 1e-9, "{bound:e}");
    for (a, b) in low.iter().zip(points) {
        assert!((a - b).abs() < 1e-7, "{a:e} {b:e}"); // the size, 10⁵, times 30u and the conditions, below 10²
    }
}

#[test]
fn parts_are_the_whole() {
    let mut hunter = Hunter::new(310);
    for _ in 0..rounds(1000) {
        let ([n, o], points) = wedge(&mut hunter, 5, 20);
        let net = WedgeNet::new(&points, [n, o]).unwrap();
        let count = points.len();
        let (q, sizes) = (exacts(&points), absolutes(&exacts(&points)));
        let mut scratch = vec![f64::NAN; 5 * simplex_count::<3>(n)];
        let part = |part: &[f64], corners: [[f64; 3]; 3], [a, b]: [f64; 2], hunter: &mut Hunter| {
            let (lambda, w) = inside(hunter);
            let (lambda, w) = (exacts(&lambda), exact(w));
            let there: Vec<Q> = (0..3)
                .map(|c| (0..3).map(|corner| &lambda[corner] * exact(corners[corner][c])).sum())
                .collect();
            let height = exact(a) * (Q::one() - &w) + exact(b) * &w;
            let [truth, scale] = [&q, &sizes].map(|points| exact_value(points, [n, o], (&there, &height)));
            check_value(part, [n, o], (&lambda, &w), &truth, &scale, "part");
        };
        let whole = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let corners = std::array::from_fn(|_| inside(&mut hunter).0);
        let interval = [hunter.unit(), hunter.unit()];
        let mut out = vec![f64::NAN; count];
        net.restrict(corners, interval, &mut out, &mut scratch).unwrap();
        part(&out, corners, interval, &mut hunter);
        let w = hunter.unit();
        let (mut below, mut above) = (vec![f64::NAN; count], vec![f64::NAN; count]);
        net.split_height(w, &mut below, &mut above).unwrap();
        part(&below, whole, [0.0, w], &mut hunter);
        part(&above, whole, [w, 1.0], &mut hunter);
        let mut three = vec![f64::NAN; 3 * count];
        net.split_at(corners[0], &mut three).unwrap();
        for (vertex, third) in three.chunks(count).enumerate() {
            let mut replaced = whole;
            replaced[vertex] = corners[0];
            part(third, replaced, [0.0, 1.0], &mut hunter);
        }
        net.split_edge([2, 0], w, &mut below, &mut above).unwrap();
        let point = [w, 0.0, 1.0 - w];
        part(&below, [point, whole[1], whole[2]], [0.0, 1.0], &mut hunter);
        part(&above, [whole[0], whole[1], point], [0.0, 1.0], &mut hunter);
        let mut eight = vec![f64::NAN; 8 * count];
        net.split_uniform(&mut eight, &mut scratch).unwrap();
        for (number, eighth) in eight.chunks(count).enumerate() {
            let half = if number < 4 { [0.0, 0.5] } else { [0.5, 1.0] };
            part(eighth, TRIANGLE_QUARTERS[number % 4], half, &mut hunter);
        }
    }
}

#[test]
fn products_and_sums() {
    let mut hunter = Hunter::new(320);
    for _ in 0..rounds(1000) {
        let ([n, o], p) = wedge(&mut hunter, 3, 10);
        let ([m, l], f) = wedge(&mut hunter, 2, 4);
        let (first, second) = (WedgeNet::new(&p, [n, o]).unwrap(), WedgeNet::new(&f, [m, l]).unwrap());
        let mut out = vec![f64::NAN; WedgeNet::<f64>::count([n + m, o + l])];
        first.product(&second, &mut out).unwrap();
        let (of_p, of_f, in_f) = (exacts(&p), exacts(&f), indices(3, m));
        for (at, index) in indices(3, n + m).iter().enumerate() {
            for k in 0..=o + l {
                let (mut truth, mut scale) = (Q::zero(), Q::zero());
                for (other, theirs) in in_f.iter().enumerate() {
                    let own: Option<Vec<usize>> =
                        index.iter().zip(theirs).map(|(g, b)| g.checked_sub(*b)).collect();
                    let Some(own) = own else { continue };
                    let ways: Q = index.iter().zip(&own).map(|(&g, &b)| choose(g, b)).product();
                    for i in k.saturating_sub(l)..=o.min(k) {
                        let weight = &ways * choose(o, i) * choose(l, k - i);
                        let term = &of_p[place(&own) * (o + 1) + i] * &of_f[other * (l + 1) + k - i] * weight;
                        scale += term.abs();
                        truth += term;
                    }
                }
                let whole = choose(o + l, k) * choose(n + m, n);
                let scale = scale / &whole + exact(f64::MIN_POSITIVE) / exact(U);
                let got = out[at * (o + l + 1) + k];
                assert_within(got, &(truth / whole), &scale, factor(n + m + o + l, 0), "product");
            }
        }
        let degrees = [n.max(m), o.max(l)];
        let mut sum = vec![f64::NAN; WedgeNet::<f64>::count(degrees)];
        let mut work = sum.clone();
        first.sum(&second, &mut sum, &mut work).unwrap();
        let (lambda, w) = ([hunter.unit() / 2.0, hunter.unit() / 2.0].map(exact), exact(hunter.unit()));
        let lambda = [lambda[0].clone(), lambda[1].clone(), Q::one() - &lambda[0] - &lambda[1]];
        let both =
            |p: &[Q], f: &[Q]| exact_value(p, [n, o], (&lambda, &w)) + exact_value(f, [m, l], (&lambda, &w));
        let (truth, scale) = (both(&of_p, &of_f), both(&absolutes(&of_p), &absolutes(&of_f)));
        check_value(&sum, degrees, (&lambda, &w), &truth, &scale, "sum");
    }
    // With no height it is the product over the triangle; with a constant triangle that on the interval.
    let (p, f) = ([1.0, 2.0, -3.0], [0.5, -1.0, 4.0]);
    let (mut a, mut b) = ([0.0; 6], [0.0; 6]);
    WedgeNet::new(&p, [1, 0]).unwrap().product(&WedgeNet::new(&f, [1, 0]).unwrap(), &mut a).unwrap();
    TriangleNet::new(&p, 1).unwrap().product(&TriangleNet::new(&f, 1).unwrap(), &mut b).unwrap();
    assert_eq!(a, b);
}

#[test]
fn power_basis_and_moments() {
    let mut hunter = Hunter::new(330);
    for _ in 0..rounds(1000) {
        let ([n, o], points) = wedge(&mut hunter, 4, 20);
        let net = WedgeNet::new(&points, [n, o]).unwrap();
        let (q, sizes) = (exacts(&points), absolutes(&exacts(&points)));
        let mut scratch = vec![f64::NAN; 2 * simplex_count::<3>(n)];
        let (mut c, mut p) = (vec![f64::NAN; points.len()], vec![f64::NAN; points.len()]);
        net.to_power(&mut c, &mut scratch).unwrap();
        wedge_from_power(&points, [n, o], &mut p, &mut scratch).unwrap();
        let (x, y, w) = (exact(hunter.unit() / 2.0), exact(hunter.unit() / 2.0), exact(hunter.unit()));
        let lambda = [x.clone(), y.clone(), Q::one() - &x - &y];
        let monomials = |c: &[Q]| -> Q {
            let row = |row: &[Q]| dot(row, &powers(&w, o));
            let rows = indices(3, n).into_iter().zip(c.chunks(o + 1));
            rows.map(|(index, c)| power(&x, index[1]) * power(&y, index[2]) * row(c)).sum()
        };
        // With every part of the differences taken absolutely: 1 − x becomes 1 + x.
        let outward = [x.clone(), y.clone(), Q::one() + &x + &y];
        let truth = exact_value(&q, [n, o], (&lambda, &w));
        let scale = wedge_value(&sizes, [n, o], &outward, (&(Q::one() + &w), &w));
        let off = (monomials(&exacts(&c)) - truth).abs();
        let tiny = exact(f64::MIN_POSITIVE) / exact(U) * integer(c.len());
        let allowed = (scale + tiny) * exact(U) * integer(factor(n + o, 0));
        assert!(off <= allowed, "to the power basis: off {:e}, allowed {:e}", off.to_f64(), allowed.to_f64());
        let (truth, scale) = (monomials(&q), monomials(&sizes));
        check_value(&p, [n, o], (&lambda, &w), &truth, &scale, "from the power basis");

        let exponents = [hunter.below(3), hunter.below(3), hunter.below(3)];
        let d = hunter.below(3);
        let k = exponents.iter().sum::<usize>();
        let weights: Vec<Q> = indices(3, n)
            .iter()
            .flat_map(|index| {
                let powers = index.iter().zip(exponents).map(|(b, e)| factorial(b + e));
                let in_triangle = multinomial(index) * powers.product::<Q>() / factorial(n + k + 2);
                (0..=o).map(move |l| {
                    &in_triangle * choose(o, l) * factorial(l + d) * factorial(o - l) / factorial(o + d + 1)
                })
            })
            .collect();
        let scale = dot(&weights, &sizes) + exact(f64::MIN_POSITIVE) / exact(U);
        assert_within(net.moment(exponents, d), &dot(&weights, &q), &scale, 4 * (k + d) + 8, "moment");
        assert_eq!(net.integral(), net.moment([0; 3], 0));
    }
}

#[test]
fn faces_and_orientation() {
    let mut hunter = Hunter::new(340);
    for _ in 0..rounds(1000) {
        let ([n, o], points) = wedge(&mut hunter, 6, 20);
        let net = WedgeNet::new(&points, [n, o]).unwrap();
        let (lambda, w) = inside(&mut hunter);
        let mut triangle = vec![f64::NAN; simplex_count::<3>(n)];
        for (top, height) in [(false, 0.0), (true, 1.0)] {
            net.triangle_face(top, &mut triangle).unwrap();
            assert_eq!(TriangleNet::new(&triangle, n).unwrap().value(lambda), net.value(lambda, height));
        }
        let mut quad = vec![f64::NAN; (n + 1) * (o + 1)];
        let size = largest(&points);
        for [a, b] in [[0, 1], [1, 2], [2, 0]] {
            net.quad_face([a, b], &mut quad).unwrap();
            let mut on_edge = [0.0; 3];
            (on_edge[a], on_edge[b]) = (1.0 - w, w);
            let got = TensorNet::new(&quad, [n, o]).unwrap().value(w, 0.375);
            assert_accurate(got, net.value(on_edge, 0.375), 2 * (n + o + 1), 0, size, "quad");
        }
        let mut turned = vec![f64::NAN; points.len()];
        net.reoriented([2, 0, 1], true, &mut turned).unwrap();
        let got = WedgeNet::new(&turned, [n, o]).unwrap().value([lambda[2], lambda[0], lambda[1]], 1.0 - w);
        // 1 − w is rounded: |∂p/∂w| ≤ 2o·size.
        assert_accurate(got, net.value(lambda, w), 3 * (n + o + 1), 0, size, "turned");
    }
}

#[test]
fn bounds() {
    let mut hunter = Hunter::new(350);
    for _ in 0..rounds(1000) {
        let degrees = [hunter.below(4), hunter.below(4)];
        let points: Vec<f64> = (0..WedgeNet::<f64>::count(degrees)).map(|_| hunter.unit() - 0.5).collect();
        let net = WedgeNet::new(&points, degrees).unwrap();
        let extremes = net.extremes(1e-5).unwrap();
        for [a, b] in [extremes.minimum, extremes.maximum] {
            assert!(a <= b && b - a <= 1e-5);
        }
        let mut found = [f64::INFINITY, f64::NEG_INFINITY];
        for index in indices(3, 12) {
            for k in 0..=12 {
                let value = net.value([0, 1, 2].map(|a| index[a] as f64 / 12.0), f64::from(k) / 12.0);
                found = [found[0].min(value), found[1].max(value)];
            }
        }
        let rounding = 8.0 * U * (degrees[0] + degrees[1] + 2) as f64;
        assert!(
            extremes.minimum[0] <= found[0] + rounding && found[1] <= extremes.maximum[1] + rounding,
            "{found:?} {extremes:?}"
        );
        // From an extreme to the grid it is half a mesh width: the polynomial, of size ½ and degree n in each
        // direction, moves by at most n² times its square.
        let degree = (degrees[0] + degrees[1]) as f64;
        let gap = (degree / 12.0).powi(2) + 1e-5;
        assert!(
            found[1] >= extremes.maximum[0] - gap && found[0] <= extremes.minimum[1] + gap,
            "{found:?} {extremes:?}"
        );
    }
    // 4 λ₁·w(1−w) ≤ 1 at the vertex of the triangle, halfway up.
    let net = WedgeNet::new(&[0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], [1, 2]).unwrap();
    let extremes = net.extremes(1e-10).unwrap();
    assert!(
        extremes.maximum[0] <= 1.0
            && 1.0 <= extremes.maximum[1]
            && extremes.maximum[1] - extremes.maximum[0] <= 1e-10
    );
}

#[test]
fn wrong_lengths_are_refused() {
    let points = [0.0; 12];
    let net = WedgeNet::new(&points, [2, 1]).unwrap();
    let length = |buffer, needed, given| Err(BernsteinError::BufferLength { buffer, needed, given });
    assert_eq!(net.elevate([2, 2], &mut [0.0; 17]), length("out", 18, 17));
    assert_eq!(net.elevate([1, 2], &mut []), Err(BernsteinError::ElevatedDegree { from: 2, to: 1 }));
    let refused = net.reduce([3, 1], &mut [], &mut []);
    assert_eq!(refused, Err(BernsteinError::ReducedDegree { from: 2, to: 3 }));
    assert_eq!(net.reduce([1, 1], &mut [0.0; 6], &mut [0.0; 49]).err(), length("scratch", 50, 49).err());
    assert_eq!(
        net.restrict([[0.0; 3]; 3], [0.0, 1.0], &mut [0.0; 12], &mut [0.0; 29]),
        length("scratch", 30, 29)
    );
    assert_eq!(net.split_height(0.5, &mut [0.0; 12], &mut []), length("above", 12, 0));
    assert_eq!(net.split_at([0.0; 3], &mut [0.0; 12]), length("out", 36, 12));
    assert_eq!(net.product(&net, &mut [0.0; 3]), length("out", 45, 3));
    assert_eq!(net.quad_face([0, 1], &mut [0.0; 5]), length("out", 6, 5));
    assert_eq!(
        net.quad_face([0, 3], &mut [0.0; 6]),
        Err(BernsteinError::Vertices { vertex: 3, vertices: 3 })
    );
    assert_eq!(
        net.reoriented([0, 1, 1], true, &mut [0.0; 12]),
        Err(BernsteinError::Vertices { vertex: 1, vertices: 3 })
    );
    assert_eq!(net.scheme([0.0; 3], 0.5, &mut []), length("out", 21, 0));
    assert_eq!(net.blossom(&[[0.0; 3]; 2], &[], &mut []).err(), length("in_height", 1, 0).err());
    let broken = WedgeNet::validated(&points[..5], [usize::MAX, usize::MAX]);
    assert!(broken.value([0.2, 0.3, 0.5], 0.5).is_nan());
    assert!(broken.elevate([usize::MAX, usize::MAX], &mut []).is_err());
    assert!(broken.scheme([0.2, 0.3, 0.5], 0.5, &mut [0.0; 4]).is_err());
    let broken = WedgeNet::validated(&points[..5], [3, 2]);
    assert!(broken.split_height(0.5, &mut [0.0; 5], &mut [0.0; 5]).is_err());
    broken.partials([0.2, 0.3, 0.5], 0.5, &mut [0.0; 10]);
    assert!(broken.extremes(1e-3).is_err());
}
