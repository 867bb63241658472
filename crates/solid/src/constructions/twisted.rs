//! A patch swept along a curve and turned about the z axis on the way.

use std::f64::consts::PI;

use casteljau_bernstein::{BernsteinError, MAX_DEGREE, product};
use casteljau_geom::glam::{DVec3, DVec4};
use casteljau_shape::{Curve, Patch, RationalCurve, RationalPatch};

use crate::{Hexahedron, RationalHexahedron, SolidError};

/// How a swept patch is turned about the z axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Twist {
    /// Layer k of the control points is rotated by k times this angle, in radians; see [`Hexahedron::twisted`].
    PerLayer(f64),
    /// Every section is rotated as a rigid body, by 0 at the start to this angle at the end, in radians; see
    /// [`RationalHexahedron::rigidly_twisted`].
    Rigid(f64),
}

impl Hexahedron {
    /// The twisted solid: the [transitional](Self::transitional) solid of patch and curve with layer k of its control
    /// points, `Vᵢⱼₖ` for all i and j, rotated by k·α about the z axis.
    ///
    /// Between its ends a section is not congruent to the patch: the points of a section are convex combinations of
    /// points rotated by different angles. Along a straight curve with equally spaced control points it is rotated by
    /// `n·α/2` half way and shrunk toward the axis by `cosⁿ(α/2)`, n being the degree of the curve. For a twist
    /// without that see [`RationalHexahedron::rigidly_twisted`].
    ///
    /// ```
    /// use casteljau_solid::{Hexahedron, shape::{Curve, Patch}, geom::glam::DVec3};
    /// let square = Patch::new([1, 1], [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::new(1.0, 1.0, 0.0)])?;
    /// let line = Curve::new([DVec3::ZERO, DVec3::Z])?;
    /// let quarter = std::f64::consts::FRAC_PI_2;
    /// let twisted = Hexahedron::twisted(&square, &line, quarter)?;
    /// assert!(twisted.point([1.0, 0.0, 1.0]).distance(DVec3::new(0.0, 1.0, 1.0)) < 1e-15);
    /// // Half way √½ of the length is left.
    /// assert!((twisted.point([1.0, 0.0, 0.5]).truncate().length() - 0.5_f64.sqrt()).abs() < 1e-15);
    /// # Ok::<(), casteljau_solid::SolidError>(())
    /// ```
    ///
    /// # Errors
    /// [`SolidError::Construction`] where the angle is not finite, and those of [`transitional`](Self::transitional).
    ///
    /// Source: Samuelčík, "Modeling with rational Bézier solids", WSCG 2005.
    pub fn twisted(patch: &Patch, curve: &Curve, angle: f64) -> Result<Self, SolidError> {
        check_angle(angle)?;
        let swept = Self::transitional(patch, curve)?;
        let rotations = rotations(angle, swept.degrees()[2]);
        let turned =
            |(p, &[c, s]): (&DVec3, &[f64; 2])| DVec3::new(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
        let points: Vec<_> =
            swept.control_points().iter().zip(rotations.iter().cycle()).map(turned).collect();
        Self::from_net(swept.intervals(), swept.degrees(), points)
    }
}

impl RationalHexahedron {
    /// The rational twisted solid, as [`Hexahedron::twisted`].
    ///
    /// # Errors
    /// [`SolidError::Construction`] where the angle is not finite, and those of [`transitional`](Self::transitional).
    pub fn twisted(patch: &RationalPatch, curve: &RationalCurve, angle: f64) -> Result<Self, SolidError> {
        check_angle(angle)?;
        let swept = Self::transitional(patch, curve)?;
        let rotations = rotations(angle, swept.degrees()[2]);
        let turned =
            |(p, &[c, s]): (&DVec4, &[f64; 2])| DVec4::new(c * p.x - s * p.y, s * p.x + c * p.y, p.z, p.w);
        let points: Vec<_> =
            swept.control_points().iter().zip(rotations.iter().cycle()).map(turned).collect();
        Self::from_net(swept.intervals(), swept.degrees(), points)
    }

