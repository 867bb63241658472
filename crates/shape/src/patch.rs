//! Tensor-product Bézier patches, polynomial and rational: construction and evaluation.

use casteljau_bernstein::{MAX_DEGREE, TensorNet, basis_barycentric};
use casteljau_geom::glam::{DVec3, DVec4};
use casteljau_geom::{BoundingBox, Interval, SurfaceJet, multi_indices, rounding_bound};

use crate::control_point::{checked, hull_box, largest_weight, lifted, points_box};
use crate::error::check_degree;
use crate::{ControlPoint, Parameters, ParametricSurface, ShapeError, SurfaceDomain};

/// A tensor-product Bézier patch over a rectangle `[a, b] × [c, d]`, `S(u,v) = Σᵢ Σⱼ Bᵢᵐ(x) Bⱼⁿ(y) Pᵢⱼ` with
/// `x = (u−a)/(b−a)`, `y = (v−c)/(d−c)`.
///
/// [`Patch`] is the polynomial one, [`RationalPatch`] the rational one, whose control points are homogeneous.
/// The control points stand in memory with j, which runs with v, fastest. All are finite, and the degrees at
/// most [`MAX_DEGREE`].
#[derive(Debug, Clone, PartialEq)]
pub struct BezierPatch<P> {
    intervals: [Interval; 2],
    degrees: [usize; 2],
    control_points: Vec<P>,
}

/// A polynomial Bézier patch, `S(u,v) = Σᵢ Σⱼ Bᵢᵐ(u) Bⱼⁿ(v) Pᵢⱼ` over `[0, 1]²` unless given other intervals.
pub type Patch = BezierPatch<DVec3>;

/// A rational Bézier patch, held homogeneous: (w·x, w·y, w·z, w).
///
/// Weights may be zero or negative. Where the denominator vanishes within its rounding bound the answer is
/// [`ShapeError::Evaluation`].
pub type RationalPatch = BezierPatch<DVec4>;

impl<P: ControlPoint> BezierPatch<P> {
    /// Makes a patch of points that were checked.
    pub(crate) fn checked(intervals: [Interval; 2], degrees: [usize; 2], control_points: Vec<P>) -> Self {
        debug_assert_eq!(control_points.len(), (degrees[0] + 1) * (degrees[1] + 1));
        Self { intervals, degrees, control_points }
    }

    /// The patch over a rectangle with the given control points, j fastest, polynomial or rational as they are.
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`ShapeError::NetSize`], [`ShapeError::Coordinate`], [`ShapeError::NoWeight`].
    pub fn from_net(
        intervals: [Interval; 2],
        degrees: [usize; 2],
        control_points: impl Into<Vec<P>>,
    ) -> Result<Self, ShapeError> {
        let control_points = control_points.into();
        check_net(degrees, control_points.len())?;
        Ok(Self::checked(intervals, degrees, checked(control_points)?))
    }

    /// Degrees m with u and n with v.
    #[must_use]
    pub fn degrees(&self) -> [usize; 2] {
        self.degrees
    }

    /// All control points, j fastest; homogeneous ones, (w·x, w·y, w·z, w), where the patch is rational.
    #[must_use]
    pub fn control_points(&self) -> &[P] {
        &self.control_points
    }

    /// Control point `Pᵢⱼ`; `None` beyond the net.
    #[must_use]
    pub fn control_point(&self, i: usize, j: usize) -> Option<P> {
        let [m, n] = self.degrees;
        if i <= m && j <= n { self.control_points.get(i * (n + 1) + j).copied() } else { None }
    }

    /// The intervals of u and of v.
    #[must_use]
    pub fn intervals(&self) -> [Interval; 2] {
        self.intervals
    }

    /// The same patch with its parameters running over other intervals.
    #[must_use]
    pub fn with_intervals(self, intervals: [Interval; 2]) -> Self {
        Self { intervals, ..self }
    }

    /// The parameters on `[0, 1]²`.
    pub(crate) fn local(&self, u: f64, v: f64) -> [f64; 2] {
        [self.intervals[0].local(u), self.intervals[1].local(v)]
    }

    pub(crate) fn net(&self) -> TensorNet<'_, P> {
        TensorNet::validated(&self.control_points, self.degrees)
    }

    /// A bound on the error of the denominator `w`, which was computed at (x, y).
    fn weight_error(&self, [x, y]: [f64; 2], w: f64) -> f64 {
        let [m, n] = self.degrees;
        // On the square the largest weight bounds them all, and is mostly enough to show that w is none.
        let rough = rounding_bound(m + n, 0, largest_weight(&self.control_points));
        let unit = 0.0..=1.0;
        if unit.contains(&x) && unit.contains(&y) && w.abs() > rough {
            return rough;
        }
        let (mut in_u, mut in_v) = ([0.0; MAX_DEGREE + 1], [0.0; MAX_DEGREE + 1]);
        basis_barycentric((1.0 - x).abs(), x.abs(), &mut in_u[..=m]);
        basis_barycentric((1.0 - y).abs(), y.abs(), &mut in_v[..=n]);
        let row =
            |points: &[P]| -> f64 { points.iter().zip(in_v).map(|(p, b)| b * p.homogeneous().w.abs()).sum() };
        let scale = self.control_points.chunks(n + 1).zip(in_u).map(|(points, b)| b * row(points)).sum();
        rounding_bound(m + n, 0, scale)
    }
}

