//! Sums and products of polynomials over a wedge.

use super::WedgeNet;
use crate::line::check_length;
use crate::simplex::{multi_indices, product_degree, shares, simplex_index};
use crate::{BernsteinError, Point, binomial};

impl<P: Point> WedgeNet<'_, P> {
    /// Sum of two polynomials of any degrees, in the larger degree in each direction.
    ///
    /// `out` and `work`, whose content is lost, are nets of those degrees. Error: that of
    /// [`elevate`](Self::elevate), and one rounding more.
    ///
    /// # Errors
    /// [`BernsteinError::Degree`], [`BernsteinError::WedgeNetLength`], [`BernsteinError::BufferLength`].
    pub fn sum(&self, other: &Self, out: &mut [P], work: &mut [P]) -> Result<(), BernsteinError> {
        let ([n, o], [m, l]) = (self.degrees(), other.degrees());
        let degrees = [n.max(m), o.max(l)];
        check_length("work", work.len(), Self::count(degrees))?;
        self.elevate(degrees, out)?;
        other.elevate(degrees, work)?;
        for (sum, &p) in out.iter_mut().zip(&*work) {
            *sum = *sum + p;
        }
        Ok(())
    }

    /// Product with a scalar polynomial; the degrees add up.
    ///
    /// Weights are those of [`SimplexNet::product`](crate::SimplexNet::product) times those of
    /// the interval along the height, and add up to 1. Error of each point: at most
    /// `4(N+O+2)·u` times the same sum of absolute values, N and O being the new degrees. Cost: one weight and one
    /// multiplication a component for each pair of points.
    ///
    /// # Errors
    /// [`BernsteinError::Degree`], [`BernsteinError::WedgeNetLength`], [`BernsteinError::BufferLength`].
    pub fn product(&self, factor: &WedgeNet<'_, f64>, out: &mut [P]) -> Result<(), BernsteinError> {
        self.product_by(factor, |p, f| p * f, out)
    }

    /// [`product`](Self::product) of points of any two kinds, by any `multiply` that is linear in both: dot and
    /// cross products, for instance.
    ///
    /// # Errors
    /// As for [`product`](Self::product).
    pub fn product_by<Q: Point, R: Point>(
        &self,
        factor: &WedgeNet<'_, Q>,
        multiply: impl Fn(P, Q) -> R,
        out: &mut [R],
    ) -> Result<(), BernsteinError> {
        let ([n, o], [m, l]) = (self.checked()?.degrees(), factor.checked()?.degrees());
        let degrees = [product_degree(n, m)?, product_degree(o, l)?];
        check_length("out", out.len(), Self::count(degrees))?;
        let [in_triangle, in_height] = degrees;
        let (of_triangle, of_height) = (binomial(in_triangle, n), binomial(in_height, o));
        for (row, index) in out.chunks_exact_mut(in_height + 1).zip(multi_indices::<3>(in_triangle)) {
            for (k, product) in row.iter_mut().enumerate() {
                let sum = shares(n, index, &mut |own, others| {
                    let (own, others) = (simplex_index(own) * (o + 1), simplex_index(others) * (l + 1));
                    let along_height = shares(o, [in_height - k, k], &mut |[_, i], [_, j]| {
                        multiply(self.points()[own + i], factor.points()[others + j])
                    });
                    along_height / of_height
                });
                *product = sum / of_triangle;
            }
        }
        Ok(())
    }
}
