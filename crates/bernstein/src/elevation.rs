//! The same polynomial at a higher degree.

use crate::{BernsteinError, MAX_DEGREE, Point};

/// Degree elevation from n to m: `Σ Bᵢⁿ Pᵢ = Σ Bⱼᵐ Qⱼ`, with n + 1 points given and m + 1 the length of `out`.
///
/// One degree at a time, `Qᵢ = (i Pᵢ₋₁ + (n+1−i) Pᵢ) / (n+1)`: convex combinations only. The end points are
/// kept to the bit. Error: at most `4(m+2)·u` times the same combination of absolute values. Cost:
/// (m−n)(m+n)/2 combinations.
///
/// # Errors
/// [`BernsteinError::NoPoints`] without points, [`BernsteinError::BufferLength`] where `out` is shorter than
/// `points`, [`BernsteinError::Degree`] above [`MAX_DEGREE`].
///
/// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 6.1.
pub fn elevate<P: Point>(points: &[P], out: &mut [P]) -> Result<(), BernsteinError> {
    let (count, given) = (points.len(), out.len());
    if count == 0 {
        return Err(BernsteinError::NoPoints);
    }
    if given < count {
        return Err(BernsteinError::BufferLength { buffer: "out", needed: count, given });
    }
    if given > MAX_DEGREE + 1 {
        return Err(BernsteinError::Degree { degree: given - 1, limit: MAX_DEGREE });
    }
    out[..count].copy_from_slice(points);
    for degree in count..given {
        out[degree] = out[degree - 1];
        for i in (1..degree).rev() {
            out[i] = (out[i - 1] * i as f64 + out[i] * (degree - i) as f64) / degree as f64;
        }
    }
    Ok(())
}
