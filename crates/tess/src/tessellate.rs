use std::collections::HashSet;
use std::ops::ControlFlow;

use casteljau_geom::glam::{DVec2, DVec3};
use casteljau_mesh::{MeshSink, TriangleMesh};

use crate::draft::{Draft, Outline, Request};
use crate::measure::{cotangent, cotangent_2d};
use crate::model::{Model, fill_in_normals};
use crate::progress::{Progress, Tell};
use crate::report::Report;
use crate::sizing::{Probes, SizeField};
use crate::surface::{Surface, open};
use crate::topology::NONE;
use crate::{AsFace, Density, Seams, TessError, TessellationOptions};

/// Least tolerance in units of the largest coordinate: 64 roundings.
pub(crate) const LEAST_TOLERANCE: f64 = 32.0 * f64::EPSILON;
/// Samples of a patch: at first; then, if the mesh turns out to have more vertices than [`FEW`], an eighth as many as it has
/// vertices, at least and at most so many.
const PROBES: [usize; 3] = [48, 120, 1000];
/// Vertices that the first samples suffice for.
const FEW: f64 = 200.0;
/// An estimate of the number of vertices is refused beyond this many times the limit.
const DOUBT: f64 = 2.0;
/// Most growth of the triangles' size over a distance.
const GROWTH: f64 = 0.35;
/// The longest edges of triangles that are on the whole of size 1.
const LONGEST: f64 = 1.3;

/// Tessellates faces, patches of any kind, into one mesh; see the [crate's page](crate) for what it promises.
///
/// `progress` is told the fraction done, from 0 to 1, never going back, and stops the work by [`ControlFlow::Break`].
///
/// # Errors
/// No patch; a tolerance or resolution out of range; more vertices than allowed; a tolerance that was not reached; a
/// request to stop; a patch that cannot be evaluated or triangulated.
///
/// Cost on one thread: 1 to 3 µs a triangle from some 150 triangles a patch on; what coarser meshes and patches of hundreds of
/// control points take is in `benches/benches/tessellate.rs`.
///
/// ```
/// use casteljau_gb::{ConcavePatch, CoordinateKind, LayoutKind, Ribbon, glam::DVec3};
/// use casteljau_tess::{TessError, TessellationOptions, no_progress, tessellate};
/// use std::ops::ControlFlow;
///
/// let corners = [DVec3::X + DVec3::Y, DVec3::Y, DVec3::ZERO, DVec3::X];
/// let ribbon = |i: usize| Ribbon::new(1, 1, vec![corners[(i + 3) % 4], corners[i]]);
/// let ribbons = (0..4).map(ribbon).collect::<Result<Vec<_>, _>>()?;
/// let square = ConcavePatch::builder(ribbons)
///     .layout(LayoutKind::Regular)
///     .coordinates(CoordinateKind::MeanValue)
///     .build()?;
/// let (mesh, report) = tessellate(std::slice::from_ref(&square), &TessellationOptions::resolution(4), &mut no_progress)?;
/// assert!((mesh.area()? - 1.0).abs() < 1e-12);
/// assert_eq!(report.open_sides.len(), 4);
/// assert_eq!(mesh.audit()?.boundary_edges, 16);
///
/// let stopped = tessellate(&[square], &TessellationOptions::resolution(4), &mut |_| ControlFlow::Break(()));
/// assert!(matches!(stopped, Err(TessError::Cancelled { .. })));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn tessellate<F: AsFace>(
    faces: &[F],
    options: &TessellationOptions,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<(TriangleMesh, Report), TessError> {
    let mut mesh = TriangleMesh::default();
    let report = tessellate_into(faces, options, &mut mesh, progress)?;
    Ok((mesh, report))
}

