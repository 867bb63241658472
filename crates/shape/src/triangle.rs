//! Bézier triangles, polynomial and rational: construction and evaluation.

use casteljau_bernstein::{TriangleNet, last_barycentric, simplex_count};
use casteljau_geom::glam::{DVec3, DVec4};
use casteljau_geom::{BoundingBox, SurfaceJet, rounding_bound};

use crate::control_point::{checked, hull_box, largest_weight, lifted, points_box};
use crate::error::check_degree;
use crate::{ControlPoint, Parameters, ParametricSurface, ShapeError, SurfaceDomain};

/// A Bézier triangle, `S(λ) = Σ n!/(i!j!k!) λ₁ⁱ λ₂ʲ λ₃ᵏ Pᵢⱼₖ` over `i + j + k = n`.
///
/// [`Triangle`] is the polynomial one, [`RationalTriangle`] the rational one, whose control points are
/// homogeneous. The parameters are (λ₁, λ₂); λ₃ = 1 − λ₁ − λ₂ is eliminated, in the derivatives too. Control
/// points stand in memory in descending lexicographic order, (n,0,0), (n−1,1,0), (n−1,0,1), …, (0,0,n). All
/// are finite, and the degree is at most [`MAX_DEGREE`](casteljau_bernstein::MAX_DEGREE).
#[derive(Debug, Clone, PartialEq)]
pub struct BezierTriangle<P> {
    degree: usize,
    control_points: Vec<P>,
}

/// A polynomial Bézier triangle.
///
/// ```
/// use casteljau_shape::{Triangle, geom::glam::DVec3};
/// let flat = Triangle::new(1, [DVec3::X, DVec3::Y, DVec3::ZERO])?;
/// assert_eq!(flat.point(0.5, 0.25), DVec3::new(0.5, 0.25, 0.0));
/// assert_eq!(flat.normal(0.5, 0.25), Some(DVec3::Z));
/// # Ok::<(), casteljau_shape::ShapeError>(())
/// ```
pub type Triangle = BezierTriangle<DVec3>;

/// A rational Bézier triangle, held homogeneous: (w·x, w·y, w·z, w).
///
/// Weights may be zero or negative. Where the denominator vanishes within its rounding bound the answer is
/// [`ShapeError::Evaluation`].
pub type RationalTriangle = BezierTriangle<DVec4>;

impl<P: ControlPoint> BezierTriangle<P> {
    /// Makes a triangle of points that were checked.
    pub(crate) fn checked(degree: usize, control_points: Vec<P>) -> Self {
        debug_assert_eq!(control_points.len(), simplex_count::<3>(degree));
        Self { degree, control_points }
    }

    /// The triangle of degree n with the given control points, polynomial or rational as they are.
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`ShapeError::TriangleSize`], [`ShapeError::Coordinate`],
    /// [`ShapeError::NoWeight`].
    pub fn from_net(degree: usize, control_points: impl Into<Vec<P>>) -> Result<Self, ShapeError> {
        let control_points = control_points.into();
        check_net(degree, control_points.len())?;
        Ok(Self::checked(degree, checked(control_points)?))
    }

    /// Degree n.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// All control points; homogeneous ones, (w·x, w·y, w·z, w), where the triangle is rational.
    #[must_use]
    pub fn control_points(&self) -> &[P] {
        &self.control_points
    }

    /// Control point `Pᵢⱼₖ`; `None` unless i + j + k is the degree.
    #[must_use]
    pub fn control_point(&self, i: usize, j: usize, k: usize) -> Option<P> {
        self.net().point([i, j, k])
    }

    pub(crate) fn net(&self) -> TriangleNet<'_, P> {
        TriangleNet::validated(&self.control_points, self.degree)
    }

    /// A bound on the error of the denominator `w`, which was computed at `lambda`.
    fn weight_error(&self, lambda: [f64; 3], w: f64) -> f64 {
        // On the triangle the largest weight bounds them all, and is mostly enough to show that w is none.
        let rough = rounding_bound(self.degree, 0, largest_weight(&self.control_points));
        if lambda.iter().all(|&l| l >= 0.0) && w.abs() > rough {
            return rough;
        }
        let weights: Vec<f64> = self.control_points.iter().map(|p| p.homogeneous().w.abs()).collect();
        let scale = TriangleNet::validated(&weights, self.degree).value(lambda.map(f64::abs));
        rounding_bound(self.degree, 0, scale)
    }
}

/// (λ₁, λ₂, λ₃) from the parameters.
fn barycentric(u: f64, v: f64) -> [f64; 3] {
    [u, v, last_barycentric(&[u, v])]
}

impl<P: ControlPoint> ParametricSurface for BezierTriangle<P> {
    fn domain(&self) -> SurfaceDomain {
        SurfaceDomain::Triangle
    }

    fn extended_partials(&self, u: f64, v: f64, out: &mut [DVec3]) -> Result<(), ShapeError> {
        let at = Parameters::Surface([u, v]).finite()?;
        let lambda = barycentric(u, v);
        let kernel = |net: &mut [P]| self.net().partials(lambda, net);
        P::project::<2>(out, kernel, |w| self.weight_error(lambda, w))
            .map_err(|source| ShapeError::Evaluation { at, source })
    }

    fn weight(&self, u: f64, v: f64) -> f64 {
        self.net().value(barycentric(u, v)).homogeneous().w
    }
}

