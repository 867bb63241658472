use thiserror::Error;

/// What can be wrong with a mesh, or with a question asked of it.
///
/// ```
/// use casteljau_mesh::{MeshError, TriangleMesh, glam::DVec3};
/// let mesh = TriangleMesh { positions: vec![DVec3::ZERO], triangles: vec![[0, 1, 2]], ..Default::default() };
/// assert_eq!(mesh.validate(), Err(MeshError::IndexOutOfRange { triangle: 0, index: 1, vertices: 1 }));
/// ```
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MeshError {
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} names vertex {index}, but there are only {vertices} vertices")]
    IndexOutOfRange {
        /// Number of the triangle.
        triangle: usize,
        /// The index it holds.
        index: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A cell names a vertex that does not exist.
    ///
    /// ```
    /// use casteljau_mesh::{Cell, MeshError, VolumeMesh, glam::DVec3};
    /// let mesh = VolumeMesh { positions: vec![DVec3::ZERO; 4], cells: vec![Cell::Tetrahedron([0, 1, 2, 4])] };
    /// assert_eq!(mesh.audit(), Err(MeshError::CellIndexOutOfRange { cell: 0, index: 4, vertices: 4 }));
    /// ```
    #[error("cell {cell} names vertex {index}, but there are only {vertices} vertices")]
    CellIndexOutOfRange {
        /// Number of the cell.
        cell: usize,
        /// The index it holds.
        index: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A coordinate of a position or of a normal is NaN or infinite.
    #[error("{what} {index} has the coordinate {value}, which is not finite")]
    NonFinite {
        /// `"position"`, `"normal"` or `"point"`.
        what: &'static str,
        /// Its number.
        index: usize,
        /// The first offending coordinate.
        value: f64,
    },
    /// A coordinate is so large that areas and volumes would overflow.
    #[error("{what} {index} has the coordinate {value:e}, beyond the limit of {limit:e}")]
    TooLarge {
        /// `"position"` or `"point"`.
        what: &'static str,
        /// Its number.
        index: usize,
        /// The first offending coordinate.
        value: f64,
        /// The largest magnitude that is accepted.
        limit: f64,
    },
    /// Some vertices have a normal and others have none.
    #[error(
        "vertex {vertex}: {normals} normals for {vertices} vertices; either every vertex has a normal or none"
    )]
    NormalCount {
        /// The first vertex that breaks the rule.
        vertex: usize,
        /// How many normals there are.
        normals: usize,
        /// How many vertices there are.
        vertices: usize,
    },
    /// More vertices than an index can name, or than the sink accepts.
    #[error("more than {limit} vertices")]
    TooManyVertices {
        /// The largest number of vertices that is accepted.
        limit: usize,
    },
    /// More triangles than the sink accepts.
    #[error("more than {limit} triangles")]
    TooManyTriangles {
        /// The largest number of triangles that is accepted.
        limit: usize,
    },
    /// An edge belongs to more than two triangles, where a surface is needed.
    #[error("the edge between vertices {from} and {to} belongs to {triangles} triangles")]
    NonManifoldEdge {
        /// The lesser end.
        from: u32,
        /// The greater end.
        to: u32,
        /// How many triangles share the edge.
        triangles: usize,
    },
    /// A closed mesh is needed.
    #[error(
        "the mesh is not closed: {boundary_edges} boundary edges, the first between vertices {from} and {to}"
    )]
    NotClosed {
        /// How many edges belong to one triangle only.
        boundary_edges: usize,
        /// An end of the first of them.
        from: u32,
        /// Its other end.
        to: u32,
    },
    /// A consistently oriented mesh is needed.
    #[error("two triangles run along the edge from vertex {from} to vertex {to} in the same direction")]
    NotOriented {
        /// Start of the edge.
        from: u32,
        /// End of the edge.
        to: u32,
    },
    /// There is no triangle to measure a distance to.
    #[error("the mesh has no triangle")]
    Empty,
}
