//! Batches over boxes, tetrahedra and wedges against exact arithmetic and single evaluation, and their poles.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use num_traits::One;

use casteljau_bernstein::glam::{DVec3, DVec4, Vec4Swizzles};
use casteljau_bernstein::{
    BatchPoint, BernsteinError, BoxBatch, BoxNet, TetrahedronBatch, TetrahedronNet, WedgeBatch, WedgeNet,
    last_barycentric, simplex_count,
};
use support::U;
use support::exact::{
    Hunter, Q, absolute_basis, absolutes, along, assert_within, exact, exacts, factor, integer, rounds,
    tensor_sum,
};
use support::simplices;
use support::simplices::{differentiated, floor};

#[derive(Debug, Clone, Copy, PartialEq)]
enum Solid {
    Box([usize; 3]),
    Tetrahedron(usize),
    /// Of the triangle and of the height.
    Wedge([usize; 2]),
}

use Solid::{Box, Tetrahedron, Wedge};

impl Solid {
    /// The number of control points.
    fn count(self) -> usize {
        match self {
            Box([l, m, n]) => (l + 1) * (m + 1) * (n + 1),
            Tetrahedron(n) => simplex_count::<4>(n),
            Wedge([n, o]) => simplex_count::<3>(n) * (o + 1),
        }
    }

    fn degree(self) -> usize {
        match self {
            Box(degrees) => degrees.iter().sum(),
            Tetrahedron(n) => n,
            Wedge([n, o]) => n + o,
        }
    }

    /// The solid that a derivative is of, if it does not vanish.
    fn lowered(self, axis: Option<usize>) -> Option<Self> {
        let Some(axis) = axis else { return Some(self) };
        Some(match self {
            Box(mut degrees) => {
                degrees[axis] = degrees[axis].checked_sub(1)?;
                Box(degrees)
            }
            Tetrahedron(n) => Tetrahedron(n.checked_sub(1)?),
            Wedge([n, o]) if axis < 2 => Wedge([n.checked_sub(1)?, o]),
            Wedge([n, o]) => Wedge([n, o.checked_sub(1)?]),
        })
    }

    fn evaluate<P: BatchPoint, const K: usize>(
        self,
        net: &[P],
        at: &[DVec3],
        out: [&mut [P]; K],
    ) -> Result<(), BernsteinError> {
        match self {
            Box(degrees) => BoxBatch::new(net, degrees)?.evaluate(at, out),
            Tetrahedron(n) => TetrahedronBatch::new(net, n)?.evaluate(at, out),
            Wedge(degrees) => WedgeBatch::new(net, degrees)?.evaluate(at, out),
        }
    }

    fn evaluate_rational<const K: usize>(
        self,
        net: &[DVec4],
        at: &[DVec3],
        out: [&mut [DVec3]; K],
    ) -> Result<(), BernsteinError> {
        match self {
            Box(degrees) => BoxBatch::new(net, degrees)?.evaluate_rational(at, out),
            Tetrahedron(n) => TetrahedronBatch::new(net, n)?.evaluate_rational(at, out),
            Wedge(degrees) => WedgeBatch::new(net, degrees)?.evaluate_rational(at, out),
        }
    }

    fn jets<P: BatchPoint>(self, net: &[P], at: &[DVec3]) -> Vec<[P; 4]> {
        let mut out = [(); 4].map(|()| vec![P::NAN; at.len()]);
        self.evaluate(net, at, out.each_mut().map(|out| &mut out[..])).unwrap();
        (0..at.len()).map(|i| out.each_ref().map(|out| out[i])).collect()
    }

    fn single(self, net: &[f64], [u, v, w]: [f64; 3]) -> [f64; 4] {
        let mut jet = [0.0; 4];
        match self {
            Box(degrees) => BoxNet::new(net, degrees).unwrap().partials(u, v, w, &mut jet),
            Tetrahedron(n) => {
                let lambda = [u, v, w, last_barycentric(&[u, v, w])];
                TetrahedronNet::new(net, n).unwrap().partials(lambda, &mut jet);
            }
            Wedge(degrees) => {
                let lambda = [u, v, last_barycentric(&[u, v])];
                WedgeNet::new(net, degrees).unwrap().partials(lambda, w, &mut jet);
            }
        }
        jet
    }

