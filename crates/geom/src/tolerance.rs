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

/// The largest power of two that is not above a positive number, and at least the smallest normal one: the unit in which
/// numbers of this size are scaled without rounding. 1 for what is no positive finite number.
///
/// ```
/// use casteljau_geom::power_of_two_below;
/// assert_eq!([5.0, 0.75, 0.0, f64::INFINITY].map(power_of_two_below), [4.0, 0.5, 1.0, 1.0]);
/// assert_eq!(power_of_two_below(1e-320), f64::MIN_POSITIVE);
/// ```
#[must_use]
pub fn power_of_two_below(x: f64) -> f64 {
    // The sign and fraction bits removed.
    if x > 0.0 && x.is_finite() {
        f64::from_bits(x.max(f64::MIN_POSITIVE).to_bits() & (0x7ff << 52))
    } else {
        1.0
    }
}
