//! Polynomials over a part of their wedge, or beyond it.

use super::WedgeNet;
use crate::error::least_length;
use crate::line::{Line, check_length};
use crate::restriction::restrict_line;
use crate::simplex::{SimplexNet, TRIANGLE_QUARTERS, check_vertices, replace_vertex, simplex_count};
use crate::{BernsteinError, Point, subdivide};

impl<P: Point> WedgeNet<'_, P> {
    /// Restriction to the wedge over the triangle with the given corners and the interval `[a, b]` of the height.
    ///
    /// As [`SimplexNet::restrict`] on every layer and [`restrict`](crate::restrict) on every row: corners and
    /// intervals may lie outside, and parts with corners in common meet to the bit. Error of each point: at most
    /// `4(n+o+2)·u` times the same with everything taken absolutely. `scratch` holds 5 layers of (n+1)(n+2)/2 points.
    ///
    /// # Errors
    /// [`BernsteinError::WedgeNetLength`], [`BernsteinError::BufferLength`].
    pub fn restrict(
        &self,
        corners: [[f64; 3]; 3],
        interval: [f64; 2],
        out: &mut [P],
        scratch: &mut [P],
    ) -> Result<(), BernsteinError> {
        let [n, o] = self.checked()?.degrees();
        let layer = simplex_count::<3>(n);
        least_length("scratch", 5 * layer, scratch.len())?;
        check_length("out", out.len(), self.points().len())?;
        let (net, rest) = scratch.split_at_mut(layer);
        let (part, rest) = rest.split_at_mut(layer);
        for k in 0..=o {
            self.copy_layer(k, net);
            SimplexNet::<P, 3>::validated(net, n).restrict(corners, part, rest)?;
            for (row, &p) in out.chunks_exact_mut(o + 1).zip(&*part) {
                row[k] = p;
            }
        }
        if interval != [0.0, 1.0] {
            for row in out.chunks_exact_mut(o + 1) {
                restrict_line(&mut Line::whole(row), o, interval);
            }
        }
        Ok(())
    }

    /// Subdivision across the height at w: `below` holds p over `[0, w]`, `above` p over `[w, 1]`.
    ///
    /// As [`subdivide`] on every row: the two share the layer at w to the bit.
    ///
    /// # Errors
    /// [`BernsteinError::WedgeNetLength`], [`BernsteinError::BufferLength`].
    pub fn split_height(&self, w: f64, below: &mut [P], above: &mut [P]) -> Result<(), BernsteinError> {
        let [_, o] = self.checked()?.degrees();
        check_length("below", below.len(), self.points().len())?;
        check_length("above", above.len(), self.points().len())?;
        let halves = below.chunks_exact_mut(o + 1).zip(above.chunks_exact_mut(o + 1));
        for (row, (below, above)) in self.points().chunks_exact(o + 1).zip(halves) {
            subdivide(row, w, below, above)?;
        }
        Ok(())
    }

    /// Subdivision at a point of the triangle into three wedges, whose nets follow one another in `out`: the one of
    /// number a has the point in place of vertex a. Otherwise as [`SimplexNet::split_at`].
    ///
    /// # Errors
    /// [`BernsteinError::WedgeNetLength`], [`BernsteinError::BufferLength`] unless `out` holds 3 nets.
    pub fn split_at(&self, lambda: [f64; 3], out: &mut [P]) -> Result<(), BernsteinError> {
        let [n, o] = self.checked()?.degrees();
        check_length("out", out.len(), 3 * self.points().len())?;
        for (vertex, part) in out.chunks_exact_mut(self.points().len()).enumerate() {
            part.copy_from_slice(self.points());
            replace_vertex(n, o + 1, vertex, lambda, part);
        }
        Ok(())
    }

    /// Subdivision of the triangle's edge from vertex a to vertex b at `(1−t) a + t b`: `near_a` has the point in
    /// place of b, `near_b` in place of a. Otherwise as [`SimplexNet::split_edge`].
    ///
    /// # Errors
    /// [`BernsteinError::Vertices`], [`BernsteinError::WedgeNetLength`], [`BernsteinError::BufferLength`].
    pub fn split_edge(
        &self,
        [a, b]: [usize; 2],
        t: f64,
        near_a: &mut [P],
        near_b: &mut [P],
    ) -> Result<(), BernsteinError> {
        let [n, o] = self.checked()?.degrees();
        check_vertices::<3>(&[a, b])?;
        let mut lambda = [0.0; 3];
        (lambda[a], lambda[b]) = (1.0 - t, t);
        for (name, vertex, part) in [("near_a", b, near_a), ("near_b", a, near_b)] {
            check_length(name, part.len(), self.points().len())?;
            part.copy_from_slice(self.points());
            replace_vertex(n, o + 1, vertex, lambda, part);
        }
        Ok(())
    }

    /// The uniform split into eight: the four [`TRIANGLE_QUARTERS`] in the lower half of the height, then those in
    /// the upper, whose nets follow one another in `out`. Otherwise as [`restrict`](Self::restrict).
    ///
    /// # Errors
    /// [`BernsteinError::WedgeNetLength`], [`BernsteinError::BufferLength`] unless `out` holds 8 nets and `scratch` 5
    /// layers.
    pub fn split_uniform(&self, out: &mut [P], scratch: &mut [P]) -> Result<(), BernsteinError> {
        let count = self.checked()?.points().len();
        check_length("out", out.len(), 8 * count)?;
        let halves = [[0.0, 0.5], [0.5, 1.0]];
        let parts = halves.into_iter().flat_map(|half| TRIANGLE_QUARTERS.map(|corners| (corners, half)));
        for ((corners, half), part) in parts.zip(out.chunks_exact_mut(count)) {
            self.restrict(corners, half, part, scratch)?;
        }
        Ok(())
    }
}
