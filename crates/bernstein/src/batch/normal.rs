//! Unit normals, a register of points at a time.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use super::simd::Lanes;

/// Shares of derivatives up to this one count as zero, 2⁻⁴⁴: 2⁹ roundings.
const COLLAPSE: f64 = 256.0 * f64::EPSILON;

/// `a × b / |a × b|` for a and b scaled so that the largest differences of their nets lie in [1, 2); 0 where
/// a or b is at most [`COLLAPSE`] or the sine of the angle between them is.
#[inline(always)]
pub(super) fn unit_normal<S: Lanes>(simd: S, a: [S::f64s; 3], b: [S::f64s; 3]) -> [S::f64s; 3] {
    let mut normal = a;
    for c in 0..3 {
        let (d, e) = ((c + 1) % 3, (c + 2) % 3);
        let product = simd.mul_f64s(simd.neg_f64s(a[e]), b[d]);
        normal[c] = simd.mul_add_f64s(a[d], b[e], product);
    }
    let least = simd.splat_f64s(COLLAPSE * COLLAPSE);
    let (square, of_a, of_b) = (square(simd, normal), square(simd, a), square(simd, b));
    let spans = simd.greater_than_f64s(square, simd.mul_f64s(simd.mul_f64s(of_a, of_b), least));
    let long = simd.and_m64s(simd.greater_than_f64s(of_a, least), simd.greater_than_f64s(of_b, least));
    let regular = simd.and_m64s(spans, long);
    let inverse = simd.div_f64s(simd.splat_f64s(1.0), simd.sqrt_f64s(square));
    for c in 0..3 {
        normal[c] = simd.select_f64s(regular, simd.mul_f64s(normal[c], inverse), simd.splat_f64s(0.0));
    }
    normal
}

#[inline(always)]
fn square<S: Lanes>(simd: S, a: [S::f64s; 3]) -> S::f64s {
    simd.mul_add_f64s(a[2], a[2], simd.mul_add_f64s(a[1], a[1], simd.mul_f64s(a[0], a[0])))
}
