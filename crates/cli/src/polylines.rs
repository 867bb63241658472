//! `casteljau mesh` of curves: polylines through points at equal steps of the parameter.

use casteljau::glam::DVec3;
use casteljau::io::{Geometry, MeshFormat, obj, ply};
use serde::Serialize;

use crate::arguments::Mesh;
use crate::failure::Failure;
use crate::input::{Input, is_dash};
use crate::number::human;
use crate::output::{Lines, write};

/// What was written; `length` is that of the polylines.
#[derive(Serialize)]
struct Report {
    output: String,
    shapes: usize,
    vertices: usize,
    edges: usize,
    length: f64,
}

/// Writes the curves; all shapes are curves.
pub fn run(
    options: &Mesh,
    input: &Input,
    shapes: &[Geometry],
    format: MeshFormat,
    json: bool,
) -> Result<(), Failure> {
    if !matches!(format, MeshFormat::Obj | MeshFormat::Ply) {
        return Err(Failure::Bad(format!(
            "{}: curves have no triangles, and this format holds nothing else; use obj or ply",
            options.output.display()
        )));
    }
    let Some(steps) = options.resolution else {
        return Err(Failure::Usage(
            "curves are meshed by --resolution: a tolerance is not supported yet".into(),
        ));
    };
    let most = options.max_vertices.unwrap_or(casteljau::tess::DEFAULT_MAX_VERTICES);
    let needed = steps.saturating_add(1).saturating_mul(shapes.len());
    if needed > most {
        return Err(Failure::Bad(format!("{}: {needed} vertices are more than {most}", input.name)));
    }
    let mut polylines = Vec::with_capacity(shapes.len());
    for (geometry, (_, named)) in shapes.iter().zip(&input.shapes) {
        let Some(curve) = geometry.as_curve() else { continue };
        let interval = curve.interval();
        let at = |k: usize| curve.try_point(interval.at(k as f64 / steps as f64));
        let points = (0..=steps).map(at).collect::<Result<Vec<DVec3>, _>>();
        polylines.push(points.map_err(|error| Failure::Bad(format!("{}: {error}", named.place())))?);
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
        vertices: needed,
        edges: steps * polylines.len(),
        length: polylines.iter().map(length).sum(),
    };
    let mut lines = Lines::new();
    match json {
        true => lines.json(&report)?,
        false => {
            lines
                .text(&format!("{}: {} vertices, {} edges", report.output, report.vertices, report.edges))?;
            lines.text(&format!("  length       {}", human(report.length)))?;
        }
    }
    lines.finish()
}
