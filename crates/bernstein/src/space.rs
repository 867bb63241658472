//! Spaces of Bernstein polynomials: a domain with a degree, and what polynomials over it can do.

use crate::line::{counts, net_size};
use crate::product::product_tensor;
use crate::{BernsteinError, Point};

/// The polynomials of some degree over some domain, held by their Bernstein coefficients.
///
/// What [`compose`](crate::compose) asks of the domain of its arguments: products, and constants. A list of D
/// degrees, `[usize; D]`, is the space of tensor products over `[0, 1]ᴰ`: `[n]` on the interval, `[m, n]` on
/// the square, `[l, m, n]` on the cube.
pub trait BernsteinSpace: Copy {
    /// The number of coefficients.
    ///
    /// # Errors
    /// [`BernsteinError::Degree`] where a degree is not served.
    fn size(self) -> Result<usize, BernsteinError>;

    /// The space of the products of k polynomials of this one: k times the degree. For k = 0 the constants.
    #[must_use]
    fn power(self, k: usize) -> Self;

    /// The space of the products with polynomials of another one: the sum of the degrees.
    #[must_use]
    fn times(self, other: Self) -> Self;

    /// Product of a scalar polynomial of this space and one of `other`, in the space
    /// [`times`](Self::times)`(other)`.
    ///
    /// # Errors
    /// [`BernsteinError::BufferLength`], [`BernsteinError::Degree`].
    fn multiply<P: Point>(self, a: &[f64], other: Self, b: &[P], out: &mut [P])
    -> Result<(), BernsteinError>;
}

impl<const D: usize> BernsteinSpace for [usize; D] {
    fn size(self) -> Result<usize, BernsteinError> {
        net_size(self)
    }

    fn power(self, k: usize) -> Self {
        self.map(|d| d.saturating_mul(k))
    }

    fn times(self, other: Self) -> Self {
        let mut sum = self;
        for (d, more) in sum.iter_mut().zip(other) {
            *d = d.saturating_add(more);
        }
        sum
    }

    fn multiply<P: Point>(
        self,
        a: &[f64],
        other: Self,
        b: &[P],
        out: &mut [P],
    ) -> Result<(), BernsteinError> {
        product_tensor(a, self, b, other, out)
    }
}

/// The indices of the lines along the last axis of a net, each with its line.
pub(crate) fn last_lines<P, const D: usize>(
    points: &[P],
    degrees: [usize; D],
) -> impl Iterator<Item = ([usize; D], &[P])> {
    let counts = counts(degrees);
    let width = counts.last().copied().unwrap_or(1);
    points.chunks_exact(width).enumerate().map(move |(mut number, line)| {
        let mut index = [0; D];
        for axis in (0..D.saturating_sub(1)).rev() {
            index[axis] = number % counts[axis];
            number /= counts[axis];
        }
        (index, line)
    })
}
