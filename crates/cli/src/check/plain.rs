//! Where curves, patches and triangles meet: curves end to end, surfaces edge to edge. They promise nothing, so that this
//! tells figures and breaks nothing.

use casteljau::geom::{BoundingBox, SurfaceJet};
use casteljau::glam::DVec3;
use casteljau::io::Geometry;
use casteljau::shape::{
    JoinReport, JoinTolerance, Maximum, ParametricCurve, ParametricSurface, PatchEdge, ShapeError,
    SurfaceDomain, SurfaceEdge,
};
use serde::Serialize;

use super::joins::{APART, ENDS, GAP};
use super::{Figures, pairs, row};
use crate::arguments::Check;
use crate::failure::Failure;
use crate::output::Lines;

/// Two ends of curves, or two edges of surfaces, that meet. `sides`: of a curve 0 is the start and 1 the end; of a patch the
/// edges count from v at its start, counter-clockwise; edge i of a triangle lies across from vertex i. `opposed`: the edges
/// run opposite ways, as they do when both surfaces have the same outside; of curves, an end meets a start. `parametric` is
/// the largest k for which the derivatives across agree up to order k, `c1` and `c2` their relative differences.
#[derive(Serialize)]
pub struct PlainLine {
    shapes: [usize; 2],
    sides: [usize; 2],
    opposed: bool,
    promised: Option<String>,
    measured: String,
    parametric: String,
    #[serde(flatten)]
    figures: Figures,
    c1: Option<f64>,
    c2: Option<f64>,
    ok: bool,
}

/// A curve's end, or a surface's edge, of the shape at this place.
struct Side<'g> {
    shape: usize,
    side: usize,
    of: Of<'g>,
    /// Points along an edge, ends included; of a curve the end alone.
    points: Vec<DVec3>,
}

enum Of<'g> {
    Curve(&'g Geometry),
    Surface(SurfaceEdge<'g>),
}

/// Steps along an edge for comparing it with others.
pub(super) const STEPS: usize = 16;

/// An edge of a surface, counter-clockwise in its parameter plane.
#[derive(Clone)]
pub(super) struct Edge<'g> {
    pub(super) side: usize,
    surface: &'g dyn ParametricSurface,
    /// The parameters where it starts and where it ends.
    ends: [[f64; 2]; 2],
    edge: SurfaceEdge<'g>,
    /// Points along it, ends included.
    pub(super) points: Vec<DVec3>,
}

impl Edge<'_> {
    fn parameters(&self, s: f64) -> [f64; 2] {
        let [start, end] = self.ends;
        [0, 1].map(|axis| start[axis] * (1.0 - s) + end[axis] * s)
    }

    /// The surface's jet at a place from 0 to 1 along the edge, and the derivative along it.
    pub(super) fn jet(&self, s: f64) -> Result<(SurfaceJet, DVec3), ShapeError> {
        let [u, v] = self.parameters(s);
        let jet = self.surface.try_jet(u, v)?;
        let [start, end] = self.ends;
        Ok((jet, jet.du * (end[0] - start[0]) + jet.dv * (end[1] - start[1])))
    }
}

pub fn measure(shapes: &[(usize, &Geometry)], options: &Check) -> Result<Vec<PlainLine>, Failure> {
    let mut sides = Vec::new();
    for (shape, geometry) in shapes {
        // Where the middle of a shape is a pole, there is no telling where its edges are.
        if let Some(curve) = geometry.as_curve() {
            sides.extend(ends(*shape, geometry, curve));
        } else if let Some(surface) = geometry.as_surface() {
            sides.extend(edges(surface)?.into_iter().map(|edge| Side {
                shape: *shape,
                side: edge.side,
                of: Of::Surface(edge.edge),
                points: edge.points,
            }));
        }
    }
    let bounds = BoundingBox::from_points(sides.iter().flat_map(|side| side.points.iter().copied()));
    let size = bounds.map_or(0.0, |b| b.diagonal());
    let mut lines = Vec::new();
    for (a, b) in pairs(sides.iter().map(|side| &side.points[..]), ENDS * size) {
        let (a, b) = (&sides[a], &sides[b]);
        if let Some(opposed) = shared(a, b, ENDS * size) {
            lines.extend(join(a, b, opposed, size, options)?);
        }
    }
    Ok(lines)
}

fn ends<'g>(shape: usize, geometry: &'g Geometry, curve: &dyn ParametricCurve) -> Vec<Side<'g>> {
    let interval = curve.interval();
    let end = |side, t| {
        let point = curve.try_point(t).ok()?;
        Some(Side { shape, side, of: Of::Curve(geometry), points: vec![point] })
    };
    [end(0, interval.start()), end(1, interval.end())].into_iter().flatten().collect()
}

