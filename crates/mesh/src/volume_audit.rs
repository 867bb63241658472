use casteljau_geom::glam::DVec3;

use crate::cell::CellFace;
use crate::{Audit, Cell, MeshError, VolumeMesh};

/// What [`VolumeMesh::audit`] found.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct VolumeAudit {
    /// Vertices, referenced or not.
    pub vertices: usize,
    /// Vertices that no cell names.
    pub unreferenced_vertices: usize,
    /// Cells that are tetrahedra, pyramids, wedges, hexahedra.
    pub cells: [usize; 4],
    /// Cells that name a vertex more than once.
    pub repeated: usize,
    /// Faces of exactly two cells, that run opposite ways: the cells lie on its two sides.
    pub interior_faces: usize,
    /// Faces of one cell.
    pub boundary_faces: usize,
    /// Faces of two cells that run the same way, or of more than two.
    pub bad_faces: usize,
    /// Cells whose volume is not above 64u of the sum of the absolute terms in it: flat, or inside out.
    pub not_positive: usize,
    /// Cells that are no tetrahedra and have a corner at which the edges do not span a positive volume, within the
    /// same bound: the trilinear map folds there. A corner whose edges lie in a plane, as at the edge of a full disc, is none where it is exactly flat or opens.
    pub folded: usize,
    /// The least volume of a cell; `None` without cells.
    pub least_volume: Option<f64>,
    /// The surface of all boundary faces.
    pub boundary: Audit,
}

impl VolumeAudit {
    /// Whether the cells conform, each is of positive volume, and their boundary is closed and oriented.
    ///
    /// The boundary may touch itself, as that of two cells which share an edge only.
    pub fn is_valid(&self) -> bool {
        self.bad_faces == 0 && self.not_positive == 0 && self.boundary.closed && self.boundary.oriented
    }
}

/// The faces of all cells, those of the same vertices side by side.
pub(crate) struct Faces(Vec<([u32; 4], bool, CellFace)>);

impl Faces {
    pub(crate) fn new(mesh: &VolumeMesh) -> Self {
        let keyed = |face: CellFace| {
            let row = face.vertices();
            let least = (0..row.len()).min_by_key(|&place| row[place]).unwrap_or(0);
            let around = |place: usize| row[(least + place) % row.len()];
            // From the least vertex in the direction of its lesser neighbour.
            let backward = around(1) > around(row.len() - 1);
            let mut key = [u32::MAX; 4];
            for (place, entry) in key.iter_mut().enumerate().take(row.len()) {
                *entry = around(if backward { row.len() - place } else { place });
            }
            (key, backward, face)
        };
        let mut all: Vec<_> = mesh.cells.iter().flat_map(Cell::faces).map(keyed).collect();
        all.sort_unstable_by_key(|&(key, backward, _)| (key, backward));
        Self(all)
    }

    fn groups(&self) -> impl Iterator<Item = &[([u32; 4], bool, CellFace)]> {
        self.0.chunk_by(|a, b| a.0 == b.0)
    }

    /// Those of one cell.
    pub(crate) fn single(&self) -> impl Iterator<Item = CellFace> {
        self.groups().filter_map(|group| match group {
            [(_, _, face)] => Some(*face),
            _ => None,
        })
    }
}

/// For each corner of a cell the three neighbours, positively spanning; pyramids are not asked at their apex.
fn corners(cell: &Cell) -> &'static [[usize; 4]] {
    match cell {
        Cell::Tetrahedron(_) => &[],
        Cell::Pyramid(_) => &[[0, 1, 3, 4], [1, 2, 0, 4], [2, 3, 1, 4], [3, 0, 2, 4]],
        Cell::Wedge(_) => {
            &[[0, 1, 2, 3], [1, 2, 0, 4], [2, 0, 1, 5], [3, 5, 4, 0], [4, 3, 5, 1], [5, 4, 3, 2]]
        }
        Cell::Hexahedron(_) => &[
            [0, 1, 3, 4],
            [1, 2, 0, 5],
            [2, 3, 1, 6],
            [3, 0, 2, 7],
            [4, 7, 5, 0],
            [5, 4, 6, 1],
            [6, 5, 7, 2],
            [7, 6, 4, 3],
        ],
    }
}