    /// The net of a derivative, and that of its scale if `sign` is 1 and the points are absolute; −1 else.
    fn differentiated(self, points: &[Q], axis: Option<usize>, sign: i64) -> Vec<Q> {
        let Some(axis) = axis else { return points.to_vec() };
        let sign_of = Q::from_integer(sign.into());
        let difference = |line: &[Q]| -> Vec<Q> {
            let degree = integer(line.len() - 1);
            line.windows(2).map(|pair| (&pair[1] + &pair[0] * &sign_of) * &degree).collect()
        };
        let mut orders = [0; 3];
        orders[axis] = 1;
        match self {
            Box(degrees) => along(points, &degrees, axis, difference),
            Tetrahedron(n) => differentiated(points, n, 4, &orders, sign),
            Wedge([_, o]) if axis == 2 => points.chunks(o + 1).flat_map(difference).collect(),
            Wedge([n, o]) => {
                let layer = |k: usize| {
                    let points: Vec<Q> = points.iter().skip(k).step_by(o + 1).cloned().collect();
                    differentiated(&points, n, 3, &orders[..2], sign)
                };
                let layers: Vec<Vec<Q>> = (0..=o).map(layer).collect();
                (0..layers[0].len())
                    .flat_map(|place| layers.iter().map(move |layer| layer[place].clone()))
                    .collect()
            }
        }
    }

    /// The factors of the basis at a place, and what of them the rounding errors act on: below u the last barycentric
    /// coordinate is not better known.
    fn basis(self, at: DVec3) -> [Vec<Vec<Q>>; 2] {
        let at = at.to_array().map(exact);
        let barycentric = |free: &[Q]| {
            let last = Q::one() - free.iter().sum::<Q>();
            let size: Q = free.iter().map(Q::abs).sum();
            let least = exact((free.len() + 1) as f64 * U) * (Q::one() + size);
            let (mut lambda, mut sizes) = (free.to_vec(), absolutes(free));
            sizes.push(last.abs().max(least));
            lambda.push(last);
            [lambda, sizes]
        };
        let interval = |n: usize, t: &Q| [support::exact::basis(n, t), absolute_basis(n, t)];
        match self {
            Box(degrees) => {
                let all = [0, 1, 2].map(|axis| interval(degrees[axis], &at[axis]));
                [0, 1].map(|which| all.iter().map(|of| of[which].clone()).collect())
            }
            Tetrahedron(n) => barycentric(&at).map(|lambda| vec![simplices::basis(n, &lambda)]),
            Wedge([n, o]) => {
                let [values, sizes] = barycentric(&at[..2]).map(|lambda| simplices::basis(n, &lambda));
                let [in_w, of_w] = interval(o, &at[2]);
                [vec![values, in_w], vec![sizes, of_w]]
            }
        }
    }
}

const AXES: [Option<usize>; 4] = [None, Some(0), Some(1), Some(2)];

fn check_exactly(solid: Solid, net: &[f64], at: &[DVec3]) {
    let q = exacts(net);
    let floor = floor(&q) * integer((solid.degree() + 1).pow(2));
    for (jet, &at) in solid.jets(net, at).into_iter().zip(at) {
        for (axis, got) in AXES.into_iter().zip(jet) {
            let what = format!("{solid:?} with {axis:?} at {at:?}");
            let Some(lower) = solid.lowered(axis) else {
                assert_eq!(got, 0.0, "{what}");
                continue;
            };
            let [values, sizes] = lower.basis(at);
            let truth = tensor_sum(&solid.differentiated(&q, axis, -1), &values);
            let scale = tensor_sum(&solid.differentiated(&absolutes(&q), axis, 1), &sizes) + &floor;
            let order = usize::from(axis.is_some());
            assert_within(got, &truth, &scale, factor(solid.degree(), order), &what);
        }
    }
}

/// Parameters: all three anywhere, or inside, on and near the faces of the simplices.
fn parameters(hunter: &mut Hunter, count: usize) -> Vec<DVec3> {
    let mut any = |_| match hunter.below(3) {
        0 => {
            let [a, b, c, _] = hunter.barycentric::<4>();
            DVec3::new(a, b, c)
        }
        _ => DVec3::new(hunter.parameter(), hunter.parameter(), hunter.parameter()),
    };
    (0..count).map(&mut any).collect()
}

