//! Faces, sections, parts and other nets of solids: the laws, on every kind.
#![allow(clippy::unwrap_used)] // helpers of tests

#[path = "../../shape/tests/support/mod.rs"]
mod support;

use casteljau_geom::glam::{DMat3, DVec3, DVec4};
use casteljau_geom::{Interval, UNIT_ROUNDOFF, rounding_bound};
use casteljau_shape::ShapeError;
use casteljau_solid::{
    Axis, BezierHexahedron, BezierTetrahedron, BezierWedge, DomainTetrahedron, Hexahedron, HexahedronFace,
    ParametricSolid, RationalHexahedron, RationalTetrahedron, RationalWedge, SolidError, Tetrahedron, Wedge,
};
use proptest::prelude::*;
use support::weight;

const SCALES: [f64; 3] = [1.0, 1e-6, 1e6];

/// Homogeneous points, coordinates up to `scale`, weights from 1e-8 to 1e8.
fn net(count: usize) -> impl Strategy<Value = (Vec<DVec4>, f64)> {
    let point = ([-1.0..1.0_f64, -1.0..1.0, -1.0..1.0], weight());
    (prop::collection::vec(point, count), 0..3_usize).prop_map(|(points, scale)| {
        let scale = SCALES[scale];
        let net = points.into_iter().map(|(p, w)| (DVec3::from_array(p) * scale * w).extend(w)).collect();
        (net, scale)
    })
}

/// From 0 to 1 in steps of 2⁻¹⁰, so that products and sums of parameters are exact: with weights from 1e-8 to 1e8 a
/// rounded parameter is another point.
fn unit() -> impl Strategy<Value = f64> {
    prop_oneof![6 => 0..=1024_u16, 1 => Just(0), 1 => Just(1024)].prop_map(|k| f64::from(k) / 1024.0)
}

fn cube() -> impl Strategy<Value = [f64; 3]> {
    [unit(), unit(), unit()]
}

/// Two ways to the same point of a shape with positive weights. Each evaluation is within 4(d+2)·u of twice the largest
/// coordinate, by numerator and denominator; the net that an operation makes is as far off once more.
fn allowed(degree: usize, scale: f64) -> f64 {
    6.0 * 3_f64.sqrt() * rounding_bound(degree, 0, scale)
}

fn same(got: DVec3, exact: DVec3, degree: usize, scale: f64) -> Result<(), TestCaseError> {
    let (off, allowed) = (got.distance(exact), allowed(degree, scale));
    prop_assert!(off <= allowed, "{got} {exact}, off {off:e}, allowed {allowed:e}");
    Ok(())
}

