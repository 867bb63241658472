//! Solids.

use casteljau::geom::{BoundingBox, Interval};
use casteljau::glam::DVec4;
use casteljau::io::Geometry;
use casteljau::io::model::NamedShape;
use casteljau::solid::{ConstructedSolid, Construction, SolidDomain, Twist};
use serde::Serialize;

use super::Bounds;
use super::classical::{SNUG, snug};
use crate::check::integrate;
use crate::failure::Failure;
use crate::number::{human, tuple};
use crate::output::Lines;

/// A solid. `bounds` contains it, each face at most a millionth of its size away;
/// null where it may reach infinity. `construction` says what a solid is made of. `volume` is the integral of the Jacobian,
/// negative for a solid turned inside out; it and the centroid are null where they could not be found.
#[derive(Serialize)]
pub struct Description {
    shape: usize,
    kind: &'static str,
    name: Option<String>,
    degree: Degree,
    rational: bool,
    control_points: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    intervals: Option<[[f64; 2]; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    interval: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    construction: Option<Made>,
    bounds: Option<Bounds>,
    volume: Option<f64>,
    centroid: Option<[f64; 3]>,
}

/// The degree of a tetrahedron, the degrees of a wedge or a hexahedron.
#[derive(Serialize)]
#[serde(untagged)]
enum Degree {
    Simplex(usize),
    Wedge([usize; 2]),
    Box([usize; 3]),
}

/// What a solid is made of: the degrees of its patch and its curve, and the angle, by the model file's names for them.
#[derive(Serialize)]
struct Made {
    #[serde(skip_serializing_if = "Option::is_none")]
    patch: Option<[usize; 2]>,
    curve: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    angle: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rigid_angle: Option<f64>,
}

/// None for what is no solid.
pub fn describe(shape: usize, named: &NamedShape, geometry: &Geometry) -> Option<Description> {
    let domain = geometry.as_solid()?.domain();
    let (degree, control_points) = match geometry {
        Geometry::Tetrahedron(solid) => (Degree::Simplex(solid.degree()), solid.control_points().len()),
        Geometry::RationalTetrahedron(solid) => {
            (Degree::Simplex(solid.degree()), solid.control_points().len())
        }
        Geometry::Wedge(solid) => (Degree::Wedge(solid.degrees()), solid.control_points().len()),
        Geometry::RationalWedge(solid) => (Degree::Wedge(solid.degrees()), solid.control_points().len()),
        Geometry::Hexahedron(solid) => (Degree::Box(solid.degrees()), solid.control_points().len()),
        Geometry::RationalHexahedron(solid) => (Degree::Box(solid.degrees()), solid.control_points().len()),
        Geometry::Constructed(solid) => {
            let solid = solid.hexahedron();
            (Degree::Box(solid.degrees()), solid.control_points().len())
        }
        _ => return None,
    };
    let ends = |i: Interval| [i.start(), i.end()];
    let properties = integrate(geometry).and_then(Result::ok);
    Some(Description {
        shape,
        kind: named.shape.kind(),
        name: named.name.clone(),
        degree,
        rational: geometry.is_rational(),
        control_points,
        intervals: match domain {
            SolidDomain::Box(intervals) => Some(intervals.map(ends)),
            _ => None,
        },
        interval: match domain {
            SolidDomain::Wedge(height) => Some(ends(height)),
            _ => None,
        },
        construction: match geometry {
            Geometry::Constructed(solid) => Some(made(solid)),
            _ => None,
        },
        bounds: bounds(geometry).map(Bounds::from),
        volume: properties.map(|p| p.volume),
        centroid: properties.and_then(|p| p.centroid).map(|c| c.to_array()),
    })
}

fn made(solid: &ConstructedSolid) -> Made {
    match solid.construction() {
        Construction::Transitional { patch, curve } => {
            Made { patch: Some(patch.degrees()), curve: curve.degree(), angle: None, rigid_angle: None }
        }
        Construction::Rotational { curve } => {
            Made { patch: None, curve: curve.degree(), angle: None, rigid_angle: None }
        }
        Construction::Twisted { patch, curve, twist } => {
            let (angle, rigid_angle) = match *twist {
                Twist::PerLayer(angle) => (Some(angle), None),
                Twist::Rigid(angle) => (None, Some(angle)),
            };
            Made { patch: Some(patch.degrees()), curve: curve.degree(), angle, rigid_angle }
        }
    }
}

/// The box around the solid over its domain.
fn bounds(geometry: &Geometry) -> Option<BoundingBox> {
    let hull = geometry.control_box();
    let within = |points: &[DVec4]| snug(hull, points);
    let size = || (SNUG * hull.map_or(0.0, |b| b.diagonal())).max(f64::MIN_POSITIVE);
    match geometry {
        Geometry::Tetrahedron(solid) => solid.tight_box(size()).ok(),
        Geometry::RationalTetrahedron(solid) => solid.tight_box(within(solid.control_points())).ok(),
        Geometry::Hexahedron(solid) => solid.tight_box(size()).ok(),
        Geometry::RationalHexahedron(solid) => solid.tight_box(within(solid.control_points())).ok(),
        Geometry::Constructed(solid) => {
            let solid = solid.hexahedron();
            solid.tight_box(within(solid.control_points())).ok()
        }
        Geometry::Wedge(solid) => solid.tight_box(size()).ok(),
        Geometry::RationalWedge(solid) => solid.tight_box(within(solid.control_points())).ok(),
        _ => hull,
    }
}

pub fn text(description: &Description, title: &str, lines: &mut Lines) -> Result<(), Failure> {
    let Description { kind, control_points, .. } = description;
    let rational = if description.rational { "rational " } else { "" };
    let degree = match description.degree {
        Degree::Simplex(n) => format!("degree {n}"),
        Degree::Wedge([n, o]) => format!("degrees {n} (triangle), {o} (height)"),
        Degree::Box([l, m, n]) => format!("degrees {l}, {m}, {n}"),
    };
    lines.text(&format!("{title}: {rational}{kind}, {degree}, {control_points} control points"))?;
    if let Some(made) = &description.construction {
        lines.text(&format!("  made of      {}", words(made)))?;
    }
    let interval = |[a, b]: [f64; 2]| format!("[{}, {}]", human(a), human(b));
    if let Some(ends) = description.interval {
        lines.text(&format!("  height       {}", interval(ends)))?;
    }
    if let Some([u, v, w]) = description.intervals {
        lines.text(&format!("  intervals    {}, {}, {}", interval(u), interval(v), interval(w)))?;
    }
    lines.text(&match &description.bounds {
        Some(bounds) => format!("  bounds       {} to {}", tuple(&bounds.min), tuple(&bounds.max)),
        None => "  bounds       none, the shape may reach infinity".into(),
    })?;
    if let Some(volume) = description.volume {
        lines.text(&format!("  volume       {}", human(volume)))?;
    }
    if let Some(centroid) = description.centroid {
        lines.text(&format!("  centroid     {}", tuple(&centroid)))?;
    }
    Ok(())
}

fn words(made: &Made) -> String {
    let curve = format!("a curve of degree {}", made.curve);
    let Some([m, n]) = made.patch else { return format!("{curve}, rotated about the z axis") };
    let swept = format!("a patch of degrees {m}, {n} along {curve}");
    match (made.angle, made.rigid_angle) {
        (Some(angle), _) => format!("{swept}, each layer turned by {} radians", human(angle)),
        (_, Some(angle)) => format!("{swept}, turned rigidly by {} radians", human(angle)),
        _ => swept,
    }
}
