//! Curves, patches and triangles.

use casteljau::geom::{BoundingBox, Interval};
use casteljau::glam::{DVec4, Vec4Swizzles};
use casteljau::io::Geometry;
use casteljau::io::model::NamedShape;
use casteljau::shape::{Curve, ParametricSurface, ShapeError, SurfaceDomain};
use serde::Serialize;

use super::Bounds;
use crate::failure::Failure;
use crate::number::{brief, human, tuple};
use crate::output::Lines;

/// Relative accuracy of lengths and areas.
const ACCURACY: f64 = 1e-9;
/// How far a face of the box may be from touching the shape, in units of the shape's size.
pub(super) const SNUG: f64 = 1e-6;

/// The degree of a curve or a triangle, the degrees of a patch.
#[derive(Serialize)]
#[serde(untagged)]
enum Degree {
    One(usize),
    Two([usize; 2]),
}

/// A curve, a patch or a triangle. `bounds` contains the shape, each face at most a millionth of its size away; it is null
/// where the shape reaches infinity. `length_error` is certain, `area_error` an estimate; both, with their values, are null
/// where there is a pole.
#[derive(Serialize)]
pub struct Description {
    shape: usize,
    kind: &'static str,
    name: Option<String>,
    degree: Degree,
    rational: bool,
    control_points: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    interval: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    intervals: Option<[[f64; 2]; 2]>,
    bounds: Option<Bounds>,
    #[serde(flatten)]
    measure: Measure,
}

#[derive(Serialize)]
#[serde(untagged)]
enum Measure {
    Length { length: Option<f64>, length_error: Option<f64> },
    Area { area: Option<f64>, area_error: Option<f64> },
}

pub fn describe(shape: usize, named: &NamedShape, geometry: &Geometry) -> Result<Description, Failure> {
    let (degree, control_points) = match geometry {
        Geometry::Curve(curve) => (Degree::One(curve.degree()), curve.control_points().len()),
        Geometry::RationalCurve(curve) => (Degree::One(curve.degree()), curve.control_points().len()),
        Geometry::PowerCurve(curve) => (Degree::One(curve.degree()), curve.coefficients().len()),
        Geometry::Patch(patch) => (Degree::Two(patch.degrees()), patch.control_points().len()),
        Geometry::RationalPatch(patch) => (Degree::Two(patch.degrees()), patch.control_points().len()),
        Geometry::PowerPatch(patch) => (Degree::Two(patch.degrees()), patch.coefficients().len()),
        Geometry::Triangle(triangle) => (Degree::One(triangle.degree()), triangle.control_points().len()),
        Geometry::RationalTriangle(triangle) => {
            (Degree::One(triangle.degree()), triangle.control_points().len())
        }
        _ => return Err(Failure::Bad(format!("{}: no description of this kind", named.place()))),
    };
    let ends = |i: Interval| [i.start(), i.end()];
    Ok(Description {
        shape,
        kind: named.shape.kind(),
        name: named.name.clone(),
        degree,
        rational: geometry.is_rational(),
        control_points,
        interval: geometry.as_curve().map(|curve| ends(curve.interval())),
        intervals: match geometry.as_surface().map(|surface| surface.domain()) {
            Some(SurfaceDomain::Rectangle(intervals)) => Some(intervals.map(ends)),
            _ => None,
        },
        bounds: bounds(geometry).map(Bounds::from),
        measure: measure(geometry).map_err(|error| Failure::Bad(format!("{}: {error}", named.place())))?,
    })
}

/// How far a face of the box of a rational shape may be away, in units of the box of control points or, where weights of
/// both signs make that useless, of the largest coordinate.
pub(super) fn snug(control: Option<BoundingBox>, points: &[DVec4]) -> f64 {
    let far = |p: &DVec4| p.xyz().abs().max_element() / if p.w == 0.0 { 1.0 } else { p.w.abs() };
    let size = control.map_or_else(|| points.iter().map(far).fold(0.0, f64::max), |b| b.diagonal());
    (SNUG * size).max(f64::MIN_POSITIVE)
}

