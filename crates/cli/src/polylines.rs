//! `casteljau mesh` of curves: polylines.

use casteljau::glam::DVec3;
use casteljau::io::{Geometry, MeshFormat, obj, ply};
use casteljau::shape::{RationalCurve, ShapeError};
use casteljau::tess::{Density, SideSamples};
use serde::Serialize;

use crate::arguments::Mesh;
use crate::failure::Failure;
use crate::input::{Input, is_dash};
use crate::number::{brief, human};
use crate::output::{Lines, write};

/// What was written; `length` is that of the polylines, `chord_error` a bound, null with a resolution.
#[derive(Serialize)]
struct Report {
    output: String,
    shapes: usize,
    vertices: usize,
    edges: usize,
    tolerance: Option<f64>,
    chord_error: Option<f64>,
    length: f64,
}

/// Writes the curves; all shapes are curves.
pub fn run(
    options: &Mesh,
    input: &Input,
    shapes: &[Geometry],
    (density, most): (Density, usize),
    format: MeshFormat,
    json: bool,
) -> Result<(), Failure> {
    if !matches!(format, MeshFormat::Obj | MeshFormat::Ply) {
        return Err(Failure::Bad(format!(
            "{}: curves have no triangles, and this format holds nothing else; use obj or ply",
            options.output.display()
        )));
    }
    let (mut polylines, mut chord_error, mut vertices) = (Vec::with_capacity(shapes.len()), 0.0, 0);
    for (geometry, (_, named)) in shapes.iter().zip(&input.shapes) {
        let placed = |error: ShapeError| Failure::Bad(format!("{}: {error}", named.place()));
        let Some(curve) = bezier(geometry).transpose().map_err(placed)? else { continue };
        // A polyline has a vertex more than edges.
        let room = most.saturating_sub(vertices).saturating_sub(1);
        let Some(samples) = SideSamples::rational(&curve, density, room) else {
            return Err(Failure::Bad(format!(
                "{}: the curve has a pole, or needs more than {room} edges",
                named.place()
            )));
        };
        chord_error = f64::max(chord_error, samples.chord_error());
        vertices += samples.points().len();
        polylines.push(samples.points().to_vec());
    }
    write(&options.output, |out| match format {
        MeshFormat::Ply => ply::write_polylines(&polylines, out),
        _ => obj::write_polylines(&polylines, out),
    })?;
    if is_dash(&options.output) {
        return Ok(());
    }
    let length = |line: &Vec<DVec3>| line.windows(2).map(|ends| ends[0].distance(ends[1])).sum::<f64>();
    let report = Report {
        output: options.output.display().to_string(),
        shapes: polylines.len(),
        vertices,
        edges: vertices - polylines.len(),
        tolerance: match density {
            Density::Tolerance(tolerance) => Some(tolerance),
            Density::Resolution(_) => None,
        },
        chord_error: matches!(density, Density::Tolerance(_)).then_some(chord_error),
        length: polylines.iter().map(length).sum(),
    };
    let mut lines = Lines::new();
    match json {
        true => lines.json(&report)?,
        false => {
            lines
                .text(&format!("{}: {} vertices, {} edges", report.output, report.vertices, report.edges))?;
            if let (Some(error), Some(tolerance)) = (report.chord_error, report.tolerance) {
                lines.text(&format!("  chord error  {} (tolerance {})", brief(error), human(tolerance)))?;
            }
            lines.text(&format!("  length       {}", human(report.length)))?;
        }
    }
    lines.finish()
}

/// A curve in rational Bernstein form.
fn bezier(geometry: &Geometry) -> Option<Result<RationalCurve, ShapeError>> {
    match geometry {
        Geometry::Curve(curve) => Some(Ok(curve.clone().into())),
        Geometry::RationalCurve(curve) => Some(Ok(curve.clone())),
        Geometry::PowerCurve(curve) => Some(curve.to_bezier().map(Into::into)),
        _ => None,
    }
}
