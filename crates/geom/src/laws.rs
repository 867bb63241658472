//! Laws that shapes obey, written once and run on every kind of shape by the tests of all crates.
//!
//! A law takes the shape as functions, tries it at the parameters given, and answers with the worst
//! violation; each has its tolerance from the caller, in the unit of what it compares. Only for tests:
//! feature `laws`.
//!
//! ```
//! use casteljau_geom::{glam::DVec3, laws};
//! let parabola = |t: f64| DVec3::new(t, t * t, 0.0);
//! let slope = |t: f64| DVec3::new(1.0, 2.0 * t, 0.0);
//! laws::derivative_law(parabola, slope, 0.3, 1e-2, 1e-12).unwrap();
//! let wrong = |t: f64| DVec3::new(1.0, t, 0.0);
//! assert!(laws::derivative_law(parabola, wrong, 0.3, 1e-2, 1e-12).is_err());
//! ```

use glam::{DAffine3, DVec3};
use thiserror::Error;

use crate::{BoundingBox, CurveJet, SurfaceJet};

/// A law that does not hold, and by how much.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{law} at {at:?}: off by {off:.3e}, allowed {allowed:.3e}")]
pub struct BrokenLaw {
    /// Name of the law.
    pub law: &'static str,
    /// Parameter or place.
    pub at: Vec<f64>,
    /// By how much it is missed.
    pub off: f64,
    /// The tolerance given.
    pub allowed: f64,
}

/// What a law answers.
pub type Verdict = Result<(), BrokenLaw>;

fn judge(law: &'static str, at: &[f64], off: f64, allowed: f64) -> Verdict {
    // NaN is a violation too.
    if off <= allowed { Ok(()) } else { Err(BrokenLaw { law, at: at.to_vec(), off, allowed }) }
}

/// Partition of unity: the basis functions add up to 1.
///
/// # Errors
/// [`BrokenLaw`] where they do not, within `tolerance`.
pub fn partition_of_unity_law(basis: &[f64], tolerance: f64) -> Verdict {
    judge("partition of unity", &[], (basis.iter().sum::<f64>() - 1.0).abs(), tolerance)
}

/// Non-negativity: no basis function is below zero by more than `tolerance`.
///
/// # Errors
/// [`BrokenLaw`] with the place of the lowest one.
pub fn non_negative_law(basis: &[f64], tolerance: f64) -> Verdict {
    let lowest = basis.iter().copied().enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
    lowest.map_or(Ok(()), |(place, value)| judge("non-negative", &[place as f64], -value, tolerance))
}

/// Linear precision: `Σ λᵢ vᵢ = p`.
///
/// # Errors
/// [`BrokenLaw`] with the distance from p.
pub fn linear_precision_law(lambda: &[f64], vertices: &[DVec3], p: DVec3, tolerance: f64) -> Verdict {
    let sum: DVec3 = lambda.iter().zip(vertices).map(|(&l, &v)| v * l).sum();
    judge("linear precision", &p.to_array(), sum.distance(p), tolerance)
}

/// Affine invariance: the shape of the mapped control points is the mapped shape, `S(A·P) = A·S(P)`.
///
/// `evaluate` makes the shape from control points and evaluates it at one parameter.
///
/// # Errors
/// [`BrokenLaw`] with the distance of the two points.
pub fn affine_invariance_law(
    control_points: &[DVec3],
    map: DAffine3,
    evaluate: impl Fn(&[DVec3]) -> DVec3,
    tolerance: f64,
) -> Verdict {
    let mapped: Vec<DVec3> = control_points.iter().map(|&p| map.transform_point3(p)).collect();
    let off = evaluate(&mapped).distance(map.transform_point3(evaluate(control_points)));
    judge("affine invariance", &[], off, tolerance)
}

/// End points: a curve starts and ends at the given points, to the bit.
///
/// # Errors
/// [`BrokenLaw`] with the parameter and the distance.
pub fn end_point_law(curve: impl Fn(f64) -> DVec3, first: DVec3, last: DVec3) -> Verdict {
    judge("end point", &[0.0], curve(0.0).distance(first), 0.0)?;
    judge("end point", &[1.0], curve(1.0).distance(last), 0.0)
}

/// Subdivision: the two parts are the whole, `left(s) = whole(ts)`, `right(s) = whole(t + (1−t)s)`, tried at
/// 17 parameters.
///
/// # Errors
/// [`BrokenLaw`] with the parameter of the whole.
pub fn subdivision_law(
    whole: impl Fn(f64) -> DVec3,
    left: impl Fn(f64) -> DVec3,
    right: impl Fn(f64) -> DVec3,
    t: f64,
    tolerance: f64,
) -> Verdict {
    for i in 0..=16 {
        let s = f64::from(i) / 16.0;
        let (a, b) = (t * s, t + (1.0 - t) * s);
        judge("subdivision, left", &[a], left(s).distance(whole(a)), tolerance)?;
        judge("subdivision, right", &[b], right(s).distance(whole(b)), tolerance)?;
    }
    Ok(())
}

