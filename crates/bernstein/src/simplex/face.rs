//! Faces and edges of a net, and the same net with its vertices in another order.

use super::index::{MultiIndices, multi_indices, simplex_count, simplex_index};
use super::net::SimplexNet;
use super::restriction::check_vertices;
use crate::line::check_length;
use crate::{BernsteinError, Point};

/// The edges of a triangle, counter-clockwise; edge a is opposite to vertex a.
pub const TRIANGLE_EDGES: [[usize; 2]; 3] = [[1, 2], [2, 0], [0, 1]];

/// The faces of a tetrahedron, counter-clockwise seen from outside where `det(v₀−v₃, v₁−v₃, v₂−v₃)` is positive;
/// face a is opposite to vertex a.
pub const TETRAHEDRON_FACES: [[usize; 3]; 4] = [[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]];

impl<P: Point, const V: usize> SimplexNet<'_, P, V> {
    /// The net over the simplex with some of the vertices, in the order given: an edge for F = 2, as the points of
    /// a curve from the first to the second; a face for F = 3; with F = V the same polynomial with its vertices in
    /// another order. Points are copied, to the bit.
    ///
    /// # Errors
    /// [`BernsteinError::Vertices`] unless these are different vertices, [`BernsteinError::BufferLength`] unless
    /// `out` holds [`simplex_count`]`::<F>(n)` points.
    ///
    /// ```
    /// use casteljau_bernstein::{TRIANGLE_EDGES, TriangleNet};
    /// let net = TriangleNet::new(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0], 2)?;
    /// let mut edge = [0.0; 3];
    /// net.face(TRIANGLE_EDGES[2], &mut edge)?;
    /// assert_eq!(edge, [0.0, 1.0, 3.0]);
    /// # Ok::<(), casteljau_bernstein::BernsteinError>(())
    /// ```
    pub fn face<const F: usize>(&self, vertices: [usize; F], out: &mut [P]) -> Result<(), BernsteinError> {
        check_vertices::<V>(&vertices)?;
        check_length("out", out.len(), simplex_count::<F>(self.degree()))?;
        for (p, index) in out.iter_mut().zip(face_indices::<F, V>(self.degree(), vertices)) {
            *p = self.at(simplex_index(index));
        }
        Ok(())
    }
}

/// The multi-indices of a face in the order of its own net.
pub(crate) fn face_indices<const F: usize, const V: usize>(
    degree: usize,
    vertices: [usize; F],
) -> impl Iterator<Item = [usize; V]> {
    let own: MultiIndices<F> = multi_indices(degree);
    own.map(move |own| {
        let mut index = [0; V];
        for (&vertex, entry) in vertices.iter().zip(own) {
            index[vertex] = entry;
        }
        index
    })
}
