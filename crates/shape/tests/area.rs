//! Areas against closed forms, and under operations that keep them.
#![allow(clippy::unwrap_used)] // helpers of tests

use std::f64::consts::PI;

use casteljau_geom::Interval;
use casteljau_geom::glam::DVec3;
use casteljau_shape::{
    MeasuredArea, ParametricSurface, Patch, RationalPatch, RationalTriangle, ShapeError, SurfaceDomain,
    Triangle,
};
use proptest::collection::vec;
use proptest::prelude::*;

fn total(patches: &[RationalPatch], relative: f64) -> f64 {
    patches.iter().map(|p| p.area(relative).unwrap()).sum()
}

#[test]
fn closed_forms() {
    for r in [1e-6, 1.0, 1e6] {
        let center = DVec3::new(1.0, 2.0, 3.0) * r;
        let close = |area: f64, exact: f64| assert!((area - exact).abs() <= 2e-12 * exact, "{area} {exact}");
        close(total(&RationalPatch::sphere(center, r).unwrap(), 1e-12), 4.0 * PI * r * r);
        close(
            total(&RationalPatch::cylinder(center, DVec3::ONE * r, r).unwrap(), 1e-12),
            2.0 * PI * r * r * 3_f64.sqrt(),
        );
        close(
            total(&RationalPatch::cone(center, DVec3::Z * (2.0 * r), 1.5 * r).unwrap(), 1e-12),
            PI * 1.5 * r * 2.5 * r,
        );
        close(
            total(&RationalPatch::torus(center, DVec3::X, 3.0 * r, r).unwrap(), 1e-12),
            12.0 * PI * PI * r * r,
        );
        let octant =
            RationalTriangle::sphere_octant(center, DVec3::X * r, DVec3::Y * r, DVec3::Z * r).unwrap();
        close(octant.area(1e-12).unwrap(), 0.5 * PI * r * r);
        let flat = Triangle::new(1, [DVec3::ZERO, DVec3::X * r, DVec3::Y * r]).unwrap();
        close(flat.area(1e-12).unwrap(), 0.5 * r * r);
    }
}

#[test]
fn folds_and_nothing() {
    // x = u(2 − 3u)…: a sheet that turns back on itself along u = 1/3 has 2·4/27 more than its extent.
    let x = [0.0, 1.0, -1.0];
    let sheet = Patch::new(
        [2, 1],
        x.iter().flat_map(|&x| [DVec3::X * x, DVec3::new(x, 1.0, 0.0)]).collect::<Vec<_>>(),
    )
    .unwrap();
    // x = 2u − 3u²: up to 1/3 at u = 1/3, down to −1.
    let exact = 1.0 / 3.0 + 4.0 / 3.0;
    assert!((sheet.area(1e-6).unwrap() - exact).abs() <= 1e-6 * exact);
    let line = Patch::new([1, 1], [DVec3::ZERO, DVec3::X, DVec3::X, 2.0 * DVec3::X]).unwrap();
    assert!(matches!(line.area(1e-3), Err(ShapeError::Area { .. })));
    for relative in [0.0, 1.0, f64::NAN] {
        assert!(matches!(sheet.area(relative), Err(ShapeError::Accuracy { .. })));
    }
    let pole = RationalPatch::new([1, 0], &[DVec3::ZERO, DVec3::X], &[1.0, -1.0]).unwrap();
    assert!(pole.area(1e-3).is_err());
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE];
    let infinite = RationalPatch::new([1, 1], &corners, &[1.0, 1.0, -1.0, -1.0]).unwrap();
    assert!(infinite.area(1e-3).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn parts_add_up(heights in vec(-1.0..1.0, 12), weights in vec(0.5..2.0, 12), cut in 0.2..0.8) {
        let net: Vec<DVec3> = heights.iter().enumerate().map(|(k, &z)| DVec3::new((k / 4) as f64, (k % 4) as f64, z)).collect();
        let patch = RationalPatch::new([2, 3], &net, &weights).unwrap();
        let whole = patch.area(1e-9).unwrap();
        let (left, right) = patch.split_v(cut).unwrap();
        prop_assert!((left.area(1e-9).unwrap() + right.area(1e-9).unwrap() - whole).abs() <= 3e-9 * whole);
        let other = patch.swapped().with_intervals([Interval::new(-1e3, 1e3).unwrap(), Interval::new(0.0, 1e-3).unwrap()]);
        prop_assert!((other.area(1e-9).unwrap() - whole).abs() <= 2e-9 * whole);
        // A graph is no smaller than its shadow.
        let shadow: Vec<DVec3> = net.iter().map(|p| p.with_z(0.0)).collect();
        prop_assert!(RationalPatch::new([2, 3], &shadow, &weights).unwrap().area(1e-9).unwrap() <= whole * (1.0 + 1e-8));
    }
}