impl VolumeMesh {
    /// Audits conformity, orientation and volume.
    ///
    /// Two cells conform where they share a whole face or none of its inside; a quad beside two triangles shows as three
    /// boundary faces and a boundary that is no manifold.
    ///
    /// Error: the mesh does not [hold together](Self::validate), or a coordinate is beyond
    /// [`MAX_COORDINATE`](crate::MAX_COORDINATE). Cost: O(C log C).
    pub fn audit(&self) -> Result<VolumeAudit, MeshError> {
        self.validate_measurable()?;
        let faces = Faces::new(self);
        let (mut interior_faces, mut boundary_faces, mut bad_faces) = (0, 0, 0);
        for group in faces.groups() {
            match group {
                [_] => boundary_faces += 1,
                [(_, false, _), (_, true, _)] => interior_faces += 1,
                _ => bad_faces += 1,
            }
        }
        let mut named = vec![false; self.positions.len()];
        let mut audit = VolumeAudit {
            vertices: self.positions.len(),
            unreferenced_vertices: 0,
            cells: [0; 4],
            repeated: 0,
            interior_faces,
            boundary_faces,
            bad_faces,
            not_positive: 0,
            folded: 0,
            least_volume: None,
            boundary: self.boundary()?.audit()?,
        };
        for cell in &self.cells {
            let row = cell.vertices();
            row.iter().for_each(|&v| named[v as usize] = true);
            audit.cells[kind(cell)] += 1;
            audit.repeated += usize::from((1..row.len()).any(|place| row[..place].contains(&row[place])));
            let volume = self.cell_volume(cell);
            audit.least_volume = Some(audit.least_volume.map_or(volume, |least: f64| least.min(volume)));
            let rounding = self.volume_rounding(row);
            audit.not_positive += usize::from(volume <= rounding);
            let span = |&[a, b, c, d]: &[usize; 4]| {
                let [a, b, c, d] = [a, b, c, d].map(|place| self.positions[row[place] as usize]);
                (b - a).cross(c - a).dot(d - a)
            };
            audit.folded += usize::from(corners(cell).iter().any(|corner| span(corner) < -6.0 * rounding));
        }
        audit.unreferenced_vertices = named.iter().filter(|n| !**n).count();
        Ok(audit)
    }

    /// How many cells have a volume that is not above the rounding in it; see [`VolumeAudit::not_positive`].
    ///
    /// The mesh must [hold together](Self::validate); cells that name vertices that do not exist count. Cost: linear.
    pub fn not_positive(&self) -> usize {
        let vertices = self.positions.len();
        let flat = |cell: &&Cell| {
            let row = cell.vertices();
            row.iter().any(|&v| v as usize >= vertices) || self.cell_volume(cell) <= self.volume_rounding(row)
        };
        self.cells.iter().filter(flat).count()
    }

    /// 64u of what the terms of a cell's volume can be: rounding of coordinates and of products.
    fn volume_rounding(&self, row: &[u32]) -> f64 {
        let points = row.iter().map(|&v| self.positions[v as usize]);
        let largest = points.clone().fold(0.0, |max: f64, p| max.max(p.abs().max_element()));
        let first = self.positions[row[0] as usize];
        let size = points.fold(DVec3::ZERO, |max, p| max.max((p - first).abs()));
        // A coordinate's rounding, u·largest, times an area of the box around the cell, and the products' own.
        let area = size.x * size.y + size.y * size.z + size.z * size.x;
        32.0 * f64::EPSILON * (size.x * size.y * size.z) + 0.5 * f64::EPSILON * largest * area
    }
}

fn kind(cell: &Cell) -> usize {
    match cell {
        Cell::Tetrahedron(_) => 0,
        Cell::Pyramid(_) => 1,
        Cell::Wedge(_) => 2,
        Cell::Hexahedron(_) => 3,
    }
}
