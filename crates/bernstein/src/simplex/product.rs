//! Sums and products of polynomials over a simplex.

use super::index::{multi_indices, simplex_count, simplex_index};
use super::net::SimplexNet;
use crate::line::check_length;
use crate::{BernsteinError, MAX_DEGREE, Point, binomial};

impl<P: Point, const V: usize> SimplexNet<'_, P, V> {
    /// Sum of two polynomials of any degrees, in the larger of the two, which `out` has.
    ///
    /// The one of lower degree is [elevated](Self::elevate), with the error of that and one rounding more.
    ///
    /// # Errors
    /// [`BernsteinError::Degree`], [`BernsteinError::BufferLength`].
    pub fn sum(&self, other: &Self, out: &mut [P]) -> Result<(), BernsteinError> {
        let (low, high) = if self.degree() <= other.degree() { (self, other) } else { (other, self) };
        low.elevate(high.degree(), out)?;
        for (place, sum) in out.iter_mut().enumerate() {
            *sum = *sum + high.at(place);
        }
        Ok(())
    }

    /// Product with a scalar polynomial of degree m, in degree n + m:
    /// `Q_γ = Σ Π C(γₐ, βₐ) / C(n+m, n) P_β f_{γ−β}` over |β| = n.
    ///
    /// With numbers for points it is the product of two scalars. The weights are those of drawing without
    /// replacement and add up to 1; no intermediate value exceeds C(n+m, n) times the result's scale. Error of
    /// each point: at most `4(n+m+2)·u` times the same sum of absolute values. Cost: one weight and one
    /// multiplication a component for each pair of points.
    ///
    /// # Errors
    /// [`BernsteinError::Degree`] where n + m is above [`MAX_DEGREE`], [`BernsteinError::BufferLength`] unless
    /// `out` holds [`simplex_count`]`::<V>(n+m)` points.
    ///
    /// ```
    /// use casteljau_bernstein::TriangleNet;
    /// let first = TriangleNet::new(&[1.0, 0.0, 0.0], 1)?; // λ₁
    /// let second = TriangleNet::new(&[0.0, 1.0, 0.0], 1)?; // λ₂
    /// let mut product = [0.0; 6];
    /// first.product(&second, &mut product)?;
    /// assert_eq!(product, [0.0, 0.5, 0.0, 0.0, 0.0, 0.0]);
    /// # Ok::<(), casteljau_bernstein::BernsteinError>(())
    /// ```
    ///
    /// Source: Farouki and Rajan, "Algorithms for polynomials in Bernstein form", CAGD 5 (1988), sec. 4.
    pub fn product(&self, factor: &SimplexNet<'_, f64, V>, out: &mut [P]) -> Result<(), BernsteinError> {
        self.product_by(factor, |p, f| p * f, out)
    }

    /// [`product`](Self::product) of points of any two kinds, by any `multiply` that is linear in both: dot and
    /// cross products, for instance.
    ///
    /// # Errors
    /// As for [`product`](Self::product).
    ///
    /// ```
    /// use casteljau_bernstein::{TriangleNet, glam::DVec2};
    /// let points = [DVec2::X, DVec2::Y, DVec2::ZERO];
    /// let net = TriangleNet::new(&points, 1)?;
    /// let mut squared_length = [0.0; 6];
    /// net.product_by(&net, DVec2::dot, &mut squared_length)?;
    /// assert_eq!(squared_length, [1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    /// # Ok::<(), casteljau_bernstein::BernsteinError>(())
    /// ```
    pub fn product_by<Q: Point, R: Point>(
        &self,
        factor: &SimplexNet<'_, Q, V>,
        multiply: impl Fn(P, Q) -> R,
        out: &mut [R],
    ) -> Result<(), BernsteinError> {
        let n = self.degree();
        let degree = product_degree(n, factor.degree())?;
        check_length("out", out.len(), simplex_count::<V>(degree))?;
        let whole = binomial(degree, n);
        for (product, index) in out.iter_mut().zip(multi_indices::<V>(degree)) {
            let sum = shares(n, index, &mut |own, others| {
                multiply(self.at(simplex_index(own)), factor.at(simplex_index(others)))
            });
            *product = sum / whole;
        }
        Ok(())
    }
}

/// The degree of a product, if it is served.
pub(crate) fn product_degree(n: usize, m: usize) -> Result<usize, BernsteinError> {
    let degree = n.saturating_add(m);
    if degree > MAX_DEGREE {
        return Err(BernsteinError::Degree { degree, limit: MAX_DEGREE });
    }
    Ok(degree)
}

/// `Σ Π C(γₐ, βₐ) term(β, γ−β)` over all β ≤ γ with |β| = n, which must not be above |γ|.
///
/// Sums of sums, one for each entry, so that a term takes part in at most n + V additions. Divided by C(|γ|, n)
/// the weights add up to 1.
pub(crate) fn shares<R: Point, const V: usize>(
    n: usize,
    index: [usize; V],
    term: &mut impl FnMut([usize; V], [usize; V]) -> R,
) -> R {
    shares_from(0, n, [0; V], index, term)
}

/// [`shares`] over the entries from `axis` on, n being left to them; `own` and `others` are β and γ − β so far.
fn shares_from<R: Point, const V: usize>(
    axis: usize,
    n: usize,
    mut own: [usize; V],
    mut others: [usize; V],
    term: &mut impl FnMut([usize; V], [usize; V]) -> R,
) -> R {
    let all = others[axis];
    if axis + 1 == V {
        own[axis] = n;
        others[axis] = all - n;
        return term(own, others);
    }
    let later: usize = others[axis + 1..].iter().sum();
    let last = V - 1;
    let least = n.saturating_sub(later);
    let mut weight = binomial(all, least);
    // With one entry after this one, its coefficient is carried along too.
    let in_two = axis + 2 == V;
    let mut rest = if in_two { binomial(others[last], n - least) } else { 1.0 };
    let mut sum = R::ZERO;
    for share in least..=n.min(all) {
        own[axis] = share;
        others[axis] = all - share;
        sum = sum + shares_from(axis + 1, n - share, own, others, term) * (weight * rest);
        // C(g, i+1) = C(g, i) (g−i)/(i+1), and C(g, j−1) = C(g, j) j/(g−j+1).
        weight = weight * (all - share) as f64 / (share + 1) as f64;
        if in_two && share < n {
            let left = n - share;
            rest = rest * left as f64 / (others[last] - left + 1) as f64;
        }
    }
    sum
}
