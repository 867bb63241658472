//! Tensor-product solids, polynomial and rational: construction and evaluation.

use casteljau_bernstein::{BoxNet, MAX_DEGREE, basis_barycentric};
use casteljau_geom::glam::{DVec3, DVec4};
use casteljau_geom::{BoundingBox, Interval, SolidJet, multi_indices, rounding_bound};
use casteljau_shape::control_net::{check_degree, checked, hull_box, largest_weight, lifted, points_box};
use casteljau_shape::{ControlPoint, Parameters, ShapeError};

use crate::{ParametricSolid, SolidDomain, SolidError};

/// A tensor-product solid over a box, `F(u,v,w) = Σᵢ Σⱼ Σₖ Bᵢˡ(x) Bⱼᵐ(y) Bₖⁿ(z) Pᵢⱼₖ`, x, y and z being u, v and w
/// brought from their intervals to `[0, 1]`.
///
/// [`Hexahedron`] is the polynomial one, [`RationalHexahedron`] the rational one, whose control points are
/// homogeneous. The control points stand in memory with k, which runs with w, fastest. All are finite, and the degrees
/// at most [`MAX_DEGREE`].
#[derive(Debug, Clone, PartialEq)]
pub struct BezierHexahedron<P> {
    intervals: [Interval; 3],
    degrees: [usize; 3],
    control_points: Vec<P>,
}

/// A polynomial tensor-product solid, over `[0, 1]³` unless given other intervals.
///
/// ```
/// use casteljau_solid::{Hexahedron, geom::glam::DVec3};
/// let cube = Hexahedron::unit_cube();
/// assert_eq!(cube.point([0.5, 0.25, 1.0]), DVec3::new(0.5, 0.25, 1.0));
/// assert_eq!(cube.jet([0.5; 3]).jacobian(), 1.0);
/// ```
pub type Hexahedron = BezierHexahedron<DVec3>;

/// A rational tensor-product solid, held homogeneous: (w·x, w·y, w·z, w).
///
/// Weights may be zero or negative. Where the denominator vanishes within its rounding bound the answer is
/// [`ShapeError::Evaluation`].
pub type RationalHexahedron = BezierHexahedron<DVec4>;

impl<P: ControlPoint> BezierHexahedron<P> {
    /// Makes a solid of points that were checked.
    pub(crate) fn checked(intervals: [Interval; 3], degrees: [usize; 3], control_points: Vec<P>) -> Self {
        debug_assert_eq!(control_points.len(), degrees.iter().map(|d| d + 1).product::<usize>());
        Self { intervals, degrees, control_points }
    }

