//! `casteljau check`: does every side keep what it promises?

mod joins;
mod plain;
mod solid;

pub use self::solid::integrate;

use casteljau::gb::{ConcavePatch, ContactLimit, ContinuityReport, Maximum, SideReport};
use casteljau::geom::UNIT_ROUNDOFF;
use casteljau::glam::DVec3;
use serde::Serialize;

use crate::arguments::Check;
use crate::failure::Failure;
use crate::input::Input;
use crate::number::brief;
use crate::output::Lines;

/// What counts as met.
#[derive(Clone, Copy)]
struct Tolerances {
    /// G0, in model units.
    position: f64,
    /// G1, in degrees.
    angle: f64,
    /// G2, relative.
    curvature: f64,
}

/// How well two surfaces meet along a curve: the three figures, and the largest g whose figure and all before it are met.
#[derive(Clone, Copy, Serialize)]
struct Figures {
    g0: f64,
    g1: Option<f64>,
    g2: Option<f64>,
}

impl Figures {
    /// 0 to 2, or none where the surfaces do not even touch.
    fn measured(&self, tolerances: &Tolerances) -> Option<usize> {
        let met = |figure: Option<f64>, tolerance: f64| figure.is_some_and(|x| x <= tolerance);
        let steps = [
            met(Some(self.g0), tolerances.position),
            met(self.g1, tolerances.angle),
            met(self.g2, tolerances.curvature),
        ];
        steps.iter().take_while(|met| **met).count().checked_sub(1)
    }
}

/// Pairs of sides, given by points along them, whose middles between the ends are near each other; in order of their
/// numbers. Of the ends, since one curve may be run through at different paces.
fn pairs<'a>(sides: impl Iterator<Item = &'a [DVec3]>, near: f64) -> Vec<(usize, usize)> {
    let middle = |points: &[DVec3]| Some(points.first()?.midpoint(*points.last()?));
    let mut order: Vec<(DVec3, usize)> =
        sides.enumerate().filter_map(|(i, points)| Some((middle(points)?, i))).collect();
    order.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
    let mut found = Vec::new();
    for (place, &(middle, i)) in order.iter().enumerate() {
        for &(other, j) in order[place + 1..].iter().take_while(|(other, _)| other.x - middle.x <= near) {
            if middle.distance(other) <= near {
                found.push((i.min(j), i.max(j)));
            }
        }
    }
    found.sort_unstable();
    found
}

/// `G1`, or `none`.
fn order_name(order: Option<usize>) -> String {
    order.map_or_else(|| "none".into(), |g| format!("G{g}"))
}

/// A side of a shape against its own ribbon. `g0` is in model units, `g1` in degrees, `g2` relative; `limit` is what keeps
/// the promise from being higher.
#[derive(Serialize)]
struct SideLine {
    shape: usize,
    side: usize,
    promised: String,
    measured: String,
    #[serde(flatten)]
    figures: Figures,
    limit: String,
    ok: bool,
}

pub fn run(options: &Check, json: bool) -> Result<(), Failure> {
    for (name, value) in [("--angle", options.angle), ("--curvature", options.curvature)] {
        check_tolerance(name, value)?;
    }
    if let Some(position) = options.position {
        check_tolerance("--position", position)?;
    }
    let input = Input::read(&options.selection)?;
    let shapes = input.shapes.iter().map(|(_, named)| input.geometry(named));
    let shapes = shapes.collect::<Result<Vec<_>, _>>()?;
    let mut lines = Lines::new();
    let mut broken = 0_usize;
    let (mut patches, mut plain) = (Vec::new(), Vec::new());
    for (named, geometry) in input.shapes.iter().zip(&shapes) {
        if geometry.as_solid().is_some() {
            broken += usize::from(!solid::verdict(named, geometry, json, &mut lines)?);
            continue;
        }
        let Some(patch) = geometry.as_gb_patch() else {
            plain.push((named.0, geometry));
            continue;
        };
        patches.push((named.0, patch));
        if !json {
            lines.text(&Input::title(named))?;
            lines.text(&head("  side"))?;
        }
        let tolerances = tolerances(options, patch);
        let report = ContinuityReport::measure(patch, options.samples as usize)?;
        for side in &report.sides {
            let line = side_line(named.0, side, &tolerances);
            broken += usize::from(!line.ok);
            if json { lines.json(&line)? } else { side_text(&line, &mut lines)? }
        }
    }
    let joins = joins::measure(&patches, &plain, options)?;
    let flat = patches.len() + plain.len();
    let plain = plain::measure(&plain, options)?;
    if !json && joins.len() + plain.len() > 0 {
        lines.text("shared sides")?;
        lines.text(&head(&format!("{:<36}", "  shape, side meets shape, side")))?;
    } else if !json && patches.is_empty() && flat > 0 {
        lines.text("no two ends or edges meet")?;
    }
    for line in &joins {
        broken += usize::from(!line.ok);
        if json { lines.json(line)? } else { joins::text(line, &mut lines)? }
    }
    for line in &plain {
        if json { lines.json(line)? } else { plain::text(line, &mut lines)? }
    }
    lines.finish()?;
    match broken {
        0 => Ok(()),
        1 => Err(Failure::Bad(format!("{}: 1 promise is broken", input.name))),
        _ => Err(Failure::Bad(format!("{}: {broken} promises are broken", input.name))),
    }
}

