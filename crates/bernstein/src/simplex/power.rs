//! Between the Bernstein and the power basis over a simplex.

use super::index::{multi_indices, simplex_count, simplex_index, step_back};
use super::net::{SimplexNet, difference};
use crate::line::check_length;
use crate::{BernsteinError, MAX_DEGREE, Point, binomial};

impl<P: Point, const V: usize> SimplexNet<'_, P, V> {
    /// Coefficients of the monomials in all barycentric coordinates but the last, `λ₁ᵃ λ₂ᵇ …`, the last one being
    /// `1 − Σ`: `c_α = n!/((n−k)! α!) Δ^α P₀`, k = |α|, at the places
    /// [`simplex_partial_index`](crate::simplex_partial_index)`(α)`: `1; λ₁, λ₂; λ₁², λ₁λ₂, λ₂²; …`
    ///
    /// Error: at most `4(n+2)·u` times the same with every part of Δ^α taken absolutely, which grows as `(2V−1)ⁿ`
    /// in the worst case: the power basis is ill-conditioned over a simplex, as it is over an interval. Cost: for
    /// each coefficient Π(αₐ + 1) points are read.
    ///
    /// # Errors
    /// [`BernsteinError::Degree`], [`BernsteinError::BufferLength`] unless `out` has as many places as the net.
    ///
    /// ```
    /// use casteljau_bernstein::TriangleNet;
    /// let mut coefficients = [0.0; 6];
    /// TriangleNet::new(&[0.0, 0.5, 0.0, 0.0, 0.0, 1.0], 2)?.to_power(&mut coefficients)?; // λ₁λ₂ + λ₃²
    /// assert_eq!(coefficients, [1.0, -2.0, -2.0, 1.0, 3.0, 1.0]);
    /// # Ok::<(), casteljau_bernstein::BernsteinError>(())
    /// ```
    pub fn to_power(&self, out: &mut [P]) -> Result<(), BernsteinError> {
        let n = self.degree();
        check_places::<P, V>(n, "out", out)?;
        // As for partial derivatives: from the last one down, with the places below to work in.
        let mut orders = [0; V];
        orders[V - 1] = n;
        loop {
            let (free, rest) = out.split_at_mut(simplex_index(orders));
            let mut base = [0; V];
            base[V - 1] = orders[0];
            rest[0] = difference(base, &orders[1..], free, &|place| self.at(place)) * multinomial(orders);
            if !step_back(&mut orders) {
                return Ok(());
            }
        }
    }
}

/// Control points from coefficients of monomials, the inverse of [`SimplexNet::to_power`]:
/// `P_β = Σ Π C(βₐ, αₐ) · (n−k)! α!/n! c_α` over α ≤ β, k = |α|, the last coordinate apart.
///
/// All weights are between 0 and 1. Error of each point: at most `4(n+2)·u` times the same sum of absolute values.
/// Cost: one weight for each pair of a point and a coefficient.
///
/// # Errors
/// [`BernsteinError::Degree`], [`BernsteinError::BufferLength`] unless both hold [`simplex_count`]`::<V>(degree)`
/// places.
///
/// ```
/// use casteljau_bernstein::simplex_from_power;
/// let mut points = [0.0; 6];
/// simplex_from_power::<_, 3>(&[1.0, -2.0, -2.0, 1.0, 3.0, 1.0], 2, &mut points)?;
/// assert_eq!(points, [0.0, 0.5, 0.0, 0.0, 0.0, 1.0]);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
pub fn simplex_from_power<P: Point, const V: usize>(
    coefficients: &[P],
    degree: usize,
    out: &mut [P],
) -> Result<(), BernsteinError> {
    check_places::<P, V>(degree, "coefficients", coefficients)?;
    check_places::<P, V>(degree, "out", out)?;
    for (p, index) in out.iter_mut().zip(multi_indices::<V>(degree)) {
        *p = monomials_at(degree, index, coefficients);
    }
    Ok(())
}

