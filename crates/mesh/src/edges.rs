use crate::union_find::UnionFind;
use crate::{MeshError, TriangleMesh};

/// One side of one triangle.
///
/// `corner` is the number 3·triangle + place of the corner that the side starts from; the side runs from there to the
/// next corner of the triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct HalfEdge {
    /// The lesser vertex.
    pub(crate) low: u32,
    /// The greater vertex.
    pub(crate) high: u32,
    /// Where the side starts.
    pub(crate) corner: usize,
    /// The triangle runs from `high` to `low`.
    pub(crate) backward: bool,
}

impl HalfEdge {
    /// Start and end, as the triangle runs.
    pub(crate) fn ends(self) -> [u32; 2] {
        if self.backward { [self.high, self.low] } else { [self.low, self.high] }
    }

    /// The corners of the triangle that lie at the lesser and at the greater vertex.
    pub(crate) fn corners(self) -> [usize; 2] {
        let next = self.corner - self.corner % 3 + (self.corner + 1) % 3;
        if self.backward { [next, self.corner] } else { [self.corner, next] }
    }
}

/// The sides of all triangles, sorted so that those of one edge stand together.
///
/// Triangles that name a vertex twice have no area whatever the positions are; they are left out of the topology.
pub(crate) struct Edges(Vec<HalfEdge>);

impl Edges {
    /// Collects and sorts: O(T log T), 24 bytes a side.
    pub(crate) fn new(mesh: &TriangleMesh) -> Result<Self, MeshError> {
        mesh.validate_indices()?;
        let limit = u32::MAX as usize / 3;
        if mesh.triangles.len() > limit {
            return Err(MeshError::TooManyTriangles { limit });
        }
        let mut halves = Vec::with_capacity(3 * mesh.triangles.len());
        for (index, &[a, b, c]) in mesh.triangles.iter().enumerate() {
            if a == b || b == c || c == a {
                continue;
            }
            for (place, [from, to]) in [[a, b], [b, c], [c, a]].into_iter().enumerate() {
                halves.push(HalfEdge {
                    low: from.min(to),
                    high: from.max(to),
                    corner: 3 * index + place,
                    backward: from > to,
                });
            }
        }
        halves.sort_unstable();
        Ok(Self(halves))
    }

    /// The edges, each as the sides that lie on it: one on the boundary, two inside.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &[HalfEdge]> {
        self.0.chunk_by(|a, b| (a.low, a.high) == (b.low, b.high))
    }

    /// Joins the corners of neighbouring triangles at each vertex: a set is one fan of triangles about its vertex.
    pub(crate) fn fans(&self, mesh: &TriangleMesh) -> UnionFind {
        let mut fans = UnionFind::new(3 * mesh.triangles.len());
        for edge in self.iter() {
            for pair in edge.windows(2) {
                let [a, b] = [pair[0].corners(), pair[1].corners()];
                fans.join(a[0] as u32, b[0] as u32);
                fans.join(a[1] as u32, b[1] as u32);
            }
        }
        fans
    }
}
