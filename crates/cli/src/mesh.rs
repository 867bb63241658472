//! `casteljau mesh`: from a model to a mesh file: a surface, a slice, or cells.

use std::ops::ControlFlow;

use casteljau::geom::BoundingBox;
use casteljau::geom::glam::DVec3;
use casteljau::io::model::NamedShape;
use casteljau::io::{Geometry, MeshFormat, obj, off, ply, stl, vtu_mesh};
use casteljau::mesh::TriangleMesh;
use casteljau::shape::SurfaceDomain;
use casteljau::tess::{
    AsFace, CellKind, Density, Face, Quality, Seams, SectionOptions, SharedFaces, Skin, Solid,
    TessellationOptions, VolumeOptions, slice, tessellate, volume_mesh,
};
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
    /// Counted by the mesher of patches.
    #[serde(skip_serializing_if = "Option::is_none")]
    interior_below_19: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    boundary_below_10: Option<usize>,
    area: f64,
    volume: Option<f64>,
    /// Pairs of faces between solids that were left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    shared_faces: Option<usize>,
    /// Faces of solids that are a point or a curve.
    #[serde(skip_serializing_if = "Option::is_none")]
    collapsed_faces: Option<usize>,
    /// Closed loops of a slice.
    #[serde(skip_serializing_if = "Option::is_none")]
    outlines: Option<usize>,
}

/// A mesh, and what is known of how it was made.
struct Made {
    mesh: TriangleMesh,
    chord_error: Option<f64>,
    space: Option<Quality>,
    shared_faces: Option<usize>,
    collapsed_faces: Option<usize>,
    outlines: Option<usize>,
}

pub fn run(options: &Mesh, json: bool) -> Result<(), Failure> {
    if let Some(tolerance) = options.tolerance.filter(|x| !(x.is_finite() && *x > 0.0)) {
        return Err(Failure::Usage(format!("--tolerance must be a number above 0, not {tolerance}")));
    }
    if options.resolution == Some(0) {
        return Err(Failure::Usage("--resolution must be 1 or more".into()));
    }
    let format = match is_dash(&options.output) || options.volume {
        true => named(options.format),
        false => MeshFormat::of_path(&options.output)?,
    };
    let ending = options.output.extension().and_then(|ending| ending.to_str());
    if options.volume && !is_dash(&options.output) && ending != Some("vtu") {
        return Err(Failure::Usage("--volume writes .vtu".into()));
    }
    let input = Input::read(&options.selection)?;
    let shapes = input.shapes.iter().map(|(_, named)| input.geometry(named));
    let shapes = shapes.collect::<Result<Vec<_>, _>>()?;
    if shapes.iter().all(|shape| shape.as_curve().is_some()) {
        let density = density(options, &shapes);
        let TessellationOptions { max_vertices, .. } = tessellation(options, density);
        return polylines::run(options, &input, &shapes, (density, max_vertices), format, json);
    }
    let density = density(options, &shapes);
    let mut progress = Progress::new("meshing");
    let mut told = |fraction| progress.tell(fraction);
    let made = match &options.slice {
        _ if options.volume => return cells(options, &input, &shapes, density, json),
        Some(plane) => sliced(options, &input, &shapes, plane, density, &mut told),
        None => surface(options, &input, &shapes, density, &mut told),
    };
    drop(progress);
    let Made { mesh, chord_error, space, shared_faces, collapsed_faces, outlines } = made?;

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
        tolerance: tolerance(density),
        chord_error,
        closed,
        boundary_edges: audit.boundary_edges,
        min_angle: audit.min_angle.map(f64::to_degrees),
        interior_below_19: space.map(|quality| quality.interior_below_19),
        boundary_below_10: space.map(|quality| quality.boundary_below_10),
        area: mesh.area()?,
        volume: volume(&mesh, closed)?,
        shared_faces,
        collapsed_faces,
        outlines,
    };
    if json {
        lines.json(&report)?
    } else {
        text(&report, &mut lines)?
    }
    lines.finish()
}