/// The box around the shape over its domain.
fn bounds(geometry: &Geometry) -> Option<BoundingBox> {
    let diagonal = |b: BoundingBox| (SNUG * b.diagonal()).max(f64::MIN_POSITIVE);
    match geometry {
        Geometry::Curve(curve) => curve.tight_box(diagonal(curve.bounding_box())).ok(),
        Geometry::RationalCurve(curve) => {
            curve.tight_box(snug(curve.hull_box(), curve.control_points())).ok()
        }
        Geometry::PowerCurve(curve) => bounds(&Geometry::Curve(curve.to_bezier().ok()?)),
        Geometry::Patch(patch) => patch.tight_box(diagonal(patch.bounding_box())).ok(),
        Geometry::RationalPatch(patch) => {
            patch.tight_box(snug(patch.hull_box(), patch.control_points())).ok()
        }
        Geometry::PowerPatch(patch) => bounds(&Geometry::Patch(patch.to_bezier().ok()?)),
        Geometry::Triangle(triangle) => triangle.tight_box(diagonal(triangle.bounding_box())).ok(),
        Geometry::RationalTriangle(triangle) => {
            triangle.tight_box(snug(triangle.hull_box(), triangle.control_points())).ok()
        }
        _ => geometry.control_box(),
    }
}

fn measure(geometry: &Geometry) -> Result<Measure, ShapeError> {
    Ok(match geometry {
        Geometry::Curve(curve) => length(curve.arc_length(ACCURACY))?,
        Geometry::RationalCurve(curve) => length(curve.arc_length(ACCURACY))?,
        Geometry::PowerCurve(curve) => length(curve.to_bezier().and_then(|c: Curve| c.arc_length(ACCURACY)))?,
        _ => match geometry.as_surface() {
            Some(surface) => area(surface)?,
            None => Measure::Area { area: None, area_error: None },
        },
    })
}

fn length(found: Result<f64, ShapeError>) -> Result<Measure, ShapeError> {
    let (length, error) = match found {
        Ok(length) => (Some(length), Some(ACCURACY * length)),
        Err(ShapeError::ZeroLength { .. }) => (Some(0.0), Some(0.0)),
        Err(ShapeError::ArcLength { length, reached, .. }) => (Some(length), Some(reached * length)),
        // There is a pole.
        Err(ShapeError::Unbounded | ShapeError::Evaluation { .. }) => (None, None),
        Err(error) => return Err(error),
    };
    Ok(Measure::Length { length: finite(length), length_error: finite(error) })
}

fn area(surface: &dyn ParametricSurface) -> Result<Measure, ShapeError> {
    let (area, error) = match surface.area_with_error(ACCURACY) {
        Ok(measured) => (Some(measured.area), Some(measured.error)),
        Err(ShapeError::Area { area: 0.0, .. }) => (Some(0.0), None),
        Err(ShapeError::Area { area, reached, .. }) => (Some(area), Some(reached * area)),
        Err(ShapeError::Unbounded | ShapeError::Evaluation { .. }) => (None, None),
        Err(error) => return Err(error),
    };
    Ok(Measure::Area { area: finite(area), area_error: finite(error) })
}

/// JSON has no infinity.
fn finite(x: Option<f64>) -> Option<f64> {
    x.filter(|x| x.is_finite())
}

pub fn text(description: &Description, title: &str, lines: &mut Lines) -> Result<(), Failure> {
    let Description { kind, control_points, .. } = description;
    let rational = if description.rational { "rational " } else { "" };
    let degree = match description.degree {
        Degree::One(n) => format!("degree {n}"),
        Degree::Two([m, n]) => format!("degrees {m}, {n}"),
    };
    let points = if kind.starts_with("power") { "coefficients" } else { "control points" };
    lines.text(&format!("{title}: {rational}{kind}, {degree}, {control_points} {points}"))?;
    let interval = |[a, b]: [f64; 2]| format!("[{}, {}]", human(a), human(b));
    if let Some(ends) = description.interval {
        lines.text(&format!("  interval     {}", interval(ends)))?;
    }
    if let Some([u, v]) = description.intervals {
        lines.text(&format!("  intervals    {}, {}", interval(u), interval(v)))?;
    }
    lines.text(&match &description.bounds {
        Some(bounds) => format!("  bounds       {} to {}", tuple(&bounds.min), tuple(&bounds.max)),
        None => "  bounds       none, the shape reaches infinity".into(),
    })?;
    let (what, value, error) = match description.measure {
        Measure::Length { length, length_error } => ("length", length, length_error),
        Measure::Area { area, area_error } => ("area", area, area_error),
    };
    lines.text(&match (value, error) {
        (Some(value), Some(error)) => format!("  {what:<12} {} ± {}", human(value), brief(error)),
        (Some(value), None) => format!("  {what:<12} {}", human(value)),
        (None, _) => format!("  {what:<12} none, there is a pole"),
    })
}
