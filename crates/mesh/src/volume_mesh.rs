use casteljau_geom::BoundingBox;
use casteljau_geom::glam::DVec3;

use crate::measure::check_range;
use crate::sink::{MAX_VERTICES, check_finite};
use crate::{Cell, MeshError, TriangleMesh};

/// A mesh of cells: vertices, and tetrahedra, pyramids, wedges and hexahedra that name them.
///
/// As with [`TriangleMesh`], the fields are public; [`validate`](Self::validate) says whether they hold together, and
/// every question asks it first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VolumeMesh {
    /// Where the vertices are.
    pub positions: Vec<DVec3>,
    /// The cells.
    pub cells: Vec<Cell>,
}

impl VolumeMesh {
    /// Says whether the mesh holds together: indices name vertices, and all coordinates are finite.
    pub fn validate(&self) -> Result<(), MeshError> {
        let vertices = self.positions.len();
        if vertices > MAX_VERTICES {
            return Err(MeshError::TooManyVertices { limit: MAX_VERTICES });
        }
        for (index, &position) in self.positions.iter().enumerate() {
            check_finite("position", index, position)?;
        }
        for (cell, named) in self.cells.iter().enumerate() {
            if let Some(&index) = named.vertices().iter().find(|&&index| index as usize >= vertices) {
                return Err(MeshError::CellIndexOutOfRange { cell, index, vertices });
            }
        }
        Ok(())
    }

    pub(crate) fn validate_measurable(&self) -> Result<(), MeshError> {
        self.validate()?;
        self.positions.iter().enumerate().try_for_each(|(index, &p)| check_range("position", index, p))
    }

    /// The smallest box around all vertices; `None` without vertices or where a position is not finite.
    pub fn bounding_box(&self) -> Option<BoundingBox> {
        BoundingBox::from_points(self.positions.iter().copied())
    }

    /// The same mesh, of tetrahedra only: each cell cut as by [`Cell::tetrahedra`], so that what conformed conforms still.
    ///
    /// Error: the mesh does not [hold together](Self::validate). Cost: linear; a hexahedron becomes five or six tetrahedra.
    ///
    /// ```
    /// use casteljau_mesh::{Cell, VolumeMesh, glam::{DVec3, dvec3}};
    /// let x = |i: u32, bit: u32| f64::from(i >> bit & 1);
    /// let cube = VolumeMesh {
    ///     positions: (0..8).map(|i| dvec3(x(i, 0), x(i, 1), x(i, 2))).collect(),
    ///     cells: vec![Cell::Hexahedron([0, 1, 3, 2, 4, 5, 7, 6])],
    /// };
    /// let cut = cube.tetrahedral()?;
    /// assert_eq!(cut.cells.len(), 6);
    /// assert!(cut.audit()?.is_valid());
    /// assert_eq!(cut.volume()?, 1.0);
    /// # Ok::<(), casteljau_mesh::MeshError>(())
    /// ```
    pub fn tetrahedral(&self) -> Result<Self, MeshError> {
        self.validate()?;
        let cells = self.cells.iter().flat_map(Cell::tetrahedra).map(Cell::Tetrahedron).collect();
        Ok(Self { positions: self.positions.clone(), cells })
    }

    /// The volume of a cell under the linear or, with quads, the trilinear map: `⅙ Σ` of the triple products of its faces'
    /// triangles with respect to its first vertex, a quad counting as the mean of its two ways to be cut, which is exact for the
    /// bilinear face between its edges. Negative for a cell that is inside out.
    pub(crate) fn cell_volume(&self, cell: &Cell) -> f64 {
        let at = |vertex: u32| self.positions[vertex as usize];
        let origin = at(cell.vertices()[0]);
        let triple = |[a, b, c]: [u32; 3]| {
            let [a, b, c] = [a, b, c].map(|v| at(v) - origin);
            a.dot(b.cross(c))
        };
        let face = |row: &[u32]| match *row {
            [a, b, c, d] => {
                0.5 * (triple([a, b, c]) + triple([a, c, d]) + triple([a, b, d]) + triple([b, c, d]))
            }
            [a, b, c] => triple([a, b, c]),
            _ => 0.0,
        };
        cell.faces().map(|f| face(f.vertices())).sum::<f64>() / 6.0
    }

    /// The volume of all cells together, those that are inside out counting negative.
    ///
    /// Error: the mesh does not [hold together](Self::validate), or a coordinate is beyond
    /// [`MAX_COORDINATE`](crate::MAX_COORDINATE). Rounding: 32u of each cell's terms, compensated summation.
    pub fn volume(&self) -> Result<f64, MeshError> {
        self.validate_measurable()?;
        Ok(crate::measure::sum(self.cells.iter().map(|cell| self.cell_volume(cell))))
    }

    /// The faces that belong to one cell only, outside out, as a mesh of its own; quads are cut by the diagonal from their
    /// least vertex, as [`tetrahedral`](Self::tetrahedral) does.
    ///
    /// Its vertices are those of this mesh that are named, in their order.
    ///
    /// Error: the mesh does not [hold together](Self::validate). Cost: O(C log C).
    pub fn boundary(&self) -> Result<TriangleMesh, MeshError> {
        self.validate()?;
        let faces = crate::volume_audit::Faces::new(self);
        let triangles: Vec<[u32; 3]> =
            faces.single().flat_map(|face| face.triangles().collect::<Vec<_>>()).collect();
        let mut number = vec![u32::MAX; self.positions.len()];
        triangles.iter().flatten().for_each(|&v| number[v as usize] = 0);
        let mut mesh = TriangleMesh::default();
        for (place, &position) in number.iter_mut().zip(&self.positions) {
            if *place == 0 {
                *place = mesh.positions.len() as u32;
                mesh.positions.push(position);
            }
        }
        mesh.triangles = triangles.iter().map(|t| t.map(|v| number[v as usize])).collect();
        Ok(mesh)
    }
}
