//! Surfaces of revolution and the quadrics: sphere, cylinder, cone, torus, as rational patches.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use casteljau_geom::Interval;
use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};

use crate::conic::{piece_count, sin_cos};
use crate::control_point::checked;
use crate::{RationalCurve, RationalPatch, RationalTriangle, ShapeError};

impl RationalPatch {
    /// The surface that `profile` sweeps when it turns around an axis by `sweep` radians, in patches of at most
    /// a right angle each.
    ///
    /// u runs around the axis, quadratic, counter-clockwise seen from the tip of `direction`; v runs along the
    /// profile, with its degree and interval. Points of the profile on the axis make a collapsed edge.
    /// Neighbours share their edges to the bit.
    /// Error: each parallel is a circle to 32u of its radius, plus the rounding of the control points.
    ///
    /// # Errors
    /// [`ShapeError::Construction`] for an axis of length zero or an impossible sweep,
    /// [`ShapeError::Coordinate`].
    ///
    /// Source: Piegl and Tiller, *The NURBS Book*, 2nd ed., sec. 8.5.
    pub fn revolved(
        profile: &RationalCurve,
        origin: DVec3,
        direction: DVec3,
        sweep: f64,
    ) -> Result<Vec<Self>, ShapeError> {
        let axis = unit("length of the axis", direction)?;
        let pieces = piece_count(sweep)?;
        let share = |k: f64| sweep * k / pieces as f64;
        let weight = (0.5 * share(1.0)).cos();
        // Turned by an angle, and moved away from the axis by 1/weight while the weight takes it back.
        let turned = |p: DVec4, angle: f64, weight: f64| {
            let (sin, cos) = sin_cos(angle);
            let relative = p.xyz() - origin * p.w;
            let along = axis * axis.dot(relative);
            let radial = relative - along;
            let turned = radial * cos + axis.cross(radial) * sin;
            ((along + origin * p.w) * weight + turned).extend(p.w * weight)
        };
        let row =
            |angle: f64, weight: f64| profile.control_points().iter().map(move |&p| turned(p, angle, weight));
        let full = (sweep.abs() - 2.0 * PI).abs() <= 4.0 * f64::EPSILON * PI;
        let end = |k: usize| if k == 0 || (full && k == pieces) { 0.0 } else { share(k as f64) };
        let piece = |k: usize| {
            let middle = share(k as f64 + 0.5);
            let net = row(end(k), 1.0).chain(row(middle, weight)).chain(row(end(k + 1), 1.0)).collect();
            Ok(Self::checked([Interval::UNIT, profile.interval()], [2, profile.degree()], checked(net)?))
        };
        (0..pieces).map(piece).collect()
    }

    /// An eighth of the ellipsoid `center + X x + Y y + Z z`, `X² + Y² + Z² = 1`, between the half-axes x, y
    /// and z: a sphere where these are orthogonal and of one length.
    ///
    /// u runs from x to y, v from the arc between them up to the pole `center + z`, where the edge v = 1
    /// collapses to a point; the normal there is the limit. It points outwards for a right-handed x, y, z.
    ///
    /// # Errors
    /// [`ShapeError::Coordinate`].
    ///
    /// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 17.3.
    pub fn sphere_octant(center: DVec3, x: DVec3, y: DVec3, z: DVec3) -> Result<Self, ShapeError> {
        // The quarter circle in homogeneous form: (cos, sin, weight), the corner being (1, 1) times its weight.
        let quarter = [[1.0, 0.0, 1.0], [FRAC_1_SQRT_2, FRAC_1_SQRT_2, FRAC_1_SQRT_2], [0.0, 1.0, 1.0]];
        let mut net = Vec::with_capacity(9);
        for [cos_u, sin_u, weight_u] in quarter {
            for [cos_v, sin_v, weight_v] in quarter {
                let weight = weight_u * weight_v;
                let offset = (x * cos_u + y * sin_u) * cos_v + z * (weight_u * sin_v);
                net.push((center * weight + offset).extend(weight));
            }
        }
        Self::from_homogeneous([2, 2], net)
    }

    /// The sphere, as eight octants with outward normals.
    ///
    /// # Errors
    /// [`ShapeError::Construction`] unless the radius is positive, [`ShapeError::Coordinate`].
    pub fn sphere(center: DVec3, radius: f64) -> Result<Vec<Self>, ShapeError> {
        let r = positive("radius of the sphere", radius)?;
        let ring = [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y, DVec3::X];
        let quarters = || ring.windows(2);
        let north = quarters().map(|q| Self::sphere_octant(center, q[0] * r, q[1] * r, DVec3::Z * r));
        let south = quarters().map(|q| Self::sphere_octant(center, q[1] * r, q[0] * r, DVec3::NEG_Z * r));
        north.chain(south).collect()
    }

