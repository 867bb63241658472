//! Simplices as domains of arguments in compositions.

use super::index::simplex_count;
use super::net::SimplexNet;
use crate::{BernsteinError, BernsteinSpace, MAX_DEGREE, Point};

/// The polynomials of a degree over a simplex with V vertices: the domain of arguments that
/// [`compose`](crate::compose) asks for.
///
/// ```
/// use casteljau_bernstein::{SimplexSpace, compose};
/// // x = t² along a curve, with t = λ₂ on a triangle: a triangle of degree 2.
/// let mut points = [0.0; 6];
/// compose(&[0.0, 0.0, 1.0], [2], [&[0.0, 1.0, 0.0]], SimplexSpace::<3>(1), &mut points)?;
/// assert_eq!(points, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SimplexSpace<const V: usize>(
    /// The degree.
    pub usize,
);

impl<const V: usize> BernsteinSpace for SimplexSpace<V> {
    fn size(self) -> Result<usize, BernsteinError> {
        if self.0 > MAX_DEGREE {
            return Err(BernsteinError::Degree { degree: self.0, limit: MAX_DEGREE });
        }
        Ok(simplex_count::<V>(self.0))
    }

    fn power(self, k: usize) -> Self {
        Self(self.0.saturating_mul(k))
    }

    fn times(self, other: Self) -> Self {
        Self(self.0.saturating_add(other.0))
    }

    fn multiply<P: Point>(
        self,
        a: &[f64],
        other: Self,
        b: &[P],
        out: &mut [P],
    ) -> Result<(), BernsteinError> {
        SimplexNet::<P, V>::new(b, other.0)?.product(&SimplexNet::new(a, self.0)?, out)
    }
}
