//! Curves with their control polygons, curvature combs, frames, and de Casteljau's construction.

use casteljau_geom::glam::{DVec2, DVec3, DVec4};
use casteljau_geom::{BoundingBox, CurveJet};
use casteljau_shape::bernstein::{de_casteljau_scheme, scheme_count};
use casteljau_shape::{ParametricCurve, RationalCurve};

use crate::canvas::{Frame, Margins, extent, finish, text};
use crate::color::{ACCENT, FAINT, INK, NETS};
use crate::decoration::{axes_and_scale, short};
use crate::domain_picture::check_counts;
use crate::scene::{Pen, Scene};
use crate::shapes::in_space;
use crate::{CurveShape, PlotError, View};

/// Pieces that a curve is drawn in.
const PIECES: usize = 400;
/// Places of a comb's crest.
const CREST: usize = 600;
/// Of these, one in so many has its tooth drawn.
const TOOTH_STEP: usize = 6;
/// Most frames along a curve.
const MOST_FRAMES: usize = 100;
/// The longest tooth, in units of the size of what is drawn.
const TOOTH: f64 = 0.25;
/// The arms of a frame, in the same unit.
const ARM: f64 = 0.09;

/// What [`curve_picture`] shows.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveStyle {
    /// Where the eye is; `None`: above a curve in a plane z = const, else the default view.
    pub view: Option<View>,
    /// Whether the control polygons are drawn.
    pub polygon: bool,
    /// Whether curvature combs are drawn: at C(t) the vector −κN, on the outside of the bend, with one scale for all.
    pub comb: bool,
    /// How many Frenet frames are drawn along each curve: tangent red, principal normal green, binormal blue.
    pub frames: usize,
    /// The parameter at which de Casteljau's construction is drawn, all levels of it.
    pub construction: Option<f64>,
    /// Width of the picture in pixels.
    pub width: u32,
}

impl Default for CurveStyle {
    fn default() -> Self {
        Self { view: None, polygon: true, comb: false, frames: 0, construction: None, width: 800 }
    }
}

/// Draws curves.
///
/// Where a comb or a frame has no answer (C′ = 0, no osculating plane) it is left out. The longest tooth of the combs is a
/// quarter of the picture's size, unless a twentieth of the teeth would be longer than that: these are cut there.
///
/// # Errors
/// No curve, numbers of the style out of range, a pole among the places drawn, a shape that leaves the range of numbers.
///
/// ```
/// use casteljau_plot::{CurveShape, CurveStyle, curve_picture};
/// use casteljau_shape::{Curve, geom::glam::DVec3};
/// let arch = Curve::new([DVec3::ZERO, DVec3::Y, DVec3::X + DVec3::Y, DVec3::X])?;
/// let style = CurveStyle { comb: true, construction: Some(0.4), ..CurveStyle::default() };
/// assert!(curve_picture(&[CurveShape::from(&arch)], &style)?.starts_with("<svg"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn curve_picture(curves: &[CurveShape], style: &CurveStyle) -> Result<String, PlotError> {
    check_counts(style.width, 0, 1)?;
    if style.frames > MOST_FRAMES {
        let (value, most) = (style.frames as f64, MOST_FRAMES as f64);
        return Err(PlotError::Option { option: "number of frames", value, least: 0.0, most });
    }
    let traces = curves.iter().map(|CurveShape(curve)| trace(curve)).collect::<Result<Vec<_>, _>>()?;
    let polygons: Vec<Vec<DVec3>> = curves.iter().map(|CurveShape(curve)| polygon(curve)).collect();
    let mut shown: Vec<DVec3> = traces.iter().flatten().copied().collect();
    if style.polygon {
        shown.extend(polygons.iter().flatten());
    }
    let size = BoundingBox::from_points(shown.iter().copied()).ok_or(PlotError::Nothing)?.diagonal();
    let combs = if style.comb { combs(curves, size)? } else { Vec::new() };
    let constructions = match style.construction {
        Some(t) => curves.iter().map(|CurveShape(curve)| construction(curve, t)).collect::<Result<_, _>>()?,
        None => Vec::new(),
    };
    shown.extend(combs.iter().flatten().map(|tooth| tooth[1]));
    shown.extend(constructions.iter().flatten().flatten());
    let view = style.view.unwrap_or_else(|| natural_view(&shown));
    let margins = Margins { side: 40.0, top: 66.0, bottom: 92.0 };
    let frame = Frame::new(extent(shown.iter().map(|&p| view.project(p)))?, style.width, &margins)?;

    // Nothing hides anything: what matters more is lifted higher.
    let mut scene = Scene::new(view, size / 50.0);
    let mut pen = |color, width, height: f64| scene.pen(Pen { color, width, lift: 4.0 * height * size });
    let teeth = pen("#6a9fb5", 0.8, 0.0);
    let crest = pen("#00838f", 1.4, 1.0);
    let outline = pen(FAINT, 1.2, 2.0);
    let line = pen(INK, 2.4, 3.0);
    let levels: Vec<usize> = NETS.iter().map(|&color| pen(color, 1.3, 4.0)).collect();
    let frames = ["#c62828", "#2e7d32", "#1565c0"].map(|color| pen(color, 1.8, 5.0));
    let point = pen(ACCENT, 1.0, 6.0);
    for comb in &combs {
        comb.iter().step_by(TOOTH_STEP).for_each(|tooth| scene.line(tooth, teeth));
        scene.line(&comb.iter().map(|tooth| tooth[1]).collect::<Vec<_>>(), crest);
    }
    for trace in &traces {
        scene.line(trace, line);
    }
    if style.polygon {
        for polygon in &polygons {
            scene.line(polygon, outline);
            polygon.iter().for_each(|&p| scene.dot(p, 3.4, outline));
        }
    }
    for scheme in &constructions {
        for (level, points) in scheme.iter().enumerate() {
            let pen = levels[level % levels.len()];
            scene.line(points, pen);
            points.iter().for_each(|&p| scene.dot(p, 2.8, pen));
        }
        if let Some([last]) = scheme.last().map(Vec::as_slice) {
            scene.dot(*last, 5.0, point);
        }
    }
    for CurveShape(curve) in curves {
        for t in spread(curve, style.frames) {
            let jet = curve.try_jet(t)?;
            let Some(found) = jet.frenet_frame() else { continue };
            for (arm, pen) in [found.tangent, found.normal, found.binormal].into_iter().zip(frames) {
                scene.line(&[jet.point, jet.point + arm * (ARM * size)], pen);
            }
        }
    }
    let title = title(curves, style);
    let page = frame.page(&title).add(scene.paint(&frame)).add(axes_and_scale(&frame, &view));
    Ok(finish(&page.add(text(&title, DVec2::new(20.0, 27.0), "start").set("font-size", 15))))
}