/// Mostly small, the special ones among them, and now and then of all degrees that have registers and more.
fn solid(hunter: &mut Hunter, kind: usize, case: usize) -> Solid {
    match (kind, case % 100) {
        (0, 0) => Box([3, 3, 3]),
        (0, 1) => Box([1, 20, 2]),
        (0, 2) => Box([30 + hunter.below(3), 1, 29 + hunter.below(3)]),
        (0, _) => Box([hunter.below(4), hunter.below(4), hunter.below(4)]),
        (1, 0) => Tetrahedron(4),
        (1, 1) if case < 300 => Tetrahedron(11 + hunter.below(2)),
        (1, _) => Tetrahedron(hunter.below(6)),
        (_, 1) if case < 300 => Wedge([10, 8]),
        (_, 2) => Wedge([1, 57 + hunter.below(6)]),
        _ => Wedge([hunter.below(5), hunter.below(5)]),
    }
}

fn against_exact_arithmetic(kind: usize) {
    let mut hunter = Hunter::new(41 + kind as u64);
    for case in 0..rounds(1200) {
        let solid = solid(&mut hunter, kind, case);
        let net = hunter.numbers(solid.count());
        let count = 1 + hunter.below(2);
        let at = parameters(&mut hunter, count);
        check_exactly(solid, &net, &at);
    }
}

#[test]
fn boxes_against_exact_arithmetic() {
    against_exact_arithmetic(0);
}

#[test]
fn tetrahedra_against_exact_arithmetic() {
    against_exact_arithmetic(1);
}

#[test]
fn wedges_against_exact_arithmetic() {
    against_exact_arithmetic(2);
}

/// Kernels, and degrees beyond them that go one by one.
#[test]
fn single_evaluation_agrees() {
    let mut hunter = Hunter::new(44);
    for case in 0..rounds(1000) {
        let solid = match case % 3 {
            0 => Box([hunter.degree_of(4, 25, 20), hunter.degree_of(4, 25, 20), hunter.degree_of(4, 25, 20)]),
            1 => Tetrahedron(hunter.degree_of(9, 61, 50)),
            _ => Wedge([hunter.degree_of(9, 30, 50), hunter.degree_of(9, 40, 50)]),
        };
        let net: Vec<f64> = (0..solid.count()).map(|_| hunter.unit() + 1.0).collect();
        let [a, b, c, _] = hunter.barycentric::<4>().map(|x| x.clamp(0.0, 1.0));
        let shrink = 1.0 / (a + b + c).max(1.0);
        let at = DVec3::new(a, b, c) * shrink;
        let (batch, single) = (solid.jets(&net, &[at])[0], solid.single(&net, at.to_array()));
        for k in 0..4 {
            // Of positive numbers up to 2 and, for derivatives, their differences times the degree; both have an error. The
            // coordinates add up to 1 within a few u.
            let scale = if k == 0 { 2.0 } else { 4.0 * solid.degree() as f64 } * (1.0 + 1e-9);
            let allowed = 2.0 * factor(solid.degree(), k.min(1)) as f64 * U * scale;
            assert!(
                (batch[k] - single[k]).abs() <= allowed,
                "{solid:?} kind {k} at {at:?}: {} {}",
                batch[k],
                single[k]
            );
        }
    }
}

#[test]
fn vertices_are_met_to_the_bit() {
    for solid in [
        Box([0; 3]),
        Box([3; 3]),
        Box([2, 4, 5]),
        Box([9; 3]),
        Tetrahedron(4),
        Tetrahedron(20),
        Wedge([3, 2]),
    ] {
        let net: Vec<f64> = (0..solid.count()).map(|i| (1.7 * i as f64).sin() + 2.0).collect();
        let corners: Vec<DVec3> = (0..8)
            .map(|bits| DVec3::new(f64::from(bits >> 2), f64::from(bits >> 1 & 1), f64::from(bits & 1)))
            .collect();
        let (first, last) = (net[0], net[net.len() - 1]);
        let found: Vec<f64> = solid.jets(&net, &corners).iter().map(|jet| jet[0]).collect();
        match solid {
            Box(_) => assert_eq!([found[0], found[7]], [first, last], "{solid:?}"),
            Tetrahedron(_) => assert_eq!([found[4], found[0]], [first, last], "{solid:?}"),
            Wedge(_) => assert_eq!([found[4], found[1]], [first, last], "{solid:?}"),
        }
    }
}

