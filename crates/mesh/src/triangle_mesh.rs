use casteljau_geom::BoundingBox;
use casteljau_geom::glam::DVec3;

use crate::MeshError;
use crate::sink::{MAX_VERTICES, check_finite, check_indices};

/// A triangle mesh: vertices, and triangles that name three of them, counter-clockwise as seen from outside.
///
/// The fields are public and nothing forbids a caller to break them; [`validate`](Self::validate) says whether they
/// hold together, and every question that needs them whole asks it first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    /// Where the vertices are.
    pub positions: Vec<DVec3>,
    /// Unit normals of the surface, one a vertex, or none at all.
    pub normals: Vec<DVec3>,
    /// Vertex indices, three a triangle.
    pub triangles: Vec<[u32; 3]>,
}

impl TriangleMesh {
    /// Neither vertices nor triangles.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty() && self.triangles.is_empty()
    }

    /// Says whether the mesh holds together: indices name vertices, normals are as many as vertices or none, and all
    /// coordinates are finite. Cost: one pass over everything.
    pub fn validate(&self) -> Result<(), MeshError> {
        let vertices = self.positions.len();
        if vertices > MAX_VERTICES {
            return Err(MeshError::TooManyVertices { limit: MAX_VERTICES });
        }
        if !self.normals.is_empty() && self.normals.len() != vertices {
            let normals = self.normals.len();
            return Err(MeshError::NormalCount { vertex: normals.min(vertices), normals, vertices });
        }
        for (index, &position) in self.positions.iter().enumerate() {
            check_finite("position", index, position)?;
        }
        for (index, &normal) in self.normals.iter().enumerate() {
            check_finite("normal", index, normal)?;
        }
        self.validate_indices()
    }

    /// The part of [`validate`](Self::validate) that topology needs.
    pub(crate) fn validate_indices(&self) -> Result<(), MeshError> {
        let vertices = self.positions.len();
        if vertices > MAX_VERTICES {
            return Err(MeshError::TooManyVertices { limit: MAX_VERTICES });
        }
        self.triangles
            .iter()
            .enumerate()
            .try_for_each(|(index, &corners)| check_indices(index, corners, vertices))
    }

    /// The three corners of triangle `index`, or `None` where there is no such triangle or vertex.
    pub fn corners(&self, index: usize) -> Option<[DVec3; 3]> {
        let &[a, b, c] = self.triangles.get(index)?;
        let at = |i: u32| self.positions.get(i as usize).copied();
        Some([at(a)?, at(b)?, at(c)?])
    }

    /// The smallest box around all vertices, referenced or not; `None` without vertices or where a position is not finite.
    pub fn bounding_box(&self) -> Option<BoundingBox> {
        BoundingBox::from_points(self.positions.iter().copied())
    }

    /// Appends the vertices and triangles of `other`, whose indices move up by the number of vertices here.
    ///
    /// Nothing is welded. Either both have normals or neither has, unless one has no vertices. On an error `self` is
    /// left as it was.
    ///
    /// ```
    /// use casteljau_mesh::{TriangleMesh, glam::DVec3};
    /// let one = TriangleMesh {
    ///     positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
    ///     triangles: vec![[0, 1, 2]],
    ///     ..Default::default()
    /// };
    /// let mut two = one.clone();
    /// two.append(&one)?;
    /// assert_eq!(two.triangles, [[0, 1, 2], [3, 4, 5]]);
    /// # Ok::<(), casteljau_mesh::MeshError>(())
    /// ```
    pub fn append(&mut self, other: &TriangleMesh) -> Result<(), MeshError> {
        let offset = self.positions.len();
        let total = offset.saturating_add(other.positions.len());
        if total > MAX_VERTICES {
            return Err(MeshError::TooManyVertices { limit: MAX_VERTICES });
        }
        other.validate_indices()?;
        let normals = self.normals.len() + other.normals.len();
        if normals != 0 && normals != total {
            return Err(MeshError::NormalCount {
                vertex: self.normals.len().min(offset),
                normals,
                vertices: total,
            });
        }
        // `total` fits u32, and no index of `other` reaches its own number of vertices: the sums cannot overflow.
        let offset = offset as u32;
        self.positions.extend_from_slice(&other.positions);
        self.normals.extend_from_slice(&other.normals);
        self.triangles.extend(other.triangles.iter().map(|corners| corners.map(|index| index + offset)));
        Ok(())
    }

    /// Turns every triangle over, and every normal with it.
    pub fn flip(&mut self) {
        self.triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
        self.normals.iter_mut().for_each(|normal| *normal = -*normal);
    }
}
