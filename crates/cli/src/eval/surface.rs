use casteljau::geom::{GeomError, multi_indices};
use casteljau::shape::{ParametricSurface, ShapeError};
use serde::Serialize;

use super::{Partials, vector};
use crate::failure::Failure;
use crate::number::{human, optional, tuple};
use crate::output::Lines;

/// A patch or a triangle at one parameter. Signs follow the normal ∂u × ∂v; where that collapses there are no curvatures,
/// and the normal is its limit from inside, if there is one. What leaves the range of numbers is not there either.
#[derive(Serialize)]
pub struct Answer {
    shape: usize,
    params: [f64; 2],
    point: [f64; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    weight: Option<f64>,
    normal: Option<[f64; 3]>,
    gaussian: Option<f64>,
    mean: Option<f64>,
    principal: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Partials::is_empty")]
    partials: Partials,
}

pub fn answer(
    surface: &dyn ParametricSurface,
    shape: usize,
    [u, v]: [f64; 2],
    rational: bool,
    order: Option<usize>,
) -> Result<Answer, ShapeError> {
    let point = surface.try_point(u, v)?;
    let normal = existing(surface.try_normal(u, v))?;
    let curvatures = existing(surface.try_curvatures(u, v))?;
    let partials = match order {
        None => Partials::default(),
        Some(order) => {
            let partials = surface.try_existing_partials(u, v, order)?;
            let named = multi_indices::<2>(order).zip(partials);
            Partials(named.map(|([a, b], d)| (format!("{a},{b}"), d.map(|d| d.to_array()))).collect())
        }
    };
    Ok(Answer {
        shape,
        params: [u, v],
        point: point.to_array(),
        weight: rational.then(|| surface.weight(u, v)),
        normal: normal.map(|n| n.to_array()),
        gaussian: curvatures.map(|c| c.gaussian),
        mean: curvatures.map(|c| c.mean),
        principal: curvatures.map(|c| c.principal),
        partials,
    })
}

/// Where derivatives collapse or leave the range of numbers there is no answer, which is no error at a point that exists.
fn existing<T>(answer: Result<T, ShapeError>) -> Result<Option<T>, ShapeError> {
    match answer {
        Ok(answer) => Ok(Some(answer)),
        Err(
            ShapeError::NoTangentPlane { .. }
            | ShapeError::Evaluation { source: GeomError::Overflow { .. }, .. },
        ) => Ok(None),
        Err(error) => Err(error),
    }
}

pub fn text(answer: &Answer, lines: &mut Lines) -> Result<(), Failure> {
    lines.text(&format!("  at {}", tuple(&answer.params)))?;
    lines.text(&format!("    point        {}", tuple(&answer.point)))?;
    if let Some(weight) = answer.weight {
        lines.text(&format!("    weight       {}", human(weight)))?;
    }
    lines.text(&format!("    normal       {}", vector(&answer.normal)))?;
    let principal = answer.principal.map_or_else(|| "none".into(), |p| tuple(&p));
    let (gaussian, mean) = (optional(answer.gaussian), optional(answer.mean));
    lines.text(&format!("    curvature    Gaussian {gaussian}, mean {mean}, principal {principal}"))?;
    answer.partials.text(lines)
}
