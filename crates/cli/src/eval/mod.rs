//! `casteljau eval`: points, partial derivatives, normals, curvatures, Jacobians.

mod curve;
mod gb_patch;
mod solid;
mod surface;

use std::fmt;

use casteljau::io::Geometry;
use casteljau::io::model::{NamedShape, Shape};
use serde::{Serialize, Serializer};

use crate::arguments::Eval;
use crate::failure::Failure;
use crate::input::Input;
use crate::number::tuple;
use crate::output::Lines;
use crate::parameters::{Parameters, Wanted};

/// The highest order of derivatives of GB patches.
const GB_ORDER: u8 = 2;

/// A parameter without an answer.
#[derive(Serialize)]
struct NoAnswer<'p> {
    shape: usize,
    params: &'p [f64],
    error: String,
}

/// The answer at one parameter. What does not exist there is null.
#[derive(Serialize)]
#[serde(untagged)]
enum Answer {
    Curve(curve::Answer),
    Surface(surface::Answer),
    Solid(solid::Answer),
    GbPatch(gb_patch::Answer),
}

pub fn run(options: &Eval, json: bool) -> Result<(), Failure> {
    if options.places.at.is_empty() && options.places.params.is_none() {
        return Err(Failure::Usage("nothing to evaluate: give --at U,V or --params FILE".into()));
    }
    let parameters = Parameters::read(&options.places, &options.selection)?;
    let input = Input::read(&options.selection)?;
    let wanted: Vec<Wanted> = input.shapes.iter().map(|(_, named)| wanted(named)).collect();
    parameters.check(&wanted)?;
    if let Some(order) = options.order.filter(|order| *order > GB_ORDER)
        && let Some((index, _)) = input.shapes.iter().find(|(_, s)| matches!(s.shape, Shape::GbPatch(_)))
    {
        return Err(Failure::Usage(format!(
            "--order {order}: shape {index} is a GB patch, whose derivatives go to order {GB_ORDER}"
        )));
    }
    let shapes = input.shapes.iter().map(|(_, named)| input.geometry(named));
    let shapes = shapes.collect::<Result<Vec<_>, _>>()?;
    let mut lines = Lines::new();
    let mut without = 0_usize;
    for ((named, geometry), wanted) in input.shapes.iter().zip(&shapes).zip(&wanted) {
        let shape = named.0;
        if !json {
            lines.text(&Input::title(named))?;
        }
        for parameter in &parameters.all {
            let params = parameter.numbers();
            let answer = answer(geometry, shape, params, wanted, options.order);
            without += usize::from(answer.is_err());
            match answer {
                Ok(answer) if json => lines.json(&answer)?,
                Ok(Answer::Curve(answer)) => curve::text(&answer, &mut lines)?,
                Ok(Answer::Surface(answer)) => surface::text(&answer, &mut lines)?,
                Ok(Answer::Solid(answer)) => solid::text(&answer, &mut lines)?,
                Ok(Answer::GbPatch(answer)) => gb_patch::text(&answer, &mut lines)?,
                Err(error) => no_answer(shape, params, &error, json, &mut lines)?,
            }
        }
    }
    lines.finish()?;
    all_answered(without, parameters.all.len() * shapes.len(), &input.name)
}

fn wanted(named: &NamedShape) -> Wanted {
    match named.shape {
        Shape::Curve(_) | Shape::PowerCurve(_) => Wanted::CURVE,
        Shape::Triangle(_) => Wanted::TRIANGLE,
        Shape::Tetrahedron(_) => Wanted::TETRAHEDRON,
        Shape::Wedge(_) => Wanted::WEDGE,
        Shape::Hexahedron(_)
        | Shape::TransitionalSolid(_)
        | Shape::RotationalSolid(_)
        | Shape::TwistedSolid(_) => Wanted::BOX,
        _ => Wanted::SURFACE,
    }
}

fn answer(
    geometry: &Geometry,
    shape: usize,
    params: &[f64],
    wanted: &Wanted,
    order: Option<u8>,
) -> Result<Answer, String> {
    let rational = geometry.is_rational();
    let order = order.map(usize::from);
    if let (&[u, v, w], Some(solid)) = (params, geometry.as_solid()) {
        return solid::answer(solid, shape, [u, v, w], rational, order)
            .map(Answer::Solid)
            .map_err(|e| e.to_string());
    }
    match (params, geometry.as_curve(), geometry.as_surface(), geometry.as_gb_patch()) {
        (&[t], Some(curve), ..) => {
            curve::answer(curve, shape, t, rational, order).map(Answer::Curve).map_err(|e| e.to_string())
        }
        (&[u, v], _, Some(surface), _) => surface::answer(surface, shape, [u, v], rational, order)
            .map(Answer::Surface)
            .map_err(|e| e.to_string()),
        (&[u, v], _, _, Some(patch)) => gb_patch::answer(patch, shape, [u, v].into(), order)
            .map(Answer::GbPatch)
            .map_err(|e| e.to_string()),
        _ => Err(format!("this shape takes {}, not {}", wanted.words, params.len())),
    }
}

pub fn no_answer(
    shape: usize,
    params: &[f64],
    error: &impl fmt::Display,
    json: bool,
    lines: &mut Lines,
) -> Result<(), Failure> {
    let error = error.to_string();
    if json {
        return lines.json(&NoAnswer { shape, params, error });
    }
    lines.text(&format!("  at {}: error: {error}", tuple(params)))
}

/// Exit status 1 where an answer is missing.
pub fn all_answered(without: usize, of: usize, name: &str) -> Result<(), Failure> {
    match without {
        0 => Ok(()),
        _ => Err(Failure::Bad(format!("{name}: {without} of {of} parameters without an answer"))),
    }
}

/// Partial derivatives by their orders, `"1,0"`, in the order of jets.
#[derive(Default)]
struct Partials(Vec<(String, Option<[f64; 3]>)>);

impl Partials {
    fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    fn text(&self, lines: &mut Lines) -> Result<(), Failure> {
        // Of solids they are longer than the words above them.
        let width = self.0.iter().map(|(orders, _)| orders.len()).max().map_or(0, |n| n.max(4));
        self.0.iter().try_for_each(|(orders, value)| {
            lines.text(&format!("    partial {orders:<width$} {}", vector(value)))
        })
    }
}

impl Serialize for Partials {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_map(self.0.iter().map(|(orders, value)| (orders, value)))
    }
}

/// The vector, or `none`.
fn vector(v: &Option<[f64; 3]>) -> String {
    v.map_or_else(|| "none".into(), |v| tuple(&v))
}