/// From derivatives with respect to the local parameters to those with respect to the given ones.
fn per_unit_of(intervals: [Interval; 2], out: &mut [DVec3]) {
    let [a, b] = intervals.map(|i| i.length());
    if [a, b] == [1.0; 2] {
        return;
    }
    let order = out.len();
    for (derivative, [j, k]) in out.iter_mut().zip(multi_indices::<2>(order)) {
        for _ in 0..j {
            *derivative /= a;
        }
        for _ in 0..k {
            *derivative /= b;
        }
    }
}

impl<P: ControlPoint> ParametricSurface for BezierPatch<P> {
    fn domain(&self) -> SurfaceDomain {
        SurfaceDomain::Rectangle(self.intervals)
    }

    fn extended_partials(&self, u: f64, v: f64, out: &mut [DVec3]) -> Result<(), ShapeError> {
        let at = Parameters::Surface([u, v]).finite()?;
        let [x, y] = self.local(u, v);
        let kernel = |net: &mut [P]| self.net().partials(x, y, net);
        P::project::<2>(out, kernel, |w| self.weight_error([x, y], w))
            .map_err(|source| ShapeError::Evaluation { at, source })?;
        per_unit_of(self.intervals, out);
        Ok(())
    }

    fn weight(&self, u: f64, v: f64) -> f64 {
        let [x, y] = self.local(u, v);
        self.net().value(x, y).homogeneous().w
    }
}

impl Patch {
    /// The patch of degrees m with u and n with v over `[0, 1]²`; `Pᵢⱼ` is `control_points[i·(n+1) + j]`.
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`ShapeError::NetSize`], [`ShapeError::Coordinate`].
    pub fn new(degrees: [usize; 2], control_points: impl Into<Vec<DVec3>>) -> Result<Self, ShapeError> {
        Self::from_net([Interval::UNIT; 2], degrees, control_points)
    }

    /// Point `S(u,v)`; parameters outside the rectangle continue the polynomial.
    ///
    /// Error: at most 4(m+n+2)·u·ΣΣ|Bᵢᵐ Bⱼⁿ Pᵢⱼ|, u = 2⁻⁵³, besides the rounding of the local parameters, which
    /// are exact over `[0, 1]²`. Cost: O(mn), no allocation.
    #[must_use]
    pub fn point(&self, u: f64, v: f64) -> DVec3 {
        let [x, y] = self.local(u, v);
        self.net().value(x, y)
    }

    /// Point and partial derivatives up to order 2.
    ///
    /// Error: at most 4(m+n+2k+2)·u times the sum of the absolute contributions, k being the order. Cost:
    /// O(mn), no allocation.
    #[must_use]
    pub fn jet(&self, u: f64, v: f64) -> SurfaceJet {
        let mut partials = [DVec3::ZERO; 6];
        let [x, y] = self.local(u, v);
        self.net().partials(x, y, &mut partials);
        per_unit_of(self.intervals, &mut partials);
        partials.into()
    }

    /// Unit normal `∂u × ∂v / |∂u × ∂v|`; where that collapses, its limit on the way to the middle of the
    /// rectangle.
    ///
    /// `None` where derivatives up to order 2 do not decide; see [`SurfaceJet::normal_toward`].
    #[must_use]
    pub fn normal(&self, u: f64, v: f64) -> Option<DVec3> {
        self.try_normal(u, v).ok()
    }

    /// The box around the control points; by the convex hull property it contains the patch over its
    /// rectangle.
    #[must_use]
    pub fn bounding_box(&self) -> BoundingBox {
        points_box(&self.control_points)
    }
}