proptest! {
    #[test]
    fn hexahedra((points, scale) in net(24), at in cube(), cut in unit(), axis in 0..3_usize) {
        let solid = RationalHexahedron::from_homogeneous([1, 2, 3], points).unwrap();
        let (degree, axis) = (6, Axis::ALL[axis]);
        let exact = solid.point(at).unwrap();
        let [u, v, w] = at;
        // Sections.
        same(solid.patch_at(Axis::U, u).unwrap().point(v, w).unwrap(), exact, degree, scale)?;
        same(solid.patch_at(Axis::V, v).unwrap().point(u, w).unwrap(), exact, degree, scale)?;
        same(solid.patch_at(Axis::W, w).unwrap().point(u, v).unwrap(), exact, degree, scale)?;
        same(solid.curve_at(Axis::U, [v, w]).unwrap().point(u).unwrap(), exact, degree, scale)?;
        same(solid.curve_at(Axis::V, [u, w]).unwrap().point(v).unwrap(), exact, degree, scale)?;
        same(solid.curve_at(Axis::W, [u, v]).unwrap().point(w).unwrap(), exact, degree, scale)?;
        // Faces and edges have the control points of the net.
        for face in HexahedronFace::ALL {
            let patch = solid.face(face).unwrap();
            prop_assert!(patch.control_points().iter().all(|p| solid.control_points().contains(p)));
        }
        for ends in [[false, false], [false, true], [true, false], [true, true]] {
            let edge = solid.edge(Axis::W, ends).unwrap();
            let [i, j] = [usize::from(ends[0]), 2 * usize::from(ends[1])];
            prop_assert!((0..=3).all(|k| edge.control_points()[k] == solid.control_point([i, j, k]).unwrap()));
        }
        // Parts, which share the patch between them to the bit.
        let (below, above) = solid.split(axis, cut).unwrap();
        let place = axis as usize;
        let mut whole = at;
        whole[place] = cut * at[place];
        same(below.point(at).unwrap(), solid.point(whole).unwrap(), 2 * degree, scale)?;
        whole[place] = cut + (1.0 - cut) * at[place];
        same(above.point(at).unwrap(), solid.point(whole).unwrap(), 2 * degree, scale)?;
        let common = |solid: &RationalHexahedron, at_end| solid.face(HexahedronFace { axis, at_end }).unwrap();
        prop_assert!(common(&below, true).control_points() == common(&above, false).control_points());
        let part = [Interval::new(0.25, 0.75).unwrap(), Interval::UNIT, Interval::new(0.0, 0.5).unwrap()];
        let part = solid.restricted(part).unwrap();
        let inside = [0.25 + 0.5 * u, v, 0.5 * w];
        same(part.point(inside).unwrap(), solid.point(inside).unwrap(), 2 * degree, scale)?;
        // The same solid otherwise.
        same(solid.elevated([2, 0, 1]).unwrap().point(at).unwrap(), exact, 2 * degree, scale)?;
        let mut back = at;
        back[place] = 1.0 - at[place];
        let reversed = solid.reversed(axis);
        same(reversed.point(back).unwrap(), exact, degree, scale)?;
        prop_assert_eq!(reversed.reversed(axis), solid.clone());
        let permuted = solid.permuted([Axis::W, Axis::U, Axis::V]).unwrap();
        same(permuted.point([w, u, v]).unwrap(), exact, degree, scale)?;
        // Where the hull and the tight box say.
        let slack = allowed(degree, scale);
        prop_assert!(solid.hull_box().unwrap().grown(slack).contains(exact));
        prop_assert!(solid.tight_box(0.1 * scale).unwrap().grown(slack).contains(exact));
    }

    #[test]
    fn tetrahedra((points, scale) in net(20), at in cube(), cut in unit()) {
        let solid = RationalTetrahedron::from_homogeneous(3, points).unwrap();
        let degree = 3;
        let inside = |[a, b, c]: [f64; 3]| [a / 4.0, b / 4.0, c / 4.0];
        let at = inside(at);
        let exact = solid.point(at).unwrap();
        let [a, b, c] = at;
        // The triangle λ₁ = a, and a straight line of parameters.
        let rest = 1.0 - a;
        let triangle = solid.triangle_between([[a, rest, 0.0], [a, 0.0, rest], [a, 0.0, 0.0]]).unwrap();
        same(triangle.point(b, c).unwrap(), solid.point([a, b * rest, c * rest]).unwrap(), 2 * degree, scale)?;
        let line = solid.curve_between([[0.0; 3], [a, b, c]]).unwrap();
        same(line.point(cut).unwrap(), solid.point(at.map(|l| cut * l)).unwrap(), 2 * degree, scale)?;
        for vertex in 0..4 {
            let face = solid.face(vertex).unwrap();
            prop_assert!(face.control_points().iter().all(|p| solid.control_points().contains(p)));
        }
        let edge = solid.edge([0, 3]).unwrap();
        prop_assert_eq!(edge.control_points()[0], solid.control_points()[0]);
        prop_assert_eq!(edge.control_points()[3], solid.control_points()[19]);
        // λ of a point in the part near vertex 0 of the cut edge.
        let (near, far) = solid.split_edge([0, 1], cut).unwrap();
        let far_face = far.permuted([1, 0, 2, 3]).unwrap().face(0).unwrap();
        prop_assert!(near.face(0).unwrap() == far_face);
        let in_near = [a + b * (1.0 - cut), b * cut, c];
        same(near.point(at).unwrap(), solid.point(in_near).unwrap(), 2 * degree, scale)?;
        let eighths = solid.split_uniform().unwrap();
        let corners = casteljau_bernstein::TETRAHEDRON_EIGHTHS;
        for (part, corners) in eighths.iter().zip(corners) {
            let lambda = [a, b, c, 1.0 - a - b - c];
            let of_whole = |i: usize| (0..4).map(|v| lambda[v] * corners[v][i]).sum::<f64>();
            let of_whole = [of_whole(0), of_whole(1), of_whole(2)];
            same(part.point(at).unwrap(), solid.point(of_whole).unwrap(), 2 * degree, scale)?;
        }
        let quarters = solid.split_at([0.25; 3]).unwrap();
        let whole = [a * 0.25, b + a * 0.25, c + a * 0.25];
        same(quarters[0].point(at).unwrap(), solid.point(whole).unwrap(), 2 * degree, scale)?;
        same(solid.elevated(2).unwrap().point(at).unwrap(), exact, 2 * degree, scale)?;
        let permuted = solid.permuted([2, 0, 3, 1]).unwrap();
        let fourth = 1.0 - a - b - c;
        same(permuted.point([c, a, fourth]).unwrap(), exact, 2 * degree, scale)?;
        prop_assert!(solid.hull_box().unwrap().grown(allowed(degree, scale)).contains(exact));
        prop_assert!(solid.tight_box(0.1 * scale).unwrap().grown(allowed(degree, scale)).contains(exact));
    }

    #[test]
    fn wedges((points, scale) in net(18), at in cube(), cut in unit()) {
        let solid = RationalWedge::from_homogeneous([2, 2], points).unwrap();
        let degree = 4;
        let [a, b, w] = [at[0] / 2.0, at[1] / 2.0, at[2]];
        let exact = solid.point([a, b, w]).unwrap();
        same(solid.triangle_at(w).unwrap().point(a, b).unwrap(), exact, degree, scale)?;
        same(solid.curve_at([a, b]).unwrap().point(w).unwrap(), exact, degree, scale)?;
        // The patch λ₁ = a, by an exact point of the line.
        let sheet = solid.patch_between([[a, 1.0 - a], [a, 0.0]]).unwrap();
        let across = [a, (1.0 - a) * (1.0 - cut), w];
        same(sheet.point(cut, w).unwrap(), solid.point(across).unwrap(), 2 * degree, scale)?;
        for top in [false, true] {
            let face = solid.triangle_face(top).unwrap();
            prop_assert!(face.control_points().iter().all(|p| solid.control_points().contains(p)));
        }
        // On the face opposite vertex 0 u runs from vertex 1 to vertex 2.
        let quad = solid.quad_face(0).unwrap();
        same(quad.point(cut, w).unwrap(), solid.point([0.0, 1.0 - cut, w]).unwrap(), degree, scale)?;
        let (below, above) = solid.split_height(cut).unwrap();
        prop_assert_eq!(below.triangle_face(true).unwrap(), above.triangle_face(false).unwrap());
        same(below.point([a, b, w]).unwrap(), solid.point([a, b, cut * w]).unwrap(), 2 * degree, scale)?;
        let upper = cut + (1.0 - cut) * w;
        same(above.point([a, b, w]).unwrap(), solid.point([a, b, upper]).unwrap(), 2 * degree, scale)?;
        let (near, _) = solid.split_edge([0, 1], cut).unwrap();
        let whole = [a + b * (1.0 - cut), b * cut, w];
        same(near.point([a, b, w]).unwrap(), solid.point(whole).unwrap(), 2 * degree, scale)?;
        let corners = [[0.5, 0.0], [0.0, 0.5], [0.0, 0.0]];
        let part = solid.restricted(corners, Interval::new(0.5, 1.0).unwrap()).unwrap();
        let upper = 0.5 + 0.5 * w;
        same(part.point([a, b, upper]).unwrap(), solid.point([0.5 * a, 0.5 * b, upper]).unwrap(), 2 * degree, scale)?;
        same(solid.elevated([1, 2]).unwrap().point([a, b, w]).unwrap(), exact, 2 * degree, scale)?;
        let turned = solid.reoriented([1, 2, 0], true).unwrap();
        same(turned.point([b, 1.0 - a - b, 1.0 - w]).unwrap(), exact, 2 * degree, scale)?;
        prop_assert!(solid.hull_box().unwrap().grown(allowed(degree, scale)).contains(exact));
        prop_assert!(solid.tight_box(0.1 * scale).unwrap().grown(allowed(degree, scale)).contains(exact));
    }

    /// Reduction undoes elevation, and its bound holds.
    #[test]
    fn reduction((points, scale) in net(27), at in cube()) {
        let polynomial: Vec<DVec3> = points.iter().map(|p| p.truncate() / p.w).collect();
        let solid = Hexahedron::new([2; 3], polynomial.clone()).unwrap();
        let (back, error) = solid.elevated([1, 2, 0]).unwrap().reduced([2; 3]).unwrap();
        prop_assert!(error <= 1e-12 * scale);
        prop_assert!(back.point(at).distance(solid.point(at)) <= 1e-12 * scale);
        let (lower, error) = solid.reduced([1, 2, 1]).unwrap();
        prop_assert!(lower.point(at).distance(solid.point(at)) <= error);
        let tetrahedron = Tetrahedron::new(2, &polynomial[..10]).unwrap();
        let local = at.map(|t| t / 4.0);
        let (lower, error) = tetrahedron.reduced(1).unwrap();
        prop_assert!(lower.point(local).distance(tetrahedron.point(local)) <= error);
        let wedge = Wedge::new([2, 2], &polynomial[..18]).unwrap();
        let (lower, error) = wedge.reduced([1, 1]).unwrap();
        prop_assert!(lower.point(local).distance(wedge.point(local)) <= error);
    }

    /// Moving the control points by an affine map moves the solid by it; its Jacobian is multiplied by the determinant.
    #[test]
    fn affine_invariance((points, scale) in net(12), columns in prop::array::uniform3([-1.0..1.0_f64, -1.0..1.0, -1.0..1.0]), at in cube()) {
        let map = DMat3::from_cols(columns[0].into(), columns[1].into(), columns[2].into());
        let moved: Vec<DVec4> = points.iter().map(|p| (map * p.truncate()).extend(p.w)).collect();
        let local = at.map(|t| t / 4.0);
        let before: [Box<dyn ParametricSolid>; 3] = [
            Box::new(BezierHexahedron::from_net([Interval::UNIT; 3], [1, 1, 2], points.clone()).unwrap()),
            Box::new(BezierTetrahedron::from_net(2, points[..10].to_vec()).unwrap()),
            Box::new(BezierWedge::from_net(Interval::UNIT, [2, 1], points.clone()).unwrap()),
        ];
        let after: [Box<dyn ParametricSolid>; 3] = [
            Box::new(BezierHexahedron::from_net([Interval::UNIT; 3], [1, 1, 2], moved.clone()).unwrap()),
            Box::new(BezierTetrahedron::from_net(2, moved[..10].to_vec()).unwrap()),
            Box::new(BezierWedge::from_net(Interval::UNIT, [2, 1], moved).unwrap()),
        ];
        for (before, after) in before.iter().zip(&after) {
            let (p, q) = (before.try_jet(local).unwrap(), after.try_jet(local).unwrap());
            // A matrix of norm 3 at most.
            prop_assert!((map * p.point).distance(q.point) <= 3.0 * allowed(4, scale));
            let (exact, got) = (map.determinant() * p.jacobian(), q.jacobian());
            // Derivatives are sums of differences, divided by the weight: at most 2·4·1e16 of the scale each by its
            // own; what the determinant is made of stands in its columns.
            let size = 27.0 * p.du.length() * p.dv.length() * p.dw.length();
            let slope = 16.0 * scale * before.weight(local).recip() * 4e8;
            let slopes = [p.du, p.dv, p.dw].map(|d| 3.0 * d.length() + slope * UNIT_ROUNDOFF);
            let off = 3.0 * rounding_bound(4, 1, slope) * (slopes[0] * slopes[1] + slopes[1] * slopes[2] + slopes[2] * slopes[0]);
            prop_assert!((exact - got).abs() <= 64.0 * UNIT_ROUNDOFF * size + 27.0 * off, "{exact} {got}");
        }
    }
}

