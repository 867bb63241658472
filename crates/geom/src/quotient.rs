//! The quotient rule: from homogeneous jets to Euclidean ones.

use glam::{DVec3, DVec4, Vec4Swizzles};

use crate::multi_index::{below, binomial, multi_indices, partial_count, partial_index};
use crate::{CurveJet, GeomError, SurfaceJet};

/// A number with its partial derivatives up to order 2: the denominator of a rational surface.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ScalarJet {
    /// w
    pub value: f64,
    /// ∂w/∂u
    pub du: f64,
    /// ∂w/∂v
    pub dv: f64,
    /// ∂²w/∂u²
    pub duu: f64,
    /// ∂²w/∂u∂v
    pub duv: f64,
    /// ∂²w/∂v²
    pub dvv: f64,
}

/// The jet of `S = N/w` from those of N and w: `S_α = (N_α − Σ_{0<β≤α} C(α,β) w_β S_{α−β}) / w`.
///
/// `uncertainty` is a bound on the error of w, 0 where w is taken as exact: a denominator within it of zero
/// counts as zero.
/// Error: that of N and w, magnified by `1/|w|` once an order.
///
/// # Errors
/// [`GeomError::Pole`] where w vanishes, [`GeomError::Overflow`] where the answer would not be finite.
///
/// Source: Piegl and Tiller, *The NURBS Book*, 2nd ed., sec. 4.5.
pub fn quotient_jet(
    numerator: &SurfaceJet,
    denominator: &ScalarJet,
    uncertainty: f64,
) -> Result<SurfaceJet, GeomError> {
    let (n, w) = (numerator, denominator);
    refuse_pole(w.value, uncertainty)?;
    let point = n.point / w.value;
    let du = (n.du - point * w.du) / w.value;
    let dv = (n.dv - point * w.dv) / w.value;
    let jet = SurfaceJet {
        point,
        du,
        dv,
        duu: (n.duu - du * (2.0 * w.du) - point * w.duu) / w.value,
        duv: (n.duv - dv * w.du - du * w.dv - point * w.duv) / w.value,
        dvv: (n.dvv - dv * (2.0 * w.dv) - point * w.dvv) / w.value,
    };
    if jet.is_finite() { Ok(jet) } else { Err(GeomError::Overflow { denominator: w.value }) }
}

/// The jet of a curve `C = N/w`; `denominator` holds w and its first three derivatives. Otherwise as
/// [`quotient_jet`].
///
/// # Errors
/// [`GeomError::Pole`] where w vanishes, [`GeomError::Overflow`] where the answer would not be finite.
pub fn quotient_curve_jet(
    numerator: &CurveJet,
    denominator: [f64; 4],
    uncertainty: f64,
) -> Result<CurveJet, GeomError> {
    let (n, [w, w1, w2, w3]) = (numerator, denominator);
    refuse_pole(w, uncertainty)?;
    let point = n.point / w;
    let d1 = (n.d1 - point * w1) / w;
    let d2 = (n.d2 - d1 * (2.0 * w1) - point * w2) / w;
    let d3 = (n.d3 - d2 * (3.0 * w1) - d1 * (3.0 * w2) - point * w3) / w;
    let jet = CurveJet { point, d1, d2, d3 };
    if jet.is_finite() { Ok(jet) } else { Err(GeomError::Overflow { denominator: w }) }
}

/// The quotient rule of any order in N parameters: from the partial derivatives of `(N, w)` to those of
/// `S = N/w`, `S_α = (N_α − Σ_{0<β≤α} C(α,β) w_β S_{α−β}) / w`.
///
/// Both lists stand in the order of [`partial_index`]. The total order is the greatest one that fits the
/// shorter of them; what is left over of `out` is set to zero. `uncertainty` as for [`quotient_jet`].
/// Error: that of N and w, magnified by `1/|w|` once an order. Cost: Π(αᵢ + 1) multiplications of a vector for
/// each α, no allocation.
///
/// ```
/// use casteljau_geom::{quotient_partials, glam::{DVec3, DVec4}};
/// // (1, t, 0)/t at t = 2: the derivatives of 1/t are −1/4 and 1/4.
/// let net = [DVec4::new(1., 2., 0., 2.), DVec4::new(0., 1., 0., 1.), DVec4::ZERO];
/// let mut out = [DVec3::ZERO; 3];
/// quotient_partials::<1>(&net, 0.0, &mut out)?;
/// assert_eq!(out, [DVec3::new(0.5, 1., 0.), DVec3::X * -0.25, DVec3::X * 0.25]);
/// # Ok::<(), casteljau_geom::GeomError>(())
/// ```
///
/// # Errors
/// [`GeomError::Pole`] where w vanishes, [`GeomError::Overflow`] where the answer would not be finite; `out`
/// is then not to be used.
///
/// Source: Piegl and Tiller, *The NURBS Book*, 2nd ed., sec. 4.5.
pub fn quotient_partials<const N: usize>(
    homogeneous: &[DVec4],
    uncertainty: f64,
    out: &mut [DVec3],
) -> Result<(), GeomError> {
    extended_quotient_partials::<N>(homogeneous, uncertainty, out)?;
    match homogeneous.first() {
        Some(value) if !out.iter().all(|d| d.is_finite()) => {
            Err(GeomError::Overflow { denominator: value.w })
        }
        _ => Ok(()),
    }
}

/// As [`quotient_partials`], but a derivative that leaves the range of numbers is infinite or NaN in `out`, and so are
/// those that are computed from it; the others stand.
///
/// ```
/// use casteljau_geom::{extended_quotient_partials, glam::{DVec3, DVec4}};
/// // 1/w at w = 1e-200 with w′ = 1: the derivative is −1e400.
/// let net = [DVec4::new(1.0, 0.0, 0.0, 1e-200), DVec4::W];
/// let mut out = [DVec3::ZERO; 2];
/// extended_quotient_partials::<1>(&net, 0.0, &mut out)?;
/// assert!(out[0].x == 1e200 && !out[1].is_finite());
/// # Ok::<(), casteljau_geom::GeomError>(())
/// ```
///
/// # Errors
/// [`GeomError::Pole`] where w vanishes; `out` is then not to be used.
pub fn extended_quotient_partials<const N: usize>(
    homogeneous: &[DVec4],
    uncertainty: f64,
    out: &mut [DVec3],
) -> Result<(), GeomError> {
    let fits = homogeneous.len().min(out.len());
    let order = (0..).take_while(|&k| N > 0 && partial_count::<N>(k) <= fits).last();
    let used = order.map_or(0, partial_count::<N>);
    out[used..].fill(DVec3::ZERO);
    let Some(order) = order else { return Ok(()) };
    let w = homogeneous[0].w;
    refuse_pole(w, uncertainty)?;
    for alpha in multi_indices::<N>(order) {
        let place = partial_index(alpha);
        let mut sum = homogeneous[place].xyz();
        for beta in below(alpha).skip(1) {
            let mut rest = alpha;
            for (r, b) in rest.iter_mut().zip(beta) {
                *r -= b;
            }
            sum -= out[partial_index(rest)] * (binomial(alpha, beta) * homogeneous[partial_index(beta)].w);
        }
        out[place] = sum / w;
    }
    Ok(())
}

fn refuse_pole(denominator: f64, uncertainty: f64) -> Result<(), GeomError> {
    if denominator.abs() > uncertainty.max(0.0) {
        Ok(())
    } else {
        Err(GeomError::Pole { denominator, uncertainty })
    }
}
