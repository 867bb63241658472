//! Is det J positive? The Jacobian determinant of a solid, certified over the whole solid.

mod determinant;
mod feature;
mod net;
pub(crate) mod product;
mod sign;
mod subdivision;
mod trilinear;
pub(crate) mod weight;

use casteljau_bernstein::glam::DVec3;
use casteljau_shape::ControlPoint;

pub use determinant::JacobianCoefficients;
pub use feature::Feature;
pub use net::{SolidDegrees, SolidNet};

use crate::SolidError;
pub(crate) use determinant::{center, exponent, jacobian, scaled};
use sign::{Coefficients, Sign};

/// So many operations for the cutting [`jacobian_verdict`] is given by those who have no wish of their own: some tenths of
/// a second.
pub const DEFAULT_OPERATIONS: u64 = 100_000_000;

/// What is known of the sign of det J over a solid.
#[derive(Debug, Clone, PartialEq)]
pub enum JacobianVerdict {
    /// det J > 0 everywhere, boundary included.
    Positive,
    /// det J > 0 everywhere but on these corners, edges and faces, where it is zero. Parts of one another are not named.
    PositiveExcept(Vec<Feature>),
    /// det J < 0 at a place; or det J = 0 everywhere, when `value` is 0.
    ///
    /// A solid that is turned inside out, det J < 0 everywhere, is invalid too: reverse one of its axes, or exchange two
    /// of its vertices. Its volume is negative.
    Invalid {
        /// Parameters: (u, v, w), (λ₁, λ₂, λ₃), or (λ₁, λ₂, w).
        witness: [f64; 3],
        /// det J there.
        value: f64,
    },
    /// The operations did not suffice: a zero inside, or a touching one on the boundary, is never decided.
    Undecided {
        /// Parameters in the middle of the worst of the parts that are left.
        near: [f64; 3],
        /// det J, for a rational solid w⁴ det J, is not below this anywhere in that part,
        least: f64,
        /// nor above this.
        largest: f64,
    },
}

impl JacobianVerdict {
    /// Whether the solid is valid: det J positive, with or without exceptions on the boundary.
    #[must_use]
    pub const fn is_valid(&self) -> bool {
        matches!(self, Self::Positive | Self::PositiveExcept(_))
    }

    /// The corners, edges and faces where det J is zero, as far as the verdict names them.
    #[must_use]
    pub fn exceptions(&self) -> &[Feature] {
        match self {
            Self::PositiveExcept(features) => features,
            _ => &[],
        }
    }
}