fn check_tolerance(name: &str, value: f64) -> Result<(), Failure> {
    let sound = value >= 0.0 && value.is_finite();
    if sound {
        Ok(())
    } else {
        Err(Failure::Usage(format!("{name} must be a number from 0 up, not {value}")))
    }
}

/// The gap that the coordinates' certificate explains, and rounding.
fn tolerances(options: &Check, patch: &ConcavePatch) -> Tolerances {
    let size = patch.bounding_box().diagonal();
    let degree = patch.ribbons().iter().map(|r| r.degree().max(2 * r.layers() - 1)).max().unwrap_or(1) as f64;
    let certified = 4.0 * degree * (patch.coordinates().certificate() + 4.0 * UNIT_ROUNDOFF) * size;
    Tolerances {
        position: options.position.unwrap_or(certified),
        angle: options.angle,
        curvature: options.curvature,
    }
}

fn side_line(shape: usize, side: &SideReport, tolerances: &Tolerances) -> SideLine {
    let value = |maximum: Option<Maximum>| maximum.map(|m| m.value);
    let figures = Figures { g0: side.g0.value, g1: value(side.g1), g2: value(side.g2) };
    let measured = figures.measured(tolerances);
    // Beyond G2 nothing is measured.
    let needed = side.promised.geometric().min(2);
    SideLine {
        shape,
        side: side.side,
        promised: format!("G{}", side.promised.geometric()),
        measured: order_name(measured),
        figures,
        limit: limit(side.promised.limit),
        ok: measured.is_some_and(|measured| measured >= needed),
    }
}

fn limit(limit: ContactLimit) -> String {
    match limit {
        ContactLimit::Layers => "its own layers".into(),
        ContactLimit::BlendPower => "the blend power".into(),
        ContactLimit::NeighbourDegree { side } => format!("the degree of side {side}"),
        ContactLimit::OtherLayers { side } => format!("the layers of side {side}"),
        ContactLimit::CenterWeight => "the center weight".into(),
        _ => "the construction".into(),
    }
}

/// The head of a table; its first column is as wide as `what`.
fn head(what: &str) -> String {
    format!("{what}  promised  measured  {:<12}{:<12}G2 ratio", "G0 gap", "G1 angle")
}

/// A row of the table.
fn row(what: &str, promised: &str, measured: &str, figures: &Figures, ok: bool) -> String {
    let angle = figures.g1.map_or_else(|| "–".into(), |x| format!("{}°", brief(x)));
    let ratio = figures.g2.map_or_else(|| "–".into(), brief);
    let gap = brief(figures.g0);
    let verdict = if ok { "" } else { "BROKEN" };
    format!("{what}  {promised:<8}  {measured:<8}  {gap:<12}{angle:<12}{ratio:<10}{verdict}")
}

fn side_text(line: &SideLine, lines: &mut Lines) -> Result<(), Failure> {
    let what = format!("  {:<4}", line.side);
    let row = row(&what, &line.promised, &line.measured, &line.figures, line.ok);
    lines.text(&format!("{row:<62}  limited by {}", line.limit))
}