/// Derivatives of all orders against those of the derivative: a central difference of the order below.
#[test]
fn derivatives_are_those_of_the_parameters() {
    let corner = |place: usize| DVec3::new((place % 3) as f64, (place % 5) as f64, (place % 7) as f64) * 0.2;
    let points: Vec<DVec3> = (0..18).map(corner).collect();
    let weights: Vec<f64> = (0..18).map(|place| 1.0 + 0.2 * (place % 4) as f64).collect();
    let intervals = [Interval::new(1.0, 3.0).unwrap(), Interval::UNIT, Interval::new(-2.0, -1.5).unwrap()];
    let hexahedron = RationalHexahedron::new([2, 1, 2], &points, &weights).unwrap().with_intervals(intervals);
    let wedge = RationalWedge::new([2, 2], &points, &weights).unwrap().with_height(intervals[0]);
    let tetrahedron = RationalTetrahedron::new(2, &points[..10], &weights[..10]).unwrap();
    let cases: [(&dyn ParametricSolid, [f64; 3]); 3] =
        [(&hexahedron, [1.7, 0.3, -1.8]), (&wedge, [0.2, 0.5, 1.4]), (&tetrahedron, [0.2, 0.3, 0.1])];
    for (solid, at) in cases {
        let jet = solid.try_jet_of_order(at, 3).unwrap();
        for (orders, exact) in jet.iter() {
            let Some(axis) = (0..3).find(|&axis| orders[axis] > 0) else { continue };
            let mut lower = orders;
            lower[axis] -= 1;
            let (h, mut before, mut after) = (1e-5, at, at);
            before[axis] -= h;
            after[axis] += h;
            let of = |at| solid.try_jet_of_order(at, 3).unwrap().get(lower).unwrap();
            let slope = (of(after) - of(before)) / (2.0 * h);
            // Truncation is h²/6 of a derivative two orders higher, which at these parameters is below 1e5.
            assert!(
                slope.distance(exact) <= 1e5 * h * h + 1e-9 * (1.0 + exact.length()),
                "{orders:?} {slope} {exact}"
            );
        }
    }
}

