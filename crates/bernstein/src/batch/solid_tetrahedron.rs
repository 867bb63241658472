//! One tetrahedron at scattered parameters.

use super::BatchPoint;
use super::solid::{Kind, Nets, Shape};
use crate::glam::{DVec3, DVec4};
use crate::{BernsteinError, TetrahedronNet, last_barycentric};

/// A tetrahedron, `p(λ) = Σ n!/β! λ^β P_β`, |β| = n, made ready to be evaluated at many scattered parameters (λ₁, λ₂, λ₃), λ₄
/// being 1 − λ₁ − λ₂ − λ₃.
///
/// ```
/// use casteljau_bernstein::{TetrahedronBatch, glam::DVec3};
/// let mut net = [0.0; 10];
/// net[1] = 0.5;
/// let solid = TetrahedronBatch::new(&net, 2)?; // λ₁λ₂
/// let [mut value, mut first, mut second, mut third] = [[0.0; 2]; 4];
/// let at = [DVec3::new(0.5, 0.25, 0.125), DVec3::X];
/// solid.evaluate(&at, [&mut value, &mut first, &mut second, &mut third])?;
/// assert_eq!((value, first, second, third), ([0.125, 0.0], [0.25, 0.0], [0.5, 1.0], [0.0; 2]));
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
#[derive(Debug, Clone)]
pub struct TetrahedronBatch<P>(Nets<P>);

impl<P: BatchPoint> TetrahedronBatch<P> {
    /// Prepares the tetrahedron with the net `points` of degree n, in the order of [`TetrahedronNet`].
    ///
    /// Cost: memory for five nets.
    ///
    /// # Errors
    /// [`BernsteinError::SimplexNetLength`] unless there are (n+1)(n+2)(n+3)/6 points, [`BernsteinError::Degree`] above
    /// [`MAX_DEGREE`](crate::MAX_DEGREE).
    pub fn new(points: &[P], degree: usize) -> Result<Self, BernsteinError> {
        TetrahedronNet::new(points, degree)?;
        Ok(Self(Nets::new(points, Shape { kind: Kind::Tetrahedron, degrees: [degree; 3] })))
    }

    /// Degree n.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.0.shape.total()
    }

    /// Values (K = 1), with first partial derivatives (K = 4) at the parameters (λ₁, λ₂, λ₃), each kind in its own buffer:
    /// 1; λ₁, λ₂, λ₃, as [`TetrahedronNet::partials`](crate::SimplexNet::partials) has them.
    ///
    /// Error: at most `4(n + 2k + 2)·u·scale`, k being 1 for derivatives, see [the crate](crate). Cost: one multiply-add a
    /// component and control point for each kind, one division; degrees above 60 go one by one through
    /// [`TetrahedronNet::partials`](crate::SimplexNet::partials).
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
        let [x, y, z] = at.to_array();
        let lambda = [x, y, z, last_barycentric(&[x, y, z])];
        TetrahedronNet::validated(&self.0.points, self.degree()).partials(lambda, jet);
    }
}

impl TetrahedronBatch<DVec4> {
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
