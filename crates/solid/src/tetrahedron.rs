//! Bézier tetrahedra, polynomial and rational: construction and evaluation.

use casteljau_bernstein::{TetrahedronNet, last_barycentric, simplex_count};
use casteljau_geom::glam::{DVec3, DVec4};
use casteljau_geom::{BoundingBox, SolidJet, rounding_bound};
use casteljau_shape::control_net::{check_degree, checked, hull_box, largest_weight, lifted, points_box};
use casteljau_shape::{ControlPoint, Parameters, ShapeError};

use crate::{ParametricSolid, SolidDomain, SolidError};

/// A Bézier tetrahedron, `F(λ) = Σ n!/β! λ^β P_β` over `|β| = n`, β of four entries.
///
/// [`Tetrahedron`] is the polynomial one, [`RationalTetrahedron`] the rational one, whose control points are
/// homogeneous. The parameters are (λ₁, λ₂, λ₃); λ₄ = 1 − λ₁ − λ₂ − λ₃ is eliminated, in the derivatives too. For a
/// parameter point in another domain tetrahedron, [`DomainTetrahedron`](crate::DomainTetrahedron) has its barycentric
/// coordinates. Control points stand in memory in descending lexicographic order, (n,0,0,0), (n−1,1,0,0), …, (0,0,0,n).
/// All are finite, and the degree is at most [`MAX_DEGREE`](casteljau_bernstein::MAX_DEGREE).
///
/// Source: Samuelčík, "Modeling with rational Bézier solids", WSCG 2005.
#[derive(Debug, Clone, PartialEq)]
pub struct BezierTetrahedron<P> {
    degree: usize,
    control_points: Vec<P>,
}

/// A polynomial Bézier tetrahedron.
///
/// ```
/// use casteljau_solid::{Tetrahedron, geom::glam::DVec3};
/// let corner = Tetrahedron::new(1, [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ZERO])?;
/// assert_eq!(corner.point([0.5, 0.25, 0.0]), DVec3::new(0.5, 0.25, 0.0));
/// assert_eq!(corner.jet([0.25; 3]).jacobian(), 1.0);
/// # Ok::<(), casteljau_solid::SolidError>(())
/// ```
pub type Tetrahedron = BezierTetrahedron<DVec3>;

/// A rational Bézier tetrahedron, held homogeneous: (w·x, w·y, w·z, w).
///
/// Weights may be zero or negative. Where the denominator vanishes within its rounding bound the answer is
/// [`ShapeError::Evaluation`].
pub type RationalTetrahedron = BezierTetrahedron<DVec4>;

impl<P: ControlPoint> BezierTetrahedron<P> {
    /// Makes a solid of points that were checked.
    pub(crate) fn checked(degree: usize, control_points: Vec<P>) -> Self {
        debug_assert_eq!(control_points.len(), simplex_count::<4>(degree));
        Self { degree, control_points }
    }

    /// The tetrahedron of degree n with the given control points, polynomial or rational as they are.
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`SolidError::TetrahedronSize`], [`ShapeError::Coordinate`],
    /// [`ShapeError::NoWeight`].
    pub fn from_net(degree: usize, control_points: impl Into<Vec<P>>) -> Result<Self, SolidError> {
        let control_points = control_points.into();
        check_size(degree, control_points.len())?;
        Ok(Self::checked(degree, checked(control_points)?))
    }

    /// Degree n.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// All control points; homogeneous ones, (w·x, w·y, w·z, w), where the solid is rational.
    #[must_use]
    pub fn control_points(&self) -> &[P] {
        &self.control_points
    }

    /// Control point `P_β`; `None` unless the entries of β add up to the degree.
    #[must_use]
    pub fn control_point(&self, index: [usize; 4]) -> Option<P> {
        self.net().point(index)
    }

    pub(crate) fn net(&self) -> TetrahedronNet<'_, P> {
        TetrahedronNet::validated(&self.control_points, self.degree)
    }

    /// A bound on the error of the denominator `w`, which was computed at `lambda`.
    fn weight_error(&self, lambda: [f64; 4], w: f64) -> f64 {
        // In the tetrahedron the largest weight bounds them all, and is mostly enough to show that w is none.
        let rough = rounding_bound(self.degree, 0, largest_weight(&self.control_points));
        if lambda.iter().all(|&l| l >= 0.0) && w.abs() > rough {
            return rough;
        }
        let weights: Vec<f64> = self.control_points.iter().map(|p| p.homogeneous().w.abs()).collect();
        let scale = TetrahedronNet::validated(&weights, self.degree).value(lambda.map(f64::abs));
        rounding_bound(self.degree, 0, scale)
    }
}

/// All four barycentric coordinates from the parameters.
pub(crate) fn barycentric([a, b, c]: [f64; 3]) -> [f64; 4] {
    [a, b, c, last_barycentric(&[a, b, c])]
}

impl<P: ControlPoint> ParametricSolid for BezierTetrahedron<P> {
    fn domain(&self) -> SolidDomain {
        SolidDomain::Tetrahedron
    }