#[test]
fn poles_are_errors() {
    let points: Vec<DVec3> =
        (0..8).map(|k| DVec3::new((k >> 2) as f64, (k >> 1 & 1) as f64, (k & 1) as f64)).collect();
    let weights = [1.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0]; // w = 1 − 2u
    let solid = RationalHexahedron::new([1; 3], &points, &weights).unwrap();
    let refused = solid.point([0.5, 0.2, 0.3]).unwrap_err();
    assert!(matches!(refused, SolidError::Shape(ShapeError::Evaluation { .. })));
    assert!(refused.to_string().contains("(0.5, 0.2, 0.3)"), "{refused}");
    assert!(solid.point([0.25, 0.2, 0.3]).is_ok());
    assert!(solid.hull_box().is_none());
    assert!(solid.point([f64::NAN, 0.0, 0.0]).is_err());
    let all_zero = RationalHexahedron::new([1; 3], &points, &[0.0; 8]);
    assert!(matches!(all_zero, Err(SolidError::Shape(ShapeError::NoWeight { .. }))));
    let zero_face =
        RationalHexahedron::new([1; 3], &points, &[0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]).unwrap();
    assert!(zero_face.face(HexahedronFace { axis: Axis::U, at_end: false }).is_err());
}

#[test]
fn orders_have_a_limit() {
    let cube = Hexahedron::unit_cube();
    for order in [129, usize::MAX] {
        let refused = cube.try_jet_of_order([0.5; 3], order).unwrap_err();
        assert_eq!(refused, SolidError::Shape(ShapeError::Order { order, limit: 128 }));
        assert!(cube.try_existing_partials([0.5; 3], order).is_err());
    }
}

