//! `casteljau mesh`: from a model to a mesh file.

use casteljau::geom::BoundingBox;
use casteljau::io::model::NamedShape;
use casteljau::io::{Geometry, MeshFormat, obj, off, ply, stl};
use casteljau::mesh::TriangleMesh;
use casteljau::shape::SurfaceDomain;
use casteljau::tess::{Density, Face, Seams, TessellationOptions, tessellate};
use serde::Serialize;

use crate::arguments::{Mesh, MeshFormatName};
use crate::failure::Failure;
use crate::input::{Input, is_dash};
use crate::number::{brief, human, optional};
use crate::output::{Lines, write};
use crate::polylines;
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
    let shapes = input.shapes.iter().map(|(_, named)| input.geometry(named));
    let shapes = shapes.collect::<Result<Vec<_>, _>>()?;
    if shapes.iter().all(|shape| shape.as_curve().is_some()) {
        let TessellationOptions { density, max_vertices, .. } = tessellation(options, &shapes);
        return polylines::run(options, &input, &shapes, (density, max_vertices), format, json);
    }
    let faces = faces(&input, &shapes)?;
    let tessellation = tessellation(options, &shapes);
    let mut progress = Progress::new("meshing");
    let (mesh, report) = tessellate(&faces, &tessellation, &mut |fraction| progress.tell(fraction))
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
        shapes: shapes.len(),
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

/// The shapes as the mesher takes them.
fn faces<'g>(input: &Input, shapes: &'g [Geometry]) -> Result<Vec<Face<'g>>, Failure> {
    let face = |(geometry, (_, named)): (&'g Geometry, &(usize, NamedShape))| match geometry {
        Geometry::GbPatch(patch) => Ok(Face::from(patch.as_ref())),
        Geometry::Patch(patch) => Ok(patch.into()),
        Geometry::RationalPatch(patch) => Ok(patch.into()),
        Geometry::PowerPatch(patch) => Ok(patch.into()),
        Geometry::Triangle(triangle) => Ok(triangle.into()),
        Geometry::RationalTriangle(triangle) => Ok(triangle.into()),
        _ => {
            let kind = named.shape.kind();
            Err(Failure::Bad(format!("{}: a shape of kind `{kind}` has no surface to mesh", named.place())))
        }
    };
    shapes.iter().zip(&input.shapes).map(face).collect()
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

fn tessellation(options: &Mesh, shapes: &[Geometry]) -> TessellationOptions {
    let density = match (options.tolerance, options.resolution) {
        (_, Some(resolution)) => Density::Resolution(resolution),
        (Some(tolerance), _) => Density::Tolerance(tolerance),
        (None, None) => Density::Tolerance(DEFAULT_TOLERANCE * size(shapes)),
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

/// The diagonal of the box of all shapes; of those that control points do not bound, of their corners and middles.
fn size(shapes: &[Geometry]) -> f64 {
    let boxes = shapes.iter().filter_map(|shape| shape.control_box().or_else(|| sampled(shape)));
    boxes.reduce(|a: BoundingBox, b| a.union(&b)).map_or(0.0, |all| all.diagonal())
}

fn sampled(shape: &Geometry) -> Option<BoundingBox> {
    const STEPS: usize = 8;
    let surface = shape.as_surface()?;
    let at = |i: usize, j: usize| [i, j].map(|k| k as f64 / STEPS as f64);
    let parameters = (0..=STEPS).flat_map(|i| (0..=STEPS).map(move |j| at(i, j)));
    let points = parameters.filter_map(|[x, y]| {
        let [u, v] = match surface.domain() {
            SurfaceDomain::Rectangle([u, v]) => [u.at(x), v.at(y)],
            SurfaceDomain::Triangle => [x * (1.0 - y), y],
        };
        surface.try_point(u, v).ok()
    });
    BoundingBox::from_points(points)
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