/// The surface of all shapes: surfaces as they are, of solids their faces but for those between neighbours.
fn surface(
    options: &Mesh,
    input: &Input,
    shapes: &[Geometry],
    density: Density,
    told: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Made, Failure> {
    let wrong = |error| Failure::Bad(format!("{}: {error}", input.name));
    let solids: Vec<Solid<'_>> = shapes.iter().filter_map(solid).collect();
    let skin = Skin::new(&solids, SharedFaces::Dropped).map_err(wrong)?;
    let tessellation = tessellation(options, density);
    let (mesh, report) = if solids.len() == shapes.len() {
        let mut mesh = TriangleMesh::default();
        let report = skin.tessellate_into(&tessellation, &mut mesh, told).map_err(wrong)?;
        (mesh, report)
    } else {
        let mut faces = faces(input, shapes)?;
        faces.extend(skin.faces().iter().map(AsFace::as_face));
        tessellate(&faces, &tessellation, told).map_err(wrong)?
    };
    let of_solids = |count: usize| (!solids.is_empty()).then_some(count);
    Ok(Made {
        mesh,
        chord_error: report.chord_error,
        space: Some(report.space),
        shared_faces: of_solids(skin.shared().len()),
        collapsed_faces: of_solids(skin.collapsed().len()),
        outlines: None,
    })
}

/// The slice of all solids by a plane.
fn sliced(
    options: &Mesh,
    input: &Input,
    shapes: &[Geometry],
    plane: &[f64],
    density: Density,
    told: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Made, Failure> {
    let wrong = |error| Failure::Bad(format!("{}: {error}", input.name));
    let (&[a, b, c, d], Density::Tolerance(tolerance)) = (plane, density) else {
        return Err(Failure::Usage("--slice takes four numbers, A,B,C,D, and no --resolution".into()));
    };
    let solids = only_solids(input, shapes)?;
    let section = SectionOptions { normals: options.normals, ..SectionOptions::tolerance(tolerance) };
    let section = match options.max_vertices {
        Some(max_vertices) => SectionOptions { max_vertices, ..section },
        None => section,
    };
    let (mesh, report) = slice(&solids, DVec3::new(a, b, c), d, &section, told).map_err(wrong)?;
    let outlines = mesh.boundary_loops()?.len();
    Ok(Made {
        mesh,
        chord_error: Some(report.chord_error),
        space: None,
        shared_faces: None,
        collapsed_faces: None,
        outlines: Some(outlines),
    })
}

/// What was written of cells.
#[derive(Serialize)]
struct CellReport {
    output: String,
    shapes: usize,
    vertices: usize,
    tetrahedra: usize,
    pyramids: usize,
    wedges: usize,
    hexahedra: usize,
    tolerance: Option<f64>,
    chord_error: Option<f64>,
    conforming: bool,
    not_positive: usize,
    volume: f64,
}

/// Cells that fill all solids.
fn cells(
    options: &Mesh,
    input: &Input,
    shapes: &[Geometry],
    density: Density,
    json: bool,
) -> Result<(), Failure> {
    let solids = only_solids(input, shapes)?;
    let kind = if options.tetrahedra { CellKind::Tetrahedra } else { CellKind::Own };
    let volume = VolumeOptions { cells: kind, ..VolumeOptions::new(density) };
    let volume = match options.max_vertices {
        Some(max_vertices) => VolumeOptions { max_vertices, ..volume },
        None => volume,
    };
    let mut progress = Progress::new("meshing");
    let (mesh, report) = volume_mesh(&solids, &volume, &mut |fraction| progress.tell(fraction))
        .map_err(|error| Failure::Bad(format!("{}: {error}", input.name)))?;
    drop(progress);
    let audit = mesh.audit()?;
    write(&options.output, |out| vtu_mesh::write(&mesh, out))?;
    if is_dash(&options.output) {
        return Ok(());
    }
    let [tetrahedra, pyramids, wedges, hexahedra] = audit.cells;
    let report = CellReport {
        output: options.output.display().to_string(),
        shapes: shapes.len(),
        vertices: mesh.positions.len(),
        tetrahedra,
        pyramids,
        wedges,
        hexahedra,
        tolerance: tolerance(density),
        chord_error: report.chord_error,
        conforming: audit.is_valid(),
        not_positive: report.not_positive,
        volume: mesh.volume()?,
    };
    let mut lines = Lines::new();
    if json {
        lines.json(&report)?;
    } else {
        lines.text(&format!(
            "{}: {} vertices, {tetrahedra} tetrahedra, {pyramids} pyramids, {wedges} wedges, {hexahedra} hexahedra",
            report.output, report.vertices
        ))?;
        if let (Some(tolerance), Some(error)) = (report.tolerance, report.chord_error) {
            lines.text(&format!("  chord error  {} (tolerance {})", brief(error), brief(tolerance)))?;
        }
        lines.text(&format!("  volume       {}", human(report.volume)))?;
        match report.conforming {
            true => lines.text("  conforming, all cells of positive volume")?,
            false => lines.text(&format!("  {} cells of no positive volume", report.not_positive))?,
        }
    }
    lines.finish()
}

/// The solids, where there is nothing else.
fn only_solids<'g>(input: &Input, shapes: &'g [Geometry]) -> Result<Vec<Solid<'g>>, Failure> {
    let each = shapes.iter().zip(&input.shapes).map(|(shape, (_, named))| {
        solid(shape).ok_or_else(|| {
            let kind = named.shape.kind();
            Failure::Bad(format!("{}: a shape of kind `{kind}` is no solid", named.place()))
        })
    });
    each.collect()
}

