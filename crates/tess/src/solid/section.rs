//! Slices of solids by a plane, and iso-surfaces of fields over them.

use std::ops::ControlFlow;

use casteljau_geom::glam::DVec3;
use casteljau_mesh::TriangleMesh;
use casteljau_solid::SolidDomain;

use super::bends::Bends;
use super::complex::Complex;
use super::field::{Level, SolidField};
use super::march::{March, Surface};
use super::section_error::Gauge;
use super::unfold::unfold;
use super::volume::{MOST_COUNT, check_density, choose_counts};
use super::{AsSolid, Solid};
use crate::model::fill_in_normals;
use crate::progress::Progress;
use crate::{DEFAULT_MAX_VERTICES, Density, TessError};

/// Fewest steps along an edge: with one, two poles could be joined by an edge that belongs to no face.
const LEAST_COUNT: u32 = 2;
/// Times that counts are doubled where the measured error is above the tolerance.
const DOUBLINGS: usize = 7;

/// How to find a slice or an iso-surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionOptions {
    /// Chord tolerance, in model units.
    pub tolerance: f64,
    /// Most vertices of the mesh; beyond it is an error. [`DEFAULT_MAX_VERTICES`] by default. So is looking at eight times as many
    /// places of the lattice (and at least four million), as where a field all but has the value in a part of the solid.
    pub max_vertices: usize,
    /// Whether vertices get normals.
    pub normals: bool,
}

impl SectionOptions {
    /// The defaults at a chord tolerance, in model units.
    pub fn tolerance(tolerance: f64) -> Self {
        Self { tolerance, max_vertices: DEFAULT_MAX_VERTICES, normals: true }
    }
}

/// What a slice or an iso-surface reached.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct SectionReport {
    /// The largest distance, in model units, that was measured between the surface and the mesh: at the middles of edges and at
    /// centroids, and along the outline on the solids' faces.
    pub chord_error: f64,
    /// For each solid the steps of its lattice, as for a [`VolumeReport`](crate::VolumeReport).
    pub counts: Vec<[u32; 3]>,
    /// For each vertex a solid that it lies in, and its parameters there. Some vertices inside a slice are moved within the plane
    /// afterwards, by less than a cell of the lattice, and keep those of where they were.
    pub origins: Vec<(usize, [f64; 3])>,
}

