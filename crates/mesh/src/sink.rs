use casteljau_geom::glam::DVec3;

use crate::{MeshError, TriangleMesh};

/// The most vertices that `u32` indices can name: one less than 2³², so that the count itself fits an index.
pub(crate) const MAX_VERTICES: usize = u32::MAX as usize;

/// What a tessellator writes into.
///
/// Vertices come before the triangles that name them. A sink refuses with an error what it cannot hold, and the
/// tessellator passes that error on; what was pushed before it stays in the sink.
pub trait MeshSink {
    /// Adds a vertex and returns its index. Indices count up from the number of vertices already there.
    ///
    /// The normal is of unit length or absent; a sink may insist that every vertex has one or none has.
    fn vertex(&mut self, position: DVec3, normal: Option<DVec3>) -> Result<u32, MeshError>;

    /// Adds a triangle, its corners counter-clockwise as seen from outside.
    fn triangle(&mut self, corners: [u32; 3]) -> Result<(), MeshError>;
}

/// A sink that keeps nothing but the numbers: what would a mesh cost?
///
/// It refuses the same indices, coordinates and excess that a mesh would.
///
/// ```
/// use casteljau_mesh::{CountingSink, MeshError, MeshSink, glam::DVec3};
/// let mut sink = CountingSink::with_limits(2, 10);
/// sink.vertex(DVec3::ZERO, None)?;
/// sink.vertex(DVec3::X, None)?;
/// assert_eq!(sink.vertex(DVec3::Y, None), Err(MeshError::TooManyVertices { limit: 2 }));
/// # Ok::<(), MeshError>(())
/// ```
#[derive(Clone, Debug)]
pub struct CountingSink {
    vertices: usize,
    triangles: usize,
    max_vertices: usize,
    max_triangles: usize,
}

impl Default for CountingSink {
    fn default() -> Self {
        Self::with_limits(MAX_VERTICES, usize::MAX)
    }
}

impl CountingSink {
    /// A sink that accepts at most so many vertices (never more than 2³² − 1) and triangles.
    pub fn with_limits(max_vertices: usize, max_triangles: usize) -> Self {
        Self { vertices: 0, triangles: 0, max_vertices: max_vertices.min(MAX_VERTICES), max_triangles }
    }

    /// Vertices received.
    pub fn vertices(&self) -> usize {
        self.vertices
    }

    /// Triangles received.
    pub fn triangles(&self) -> usize {
        self.triangles
    }
}

impl MeshSink for CountingSink {
    fn vertex(&mut self, position: DVec3, normal: Option<DVec3>) -> Result<u32, MeshError> {
        check_finite("position", self.vertices, position)?;
        if let Some(normal) = normal {
            check_finite("normal", self.vertices, normal)?;
        }
        let index = next_index(self.vertices, self.max_vertices)?;
        self.vertices += 1;
        Ok(index)
    }

    fn triangle(&mut self, corners: [u32; 3]) -> Result<(), MeshError> {
        check_indices(self.triangles, corners, self.vertices)?;
        if self.triangles >= self.max_triangles {
            return Err(MeshError::TooManyTriangles { limit: self.max_triangles });
        }
        self.triangles += 1;
        Ok(())
    }
}

/// The mesh as a sink: all vertices have normals or none has, and every triangle names vertices that exist.
impl MeshSink for TriangleMesh {
    fn vertex(&mut self, position: DVec3, normal: Option<DVec3>) -> Result<u32, MeshError> {
        let count = self.positions.len();
        check_finite("position", count, position)?;
        let index = next_index(count, MAX_VERTICES)?;
        let expected = if normal.is_some() { count } else { 0 };
        if self.normals.len() != expected {
            let normals = self.normals.len() + usize::from(normal.is_some());
            return Err(MeshError::NormalCount { vertex: count, normals, vertices: count + 1 });
        }
        if let Some(normal) = normal {
            check_finite("normal", count, normal)?;
            self.normals.push(normal);
        }
        self.positions.push(position);
        Ok(index)
    }

    fn triangle(&mut self, corners: [u32; 3]) -> Result<(), MeshError> {
        check_indices(self.triangles.len(), corners, self.positions.len())?;
        self.triangles.push(corners);
        Ok(())
    }
}

/// A sink can be lent.
impl<S: MeshSink + ?Sized> MeshSink for &mut S {
    fn vertex(&mut self, position: DVec3, normal: Option<DVec3>) -> Result<u32, MeshError> {
        (**self).vertex(position, normal)
    }

    fn triangle(&mut self, corners: [u32; 3]) -> Result<(), MeshError> {
        (**self).triangle(corners)
    }
}

/// The index that the next vertex gets.
fn next_index(count: usize, limit: usize) -> Result<u32, MeshError> {
    match u32::try_from(count) {
        Ok(index) if count < limit => Ok(index),
        _ => Err(MeshError::TooManyVertices { limit }),
    }
}

/// Refuses a triangle with an index that names no vertex.
pub(crate) fn check_indices(triangle: usize, corners: [u32; 3], vertices: usize) -> Result<(), MeshError> {
    match corners.into_iter().find(|&index| index as usize >= vertices) {
        Some(index) => Err(MeshError::IndexOutOfRange { triangle, index, vertices }),
        None => Ok(()),
    }
}

/// Refuses NaN and infinity.
pub(crate) fn check_finite(what: &'static str, index: usize, value: DVec3) -> Result<(), MeshError> {
    match value.to_array().into_iter().find(|c| !c.is_finite()) {
        Some(value) => Err(MeshError::NonFinite { what, index, value }),
        None => Ok(()),
    }
}
