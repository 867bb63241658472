//! De Casteljau's algorithm over a wedge: its scheme, the blossom, directional derivatives.

use super::WedgeNet;
use crate::error::least_length;
use crate::line::check_length;
use crate::simplex::{directional, multi_indices, raised, simplex_count, simplex_index, step};
use crate::{BernsteinError, Point, derivative, interval};

impl<P: Point> WedgeNet<'_, P> {
    /// The scheme of de Casteljau's algorithm, triangle first: nets of degrees (n, o), (n−1, o), …, (0, o), one
    /// after another; then, of the last one, a curve of degree o, the levels of its own scheme, `p(λ, w)` last.
    /// # Errors
    /// [`BernsteinError::BufferLength`] unless `out` holds (n+1)(n+2)(n+3)/6·(o+1) + o(o+1)/2 points.
    pub fn scheme(&self, lambda: [f64; 3], w: f64, out: &mut [P]) -> Result<(), BernsteinError> {
        let [n, o] = self.degrees();
        let width = o.saturating_add(1);
        let curve = width.saturating_mul(o) / 2;
        check_length("out", out.len(), simplex_count::<4>(n).saturating_mul(width).saturating_add(curve))?;
        let (mut below, mut rest) = out.split_at_mut(simplex_count::<3>(n) * width);
        self.copy_to(below);
        for lower in (0..n).rev() {
            let (level, left) = rest.split_at_mut(simplex_count::<3>(lower) * width);
            for (row, index) in level.chunks_exact_mut(width).zip(multi_indices::<3>(lower)) {
                let corner = |vertex: usize| &below[simplex_index(raised(index, vertex)) * width..];
                let corners = corner(0).iter().zip(corner(1)).zip(corner(2));
                for (p, ((&a, &b), &c)) in row.iter_mut().zip(corners) {
                    *p = a * lambda[0] + b * lambda[1] + c * lambda[2];
                }
            }
            (below, rest) = (level, left);
        }
        // The scheme of the curve begins with its points, which are there already.
        let last = out.len() - curve - width;
        interval::fill_scheme(width, w, &mut out[last..]);
        Ok(())
    }

    /// The blossom `p[λ¹, …, λⁿ; w₁, …, wₒ]`, symmetric in the arguments of each kind and affine in each.
    ///
    /// Error: at most `4(n+o+2)·u` times the same with everything taken absolutely. Cost: de Casteljau's
    /// algorithm for each layer, and for the curve of the results.
    ///
    /// # Errors
    /// [`BernsteinError::BufferLength`] unless there are n and o arguments, and `scratch` holds
    /// (n+1)(n+2)/2 + o + 1 points or more.
    pub fn blossom(
        &self,
        in_triangle: &[[f64; 3]],
        in_height: &[f64],
        scratch: &mut [P],
    ) -> Result<P, BernsteinError> {
        let [n, o] = self.degrees();
        check_length("in_triangle", in_triangle.len(), n)?;
        check_length("in_height", in_height.len(), o)?;
        let (net, column) = self.scratch(0, scratch)?;
        for (k, p) in column.iter_mut().enumerate() {
            self.copy_layer(k, net);
            for (lower, &argument) in (0..n).rev().zip(in_triangle) {
                step(lower, argument, net);
            }
            *p = net[0];
        }
        for (level, &w) in (1..=o).rev().zip(in_height) {
            interval::step(w, &mut column[..=level]);
        }
        Ok(column[0])
    }

    /// The derivative of order k along one direction, `(D_d + e ∂/∂w)ᵏ p = Σⱼ C(k,j) eʲ D_dᵏ⁻ʲ ∂ʲp/∂wʲ`.
    ///
    /// d has barycentric coordinates that add up to 0; the last one is implied by the others and not read.
    /// Error: at most `4(n + o + 2k + 2)·u·scale`, scale being the sum of the absolute contributions. Cost: k + 1
    /// passes over the layers.
    ///
    /// # Errors
    /// [`BernsteinError::BufferLength`] unless `scratch` holds (n+1)(n+2)/2 + o + 1 + k points or more.
    pub fn directional(
        &self,
        (lambda, w): ([f64; 3], f64),
        (d, e): ([f64; 3], f64),
        order: usize,
        scratch: &mut [P],
    ) -> Result<P, BernsteinError> {
        let [n, o] = self.degrees();
        let (net, rest) = self.scratch(order, scratch)?;
        let (column, work) = rest.split_at_mut(o + 1);
        let mut sum = P::ZERO;
        let mut weight = 1.0;
        for j in 0..=order.min(o) {
            let in_triangle = order - j;
            if in_triangle <= n {
                for (k, p) in column.iter_mut().enumerate() {
                    self.copy_layer(k, net);
                    *p = directional(n, lambda, std::iter::repeat_n(d, in_triangle), net);
                }
                sum = sum + derivative(column, w, &mut work[..j]) * weight;
            }
            weight *= e * (order - j) as f64 / (j + 1) as f64;
        }
        Ok(sum)
    }

    /// Room for one layer, and for a column with `more` points after it.
    fn scratch<'s>(
        &self,
        more: usize,
        scratch: &'s mut [P],
    ) -> Result<(&'s mut [P], &'s mut [P]), BernsteinError> {
        let [n, o] = self.degrees();
        let layer = simplex_count::<3>(n);
        let needed = layer.saturating_add(o).saturating_add(1).saturating_add(more);
        least_length("scratch", needed, scratch.len())?;
        Ok(scratch[..needed].split_at_mut(layer))
    }

    pub(super) fn copy_layer(&self, k: usize, net: &mut [P]) {
        let layer = self.layer(k);
        for (place, p) in net.iter_mut().enumerate() {
            *p = layer(place);
        }
    }
}
