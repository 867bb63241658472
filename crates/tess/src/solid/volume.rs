//! Cells that fill solids.

use std::collections::HashMap;
use std::ops::ControlFlow;

use casteljau_geom::glam::DVec3;
use casteljau_mesh::{Cell, VolumeMesh};

use super::bends::Bends;
use super::complex::{Complex, Place};
use super::lattice::LatticeCell;
use super::{AsSolid, Solid};
use crate::progress::Progress;
use crate::{DEFAULT_MAX_VERTICES, Density, TessError};

/// Most edges along one side of a solid.
pub(crate) const MOST_COUNT: u32 = 1 << 20;
/// Times that counts are doubled where cells are not of positive volume.
const DOUBLINGS: usize = 3;
/// Places between two reports of progress.
const REPORT: usize = 4096;

/// Which cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum CellKind {
    /// Those of the kind of each solid: hexahedra, tetrahedra, wedges; pyramids and lower ones where a face or an edge is a point.
    #[default]
    Own,
    /// Tetrahedra only.
    Tetrahedra,
}

/// How to fill solids with cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VolumeOptions {
    /// Chord tolerance, or edges along every edge of the solids.
    pub density: Density,
    /// Most vertices of the mesh; beyond it is an error. [`DEFAULT_MAX_VERTICES`] by default.
    pub max_vertices: usize,
    /// Which cells.
    pub cells: CellKind,
}

impl VolumeOptions {
    /// A mesh within a chord tolerance, in model units: at equal parameters the solid and the map that is linear on the tetrahedra or
    /// trilinear on the hexahedra are no farther apart.
    pub fn tolerance(tolerance: f64) -> Self {
        Self::new(Density::Tolerance(tolerance))
    }

    /// A mesh with so many cells along every edge.
    pub fn resolution(resolution: usize) -> Self {
        Self::new(Density::Resolution(resolution))
    }

    /// The defaults at a density.
    pub fn new(density: Density) -> Self {
        Self { density, max_vertices: DEFAULT_MAX_VERTICES, cells: CellKind::default() }
    }
}

/// What a volume mesh reached.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct VolumeReport {
    /// A bound on the distance between solids and cells at equal parameters, in model units; `None` by resolution.
    pub chord_error: Option<f64>,
    /// For each solid its cells along u, v and w; along the edges of a tetrahedron; or along those of the triangle and of the
    /// height of a wedge.
    pub counts: Vec<[u32; 3]>,
    /// Cells of no positive volume, after counts were doubled up to three times where a tolerance was asked for: the solid is folded
    /// or flat there, or needs a finer mesh.
    pub not_positive: usize,
    /// Cells of the lattice that were left out, as their edges or faces are points and nothing is between the others.
    pub dropped: usize,
}