/// Equality of curves: `a(s) = b(s)` at 17 values of s from 0 to 1; `law` names what made the one from the other.
///
/// # Errors
/// [`BrokenLaw`] with the parameter and the distance.
pub fn equal_curves_law(
    law: &'static str,
    a: impl Fn(f64) -> DVec3,
    b: impl Fn(f64) -> DVec3,
    tolerance: f64,
) -> Verdict {
    (0..=16).map(|i| f64::from(i) / 16.0).try_for_each(|s| judge(law, &[s], a(s).distance(b(s)), tolerance))
}

/// Equality of surfaces: `a(s, t) = b(s, t)` at 9 × 9 parameters from 0 to 1, those with s + t > 1 left out where
/// `triangle` is set.
///
/// # Errors
/// [`BrokenLaw`] with the parameters and the distance.
pub fn equal_surfaces_law(
    law: &'static str,
    triangle: bool,
    a: impl Fn(f64, f64) -> DVec3,
    b: impl Fn(f64, f64) -> DVec3,
    tolerance: f64,
) -> Verdict {
    for k in 0..81 {
        let [s, t] = [k / 9, k % 9].map(|i| f64::from(i) / 8.0);
        if !triangle || s + t <= 1.0 {
            judge(law, &[s, t], a(s, t).distance(b(s, t)), tolerance)?;
        }
    }
    Ok(())
}

/// Convex hull property: the box contains the points of a curve at 17 values of s from 0 to 1, within `tolerance`.
///
/// # Errors
/// [`BrokenLaw`] with the parameter and the distance outside.
pub fn hull_law(hull: BoundingBox, curve: impl Fn(f64) -> DVec3, tolerance: f64) -> Verdict {
    (0..=16).map(|i| f64::from(i) / 16.0).try_for_each(|s| {
        let p = curve(s);
        judge("convex hull", &[s], p.distance(p.clamp(hull.min, hull.max)), tolerance)
    })
}

/// Derivatives of a curve: each member of its jet is the derivative of the one before.
///
/// # Errors
/// [`BrokenLaw`] with the parameter and the name of the member.
pub fn curve_derivative_law(jet: impl Fn(f64) -> CurveJet, t: f64, step: f64, tolerance: f64) -> Verdict {
    let here = jet(t);
    let difference = |member: fn(CurveJet) -> DVec3| central_difference(|x| member(jet(x)), t, step);
    judge("d1", &[t], here.d1.distance(difference(|j| j.point)), tolerance)?;
    judge("d2", &[t], here.d2.distance(difference(|j| j.d1)), tolerance)?;
    judge("d3", &[t], here.d3.distance(difference(|j| j.d2)), tolerance)
}

/// Weights of the central difference of order 8, for distances 1, 2, 3, 4 times the step.
const CENTRAL: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];

/// Central difference of order 8, `f′(t) ≈ Σ cⱼ (f(t+jh) − f(t−jh))/h`, with error h⁸/630·f⁽⁹⁾ and rounding
/// 2u|f|/h.
pub fn central_difference(f: impl Fn(f64) -> DVec3, t: f64, step: f64) -> DVec3 {
    let pair = |(j, c): (usize, &f64)| {
        let h = (j + 1) as f64 * step;
        (f(t + h) - f(t - h)) * (c / step)
    };
    CENTRAL.iter().enumerate().map(pair).sum()
}

/// Derivative: `derivative` is that of `f`, by central differences of order 8 with the step given.
///
/// # Errors
/// [`BrokenLaw`] with the distance of the two vectors.
pub fn derivative_law(
    f: impl Fn(f64) -> DVec3,
    derivative: impl Fn(f64) -> DVec3,
    t: f64,
    step: f64,
    tolerance: f64,
) -> Verdict {
    judge("derivative", &[t], central_difference(f, t, step).distance(derivative(t)), tolerance)
}

/// Derivatives of a surface: each member of its jet is the derivative of a lower one, in u and in v where
/// both exist.
///
/// # Errors
/// [`BrokenLaw`] with the parameters and the name of the member.
pub fn surface_derivative_law(
    jet: impl Fn(f64, f64) -> SurfaceJet,
    [u, v]: [f64; 2],
    step: f64,
    tolerance: f64,
) -> Verdict {
    let here = jet(u, v);
    let in_u = |member: fn(SurfaceJet) -> DVec3| central_difference(|x| member(jet(x, v)), u, step);
    let in_v = |member: fn(SurfaceJet) -> DVec3| central_difference(|x| member(jet(u, x)), v, step);
    for (law, given, difference) in [
        ("∂u", here.du, in_u(|j| j.point)),
        ("∂v", here.dv, in_v(|j| j.point)),
        ("∂uu", here.duu, in_u(|j| j.du)),
        ("∂uv from ∂v", here.duv, in_u(|j| j.dv)),
        ("∂uv from ∂u", here.duv, in_v(|j| j.du)),
        ("∂vv", here.dvv, in_v(|j| j.dv)),
    ] {
        judge(law, &[u, v], given.distance(difference), tolerance)?;
    }
    Ok(())
}
