//! Power basis, integrals and moments, bounds, faces and orientation over simplices.
#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use casteljau_bernstein::{
    BernsteinError, SimplexNet, TETRAHEDRON_FACES, TRIANGLE_EDGES, TetrahedronNet, TriangleNet, hull_bounds,
    simplex_count, simplex_from_power, simplex_power_matrix, simplex_power_matrix_inverse,
};
use num_traits::{One, Zero};
use support::exact::{
    Hunter, Q, absolutes, assert_within, choose, dot, exact, exacts, factor, factorial, integer, rounds,
};
use support::simplices::{basis, indices, multinomial};
use support::{U, assert_accurate};

fn net<const V: usize>(points: &[f64], degree: usize) -> SimplexNet<'_, f64, V> {
    SimplexNet::new(points, degree).unwrap()
}

/// The smallest normal number as an addition to a scale.
fn tiny() -> Q {
    exact(f64::MIN_POSITIVE) / exact(U) * integer(1 << 40)
}

/// `(−1)^(k−|β|) n!/((n−k)! α!) Π C(αₐ, βₐ)` from factorials alone: B_β expanded in the free coordinates.
fn power_entry(n: usize, orders: &[usize], index: &[usize]) -> Q {
    let last = index.len() - 1;
    if (0..last).any(|a| orders[a + 1] < index[a]) {
        return Q::zero();
    }
    // n!/β! λ^β' times the terms of (1 − Σλ)^β_V.
    let rest: Vec<usize> = (0..last).map(|a| orders[a + 1] - index[a]).collect();
    let k: usize = rest.iter().sum();
    let mut terms = rest.clone();
    terms.push(index[last] - k);
    let sign = if k.is_multiple_of(2) { Q::one() } else { -Q::one() };
    assert_eq!(index.iter().sum::<usize>(), n);
    multinomial(index) * multinomial(&terms) * sign
}

/// Both conversions of a degree, exactly, by rows: what they do to unit nets.
struct Conversions {
    to: Vec<Vec<Q>>,
    from: Vec<Vec<Q>>,
}

impl Conversions {
    /// The rows at some places.
    fn new(vertices: usize, n: usize, places: &[usize]) -> Self {
        let all = indices(vertices, n);
        let to = |&i: &usize| all.iter().map(|index| power_entry(n, &all[i], index)).collect();
        let from = |&i: &usize| {
            let weight = |orders: &Vec<usize>| {
                let ways: Q = (1..vertices).map(|a| choose(all[i][a - 1], orders[a])).product();
                ways / multinomial(orders)
            };
            all.iter().map(weight).collect()
        };
        Self { to: places.iter().map(to).collect(), from: places.iter().map(from).collect() }
    }

    fn check<const V: usize>(&self, points: &[f64], n: usize, places: &[usize]) {
        let (mut c, mut p) = (vec![f64::NAN; points.len()], vec![f64::NAN; points.len()]);
        net::<V>(points, n).to_power(&mut c).unwrap();
        simplex_from_power::<_, V>(points, n, &mut p).unwrap();
        let q = exacts(points);
        for (out, rows, what) in [(&c, &self.to, "to the power basis"), (&p, &self.from, "from it")] {
            for (&place, row) in places.iter().zip(rows) {
                let scale = dot(&absolutes(row), &absolutes(&q)) + tiny();
                assert_within(out[place], &dot(row, &q), &scale, factor(n, 0), what);
            }
        }
    }

    fn check_matrices<const V: usize>(&self, n: usize) {
        let count = self.to.len();
        let (mut matrix, mut inverse) = (vec![f64::NAN; count * count], vec![f64::NAN; count * count]);
        simplex_power_matrix::<V>(n, &mut matrix).unwrap();
        simplex_power_matrix_inverse::<V>(n, &mut inverse).unwrap();
        for (entry, truth) in matrix.iter().zip(self.to.iter().flatten()) {
            // Integers, which beyond 2⁵³ are rounded as the conversion is.
            assert_within(*entry, truth, &truth.abs(), if n <= 15 { 0 } else { factor(n, 0) }, "matrix");
        }
        for (entry, truth) in inverse.iter().zip(self.from.iter().flatten()) {
            assert_within(*entry, truth, truth, factor(n, 0), "inverse matrix");
        }
    }
}