/// As [`tessellate`], into a sink of the caller's. Vertices come first, patch by patch, then the triangles.
///
/// Nothing is pushed before all patches are meshed, so an error other than the sink's own leaves the sink as it was.
///
/// # Errors
/// As [`tessellate`], and whatever the sink refuses.
pub fn tessellate_into<F: AsFace>(
    faces: &[F],
    options: &TessellationOptions,
    sink: &mut dyn MeshSink,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Report, TessError> {
    let faces = faces.iter().enumerate();
    let surfaces: Vec<_> =
        faces.map(|(index, face)| open(face.as_face(), index)).collect::<Result<_, _>>()?;
    mesh_into(&surfaces, options, sink, progress)
}

fn mesh_into(
    surfaces: &[Box<dyn Surface + '_>],
    options: &TessellationOptions,
    sink: &mut dyn MeshSink,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Report, TessError> {
    let progress = Progress::new(progress);
    progress.tell(0.0)?;
    check(surfaces, options)?;
    let limit = options.max_vertices.min(u32::MAX as usize - 1);
    let merge = options.seams == Seams::Merged;
    let model = Model::new(surfaces, options.density, limit, merge)?;
    let mut report = Report::default();
    model.report(surfaces, &mut report);

    let mut all = Collected::new(&model, options.normals);
    let mut taken = model.side_edges();
    let tell = |fraction: f64| progress.tell(fraction);
    for (index, surface) in surfaces.iter().enumerate() {
        progress.part(index, surfaces.len());
        let outline = &model.outlines[index];
        let others = all.points.len() - outline.points.len().min(all.points.len());
        let request = Request {
            patch: index,
            tolerance: tolerance(options.density),
            normals: options.normals,
            room: limit.saturating_sub(others),
            limit,
            vertices: &model.vertices[index],
            taken: &taken,
        };

        let draft = fill(surface.as_ref(), outline, request, &tell)?;
        all.add(surface.as_ref(), &draft, &mut report);
        let chords = all.chords(&draft);
        taken.extend(chords);
    }
    progress.part(0, 1);
    progress.tell(1.0)?;
    all.push(sink, &mut report)?;
    Ok(report)
}

fn tolerance(density: Density) -> Option<f64> {
    match density {
        Density::Tolerance(tolerance) => Some(tolerance),
        Density::Resolution(_) => None,
    }
}

fn check(surfaces: &[Box<dyn Surface + '_>], options: &TessellationOptions) -> Result<(), TessError> {
    if surfaces.is_empty() {
        return Err(TessError::Empty);
    }
    let largest = surfaces.iter().map(|surface| surface.largest()).fold(0.0, f64::max);
    let least = LEAST_TOLERANCE * largest;
    match options.density {
        Density::Resolution(value @ 0) => Err(TessError::Resolution { value }),
        Density::Tolerance(value) if !(value >= least && value > 0.0 && value.is_finite()) => {
            Err(TessError::Tolerance { value, least })
        }
        _ => Ok(()),
    }
}

/// The mesh of one patch.
fn fill<'a>(
    surface: &'a dyn Surface,
    outline: &Outline,
    request: Request<'a>,
    tell: &'a Tell<'a>,
) -> Result<Draft<'a>, TessError> {
    let too_many = |needed: f64| TessError::TooManyVertices {
        patch: request.patch,
        needed: needed + (request.limit - request.room) as f64,
        limit: request.limit,
    };
    let beyond = |expected: f64| expected.is_nan() || expected > DOUBT * request.room as f64;
    let vertices = surface.domain().vertices();
    match request.tolerance {
        Some(tolerance) => {
            let mut probes = Probes::new(surface, request.patch, PROBES[0])?;
            let mut plane = probes.evened();
            let mut sizes = probes.sizes(plane, tolerance);
            let mut expected = plane.determinant() * probes.expected(&sizes);
            if beyond(expected) {
                return Err(too_many(expected));
            }
            if expected > FEW {
                let more = ((expected / 8.0) as usize).clamp(PROBES[1], PROBES[2]);
                probes = Probes::new(surface, request.patch, more)?;
                plane = probes.evened();
                sizes = probes.sizes(plane, tolerance);
                expected = plane.determinant() * probes.expected(&sizes);
            }
            let corners: Vec<DVec2> = vertices.iter().map(|&v| plane * v).collect();
            let extent = (plane * (vertices[0] - vertices[vertices.len() / 2])).length();
            let mut field = SizeField::new(&corners, probes.len(), extent);
            field.lower_all(&probes, plane, &sizes);
            field.spread(GROWTH);
            let size = |p: DVec2| field.at(p);
            let expected = expected + outline.points.len() as f64;
            let mut draft = Draft::new(surface, outline, request, plane, &size, expected, tell)?;
            draft.refine(tolerance)?;
            Ok(draft)
        }
        None => {
            let probes = Probes::new(surface, request.patch, PROBES[0])?;
            let plane = probes.evened();
            let corners: Vec<DVec2> = vertices.iter().map(|&v| plane * v).collect();
            let field = even_field(&corners, outline);
            let size = |p: DVec2| field.at(p);
            let sizes: Vec<f64> = probes.places().map(|p| field.at(plane * p)).collect();
            let expected = plane.determinant() * probes.expected(&sizes);
            if beyond(expected) {
                return Err(too_many(expected));
            }
            let expected = expected + outline.points.len() as f64;
            let mut draft = Draft::new(surface, outline, request, plane, &size, expected, tell)?;
            draft.finish_angles()?;
            Ok(draft)
        }
    }
}

/// Sizes between the spacings of the sides, each weighing with its distance to the power −2.
fn even_field(corners: &[DVec2], outline: &Outline) -> SizeField {
    let n = corners.len();
    let sides: Vec<(DVec2, DVec2, f64)> = (0..n)
        .map(|side| {
            let (a, b) = (corners[(side + n - 1) % n], corners[side]);
            let end = outline.starts.get(side + 1).copied().unwrap_or(outline.points.len());
            let edges = end.saturating_sub(outline.starts[side]).max(1);
            (a, b - a, (b - a).length() / edges as f64)
        })
        .collect();
    let mut field = SizeField::new(corners, 400, f64::INFINITY);
    field.set(|p| {
        let (mut weights, mut sum) = (0.0, 0.0);
        for &(a, along, spacing) in &sides {
            let t = ((p - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            let near = p.distance_squared(a + along * t) + 0.25 * spacing * spacing;
            weights += 1.0 / near;
            sum += spacing / near;
        }
        LONGEST * sum / weights
    });
    field
}

/// The meshes of all patches, put together.
struct Collected<'a> {
    model: &'a Model,
    points: Vec<DVec3>,
    /// Empty where none are wanted.
    normals: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// The mesh's vertex for each of the model's, `u32::MAX` before it was met.
    known: Vec<u32>,
    with_normals: bool,
}

impl<'a> Collected<'a> {
    fn new(model: &'a Model, with_normals: bool) -> Self {
        let known = vec![NONE; model.count];
        let (points, normals, triangles) = (Vec::new(), Vec::new(), Vec::new());
        Self { model, points, normals, triangles, known, with_normals }
    }

    fn add(&mut self, surface: &dyn Surface, draft: &Draft<'_>, report: &mut Report) {
        let numbers = &self.model.vertices[draft.request.patch];
        let mut places = Vec::with_capacity(draft.points.len());
        let mut counted: HashSet<u32> = HashSet::new();
        for (v, (&point, &normal)) in draft.points.iter().zip(&draft.normals).enumerate() {
            let place = match numbers.get(v) {
                Some(&number) if self.known[number as usize] != NONE => {
                    let place = self.known[number as usize];
                    // A patch that meets itself counts once.
                    if self.with_normals && counted.insert(number) {
                        self.normals[place as usize] += normal;
                    }
                    places.push(place);
                    continue;
                }
                Some(&number) => {
                    self.known[number as usize] = self.points.len() as u32;
                    counted.insert(number);
                    self.points.len() as u32
                }
                None => self.points.len() as u32,
            };
            self.points.push(point);
            if self.with_normals {
                self.normals.push(normal);
            }
            places.push(place);
        }
        let clockwise = surface.clockwise();
        let even: Vec<DVec2> = draft.plane.iter().map(|&p| draft.back * p).collect();
        for (t, &corners) in draft.topology.triangles.iter().enumerate() {
            let mut mapped = corners.map(|v| places[v as usize]);
            if mapped[0] == mapped[1] || mapped[1] == mapped[2] || mapped[2] == mapped[0] {
                continue;
            }
            if clockwise {
                mapped.swap(1, 2);
            }
            self.triangles.push(mapped);
            let touches = draft.at_boundary(t as u32);
            let [a, b, c] = draft.corners(t as u32);
            report.space.count(cotangent(a, b, c), touches);
            let [a, b, c] = corners.map(|v| even[v as usize]);
            report.domain.count(cotangent_2d(a, b, c), touches);
        }
        if draft.request.tolerance.is_some() {
            report.chord_error = Some(report.chord_error.unwrap_or(0.0).max(draft.chord_error));
        }
    }

    /// Inner edges between two vertices of the outline, by the model's numbers.
    fn chords(&self, draft: &Draft<'_>) -> Vec<[u32; 2]> {
        let numbers = &self.model.vertices[draft.request.patch];
        let mut chords = Vec::new();
        for (t, corners) in draft.topology.triangles.iter().enumerate() {
            for k in 0..3 {
                let (a, b) = (corners[(k + 1) % 3] as usize, corners[(k + 2) % 3] as usize);
                if a < b
                    && draft.topology.across[t][k] != NONE
                    && let (Some(&a), Some(&b)) = (numbers.get(a), numbers.get(b))
                {
                    chords.push([a.min(b), a.max(b)]);
                }
            }
        }
        chords
    }

    fn push(mut self, sink: &mut dyn MeshSink, report: &mut Report) -> Result<(), TessError> {
        // Sums of several patches' normals that nearly cancel say nothing.
        for normal in &mut self.normals {
            let length = normal.length();
            *normal = if length > 1e-6 { *normal / length } else { DVec3::ZERO };
        }
        if self.with_normals {
            report.without_normal = fill_in_normals(&mut self.normals, &self.points, &self.triangles);
        }
        let mut indices = Vec::with_capacity(self.points.len());
        for (v, &point) in self.points.iter().enumerate() {
            indices.push(sink.vertex(point, self.normals.get(v).copied())?);
        }
        for corners in &self.triangles {
            sink.triangle(corners.map(|v| indices[v as usize]))?;
        }
        (report.vertices, report.triangles) = (self.points.len(), self.triangles.len());
        Ok(())
    }
}
