//! Integrals and moments over a simplex.

use super::index::multi_indices;
use super::net::SimplexNet;
use crate::Point;

impl<P: Point, const V: usize> SimplexNet<'_, P, V> {
    /// Integral over the simplex in its parameters, `∫ p dλ₁ … dλ_{V−1}`: the mean of the control points, times the
    /// measure `1/(V−1)!` of the parameters, ½ for a triangle and ⅙ for a tetrahedron.
    ///
    /// Error: at most `(V+4)·u` times the same of absolute values. Cost: each point is read once.
    ///
    /// ```
    /// use casteljau_bernstein::TriangleNet;
    /// let net = TriangleNet::new(&[3.0, 0.0, 0.0], 1)?; // 3λ₁
    /// assert_eq!(net.integral(), 0.5);
    /// # Ok::<(), casteljau_bernstein::BernsteinError>(())
    /// ```
    ///
    /// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 17.7.
    #[must_use]
    pub fn integral(&self) -> P {
        self.moment([0; V])
    }

    /// Moment `∫ λ₁ᵃ λ₂ᵇ … p dλ₁ … dλ_{V−1}`, with an exponent for each barycentric coordinate, 0 for most:
    /// `n!/(n+k+V−1)! Σ (β+α)!/β! P_β`, k = |α|.
    ///
    /// Sums are compensated (Kahan). Error: at most `(4k+V+4)·u` times the same of absolute values. Cost: k + 1
    /// multiplications a point.
    #[must_use]
    pub fn moment(&self, exponents: [usize; V]) -> P {
        let n = self.degree();
        let mut sum = Compensated::new();
        for (place, index) in multi_indices::<V>(n).enumerate().take(self.points().len()) {
            sum.add(self.at(place) * moment_weight(n, index, exponents));
        }
        sum.value() / measure::<V>(n, exponents)
    }
}

/// `Π (βₐ+1) … (βₐ+αₐ) / ((n+1) … (n+k))`, factor by factor, so that nothing overflows.
pub(crate) fn moment_weight<const V: usize>(n: usize, index: [usize; V], exponents: [usize; V]) -> f64 {
    let (mut weight, mut total) = (1.0, n as f64);
    for (&entry, &exponent) in index.iter().zip(&exponents) {
        for j in 1..=exponent {
            total += 1.0;
            weight *= (entry as f64 + j as f64) / total;
        }
    }
    weight
}

/// What the weighted sum is divided by, `(n+k+1) … (n+k+V−1)`.
pub(crate) fn measure<const V: usize>(n: usize, exponents: [usize; V]) -> f64 {
    let total = exponents.iter().fold(n as f64, |total, &e| total + e as f64);
    (1..V).fold(1.0, |product, j| product * (total + j as f64))
}

/// A sum whose error does not grow with the number of terms.
pub(crate) struct Compensated<P> {
    sum: P,
    lost: P,
}

impl<P: Point> Compensated<P> {
    pub(crate) fn new() -> Self {
        Self { sum: P::ZERO, lost: P::ZERO }
    }

    pub(crate) fn add(&mut self, term: P) {
        let term = term - self.lost;
        let next = self.sum + term;
        self.lost = (next - self.sum) - term;
        self.sum = next;
    }

    pub(crate) fn value(self) -> P {
        self.sum - self.lost
    }
}
