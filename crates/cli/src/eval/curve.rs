use casteljau::shape::{ParametricCurve, ShapeError};
use serde::Serialize;

use super::{Partials, vector};
use crate::failure::Failure;
use crate::number::{human, optional, tuple};
use crate::output::Lines;

/// A curve at one parameter. There is no tangent where C′ = 0, and no torsion where there is no osculating plane.
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
    let jet = curve.try_jet(t)?;
    let partials = match order {
        None => Partials::default(),
        Some(order) => {
            let jet = curve.try_jet_of_order(t, order)?;
            let named = jet.as_slice().iter().enumerate();
            Partials(named.map(|(k, d)| (k.to_string(), Some(d.to_array()))).collect())
        }
    };
    Ok(Answer {
        shape,
        params: [t],
        point: jet.point.to_array(),
        weight: rational.then(|| curve.weight(t)),
        tangent: jet.tangent().map(|d| d.to_array()),
        curvature: jet.curvature(),
        torsion: jet.frenet_frame().map(|frame| frame.torsion),
        partials,
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
