//! Wedges, triangle × interval, polynomial and rational: construction and evaluation.

use casteljau_bernstein::{MAX_DEGREE, TriangleNet, WedgeNet, basis_barycentric, last_barycentric};
use casteljau_geom::glam::{DVec3, DVec4};
use casteljau_geom::{BoundingBox, Interval, SolidJet, multi_indices, rounding_bound};
use casteljau_shape::control_net::{check_degree, checked, hull_box, largest_weight, lifted, points_box};
use casteljau_shape::{ControlPoint, Parameters, ShapeError};

use crate::{ParametricSolid, SolidDomain, SolidError};

/// A Bézier wedge over a triangle × an interval, `F(λ, w) = Σ_β Σₖ n!/β! λ^β Bₖᵒ(z) P_βₖ` over `|β| = n`, z being w
/// brought from its interval to `[0, 1]`.
///
/// [`Wedge`] is the polynomial one, [`RationalWedge`] the rational one, whose control points are homogeneous. The
/// parameters are (λ₁, λ₂, w); λ₃ = 1 − λ₁ − λ₂ is eliminated, in the derivatives too. Control points stand in memory
/// with β descending lexicographically, (n,0,0), (n−1,1,0), …, (0,0,n), and k, which runs with w, fastest. All are
/// finite, and the degrees at most [`MAX_DEGREE`].
#[derive(Debug, Clone, PartialEq)]
pub struct BezierWedge<P> {
    height: Interval,
    degrees: [usize; 2],
    control_points: Vec<P>,
}

/// A polynomial wedge, over the height `[0, 1]` unless given another one.
///
/// ```
/// use casteljau_solid::{Wedge, geom::glam::DVec3};
/// let corners = [DVec3::X, DVec3::X + DVec3::Z, DVec3::Y, DVec3::Y + DVec3::Z, DVec3::ZERO, DVec3::Z];
/// let prism = Wedge::new([1, 1], corners)?;
/// assert_eq!(prism.point([0.5, 0.25, 0.75]), DVec3::new(0.5, 0.25, 0.75));
/// assert_eq!(prism.jet([0.5, 0.25, 0.75]).jacobian(), 1.0);
/// # Ok::<(), casteljau_solid::SolidError>(())
/// ```
pub type Wedge = BezierWedge<DVec3>;

/// A rational wedge, held homogeneous: (w·x, w·y, w·z, w).
///
/// Weights may be zero or negative. Where the denominator vanishes within its rounding bound the answer is
/// [`ShapeError::Evaluation`].
pub type RationalWedge = BezierWedge<DVec4>;

impl<P: ControlPoint> BezierWedge<P> {
    /// Makes a solid of points that were checked.
    pub(crate) fn checked(height: Interval, degrees: [usize; 2], control_points: Vec<P>) -> Self {
        debug_assert_eq!(control_points.len(), WedgeNet::<P>::count(degrees));
        Self { height, degrees, control_points }
    }

    /// The wedge over a height with the given control points, polynomial or rational as they are.
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`SolidError::WedgeSize`], [`ShapeError::Coordinate`], [`ShapeError::NoWeight`].
    pub fn from_net(
        height: Interval,
        degrees: [usize; 2],
        control_points: impl Into<Vec<P>>,
    ) -> Result<Self, SolidError> {
        let control_points = control_points.into();
        check_size(degrees, control_points.len())?;
        Ok(Self::checked(height, degrees, checked(control_points)?))
    }

    /// Degrees n of the triangle and o of the height.
    #[must_use]
    pub fn degrees(&self) -> [usize; 2] {
        self.degrees
    }

    /// All control points, k fastest; homogeneous ones, (w·x, w·y, w·z, w), where the solid is rational.
    #[must_use]
    pub fn control_points(&self) -> &[P] {
        &self.control_points
    }

    /// Control point `P_βₖ`; `None` beyond the net.
    #[must_use]
    pub fn control_point(&self, index: [usize; 3], k: usize) -> Option<P> {
        self.net().point(index, k)
    }

    /// The interval of w.
    #[must_use]
    pub fn height(&self) -> Interval {
        self.height
    }

    /// The same solid with w running over another interval.
    #[must_use]
    pub fn with_height(self, height: Interval) -> Self {
        Self { height, ..self }
    }

    pub(crate) fn net(&self) -> WedgeNet<'_, P> {
        WedgeNet::validated(&self.control_points, self.degrees)
    }

    /// All barycentric coordinates, and w on `[0, 1]`.
    pub(crate) fn local(&self, [a, b, w]: [f64; 3]) -> ([f64; 3], f64) {
        ([a, b, last_barycentric(&[a, b])], self.height.local(w))
    }

    /// A bound on the error of the denominator `w`, which was computed at `lambda` and z.
    fn weight_error(&self, lambda: [f64; 3], z: f64, w: f64) -> f64 {
        let [n, o] = self.degrees;
        // In the wedge the largest weight bounds them all, and is mostly enough to show that w is none.
        let rough = rounding_bound(n + o, 0, largest_weight(&self.control_points));
        if lambda.iter().all(|&l| l >= 0.0) && (0.0..=1.0).contains(&z) && w.abs() > rough {
            return rough;
        }
        let mut along = [0.0; MAX_DEGREE + 1];
        basis_barycentric((1.0 - z).abs(), z.abs(), &mut along[..=o]);
        let column = |points: &[P]| points.iter().zip(along).map(|(p, b)| b * p.homogeneous().w.abs()).sum();
        let columns: Vec<f64> = self.control_points.chunks(o + 1).map(column).collect();
        let scale = TriangleNet::validated(&columns, n).value(lambda.map(f64::abs));
        rounding_bound(n + o, 0, scale)
    }
}