    /// The solid over a box with the given control points, k fastest, polynomial or rational as they are.
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`SolidError::HexahedronSize`], [`ShapeError::Coordinate`], [`ShapeError::NoWeight`].
    pub fn from_net(
        intervals: [Interval; 3],
        degrees: [usize; 3],
        control_points: impl Into<Vec<P>>,
    ) -> Result<Self, SolidError> {
        let control_points = control_points.into();
        check_size(degrees, control_points.len())?;
        Ok(Self::checked(intervals, degrees, checked(control_points)?))
    }

    /// Degrees l with u, m with v and n with w.
    #[must_use]
    pub fn degrees(&self) -> [usize; 3] {
        self.degrees
    }

    /// All control points, k fastest; homogeneous ones, (w·x, w·y, w·z, w), where the solid is rational.
    #[must_use]
    pub fn control_points(&self) -> &[P] {
        &self.control_points
    }

    /// Control point `Pᵢⱼₖ`; `None` beyond the net.
    #[must_use]
    pub fn control_point(&self, [i, j, k]: [usize; 3]) -> Option<P> {
        let [l, m, n] = self.degrees;
        if i > l || j > m || k > n {
            return None;
        }
        self.control_points.get((i * (m + 1) + j) * (n + 1) + k).copied()
    }

    /// The intervals of u, v and w.
    #[must_use]
    pub fn intervals(&self) -> [Interval; 3] {
        self.intervals
    }

    /// The same solid with its parameters running over other intervals.
    #[must_use]
    pub fn with_intervals(self, intervals: [Interval; 3]) -> Self {
        Self { intervals, ..self }
    }

    /// The parameters on `[0, 1]³`.
    pub(crate) fn local(&self, at: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|axis| self.intervals[axis].local(at[axis]))
    }

    pub(crate) fn net(&self) -> BoxNet<'_, P> {
        BoxNet::validated(&self.control_points, self.degrees)
    }

    /// A bound on the error of the denominator `w`, which was computed at the local parameters `at`.
    fn weight_error(&self, at: [f64; 3], w: f64) -> f64 {
        let [l, m, n] = self.degrees;
        // In the box the largest weight bounds them all, and is mostly enough to show that w is none.
        let rough = rounding_bound(l + m + n, 0, largest_weight(&self.control_points));
        if at.iter().all(|x| (0.0..=1.0).contains(x)) && w.abs() > rough {
            return rough;
        }
        let mut rows = [[0.0; MAX_DEGREE + 1]; 3];
        for ((row, x), degree) in rows.iter_mut().zip(at).zip(self.degrees) {
            basis_barycentric((1.0 - x).abs(), x.abs(), &mut row[..=degree]);
        }
        let [in_u, in_v, in_w] = &rows;
        let line =
            |points: &[P]| -> f64 { points.iter().zip(in_w).map(|(p, b)| b * p.homogeneous().w.abs()).sum() };
        let slab = |points: &[P]| -> f64 { points.chunks(n + 1).zip(in_v).map(|(p, b)| b * line(p)).sum() };
        let slabs = self.control_points.chunks((m + 1) * (n + 1));
        rounding_bound(l + m + n, 0, slabs.zip(in_u).map(|(p, b)| b * slab(p)).sum())
    }
}

/// From derivatives with respect to the local parameters to those with respect to the given ones.
fn per_unit_of(intervals: [Interval; 3], out: &mut [DVec3]) {
    let lengths = intervals.map(|i| i.length());
    if lengths == [1.0; 3] {
        return;
    }
    let count = out.len();
    for (derivative, orders) in out.iter_mut().zip(multi_indices::<3>(count)) {
        for (length, order) in lengths.into_iter().zip(orders) {
            // One division after another: no power of the length leaves the range before the answer does.
            for _ in 0..order {
                *derivative /= length;
            }
        }
    }
}

impl<P: ControlPoint> ParametricSolid for BezierHexahedron<P> {
    fn domain(&self) -> SolidDomain {
        SolidDomain::Box(self.intervals)
    }

    fn extended_partials(&self, at: [f64; 3], out: &mut [DVec3]) -> Result<(), SolidError> {
        let place = Parameters::Solid(at).finite()?;
        let local @ [x, y, z] = self.local(at);
        let kernel = |net: &mut [P]| self.net().partials(x, y, z, net);
        P::project::<3>(out, kernel, |w| self.weight_error(local, w))
            .map_err(|source| ShapeError::Evaluation { at: place, source })?;
        per_unit_of(self.intervals, out);
        Ok(())
    }

    fn weight(&self, at: [f64; 3]) -> f64 {
        let [x, y, z] = self.local(at);
        self.net().value(x, y, z).homogeneous().w
    }
}

