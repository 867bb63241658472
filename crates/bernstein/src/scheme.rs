//! Whole schemes of de Casteljau's algorithm on surfaces, for looking at and for drawing.

use crate::interval::fill_scheme;
use crate::line::check_length;
use crate::{BernsteinError, Point, TensorNet};

/// The number of points in de Casteljau's scheme for a curve of degree n, `(n+1)(n+2)/2`.
#[must_use]
pub const fn scheme_count(degree: usize) -> usize {
    (degree + 1) * (degree + 2) / 2
}

impl<P: Point> TensorNet<'_, P> {
    /// The construction of a point in two stages: the schemes of the m + 1 curves in v, one for each row of the
    /// net and in their order, then the scheme in u of the points that these curves gave. `p(u,v)` comes last.
    ///
    /// Each scheme is laid out as by [`de_casteljau_scheme`](crate::de_casteljau_scheme). `out` holds
    /// [`tensor_scheme_count`] points. Error of each point: at most `4(m+n+2)·u` times its combination of
    /// absolute values.
    ///
    /// ```
    /// use casteljau_bernstein::{TensorNet, tensor_scheme_count};
    /// let net = TensorNet::new(&[0.0, 2.0, 4.0, 8.0], [1, 1])?;
    /// let mut scheme = [0.0; 9];
    /// assert_eq!(tensor_scheme_count([1, 1]), 9);
    /// net.scheme(0.5, 0.25, &mut scheme)?;
    /// // Row 0 and its point, row 1 and its point, both points and the point between them.
    /// assert_eq!(scheme, [0.0, 2.0, 0.5, 4.0, 8.0, 5.0, 0.5, 5.0, 2.75]);
    /// # Ok::<(), casteljau_bernstein::BernsteinError>(())
    /// ```
    ///
    /// # Errors
    /// [`BernsteinError::BufferLength`] where `out` has another length; [`BernsteinError::NetLength`] where the
    /// net does not fit its degrees.
    ///
    /// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 14.3.
    pub fn scheme(&self, u: f64, v: f64, out: &mut [P]) -> Result<(), BernsteinError> {
        let [m, n] = self.degrees;
        let checked = TensorNet::new(self.points, self.degrees)?;
        check_length("out", out.len(), tensor_scheme_count(self.degrees))?;
        let one = scheme_count(n);
        let (curves, across) = out.split_at_mut((m + 1) * one);
        for ((row, scheme), point) in checked.rows().zip(curves.chunks_exact_mut(one)).zip(&mut *across) {
            scheme[..=n].copy_from_slice(row);
            fill_scheme(n + 1, v, scheme);
            *point = scheme[one - 1];
        }
        fill_scheme(m + 1, u, across);
        Ok(())
    }
}

/// The number of points in the scheme of a surface point, `(m+1)(n+1)(n+2)/2 + (m+1)(m+2)/2`.
#[must_use]
pub const fn tensor_scheme_count(degrees: [usize; 2]) -> usize {
    (degrees[0] + 1) * scheme_count(degrees[1]) + scheme_count(degrees[0])
}
