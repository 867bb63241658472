//! A patch translated along a curve.

use casteljau_geom::Interval;
use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};
use casteljau_shape::{Curve, Patch, RationalCurve, RationalPatch};

use crate::{Hexahedron, RationalHexahedron, SolidError};

impl Hexahedron {
    /// The transitional solid, the patch S translated along the curve C: `F(u,v,w) = S(u,v) + C(w) − Q₀` with the
    /// control points `Vᵢⱼₖ = Pᵢⱼ + (Qₖ − Q₀)`.
    ///
    /// Its Jacobian is `(∂u S × ∂v S) · C′`, and its face at the start of w is the patch to the bit. The parameters run
    /// over the intervals of the patch and of the curve. Error of each control point: 2u of its terms.
    ///
    /// ```
    /// use casteljau_solid::{Hexahedron, shape::{Curve, Patch}, geom::glam::DVec3};
    /// let square = Patch::new([1, 1], [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::new(1.0, 1.0, 0.0)])?;
    /// let line = Curve::new([DVec3::X, DVec3::new(2.0, 0.0, 3.0)])?;
    /// let prism = Hexahedron::transitional(&square, &line)?;
    /// assert_eq!(prism.point([0.0, 1.0, 1.0]), DVec3::new(1.0, 1.0, 3.0));
    /// assert_eq!(prism.jet([0.5; 3]).jacobian(), 3.0);
    /// # Ok::<(), casteljau_solid::SolidError>(())
    /// ```
    ///
    /// # Errors
    /// [`ShapeError::Coordinate`](casteljau_shape::ShapeError::Coordinate) where the sum leaves the range.
    ///
    /// Source: Samuelčík, "Modeling with rational Bézier solids", WSCG 2005.
    pub fn transitional(patch: &Patch, curve: &Curve) -> Result<Self, SolidError> {
        let start = curve.control_points()[0];
        let points: Vec<DVec3> = patch
            .control_points()
            .iter()
            .flat_map(|&p| curve.control_points().iter().map(move |&q| p + (q - start)))
            .collect();
        let (intervals, degrees) =
            layout(patch.intervals(), patch.degrees(), curve.interval(), curve.degree());
        Self::from_net(intervals, degrees, points)
    }
}

impl RationalHexahedron {
    /// The rational transitional solid, as [`Hexahedron::transitional`], with the weights `wᵢⱼₖ = sᵢⱼ rₖ`.
    ///
    /// # Errors
    /// [`SolidError::Construction`] where the curve's first control point lies at infinity,
    /// [`ShapeError::Coordinate`](casteljau_shape::ShapeError::Coordinate) where a product leaves the range.
    pub fn transitional(patch: &RationalPatch, curve: &RationalCurve) -> Result<Self, SolidError> {
        let first = curve.control_points()[0];
        let start = curve.start().ok_or(SolidError::Construction {
            what: "weight of the curve's first control point",
            value: first.w,
        })?;
        // rₖ(Qₖ − Q₀), which is 0 to the bit for k = 0.
        let along: Vec<DVec4> = curve
            .control_points()
            .iter()
            .enumerate()
            .map(|(k, &q)| (if k == 0 { DVec3::ZERO } else { q.xyz() - start * q.w }).extend(q.w))
            .collect();
        let points: Vec<DVec4> = patch
            .control_points()
            .iter()
            .flat_map(|&p| along.iter().map(move |&q| (p.xyz() * q.w + q.xyz() * p.w).extend(p.w * q.w)))
            .collect();
        let (intervals, degrees) =
            layout(patch.intervals(), patch.degrees(), curve.interval(), curve.degree());
        Self::from_net(intervals, degrees, points)
    }
}

/// Intervals and degrees of a patch swept along a curve.
fn layout([u, v]: [Interval; 2], [l, m]: [usize; 2], w: Interval, n: usize) -> ([Interval; 3], [usize; 3]) {
    ([u, v, w], [l, m, n])
}