/// Node and weight on [0, 1] of Gauss's rule of six points, exact to degree 11.
const SIX: [(f64, f64); 6] = [
    (0.033_765_242_898_423_98, 0.085_662_246_189_585_17),
    (0.169_395_306_766_867_74, 0.180_380_786_524_069_3),
    (0.380_690_406_958_401_55, 0.233_956_967_286_345_52),
    (0.619_309_593_041_598_4, 0.233_956_967_286_345_52),
    (0.830_604_693_233_132_3, 0.180_380_786_524_069_3),
    (0.966_234_757_101_576, 0.085_662_246_189_585_17),
];

/// The area by the rule of six on a grid of equal cells that has no corner inside in common with halvings.
fn by_grid(surface: &dyn ParametricSurface, cells: usize) -> f64 {
    let h = 1.0 / cells as f64;
    let places: Vec<(f64, f64)> =
        (0..cells).flat_map(|k| SIX.map(|(x, w)| ((k as f64 + x) * h, w * h))).collect();
    let mut sum = 0.0;
    for &(x, a) in &places {
        for &(y, b) in &places {
            let ([u, v], jacobian) = match surface.domain() {
                SurfaceDomain::Rectangle([u, v]) => ([u.at(x), v.at(y)], u.length() * v.length()),
                SurfaceDomain::Triangle => ([y * (1.0 - x), (1.0 - y) * (1.0 - x)], 1.0 - x),
            };
            let mut out = [DVec3::ZERO; 3];
            surface.try_partials(u, v, &mut out).unwrap();
            sum += a * b * jacobian * out[1].cross(out[2]).length();
        }
    }
    sum
}

/// The area by three grids, and how far they lie apart.
#[derive(Debug)]
struct Referee {
    area: f64,
    spread: f64,
}

impl Referee {
    /// By the coarsest grids that agree to `relative` and do not contradict what was measured: the finest decide.
    fn of(surface: &dyn ParametricSurface, relative: f64, measured: &MeasuredArea) -> Self {
        let by = |grids: [usize; 3]| {
            let found = grids.map(|cells| by_grid(surface, cells));
            let (low, high) = (found[0].min(found[1]).min(found[2]), found[0].max(found[1]).max(found[2]));
            Self { area: found[2], spread: high - low }
        };
        let rough = by([11, 13, 19]);
        let agrees = (rough.area - measured.area).abs() <= measured.error + rough.spread;
        if rough.spread <= relative * rough.area && agrees { rough } else { by([61, 83, 101]) }
    }
}

#[derive(Debug)]
enum Surface {
    Patch(Patch),
    RationalPatch(RationalPatch),
    Triangle(Triangle),
    RationalTriangle(RationalTriangle),
}

impl Surface {
    fn any(&self) -> &dyn ParametricSurface {
        match self {
            Self::Patch(s) => s,
            Self::RationalPatch(s) => s,
            Self::Triangle(s) => s,
            Self::RationalTriangle(s) => s,
        }
    }
}

