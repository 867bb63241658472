//! Angles between directions.

use glam::DVec3;

/// Angle between two directions in degrees, `atan2(|a × b|, a · b)`, from 0 to 180.
///
/// The lengths do not matter; it is right for small angles, where the arc cosine loses half its digits. 0
/// where one of the vectors is zero.
/// Error: a few u relative to the angle, plus that of the vectors.
#[must_use]
pub fn angle_degrees(a: DVec3, b: DVec3) -> f64 {
    // Scaled first, so that neither tiny nor huge vectors leave the range of numbers.
    let (a, b) = (a / a.abs().max_element(), b / b.abs().max_element());
    if a.is_nan() || b.is_nan() {
        return 0.0;
    }
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_angles_keep_their_digits() {
        let tiny = 1e-11_f64;
        let a = angle_degrees(DVec3::X, DVec3::new(1.0, tiny, 0.0));
        assert!((a - tiny.to_degrees()).abs() <= 8.0 * crate::UNIT_ROUNDOFF * a);
        assert_eq!(angle_degrees(DVec3::X * 1e-300, DVec3::Y * 1e300), 90.0);
        assert_eq!(angle_degrees(DVec3::X, -DVec3::X), 180.0);
        assert_eq!(angle_degrees(DVec3::X, DVec3::ZERO), 0.0);
    }
}
