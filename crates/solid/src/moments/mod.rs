//! Volume, centroid and second moments of solids, signed like det J.

mod gauss;
mod polynomial;
mod rational;

use casteljau_bernstein::glam::{DMat3, DVec3};
use casteljau_shape::{ControlPoint, ShapeError};

use crate::certificate::{SolidNet, center, scaled, weight};
use crate::{DEFAULT_OPERATIONS, SolidError};

/// Integrals over a solid, all with the signed measure det J: parts that are turned inside out count negatively.
///
/// Moments are about a point near the solid, so that a solid far from the origin keeps its digits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassProperties {
    /// `V = ∫ det J`, in cubes of the unit of the control points.
    pub volume: f64,
    /// The centroid, `c + ∫ (x − c) det J / V`; `None` where the volume is zero within its error.
    pub centroid: Option<DVec3>,
    /// The point c that the moments are about: the origin, or near the solid where that is far away.
    pub reference: DVec3,
    /// `∫ (x − c) det J`.
    pub first_moment: DVec3,
    /// `∫ (x − c)(x − c)ᵀ det J`.
    pub second_moment: DMat3,
    /// The error of the volume: a bound for polynomial solids, an estimate for rational ones.
    pub volume_error: f64,
    /// The same for each component of the first moment.
    pub first_error: f64,
    /// The same for each component of the second moment.
    pub second_error: f64,
}

impl MassProperties {
    /// `∫ (x − p) det J` about any point.
    #[must_use]
    pub fn first_moment_about(&self, p: DVec3) -> DVec3 {
        self.first_moment + (self.reference - p) * self.volume
    }

    /// `∫ (x − p)(x − p)ᵀ det J` about any point (Steiner's theorem).
    #[must_use]
    pub fn second_moment_about(&self, p: DVec3) -> DMat3 {
        let d = self.reference - p;
        let outer = |a: DVec3, b: DVec3| DMat3::from_cols(a * b.x, a * b.y, a * b.z);
        let mixed = outer(self.first_moment, d) + outer(d, self.first_moment);
        self.second_moment + mixed + outer(d, d) * self.volume
    }
}

/// Volume and moments of a solid, `∫ det J`, `∫ (x − c) det J`, `∫ (x − c)(x − c)ᵀ det J` over its domain.
///
/// Polynomial solids: the integral of a Bernstein polynomial is the mean of its coefficients times the measure of the domain,
/// so the answer is exact but for rounding, and the errors are proven bounds, the number of roundings times u times the sum of
/// the absolute contributions; `relative` is not needed.
///
/// Rational solids: Gauss's rule of 16 points an axis on cells that are halved, the worst first, until the estimated errors
/// are at most `relative` times `∫|det J|`, `∫|x − c||det J|` and `∫|x − c|²|det J|`. A tetrahedron or wedge is taken as the
/// hexahedron that covers it with sides collapsed. Weights are first evened out by a change of parameters, u → u/(u + s(1−u))
/// along each axis, which leaves the integrals as they are: 1e-12 is reached for weights from 1e-2 to 1e2. Cost: 0.6 ms a
/// cell, of which a solid with weights of one size needs 3, one with wild ones hundreds.
///
/// # Errors
/// [`SolidError::NetLength`] and [`SolidError::Shape`] for a net that is none or a `relative` not between 0 and 1;
/// [`SolidError::Coefficients`] for degrees about above 30 of a polynomial solid and [`SolidError::Multiplicities`] for a
/// single one above about 200; for rational solids [`SolidError::WeightZero`], [`SolidError::WeightUndecided`], and [`SolidError::Moments`] where the accuracy was not
/// reached.
///
/// ```
/// use casteljau_solid::{SolidNet, mass_properties};
/// use casteljau_solid::geom::glam::DVec3;
/// let points = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ZERO];
/// let tetrahedron = mass_properties(&SolidNet::Tetrahedron { points: &points, degree: 1 }, 1e-12)?;
/// assert!((tetrahedron.volume - 1.0 / 6.0).abs() <= tetrahedron.volume_error);
/// let centroid = tetrahedron.centroid.unwrap_or_default();
/// assert!(centroid.distance(DVec3::splat(0.25)) < 1e-15);
/// # Ok::<(), casteljau_solid::SolidError>(())
/// ```
pub fn mass_properties<P: ControlPoint>(
    net: &SolidNet<'_, P>,
    relative: f64,
) -> Result<MassProperties, SolidError> {
    net.check()?;
    if !(relative > 0.0 && relative < 1.0) {
        return Err(ShapeError::Accuracy { relative }.into());
    }
    let points: Vec<_> = net.points().iter().map(|p| p.homogeneous()).collect();
    let reference = DVec3::from(center(&points));
    if !P::RATIONAL {
        net.degrees().check_determinant(false)?;
        // Second moments are integrals of products with two coordinates.
        net.degrees().check_multiplicities(5)?;
        return Ok(polynomial::integrate(net, reference));
    }
    weight::check_one_sign(net, DEFAULT_OPERATIONS)?;
    rational::integrate(&points, net.degrees(), reference, relative)
}

/// The ten integrals in one row: 1; x, y, z; xx, xy, xz, yy, yz, zz.
type Integrals = [f64; 10];

/// From integrals over a solid `2^in_space` times as small, whose det J is `2^in_volume` times as small.
fn assembled(
    sums: Integrals,
    errors: Integrals,
    reference: DVec3,
    [in_volume, in_space]: [i32; 2],
) -> MassProperties {
    let [volume, x, y, z, xx, xy, xz, yy, yz, zz] = sums;
    let largest = |list: &[f64]| list.iter().fold(0.0_f64, |most, &e| most.max(e));
    let scaled_by = |power: i32| move |m: f64| scaled(m, in_volume + power * in_space);
    let (first, second) = (scaled_by(1), scaled_by(2));
    // By the integrals before they are scaled, which may leave the range of numbers.
    let centroid = (volume.abs() > errors[0])
        .then(|| reference + (DVec3::new(x, y, z) / volume).map(|m| scaled(m, in_space)));
    MassProperties {
        volume: scaled_by(0)(volume),
        centroid,
        reference,
        first_moment: DVec3::new(x, y, z).map(first),
        second_moment: DMat3::from_cols_array(&[xx, xy, xz, xy, yy, yz, xz, yz, zz].map(second)),
        volume_error: scaled_by(0)(errors[0]),
        first_error: first(largest(&errors[1..4])),
        second_error: second(largest(&errors[4..])),
    }
}