/// Fills solids with cells that conform, across solids too: faces and edges are shared where their nets are the same to
/// the bit, as for [`Skin`](crate::Skin), and have the same vertices.
///
/// Each domain is divided evenly, a hexahedron into boxes, a tetrahedron into n³ tetrahedra, a wedge into n² triangles times
/// steps of the height; with [`CellKind::Tetrahedra`] boxes and wedges are cut as by [`Cell::tetrahedra`]. Cells are right
/// side out also where a solid is turned inside out.
///
/// **Counts.** With a tolerance every solid asks for the counts that keep `⅛ ΣΣ M_ab h_a h_b` below it, M_ab bounding the second
/// derivatives by their control nets (over 64 parts of the domain; for rational solids by those of the quotient's) and h being the steps:
/// a bound, not a measurement. Edges that lie across from each other in a solid must be divided alike, and so must edges
/// that solids share, so counts spread through a model; the largest one asked for is taken.
///
/// Cost: some 1.5 µs a cell, besides 5 to 30 ms a solid for the bounds of a rational one; see `benches/benches/solids.rs`.
///
/// ```
/// use casteljau_solid::{Axis, Hexahedron};
/// use casteljau_tess::{CellKind, VolumeOptions, no_progress, volume_mesh};
/// let (left, right) = Hexahedron::unit_cube().split(Axis::U, 0.25)?;
/// let options = VolumeOptions { cells: CellKind::Tetrahedra, ..VolumeOptions::resolution(2) };
/// let (mesh, _) = volume_mesh(&[left, right], &options, &mut no_progress)?;
/// assert_eq!((mesh.positions.len(), mesh.cells.len()), (5 * 3 * 3, 2 * 8 * 6));
/// assert!(mesh.audit()?.is_valid());
/// assert!((mesh.volume()? - 1.0).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// No solid; a tolerance or resolution out of range; more vertices than allowed; [`TessError::SolidPole`];
/// [`TessError::FlatSolid`]; a request to stop.
pub fn volume_mesh<S: AsSolid>(
    solids: &[S],
    options: &VolumeOptions,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<(VolumeMesh, VolumeReport), TessError> {
    let progress = Progress::new(progress);
    progress.tell(0.0)?;
    let solids: Vec<Solid<'_>> = solids.iter().map(AsSolid::as_solid).collect();
    let complex = Complex::new(&solids)?;
    check_density(&complex, options.density)?;
    let bends = (0..complex.len()).map(|solid| Bends::new(complex.net(solid), solid));
    let bends = bends.collect::<Result<Vec<_>, _>>()?;
    let mut counts = choose_counts(&complex, &bends, options.density, 1)?;
    check_size(&complex, &counts, options.max_vertices)?;
    let mut doublings = 0;
    loop {
        let (mesh, mut report) = fill(&complex, &counts, options, &progress)?;
        report.not_positive = mesh.not_positive();
        let by_tolerance = matches!(options.density, Density::Tolerance(_));
        if report.not_positive > 0 && by_tolerance && doublings < DOUBLINGS {
            let finer: Vec<u32> = counts.iter().map(|n| 2 * n).collect();
            if check_size(&complex, &finer, options.max_vertices).is_ok() {
                doublings += 1;
                counts = finer;
                continue;
            }
        }
        if by_tolerance {
            let error =
                |(solid, bends): (usize, &Bends)| bends.chord_error(complex.counts_of(solid, &counts));
            report.chord_error = Some(bends.iter().enumerate().map(error).fold(0.0, f64::max));
        }
        progress.tell(1.0)?;
        return Ok((mesh, report));
    }
}

/// Refuses no solids, and a density out of range.
pub(crate) fn check_density(complex: &Complex, density: Density) -> Result<(), TessError> {
    if complex.len() == 0 {
        return Err(TessError::Empty);
    }
    let least = complex.largest() * crate::tessellate::LEAST_TOLERANCE;
    match density {
        Density::Resolution(value @ 0) => Err(TessError::Resolution { value }),
        Density::Tolerance(value) if !(value >= least && value > 0.0 && value.is_finite()) => {
            Err(TessError::Tolerance { value, least })
        }
        _ => Ok(()),
    }
}

/// The largest counts that any solid asks for, none below `least`.
pub(crate) fn choose_counts(
    complex: &Complex,
    bends: &[Bends],
    density: Density,
    least: u32,
) -> Result<Vec<u32>, TessError> {
    let mut counts = vec![least; complex.counts];
    for (solid, bends) in bends.iter().enumerate() {
        let limit = MOST_COUNT as usize;
        let too_many = |needed: f64| TessError::TooManySolidVertices { solid, needed, limit };
        let asked = match density {
            Density::Resolution(n) => match u32::try_from(n) {
                Ok(n) if n <= MOST_COUNT => [n; 3],
                _ => return Err(too_many(n as f64)),
            },
            Density::Tolerance(tolerance) => {
                bends.counts(tolerance, MOST_COUNT).ok_or_else(|| too_many(f64::from(MOST_COUNT)))?
            }
        };
        for (group, asked) in complex.groups(solid).into_iter().zip(asked) {
            counts[group] = counts[group].max(asked);
        }
    }
    Ok(counts)
}

/// Refuses more vertices than allowed, before anything is allocated for them.
fn check_size(complex: &Complex, counts: &[u32], limit: usize) -> Result<(), TessError> {
    let limit = limit.min(u32::MAX as usize - 1);
    let mut needed = 0.0;
    for solid in 0..complex.len() {
        let counts = complex.counts_of(solid, counts);
        needed += complex.degrees(solid).expected_places(counts);
        // Those on shared faces are counted twice; they are the lesser part of a mesh that is too large.
        if needed > 1.5 * limit as f64 || counts.iter().any(|&n| n > MOST_COUNT) {
            return Err(TessError::TooManySolidVertices { solid, needed, limit });
        }
    }
    Ok(())
}

/// Vertices and cells for these counts.
fn fill(
    complex: &Complex,
    counts: &[u32],
    options: &VolumeOptions,
    progress: &Progress<'_>,
) -> Result<(VolumeMesh, VolumeReport), TessError> {
    let mut vertices = Vertices::default();
    let shown = (0..complex.len()).map(|solid| complex.shown_counts(solid, counts)).collect();
    let mut report = VolumeReport { counts: shown, ..VolumeReport::default() };
    let mut numbers: Vec<Vec<u32>> = Vec::new();
    let total = complex.len();
    for solid in 0..total {
        progress.part(solid, total);
        let counts = complex.counts_of(solid, counts);
        let degrees = complex.degrees(solid);
        let all = degrees.places(counts);
        let mut own = vec![0; all];
        let mut done = 0;
        degrees.each_place(counts, |at| {
            done += 1;
            if done % REPORT == 0 {
                progress.tell(0.7 * done as f64 / all as f64)?;
            }
            let number = vertices.number(complex, solid, at, counts)?;
            if vertices.points.len() > options.max_vertices {
                let (needed, limit) = (vertices.points.len() as f64, options.max_vertices);
                return Err(TessError::TooManySolidVertices { solid, needed, limit });
            }
            own[degrees.place_index(at, counts)] = number;
            Ok(())
        })?;
        numbers.push(own);
    }
    let order = vertices.order();
    let mut mesh = VolumeMesh { positions: vec![DVec3::ZERO; order.len()], cells: Vec::new() };
    for (&place, &point) in order.iter().zip(&vertices.points) {
        mesh.positions[place as usize] = point;
    }
    for (solid, own) in numbers.iter().enumerate() {
        let counts = complex.counts_of(solid, counts);
        let degrees = complex.degrees(solid);
        degrees.each_cell(counts, |cell| {
            let vertex = |at: [u32; 4]| order[own[degrees.place_index(at, counts)] as usize];
            let cell = match cell {
                LatticeCell::Hexahedron(places) => Cell::Hexahedron(places.map(vertex)),
                LatticeCell::Tetrahedron(places) => Cell::Tetrahedron(places.map(vertex)),
                LatticeCell::Wedge(places) => Cell::Wedge(places.map(vertex)),
            };
            let cell = if complex.is_inverted(solid) { cell.flipped() } else { cell };
            match (cell.reduced(), options.cells) {
                (None, _) => report.dropped += 1,
                (Some(cell), CellKind::Own) => mesh.cells.push(cell),
                (Some(cell), CellKind::Tetrahedra) => {
                    mesh.cells.extend(cell.tetrahedra().map(Cell::Tetrahedron));
                }
            }
            Ok::<(), TessError>(())
        })?;
        progress.tell(1.0)?;
    }
    Ok((mesh, report))
}

/// Vertices of all lattices, in the order they are met.
#[derive(Default)]
struct Vertices {
    points: Vec<DVec3>,
    dimensions: Vec<u8>,
    known: HashMap<Place, u32>,
}

impl Vertices {
    fn number(
        &mut self,
        complex: &Complex,
        solid: usize,
        at: [u32; 4],
        counts: [u32; 3],
    ) -> Result<u32, TessError> {
        let place = complex.place(solid, at, counts);
        let fresh = self.points.len() as u32;
        let inside = matches!(place, Place::Inside(..));
        // What is inside is met once.
        let number = if inside { fresh } else { *self.known.entry(place).or_insert(fresh) };
        if number == fresh {
            self.points.push(complex.point(place, solid, at, counts)?);
            self.dimensions.push(place.dimension() as u8);
        }
        Ok(number)
    }

    /// New numbers: corners first, then edges, faces, and the inside. The diagonals of a disc's corner cell, whose sides meet in a
    /// straight angle, then go through that corner, and no triangle is left between the circle and its chord.
    fn order(&self) -> Vec<u32> {
        let mut sorted: Vec<u32> = (0..self.points.len() as u32).collect();
        sorted.sort_by_key(|&vertex| self.dimensions[vertex as usize]);
        let mut order = vec![0; sorted.len()];
        for (place, vertex) in sorted.into_iter().enumerate() {
            order[vertex as usize] = place as u32;
        }
        order
    }
}
