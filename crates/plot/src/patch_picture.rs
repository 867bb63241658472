use casteljau_gb::{ConcavePatch, Location, SampleSet};
use casteljau_geom::glam::{DVec2, DVec3};
use casteljau_geom::{BoundingBox, SurfaceJet};

use crate::canvas::{Frame, Margins, extent, finish, text};
use crate::color::{FAINT, INK, NETS, diverging};
use crate::contour::contours;
use crate::decoration::{axes_and_scale, color_bar};
use crate::domain_picture::check_counts;
use crate::sampling::Sampling;
use crate::scene::{Pen, Scene};
use crate::shade::{Skin, color_scale, shade};
use crate::{PlotError, View};

/// How the surface itself is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Shading {
    /// Not at all: lines alone, none hidden.
    None,
    /// As a dull body in the light of one lamp, blue where the normal looks at the eye, tan on the other side.
    #[default]
    Light,
    /// By Gaussian curvature K.
    Gaussian,
    /// By mean curvature H, positive where the surface bends toward its normal.
    Mean,
}

/// Which lines are drawn on the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Isolines {
    /// None.
    None,
    /// Lines of constant u and of constant v, the domain's own plane.
    #[default]
    Grid,
    /// Lines of constant s and of constant h of one side.
    Side(usize),
    /// Lines of constant h of every side, for h < 1/2.
    Distances,
}

/// What [`patch_picture`] shows.
#[derive(Clone, Debug, PartialEq)]
pub struct PatchStyle {
    /// Where the eye is.
    pub view: View,
    /// How the surface is drawn.
    pub shading: Shading,
    /// Lines on the surface.
    pub isolines: Isolines,
    /// Number of lines of a family.
    pub levels: usize,
    /// Whether the control nets of the ribbons are drawn.
    pub net: bool,
    /// Triangles wanted, in all.
    pub triangles: usize,
    /// Width of the picture in pixels.
    pub width: u32,
}

impl Default for PatchStyle {
    fn default() -> Self {
        Self {
            view: View::default(),
            shading: Shading::default(),
            isolines: Isolines::default(),
            levels: 15,
            net: true,
            triangles: 4000,
            width: 800,
        }
    }
}

/// One patch, sampled.
struct Sampled<'a> {
    patch: &'a ConcavePatch,
    sampling: Sampling,
    points: Vec<DVec3>,
    normals: Vec<DVec3>,
}

impl Sampled<'_> {
    /// Longest edge of the triangles in space.
    fn longest_edge(&self) -> f64 {
        let edges = self.sampling.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let length = |[a, b]: [u32; 2]| self.points[a as usize].distance(self.points[b as usize]);
        edges.map(length).fold(0.0, f64::max)
    }
}

/// Draws GB patches: surface, side curves, isolines and control nets.
///
/// Points on lines and surface are the patch's own. What lies behind the surface is hidden by the painter's algorithm, which
/// is right to the size of a triangle. Curvature colours are scaled so that one value in twenty is beyond the bar.
///
/// # Errors
/// No patch, a side that does not exist, numbers of the style out of range, a shape that leaves the range of numbers.
///
/// Cost: about 10 µs a triangle; the file has about 75 bytes a triangle.
pub fn patch_picture(patches: &[ConcavePatch], style: &PatchStyle) -> Result<String, PlotError> {
    check_counts(style.width, style.levels, style.triangles)?;
    let count = style.triangles / patches.len().max(1);
    let sampled = patches.iter().map(|patch| sample(patch, count)).collect::<Result<Vec<_>, _>>()?;
    let nets = || patches.iter().flat_map(|p| p.ribbons()).flat_map(|r| r.control_points().iter().copied());
    let shown: Vec<DVec3> = sampled.iter().flat_map(|s| s.points.iter().copied()).collect();
    let size = BoundingBox::from_points(shown.iter().copied()).ok_or(PlotError::Nothing)?.diagonal();
    let all = shown.into_iter().chain(nets().filter(|_| style.net));
    let margins = Margins { side: 30.0, top: 66.0, bottom: 92.0 };
    let frame = Frame::new(extent(all.map(|p| style.view.project(p)))?, style.width, &margins)?;

    // Of a closed body the far side is never seen: what lies on it is left out, down to the last stroke.
    let closed = style.shading != Shading::None && is_closed(patches);
    let longest = sampled.iter().map(Sampled::longest_edge).fold(0.0, f64::max);
    let mut scene = Scene::new(style.view, longest.max(size / 200.0));
    let curvature = curvature_scale(&sampled, style.shading);
    for part in &sampled {
        surface(&mut scene, part, style, curvature, closed);
    }
    let isoline = scene.pen(Pen { color: "#52606d", width: 0.7, lift: 0.4 * longest });
    let side = scene.pen(Pen { color: INK, width: 2.2, lift: 0.8 * longest });
    for part in &sampled {
        isolines(&mut scene, part, style, &Trace { pen: isoline, hidden: closed.then_some(style.view) })?;
        boundary(&mut scene, part.patch, side, closed.then_some(style.view))?;
    }
    if style.net {
        // The net of a single patch lies before it; among several, nets are hidden like everything else.
        let lift = if patches.len() == 1 { 4.0 * size } else { longest };
        let mut first = 0;
        for patch in patches {
            net(&mut scene, patch, first, lift, closed.then_some(style.view));
            first += patch.sides();
        }
    }

    let title = title(patches);
    let mut page = frame.page(&title).add(scene.paint(&frame)).add(axes_and_scale(&frame, &style.view));
    if let Some(scale) = curvature {
        let label = if style.shading == Shading::Mean { "mean curvature" } else { "Gaussian curvature" };
        page = page.add(color_bar(&frame, [-scale, scale], label, diverging));
    }
    page = page.add(text(&title, DVec2::new(20.0, 27.0), "start").set("font-size", 15));
    Ok(finish(&page))
}

