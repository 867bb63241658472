//! Faces of a wedge, and the same net seen from elsewhere.

use super::WedgeNet;
use crate::line::check_length;
use crate::simplex::{check_vertices, face_indices, simplex_count, simplex_index};
use crate::{BernsteinError, Point};

impl<P: Point> WedgeNet<'_, P> {
    /// The triangle at the bottom, w = 0, or at the top, w = 1, as a net of degree n. Points are copied, to the bit.
    ///
    /// # Errors
    /// [`BernsteinError::WedgeNetLength`], [`BernsteinError::BufferLength`].
    pub fn triangle_face(&self, top: bool, out: &mut [P]) -> Result<(), BernsteinError> {
        let [n, o] = self.checked()?.degrees();
        check_length("out", out.len(), simplex_count::<3>(n))?;
        self.copy_layer(if top { o } else { 0 }, out);
        Ok(())
    }

    /// The quad over the triangle's edge from vertex a to vertex b, as a net of degrees n, with u from a to b, and
    /// o, with v along the height. Points are copied, to the bit.
    ///
    /// With the edges (0, 1), (1, 2), (2, 0) and positive orientation of the whole, `∂u × ∂v` points outward.
    ///
    /// # Errors
    /// [`BernsteinError::Vertices`], [`BernsteinError::WedgeNetLength`], [`BernsteinError::BufferLength`] unless `out`
    /// holds (n+1)(o+1) points.
    ///
    /// ```
    /// use casteljau_bernstein::WedgeNet;
    /// let net = WedgeNet::new(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0], [1, 1])?;
    /// let mut quad = [0.0; 4];
    /// net.quad_face([2, 0], &mut quad)?;
    /// assert_eq!(quad, [4.0, 5.0, 0.0, 1.0]);
    /// # Ok::<(), casteljau_bernstein::BernsteinError>(())
    /// ```
    pub fn quad_face(&self, edge: [usize; 2], out: &mut [P]) -> Result<(), BernsteinError> {
        let [n, o] = self.checked()?.degrees();
        check_length("out", out.len(), (n + 1) * (o + 1))?;
        self.copy_rows(edge, false, out)
    }

    /// The same polynomial with the vertices of the triangle in the order given, and upside down if `flip`.
    ///
    /// # Errors
    /// [`BernsteinError::Vertices`], [`BernsteinError::WedgeNetLength`], [`BernsteinError::BufferLength`].
    pub fn reoriented(&self, vertices: [usize; 3], flip: bool, out: &mut [P]) -> Result<(), BernsteinError> {
        check_length("out", out.len(), self.checked()?.points().len())?;
        self.copy_rows(vertices, flip, out)
    }

    fn copy_rows<const F: usize>(
        &self,
        vertices: [usize; F],
        flip: bool,
        out: &mut [P],
    ) -> Result<(), BernsteinError> {
        let [n, o] = self.degrees();
        check_vertices::<3>(&vertices)?;
        for (row, index) in out.chunks_exact_mut(o + 1).zip(face_indices::<F, 3>(n, vertices)) {
            let start = simplex_index::<3>(index) * (o + 1);
            row.copy_from_slice(&self.points()[start..=start + o]);
            if flip {
                row.reverse();
            }
        }
        Ok(())
    }
}