/// Degrees to 5, a thousand nets, whole and with matrices; then degrees to `most`, where a few rows are compared.
fn power<const V: usize>(seed: u64, most: usize) {
    let mut hunter = Hunter::new(seed);
    for n in 0..6 {
        let places: Vec<usize> = (0..simplex_count::<V>(n)).collect();
        let conversions = Conversions::new(V, n, &places);
        conversions.check_matrices::<V>(n);
        for _ in 0..170 {
            conversions.check::<V>(&hunter.numbers(places.len()), n, &places);
        }
    }
    for n in (6..25).step_by(3).chain([most]) {
        let count = simplex_count::<V>(n);
        let places: Vec<usize> = (0..10).map(|_| hunter.below(count)).collect();
        Conversions::new(V, n, &places).check::<V>(&hunter.numbers(count), n, &places);
    }
    let n = 30 / V;
    let places: Vec<usize> = (0..simplex_count::<V>(n)).collect();
    Conversions::new(V, n, &places).check_matrices::<V>(n);
}

#[test]
fn power_basis_both_ways() {
    power::<2>(200, 100);
    power::<3>(201, 40);
    power::<4>(202, 40);
}

fn moments<const V: usize>(seed: u64, cases: usize) {
    let mut hunter = Hunter::new(seed);
    for round in 0..rounds(cases) {
        let n = if round == 0 { 40 } else { hunter.degree_of(6, 40, if V == 4 { 200 } else { 50 }) };
        let points = hunter.numbers(simplex_count::<V>(n));
        let exponents: [usize; V] = std::array::from_fn(|_| if round == 0 { 0 } else { hunter.below(4) });
        let k: usize = exponents.iter().sum();
        // ∫ λ^γ = γ!/(|γ| + V − 1)!
        let weights: Vec<Q> = indices(V, n)
            .iter()
            .map(|index| {
                let powers: Vec<usize> = index.iter().zip(exponents).map(|(b, e)| b + e).collect();
                let product = powers.iter().fold(Q::one(), |w, &p| w * factorial(p));
                multinomial(index) * product / factorial(n + k + V - 1)
            })
            .collect();
        let q = exacts(&points);
        let scale = dot(&weights, &absolutes(&q)) + tiny();
        let got = net::<V>(&points, n).moment(exponents);
        assert_within(got, &dot(&weights, &q), &scale, 4 * k + V + 4, "moment");
        if k == 0 {
            assert_eq!(got, net::<V>(&points, n).integral());
        }
    }
}

#[test]
fn moments_are_exact_to_their_bound() {
    moments::<2>(210, 1000);
    moments::<3>(211, 1000);
    moments::<4>(212, 1000);
}

fn bounds<const V: usize>(seed: u64, cases: usize, most: usize) {
    let mut hunter = Hunter::new(seed);
    for _ in 0..rounds(cases) {
        let n = hunter.below(most + 1);
        let points: Vec<f64> = (0..simplex_count::<V>(n)).map(|_| hunter.unit() - 0.5).collect();
        let net = net::<V>(&points, n);
        let tolerance = 1e-6;
        let extremes = net.extremes(tolerance).unwrap();
        let [low, high] = hull_bounds(points.iter().copied()).unwrap();
        for [a, b] in [extremes.minimum, extremes.maximum] {
            assert!(a <= b && b - a <= tolerance, "{a} {b}");
            assert!(low - 1e-14 <= a && b <= high + 1e-14);
        }
        // No value is beyond the outer ends, and a fine grid comes close to the inner ones.
        let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
        let fine = 24;
        for index in indices(V, fine) {
            let lambda: [f64; V] = std::array::from_fn(|a| index[a] as f64 / fine as f64);
            let value = net.value(lambda);
            (least, greatest) = (least.min(value), greatest.max(value));
        }
        assert!(extremes.minimum[0] <= least + 1e-14 && greatest <= extremes.maximum[1] + 1e-14);
        // On half a mesh width a polynomial of degree n and size 1 changes by at most n²/fine² · V².
        let gap = ((n * V) as f64 / fine as f64).powi(2) + 1e-12;
        assert!(
            greatest >= extremes.maximum[0] - gap && least <= extremes.minimum[1] + gap,
            "{n} {greatest} {extremes:?}"
        );
    }
}

