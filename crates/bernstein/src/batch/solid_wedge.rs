//! One wedge at scattered parameters.

use super::BatchPoint;
use super::solid::{Kind, Nets, Shape};
use crate::glam::{DVec3, DVec4};
use crate::{BernsteinError, WedgeNet, last_barycentric};

/// A wedge, `p(λ, w) = Σ_β Σₖ n!/β! λ^β Bₖᵒ(w) P_βₖ`, |β| = n, made ready to be evaluated at many scattered parameters (λ₁, λ₂,
/// w), λ₃ being 1 − λ₁ − λ₂.
///
/// ```
/// use casteljau_bernstein::{WedgeBatch, glam::DVec3};
/// let solid = WedgeBatch::new(&[0.0, 1.0, 0.0, 0.0, 0.0, 0.0], [1, 1])?; // λ₁w
/// let [mut value, mut first, mut second, mut in_w] = [[0.0; 2]; 4];
/// let at = [DVec3::new(0.5, 0.25, 0.5), DVec3::new(1.0, 0.0, 1.0)];
/// solid.evaluate(&at, [&mut value, &mut first, &mut second, &mut in_w])?;
/// assert_eq!((value, first, second, in_w), ([0.25, 1.0], [0.5, 1.0], [0.0; 2], [0.5, 1.0]));
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
#[derive(Debug, Clone)]
pub struct WedgeBatch<P>(Nets<P>);

impl<P: BatchPoint> WedgeBatch<P> {
    /// Prepares the wedge with the net `points` of the degrees n (of the triangle) and o (of the height), in the order of
    /// [`WedgeNet`].
    ///
    /// Cost: memory for five nets.
    ///
    /// # Errors
    /// [`BernsteinError::WedgeNetLength`] unless there are (n+1)(n+2)/2·(o+1) points, [`BernsteinError::Degree`] above
    /// [`MAX_DEGREE`](crate::MAX_DEGREE).
    pub fn new(points: &[P], degrees: [usize; 2]) -> Result<Self, BernsteinError> {
        WedgeNet::new(points, degrees)?;
        let [n, o] = degrees;
        Ok(Self(Nets::new(points, Shape { kind: Kind::Wedge, degrees: [n, n, o] })))
    }

    /// Degrees n and o.
    #[must_use]
    pub fn degrees(&self) -> [usize; 2] {
        let [n, _, o] = self.0.shape.degrees;
        [n, o]
    }

    /// Values (K = 1), with first partial derivatives (K = 4) at the parameters (λ₁, λ₂, w), each kind in its own buffer: 1;
    /// λ₁, λ₂, w, as [`WedgeNet::partials`] has them.
    ///
    /// Error: at most `4(n + o + 2k + 2)·u·scale`, k being 1 for derivatives, see [the crate](crate). Cost: one multiply-add a
    /// component and control point for each kind, two divisions; total degrees n + o above 60 go one by one through
    /// [`WedgeNet::partials`].
    ///
    /// # Errors
    /// [`BernsteinError::BufferLength`] unless every buffer has the length of `parameters`.
    pub fn evaluate<const K: usize>(
        &self,
        parameters: &[DVec3],
        out: [&mut [P]; K],
    ) -> Result<(), BernsteinError> {
        const { assert!(K == 1 || K == 4, "values; first derivatives") };
        self.0.evaluate(parameters, out, |at, jet| self.partials(at, jet))
    }

    fn partials(&self, at: DVec3, jet: &mut [P]) {
        let lambda = [at.x, at.y, last_barycentric(&[at.x, at.y])];
        WedgeNet::validated(&self.0.points, self.degrees()).partials(lambda, at.z, jet);
    }
}

impl WedgeBatch<DVec4> {
    /// As [`evaluate`](Self::evaluate), for a rational net `(w·x, w·y, w·z, w)`: points and derivatives in space, by the quotient
    /// rule.
    ///
    /// Error: that of numerator and denominator, magnified by 1/|w| once an order.
    ///
    /// # Errors
    /// [`BernsteinError::BufferLength`], and [`BernsteinError::Pole`] with the first place where the denominator vanishes within
    /// its rounding error, or the quotient is out of range; the buffers hold 0 at such places, and the answers everywhere else.
    pub fn evaluate_rational<const K: usize>(
        &self,
        parameters: &[DVec3],
        out: [&mut [DVec3]; K],
    ) -> Result<(), BernsteinError> {
        const { assert!(K == 1 || K == 4, "values; first derivatives") };
        self.0.evaluate_rational(parameters, out, |at, jet| self.partials(at, jet))
    }
}
