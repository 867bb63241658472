//! Sums and products of polynomials.

use crate::binomial::binomials;
use crate::elevation::{elevate, elevate_tensor};
use crate::line::{check_length, counts, degree_of, net_size, strides};
use crate::space::last_lines;
use crate::{BernsteinError, Point};

/// Sum of two polynomials of any degrees, `p + q`, in the larger of the two degrees, which `out` has.
///
/// The one of lower degree is elevated. Error of each point: at most `4(n+2)·u` times its combination of
/// absolute values. Cost: as for [`elevate`].
///
/// # Errors
/// [`BernsteinError::NoPoints`], [`BernsteinError::Degree`], [`BernsteinError::BufferLength`].
pub fn sum<P: Point>(a: &[P], b: &[P], out: &mut [P]) -> Result<(), BernsteinError> {
    let (low, high) = if a.len() <= b.len() { (a, b) } else { (b, a) };
    check_length("out", out.len(), high.len())?;
    elevate(low, out)?;
    for (sum, &p) in out.iter_mut().zip(high) {
        *sum = *sum + p;
    }
    Ok(())
}

/// Sum of two tensor products of any degrees, along each axis in the larger of the two degrees.
///
/// `out` and `work`, whose content is lost, are nets of those degrees. Error of each point: at most
/// `4(Σ degrees + 2)·u` times its combination of absolute values.
///
/// # Errors
/// [`BernsteinError::Degree`], [`BernsteinError::BufferLength`].
pub fn sum_tensor<P: Point, const D: usize>(
    a: &[P],
    a_degrees: [usize; D],
    b: &[P],
    b_degrees: [usize; D],
    out: &mut [P],
    work: &mut [P],
) -> Result<(), BernsteinError> {
    let mut degrees = a_degrees;
    for (d, other) in degrees.iter_mut().zip(b_degrees) {
        *d = (*d).max(other);
    }
    check_length("work", work.len(), net_size(degrees)?)?;
    elevate_tensor(a, a_degrees, degrees, out)?;
    elevate_tensor(b, b_degrees, degrees, work)?;
    for (sum, &p) in out.iter_mut().zip(&*work) {
        *sum = *sum + p;
    }
    Ok(())
}

/// Product of a scalar polynomial of degree m and any other of degree n, in degree m + n:
/// `Qₖ = Σ C(m,i) C(n,j) / C(m+n,k) aᵢ Pⱼ` over i + j = k.
///
/// With numbers for points it is the product of two scalars; dot and cross products are sums of those of
/// components. Error of each point: at most `4(m+n+2)·u` times the same sum of absolute values: the binomial
/// coefficients are correct to 1 ulp at every degree, and no intermediate value exceeds C(m+n,k) times the
/// result's scale. Cost: (m+1)(n+1) multiplications a component; below degree 32 nothing is allocated, above
/// it the coefficients are.
///
/// ```
/// use casteljau_bernstein::product;
/// let mut square = [0.0; 3];
/// product(&[0.0, 1.0], &[0.0, 1.0], &mut square)?; // t·t
/// assert_eq!(square, [0.0, 0.0, 1.0]);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
///
/// # Errors
/// [`BernsteinError::NoPoints`]; [`BernsteinError::Degree`] where m + n is above
/// [`MAX_DEGREE`](crate::MAX_DEGREE); [`BernsteinError::BufferLength`] where `out` has not m + n + 1 places.
///
/// Source: Farouki and Rajan, *Algorithms for polynomials in Bernstein form*, CAGD 5, 1988.
pub fn product<P: Point>(a: &[f64], b: &[P], out: &mut [P]) -> Result<(), BernsteinError> {
    product_tensor(a, [degree_of(a)?], b, [degree_of(b)?], out)
}

/// Product of a scalar tensor product and any other: [`product`] along each axis.
///
/// The degrees add up. Error of each point: at most `(N + 8D)·u` times the sum of absolute values, N being the
/// number of products that meet in it, at most `Π (min(mᵢ,nᵢ) + 1)`; in practice about the root of that. Cost:
/// one multiplication a component for each pair of points.
///
/// # Errors
/// [`BernsteinError::Degree`]; [`BernsteinError::BufferLength`] for `a`, `b` and `out`.
pub fn product_tensor<P: Point, const D: usize>(
    a: &[f64],
    a_degrees: [usize; D],
    b: &[P],
    b_degrees: [usize; D],
    out: &mut [P],
) -> Result<(), BernsteinError> {
    let mut degrees = a_degrees;
    for (d, more) in degrees.iter_mut().zip(b_degrees) {
        *d = d.saturating_add(more);
    }
    check_length("out", out.len(), net_size(degrees)?)?;
    check_length("a", a.len(), net_size(a_degrees)?)?;
    check_length("b", b.len(), net_size(b_degrees)?)?;
    let (of_a, of_b, of_out) = (a_degrees.map(binomials), b_degrees.map(binomials), degrees.map(binomials));
    let strides = strides(counts(degrees));
    out.fill(P::ZERO);
    let Some(last) = D.checked_sub(1) else { return Ok(()) };
    for (i, a_line) in last_lines(a, a_degrees) {
        for (j, b_line) in last_lines(b, b_degrees) {
            let (mut weight, mut place) = (1.0, 0);
            for axis in 0..last {
                let k = i[axis] + j[axis];
                weight *= of_a[axis][i[axis]] * of_b[axis][j[axis]] / of_out[axis][k];
                place += k * strides[axis];
            }
            for (shift, (&x, &c)) in a_line.iter().zip(&*of_a[last]).enumerate() {
                let factor = x * (weight * c);
                let targets = &mut out[place + shift..];
                for ((sum, &p), &c) in targets.iter_mut().zip(b_line).zip(&*of_b[last]) {
                    *sum = *sum + p * (factor * c);
                }
            }
        }
    }
    // Along the last axis the divisor waits for the sum.
    for line in out.chunks_exact_mut(degrees[last] + 1) {
        for (p, &c) in line.iter_mut().zip(&*of_out[last]) {
            *p = *p / c;
        }
    }
    Ok(())
}