fn title(patches: &[ConcavePatch]) -> String {
    match patches {
        [patch] => {
            let range = |of: fn(&casteljau_gb::Ribbon) -> usize| {
                let (least, most) =
                    patch.ribbons().iter().map(of).fold((usize::MAX, 0), |(a, b), x| (a.min(x), b.max(x)));
                if least == most { least.to_string() } else { format!("{least}–{most}") }
            };
            let degree = range(casteljau_gb::Ribbon::degree);
            let layers = range(casteljau_gb::Ribbon::layers);
            format!("GB patch, {} sides, degree {degree}, layers {layers}", patch.sides())
        }
        _ => format!("{} GB patches", patches.len()),
    }
}

fn sample(patch: &ConcavePatch, count: usize) -> Result<Sampled<'_>, PlotError> {
    let sampling = Sampling::new(patch.domain(), count)?;
    let (points, normals) = sampling.surface(patch)?;
    Ok(Sampled { patch, sampling, points, normals })
}

/// Gaussian or mean curvature at a point of the sampling; NaN where there is none.
fn curvature(part: &Sampled<'_>, shading: Shading, index: usize) -> f64 {
    // With respect to the patch's normal, which does not depend on the way the domain runs.
    let value = |jet: SurfaceJet| {
        let curvatures = jet.curvatures()?;
        let sign = jet.normal()?.dot(part.normals[index]).signum();
        Some(if shading == Shading::Mean { sign * curvatures.mean } else { curvatures.gaussian })
    };
    part.patch.jet_at(part.sampling.locations[index]).ok().and_then(value).unwrap_or(f64::NAN)
}