    /// The side of a cylinder: four patches from the circle around `base` to that around `base + axis`.
    ///
    /// Normals point outwards.
    ///
    /// # Errors
    /// [`ShapeError::Construction`] for an axis of length zero or a radius that is not positive,
    /// [`ShapeError::Coordinate`].
    pub fn cylinder(base: DVec3, axis: DVec3, radius: f64) -> Result<Vec<Self>, ShapeError> {
        let r = positive("radius of the cylinder", radius)?;
        Self::frustum(base, axis, [r, r])
    }

    /// The side of a cone with its tip at `base + axis`: four patches whose edge v = 1 collapses to the tip.
    ///
    /// Normals point outwards.
    ///
    /// # Errors
    /// As for [`cylinder`](Self::cylinder).
    pub fn cone(base: DVec3, axis: DVec3, radius: f64) -> Result<Vec<Self>, ShapeError> {
        let r = positive("radius of the cone", radius)?;
        Self::frustum(base, axis, [r, 0.0])
    }

    fn frustum(base: DVec3, axis: DVec3, [low, high]: [f64; 2]) -> Result<Vec<Self>, ShapeError> {
        let across = unit("length of the axis", axis)?.any_orthonormal_vector();
        let profile = [base + across * low, base + axis + across * high];
        Self::revolved(&RationalCurve::new(&profile, &[1.0; 2])?, base, axis, 2.0 * PI)
    }

    /// The torus around `center`, with the radius `major` of the ring and `minor` of the tube: sixteen patches,
    /// normals outwards.
    ///
    /// # Errors
    /// [`ShapeError::Construction`] for an axis of length zero or radii that are not positive,
    /// [`ShapeError::Coordinate`].
    pub fn torus(center: DVec3, axis: DVec3, major: f64, minor: f64) -> Result<Vec<Self>, ShapeError> {
        let (big, small) = (positive("radius of the ring", major)?, positive("radius of the tube", minor)?);
        let up = unit("length of the axis", axis)?;
        let across = up.any_orthonormal_vector();
        let tube = RationalCurve::circle(center + across * big, across * small, up * small)?;
        let mut patches = Vec::with_capacity(16);
        for profile in tube {
            let profile = profile.with_interval(Interval::UNIT);
            patches.extend(Self::revolved(&profile, center, up, 2.0 * PI)?);
        }
        Ok(patches)
    }
}

impl RationalTriangle {
    /// An eighth of the ellipsoid `center + X x + Y y + Z z`, `X² + Y² + Z² = 1`, as a triangle of degree 4
    /// without a singular point; see [`RationalPatch::sphere_octant`].
    ///
    /// λ₁ belongs to the corner `center + x`, λ₂ to `center + y`. The three edges are arcs of great circles.
    ///
    /// # Errors
    /// [`ShapeError::Coordinate`].
    ///
    /// Source: Farin, Piper and Worsey, "The octant of a sphere as a non-degenerate triangular Bézier patch",
    /// CAGD 4 (1987).
    pub fn sphere_octant(center: DVec3, x: DVec3, y: DVec3, z: DVec3) -> Result<Self, ShapeError> {
        let (r2, r3) = (2_f64.sqrt(), 3_f64.sqrt());
        let (a, b) = ((r3 - 1.0) / r3, (r3 + 1.0) / (2.0 * r3));
        let c = 1.0 - (5.0 - r2) * (7.0 - r3) / 46.0;
        let (w400, w310, w220) = (4.0 * r3 * (r3 - 1.0), 3.0 * r2, 4.0);
        let w211 = r2 / r3 * (3.0 + 2.0 * r2 - r3);
        // In the order of the net, (4,0,0) first: X, Y, Z and the weight.
        let net = [
            [1.0, 0.0, 0.0, w400],
            [1.0, a, 0.0, w310],
            [1.0, 0.0, a, w310],
            [b, b, 0.0, w220],
            [1.0, c, c, w211],
            [b, 0.0, b, w220],
            [a, 1.0, 0.0, w310],
            [c, 1.0, c, w211],
            [c, c, 1.0, w211],
            [a, 0.0, 1.0, w310],
            [0.0, 1.0, 0.0, w400],
            [0.0, 1.0, a, w310],
            [0.0, b, b, w220],
            [0.0, a, 1.0, w310],
            [0.0, 0.0, 1.0, w400],
        ];
        let homogeneous = net.map(|[p, q, r, w]| ((center + x * p + y * q + z * r) * w).extend(w));
        Self::from_homogeneous(4, homogeneous)
    }
}

fn positive(what: &'static str, value: f64) -> Result<f64, ShapeError> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(ShapeError::Construction { what, value }) }
}

fn unit(what: &'static str, v: DVec3) -> Result<DVec3, ShapeError> {
    v.try_normalize().ok_or(ShapeError::Construction { what, value: v.length() })
}
