//! Curves, patches and triangles: examples of the literature, quadrics, curves that join.

use std::f64::consts::TAU;

use casteljau::geom::Interval;
use casteljau::glam::{DVec3, dvec3};
use casteljau::io::model::{Model, NamedShape, Shape};
use casteljau::io::{CurveRecord, NetRecord, PatchRecord, PowerCurveRecord, TriangleRecord};
use casteljau::shape::{Curve, PowerCurve, RationalCurve, RationalPatch, RationalTriangle, ShapeError};

/// File names and models.
pub fn all() -> Result<Vec<(&'static str, Model)>, ShapeError> {
    Ok(vec![
        ("parabolic_cylinder.json", parabolic_cylinder()),
        ("plane_curve.json", plane_curve()),
        ("roof.json", roof()),
        ("circle.json", circle()?),
        ("sphere.json", sphere()?),
        ("torus.json", torus()?),
        ("octant.json", octant()?),
        ("twisted_cubic.json", twisted_cubic()?),
        ("curvature_pair.json", curvature_pair()?),
    ])
}

const UNIT: [f64; 2] = [0.0, 1.0];

fn single(name: &str, shape: Shape) -> Model {
    Model { shapes: vec![NamedShape::new(Some(name.into()), shape)] }
}

fn many(name: &str, shapes: impl Iterator<Item = Shape>) -> Model {
    let named = shapes.enumerate().map(|(i, shape)| NamedShape::new(Some(format!("{name} {i}")), shape));
    Model { shapes: named.collect() }
}

fn patch<const N: usize, const M: usize>(net: [[[f64; 3]; N]; M]) -> Shape {
    Shape::Patch(PatchRecord {
        degrees: [M - 1, N - 1],
        net: NetRecord::Points(net.as_flattened().to_vec()),
        intervals: [UNIT; 2],
    })
}

/// Degrees 2 and 3 for r(u, v) = (3v, 2u, 3v(1 − v)): at (½, ½) the normal is (0, 0, −1), the tangent plane z = ¾, K = 0,
/// |H| = 1/3 and the principal curvatures are 0 and 2/3.
fn parabolic_cylinder() -> Model {
    let row = |y: f64| [[0.0, y, 0.0], [1.0, y, 1.0], [2.0, y, 1.0], [3.0, y, 0.0]];
    single("quadratic-cubic patch", patch([row(0.0), row(1.0), row(2.0)]))
}

/// A plane curve of degree 5.
fn plane_curve() -> Model {
    let points = [[0.0, 0.0], [1.0, 1.0], [2.0, 0.5], [3.0, 0.5], [0.5, 1.5], [1.5, 0.0]];
    let points = points.map(|[x, y]| [x, y, 0.0]);
    single(
        "curve of six points",
        Shape::Curve(CurveRecord { net: NetRecord::Points(points.to_vec()), interval: UNIT }),
    )
}

/// A surface of 3 × 4 points.
fn roof() -> Model {
    let net = [
        [[-3.0, 0.0, 2.0], [-2.0, 0.0, 6.0], [-1.0, 0.0, 7.0], [0.0, 0.0, 2.0]],
        [[-3.0, 1.0, 2.0], [-2.0, 1.0, 4.0], [-1.0, 1.0, 5.0], [0.0, 1.0, 2.5]],
        [[-3.0, 3.0, 0.0], [-2.0, 3.0, 2.5], [-1.0, 3.0, 4.5], [0.0, 3.0, 6.5]],
    ];
    single("surface of 3 × 4 points", patch(net))
}

/// The unit circle in one piece, of degree 5, its parameter running over [0, 2π].
fn circle() -> Result<Model, ShapeError> {
    let circle = RationalCurve::full_circle(DVec3::ZERO, DVec3::X, DVec3::Y)?;
    let circle = circle.with_interval(Interval::new(0.0, TAU).unwrap_or(Interval::UNIT));
    Ok(single("full circle", Shape::Curve((&circle).into())))
}

/// Eight octants, each with an edge that collapses to a pole.
fn sphere() -> Result<Model, ShapeError> {
    let patches = RationalPatch::sphere(DVec3::ZERO, 1.0)?;
    Ok(many("octant", patches.iter().map(|patch| Shape::Patch(patch.into()))))
}

/// Sixteen patches: a ring of radius 3 with a tube of radius 1.
fn torus() -> Result<Model, ShapeError> {
    let patches = RationalPatch::torus(DVec3::ZERO, DVec3::Z, 3.0, 1.0)?;
    Ok(many("piece", patches.iter().map(|patch| Shape::Patch(patch.into()))))
}

/// An eighth of the unit sphere as a triangle of degree 4, regular everywhere.
fn octant() -> Result<Model, ShapeError> {
    let octant = RationalTriangle::sphere_octant(DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z)?;
    Ok(single("sphere octant", Shape::Triangle(TriangleRecord::from(&octant))))
}

/// (t, t², t³) over [−1, 2]: at t = 0 curvature 2 and torsion 3.
fn twisted_cubic() -> Result<Model, ShapeError> {
    let cubic = PowerCurve::new([DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z])?;
    let cubic = cubic.with_interval(Interval::new(-1.0, 2.0).unwrap_or(Interval::UNIT));
    Ok(single("twisted cubic", Shape::PowerCurve(PowerCurveRecord::from(&cubic))))
}

/// Two cubics that join with continuous curvature, and not with equal second derivatives.
fn curvature_pair() -> Result<Model, ShapeError> {
    let first = Curve::new([DVec3::ZERO, dvec3(1.0, 2.0, 0.0), dvec3(3.0, 3.0, 1.0), dvec3(5.0, 3.0, 1.0)])?;
    let second = first.continued_with_curvature(0.5, 0.25, &[dvec3(8.0, 0.0, 2.0)])?;
    let shape = |curve: &Curve| Shape::Curve(curve.into());
    Ok(Model {
        shapes: vec![
            NamedShape::new(Some("first".into()), shape(&first)),
            NamedShape::new(Some("second".into()), shape(&second)),
        ],
    })
}