impl Triangle {
    /// The triangle of degree n with the given control points, (n+1)(n+2)/2 of them.
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`ShapeError::TriangleSize`], [`ShapeError::Coordinate`].
    pub fn new(degree: usize, control_points: impl Into<Vec<DVec3>>) -> Result<Self, ShapeError> {
        Self::from_net(degree, control_points)
    }

    /// Point `S(λ₁, λ₂, 1−λ₁−λ₂)`; parameters outside the triangle continue the polynomial.
    ///
    /// Error: at most 4(n+2)·u·Σ|Bᵢⱼₖ Pᵢⱼₖ|, u = 2⁻⁵³. Cost: O(n²), no allocation.
    #[must_use]
    pub fn point(&self, lambda1: f64, lambda2: f64) -> DVec3 {
        self.net().value(barycentric(lambda1, lambda2))
    }

    /// Point and partial derivatives up to order 2 with respect to λ₁ and λ₂.
    ///
    /// Error: at most 4(n+2k+2)·u times the sum of the absolute contributions, k being the order. Cost: O(n²),
    /// no allocation.
    #[must_use]
    pub fn jet(&self, lambda1: f64, lambda2: f64) -> SurfaceJet {
        let mut partials = [DVec3::ZERO; 6];
        self.net().partials(barycentric(lambda1, lambda2), &mut partials);
        partials.into()
    }

    /// Unit normal `∂₁ × ∂₂ / |∂₁ × ∂₂|`; where that collapses, its limit on the way to the centroid.
    ///
    /// `None` where derivatives up to order 2 do not decide; see [`SurfaceJet::normal_toward`].
    #[must_use]
    pub fn normal(&self, lambda1: f64, lambda2: f64) -> Option<DVec3> {
        self.try_normal(lambda1, lambda2).ok()
    }

    /// The box around the control points; by the convex hull property it contains the triangle.
    #[must_use]
    pub fn bounding_box(&self) -> BoundingBox {
        points_box(&self.control_points)
    }
}

impl RationalTriangle {
    /// The triangle of degree n with the given control points and weights, in the same order.
    ///
    /// A control point of weight 0 contributes nothing; for a point at infinity see
    /// [`from_homogeneous`](Self::from_homogeneous).
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`ShapeError::TriangleSize`], [`ShapeError::WeightCount`],
    /// [`ShapeError::NoWeight`], [`ShapeError::Coordinate`] (also of the products w·x).
    pub fn new(degree: usize, control_points: &[DVec3], weights: &[f64]) -> Result<Self, ShapeError> {
        check_net(degree, control_points.len())?;
        Self::from_homogeneous(degree, lifted(control_points, weights)?)
    }

    /// The triangle with homogeneous control points (w·x, w·y, w·z, w).
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`ShapeError::TriangleSize`], [`ShapeError::NoWeight`],
    /// [`ShapeError::Coordinate`].
    pub fn from_homogeneous(
        degree: usize,
        control_points: impl Into<Vec<DVec4>>,
    ) -> Result<Self, ShapeError> {
        Self::from_net(degree, control_points)
    }

    /// Weights, in the order of the control points.
    pub fn weights(&self) -> impl ExactSizeIterator<Item = f64> {
        self.control_points.iter().map(|p| p.w)
    }

    /// Point `S(λ) = Σ Bᵢⱼₖ wᵢⱼₖ Pᵢⱼₖ / Σ Bᵢⱼₖ wᵢⱼₖ`.
    ///
    /// Error: 4(n+2)·u·(Σ|Bᵢⱼₖ wᵢⱼₖ Pᵢⱼₖ| + |S|·Σ|Bᵢⱼₖ wᵢⱼₖ|)/|w|. Cost: O(n²).
    ///
    /// # Errors
    /// [`ShapeError::Parameter`] where a parameter is not finite, [`ShapeError::Evaluation`] at a pole.
    pub fn point(&self, lambda1: f64, lambda2: f64) -> Result<DVec3, ShapeError> {
        self.try_point(lambda1, lambda2)
    }

    /// Point and partial derivatives up to order 2, by the quotient rule.
    ///
    /// Error: at most 4(n+2k+2)·u times the sum of the absolute contributions. Cost: O(n²).
    ///
    /// # Errors
    /// Those of [`point`](Self::point).
    pub fn jet(&self, lambda1: f64, lambda2: f64) -> Result<SurfaceJet, ShapeError> {
        self.try_jet(lambda1, lambda2)
    }

    /// Unit normal; where it collapses, its limit on the way to the centroid.
    ///
    /// # Errors
    /// Those of [`try_normal`](ParametricSurface::try_normal).
    pub fn normal(&self, lambda1: f64, lambda2: f64) -> Result<DVec3, ShapeError> {
        self.try_normal(lambda1, lambda2)
    }

    /// The box around the control points, which contains the triangle where all weights have one sign.
    ///
    /// `None` where they have not (or a control point lies at infinity): then the hull says nothing.
    #[must_use]
    pub fn hull_box(&self) -> Option<BoundingBox> {
        hull_box(&self.control_points)
    }
}

impl From<Triangle> for RationalTriangle {
    /// The same triangle, all weights 1.
    fn from(triangle: Triangle) -> Self {
        Self::checked(triangle.degree, triangle.control_points.iter().map(|p| p.extend(1.0)).collect())
    }
}

fn check_net(degree: usize, given: usize) -> Result<(), ShapeError> {
    check_degree(degree)?;
    let needed = simplex_count::<3>(degree);
    if needed == given { Ok(()) } else { Err(ShapeError::TriangleSize { degree, needed, given }) }
}