    fn extended_partials(&self, at: [f64; 3], out: &mut [DVec3]) -> Result<(), SolidError> {
        let place = Parameters::Solid(at).finite()?;
        let lambda = barycentric(at);
        let kernel = |net: &mut [P]| self.net().partials(lambda, net);
        P::project::<3>(out, kernel, |w| self.weight_error(lambda, w))
            .map_err(|source| ShapeError::Evaluation { at: place, source })?;
        Ok(())
    }

    fn weight(&self, at: [f64; 3]) -> f64 {
        self.net().value(barycentric(at)).homogeneous().w
    }
}

impl Tetrahedron {
    /// The tetrahedron of degree n with the given control points, (n+1)(n+2)(n+3)/6 of them.
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`SolidError::TetrahedronSize`], [`ShapeError::Coordinate`].
    pub fn new(degree: usize, control_points: impl Into<Vec<DVec3>>) -> Result<Self, SolidError> {
        Self::from_net(degree, control_points)
    }

    /// Point `F(λ₁, λ₂, λ₃, 1−λ₁−λ₂−λ₃)`; parameters outside the tetrahedron continue the polynomial.
    ///
    /// Error: at most 4(n+2)·u·Σ|B_β P_β|, u = 2⁻⁵³. Cost: O(n³), no allocation.
    #[must_use]
    pub fn point(&self, at: [f64; 3]) -> DVec3 {
        self.net().value(barycentric(at))
    }

    /// Point and first partial derivatives with respect to λ₁, λ₂ and λ₃.
    ///
    /// Error: at most 4(n+2k+2)·u times the sum of the absolute contributions, k being the order. Cost: O(n³), no
    /// allocation.
    #[must_use]
    pub fn jet(&self, at: [f64; 3]) -> SolidJet {
        let mut partials = [DVec3::ZERO; 4];
        self.net().partials(barycentric(at), &mut partials);
        let [point, du, dv, dw] = partials;
        SolidJet { point, du, dv, dw }
    }

    /// The box around the control points; by the convex hull property it contains the solid.
    #[must_use]
    pub fn bounding_box(&self) -> BoundingBox {
        points_box(&self.control_points)
    }
}

impl RationalTetrahedron {
    /// The tetrahedron of degree n with the given control points and weights, in the same order.
    ///
    /// A control point of weight 0 contributes nothing; for a point at infinity see
    /// [`from_homogeneous`](Self::from_homogeneous).
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`SolidError::TetrahedronSize`], [`ShapeError::WeightCount`],
    /// [`ShapeError::NoWeight`], [`ShapeError::Coordinate`] (also of the products w·x).
    pub fn new(degree: usize, control_points: &[DVec3], weights: &[f64]) -> Result<Self, SolidError> {
        check_size(degree, control_points.len())?;
        Self::from_homogeneous(degree, lifted(control_points, weights)?)
    }

    /// The tetrahedron with homogeneous control points (w·x, w·y, w·z, w).
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`SolidError::TetrahedronSize`], [`ShapeError::NoWeight`],
    /// [`ShapeError::Coordinate`].
    pub fn from_homogeneous(
        degree: usize,
        control_points: impl Into<Vec<DVec4>>,
    ) -> Result<Self, SolidError> {
        Self::from_net(degree, control_points)
    }

    /// Weights, in the order of the control points.
    pub fn weights(&self) -> impl ExactSizeIterator<Item = f64> {
        self.control_points.iter().map(|p| p.w)
    }

    /// Point `F(λ) = Σ B_β w_β P_β / Σ B_β w_β`.
    ///
    /// Error: 4(n+2)·u·(Σ|B_β w_β P_β| + |F|·Σ|B_β w_β|)/|w|. Cost: O(n³), no allocation.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`] where a parameter is not finite, [`ShapeError::Evaluation`] at a pole.
    pub fn point(&self, at: [f64; 3]) -> Result<DVec3, SolidError> {
        self.try_point(at)
    }

    /// Point and first partial derivatives, by the quotient rule.
    ///
    /// Error: at most 4(n+2k+2)·u times the sum of the absolute contributions. Cost: O(n³), no allocation.
    ///
    /// # Errors
    /// Those of [`point`](Self::point).
    pub fn jet(&self, at: [f64; 3]) -> Result<SolidJet, SolidError> {
        self.try_jet(at)
    }

    /// The box around the control points, which contains the solid where all weights have one sign.
    ///
    /// `None` where they have not (or a control point lies at infinity): then the hull says nothing.
    #[must_use]
    pub fn hull_box(&self) -> Option<BoundingBox> {
        hull_box(&self.control_points)
    }
}

impl From<Tetrahedron> for RationalTetrahedron {
    /// The same solid, all weights 1.
    fn from(solid: Tetrahedron) -> Self {
        Self::checked(solid.degree, solid.control_points.iter().map(|p| p.extend(1.0)).collect())
    }
}

fn check_size(degree: usize, given: usize) -> Result<(), SolidError> {
    check_degree(degree)?;
    let needed = simplex_count::<4>(degree);
    if needed == given { Ok(()) } else { Err(SolidError::TetrahedronSize { degree, needed, given }) }
}