fn solid(shape: &Geometry) -> Option<Solid<'_>> {
    Some(match shape {
        Geometry::Hexahedron(solid) => solid.into(),
        Geometry::RationalHexahedron(solid) => solid.into(),
        Geometry::Tetrahedron(solid) => solid.into(),
        Geometry::RationalTetrahedron(solid) => solid.into(),
        Geometry::Wedge(solid) => solid.into(),
        Geometry::RationalWedge(solid) => solid.into(),
        Geometry::Constructed(solid) => solid.as_ref().into(),
        _ => return None,
    })
}

/// The surfaces as the mesher takes them.
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
    let surfaces = shapes.iter().zip(&input.shapes).filter(|(shape, _)| solid(shape).is_none());
    surfaces.map(face).collect()
}

fn tolerance(density: Density) -> Option<f64> {
    match density {
        Density::Tolerance(tolerance) => Some(tolerance),
        Density::Resolution(_) => None,
    }
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

fn density(options: &Mesh, shapes: &[Geometry]) -> Density {
    match (options.tolerance, options.resolution) {
        (_, Some(resolution)) => Density::Resolution(resolution),
        (Some(tolerance), _) => Density::Tolerance(tolerance),
        (None, None) => Density::Tolerance(DEFAULT_TOLERANCE * size(shapes)),
    }
}

fn tessellation(options: &Mesh, density: Density) -> TessellationOptions {
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
    match (report.interior_below_19, report.boundary_below_10) {
        (Some(inner), Some(outer)) => lines
            .text(&format!("  least angle  {angle}°; {inner} inner below 19°, {outer} at sides below 10°"))?,
        _ => lines.text(&format!("  least angle  {angle}°"))?,
    }
    lines.text(&format!("  area         {}", human(report.area)))?;
    if let Some(shared @ 1..) = report.shared_faces {
        lines.text(&format!("  left out     {shared} pairs of faces between solids"))?;
    }
    if let Some(outlines) = report.outlines {
        return lines.text(&format!("  outlines     {outlines}"));
    }
    match report.closed {
        true => lines.text(&format!("  volume       {}, closed", optional(report.volume))),
        false => lines.text(&format!("  volume       none, open: {} boundary edges", report.boundary_edges)),
    }
}
