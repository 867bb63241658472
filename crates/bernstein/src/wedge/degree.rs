//! Degree elevation and reduction over a wedge, in either direction.

use super::WedgeNet;
use crate::elevation::elevate_line;
use crate::error::least_length;
use crate::line::{Line, check_length};
use crate::simplex::{SimplexNet, check_elevation, elevate_step, simplex_count};
use crate::{BernsteinError, Point, reduce};

impl<P: Point> WedgeNet<'_, P> {
    /// Degree elevation from (n, o) to `to`, in the triangle, along the height or both.
    ///
    /// Convex combinations only; vertices are kept to the bit. Error of each point: at most
    /// `4(to₀ + to₁ + 2)·u` times its combination of absolute values.
    ///
    /// # Errors
    /// [`BernsteinError::ElevatedDegree`] where a degree would get lower, [`BernsteinError::Degree`],
    /// [`BernsteinError::WedgeNetLength`], [`BernsteinError::BufferLength`] unless `out` is a net of the new degrees.
    ///
    /// ```
    /// use casteljau_bernstein::WedgeNet;
    /// let mut out = [0.0; 9];
    /// WedgeNet::new(&[0.0, 2.0, 0.0, 4.0, 0.0, 6.0], [1, 1])?.elevate([1, 2], &mut out)?;
    /// assert_eq!(out, [0.0, 1.0, 2.0, 0.0, 2.0, 4.0, 0.0, 3.0, 6.0]);
    /// # Ok::<(), casteljau_bernstein::BernsteinError>(())
    /// ```
    pub fn elevate(&self, to: [usize; 2], out: &mut [P]) -> Result<(), BernsteinError> {
        let [n, o] = self.checked()?.degrees();
        check_elevation(n, to[0])?;
        check_elevation(o, to[1])?;
        check_length("out", out.len(), Self::count(to))?;
        let width = to[1] + 1;
        for (row, given) in out.chunks_exact_mut(width).zip(self.points().chunks_exact(o + 1)) {
            row[..=o].copy_from_slice(given);
            elevate_line(&mut Line::whole(row), o + 1, width);
        }
        for degree in n + 1..=to[0] {
            elevate_step::<P, 3>(degree, width, out);
        }
        Ok(())
    }

    /// Degree reduction from (n, o) to `to`: first along the height, as [`reduce`] on every row, then in the triangle,
    /// as [`SimplexNet::reduce`] on every layer; gives a bound on the distance of the two polynomials over the wedge.
    ///
    /// The bound is the sum of those of the two stages, each certified. Values at the vertices are kept where
    /// neither degree becomes 0. A polynomial of the lower degrees comes back as it was, up to rounding. `scratch`
    /// holds (o + 7)·(n+1)(n+2)/2 + o + 1 points; its content is lost.
    ///
    /// # Errors
    /// [`BernsteinError::ReducedDegree`] where a degree would get higher, [`BernsteinError::WedgeNetLength`],
    /// [`BernsteinError::BufferLength`].
    pub fn reduce(&self, to: [usize; 2], out: &mut [P], scratch: &mut [P]) -> Result<f64, BernsteinError> {
        let [n, o] = self.checked()?.degrees();
        for (from, to) in [(n, to[0]), (o, to[1])] {
            if to > from {
                return Err(BernsteinError::ReducedDegree { from, to });
            }
        }
        check_length("out", out.len(), Self::count(to))?;
        let (high, low, width) = (simplex_count::<3>(n), simplex_count::<3>(to[0]), to[1] + 1);
        least_length("scratch", high * (o + 7) + o + 1, scratch.len())?;
        let (rows, rest) = scratch.split_at_mut(high * width);
        let (work, rest) = rest.split_at_mut(o + 1);
        let mut along_height = 0.0_f64;
        for (row, given) in rows.chunks_exact_mut(width).zip(self.points().chunks_exact(o + 1)) {
            along_height = along_height.max(reduce(given, row, work)?);
        }
        let (layer, rest) = rest.split_at_mut(high);
        let (reduced, rest) = rest.split_at_mut(low);
        let mut in_triangle = 0.0_f64;
        for k in 0..width {
            for (p, row) in layer.iter_mut().zip(rows.chunks_exact(width)) {
                *p = row[k];
            }
            let net = SimplexNet::<P, 3>::validated(layer, n);
            in_triangle = in_triangle.max(net.reduce(to[0], reduced, rest)?);
            for (row, &p) in out.chunks_exact_mut(width).zip(&*reduced) {
                row[k] = p;
            }
        }
        Ok(along_height + in_triangle)
    }
}
