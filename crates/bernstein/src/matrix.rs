//! Kernels as matrices: `Q = M·P` for columns of control points. All are stored row by row.

use crate::elevation::elevate_along;
use crate::line::{check_length, net_size};
use crate::restriction::restrict_tensor;
use crate::{BernsteinError, binomial};

/// The matrix `M_B` of degree n, from control points to coefficients of the power basis on `[0, 1]`:
/// `p(t) = (1, t, …, tⁿ)·M_B·(P₀, …, Pₙ)ᵀ`, row k, column i being `(−1)ᵏ⁻ⁱ C(n,k) C(k,i)`.
///
/// Integers, exact while they are below 2⁵³ (all of them up to n = 33); beyond, relative error at most `2n·u`.
///
/// ```
/// use casteljau_bernstein::power_matrix;
/// let mut matrix = [0.0; 9];
/// power_matrix(2, &mut matrix)?;
/// assert_eq!(matrix, [1.0, 0.0, 0.0, -2.0, 2.0, 0.0, 1.0, -2.0, 1.0]);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
///
/// # Errors
/// [`BernsteinError::Degree`], [`BernsteinError::BufferLength`] unless `out` holds (n+1)² numbers.
///
/// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 5.7.
pub fn power_matrix(degree: usize, out: &mut [f64]) -> Result<(), BernsteinError> {
    check_length("out", out.len(), net_size([degree, degree])?)?;
    for (k, row) in out.chunks_exact_mut(degree + 1).enumerate() {
        for (i, entry) in row.iter_mut().enumerate() {
            let sign = if (k + i).is_multiple_of(2) { 1.0 } else { -1.0 };
            *entry = if i > k { 0.0 } else { sign * binomial(degree, k) * binomial(k, i) };
        }
    }
    Ok(())
}

/// The inverse of `M_B`, from coefficients of the power basis to control points: row j, column k is
/// `C(j,k)/C(n,k)`.
///
/// Relative error of an entry: at most u up to n = 50, `2n·u` beyond.
///
/// # Errors
/// [`BernsteinError::Degree`], [`BernsteinError::BufferLength`] unless `out` holds (n+1)² numbers.
pub fn inverse_power_matrix(degree: usize, out: &mut [f64]) -> Result<(), BernsteinError> {
    check_length("out", out.len(), net_size([degree, degree])?)?;
    for (j, row) in out.chunks_exact_mut(degree + 1).enumerate() {
        for (k, entry) in row.iter_mut().enumerate() {
            *entry = binomial(j, k) / binomial(degree, k);
        }
    }
    Ok(())
}

/// The matrix of degree elevation from n to m, with m + 1 rows and n + 1 columns; its rows add up to 1.
///
/// Error of an entry: that of [`elevate`](crate::elevate).
///
/// # Errors
/// [`BernsteinError::Degree`], [`BernsteinError::ElevatedDegree`] for m below n,
/// [`BernsteinError::BufferLength`] unless `out` holds (m+1)(n+1) numbers.
pub fn elevation_matrix(from: usize, to: usize, out: &mut [f64]) -> Result<(), BernsteinError> {
    check_length("out", out.len(), net_size([to, from])?)?;
    let mut unit = vec![0.0; net_size([from, from])?];
    fill_unit(from, &mut unit);
    elevate_along(&unit, [from, from], 0, to, out)
}

/// The matrix of restriction to `[a, b]`, (n+1)², row i being `Bⱼⁿ` polarised at n − i times a and i times b.
///
/// Error of an entry: that of [`restrict`](crate::restrict).
///
/// # Errors
/// [`BernsteinError::Degree`], [`BernsteinError::BufferLength`].
pub fn restriction_matrix(degree: usize, interval: [f64; 2], out: &mut [f64]) -> Result<(), BernsteinError> {
    let size = net_size([degree, degree])?;
    check_length("out", out.len(), size)?;
    let mut unit = vec![0.0; size];
    fill_unit(degree, &mut unit);
    restrict_tensor(&unit, [degree, degree], [interval, [0.0, 1.0]], out)
}

fn fill_unit(degree: usize, out: &mut [f64]) {
    for entry in out.iter_mut().step_by(degree + 2) {
        *entry = 1.0;
    }
}
