//! Where shapes of a file meet: sides with common ends and, parameter by parameter, common points.

use casteljau::gb::{ConcavePatch, GbError, Location, Ribbon};
use casteljau::geom::{SurfaceJet, angle_degrees};
use casteljau::glam::DVec3;
use casteljau::shape::Curve;
use serde::Serialize;

use super::{Figures, Tolerances, order_name, row};
use crate::arguments::Check;
use crate::failure::Failure;
use crate::output::Lines;

/// Ends farther apart than this, in units of the model's size, do not belong together.
pub(super) const ENDS: f64 = 1e-6;
/// Curves with common ends that part farther than this, in units of their chord or hull, are different sides.
pub(super) const APART: f64 = 1e-2;
/// The largest gap that still counts as one curve, in units of the model's size.
pub(super) const GAP: f64 = 1e-9;
/// Ribbons at a larger angle, in degrees, are meant to form a crease.
const CREASE: f64 = 1e-2;
/// Ribbons whose normal curvatures differ by more, relative, are not meant to agree in them.
const BEND: f64 = 1e-3;

/// Two sides that meet. The promise is what the two ribbons prescribe, as far as both patches follow them: a common
/// curve G0, common tangent planes G1, common curvatures across G2. `opposed`: the sides run opposite ways, as they do
/// when both shapes have the same outside.
#[derive(Serialize)]
pub struct JoinLine {
    shapes: [usize; 2],
    sides: [usize; 2],
    opposed: bool,
    promised: String,
    measured: String,
    #[serde(flatten)]
    figures: Figures,
    pub ok: bool,
}

/// A side of a patch, with its number.
struct Side<'a> {
    patch: usize,
    side: usize,
    of: &'a ConcavePatch,
    ribbon: &'a Ribbon,
    curve: Curve,
}

pub fn measure(
    patches: &[&ConcavePatch],
    numbers: &[usize],
    options: &Check,
) -> Result<Vec<JoinLine>, Failure> {
    let boxes = patches.iter().map(|patch| patch.bounding_box());
    let size = boxes.reduce(|a, b| a.union(&b)).map_or(0.0, |all| all.diagonal());
    let mut sides = Vec::new();
    for (patch, of) in patches.iter().copied().enumerate() {
        for (side, ribbon) in of.ribbons().iter().enumerate() {
            sides.push(Side { patch, side, of, ribbon, curve: of.side_curve(side)? });
        }
    }
    let mut joins = Vec::new();
    for (a, b) in pairs(&sides, ENDS * size) {
        let (a, b) = (&sides[a], &sides[b]);
        if let Some(opposed) = shared(a, b, ENDS * size) {
            joins.push(join(a, b, opposed, size, numbers, options)?);
        }
    }
    Ok(joins)
}