/// `Σ weight(α, β) c_α`, the monomials of one total order after those of another, so that sums stay short.
fn monomials_at<P: Point, const V: usize>(degree: usize, index: [usize; V], coefficients: &[P]) -> P {
    let (mut sum, mut of_order, mut order) = (P::ZERO, P::ZERO, 0);
    for (orders, &c) in multi_indices::<V>(degree).zip(coefficients) {
        if degree - orders[0] > order {
            (sum, of_order, order) = (sum + of_order, P::ZERO, order + 1);
        }
        let weight = inverse_entry(index, orders);
        if weight != 0.0 {
            of_order = of_order + c * weight;
        }
    }
    sum + of_order
}

/// The matrix of [`SimplexNet::to_power`], c = M P, by rows: row α has the entries
/// `(−1)^(k−|β|) n!/((n−k)! α!) Π C(αₐ, βₐ)`, k = |α|, the products and |β| without the last coordinate. All are
/// integers, and exact while they are below 2⁵³.
///
/// # Errors
/// [`BernsteinError::Degree`]; [`BernsteinError::BufferLength`] unless `out` is square, with
/// [`simplex_count`]`::<V>(degree)` rows.
pub fn simplex_power_matrix<const V: usize>(degree: usize, out: &mut [f64]) -> Result<(), BernsteinError> {
    fill::<V>(degree, out, |orders, index| {
        let ways = pairs(orders, index).fold(1.0, |w, (a, b)| w * binomial(a, b));
        // |α| − |β|, both without the last coordinate, is β_V − α₀.
        let odd = (index[V - 1] + orders[0]) % 2 == 1;
        multinomial(orders) * if odd { -ways } else { ways }
    })
}

/// The matrix of [`simplex_from_power`], P = M⁻¹ c, by rows; its entries are between 0 and 1.
///
/// # Errors
/// As for [`simplex_power_matrix`].
pub fn simplex_power_matrix_inverse<const V: usize>(
    degree: usize,
    out: &mut [f64],
) -> Result<(), BernsteinError> {
    fill::<V>(degree, out, inverse_entry)
}

fn fill<const V: usize>(
    degree: usize,
    out: &mut [f64],
    entry: impl Fn([usize; V], [usize; V]) -> f64,
) -> Result<(), BernsteinError> {
    if degree > MAX_DEGREE {
        return Err(BernsteinError::Degree { degree, limit: MAX_DEGREE });
    }
    let count = simplex_count::<V>(degree);
    check_length("out", out.len(), count.saturating_mul(count))?;
    for (row, of_row) in out.chunks_exact_mut(count).zip(multi_indices::<V>(degree)) {
        for (place, of_column) in row.iter_mut().zip(multi_indices::<V>(degree)) {
            *place = entry(of_row, of_column);
        }
    }
    Ok(())
}

/// `Π C(βₐ, αₐ) / (n!/((n−k)! α!))`
fn inverse_entry<const V: usize>(index: [usize; V], orders: [usize; V]) -> f64 {
    if pairs(orders, index).any(|(a, b)| a > b) {
        return 0.0;
    }
    pairs(orders, index).fold(1.0, |w, (a, b)| w * binomial(b, a)) / multinomial(orders)
}

/// `(αₐ, βₐ)`: orders have n − k before α, multi-indices the last coordinate after the others.
fn pairs<const V: usize>(orders: [usize; V], index: [usize; V]) -> impl Iterator<Item = (usize, usize)> {
    (1..V).map(move |a| (orders[a], index[a - 1]))
}

/// `n!/β!`, as a product of binomial coefficients.
pub(crate) fn multinomial<const V: usize>(index: [usize; V]) -> f64 {
    let mut sum = 0;
    index.iter().fold(1.0, |product, &entry| {
        sum += entry;
        product * binomial(sum, entry)
    })
}

fn check_places<P, const V: usize>(
    degree: usize,
    buffer: &'static str,
    places: &[P],
) -> Result<(), BernsteinError> {
    if degree > MAX_DEGREE {
        return Err(BernsteinError::Degree { degree, limit: MAX_DEGREE });
    }
    check_length(buffer, places.len(), simplex_count::<V>(degree))
}
