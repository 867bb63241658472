//! Unit normals, a register of points at a time.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use super::horner::select;
use super::simd::Lanes;

/// Shares of derivatives up to this one count as zero, 2⁻⁴⁴: 2⁹ roundings.
const COLLAPSE: f64 = 256.0 * f64::EPSILON;

/// `a × b / |a × b|` for a and b scaled so that the largest differences of their nets lie in [1, 2); 0 where
/// a or b is at most [`COLLAPSE`] or the sine of the angle between them is.
///
/// `inside` says that the parameters lie in `[0, 1]`, so that no component of a and b is above 2.
#[inline(always)]
pub(super) fn unit_normal<S: Lanes>(simd: S, a: [S::f64s; 3], b: [S::f64s; 3], inside: bool) -> [S::f64s; 3] {
    let mut normal = a;
    for c in 0..3 {
        let (d, e) = ((c + 1) % 3, (c + 2) % 3);
        let product = simd.mul_f64s(simd.neg_f64s(a[e]), b[d]);
        normal[c] = simd.mul_add_f64s(a[d], b[e], product);
    }
    let length = square(simd, normal);
    let inverse = simd.div_f64s(simd.splat_f64s(1.0), simd.sqrt_f64s(length));
    let mut unit = normal;
    for c in 0..3 {
        unit[c] = simd.mul_f64s(normal[c], inverse);
    }
    // |a| and |b| being at most √12, a product longer than 12·COLLAPSE passes both tests.
    let enough = simd.splat_f64s(144.0 * COLLAPSE * COLLAPSE);
    if !inside || !simd.all(simd.greater_than_f64s(length, enough)) {
        let least = simd.splat_f64s(COLLAPSE * COLLAPSE);
        let (of_a, of_b) = (square(simd, a), square(simd, b));
        let spans = simd.greater_than_f64s(length, simd.mul_f64s(simd.mul_f64s(of_a, of_b), least));
        let long = simd.and_m64s(simd.greater_than_f64s(of_a, least), simd.greater_than_f64s(of_b, least));
        unit = select(simd, simd.and_m64s(spans, long), unit, [simd.splat_f64s(0.0); 3]);
    }
    unit
}

#[inline(always)]
fn square<S: Lanes>(simd: S, a: [S::f64s; 3]) -> S::f64s {
    simd.mul_add_f64s(a[2], a[2], simd.mul_add_f64s(a[1], a[1], simd.mul_f64s(a[0], a[0])))
}