/// Patches and triangles of low degree, polynomial and rational, whole or spoilt; whether it is one that folds.
fn surface() -> impl Strategy<Value = (Surface, bool)> {
    let coordinates = vec((-1.0..1.0, -1.0..1.0, -1.0..1.0_f64), 25);
    let weights = vec((-1.0..1.0_f64).prop_map(|e| 10_f64.powf(e)), 25);
    (coordinates, weights, 1..5usize, 1..5usize, any::<[bool; 3]>(), 0..5usize).prop_map(
        |(coordinates, weights, m, n, [rational, triangle, near], spoilt)| {
            let count = if triangle { (m + 1) * (m + 2) / 2 } else { (m + 1) * (n + 1) };
            let mut net: Vec<DVec3> = coordinates[..count].iter().map(|&p| DVec3::from(p)).collect();
            let row = if triangle { 2 } else { n + 1 };
            if near && !triangle {
                // Like a surface: a net near a grid.
                for (k, p) in net.iter_mut().enumerate() {
                    *p = *p * 0.5 + DVec3::new((k / row) as f64, (k % row) as f64, 0.0);
                }
            }
            match spoilt {
                // An edge, or a corner of the triangle with its neighbours, is a point.
                1 => {
                    let first = net[0];
                    net[..row].fill(first);
                }
                // The derivative across vanishes all along an edge: a cusp.
                2 if !triangle && m > 1 => net.copy_within(..row, row),
                // In a plane, where it folds over.
                3 => net.iter_mut().for_each(|p| p.z = 0.0),
                _ => {}
            }
            let surface = match (triangle, rational) {
                (false, false) => Surface::Patch(Patch::new([m, n], net).unwrap()),
                (false, true) => {
                    Surface::RationalPatch(RationalPatch::new([m, n], &net, &weights[..count]).unwrap())
                }
                (true, false) => Surface::Triangle(Triangle::new(m, net).unwrap()),
                (true, true) => {
                    Surface::RationalTriangle(RationalTriangle::new(m, &net, &weights[..count]).unwrap())
                }
            };
            (surface, spoilt == 3)
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { max_global_rejects: 1 << 20, max_local_rejects: 1 << 20, ..ProptestConfig::default() })]

    /// The stated error holds against another rule on another grid. Cases where its grids differ by more than a
    /// quarter of the error asked for are left out: there it is no referee.
    #[test]
    fn stated_errors_hold((surface, folded) in surface(), exponent in 2.0..6.0_f64) {
        let relative = 10_f64.powf(if folded { -0.5 * exponent - 1.0 } else { -exponent });
        match surface.any().area_with_error(relative) {
            Ok(measured) => {
                prop_assert!(measured.error <= relative * measured.area);
                let referee = Referee::of(surface.any(), 0.25 * relative, &measured);
                prop_assume!(referee.spread <= 0.25 * relative * referee.area);
                let off = (measured.area - referee.area).abs();
                prop_assert!(off <= measured.error + referee.spread + 1e-13 * referee.area,
                    "{off:e} off, {:e} stated, {relative:e} asked for, {referee:?}", measured.error);
            }
            Err(ShapeError::Area { area, reached, cells, .. }) => {
                prop_assert!(reached > relative && (cells >= 8000 || area < 1e-9), "{area:e} {reached:e} {cells}");
                return Err(TestCaseError::reject("not reached"));
            }
            Err(other) => prop_assert!(false, "{other}"),
        }
    }
}

/// Where places are large beside the surface their rounding is in the derivatives, and in the stated error.
#[test]
fn far_from_the_origin() {
    for rational in [false, true] {
        let at = |far: f64| {
            let net: Vec<DVec3> = (0..16)
                .map(|k| {
                    DVec3::new((k / 4) as f64, (k % 4) as f64, f64::from(k * k % 7) / 4.0) + DVec3::splat(far)
                })
                .collect();
            let weights: Vec<f64> =
                (0..16).map(|k| if rational { 1.0 + f64::from(k % 5) / 4.0 } else { 1.0 }).collect();
            RationalPatch::new([3, 3], &net, &weights).unwrap()
        };
        let exact = at(0.0).area_with_error(1e-13).unwrap();
        let far = at(1048576.0);
        let measured = far.area_with_error(1e-6).unwrap();
        assert!((measured.area - exact.area).abs() <= measured.error + exact.error, "{measured:?} {exact:?}");
        assert!(measured.error > 1e-11 * measured.area);
        // It is known from the rounding that more cells are no help.
        assert!(matches!(far.area(1e-12), Err(ShapeError::Area { cells, .. }) if cells < 1000));
    }
}
