//! Where shapes of a file meet: sides with common ends and, parameter by parameter, common points.

use casteljau::gb::{ConcavePatch, GbError, Location, Ribbon};
use casteljau::geom::{BoundingBox, SurfaceJet, angle_degrees};
use casteljau::glam::DVec3;
use casteljau::io::Geometry;
use casteljau::shape::Curve;
use serde::Serialize;

use super::plain::{Edge, STEPS, edges};
use super::{Figures, Tolerances, order_name, pairs, row};
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

/// Two sides that meet, one of them of a GB patch. The promise is what the two ribbons, or a ribbon and the other surface,
/// prescribe, as far as the patches follow them: a common curve G0, common tangent planes G1, common curvatures across
/// G2. `opposed`: the sides run opposite ways, as they do
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

/// A side of a shape.
struct Side<'a> {
    shape: usize,
    side: usize,
    of: Of<'a>,
    /// Points at equal steps of the parameter, ends included.
    points: Vec<DVec3>,
}

enum Of<'a> {
    Ribbon { patch: &'a ConcavePatch, ribbon: &'a Ribbon, curve: Curve },
    Edge(Edge<'a>),
}

/// Where GB patches meet each other, and where they meet other surfaces. Shapes come with their numbers.
pub fn measure(
    patches: &[(usize, &ConcavePatch)],
    others: &[(usize, &Geometry)],
    options: &Check,
) -> Result<Vec<JoinLine>, Failure> {
    let mut sides = Vec::new();
    for &(shape, patch) in patches {
        for (side, ribbon) in patch.ribbons().iter().enumerate() {
            let curve = patch.side_curve(side)?;
            let points = (0..=STEPS).map(|k| curve.point(k as f64 / STEPS as f64)).collect();
            sides.push(Side { shape, side, of: Of::Ribbon { patch, ribbon, curve }, points });
        }
    }
    let ribbons = sides.len();
    for &(shape, geometry) in others.iter().filter(|_| ribbons > 0) {
        for edge in geometry.as_surface().map(edges).transpose()?.unwrap_or_default() {
            let (side, points) = (edge.side, edge.points.clone());
            sides.push(Side { shape, side, of: Of::Edge(edge), points });
        }
    }
    let bounds = BoundingBox::from_points(sides.iter().flat_map(|side| side.points.iter().copied()));
    let boxes = patches.iter().map(|(_, patch)| patch.bounding_box());
    let size = bounds.into_iter().chain(boxes).reduce(|a, b| a.union(&b)).map_or(0.0, |all| all.diagonal());
    let mut joins = Vec::new();
    for (a, b) in pairs(sides.iter().map(|side| &side.points[..]), ENDS * size) {
        // The other surfaces among themselves are somebody else's.
        if a >= ribbons {
            continue;
        }
        let (a, b) = (&sides[a], &sides[b]);
        if let Some(opposed) = shared(a, b, ENDS * size) {
            joins.extend(join(a, b, opposed, size, options)?);
        }
    }
    Ok(joins)
}

/// Whether two sides follow one curve, and if so whether they run opposite ways.
fn shared(a: &Side<'_>, b: &Side<'_>, near: f64) -> Option<bool> {
    let hull = BoundingBox::from_points(a.points.iter().copied())?.diagonal();
    let follows = |opposed: bool| {
        a.points.iter().enumerate().all(|(k, p)| {
            let other = b.points[if opposed { STEPS - k } else { k }];
            p.distance(other) <= if k == 0 || k == STEPS { near } else { APART * hull }
        })
    };
    if follows(true) {
        return Some(true);
    }
    follows(false).then_some(false)
}

/// None where a neighbourhood cannot be evaluated, as at a pole.
fn join(
    a: &Side<'_>,
    b: &Side<'_>,
    opposed: bool,
    size: f64,
    options: &Check,
) -> Result<Option<JoinLine>, Failure> {
    let samples = options.samples as usize;
    let (mut shapes, mut prescribed) = (Largest::default(), Largest::default());
    for m in 0..samples {
        // Denser toward the corners, as the report on the sides.
        let t = (std::f64::consts::FRAC_PI_4 * (2 * m + 1) as f64 / samples as f64).sin().powi(2);
        let other = if opposed { 1.0 - t } else { t };
        let (Some(first), Some(second)) = (a.seen(t)?, b.seen(other)?) else { return Ok(None) };
        shapes.compare(&first, &second, opposed, size);
        if let (Some(first), Some(second)) = (a.prescribed(t)?, b.prescribed(other)?) {
            prescribed.compare(&first, &second, opposed, size);
        }
    }
    let figures = shapes.figures();
    let position = options.position.unwrap_or(GAP * size);
    // The patches may differ by what the ribbons differ, and no more.
    let meant = prescribed.figures();
    let tolerances = Tolerances {
        position,
        angle: options.angle + meant.g1.filter(|x| *x <= CREASE).unwrap_or(0.0),
        curvature: options.curvature + meant.g2.filter(|x| *x <= BEND).unwrap_or(0.0),
    };
    let order = a.kept().min(b.kept());
    let smooth = order >= 1 && meant.g1.is_some_and(|x| x <= CREASE);
    let bent_alike = smooth && order >= 2 && meant.g2.is_some_and(|x| x <= BEND);
    let promised = usize::from(smooth) + usize::from(bent_alike);
    let measured = figures.measured(&tolerances);
    Ok(Some(JoinLine {
        shapes: [a.shape, b.shape],
        sides: [a.side, b.side],
        opposed,
        promised: format!("G{promised}"),
        measured: order_name(measured),
        figures,
        ok: measured.is_some_and(|measured| measured >= promised),
    }))
}

/// A surface at a place on a side.
struct Seen {
    point: DVec3,
    /// The direction of the side.
    along: DVec3,
    normal: Option<DVec3>,
    jet: Option<SurfaceJet>,
}

impl Side<'_> {
    /// The continuity that the shape keeps with what is prescribed on this side: a surface is that itself.
    fn kept(&self) -> usize {
        match &self.of {
            Of::Ribbon { patch, .. } => patch.continuity()[self.side].geometric(),
            Of::Edge(_) => usize::MAX,
        }
    }

    /// The shape from inside: a patch's own normal there, which is not taken from the ribbon.
    fn seen(&self, t: f64) -> Result<Option<Seen>, GbError> {
        let Of::Ribbon { patch, curve, .. } = &self.of else { return Ok(self.on_edge(t)) };
        let location = Location::Side { side: self.side, t };
        let jet = patch.jet_at(location)?;
        let outside = patch.normal_at(location).ok();
        let toward =
            |normal: DVec3| if outside.is_some_and(|n| n.dot(normal) < 0.0) { -normal } else { normal };
        let point = patch.point_at(location)?;
        let (along, normal) = (curve.jet(t).d1, jet.normal().map(toward));
        Ok(Some(Seen { point, along, normal, jet: Some(jet) }))
    }

    /// What the shape should be on this side: the ribbon, or the surface itself.
    fn prescribed(&self, t: f64) -> Result<Option<Seen>, GbError> {
        let Of::Ribbon { ribbon, .. } = &self.of else { return Ok(self.on_edge(t)) };
        Ok(ribbon.jet(t, 0.0).map(|jet| Seen {
            point: jet.point,
            along: jet.du,
            normal: jet.normal(),
            jet: Some(jet),
        }))
    }

    fn on_edge(&self, t: f64) -> Option<Seen> {
        let Of::Edge(edge) = &self.of else { return None };
        let (jet, along) = edge.jet(t).ok()?;
        Some(Seen { point: jet.point, along, normal: jet.normal(), jet: Some(jet) })
    }
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