impl RationalPatch {
    /// The patch with the given control points and weights, in the same order, over `[0, 1]²`.
    ///
    /// A control point of weight 0 contributes nothing; for a point at infinity see
    /// [`from_homogeneous`](Self::from_homogeneous).
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`ShapeError::NetSize`], [`ShapeError::WeightCount`], [`ShapeError::NoWeight`],
    /// [`ShapeError::Coordinate`] (also of the products w·x).
    pub fn new(degrees: [usize; 2], control_points: &[DVec3], weights: &[f64]) -> Result<Self, ShapeError> {
        check_net(degrees, control_points.len())?;
        Self::from_homogeneous(degrees, lifted(control_points, weights)?)
    }

    /// The patch with homogeneous control points (w·x, w·y, w·z, w) over `[0, 1]²`.
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`ShapeError::NetSize`], [`ShapeError::NoWeight`], [`ShapeError::Coordinate`].
    pub fn from_homogeneous(
        degrees: [usize; 2],
        control_points: impl Into<Vec<DVec4>>,
    ) -> Result<Self, ShapeError> {
        Self::from_net([Interval::UNIT; 2], degrees, control_points)
    }

    /// Weights, in the order of the control points.
    pub fn weights(&self) -> impl ExactSizeIterator<Item = f64> {
        self.control_points.iter().map(|p| p.w)
    }

    /// Point `S(u,v) = ΣΣ Bᵢᵐ Bⱼⁿ wᵢⱼ Pᵢⱼ / ΣΣ Bᵢᵐ Bⱼⁿ wᵢⱼ`.
    ///
    /// Error: 4(m+n+2)·u·(ΣΣ|Bᵢᵐ Bⱼⁿ wᵢⱼ Pᵢⱼ| + |S|·ΣΣ|Bᵢᵐ Bⱼⁿ wᵢⱼ|)/|w|. Cost: O(mn), no allocation.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`] where a parameter is not finite, [`ShapeError::Evaluation`] at a pole.
    pub fn point(&self, u: f64, v: f64) -> Result<DVec3, ShapeError> {
        self.try_point(u, v)
    }

    /// Point and partial derivatives up to order 2, by the quotient rule.
    ///
    /// Error: at most 4(m+n+2k+2)·u times the sum of the absolute contributions. Cost: O(mn), no allocation.
    ///
    /// # Errors
    /// Those of [`point`](Self::point).
    pub fn jet(&self, u: f64, v: f64) -> Result<SurfaceJet, ShapeError> {
        self.try_jet(u, v)
    }

    /// Unit normal; where an edge collapses, its limit on the way to the middle of the rectangle.
    ///
    /// # Errors
    /// Those of [`try_normal`](ParametricSurface::try_normal).
    pub fn normal(&self, u: f64, v: f64) -> Result<DVec3, ShapeError> {
        self.try_normal(u, v)
    }

    /// The box around the control points, which contains the patch where all weights have one sign.
    ///
    /// `None` where they have not (or a control point lies at infinity): then the hull says nothing.
    #[must_use]
    pub fn hull_box(&self) -> Option<BoundingBox> {
        hull_box(&self.control_points)
    }
}

impl From<Patch> for RationalPatch {
    /// The same patch, all weights 1.
    fn from(patch: Patch) -> Self {
        let points = patch.control_points.iter().map(|p| p.extend(1.0)).collect();
        Self::checked(patch.intervals, patch.degrees, points)
    }
}

fn check_net(degrees: [usize; 2], given: usize) -> Result<(), ShapeError> {
    for degree in degrees {
        check_degree(degree)?;
    }
    let needed = (degrees[0] + 1) * (degrees[1] + 1);
    if needed == given { Ok(()) } else { Err(ShapeError::NetSize { degrees, needed, given }) }
}