#[test]
fn extremes_enclose_all_values() {
    bounds::<2>(220, 1000, 8);
    bounds::<3>(221, 1000, 5);
    bounds::<4>(222, 1000, 3);
}

#[test]
fn extremes_at_known_places() {
    // 27 λ₁λ₂λ₃ has its greatest value 1 at the centre.
    let mut points = [0.0; 10];
    points[4] = 4.5;
    let extremes = TriangleNet::new(&points, 3).unwrap().extremes(1e-10).unwrap();
    assert!(
        extremes.maximum[0] <= 1.0
            && 1.0 <= extremes.maximum[1]
            && extremes.maximum[1] - extremes.maximum[0] <= 1e-10
    );
    assert!(extremes.minimum[0] <= 0.0 && 0.0 <= extremes.minimum[1]);
    // Not attainable: below rounding. Some 50 halvings of a cubic with points up to 4.5 bring 50·3·4.5u = 8e-14, and
    // the search ends where the gap is below four times that, both ends being counted.
    let [low, high] = TriangleNet::new(&points, 3).unwrap().extremes(1e-30).unwrap().maximum;
    assert!(low <= 1.0 && 1.0 <= high && high - low < 1e-12, "{low} {high}");
    let constant = [2.5; 20];
    let extremes = TetrahedronNet::new(&constant, 3).unwrap().extremes(1e-9).unwrap();
    assert_eq!((extremes.minimum, extremes.maximum), ([2.5; 2], [2.5; 2]));
    assert_eq!(TriangleNet::new(&[7.0], 0).unwrap().extremes(1e-9).unwrap().maximum, [7.0; 2]);
    for tolerance in [0.0, -1.0, f64::NAN] {
        let refused = TriangleNet::new(&points, 3).unwrap().extremes(tolerance);
        assert!(matches!(refused, Err(BernsteinError::Tolerance { .. })), "{tolerance}");
    }
    let refused = TriangleNet::new(&[0.0, f64::INFINITY, 0.0], 1).unwrap().extremes(0.1);
    assert_eq!(refused, Err(BernsteinError::Coefficient { place: 1, value: f64::INFINITY }));
}

/// The value on a face is that of the face's net to the bit, whatever the face; reorientation is a relabelling.
#[test]
fn faces_are_nets_of_their_own() {
    let mut hunter = Hunter::new(230);
    for _ in 0..rounds(1000) {
        let n = hunter.below(9);
        let points = hunter.numbers(simplex_count::<4>(n));
        let solid = TetrahedronNet::new(&points, n).unwrap();
        let (a, b) = (hunter.unit(), hunter.unit());
        for (opposite, mut vertices) in TETRAHEDRON_FACES.into_iter().enumerate() {
            // In ascending order nested multiplication is the same, operation by operation.
            vertices.sort_unstable();
            let mut face = vec![f64::NAN; simplex_count::<3>(n)];
            solid.face(vertices, &mut face).unwrap();
            let face = TriangleNet::new(&face, n).unwrap();
            let on_face = [a, b, 1.0 - a - b];
            let mut lambda = [0.0; 4];
            for (&vertex, l) in vertices.iter().zip(on_face) {
                lambda[vertex] = l;
            }
            assert_eq!(lambda[opposite], 0.0);
            assert_eq!(solid.value(lambda), face.value(on_face));
            for mut edge in TRIANGLE_EDGES {
                edge.sort_unstable();
                let mut curve = vec![f64::NAN; n + 1];
                face.face(edge, &mut curve).unwrap();
                let mut on_edge = [0.0; 3];
                (on_edge[edge[0]], on_edge[edge[1]]) = (1.0 - a, a);
                assert_eq!(face.value(on_edge), casteljau_bernstein::value(&curve, a));
            }
        }
        let order = [2, 0, 3, 1];
        let mut turned = vec![f64::NAN; points.len()];
        solid.face(order, &mut turned).unwrap();
        let turned = TetrahedronNet::new(&turned, n).unwrap();
        let lambda = hunter.barycentric::<4>();
        let largest = points.iter().fold(0.0, |m: f64, p| m.max(p.abs()));
        let size: f64 = lambda.iter().map(|l| l.abs()).sum();
        let scale = largest * size.powi(i32::try_from(n).unwrap());
        let there = order.map(|vertex| lambda[vertex]);
        assert_accurate(turned.value(there), solid.value(lambda), 2 * n + 2, 0, scale, "turned");
        for vertex in 0..4 {
            let (mut here, mut there) = ([0.0; 4], [0.0; 4]);
            (here[order[vertex]], there[vertex]) = (1.0, 1.0);
            assert_eq!(turned.value(there), solid.value(here), "vertices to the bit");
        }
    }
    let net = TriangleNet::new(&[0.0, 1.0, 2.0], 1).unwrap();
    assert_eq!(net.face([0, 0], &mut [0.0; 2]), Err(BernsteinError::Vertices { vertex: 0, vertices: 3 }));
    assert_eq!(
        net.face([0, 1], &mut [0.0; 3]),
        Err(BernsteinError::BufferLength { buffer: "out", needed: 2, given: 3 })
    );
    let refused = net.to_power(&mut [0.0; 2]);
    assert_eq!(refused, Err(BernsteinError::BufferLength { buffer: "out", needed: 3, given: 2 }));
    let refused = simplex_power_matrix::<3>(501, &mut []);
    assert_eq!(refused, Err(BernsteinError::Degree { degree: 501, limit: 500 }));
}