impl Hexahedron {
    /// The solid of degrees l with u, m with v and n with w over `[0, 1]³`; `Pᵢⱼₖ` is
    /// `control_points[(i·(m+1) + j)·(n+1) + k]`.
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`SolidError::HexahedronSize`], [`ShapeError::Coordinate`].
    pub fn new(degrees: [usize; 3], control_points: impl Into<Vec<DVec3>>) -> Result<Self, SolidError> {
        Self::from_net([Interval::UNIT; 3], degrees, control_points)
    }

    /// `F(u,v,w) = (u, v, w)`.
    #[must_use]
    pub fn unit_cube() -> Self {
        let corner =
            |bits: usize| DVec3::new((bits >> 2 & 1) as f64, (bits >> 1 & 1) as f64, (bits & 1) as f64);
        Self::checked([Interval::UNIT; 3], [1; 3], (0..8).map(corner).collect())
    }

    /// Point `F(u,v,w)`; parameters outside the box continue the polynomial.
    ///
    /// Error: at most 4(l+m+n+2)·u·ΣΣΣ|Bᵢˡ Bⱼᵐ Bₖⁿ Pᵢⱼₖ|, u = 2⁻⁵³, besides the rounding of the local parameters,
    /// which are exact over `[0, 1]³`. Cost: O(lmn), no allocation.
    #[must_use]
    pub fn point(&self, at: [f64; 3]) -> DVec3 {
        let [x, y, z] = self.local(at);
        self.net().value(x, y, z)
    }

    /// Point and first partial derivatives.
    ///
    /// Error: at most 4(l+m+n+2k+2)·u times the sum of the absolute contributions, k being the order. Cost: O(lmn),
    /// no allocation.
    #[must_use]
    pub fn jet(&self, at: [f64; 3]) -> SolidJet {
        let mut partials = [DVec3::ZERO; 4];
        let [x, y, z] = self.local(at);
        self.net().partials(x, y, z, &mut partials);
        per_unit_of(self.intervals, &mut partials);
        let [point, du, dv, dw] = partials;
        SolidJet { point, du, dv, dw }
    }

    /// The box around the control points; by the convex hull property it contains the solid.
    #[must_use]
    pub fn bounding_box(&self) -> BoundingBox {
        points_box(&self.control_points)
    }
}

impl RationalHexahedron {
    /// The solid with the given control points and weights, in the same order, over `[0, 1]³`.
    ///
    /// A control point of weight 0 contributes nothing; for a point at infinity see
    /// [`from_homogeneous`](Self::from_homogeneous).
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`SolidError::HexahedronSize`], [`ShapeError::WeightCount`],
    /// [`ShapeError::NoWeight`], [`ShapeError::Coordinate`] (also of the products w·x).
    pub fn new(degrees: [usize; 3], control_points: &[DVec3], weights: &[f64]) -> Result<Self, SolidError> {
        check_size(degrees, control_points.len())?;
        Self::from_homogeneous(degrees, lifted(control_points, weights)?)
    }

    /// The solid with homogeneous control points (w·x, w·y, w·z, w) over `[0, 1]³`.
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`SolidError::HexahedronSize`], [`ShapeError::NoWeight`], [`ShapeError::Coordinate`].
    pub fn from_homogeneous(
        degrees: [usize; 3],
        control_points: impl Into<Vec<DVec4>>,
    ) -> Result<Self, SolidError> {
        Self::from_net([Interval::UNIT; 3], degrees, control_points)
    }

    /// Weights, in the order of the control points.
    pub fn weights(&self) -> impl ExactSizeIterator<Item = f64> {
        self.control_points.iter().map(|p| p.w)
    }

    /// Point `F(u,v,w) = ΣΣΣ Bᵢˡ Bⱼᵐ Bₖⁿ wᵢⱼₖ Pᵢⱼₖ / ΣΣΣ Bᵢˡ Bⱼᵐ Bₖⁿ wᵢⱼₖ`.
    ///
    /// Error: 4(l+m+n+2)·u·(ΣΣΣ|B wᵢⱼₖ Pᵢⱼₖ| + |F|·ΣΣΣ|B wᵢⱼₖ|)/|w|. Cost: O(lmn), no allocation.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`] where a parameter is not finite, [`ShapeError::Evaluation`] at a pole.
    pub fn point(&self, at: [f64; 3]) -> Result<DVec3, SolidError> {
        self.try_point(at)
    }

    /// Point and first partial derivatives, by the quotient rule.
    ///
    /// Error: at most 4(l+m+n+2k+2)·u times the sum of the absolute contributions. Cost: O(lmn), no allocation.
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

impl From<Hexahedron> for RationalHexahedron {
    /// The same solid, all weights 1.
    fn from(solid: Hexahedron) -> Self {
        let points = solid.control_points.iter().map(|p| p.extend(1.0)).collect();
        Self::checked(solid.intervals, solid.degrees, points)
    }
}

fn check_size(degrees: [usize; 3], given: usize) -> Result<(), SolidError> {
    for degree in degrees {
        check_degree(degree)?;
    }
    let needed = degrees.iter().map(|d| d + 1).product();
    if needed == given { Ok(()) } else { Err(SolidError::HexahedronSize { degrees, needed, given }) }
}
