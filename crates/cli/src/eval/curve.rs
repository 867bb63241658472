use casteljau::geom::CurveJet;
use casteljau::glam::DVec3;
use casteljau::shape::{ParametricCurve, ShapeError};
use serde::Serialize;

use super::{Partials, vector};
use crate::failure::Failure;
use crate::number::{human, optional, tuple};
use crate::output::Lines;

/// A curve at one parameter. There is no tangent where C′ = 0, and no torsion where there is no osculating plane;
/// what leaves the range of numbers is not there either.
#[derive(Serialize)]
pub struct Answer {
    shape: usize,
    params: [f64; 1],
    point: [f64; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    weight: Option<f64>,
    tangent: Option<[f64; 3]>,
    curvature: Option<f64>,
    torsion: Option<f64>,
    #[serde(skip_serializing_if = "Partials::is_empty")]
    partials: Partials,
}

pub fn answer(
    curve: &dyn ParametricCurve,
    shape: usize,
    t: f64,
    rational: bool,
    order: Option<usize>,
) -> Result<Answer, ShapeError> {
    let derivatives = curve.try_existing_partials(t, order.map_or(3, |order| order.max(3)))?;
    // What is computed from a derivative that does not exist does not exist.
    let derivative = |k: usize| derivatives.get(k).copied().flatten().unwrap_or(DVec3::NAN);
    let point = derivative(0);
    let jet = CurveJet { point, d1: derivative(1), d2: derivative(2), d3: derivative(3) };
    let jet = jet.rescaled(curve.interval().length());
    let told = order.map_or(0, |order| order + 1);
    let named = derivatives.iter().take(told).enumerate();
    let partials = named.map(|(k, d)| (k.to_string(), d.map(|d| d.to_array()))).collect();
    Ok(Answer {
        shape,
        params: [t],
        point: point.to_array(),
        weight: rational.then(|| curve.weight(t)),
        tangent: jet.tangent().map(|d| d.to_array()),
        curvature: jet.curvature(),
        torsion: jet.frenet_frame().map(|frame| frame.torsion),
        partials: Partials(partials),
    })
}

pub fn text(answer: &Answer, lines: &mut Lines) -> Result<(), Failure> {
    lines.text(&format!("  at {}", human(answer.params[0])))?;
    lines.text(&format!("    point        {}", tuple(&answer.point)))?;
    if let Some(weight) = answer.weight {
        lines.text(&format!("    weight       {}", human(weight)))?;
    }
    lines.text(&format!("    tangent      {}", vector(&answer.tangent)))?;
    let (curvature, torsion) = (optional(answer.curvature), optional(answer.torsion));
    lines.text(&format!("    curvature    {curvature}, torsion {torsion}"))?;
    answer.partials.text(lines)
}
