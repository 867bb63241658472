//! A curve rotated about the z axis into the full solid of revolution.

use casteljau_geom::Interval;
use casteljau_geom::glam::DVec4;
use casteljau_shape::RationalCurve;

use crate::{RationalHexahedron, SolidError};

/// Each control point of the disc of Q: (a, b, c, d, f) gives it the position (a Qx + b Qy, c Qx + d Qy) and the
/// weight f. Four quarter circles are the edges of the disc, and its center has a weight of its own.
const DISC: [[f64; 5]; 9] = [
    [1.0, 0.0, 0.0, 1.0, 1.0],    // (Qx, Qy)
    [1.0, 1.0, -1.0, 1.0, 1.0],   // (Qx+Qy, Qy−Qx)
    [0.0, 1.0, -1.0, 0.0, 2.0],   // (Qy, −Qx)
    [1.0, -1.0, 1.0, 1.0, 1.0],   // (Qx−Qy, Qx+Qy)
    [0.0, 0.0, 0.0, 0.0, 1.0],    // (0, 0)
    [-1.0, 1.0, -1.0, -1.0, 2.0], // (Qy−Qx, −Qx−Qy)
    [0.0, -1.0, 1.0, 0.0, 2.0],   // (−Qy, Qx)
    [-1.0, -1.0, 1.0, -1.0, 2.0], // (−Qx−Qy, Qx−Qy)
    [-1.0, 0.0, 0.0, -1.0, 4.0],  // (−Qx, −Qy)
];

impl RationalHexahedron {
    /// The rotational solid: every point of the curve, the meridian, becomes the disc around the z axis through it. One
    /// hexahedron of degrees (2, 2, n) is the full solid of revolution; a ball, for a meridian that is a half circle of
    /// degree 3.
    ///
    /// The section of constant w is the disc of radius `√(x² + y²)` at the height z of the meridian's point; the faces
    /// of constant u and of constant v lie on its circle, four quarters of it. The Jacobian is not negative where z
    /// rises along the meridian; it is 0 on the four edges along w, where two quarters meet in a straight angle, and
    /// where the meridian meets the axis. Volume: `π ∫ (x² + y²) dz`.
    ///
    /// The distance of a side from its circle is at most 8u of the radius where the meridian's control points lie in
    /// one half-plane through the axis, and `4(n + 4)·u` times the sum of the absolute contributions for any.
    ///
    /// ```
    /// use casteljau_solid::{ParametricSolid, RationalHexahedron, shape::RationalCurve, geom::glam::DVec3};
    /// let meridian = RationalCurve::new(&[DVec3::X, DVec3::new(1.0, 0.0, 2.0)], &[1.0, 1.0])?;
    /// let cylinder = RationalHexahedron::rotational(&meridian)?;
    /// assert_eq!(cylinder.point([0.5, 0.5, 0.5])?.z, 1.0);
    /// assert!((cylinder.point([0.0, 0.4, 0.5])?.truncate().length() - 1.0).abs() < 1e-15);
    /// assert!(cylinder.try_jacobian([0.5, 0.5, 0.5])? > 0.0);
    /// # Ok::<(), casteljau_solid::SolidError>(())
    /// ```
    ///
    /// # Errors
    /// [`ShapeError::Coordinate`](casteljau_shape::ShapeError::Coordinate) where a product with a weight leaves the
    /// range.
    ///
    /// Source: Samuelčík, "Modeling with rational Bézier solids", WSCG 2005.
    pub fn rotational(meridian: &RationalCurve) -> Result<Self, SolidError> {
        Self::rotational_with_center(meridian, 1.0)
    }

    /// As [`rotational`](Self::rotational) with another weight of the control points on the axis, `center` times the
    /// meridian's: the solid is the same, its parameters crowd toward the axis or away from it.
    ///
    /// # Errors
    /// [`SolidError::Construction`] unless `center` is positive, and those of [`rotational`](Self::rotational).
    pub fn rotational_with_center(meridian: &RationalCurve, center: f64) -> Result<Self, SolidError> {
        if !(center > 0.0 && center.is_finite()) {
            return Err(SolidError::Construction { what: "weight of the center", value: center });
        }
        let net = meridian.control_points();
        let mut points = Vec::with_capacity(DISC.len() * net.len());
        for (place, [a, b, c, d, factor]) in DISC.into_iter().enumerate() {
            let factor = if place == 4 { center } else { factor };
            points.extend(
                net.iter().map(|q| DVec4::new(a * q.x + b * q.y, c * q.x + d * q.y, q.z, q.w) * factor),
            );
        }
        let intervals = [Interval::UNIT, Interval::UNIT, meridian.interval()];
        Self::from_net(intervals, [2, 2, meridian.degree()], points)
    }
}