/// Pairs of sides whose middles of the ends are near each other, found by sorting; in order of their numbers.
fn pairs(sides: &[Side<'_>], near: f64) -> Vec<(usize, usize)> {
    let middle = |i: usize| sides[i].curve.start().midpoint(sides[i].curve.end());
    let mut order: Vec<(f64, usize)> = (0..sides.len()).map(|i| (middle(i).x, i)).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut found = Vec::new();
    for (place, &(x, i)) in order.iter().enumerate() {
        for &(_, j) in order[place + 1..].iter().take_while(|(other, _)| other - x <= near) {
            if middle(i).distance(middle(j)) <= near {
                found.push((i.min(j), i.max(j)));
            }
        }
    }
    found.sort_unstable();
    found
}

/// Whether two sides follow one curve, and if so whether they run opposite ways.
fn shared(a: &Side<'_>, b: &Side<'_>, near: f64) -> Option<bool> {
    const SAMPLES: usize = 16;
    let ends = [a.curve.start(), a.curve.end()];
    let meets = |p: DVec3, q: DVec3| p.distance(ends[0]) <= near && q.distance(ends[1]) <= near;
    let (start, end) = (b.curve.start(), b.curve.end());
    let hull = a.curve.bounding_box().diagonal();
    let follows = |opposed: bool| {
        (1..SAMPLES).all(|i| {
            let t = i as f64 / SAMPLES as f64;
            let other = b.curve.point(if opposed { 1.0 - t } else { t });
            a.curve.point(t).distance(other) <= APART * hull
        })
    };
    if meets(end, start) && follows(true) {
        return Some(true);
    }
    (meets(start, end) && follows(false)).then_some(false)
}

fn join(
    a: &Side<'_>,
    b: &Side<'_>,
    opposed: bool,
    size: f64,
    numbers: &[usize],
    options: &Check,
) -> Result<JoinLine, Failure> {
    let samples = options.samples as usize;
    let (mut patches, mut ribbons) = (Largest::default(), Largest::default());
    for m in 0..samples {
        // Denser toward the corners, as the report on the sides.
        let t = (std::f64::consts::FRAC_PI_4 * (2 * m + 1) as f64 / samples as f64).sin().powi(2);
        let other = if opposed { 1.0 - t } else { t };
        patches.compare(&seen(a, t)?, &seen(b, other)?, opposed, size);
        if let (Some(first), Some(second)) = (a.ribbon.jet(t, 0.0), b.ribbon.jet(other, 0.0)) {
            let prescribed = |jet: SurfaceJet| Seen {
                point: jet.point,
                along: jet.du,
                normal: jet.normal(),
                jet: Some(jet),
            };
            ribbons.compare(&prescribed(first), &prescribed(second), opposed, size);
        }
    }
    let figures = patches.figures();
    let position = options.position.unwrap_or(GAP * size);
    // The patches may differ by what the ribbons differ, and no more.
    let meant = ribbons.figures();
    let tolerances = Tolerances {
        position,
        angle: options.angle + meant.g1.filter(|x| *x <= CREASE).unwrap_or(0.0),
        curvature: options.curvature + meant.g2.filter(|x| *x <= BEND).unwrap_or(0.0),
    };
    let order = a.of.continuity()[a.side].geometric().min(b.of.continuity()[b.side].geometric());
    let smooth = order >= 1 && meant.g1.is_some_and(|x| x <= CREASE);
    let bent_alike = smooth && order >= 2 && meant.g2.is_some_and(|x| x <= BEND);
    let promised = usize::from(smooth) + usize::from(bent_alike);
    let measured = figures.measured(&tolerances);
    Ok(JoinLine {
        shapes: [numbers[a.patch], numbers[b.patch]],
        sides: [a.side, b.side],
        opposed,
        promised: format!("G{promised}"),
        measured: order_name(measured),
        figures,
        ok: measured.is_some_and(|measured| measured >= promised),
    })
}

/// A surface at a place on a side.
struct Seen {
    point: DVec3,
    /// The direction of the side.
    along: DVec3,
    normal: Option<DVec3>,
    jet: Option<SurfaceJet>,
}

/// The patch from inside: its own normal there, which is not taken from the ribbon.
fn seen(side: &Side<'_>, t: f64) -> Result<Seen, GbError> {
    let location = Location::Side { side: side.side, t };
    let jet = side.of.jet_at(location)?;
    let outside = side.of.normal_at(location).ok();
    let toward = |normal: DVec3| if outside.is_some_and(|n| n.dot(normal) < 0.0) { -normal } else { normal };
    let point = side.of.point_at(location)?;
    Ok(Seen { point, along: side.curve.jet(t).d1, normal: jet.normal().map(toward), jet: Some(jet) })
}

/// The largest figures so far.
#[derive(Default)]
struct Largest {
    g0: f64,
    g1: Option<f64>,
    g2: Option<f64>,
}

impl Largest {
    fn compare(&mut self, a: &Seen, b: &Seen, opposed: bool, size: f64) {
        let raise =
            |slot: &mut Option<f64>, value: f64| *slot = Some(slot.map_or(value, |old: f64| old.max(value)));
        self.g0 = self.g0.max(a.point.distance(b.point));
        let (Some(m), Some(n)) = (a.normal, b.normal) else { return };
        // Sides that run the same way have their shapes' outsides on different sides.
        let sign = if opposed { 1.0 } else { -1.0 };
        raise(&mut self.g1, angle_degrees(m, sign * n));
        if let (Some(first), Some(second)) = (bending(a, m), bending(b, n)) {
            let second = sign * second;
            let scale = first.abs().max(second.abs()).max(1.0 / size);
            raise(&mut self.g2, (first - second).abs() / scale);
        }
    }

    fn figures(&self) -> Figures {
        Figures { g0: self.g0, g1: self.g1, g2: self.g2 }
    }
}

/// Normal curvature across the side, toward the normal that is given: Euler's formula κ₁ cos² + κ₂ sin².
fn bending(seen: &Seen, normal: DVec3) -> Option<f64> {
    let jet = seen.jet?;
    let curvatures = jet.curvatures()?;
    let across = normal.cross(seen.along).try_normalize()?;
    let [first, second] = curvatures.directions.map(|d| d.dot(across).powi(2));
    let toward = jet.normal()?.dot(normal).signum();
    Some(toward * (curvatures.principal[0] * first + curvatures.principal[1] * second))
}

pub fn text(line: &JoinLine, lines: &mut Lines) -> Result<(), Failure> {
    let ([a, b], [i, j]) = (line.shapes, line.sides);
    // Sides of shapes that have one outside run opposite ways.
    let turned = if line.opposed { "" } else { ", inside out" };
    let what = format!("  {a}, {i} meets {b}, {j}{turned}");
    let row = row(&format!("{what:<36}"), &line.promised, &line.measured, &line.figures, line.ok);
    lines.text(row.trim_end())
}
