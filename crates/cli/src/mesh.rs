//! `casteljau mesh`: from a model to a mesh file.

use casteljau::gb::ConcavePatch;
use casteljau::geom::BoundingBox;
use casteljau::io::{MeshFormat, obj, off, ply, stl};
use casteljau::mesh::TriangleMesh;
use casteljau::tess::{Density, Seams, TessellationOptions, tessellate};
use serde::Serialize;

use crate::arguments::{Mesh, MeshFormatName};
use crate::failure::Failure;
use crate::input::{Input, is_dash};
use crate::number::{brief, human, optional};
use crate::output::{Lines, write};
use crate::progress::Progress;

/// The default tolerance, in units of the model's size.
const DEFAULT_TOLERANCE: f64 = 1.0 / 2000.0;

/// What was written. `volume` is null unless the mesh is closed; angles are in degrees.
#[derive(Serialize)]
struct Report {
    output: String,
    shapes: usize,
    vertices: usize,
    triangles: usize,
    tolerance: Option<f64>,
    chord_error: Option<f64>,
    closed: bool,
    boundary_edges: usize,
    min_angle: Option<f64>,
    interior_below_19: usize,
    boundary_below_10: usize,
    area: f64,
    volume: Option<f64>,
}

pub fn run(options: &Mesh, json: bool) -> Result<(), Failure> {
    if let Some(tolerance) = options.tolerance.filter(|x| !(x.is_finite() && *x > 0.0)) {
        return Err(Failure::Usage(format!("--tolerance must be a number above 0, not {tolerance}")));
    }
    if options.resolution == Some(0) {
        return Err(Failure::Usage("--resolution must be 1 or more".into()));
    }
    let format = match is_dash(&options.output) {
        true => named(options.format),
        false => MeshFormat::of_path(&options.output)?,
    };
    let input = Input::read(&options.selection)?;
    let patches = input.patches()?;
    let tessellation = tessellation(options, &patches);
    let mut progress = Progress::new("meshing");
    let (mesh, report) = tessellate(&patches, &tessellation, &mut |fraction| progress.tell(fraction))
        .map_err(|error| Failure::Bad(format!("{}: {error}", input.name)))?;
    drop(progress);

    let audit = mesh.audit()?;
    write(&options.output, |out| match format {
        MeshFormat::Off => off::write(&mesh, out),
        MeshFormat::Ply => ply::write(&mesh, out),
        MeshFormat::Stl => stl::write(&mesh, out),
        _ => obj::write(&mesh, out),
    })?;
    if is_dash(&options.output) {
        return Ok(());
    }
    let closed = audit.closed && audit.manifold && audit.oriented;
    let mut lines = Lines::new();
    let report = Report {
        output: options.output.display().to_string(),
        shapes: patches.len(),
        vertices: mesh.positions.len(),
        triangles: mesh.triangles.len(),
        tolerance: match tessellation.density {
            Density::Tolerance(tolerance) => Some(tolerance),
            Density::Resolution(_) => None,
        },
        chord_error: report.chord_error,
        closed,
        boundary_edges: audit.boundary_edges,
        min_angle: audit.min_angle.map(f64::to_degrees),
        interior_below_19: report.space.interior_below_19,
        boundary_below_10: report.space.boundary_below_10,
        area: mesh.area()?,
        volume: volume(&mesh, closed)?,
    };
    if json {
        lines.json(&report)?
    } else {
        text(&report, &mut lines)?
    }
    lines.finish()
}

fn volume(mesh: &TriangleMesh, closed: bool) -> Result<Option<f64>, Failure> {
    Ok(if closed { Some(mesh.signed_volume()?) } else { None })
}

fn named(format: MeshFormatName) -> MeshFormat {
    match format {
        MeshFormatName::Obj => MeshFormat::Obj,
        MeshFormatName::Off => MeshFormat::Off,
        MeshFormatName::Ply => MeshFormat::Ply,
        MeshFormatName::Stl => MeshFormat::Stl,
    }
}

fn tessellation(options: &Mesh, patches: &[ConcavePatch]) -> TessellationOptions {
    let density = match (options.tolerance, options.resolution) {
        (_, Some(resolution)) => Density::Resolution(resolution),
        (Some(tolerance), _) => Density::Tolerance(tolerance),
        (None, None) => Density::Tolerance(DEFAULT_TOLERANCE * size(patches)),
    };
    let mut tessellation =
        TessellationOptions { normals: options.normals, ..TessellationOptions::new(density) };
    if options.separate {
        tessellation.seams = Seams::Separate;
    }
    if let Some(most) = options.max_vertices {
        tessellation.max_vertices = most;
    }
    tessellation
}

/// The diagonal of the box of all patches.
fn size(patches: &[ConcavePatch]) -> f64 {
    let boxes = patches.iter().map(ConcavePatch::bounding_box);
    boxes.reduce(|a: BoundingBox, b| a.union(&b)).map_or(0.0, |all| all.diagonal())
}

fn text(report: &Report, lines: &mut Lines) -> Result<(), Failure> {
    lines
        .text(&format!("{}: {} vertices, {} triangles", report.output, report.vertices, report.triangles))?;
    if let (Some(tolerance), Some(error)) = (report.tolerance, report.chord_error) {
        lines.text(&format!("  chord error  {} (tolerance {})", brief(error), brief(tolerance)))?;
    }
    let angle = report.min_angle.map_or_else(|| "none".into(), brief);
    let (inner, outer) = (report.interior_below_19, report.boundary_below_10);
    lines.text(&format!("  least angle  {angle}°; {inner} inner below 19°, {outer} at sides below 10°"))?;
    lines.text(&format!("  area         {}", human(report.area)))?;
    match report.closed {
        true => lines.text(&format!("  volume       {}, closed", optional(report.volume))),
        false => lines.text(&format!("  volume       none, open: {} boundary edges", report.boundary_edges)),
    }
}
