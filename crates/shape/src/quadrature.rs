//! Gauss's rule of 16 points.

/// Positive half of Gauss's rule of 16 points on [−1, 1]: node, weight. Exact to degree 31.
const GAUSS: [(f64, f64); 8] = [
    (0.09501250983763744, 0.1894506104550685),
    (0.2816035507792589, 0.18260341504492358),
    (0.45801677765722737, 0.16915651939500254),
    (0.6178762444026438, 0.14959598881657674),
    (0.755404408355003, 0.12462897125553388),
    (0.8656312023878318, 0.09515851168249279),
    (0.9445750230732326, 0.062253523938647894),
    (0.9894009349916499, 0.027152459411754096),
];

/// Gauss's rule of 16 points on `[0, 1]`, each with its weight: `∫ f ≈ Σ wᵢ f(xᵢ)`, exact for polynomials up to degree 31.
///
/// Weights add up to 1 within rounding; nodes come in pairs around ½, from the middle outward.
///
/// ```
/// let sum: f64 = casteljau_shape::gauss_rule().map(|(x, w)| w * x.exp()).sum();
/// assert!((sum - (1_f64.exp() - 1.0)).abs() < 1e-15);
/// ```
pub fn gauss_rule() -> impl Iterator<Item = (f64, f64)> {
    gauss()
}

/// The rule brought to [0, 1]: node, weight.
pub(crate) fn gauss() -> impl Iterator<Item = (f64, f64)> {
    GAUSS.iter().flat_map(|&(x, w)| [(0.5 - 0.5 * x, 0.5 * w), (0.5 + 0.5 * x, 0.5 * w)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use casteljau_geom::UNIT_ROUNDOFF;

    /// ∫ xᵏ over [0, 1] is 1/(k+1), to the rounding of sixteen terms.
    #[test]
    fn gauss_rule_is_exact_to_degree_31() {
        for k in 0..=31 {
            let sum: f64 = gauss().map(|(x, w)| w * x.powi(k)).sum();
            let off = (sum - 1.0 / f64::from(k + 1)).abs();
            assert!(off <= 8.0 * UNIT_ROUNDOFF, "x^{k}: {off:e}");
        }
    }
}