/// The slice of solids by the plane `n·x = d`, as a mesh of triangles in the plane with the normal n.
///
/// The outline of the slice of one solid, or of several that share faces to the bit, is made of closed loops,
/// [`TriangleMesh::boundary_loops`]; its vertices lie on the solids' faces and on the plane, within 8u(|d|/|n| + |p|) of it. The outline's
/// edges are within the tolerance of it, as measured at their middles.
///
/// **Method.** The solids' lattices ([`volume_mesh`](crate::volume_mesh)) are so fine that the map which is linear on their
/// tetrahedra is within the tolerance of the solids; their edges that pass through the plane do so where the root of a
/// polynomial along them is, and every tetrahedron has one or two triangles. So what is missed between the places of the lattice
/// reaches beyond the plane by no more than the tolerance. Where an outline is farther from its edges than that, as where the plane
/// grazes a face, the lattice is doubled. Triangles that come out turned over, as lattice lines between an edge of the outline and its
/// arc make them, are mended by flips and moves within the plane; where the plane runs along an edge of a solid a few may be left, all of them
/// within the tolerance of the outline.
///
/// **Half-open.** A place on the plane counts as above it. So a plane through a face has that face where the solid lies below,
/// and nothing where it lies above: of two solids on each other it has the face between them once. Where the plane only touches an
/// edge or a corner there is nothing.
///
/// ```
/// use casteljau_solid::Hexahedron;
/// use casteljau_tess::{SectionOptions, no_progress, slice, geom::glam::DVec3};
/// // A cube across its diagonal: a hexagon.
/// let options = SectionOptions::tolerance(1e-3);
/// let (mesh, _) = slice(&[Hexahedron::unit_cube()], DVec3::ONE, 1.5, &options, &mut no_progress)?;
/// assert_eq!(mesh.boundary_loops()?.len(), 1);
/// assert!((mesh.area()? - 0.75 * 3f64.sqrt()).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// No solid; [`TessError::Plane`]; a tolerance out of range; more vertices than allowed; [`TessError::SolidPole`];
/// [`TessError::FlatSolid`]; [`TessError::SectionMissed`]; a request to stop.
pub fn slice<S: AsSolid>(
    solids: &[S],
    normal: DVec3,
    offset: f64,
    options: &SectionOptions,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<(TriangleMesh, SectionReport), TessError> {
    let size = normal.abs().max_element();
    let scaled = normal / size;
    let length = scaled.length();
    let (unit, distance) = (scaled / length, offset / size / length);
    if !(size > 0.0 && unit.is_finite() && distance.is_finite()) {
        return Err(TessError::Plane { normal, offset });
    }
    let solids: Vec<Solid<'_>> = solids.iter().map(AsSolid::as_solid).collect();
    let complex = Complex::new(&solids)?;
    let plane = unit.extend(-distance);
    let levels: Vec<Level> = (0..complex.len()).map(|s| Level::of_plane(complex.net(s), plane)).collect();
    let pull = |p: DVec3| p - unit * (p.dot(unit) - distance);
    let request = Request { complex: &complex, levels: &levels, options, flat: true };
    let (mut surface, mut report) = request.find(&pull, &Progress::new(progress))?;
    unfold(&mut surface.triangles, &mut surface.points, unit, &pull);
    report.origins = origins(&solids, &complex, &surface);
    let normals = if options.normals { vec![unit; surface.points.len()] } else { Vec::new() };
    Ok((TriangleMesh { positions: surface.points, normals, triangles: surface.triangles }, report))
}

/// The surface in solids on which a field has a value, its normals along the rising field.
///
/// There is one field a solid, over the same kind of domain. On faces that solids share their fields should agree; the surface
/// is without gaps there even where they do not. It ends on the solids' faces. Triangles are within the tolerance, as measured at the
/// middles of edges and at centroids; the search is that of [`slice()`], and places at which the field has the value count as above it. A
/// part of the surface that passes between the places of the lattice unseen is missed; all places at which the field is lower on the
/// one side and higher on the other, farther apart than a step of the lattice, are seen.
///
/// ```
/// use casteljau_solid::Hexahedron;
/// use casteljau_tess::{SectionOptions, SolidField, iso_surface, no_progress};
/// // x² + y² in a cube: coefficients 0, 0, 1 along either.
/// let square = [0.0, 0.0, 1.0];
/// let field = SolidField::hexahedron([2, 2, 0], (0..9).map(|i| square[i / 3] + square[i % 3]).collect::<Vec<_>>())?;
/// let options = SectionOptions::tolerance(1e-3);
/// let (mesh, report) = iso_surface(&[Hexahedron::unit_cube()], &[field], 0.25, &options, &mut no_progress)?;
/// assert!(report.chord_error <= 1e-3);
/// assert!((mesh.area()? - 0.25 * std::f64::consts::PI).abs() < 2e-3); // a quarter of a cylinder
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of [`slice()`]; [`TessError::Field`] for a number of fields that is not that of the solids, or a value that is not finite;
/// [`TessError::FieldKind`].
pub fn iso_surface<S: AsSolid>(
    solids: &[S],
    fields: &[SolidField],
    value: f64,
    options: &SectionOptions,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<(TriangleMesh, SectionReport), TessError> {
    if fields.len() != solids.len() {
        return Err(TessError::Field { what: "number of fields", value: fields.len() as f64 });
    }
    if !value.is_finite() {
        return Err(TessError::Field { what: "value", value });
    }
    let solids: Vec<Solid<'_>> = solids.iter().map(AsSolid::as_solid).collect();
    let complex = Complex::new(&solids)?;
    for (solid, field) in fields.iter().enumerate() {
        let (own, of_field) = (complex.degrees(solid), field.degrees);
        if std::mem::discriminant(&own) != std::mem::discriminant(&of_field) {
            return Err(TessError::FieldKind { solid });
        }
    }
    let levels: Vec<Level> = fields.iter().map(|field| Level::of_field(field, value)).collect();
    let request = Request { complex: &complex, levels: &levels, options, flat: false };
    let (surface, mut report) = request.find(&|p| p, &Progress::new(progress))?;
    report.origins = origins(&solids, &complex, &surface);
    let mut mesh = TriangleMesh { triangles: surface.triangles, ..TriangleMesh::default() };
    if options.normals {
        let rising = |&(solid, local): &(usize, [f64; 4])| {
            let level = &levels[solid];
            let [_, a, b, c] = level.degrees.partials(&level.coefficients, local);
            let [_, u, v, w] = complex.net(solid).jet(local);
            // The gradient times the Jacobian, which is zero where there is none.
            let rising = v.cross(w) * a + w.cross(u) * b + u.cross(v) * c;
            let rising = if u.dot(v.cross(w)) < 0.0 { -rising } else { rising };
            // Scaled first: squares of small numbers vanish.
            (rising / rising.abs().max_element()).try_normalize().unwrap_or(DVec3::ZERO)
        };
        mesh.normals = surface.origins.iter().map(rising).collect();
        fill_in_normals(&mut mesh.normals, &surface.points, &mesh.triangles);
    }
    mesh.positions = surface.points;
    Ok((mesh, report))
}

/// Parameters of the solids themselves.
fn origins(solids: &[Solid<'_>], complex: &Complex, surface: &Surface) -> Vec<(usize, [f64; 3])> {
    let own = |&(solid, local): &(usize, [f64; 4])| {
        let at = complex.degrees(solid).parameters(local);
        let at = match solids[solid].parametric().domain() {
            SolidDomain::Box(intervals) => std::array::from_fn(|a| intervals[a].at(at[a])),
            SolidDomain::Tetrahedron => at,
            SolidDomain::Wedge(height) => [at[0], at[1], height.at(at[2])],
        };
        (solid, at)
    };
    surface.origins.iter().map(own).collect()
}

struct Request<'a> {
    complex: &'a Complex,
    levels: &'a [Level],
    options: &'a SectionOptions,
    /// The triangles lie on the surface; only their outline can be off.
    flat: bool,
}

impl Request<'_> {
    fn find(
        &self,
        pull: &dyn Fn(DVec3) -> DVec3,
        progress: &Progress<'_>,
    ) -> Result<(Surface, SectionReport), TessError> {
        progress.tell(0.0)?;
        let SectionOptions { tolerance, max_vertices, .. } = *self.options;
        let density = Density::Tolerance(tolerance);
        check_density(self.complex, density)?;
        let total = self.complex.len();
        let bends = (0..total).map(|solid| Bends::new(self.complex.net(solid), solid));
        let bends = bends.collect::<Result<Vec<_>, _>>()?;
        let mut counts = choose_counts(self.complex, &bends, density, LEAST_COUNT)?;
        let gauge = Gauge { complex: self.complex, levels: self.levels, outline_only: self.flat };
        for round in 0.. {
            let march = March {
                complex: self.complex,
                levels: self.levels,
                counts: &counts,
                limit: max_vertices.min(u32::MAX as usize - 1),
                pull,
                gauge: &gauge,
            };
            let surface = march.run(progress)?;
            let (solid, reached) = surface
                .errors
                .iter()
                .copied()
                .enumerate()
                .max_by(|a, b| a.1.total_cmp(&b.1))
                .unwrap_or((0, 0.0));
            if reached <= tolerance {
                progress.part(0, 1);
                progress.tell(1.0)?;
                let report = SectionReport {
                    chord_error: reached,
                    counts: (0..total).map(|s| self.complex.shown_counts(s, &counts)).collect(),
                    origins: Vec::new(),
                };
                return Ok((surface, report));
            }
            let mut finer = counts.clone();
            for (solid, _) in surface.errors.iter().enumerate().filter(|(_, error)| **error > tolerance) {
                for group in self.complex.groups(solid) {
                    finer[group] = 2 * counts[group];
                }
            }
            if round == DOUBLINGS || finer.iter().any(|&n| n > MOST_COUNT) {
                let vertices = surface.points.len();
                return Err(TessError::SectionMissed { solid, tolerance, reached, vertices });
            }
            counts = finer;
        }
        Err(TessError::Empty)
    }
}