#[test]
fn rational_solids_are_quotients() {
    let mut hunter = Hunter::new(45);
    for case in 0..rounds(1200) {
        let solid = solid(&mut hunter, case % 3, 3 + case % 90);
        let solid = if case % 40 == 1 { Tetrahedron(4) } else { solid };
        let mut number = || 2.0 * hunter.unit() - 1.0;
        let net: Vec<DVec4> = (0..solid.count())
            .map(|_| DVec4::new(number(), number(), number(), 0.5 + number().abs()))
            .collect();
        let at: Vec<DVec3> =
            (0..9).map(|_| DVec3::new(number().abs(), number().abs(), number().abs()) / 3.0).collect();
        let homogeneous = solid.jets(&net, &at);
        let mut points = [(); 4].map(|()| vec![DVec3::NAN; at.len()]);
        solid.evaluate_rational(&net, &at, points.each_mut().map(|out| &mut out[..])).unwrap();
        let mut values = vec![DVec3::NAN; at.len()];
        solid.evaluate_rational(&net, &at, [&mut values]).unwrap();
        assert_eq!(values, points[0]);
        for (place, h) in homogeneous.into_iter().enumerate() {
            let s = points.each_ref().map(|out| out[place]);
            for k in 0..4 {
                let product = if k == 0 { s[0] * h[0].w } else { s[0] * h[k].w + s[k] * h[0].w };
                // Numbers up to 1.5 and their differences, in numerator and denominator, and four operations after them.
                let degree = solid.degree() as f64;
                let scale = if k == 0 { 1.5 } else { 3.0 * degree + s[k].abs().max_element() }
                    * (1.0 + s[0].abs().max_element());
                let allowed = (2 * factor(solid.degree(), k.min(1)) + 8) as f64 * U * scale * 2.0;
                let off = (product - h[k].xyz()).abs().max_element();
                assert!(off <= allowed, "{solid:?}, kind {k}: {off:e}, allowed {allowed:e}");
            }
        }
    }
}

#[test]
fn poles_are_errors_with_their_first_place_and_never_not_a_number() {
    // The weight is the first parameter less the second; in the last coordinate there are places inside and on a face.
    let point = |i: usize, w: f64| DVec4::new(i as f64, 1.0, 2.0, w);
    let net =
        |weights: &[f64]| -> Vec<DVec4> { weights.iter().enumerate().map(|(i, &w)| point(i, w)).collect() };
    let solids = [
        (Tetrahedron(1), net(&[1.0, -1.0, 0.0, 0.0])),
        (Wedge([1, 1]), net(&[1.0, 1.0, -1.0, -1.0, 0.0, 0.0])),
        (Box([1, 1, 1]), net(&[0.0, 0.0, -1.0, -1.0, 1.0, 1.0, 0.0, 0.0])),
    ];
    for (solid, net) in solids {
        let at = [
            [0.5, 0.25, 0.125],
            [0.25, 0.25, 0.5],
            [0.5, 0.125, 1.0],
            [0.375, 0.375, 0.25],
            [0.5, 0.5, 1.0],
            [0.5, 0.5, 0.0],
        ];
        let at = at.map(DVec3::from_array);
        let mut out = [(); 4].map(|()| vec![DVec3::NAN; at.len()]);
        let answer = solid.evaluate_rational(&net, &at, out.each_mut().map(|out| &mut out[..]));
        assert_eq!(answer, Err(BernsteinError::Pole { index: 1 }), "{solid:?}");
        for out in &out {
            assert_eq!([out[1], out[3], out[4], out[5]], [DVec3::ZERO; 4], "{solid:?}");
            assert!(out.iter().all(|p| p.is_finite()), "{solid:?}");
        }
        assert!(out[0][0] != DVec3::ZERO && out[0][2] != DVec3::ZERO);
        // A quotient out of range, and a parameter that is not a number.
        let far = vec![DVec4::new(1e200, 0.0, 0.0, 1e-200); net.len()];
        let mut out = [DVec3::NAN; 2];
        let answer = solid.evaluate_rational(&far, &[DVec3::ZERO; 2], [&mut out]);
        assert_eq!((answer, out), (Err(BernsteinError::Pole { index: 0 }), [DVec3::ZERO; 2]));
        let ones = vec![DVec4::ONE; net.len()];
        let answer = solid.evaluate_rational(&ones, &[DVec3::ZERO, DVec3::NAN], [&mut out]);
        assert_eq!((answer, out), (Err(BernsteinError::Pole { index: 1 }), [DVec3::ONE, DVec3::ZERO]));
    }
    // One by one.
    let solid = Wedge([1, 60]);
    let weights = [1.0, -1.0, 0.0];
    let net: Vec<DVec4> = weights.iter().flat_map(|&w| (0..61).map(move |k| point(k, w))).collect();
    let at = [DVec3::new(0.5, 0.25, 0.5), DVec3::new(0.25, 0.25, 0.5)];
    let mut out = [DVec3::NAN; 2];
    assert_eq!(solid.evaluate_rational(&net, &at, [&mut out]), Err(BernsteinError::Pole { index: 1 }));
    assert!(out[0].is_finite() && out[1] == DVec3::ZERO);
}