/// The sign of `det J = det ∂(x,y,z)/∂(parameters)` over the whole of a solid, proven.
///
/// The Bernstein coefficients of det J (rational solids: of D = w⁴ det J, see [`JacobianCoefficients`]) come with bounds
/// on their rounding; with coefficients beyond their bounds everything that is said is certain:
///
/// * *Positive*: all coefficients of parts that cover the solid are greater than their bounds;
/// * *Invalid*: at a corner of a part, det J is below zero by more than its bound;
/// * *PositiveExcept*: the coefficients of the features named are zero, and over parts that cover the solid none is
///   negative. Then det J is zero on a face exactly where all coefficients of the face are, and positive elsewhere.
///
/// *Zero* here means zero within the rounding of the control points: a coefficient counts as zero if it is not larger than
/// its rounding and the change that 4u of the size of each control point and of each weight make to it
/// ([`JacobianCoefficients::tolerances`]; u = 2⁻⁵³). So rotational solids, whose control points are rounded sums, have the
/// edges that they should; a solid that is deeper negative is invalid, and one all of whose coefficients count as zero is
/// flat, invalid with the value 0. `Positive` and a negative witness are true of the very numbers given.
///
/// Parts are cut in Bernstein form, the worst first, until all are decided or so many `operations` (multiplications,
/// about) are spent: the same answer on every machine. Never decided are zeros that touch from above inside the solid or in
/// the middle of a feature, and zeros of a higher order on a feature where coefficients beside it stay negative in all
/// parts. Cost: a trilinear polynomial hexahedron mostly below 0.4 µs; others that of their coefficients, which no budget bounds, and
/// each cut some passes through these. The coefficients take a product for each pair of control points: milliseconds for a
/// triquadratic one, some tenths of a second for a rational one of degrees (8, 8, 8), a minute at (20, 20, 20).
///
/// # Errors
/// [`SolidError::NetLength`] and [`SolidError::Shape`] for a net that is none; [`SolidError::Coefficients`] for degrees about
/// above 30, 20 for rational solids, and [`SolidError::Multiplicities`] for a single one above 200; [`SolidError::WeightZero`] where the weight of a rational solid vanishes, [`SolidError::WeightUndecided`] where that could not be found out. Weights may have any
/// sign as long as their function has one.
///
/// ```
/// use casteljau_solid::{DEFAULT_OPERATIONS, JacobianVerdict, SolidNet, jacobian_verdict};
/// use casteljau_solid::geom::glam::DVec3;
/// let mut points: Vec<DVec3> = (0..8).map(|c| DVec3::new((c >> 2) as f64, (c >> 1 & 1) as f64, (c & 1) as f64)).collect();
/// let verdict = |points: &[DVec3]| {
///     jacobian_verdict(&SolidNet::Hexahedron { points, degrees: [1, 1, 1] }, DEFAULT_OPERATIONS)
/// };
/// assert_eq!(verdict(&points)?, JacobianVerdict::Positive);
/// points[7] = points[3]; // An edge collapses.
/// assert_eq!(verdict(&points)?.exceptions()[0].to_string(), "edge v = 1, w = 1");
/// points[7] = DVec3::splat(-1.0);
/// assert!(!verdict(&points)?.is_valid());
/// # Ok::<(), casteljau_solid::SolidError>(())
/// ```
///
/// Sources: Gain and Dodgson, "Preventing self-intersection under free-form deformation", IEEE TVCG 7 (2001); Johnen,
/// Remacle and Geuzaine, "Geometrical validity of curvilinear finite elements", J. Comput. Phys. 233 (2013).
pub fn jacobian_verdict<P: ControlPoint>(
    net: &SolidNet<'_, P>,
    operations: u64,
) -> Result<JacobianVerdict, SolidError> {
    net.check()?;
    if let SolidNet::Hexahedron { points, degrees: [1, 1, 1] } = net
        && let Some(verdict) = trilinear_verdict(points)
    {
        return Ok(verdict);
    }
    net.degrees().check_determinant(P::RATIONAL)?;
    if P::RATIONAL {
        weight::check_one_sign(net, operations)?;
    }
    let determinant = JacobianCoefficients::of(net);
    let (values, rounding, tolerances, exponent) = determinant.raw();
    let sign =
        Coefficients { degrees: determinant.degrees(), values, rounding, tolerances }.sign(operations)?;
    Ok(match sign {
        Sign::Positive => JacobianVerdict::Positive,
        Sign::PositiveExcept(features) => JacobianVerdict::PositiveExcept(features),
        Sign::NotPositive { witness, value } => {
            let weight = if P::RATIONAL { weight::value(net, witness) } else { 1.0 };
            let scaled = scaled(value, exponent) / weight / weight / weight / weight;
            // Negative stays negative, whatever the size.
            let nearest = if value < 0.0 { -f64::MIN_POSITIVE } else { 0.0 };
            JacobianVerdict::Invalid { witness, value: scaled.clamp(f64::MIN, nearest) }
        }
        Sign::Undecided { near, least, largest } => JacobianVerdict::Undecided {
            near,
            least: scaled(least, exponent),
            largest: scaled(largest, exponent),
        },
    })
}

/// The short way for polynomial hexahedra of degree 1.
fn trilinear_verdict<P: ControlPoint>(points: &[P]) -> Option<JacobianVerdict> {
    let points: &[P; 8] = points.try_into().ok()?;
    if P::RATIONAL {
        return None;
    }
    trilinear::verdict(&std::array::from_fn(|place| {
        let [x, y, z] = *points[place].components() else { return DVec3::NAN };
        DVec3::new(x, y, z)
    }))
}
