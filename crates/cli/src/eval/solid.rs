use casteljau::geom::{SolidJet, multi_indices};
use casteljau::glam::DVec3;
use casteljau::solid::{ParametricSolid, SolidError};
use serde::Serialize;

use super::Partials;
use crate::failure::Failure;
use crate::number::{human, optional, tuple};
use crate::output::Lines;

/// A solid at one parameter. `jacobian` is det ∂(x,y,z)/∂(parameters); what leaves the range of numbers is not there.
#[derive(Serialize)]
pub struct Answer {
    shape: usize,
    params: [f64; 3],
    point: [f64; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    weight: Option<f64>,
    jacobian: Option<f64>,
    #[serde(skip_serializing_if = "Partials::is_empty")]
    partials: Partials,
}

pub fn answer(
    solid: &dyn ParametricSolid,
    shape: usize,
    at: [f64; 3],
    rational: bool,
    order: Option<usize>,
) -> Result<Answer, SolidError> {
    let derivatives = solid.try_existing_partials(at, order.map_or(1, |order| order.max(1)))?;
    // What is computed from a derivative that does not exist does not exist.
    let derivative = |place: usize| derivatives.get(place).copied().flatten().unwrap_or(DVec3::NAN);
    let jet = SolidJet { point: derivative(0), du: derivative(1), dv: derivative(2), dw: derivative(3) };
    let told = order.into_iter().flat_map(multi_indices::<3>).zip(&derivatives);
    let partials = told.map(|([a, b, c], d)| (format!("{a},{b},{c}"), d.map(|d| d.to_array()))).collect();
    Ok(Answer {
        shape,
        params: at,
        point: jet.point.to_array(),
        weight: rational.then(|| solid.weight(at)),
        jacobian: Some(jet.jacobian()).filter(|x| x.is_finite()),
        partials: Partials(partials),
    })
}

pub fn text(answer: &Answer, lines: &mut Lines) -> Result<(), Failure> {
    lines.text(&format!("  at {}", tuple(&answer.params)))?;
    lines.text(&format!("    point        {}", tuple(&answer.point)))?;
    if let Some(weight) = answer.weight {
        lines.text(&format!("    weight       {}", human(weight)))?;
    }
    lines.text(&format!("    Jacobian     {}", optional(answer.jacobian)))?;
    answer.partials.text(lines)
}
