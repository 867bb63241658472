//! `casteljau domain`: the polygon and the coordinates.

use casteljau::domain::Orientation;
use casteljau::gb::{ConcavePatch, GbError, Location};
use casteljau::glam::DVec2;
use serde::Serialize;

use crate::arguments::Domain;
use crate::eval::{all_answered, no_answer};
use crate::failure::Failure;
use crate::input::Input;
use crate::number::{brief, human, tuple};
use crate::output::Lines;
use crate::parameters::{Parameters, Wanted};
use crate::words;

/// A domain. `boundary_residual` is the largest difference between the coordinates as they are computed inside and their
/// exact values on the sides; `certificate` bounds their error inside.
#[derive(Serialize)]
struct Description {
    shape: usize,
    vertices: Vec<[f64; 2]>,
    concave: Vec<bool>,
    orientation: &'static str,
    layout: &'static str,
    repaired: bool,
    coordinates: &'static str,
    boundary_residual: f64,
    certificate: f64,
}

/// Coordinates at one parameter; derivatives do not exist at corners.
#[derive(Serialize)]
struct Answer {
    shape: usize,
    params: [f64; 2],
    barycentric: Vec<f64>,
    du: Option<Vec<f64>>,
    dv: Option<Vec<f64>>,
}

pub fn run(options: &Domain, json: bool) -> Result<(), Failure> {
    let parameters = Parameters::read(&options.places, &options.selection)?;
    parameters.check(&[Wanted::SURFACE])?;
    let input = Input::read(&options.selection)?;
    let patches = input.patches()?;
    let mut lines = Lines::new();
    let mut without = 0_usize;
    for (named, patch) in input.shapes.iter().zip(&patches) {
        let shape = named.0;
        let description = describe(patch, shape);
        match json {
            true => lines.json(&description)?,
            false => text(&description, &Input::title(named), patch, &mut lines)?,
        }
        for parameter in &parameters.all {
            let uv = DVec2::from_slice(parameter.numbers());
            let answer = answer(patch, shape, uv);
            without += usize::from(answer.is_err());
            match answer {
                Ok(answer) if json => lines.json(&answer)?,
                Ok(answer) => answer_text(&answer, &mut lines)?,
                Err(error) => no_answer(shape, parameter.numbers(), &error, json, &mut lines)?,
            }
        }
    }
    lines.finish()?;
    all_answered(without, parameters.all.len() * patches.len(), &input.name)
}

fn describe(patch: &ConcavePatch, shape: usize) -> Description {
    let polygon = patch.domain();
    Description {
        shape,
        vertices: polygon.vertices().iter().map(|p| p.to_array()).collect(),
        concave: (0..polygon.len()).map(|i| polygon.is_concave(i)).collect(),
        orientation: match polygon.orientation() {
            Orientation::CounterClockwise => "counter-clockwise",
            Orientation::Clockwise => "clockwise",
        },
        layout: words::layout(patch),
        repaired: patch.layout_repaired(),
        coordinates: words::coordinates(patch),
        boundary_residual: patch.coordinates().boundary_residual(),
        certificate: patch.coordinates().certificate(),
    }
}

fn answer(patch: &ConcavePatch, shape: usize, uv: DVec2) -> Result<Answer, GbError> {
    let location = patch.domain().locate(uv);
    if location == Location::Outside {
        return Err(GbError::Outside { uv });
    }
    let n = patch.sides();
    let order = if matches!(location, Location::Corner(_)) { 0 } else { 1 };
    let mut rows = vec![0.0; if order == 0 { n } else { 3 * n }];
    patch.coordinates().evaluate(&[uv], order, &mut rows)?;
    let row = |k: usize| rows.get(k * n..(k + 1) * n).map(<[f64]>::to_vec);
    let barycentric = row(0).unwrap_or_default();
    Ok(Answer { shape, params: uv.to_array(), barycentric, du: row(1), dv: row(2) })
}

fn text(
    description: &Description,
    title: &str,
    patch: &ConcavePatch,
    lines: &mut Lines,
) -> Result<(), Failure> {
    let repaired = if description.repaired { ", repaired" } else { "" };
    let Description { layout, coordinates, orientation, .. } = description;
    lines.text(&format!("{title}: {} sides, layout {layout}{repaired}, {orientation}", patch.sides()))?;
    let (residual, certificate) = (brief(description.boundary_residual), brief(description.certificate));
    lines.text(&format!(
        "  coordinates  {coordinates}, boundary residual {residual}, certificate {certificate}"
    ))?;
    for (i, vertex) in description.vertices.iter().enumerate() {
        let angle = brief(patch.domain().interior_angle(i).to_degrees());
        let concave = if description.concave[i] { ", concave" } else { "" };
        lines.text(&format!("  vertex {i:<5} {:<32} {angle}°{concave}", tuple(vertex)))?;
    }
    Ok(())
}

fn answer_text(answer: &Answer, lines: &mut Lines) -> Result<(), Failure> {
    lines.text(&format!("  at {}", tuple(&answer.params)))?;
    let column =
        |row: &Option<Vec<f64>>, i: usize| row.as_ref().map_or_else(|| "none".into(), |row| human(row[i]));
    for (i, &value) in answer.barycentric.iter().enumerate() {
        let (du, dv) = (column(&answer.du, i), column(&answer.dv, i));
        lines.text(&format!("    λ {i:<3} {:<16} du {du:<16} dv {dv}", human(value)))?;
    }
    Ok(())
}
