//! Sums and products of polynomials over a simplex.

use std::borrow::Cow;

use super::index::{MultiIndices, simplex_count, simplex_index};
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
    /// each point: at most `4(n+m+2)·u` times the same sum of absolute values. Cost: two multiplications a
    /// component for each pair of points; from degree 32 on (n+1)(m+1) weights are allocated.
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
        let (n, m) = (self.degree(), factor.degree());
        let degree = product_degree(n, m)?;
        check_length("out", out.len(), simplex_count::<V>(degree))?;
        let ways = Ways::new(n, m);
        let whole = ways.row(n)[m];
        // `Σ C(j+l, j) C(r−j+s−l, r−j) Pⱼ fₗ` over j + l = k, of lines with r + 1 and s + 1 points.
        let line = |own: [usize; V], others: [usize; V], sum: &mut [R]| {
            let (r, s) = (own[V - 2], others[V - 2]);
            let factors = line_at(factor, others);
            for (j, &p) in line_at(self, own).iter().enumerate() {
                let (last, but_one) = (&ways.row(j)[..=s], &ways.row(r - j)[..=s]);
                let weights = last.iter().zip(but_one.iter().rev()).map(|(a, b)| a * b);
                for ((sum, &f), weight) in sum[j..].iter_mut().zip(factors).zip(weights) {
                    *sum = *sum + multiply(p, f) * weight;
                }
            }
        };
        let mut rest = out;
        for first in MultiIndices::on_face(degree, std::array::from_fn(|vertex| vertex), V - 1) {
            let (sum, later) = rest.split_at_mut(first[V - 2] + 1);
            sum.fill(R::ZERO);
            add_shares(0, n, [0; V], first, &ways, &line, sum, later);
            sum.iter_mut().for_each(|product| *product = *product / whole);
            rest = later;
        }
        Ok(())
    }
}

/// The points of a net that differ in the last two entries only, from the one with a multi-index that ends in 0 on.
fn line_at<'a, P: Point, const V: usize>(net: &SimplexNet<'a, P, V>, first: [usize; V]) -> &'a [P] {
    let start = simplex_index(first);
    net.points().get(start..=start + first[V - 2]).unwrap_or_default()
}

/// Adds to `sum`, the points `others`, …, of a line, `Σ Π C(γₐ, βₐ) line(β, γ−β)` over all ways of sharing n among
/// the entries of β from `axis` on, the last two of which count as one.
///
/// Sums of sums, one for each entry, so that a term takes part in at most n + V additions. What is added up
/// stands in `work`: for each entry above 0 there is a longer line among those of the net after `sum`.
#[allow(clippy::too_many_arguments)]
fn add_shares<R: Point, const V: usize>(
    axis: usize,
    n: usize,
    mut own: [usize; V],
    mut others: [usize; V],
    ways: &Ways,
    line: &impl Fn([usize; V], [usize; V], &mut [R]),
    sum: &mut [R],
    work: &mut [R],
) {
    let all = others[axis];
    if axis + 2 == V {
        (own[axis], others[axis]) = (n, all - n);
        return line(own, others, sum);
    }
    if all == 0 {
        return add_shares(axis + 1, n, own, others, ways, line, sum, work);
    }
    let later: usize = others[axis + 1..].iter().sum();
    let (part, work) = work.split_at_mut(sum.len());
    for share in n.saturating_sub(later)..=n.min(all) {
        (own[axis], others[axis]) = (share, all - share);
        part.fill(R::ZERO);
        add_shares(axis + 1, n - share, own, others, ways, line, part, work);
        let weight = ways.row(share)[all - share];
        for (sum, &p) in sum.iter_mut().zip(&*part) {
            *sum = *sum + p * weight;
        }
    }
}

/// The numbers of ways to mix i things with k others, `C(i+k, i)`, for i ≤ n, k ≤ m: Pascal's triangle on its side.
///
/// Made by additions of positive numbers: exact to i + k = 56, relative error at most (i + k − 56)·u beyond.
struct Ways {
    table: Cow<'static, [f64]>,
    columns: usize,
}

/// Degrees below this one find their numbers in a table.
const FEW: usize = 32;

static FEW_WAYS: [f64; FEW * FEW] = {
    let (mut table, mut place) = ([1.0; FEW * FEW], FEW);
    while place < FEW * FEW {
        if place % FEW > 0 {
            table[place] = table[place - FEW] + table[place - 1];
        }
        place += 1;
    }
    table
};

impl Ways {
    fn new(n: usize, m: usize) -> Self {
        if n.max(m) < FEW {
            return Self { table: Cow::Borrowed(&FEW_WAYS), columns: FEW };
        }
        let columns = m + 1;
        let mut table = vec![1.0; (n + 1) * columns];
        for place in (columns..table.len()).filter(|place| place % columns > 0) {
            table[place] = table[place - columns] + table[place - 1];
        }
        Self { table: Cow::Owned(table), columns }
    }

    #[inline]
    fn row(&self, i: usize) -> &[f64] {
        &self.table[i * self.columns..][..self.columns]
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
