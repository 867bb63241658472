//! Values and partial derivatives over a wedge.

use crate::interval::{differentiated, nested};
use crate::simplex::{partial, simplex_count, simplex_index, step_back, value};
use crate::{BernsteinError, MAX_DEGREE, Point};

/// A polynomial over a wedge, `p(λ, w) = Σ_β Σₖ n!/β! λ^β Bₖᵒ(w) P_βₖ`, |β| = n, over a borrowed control net.
///
/// λ are the three barycentric coordinates of a triangle, taken as given (see [`SimplexNet`](crate::SimplexNet)),
/// and w goes from 0 to 1 along the height. `P_βₖ` stands at place `simplex_index(β)·(o+1) + k`: k runs fastest.
///
/// ```
/// use casteljau_bernstein::WedgeNet;
/// let net = WedgeNet::new(&[0.0, 1.0, 0.0, 0.0, 0.0, 0.0], [1, 1])?; // λ₁w
/// assert_eq!(net.value([0.5, 0.25, 0.25], 0.5), 0.25);
/// let mut partials = [0.0; 4]; // 1; λ₁, λ₂, w
/// net.partials([0.5, 0.25, 0.25], 0.5, &mut partials);
/// assert_eq!(partials, [0.25, 0.5, 0.0, 0.5]);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct WedgeNet<'a, P> {
    points: &'a [P],
    degrees: [usize; 2],
}

impl<'a, P: Point> WedgeNet<'a, P> {
    /// Takes `points` as a net of the degrees n (of the triangle) and o (of the height).
    ///
    /// # Errors
    /// [`BernsteinError::WedgeNetLength`] unless there are (n+1)(n+2)/2·(o+1) points,
    /// [`BernsteinError::Degree`] above [`MAX_DEGREE`].
    pub fn new(points: &'a [P], degrees: [usize; 2]) -> Result<Self, BernsteinError> {
        if let Some(&degree) = degrees.iter().find(|&&d| d > MAX_DEGREE) {
            return Err(BernsteinError::Degree { degree, limit: MAX_DEGREE });
        }
        let (needed, given) = (Self::count(degrees), points.len());
        if given != needed {
            return Err(BernsteinError::WedgeNetLength { degrees, needed, given });
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

    /// The number of control points of a net of degrees n and o, `(n+1)(n+2)/2·(o+1)`.
    #[must_use]
    pub const fn count(degrees: [usize; 2]) -> usize {
        simplex_count::<3>(degrees[0]).saturating_mul(degrees[1].saturating_add(1))
    }

    /// The net, if it fits its degrees.
    pub(crate) fn checked(&self) -> Result<Self, BernsteinError> {
        Self::new(self.points, self.degrees)
    }

    /// The degrees n of the triangle and o of the height.
    #[must_use]
    pub const fn degrees(&self) -> [usize; 2] {
        self.degrees
    }

    /// All control points.
    #[must_use]
    pub const fn points(&self) -> &'a [P] {
        self.points
    }

    /// The control point `P_βₖ`; `None` beyond the net.
    #[must_use]
    pub fn point(&self, index: [usize; 3], k: usize) -> Option<P> {
        let degree = index.iter().fold(0_usize, |sum, &entry| sum.saturating_add(entry));
        let [n, o] = self.degrees;
        if degree != n || k > o {
            return None;
        }
        self.points.get(simplex_index(index).saturating_mul(o + 1).saturating_add(k)).copied()
    }

    /// Value `p(λ, w)`, by nested multiplication: the layers' triangles, then along the height.
    ///
    /// At a vertex the answer is its control point to the bit. Error: at most `4(n+o+2)·u` times the sum of the
    /// absolute contributions. Contributions below 10⁻²⁹⁰ may vanish. Cost: each point is read once, 3
    /// operations a component.
    #[inline]
    #[must_use]
    pub fn value(&self, lambda: [f64; 3], w: f64) -> P {
        let [n, o] = self.degrees;
        nested(o, w, (0..=o).map(|k| value(n, lambda, &self.layer(k))))
    }

    /// Partial derivatives with respect to λ₁, λ₂ and w, λ₃ = 1 − λ₁ − λ₂ being eliminated, at the places
    /// [`simplex_partial_index`](crate::simplex_partial_index)`([a, b, c])` of `out`.
    ///
    /// The total order is the greatest k with [`simplex_count`]`::<4>(k) ≤ out.len()`; places beyond are set to
    /// zero. Error: at most `4(n + o + 2k + 2)·u·scale`, scale being the sum of the absolute contributions to a
    /// derivative of order k. Cost: for each derivative, (a+1)(b+1) points are read for each of a smaller net.
    pub fn partials(&self, lambda: [f64; 3], w: f64, out: &mut [P]) {
        let Some(order) = (0..).take_while(|&k| simplex_count::<4>(k) <= out.len()).last() else {
            out.fill(P::ZERO);
            return;
        };
        out[simplex_count::<4>(order)..].fill(P::ZERO);
        let [n, o] = self.degrees;
        // As over a simplex: from the last one down, with the places below to work in.
        let mut orders = [0, 0, 0, order];
        loop {
            let [_, a, b, c] = orders;
            let (free, rest) = out.split_at_mut(simplex_index(orders));
            let (in_height, in_triangle) = free.split_at_mut(c);
            let layers = (0..=o).map(|k| partial(n, lambda, &[a, b], in_triangle, &self.layer(k)));
            rest[0] = differentiated(o.saturating_add(1), w, in_height, layers);
            if !step_back(&mut orders) {
                break;
            }
        }
    }

    /// Fills `net` with the control points, whatever their number.
    pub(super) fn copy_to(&self, net: &mut [P]) {
        for (place, p) in net.iter_mut().enumerate() {
            *p = self.points.get(place).copied().unwrap_or(P::ZERO);
        }
    }

    /// The triangle net of all `P_βₖ` with one k, as a function of the place.
    #[inline]
    pub(crate) fn layer(&self, k: usize) -> impl Fn(usize) -> P {
        let width = self.degrees[1].saturating_add(1);
        move |place| {
            self.points.get(place.saturating_mul(width).saturating_add(k)).copied().unwrap_or(P::ZERO)
        }
    }
}