fn title(curves: &[CurveShape], style: &CurveStyle) -> String {
    let what = match curves {
        [CurveShape(curve)] => {
            let rational = curve.weights().any(|w| w != 1.0);
            format!(
                "{} of degree {}",
                if rational { "rational Bézier curve" } else { "Bézier curve" },
                curve.degree()
            )
        }
        _ => format!("{} Bézier curves", curves.len()),
    };
    match style.construction {
        Some(t) => format!("{what}, de Casteljau's construction at t = {}", short(t)),
        None => what,
    }
}

/// From above where all points have one height.
fn natural_view(points: &[DVec3]) -> View {
    let flat = points.iter().all(|p| p.z == points[0].z);
    if flat { View::from_angles(-90.0, 90.0) } else { View::default() }
}

/// `count` parameters in the middle of as many equal pieces.
fn spread(curve: &RationalCurve, count: usize) -> impl Iterator<Item = f64> {
    let interval = curve.interval();
    (0..count).map(move |i| interval.at((i as f64 + 0.5) / count as f64))
}

fn trace(curve: &RationalCurve) -> Result<Vec<DVec3>, PlotError> {
    let at = |i: usize| curve.try_point(curve.interval().at(i as f64 / PIECES as f64));
    Ok((0..=PIECES).map(at).collect::<Result<_, _>>()?)
}

fn polygon(curve: &RationalCurve) -> Vec<DVec3> {
    curve.control_points().iter().filter_map(|&p| in_space(p)).collect()
}

/// The teeth of each curve, from the curve outwards, with one scale for all.
fn combs(curves: &[CurveShape], size: f64) -> Result<Vec<Vec<[DVec3; 2]>>, PlotError> {
    let mut all = Vec::with_capacity(curves.len());
    let mut lengths = Vec::new();
    for CurveShape(curve) in curves {
        let interval = curve.interval();
        let mut teeth = Vec::with_capacity(CREST + 1);
        for i in 0..=CREST {
            let jet = curve.try_jet(interval.at(i as f64 / CREST as f64))?;
            if let Some(bend) = bend(&jet) {
                lengths.push(bend.length());
                teeth.push([jet.point, -bend]);
            }
        }
        all.push(teeth);
    }
    lengths.sort_by(f64::total_cmp);
    let longest = lengths.get(lengths.len() * 19 / 20).copied().unwrap_or(0.0);
    let most = TOOTH * size;
    for [from, to] in all.iter_mut().flatten() {
        let tooth = if longest > 0.0 { *to * (most / longest) } else { DVec3::ZERO };
        *to = *from + tooth.clamp_length_max(most);
    }
    Ok(all)
}

/// The curvature vector κN = (C′ × C″) × C′ / |C′|⁴.
fn bend(jet: &CurveJet) -> Option<DVec3> {
    let (tangent, speed) = (jet.tangent()?, jet.d1.length());
    let across = jet.d2 - tangent * tangent.dot(jet.d2);
    let bend = across / speed / speed;
    bend.is_finite().then_some(bend)
}

/// The levels of de Casteljau's scheme after the control polygon, in space.
fn construction(curve: &RationalCurve, t: f64) -> Result<Vec<Vec<DVec3>>, PlotError> {
    if !t.is_finite() {
        return Err(PlotError::NotFinite);
    }
    let n = curve.degree();
    let mut scheme = vec![DVec4::ZERO; scheme_count(n)];
    de_casteljau_scheme(curve.control_points(), curve.interval().local(t), &mut scheme)
        .map_err(casteljau_shape::ShapeError::from)?;
    Ok(levels(&scheme, n).into_iter().skip(1).collect())
}

/// The rows of a scheme that stand one after another, the control points first; points at infinity are left out.
pub(crate) fn levels(scheme: &[DVec4], degree: usize) -> Vec<Vec<DVec3>> {
    let mut rest = scheme;
    let mut levels = Vec::with_capacity(degree + 1);
    for count in (1..=degree + 1).rev() {
        let (level, left) = rest.split_at(count.min(rest.len()));
        levels.push(level.iter().filter_map(|&p| in_space(p)).collect());
        rest = left;
    }
    levels
}
