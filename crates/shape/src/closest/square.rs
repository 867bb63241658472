//! The Bernstein coefficients of the squared distance, for queries that lie almost equally far from much of a
//! shape.

use casteljau_bernstein::binomial;
use casteljau_geom::UNIT_ROUNDOFF;
use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};

/// Beyond this total degree products of binomial coefficients leave the range of numbers.
const MOST_DEGREE: usize = 200;

/// A lower bound of `½|S − q|²` over a piece with positive weights, `½ min F_IJ/W_IJ` with
/// `|A − q w|² = Σ B_IJ F_IJ`, `w² = Σ B_IJ W_IJ`.
///
/// Where S lies on a sphere around q it is exact but for rounding. Cost: ((m+1)(n+1))²/2 scalar products.
pub(super) fn least_square(net: &[DVec4], [m, n]: [usize; 2], q: DVec3, scratch: &mut Vec<DVec4>) -> f64 {
    if m + n > MOST_DEGREE {
        return 0.0;
    }
    let stride = n + 1;
    scratch.clear();
    let mut largest = 0.0_f64;
    scratch.extend(net.iter().enumerate().map(|(place, p)| {
        let away = p.xyz() - q * p.w;
        largest = largest.max(away.length_squared() / (p.w * p.w));
        away.extend(p.w) * (binomial(m, place / stride) * binomial(n, place % stride))
    }));
    let mut least = f64::INFINITY;
    for row in 0..=2 * m {
        for column in 0..=2 * n {
            // The factor C(2m,I) C(2n,J) of both coefficients falls out of their quotient.
            let (mut square, mut weight) = (0.0, 0.0);
            for i in row.saturating_sub(m)..=row.min(m) {
                for j in column.saturating_sub(n)..=column.min(n) {
                    let a = scratch[i * stride + j];
                    let b = scratch[(row - i) * stride + column - j];
                    square += a.xyz().dot(b.xyz());
                    weight += a.w * b.w;
                }
            }
            least = least.min(square / weight);
        }
    }
    // Each coefficient is a mean of scalar products, none larger than `largest`.
    0.5 * (least - (2 * (m + n) + 16) as f64 * UNIT_ROUNDOFF * largest)
}
