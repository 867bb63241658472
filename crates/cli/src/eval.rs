//! `casteljau eval`: points, partial derivatives, normals, curvatures.

use std::collections::BTreeMap;

use casteljau::gb::{ConcavePatch, GbError, Location};
use casteljau::geom::SurfaceJet;
use casteljau::glam::{DVec2, DVec3};
use serde::Serialize;

use crate::arguments::Eval;
use crate::failure::Failure;
use crate::input::Input;
use crate::number::{optional, tuple};
use crate::output::Lines;
use crate::parameters;

/// The answer at one parameter. What does not exist at a corner is null.
#[derive(Serialize)]
struct Answer {
    shape: usize,
    params: [f64; 2],
    point: [f64; 3],
    barycentric: Vec<f64>,
    normal: Option<[f64; 3]>,
    gaussian: Option<f64>,
    mean: Option<f64>,
    principal: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    partials: BTreeMap<&'static str, Option<[f64; 3]>>,
}

/// A parameter without an answer.
#[derive(Serialize)]
pub struct NoAnswer {
    pub shape: usize,
    pub params: [f64; 2],
    pub error: String,
}

pub fn run(options: &Eval, json: bool) -> Result<(), Failure> {
    if options.places.at.is_empty() && options.places.params.is_none() {
        return Err(Failure::Usage("nothing to evaluate: give --at U,V or --params FILE".into()));
    }
    let parameters = parameters::read(&options.places, &options.selection)?;
    let input = Input::read(&options.selection)?;
    let patches = input.patches()?;
    let mut lines = Lines::new();
    let mut without = 0_usize;
    for (named, patch) in input.shapes.iter().zip(&patches) {
        if !json {
            lines.text(&Input::title(named))?;
        }
        for &uv in &parameters {
            let answer = answer(patch, named.0, uv, options.order);
            without += usize::from(answer.is_err());
            match answer {
                Ok(answer) if json => lines.json(&answer)?,
                Ok(answer) => text(&answer, &mut lines)?,
                Err(error) => no_answer(named.0, uv, &error, json, &mut lines)?,
            }
        }
    }
    lines.finish()?;
    all_answered(without, parameters.len() * patches.len(), &input.name)
}

pub fn no_answer(
    shape: usize,
    uv: DVec2,
    error: &GbError,
    json: bool,
    lines: &mut Lines,
) -> Result<(), Failure> {
    let (params, error) = (uv.to_array(), error.to_string());
    if json {
        return lines.json(&NoAnswer { shape, params, error });
    }
    lines.text(&format!("  at {}: error: {error}", tuple(&params)))
}

/// Exit status 1 where an answer is missing.
pub fn all_answered(without: usize, of: usize, name: &str) -> Result<(), Failure> {
    match without {
        0 => Ok(()),
        _ => Err(Failure::Bad(format!("{name}: {without} of {of} parameters without an answer"))),
    }
}

fn answer(patch: &ConcavePatch, shape: usize, uv: DVec2, order: Option<u8>) -> Result<Answer, GbError> {
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
fn partials(point: DVec3, jet: Option<SurfaceJet>, order: u8) -> BTreeMap<&'static str, Option<[f64; 3]>> {
    let of = |part: fn(&SurfaceJet) -> DVec3| jet.as_ref().map(|jet| part(jet).to_array());
    let mut all = BTreeMap::from([("0,0", Some(point.to_array()))]);
    if order >= 1 {
        all.extend([("1,0", of(|jet| jet.du)), ("0,1", of(|jet| jet.dv))]);
    }
    if order >= 2 {
        all.extend([("2,0", of(|jet| jet.duu)), ("1,1", of(|jet| jet.duv)), ("0,2", of(|jet| jet.dvv))]);
    }
    all
}

fn text(answer: &Answer, lines: &mut Lines) -> Result<(), Failure> {
    let vector = |v: &Option<[f64; 3]>| v.map_or_else(|| "none".into(), |v| tuple(&v));
    lines.text(&format!("  at {}", tuple(&answer.params)))?;
    lines.text(&format!("    point        {}", tuple(&answer.point)))?;
    lines.text(&format!("    normal       {}", vector(&answer.normal)))?;
    let principal = answer.principal.map_or_else(|| "none".into(), |p| tuple(&p));
    let (gaussian, mean) = (optional(answer.gaussian), optional(answer.mean));
    lines.text(&format!("    curvature    Gaussian {gaussian}, mean {mean}, principal {principal}"))?;
    lines.text(&format!("    barycentric  {}", tuple(&answer.barycentric)))?;
    for (orders, value) in &answer.partials {
        lines.text(&format!("    partial {orders}  {}", vector(value)))?;
    }
    Ok(())
}