/// From derivatives with respect to z to those with respect to w.
fn per_unit_of(height: Interval, out: &mut [DVec3]) {
    let length = height.length();
    if length == 1.0 {
        return;
    }
    let count = out.len();
    for (derivative, [_, _, order]) in out.iter_mut().zip(multi_indices::<3>(count)) {
        // One division after another: no power of the length leaves the range before the answer does.
        for _ in 0..order {
            *derivative /= length;
        }
    }
}

impl<P: ControlPoint> ParametricSolid for BezierWedge<P> {
    fn domain(&self) -> SolidDomain {
        SolidDomain::Wedge(self.height)
    }

    fn extended_partials(&self, at: [f64; 3], out: &mut [DVec3]) -> Result<(), SolidError> {
        let place = Parameters::Solid(at).finite()?;
        let (lambda, z) = self.local(at);
        let kernel = |net: &mut [P]| self.net().partials(lambda, z, net);
        P::project::<3>(out, kernel, |w| self.weight_error(lambda, z, w))
            .map_err(|source| ShapeError::Evaluation { at: place, source })?;
        per_unit_of(self.height, out);
        Ok(())
    }

    fn weight(&self, at: [f64; 3]) -> f64 {
        let (lambda, z) = self.local(at);
        self.net().value(lambda, z).homogeneous().w
    }
}

impl Wedge {
    /// The wedge of degrees n of the triangle and o of the height over `[0, 1]`.
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`SolidError::WedgeSize`], [`ShapeError::Coordinate`].
    pub fn new(degrees: [usize; 2], control_points: impl Into<Vec<DVec3>>) -> Result<Self, SolidError> {
        Self::from_net(Interval::UNIT, degrees, control_points)
    }

    /// Point `F(λ₁, λ₂, w)`; parameters outside the wedge continue the polynomial.
    ///
    /// Error: at most 4(n+o+2)·u times the sum of the absolute contributions, u = 2⁻⁵³, besides the rounding of z,
    /// which is exact over `[0, 1]`. Cost: O(n²o), no allocation.
    #[must_use]
    pub fn point(&self, at: [f64; 3]) -> DVec3 {
        let (lambda, z) = self.local(at);
        self.net().value(lambda, z)
    }

    /// Point and first partial derivatives with respect to λ₁, λ₂ and w.
    ///
    /// Error: at most 4(n+o+2k+2)·u times the sum of the absolute contributions, k being the order. Cost: O(n²o),
    /// no allocation.
    #[must_use]
    pub fn jet(&self, at: [f64; 3]) -> SolidJet {
        let mut partials = [DVec3::ZERO; 4];
        let (lambda, z) = self.local(at);
        self.net().partials(lambda, z, &mut partials);
        per_unit_of(self.height, &mut partials);
        let [point, du, dv, dw] = partials;
        SolidJet { point, du, dv, dw }
    }

    /// The box around the control points; by the convex hull property it contains the solid.
    #[must_use]
    pub fn bounding_box(&self) -> BoundingBox {
        points_box(&self.control_points)
    }
}

impl RationalWedge {
    /// The wedge with the given control points and weights, in the same order, over the height `[0, 1]`.
    ///
    /// A control point of weight 0 contributes nothing; for a point at infinity see
    /// [`from_homogeneous`](Self::from_homogeneous).
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`SolidError::WedgeSize`], [`ShapeError::WeightCount`], [`ShapeError::NoWeight`],
    /// [`ShapeError::Coordinate`] (also of the products w·x).
    pub fn new(degrees: [usize; 2], control_points: &[DVec3], weights: &[f64]) -> Result<Self, SolidError> {
        check_size(degrees, control_points.len())?;
        Self::from_homogeneous(degrees, lifted(control_points, weights)?)
    }

    /// The wedge with homogeneous control points (w·x, w·y, w·z, w) over the height `[0, 1]`.
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`SolidError::WedgeSize`], [`ShapeError::NoWeight`], [`ShapeError::Coordinate`].
    pub fn from_homogeneous(
        degrees: [usize; 2],
        control_points: impl Into<Vec<DVec4>>,
    ) -> Result<Self, SolidError> {
        Self::from_net(Interval::UNIT, degrees, control_points)
    }

    /// Weights, in the order of the control points.
    pub fn weights(&self) -> impl ExactSizeIterator<Item = f64> {
        self.control_points.iter().map(|p| p.w)
    }

    /// Point `F(λ, w) = ΣΣ B wᵦₖ Pᵦₖ / ΣΣ B wᵦₖ`.
    ///
    /// Error: 4(n+o+2)·u·(ΣΣ|B wᵦₖ Pᵦₖ| + |F|·ΣΣ|B wᵦₖ|)/|w|. Cost: O(n²o), no allocation.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`] where a parameter is not finite, [`ShapeError::Evaluation`] at a pole.
    pub fn point(&self, at: [f64; 3]) -> Result<DVec3, SolidError> {
        self.try_point(at)
    }

    /// Point and first partial derivatives, by the quotient rule.
    ///
    /// Error: at most 4(n+o+2k+2)·u times the sum of the absolute contributions. Cost: O(n²o), no allocation.
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

impl From<Wedge> for RationalWedge {
    /// The same solid, all weights 1.
    fn from(solid: Wedge) -> Self {
        let points = solid.control_points.iter().map(|p| p.extend(1.0)).collect();
        Self::checked(solid.height, solid.degrees, points)
    }
}

fn check_size(degrees: [usize; 2], given: usize) -> Result<(), SolidError> {
    for degree in degrees {
        check_degree(degree)?;
    }
    let needed = WedgeNet::<DVec3>::count(degrees);
    if needed == given { Ok(()) } else { Err(SolidError::WedgeSize { degrees, needed, given }) }
}
