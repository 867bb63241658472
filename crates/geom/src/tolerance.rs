//! The few numbers that comparisons are made with, each with a name and a reason.

/// Unit roundoff of f64, u = 2⁻⁵³: one operation has a relative error of at most u.
pub const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;

/// A first derivative counts as collapsed below this share of the jet's other derivatives, 2⁻⁴⁴ ≈ 6·10⁻¹⁴.
///
/// It lies 2⁹ roundings above u, so that derivatives that vanish but for rounding are recognised; the limit
/// that then stands in for the normal differs from it by an angle of this order, so nothing jumps where the
/// rule takes over.
pub const COLLAPSE: f64 = 512.0 * UNIT_ROUNDOFF;

/// The accuracy that every evaluation keeps, `4(d + 2k + 2)·u·scale`, d being the total degree, k the order
/// of derivative.
///
/// *scale* is the sum of the absolute values of everything added up.
#[must_use]
pub const fn rounding_bound(degree: usize, order: usize, scale: f64) -> f64 {
    (4 * (degree + 2 * order + 2)) as f64 * UNIT_ROUNDOFF * scale
}
