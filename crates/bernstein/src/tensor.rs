//! Tensor products in two variables.

use crate::interval::{differentiated, nested};
use crate::line::counts;
use crate::{BernsteinError, MAX_DEGREE, Point, binomial, box_net::power};

/// Nets with at most so many rows keep the rows' values on the stack; others make them again for each order.
const ROWS_ON_STACK: usize = 24;

/// A tensor-product polynomial, `p(u,v) = Σᵢ Σⱼ Bᵢᵐ(u) Bⱼⁿ(v) Pᵢⱼ`, over a borrowed control net.
///
/// `Pᵢⱼ` stands at place `i·(n+1) + j`: j runs fastest, and with v.
///
/// ```
/// use casteljau_bernstein::TensorNet;
/// let net = TensorNet::new(&[0.0, 0.0, 0.0, 1.0], [1, 1])?; // u·v
/// assert_eq!(net.value(0.5, 0.25), 0.125);
/// let mut partials = [0.0; 6];
/// net.partials(0.5, 0.25, &mut partials);
/// assert_eq!(partials, [0.125, 0.25, 0.5, 0.0, 1.0, 0.0]);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct TensorNet<'a, P> {
    pub(crate) points: &'a [P],
    pub(crate) degrees: [usize; 2],
}

/// The number of partial derivatives up to a total order, `(k+1)(k+2)/2`.
#[must_use]
pub const fn partial_count(order: usize) -> usize {
    (order + 1) * (order + 2) / 2
}

/// The place of `∂ᵃ⁺ᵇ/∂uᵃ∂vᵇ` in a list of partial derivatives: `1; u, v; uu, uv, vv; …`, that is
/// `(a+b)(a+b+1)/2 + b`.
#[must_use]
pub const fn partial_index(a: usize, b: usize) -> usize {
    (a + b) * (a + b + 1) / 2 + b
}

impl<'a, P: Point> TensorNet<'a, P> {
    /// Takes `points` as a net of the degrees m (with u) and n (with v).
    ///
    /// # Errors
    /// [`BernsteinError::NetLength`] unless there are (m+1)(n+1) points, [`BernsteinError::Degree`] above
    /// [`MAX_DEGREE`].
    pub fn new(points: &'a [P], degrees: [usize; 2]) -> Result<Self, BernsteinError> {
        if let Some(&degree) = degrees.iter().find(|&&d| d > MAX_DEGREE) {
            return Err(BernsteinError::Degree { degree, limit: MAX_DEGREE });
        }
        if points.len() != (degrees[0] + 1) * (degrees[1] + 1) {
            return Err(BernsteinError::NetLength { degrees, given: points.len() });
        }
        Ok(Self { points, degrees })
    }

    /// Takes `points` as a net that was validated before, when the shape that owns it was constructed.
    ///
    /// Nothing is checked: a net that does not fit its degrees gives meaningless values, but no panic.
    #[inline]
    #[must_use]
    pub const fn validated(points: &'a [P], degrees: [usize; 2]) -> Self {
        Self { points, degrees }
    }

    /// Value `p(u,v)`.
    ///
    /// Error: at most `4(m+n+2)·u·ΣΣ|Bᵢᵐ Bⱼⁿ Pᵢⱼ|`. Cost: the net is read once, 3(m+1)(n+1) operations a
    /// component.
    #[inline]
    #[must_use]
    pub fn value(&self, u: f64, v: f64) -> P {
        let [m, n] = self.degrees;
        nested(m, u, self.rows().map(|row| nested(n, v, row.iter().copied())))
    }

    /// Partial derivatives `∂ᵃ⁺ᵇp/∂uᵃ∂vᵇ`, at the places [`partial_index`]`(a, b)` of `out`.
    ///
    /// The total order is the greatest k with [`partial_count`]`(k) ≤ out.len()`; places beyond are set to
    /// zero.
    /// Error: at most `4(m + n + 2(a+b) + 2)·u·scale`, scale being the sum of the absolute contributions.
    /// Cost: the net is read k + 1 times; (k+1)(k+2)/2 times for m ≥ 24 or k ≥ 4.
    pub fn partials(&self, u: f64, v: f64, out: &mut [P]) {
        let Some(order) = (0..).take_while(|&k| partial_count(k) <= out.len()).last() else {
            out.fill(P::ZERO);
            return;
        };
        out[partial_count(order)..].fill(P::ZERO);
        let [m, n] = self.degrees;
        if m < ROWS_ON_STACK && order <= 3 {
            let mut values = [P::ZERO; ROWS_ON_STACK];
            let mut work = [P::ZERO; 3];
            for b in 0..=order {
                for (place, row) in values.iter_mut().zip(self.rows()) {
                    *place = differentiated(n + 1, v, &mut work[..b], row.iter().copied());
                }
                for a in 0..=order - b {
                    let rows = values[..=m].iter().copied();
                    out[partial_index(a, b)] = differentiated(m + 1, u, &mut work[..a], rows);
                }
            }
            return;
        }
        // The places before (a, b) are free and at least a + b many when the last ones are made first.
        for total in (0..=order).rev() {
            for b in (0..=total).rev() {
                let a = total - b;
                let (free, rest) = out.split_at_mut(partial_index(a, b));
                let (in_u, in_v) = free[..total].split_at_mut(a);
                let rows = self.rows().map(|row| differentiated(n + 1, v, &mut *in_v, row.iter().copied()));
                rest[0] = differentiated(m + 1, u, in_u, rows);
            }
        }
    }

    /// Derivative of order r along a direction, `(d/dh)ʳ p(u + h·d)` at h = 0:
    /// `Σ C(r,a) dᵤᵃ dᵥᵇ ∂ʳp/∂uᵃ∂vᵇ` over a + b = r.
    ///
    /// The order is the length of `work`, whose content is lost. Error: as for [`partials`](Self::partials),
    /// scale being the sum above with every term taken absolutely. Cost: the net is read r + 1 times.
    #[must_use]
    pub fn directional(&self, [u, v]: [f64; 2], [du, dv]: [f64; 2], work: &mut [P]) -> P {
        let order = work.len();
        let [m, n] = counts(self.degrees);
        let mut sum = P::ZERO;
        for a in 0..=order {
            let factor = binomial(order, a) * power(du, a) * power(dv, order - a);
            if factor != 0.0 {
                let (in_u, in_v) = work.split_at_mut(a);
                let rows = self.rows().map(|row| differentiated(n, v, &mut *in_v, row.iter().copied()));
                sum = sum + differentiated(m, u, in_u, rows) * factor;
            }
        }
        sum
    }

    /// The rows `Pᵢ₀ … Pᵢₙ`.
    pub(crate) fn rows(&self) -> std::slice::ChunksExact<'a, P> {
        self.points.chunks_exact(self.degrees[1].saturating_add(1))
    }
}