#[test]
fn domain_tetrahedra() {
    let vertices = [
        DVec3::new(1.0, 2.0, 3.0),
        DVec3::new(4.0, 2.5, 3.0),
        DVec3::new(0.0, 5.0, 2.0),
        DVec3::new(1.0, 1.0, 9.0),
    ];
    let domain = DomainTetrahedron::new(vertices).unwrap();
    for (vertex, lambda) in
        vertices.into_iter().zip([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3]])
    {
        let got = domain.barycentric(vertex);
        assert!(got.iter().zip(lambda).all(|(a, b)| (a - b).abs() < 1e-14), "{got:?}");
        assert!(domain.at(lambda).distance(vertex) < 1e-14);
    }
    let solid = Tetrahedron::new(1, vertices).unwrap();
    // The identity has the unit matrix for its derivative.
    let gradient = domain.gradient(solid.jet([0.2; 3]).jacobian_matrix());
    assert!((gradient - DMat3::IDENTITY).to_cols_array().iter().all(|x| x.abs() < 1e-14));
    let flat = DomainTetrahedron::new([DVec3::X, DVec3::Y, DVec3::ZERO, DVec3::new(0.3, 0.3, 0.0)]);
    assert!(matches!(flat, Err(SolidError::Construction { .. })));
}

/// Boxes that touch: against the extremes of a fine grid of parameters.
#[test]
fn tight_boxes_touch() {
    let place = |k: usize| DVec3::new((k as f64 * 0.7).sin(), (k as f64 * 1.3).cos(), (k as f64 * 2.1).sin());
    let points: Vec<DVec3> = (0..27).map(place).collect();
    let weights: Vec<f64> = (0..27).map(|k| 1.0 + 0.5 * (k as f64).sin()).collect();
    let hexahedron = RationalHexahedron::new([2; 3], &points, &weights).unwrap();
    let tetrahedron = RationalTetrahedron::new(2, &points[..10], &weights[..10]).unwrap();
    let wedge = RationalWedge::new([2, 2], &points[..18], &weights[..18]).unwrap();
    let tolerance = 1e-3;
    let boxes = [
        hexahedron.tight_box(tolerance).unwrap(),
        tetrahedron.tight_box(tolerance).unwrap(),
        wedge.tight_box(tolerance).unwrap(),
    ];
    let solids: [&dyn ParametricSolid; 3] = [&hexahedron, &tetrahedron, &wedge];
    for (solid, bounds) in solids.into_iter().zip(boxes) {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let steps = 40;
        for k in 0..(steps + 1_usize).pow(3) {
            let at = [k % (steps + 1), k / (steps + 1) % (steps + 1), k / (steps + 1).pow(2)];
            let at = at.map(|i| i as f64 / steps as f64);
            if solid.domain().contains(at) {
                let p = solid.try_point(at).unwrap();
                (low, high) = (low.min(p), high.max(p));
            }
        }
        // Second derivatives below 40: half a step from an extreme the surface has fallen by 40/8 steps².
        let missed = 5.0 / (steps * steps) as f64 * 3.0;
        assert!(
            (low - bounds.min).min_element() >= -1e-12
                && (low - bounds.min).max_element() <= tolerance + missed
        );
        assert!(
            (bounds.max - high).min_element() >= -1e-12
                && (bounds.max - high).max_element() <= tolerance + missed
        );
    }
}

/// A determinant that leaves the range of numbers is an error: never infinite, nor NaN.
#[test]
fn a_jacobian_out_of_range_is_an_error() {
    for scale in [1e110, 1e130] {
        // Terms of both signs.
        let [u, v, w] = [[1.0, 1.0, 1.0], [1.0, 1.0, 0.5], [0.3, -0.2, 1.0]].map(DVec3::from_array);
        let cube = Hexahedron::unit_cube();
        let points = cube.control_points().iter().map(|p| (u * p.x + v * p.y + w * p.z) * scale);
        let solid = Hexahedron::new([1; 3], points.collect::<Vec<_>>()).unwrap();
        for solid in [&solid as &dyn ParametricSolid, &RationalHexahedron::from(solid.clone())] {
            let refused = solid.try_jacobian([0.5; 3]);
            assert!(matches!(refused, Err(SolidError::Shape(ShapeError::Evaluation { .. }))), "{refused:?}");
        }
    }
}
