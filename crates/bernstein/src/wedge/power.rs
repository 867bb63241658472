//! The power basis, integrals and moments over a wedge.

use super::WedgeNet;
use crate::error::least_length;
use crate::line::check_length;
use crate::simplex::{
    Compensated, SimplexNet, measure, moment_weight, multi_indices, simplex_count, simplex_from_power,
};
use crate::{BernsteinError, Point, binomial};

impl<P: Point> WedgeNet<'_, P> {
    /// Coefficients of the monomials `λ₁ᵃ λ₂ᵇ wᶜ`, λ₃ being 1 − λ₁ − λ₂, at the places
    /// `simplex_partial_index([a, b])·(o+1) + c`: as [`SimplexNet::to_power`] for every layer, and
    /// `C(o,c) Δᶜ` along the height.
    ///
    /// Error: at most `4(n+o+2)·u` times the same with every difference taken absolutely. `scratch` holds two layers
    /// of (n+1)(n+2)/2 points.
    ///
    /// # Errors
    /// [`BernsteinError::WedgeNetLength`], [`BernsteinError::BufferLength`].
    pub fn to_power(&self, out: &mut [P], scratch: &mut [P]) -> Result<(), BernsteinError> {
        let [n, o] = self.checked()?.degrees();
        check_length("out", out.len(), self.points().len())?;
        out.copy_from_slice(self.points());
        for row in out.chunks_exact_mut(o + 1) {
            for level in 1..=o {
                for k in (level..=o).rev() {
                    row[k] = row[k] - row[k - 1];
                }
            }
            for (k, p) in row.iter_mut().enumerate() {
                *p = *p * binomial(o, k);
            }
        }
        each_layer(n, o, out, scratch, |layer, converted| {
            SimplexNet::<P, 3>::validated(layer, n).to_power(converted)
        })
    }

    /// Integral over the wedge in its parameters, `∫ p dλ₁ dλ₂ dw`: half the mean of the control points.
    ///
    /// Error: at most `8u` times the same of absolute values. Cost: each point is read once.
    #[must_use]
    pub fn integral(&self) -> P {
        self.moment([0; 3], 0)
    }

    /// Moment `∫ λ₁ᵃ λ₂ᵇ λ₃ᶜ wᵈ p dλ₁ dλ₂ dw`.
    ///
    /// Sums are compensated. Error: at most `(4k+8)·u` times the same of absolute values, k = a + b + c + d.
    #[must_use]
    pub fn moment(&self, exponents: [usize; 3], in_height: usize) -> P {
        let [n, o] = self.degrees();
        let along = [0, in_height];
        let mut sum = Compensated::new();
        let rows = self.points().chunks_exact(o.saturating_add(1));
        for (row, index) in rows.zip(multi_indices::<3>(n)) {
            let weight = moment_weight(n, index, exponents);
            for (k, &p) in row.iter().enumerate() {
                sum.add(p * (weight * moment_weight(o, [o - k, k], along)));
            }
        }
        sum.value() / (measure(n, exponents) * measure(o, along))
    }
}

/// Control points over a wedge from coefficients of monomials, the inverse of [`WedgeNet::to_power`].
///
/// Error of each point: at most `4(n+o+2)·u` times its combination of absolute values. `scratch` holds two layers of
/// (n+1)(n+2)/2 points.
///
/// # Errors
/// [`BernsteinError::Degree`], [`BernsteinError::WedgeNetLength`], [`BernsteinError::BufferLength`].
///
/// ```
/// use casteljau_bernstein::{WedgeNet, wedge_from_power};
/// let mut points = [0.0; 6];
/// wedge_from_power(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0], [1, 1], &mut points, &mut [0.0; 6])?; // λ₁w
/// assert_eq!(points, [0.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
pub fn wedge_from_power<P: Point>(
    coefficients: &[P],
    degrees: [usize; 2],
    out: &mut [P],
    scratch: &mut [P],
) -> Result<(), BernsteinError> {
    let [n, o] = WedgeNet::new(coefficients, degrees)?.degrees();
    check_length("out", out.len(), coefficients.len())?;
    out.copy_from_slice(coefficients);
    for row in out.chunks_exact_mut(o + 1) {
        for (k, p) in row.iter_mut().enumerate() {
            *p = *p / binomial(o, k);
        }
        for level in (1..=o).rev() {
            for k in level..=o {
                row[k] = row[k] + row[k - 1];
            }
        }
    }
    each_layer(n, o, out, scratch, |layer, converted| simplex_from_power::<P, 3>(layer, n, converted))
}

/// Every layer of `net`, changed by a kernel that writes to its second argument.
fn each_layer<P: Point>(
    n: usize,
    o: usize,
    net: &mut [P],
    scratch: &mut [P],
    kernel: impl Fn(&[P], &mut [P]) -> Result<(), BernsteinError>,
) -> Result<(), BernsteinError> {
    let count = simplex_count::<3>(n);
    least_length("scratch", 2 * count, scratch.len())?;
    let (layer, rest) = scratch.split_at_mut(count);
    let converted = &mut rest[..count];
    for k in 0..=o {
        for (p, row) in layer.iter_mut().zip(net.chunks_exact(o + 1)) {
            *p = row[k];
        }
        kernel(layer, converted)?;
        for (row, &p) in net.chunks_exact_mut(o + 1).zip(&*converted) {
            row[k] = p;
        }
    }
    Ok(())
}
