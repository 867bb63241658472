//! One tensor-product solid at scattered parameters.

use super::BatchPoint;
use super::solid::{Kind, Nets, Shape};
use crate::glam::{DVec3, DVec4};
use crate::{BernsteinError, BoxNet};

/// A tensor-product solid, `p(u,v,w) = Σᵢ Σⱼ Σₖ Bᵢˡ(u) Bⱼᵐ(v) Bₖⁿ(w) Pᵢⱼₖ`, made ready to be evaluated at many scattered
/// parameters.
///
/// For parameters that form a grid, [`BoxGridBatch`](crate::BoxGridBatch) takes a fraction of the time.
///
/// ```
/// use casteljau_bernstein::{BoxBatch, glam::DVec3};
/// let solid = BoxBatch::new(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], [1, 1, 1])?; // u·v·w
/// let [mut value, mut in_u, mut in_v, mut in_w] = [[0.0; 2]; 4];
/// let at = [DVec3::new(0.5, 0.25, 0.5), DVec3::ONE];
/// solid.evaluate(&at, [&mut value, &mut in_u, &mut in_v, &mut in_w])?;
/// assert_eq!((value, in_u, in_v, in_w), ([0.0625, 1.0], [0.125, 1.0], [0.25, 1.0], [0.125, 1.0]));
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
#[derive(Debug, Clone)]
pub struct BoxBatch<P>(Nets<P>);

impl<P: BatchPoint> BoxBatch<P> {
    /// Prepares the solid with the net `points` of the degrees l (with u), m (with v) and n (with w), in the order of
    /// [`BoxNet`].
    ///
    /// Cost: memory for five nets.
    ///
    /// # Errors
    /// [`BernsteinError::BoxNetLength`] unless there are (l+1)(m+1)(n+1) points, [`BernsteinError::Degree`] above
    /// [`MAX_DEGREE`](crate::MAX_DEGREE).
    pub fn new(points: &[P], degrees: [usize; 3]) -> Result<Self, BernsteinError> {
        BoxNet::new(points, degrees)?;
        Ok(Self(Nets::new(points, Shape { kind: Kind::Box, degrees })))
    }

    /// Degrees l, m and n.
    #[must_use]
    pub fn degrees(&self) -> [usize; 3] {
        self.0.shape.degrees
    }

    /// Values (K = 1), with first partial derivatives (K = 4) at the parameters (u, v, w), each kind in its own buffer: 1; u,
    /// v, w.
    ///
    /// Error: at most `4(l + m + n + 2k + 2)·u·scale`, k being 1 for derivatives, see [the crate](crate). Cost: one
    /// multiply-add a component and control point for each kind, three divisions; total degrees above 60 go one by one through
    /// [`BoxNet::partials`].
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
        BoxNet::validated(&self.0.points, self.degrees()).partials(at.x, at.y, at.z, jet);
    }
}

impl BoxBatch<DVec4> {
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