/// All edges that have no pole and are no points.
pub(super) fn edges(surface: &dyn ParametricSurface) -> Result<Vec<Edge<'_>>, ShapeError> {
    let all: Vec<(SurfaceEdge<'_>, [[f64; 2]; 2])> = match surface.domain() {
        SurfaceDomain::Rectangle([u, v]) => {
            let (a, b, c, d) = (u.start(), u.end(), v.start(), v.end());
            let edge = |edge| SurfaceEdge::of_patch(surface, edge);
            vec![
                (edge(PatchEdge::VStart)?, [[a, c], [b, c]]),
                (edge(PatchEdge::UEnd)?, [[b, c], [b, d]]),
                (edge(PatchEdge::VEnd)?.reversed(), [[b, d], [a, d]]),
                (edge(PatchEdge::UStart)?.reversed(), [[a, d], [a, c]]),
            ]
        }
        SurfaceDomain::Triangle => {
            let corners = [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]];
            let edge = |i: usize| {
                let ends = [corners[(i + 1) % 3], corners[(i + 2) % 3]];
                SurfaceEdge::of_triangle(surface, i).map(|edge| (edge, ends))
            };
            (0..3).map(edge).collect::<Result<_, _>>()?
        }
    };
    let mut edges = Vec::new();
    for (side, (edge, ends)) in all.into_iter().enumerate() {
        let mut edge = Edge { side, surface, ends, edge, points: Vec::new() };
        let at = |k: usize| {
            let [u, v] = edge.parameters(k as f64 / STEPS as f64);
            surface.try_point(u, v)
        };
        let Ok(points) = (0..=STEPS).map(at).collect::<Result<Vec<_>, _>>() else { continue };
        if points.iter().any(|p| *p != points[0]) {
            edge.points = points;
            edges.push(edge);
        }
    }
    Ok(edges)
}

/// Whether two sides are the same place or curve, and if so whether they run opposite ways.
fn shared(a: &Side<'_>, b: &Side<'_>, near: f64) -> Option<bool> {
    let hull = BoundingBox::from_points(a.points.iter().copied())?.diagonal();
    let follows = |opposed: bool| {
        let count = a.points.len();
        count == b.points.len()
            && a.points.iter().enumerate().all(|(k, p)| {
                let other = b.points[if opposed { count - 1 - k } else { k }];
                let most = if k == 0 || k + 1 == count { near } else { APART * hull };
                p.distance(other) <= most
            })
    };
    match (&a.of, &b.of) {
        (Of::Curve(_), Of::Curve(_)) => follows(false).then_some(a.side != b.side),
        (Of::Surface(_), Of::Surface(_)) if follows(true) => Some(true),
        (Of::Surface(_), Of::Surface(_)) => follows(false).then_some(false),
        _ => None,
    }
}

fn join(
    a: &Side<'_>,
    b: &Side<'_>,
    opposed: bool,
    size: f64,
    options: &Check,
) -> Result<Option<PlainLine>, Failure> {
    let report = match (&a.of, &b.of) {
        (Of::Curve(first), Of::Curve(second)) => {
            // An end, then a start; of two ends the first, of two starts the second is where the way leads.
            let (first, second) = if (a.side, b.side) == (0, 1) {
                ((second, 1), (first, 0))
            } else {
                ((first, a.side), (second, b.side))
            };
            let (Some(first), Some(second)) = (run(first.0, first.1 == 0)?, run(second.0, second.1 == 1)?)
            else {
                return Ok(None);
            };
            JoinReport::of_curves(first.as_ref(), second.as_ref())
        }
        (Of::Surface(first), Of::Surface(second)) => {
            let second = if opposed { second.reversed() } else { *second };
            JoinReport::along_edge(first, &second, options.samples as usize)
        }
        _ => return Ok(None),
    };
    // A pole in the neighbourhood of the joint: nothing can be said.
    let report = match report {
        Err(ShapeError::Evaluation { .. }) => return Ok(None),
        report => report?,
    };
    let tolerance = JoinTolerance {
        gap: options.position.unwrap_or(GAP * size),
        angle: options.angle,
        relative: options.curvature,
    };
    let met = report.continuity(&tolerance);
    let (geometric, parametric) = ([met.c0, met.g1, met.g2], [met.c0, met.c1, met.c2]);
    let name = |letter: char, met: [bool; 3]| match met.iter().take_while(|met| **met).count() {
        0 => "none".to_string(),
        count => format!("{letter}{}", count - 1),
    };
    let value = |maximum: Option<Maximum>| maximum.map(|m| m.value);
    Ok(Some(PlainLine {
        shapes: [a.shape, b.shape],
        sides: [a.side, b.side],
        opposed,
        promised: None,
        measured: name('G', geometric),
        parametric: name('C', parametric),
        figures: Figures { g0: report.gap.value, g1: value(report.angle), g2: value(report.curvature) },
        c1: value(report.first),
        c2: value(report.second),
        ok: true,
    }))
}

/// The curve, or the same run backwards.
fn run(geometry: &Geometry, backwards: bool) -> Result<Option<Box<dyn ParametricCurve>>, ShapeError> {
    Ok(Some(match geometry {
        Geometry::Curve(curve) if backwards => Box::new(curve.reversed()),
        Geometry::Curve(curve) => Box::new(curve.clone()),
        Geometry::RationalCurve(curve) if backwards => Box::new(curve.reversed()),
        Geometry::RationalCurve(curve) => Box::new(curve.clone()),
        Geometry::PowerCurve(curve) if backwards => Box::new(curve.to_bezier()?.reversed()),
        Geometry::PowerCurve(curve) => Box::new(curve.clone()),
        _ => return Ok(None),
    }))
}

pub fn text(line: &PlainLine, lines: &mut Lines) -> Result<(), Failure> {
    let ([a, b], [i, j]) = (line.shapes, line.sides);
    let what = format!("{:<36}", format!("  {a}, {i} meets {b}, {j}"));
    let row = row(&what, "–", &line.measured, &line.figures, true);
    lines.text(&format!("{row:<88} {}", line.parametric))
}