fn curvature_scale(parts: &[Sampled<'_>], shading: Shading) -> Option<f64> {
    matches!(shading, Shading::Gaussian | Shading::Mean).then(|| {
        color_scale(
            parts.iter().flat_map(|part| (0..part.points.len()).map(move |i| curvature(part, shading, i))),
        )
    })
}

fn surface(scene: &mut Scene, part: &Sampled<'_>, style: &PatchStyle, scale: Option<f64>, closed: bool) {
    if style.shading == Shading::None {
        return;
    }
    let values: Vec<f64> = match scale {
        Some(scale) => (0..part.points.len()).map(|i| curvature(part, style.shading, i) / scale).collect(),
        None => Vec::new(),
    };
    let Sampled { points, normals, sampling, .. } = part;
    let skin = Skin { points, normals, triangles: &sampling.triangles, values: &values };
    shade(scene, &skin, &style.view, closed);
}

/// The side curves. With `hidden`, those pieces are left out where the patch's own normal looks away: the neighbour has them.
fn boundary(
    scene: &mut Scene,
    patch: &ConcavePatch,
    pen: usize,
    hidden: Option<View>,
) -> Result<(), PlotError> {
    const PIECES: usize = 48;
    for side in 0..patch.sides() {
        let curve = patch.side_curve(side)?;
        let points: Vec<DVec3> = (0..=PIECES).map(|i| curve.point(i as f64 / PIECES as f64)).collect();
        for (i, ends) in points.windows(2).enumerate() {
            let t = (i as f64 + 0.5) / PIECES as f64;
            if seen_on_side(patch, side, t, hidden) {
                scene.line(ends, pen);
            }
        }
    }
    Ok(())
}

/// Whether the patch beside a place on a side is on the near side.
fn seen_on_side(patch: &ConcavePatch, side: usize, t: f64, hidden: Option<View>) -> bool {
    let normal = || patch.normal_at(Location::Side { side, t });
    hidden.is_none_or(|view| normal().is_ok_and(|n| n.dot(view.toward()) > 0.0))
}

/// The control nets. With `hidden`, those layers of a ribbon are left out that lie on the far side as seen from there.
fn net(scene: &mut Scene, patch: &ConcavePatch, first: usize, lift: f64, hidden: Option<View>) {
    for (side, ribbon) in patch.ribbons().iter().enumerate() {
        let color = NETS[(first + side) % NETS.len()];
        let pen = scene.pen(Pen { color, width: 1.0, lift });
        let degree = ribbon.degree();
        // Of the column j, judged by the normal at the side.
        let seen = |j: usize| {
            let t = (j as f64 / degree as f64).clamp(0.01, 0.99);
            seen_on_side(patch, side, t, hidden)
        };
        for (j, point) in ribbon.row(0).iter().enumerate() {
            if seen(j) {
                scene.dot(*point, 3.0, pen);
            }
        }
        for k in 0..ribbon.layers() {
            for j in (0..degree).filter(|&j| seen(j) && seen(j + 1)) {
                scene.line(&ribbon.row(k)[j..j + 2], pen);
            }
        }
        for j in (0..=degree).filter(|&j| seen(j)) {
            let column: Vec<DVec3> = (0..ribbon.layers()).filter_map(|k| ribbon.point(j, k)).collect();
            column.iter().skip(1).for_each(|&point| scene.dot(point, 2.3, pen));
            scene.line(&column, pen);
        }
    }
    let used = patch.center().filter(|_| patch.center_weight() != casteljau_gb::CenterWeight::None);
    let extra = patch.corner_points().iter().map(|c| c.point);
    let pen = scene.pen(Pen { color: FAINT, width: 1.0, lift });
    for point in used.into_iter().chain(extra) {
        scene.dot(point, 3.5, pen);
    }
}

/// Whether every side runs along another one the other way.
fn is_closed(patches: &[ConcavePatch]) -> bool {
    let rows = || patches.iter().flat_map(ConcavePatch::ribbons).map(|ribbon| ribbon.row(0));
    let opposite = |row: &[DVec3]| rows().any(|other| other.iter().rev().eq(row));
    patches.len() > 1 && rows().all(opposite)
}

/// How isolines are drawn.
struct Trace {
    pen: usize,
    /// The view whose far side is left out.
    hidden: Option<View>,
}

fn isolines(scene: &mut Scene, part: &Sampled<'_>, style: &PatchStyle, how: &Trace) -> Result<(), PlotError> {
    let (sampling, patch) = (&part.sampling, part.patch);
    let n = patch.sides();
    if style.isolines == Isolines::None || style.levels == 0 {
        return Ok(());
    }
    let lambda = sampling.coordinates(patch.coordinates())?;
    let pair = |point: usize, side: usize| {
        let row = &lambda[point * n..(point + 1) * n];
        (row[(side + n - 1) % n], row[side])
    };
    let points = || 0..sampling.points.len();
    let distance =
        |side: usize| points().map(|p| 1.0 - pair(p, side).0 - pair(p, side).1).collect::<Vec<f64>>();
    let inner = |range: [f64; 2]| {
        let count = style.levels;
        (1..=count).map(move |j| range[0] + (range[1] - range[0]) * j as f64 / (count + 1) as f64)
    };
    let mut draw = |values: &[f64], level: f64| trace(scene, part, values, level, how);
    match style.isolines {
        Isolines::None => {}
        Isolines::Grid => {
            let [low, high] = patch.domain().bounding_box();
            // The same spacing both ways.
            let step = (high - low).max_element() / (style.levels + 1) as f64;
            for axis in 0..2 {
                let values: Vec<f64> = sampling.points.iter().map(|p| p[axis]).collect();
                let count = ((high[axis] - low[axis]) / step).ceil() as usize;
                for j in 1..count {
                    draw(&values, low[axis] + j as f64 * step)?;
                }
            }
        }
        Isolines::Side(index) if index >= n => {
            return Err(PlotError::NoSuch { what: "side", index, count: n });
        }
        Isolines::Side(side) => {
            let along: Vec<f64> = points()
                .map(|p| {
                    let (before, at) = pair(p, side);
                    at / (before + at)
                })
                .collect();
            let across = distance(side);
            for level in inner([0.0, 1.0]) {
                draw(&along, level)?;
                draw(&across, level)?;
            }
        }
        Isolines::Distances => {
            for side in 0..n {
                let across = distance(side);
                for level in inner([0.0, 0.5]) {
                    draw(&across, level)?;
                }
            }
        }
    }
    Ok(())
}

/// Finds a level line in the domain and draws its image on the surface.
fn trace(
    scene: &mut Scene,
    part: &Sampled<'_>,
    values: &[f64],
    level: f64,
    how: &Trace,
) -> Result<(), PlotError> {
    let sampling = &part.sampling;
    for line in contours(&sampling.points, &sampling.triangles, values, level, &mut |_, _, t| t) {
        let domain = part.patch.domain();
        let on_patch = |&p: &DVec2| match domain.locate(p) {
            // An end on a side may have left the polygon by rounding.
            Location::Outside => None,
            location => Some(location),
        };
        let locations: Vec<_> = line.points.iter().filter_map(on_patch).collect();
        let set = SampleSet::new(part.patch.coordinates(), &locations, 1)?;
        let mut image = vec![DVec3::ZERO; set.len()];
        let mut normals = image.clone();
        part.patch.evaluate_sample_normals(&set, &mut image, &mut normals)?;
        if line.closed {
            image.extend(image.first().copied());
            normals.extend(normals.first().copied());
        }
        let seen = |normal: &DVec3| how.hidden.is_none_or(|view| normal.dot(view.toward()) > 0.0);
        for (ends, normals) in image.windows(2).zip(normals.windows(2)) {
            if normals.iter().all(seen) {
                scene.line(ends, how.pen);
            }
        }
    }
    Ok(())
}