    /// The rigidly twisted solid: the [transitional](Self::transitional) solid of patch and curve, whose section at w is
    /// rotated by φ(w) about the z axis, φ running from 0 to `angle` (radians) over the interval of the curve.
    ///
    /// Every section is congruent to the patch, which [`twisted`](Self::twisted) does not keep. With the local
    /// parameter t the rotation is `e^{iφ} = q²ᵏ/|q|²ᵏ`, `q(t) = (1−t) + t·e^{iθ/2k}`, a rational function of degree 2k;
    /// k is the least one for which `|θ| < kπ`, so that its weights are positive. φ is θ/2 half way, and deviates from
    /// tθ by less than 0.143·k (0.016 for θ = π/2, 0.032 for π). The degree along w is that of the curve and 2k.
    ///
    /// ```
    /// use casteljau_solid::{RationalHexahedron, shape::{Curve, Patch}, geom::glam::DVec3};
    /// let square = Patch::new([1, 1], [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::new(1.0, 1.0, 0.0)])?;
    /// let line = Curve::new([DVec3::ZERO, DVec3::Z])?;
    /// let half_turn = RationalHexahedron::rigidly_twisted(&square.into(), &line.into(), std::f64::consts::PI)?;
    /// assert_eq!(half_turn.degrees(), [1, 1, 5]);
    /// let middle = half_turn.point([1.0, 0.0, 0.5])?;
    /// assert!(middle.distance(DVec3::new(0.0, 1.0, 0.5)) < 1e-15);
    /// # Ok::<(), casteljau_solid::SolidError>(())
    /// ```
    ///
    /// # Errors
    /// [`SolidError::Construction`] where the angle is not finite, [`SolidError::Kernel`] where the degree becomes
    /// larger than [`MAX_DEGREE`], and those of [`transitional`](Self::transitional).
    pub fn rigidly_twisted(
        patch: &RationalPatch,
        curve: &RationalCurve,
        angle: f64,
    ) -> Result<Self, SolidError> {
        check_angle(angle)?;
        let swept = Self::transitional(patch, curve)?;
        let [l, m, n] = swept.degrees();
        // Casts and sums stop at the largest number: it is refused all the same.
        let k = ((angle.abs() / PI).floor() + 1.0) as usize;
        let degree = n.saturating_add(k.saturating_mul(2));
        if degree > MAX_DEGREE {
            return Err(BernsteinError::Degree { degree, limit: MAX_DEGREE }.into());
        }
        let [cosine, sine, weight] = rational_rotation(angle, k)?;
        let times = |factor: &[f64], line: &[f64]| -> Result<Vec<f64>, SolidError> {
            let mut out = vec![0.0; degree + 1];
            product(factor, line, &mut out)?;
            Ok(out)
        };
        let mut points = Vec::with_capacity((l + 1) * (m + 1) * (degree + 1));
        for line in swept.control_points().chunks(n + 1) {
            let [x, y, z, w] = [0, 1, 2, 3].map(|axis| line.iter().map(|p| p[axis]).collect::<Vec<f64>>());
            let [xc, ys, xs, yc] =
                [times(&cosine, &x)?, times(&sine, &y)?, times(&sine, &x)?, times(&cosine, &y)?];
            let [z, w] = [times(&weight, &z)?, times(&weight, &w)?];
            points.extend((0..=degree).map(|k| DVec4::new(xc[k] - ys[k], xs[k] + yc[k], z[k], w[k])));
        }
        Self::from_net(swept.intervals(), [l, m, degree], points)
    }
}

/// The rational rotation by φ(t), from 0 at t = 0 to `angle` at t = 1: Bernstein coefficients of degree 2k of w·cos φ,
/// w·sin φ and of `w = |q|²ᵏ`, with `q = (1−t) + t·e^{iθ/2k}`; coefficient j of the first two is that of
/// `e^{iθ j/2k}`.
///
/// The weights are positive where `|θ| < kπ`; at `|θ| = kπ` every second one is 0, and the net is homogeneous.
///
/// ```
/// use casteljau_solid::rational_rotation;
/// let [cosine, _, weight] = rational_rotation(std::f64::consts::FRAC_PI_2, 1)?;
/// assert!((cosine[1] - 0.5_f64.sqrt()).abs() < 1e-15 && weight == [1.0, cosine[1], 1.0]);
/// # Ok::<(), casteljau_solid::SolidError>(())
/// ```
///
/// # Errors
/// [`SolidError::Construction`] where the angle is not finite or k is 0, [`SolidError::Kernel`] for degrees above
/// [`MAX_DEGREE`].
pub fn rational_rotation(angle: f64, k: usize) -> Result<[Vec<f64>; 3], SolidError> {
    check_angle(angle)?;
    if k == 0 {
        return Err(SolidError::Construction { what: "half degree of the rotation", value: 0.0 });
    }
    let degree = k.saturating_mul(2);
    if degree > MAX_DEGREE {
        return Err(BernsteinError::Degree { degree, limit: MAX_DEGREE }.into());
    }
    let share = |j: usize| angle * (j as f64 / degree as f64);
    let cosine: Vec<f64> = (0..=degree).map(|j| share(j).cos()).collect();
    let sine = (0..=degree).map(|j| share(j).sin()).collect();
    // |q|² has the coefficients 1, cos(θ/2k), 1.
    let square = [1.0, cosine[1], 1.0];
    let mut weight = square.to_vec();
    for power in 2..=k {
        let mut next = vec![0.0; 2 * power + 1];
        product(&square, &weight, &mut next)?;
        weight = next;
    }
    Ok([cosine, sine, weight])
}

/// Cosine and sine of k·α for k = 0…n.
fn rotations(angle: f64, n: usize) -> Vec<[f64; 2]> {
    (0..=n).map(|k| k as f64 * angle).map(|a| [a.cos(), a.sin()]).collect()
}

fn check_angle(angle: f64) -> Result<(), SolidError> {
    if angle.is_finite() {
        Ok(())
    } else {
        Err(SolidError::Construction { what: "angle of the twist", value: angle })
    }
}