#[test]
#[cfg(feature = "rayon")]
fn nothing_depends_on_the_number_of_threads() {
    let net: Vec<DVec4> =
        (0..64).map(f64::from).map(|i| DVec4::new(i, i.sin(), i.cos(), 2.0 + i.sin())).collect();
    let at: Vec<DVec3> = (0..40_003)
        .map(f64::from)
        .map(|i| DVec3::new((i * 0.618).fract(), (i * 0.755).fract(), (i * 0.57).fract()) / 3.0)
        .collect();
    let run = || {
        [Box([3; 3]), Tetrahedron(4), Wedge([4, 3])].map(|solid| {
            let mut out = [(); 4].map(|()| vec![DVec3::NAN; at.len()]);
            solid
                .evaluate_rational(&net[..solid.count()], &at, out.each_mut().map(|out| &mut out[..]))
                .unwrap();
            out
        })
    };
    let with = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(run);
    assert_eq!(with(1), with(3));
}

#[test]
fn wrong_input_is_refused() {
    assert!(matches!(
        BoxBatch::new(&[0.0; 7], [1; 3]),
        Err(BernsteinError::BoxNetLength { degrees: [1, 1, 1], given: 7 })
    ));
    assert!(matches!(
        TetrahedronBatch::new(&[0.0; 5], 1),
        Err(BernsteinError::SimplexNetLength { vertices: 4, degree: 1, needed: 4, given: 5 })
    ));
    assert!(matches!(
        WedgeBatch::new(&[0.0; 5], [1, 1]),
        Err(BernsteinError::WedgeNetLength { degrees: [1, 1], needed: 6, given: 5 })
    ));
    for solid in [Box([1; 3]), Tetrahedron(1), Wedge([1, 1]), Wedge([1, 70])] {
        let net = vec![DVec4::ONE; solid.count()];
        let short = Err(BernsteinError::BufferLength { buffer: "out", needed: 4, given: 3 });
        assert_eq!(solid.evaluate(&net, &[DVec3::ZERO; 4], [&mut [DVec4::ZERO; 3]]), short);
        assert_eq!(solid.evaluate_rational(&net, &[DVec3::ZERO; 4], [&mut [DVec3::ZERO; 3]]), short);
        assert_eq!(solid.evaluate(&net, &[], [&mut []]), Ok(()));
        assert_eq!(solid.evaluate_rational(&net, &[], [&mut []]), Ok(()));
    }
    for refused in [Box([501, 0, 0]), Tetrahedron(501), Wedge([0, 501])] {
        let net = if let Tetrahedron(_) = refused { vec![0.0; 1] } else { vec![0.0; refused.count()] };
        let answer = refused.evaluate(&net, &[], [&mut []]);
        assert_eq!(answer, Err(BernsteinError::Degree { degree: 501, limit: 500 }));
    }
}