/// Outward faces: the normal of each, in the parameters, points away from the opposite vertex.
#[test]
fn faces_look_outward() {
    let corner = |vertex: usize| {
        let mut p = [0.0; 3];
        if vertex < 3 {
            p[vertex] = 1.0;
        }
        casteljau_bernstein::glam::DVec3::from_array(p)
    };
    for (opposite, [a, b, c]) in TETRAHEDRON_FACES.into_iter().enumerate() {
        let normal = (corner(b) - corner(a)).cross(corner(c) - corner(a));
        assert!(normal.dot(corner(opposite) - corner(a)) < 0.0, "face {opposite}");
    }
}

/// Partition of unity and affine invariance, with vectors for points.
#[test]
fn affine_invariance() {
    use casteljau_bernstein::glam::{DMat3, DVec3};
    let mut hunter = Hunter::new(240);
    for _ in 0..rounds(1000) {
        let n = hunter.below(12);
        let points: Vec<DVec3> = (0..simplex_count::<3>(n))
            .map(|_| DVec3::new(hunter.unit(), hunter.unit() * 1e3, hunter.unit() - 0.5))
            .collect();
        let map = DMat3::from_cols(
            DVec3::new(0.5, 2.0, -1.0),
            DVec3::new(-0.25, 1.0, 4.0),
            DVec3::new(8.0, 0.125, 1.0),
        );
        let shift = DVec3::new(-3.0, 1e4, 0.5);
        let mapped: Vec<DVec3> = points.iter().map(|&p| map * p + shift).collect();
        let (a, b) = (hunter.unit(), hunter.unit());
        let lambda = if a + b > 1.0 { [1.0 - a, 1.0 - b, a + b - 1.0] } else { [a, b, 1.0 - a - b] };
        let value = TriangleNet::new(&points, n).unwrap().value(lambda);
        let off =
            (TriangleNet::new(&mapped, n).unwrap().value(lambda) - (map * value + shift)).abs().max_element();
        // The map, of norm below 10⁴ on these points, is rounded on both sides, and λ by u.
        assert!(off <= (8 * (n + 2)) as f64 * U * 2e4, "{off:e}");
        let mut b = vec![0.0; points.len()];
        casteljau_bernstein::simplex_basis(n, lambda, &mut b).unwrap();
        let sum: f64 = b.iter().sum();
        assert!(
            (sum - 1.0).abs() <= (5 * n + b.len()) as f64 * U + (n + 1) as f64 * U
                && b.iter().all(|b| *b >= 0.0)
        );
        let total: Q = basis(n, &exacts(&lambda)).into_iter().sum();
        assert_within(sum, &total, &total, factor(n, 0) + b.len(), "partition of unity");
    }
}
