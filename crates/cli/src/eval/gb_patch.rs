use casteljau::gb::{ConcavePatch, GbError, Location};
use casteljau::geom::SurfaceJet;
use casteljau::glam::{DVec2, DVec3};
use serde::Serialize;

use super::{Partials, vector};
use crate::failure::Failure;
use crate::number::{optional, tuple};
use crate::output::Lines;

/// A GB patch at one parameter. What does not exist at a corner is null.
#[derive(Serialize)]
pub struct Answer {
    shape: usize,
    params: [f64; 2],
    point: [f64; 3],
    barycentric: Vec<f64>,
    normal: Option<[f64; 3]>,
    gaussian: Option<f64>,
    mean: Option<f64>,
    principal: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Partials::is_empty")]
    partials: Partials,
}

pub fn answer(
    patch: &ConcavePatch,
    shape: usize,
    uv: DVec2,
    order: Option<usize>,
) -> Result<Answer, GbError> {
    let location = match patch.domain().locate(uv) {
        Location::Outside => return Err(GbError::Outside { uv }),
        location => location,
    };
    let mut barycentric = vec![0.0; patch.sides()];
    patch.coordinates().evaluate(&[uv], 0, &mut barycentric)?;
    let point = patch.point_at(location)?;
    let jet = match patch.jet_at(location) {
        Ok(jet) => Some(jet),
        Err(GbError::CornerDerivative { .. }) => None,
        Err(error) => return Err(error),
    };
    let normal = patch.normal_at(location).ok();
    let curvatures = jet.and_then(|jet| {
        let curvatures = jet.curvatures()?;
        // Signs follow the normal that is told, which a clockwise domain does not turn over.
        let flipped = normal.zip(jet.normal()).is_some_and(|(told, own)| told.dot(own) < 0.0);
        let [low, high] = curvatures.principal;
        Some(match flipped {
            false => (curvatures.gaussian, curvatures.mean, [low, high]),
            true => (curvatures.gaussian, -curvatures.mean, [-high, -low]),
        })
    });
    Ok(Answer {
        shape,
        params: uv.to_array(),
        point: point.to_array(),
        barycentric,
        normal: normal.map(|n| n.to_array()),
        gaussian: curvatures.map(|c| c.0),
        mean: curvatures.map(|c| c.1),
        principal: curvatures.map(|c| c.2),
        partials: order.map(|order| partials(point, jet, order)).unwrap_or_default(),
    })
}

/// By their orders in u and v.
fn partials(point: DVec3, jet: Option<SurfaceJet>, order: usize) -> Partials {
    let of = |part: fn(&SurfaceJet) -> DVec3| jet.as_ref().map(|jet| part(jet).to_array());
    let mut all = vec![("0,0", Some(point.to_array()))];
    if order >= 1 {
        all.extend([("1,0", of(|jet| jet.du)), ("0,1", of(|jet| jet.dv))]);
    }
    if order >= 2 {
        all.extend([("2,0", of(|jet| jet.duu)), ("1,1", of(|jet| jet.duv)), ("0,2", of(|jet| jet.dvv))]);
    }
    Partials(all.into_iter().map(|(orders, value)| (orders.to_string(), value)).collect())
}

pub fn text(answer: &Answer, lines: &mut Lines) -> Result<(), Failure> {
    lines.text(&format!("  at {}", tuple(&answer.params)))?;
    lines.text(&format!("    point        {}", tuple(&answer.point)))?;
    lines.text(&format!("    normal       {}", vector(&answer.normal)))?;
    let principal = answer.principal.map_or_else(|| "none".into(), |p| tuple(&p));
    let (gaussian, mean) = (optional(answer.gaussian), optional(answer.mean));
    lines.text(&format!("    curvature    Gaussian {gaussian}, mean {mean}, principal {principal}"))?;
    lines.text(&format!("    barycentric  {}", tuple(&answer.barycentric)))?;
    answer.partials.text(lines)
}
