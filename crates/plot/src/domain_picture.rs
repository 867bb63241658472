use casteljau_domain::{CoordinateKind, Coordinates, Polygon};
use casteljau_geom::glam::DVec2;
use svg::Document;
use svg::node::element::{Circle, Group};

use crate::canvas::{Frame, Margins, disc, extent, finish, lines, path, polyline, text};
use crate::color::{ACCENT, INK, hex, sequential};
use crate::contour::contours;
use crate::decoration::{color_bar, scale_bar};
use crate::sampling::Sampling;
use crate::{MOST_LEVELS, MOST_TRIANGLES, PlotError, WIDTHS};

/// What [`domain_picture`] shows.
#[derive(Clone, Debug, PartialEq)]
pub struct DomainStyle {
    /// The coordinate λ_i whose isolines are drawn; `None` for none.
    pub coordinate: Option<usize>,
    /// Number of isolines, at j/(levels + 1), j = 1 … levels.
    pub levels: usize,
    /// Whether the triangulation is drawn.
    pub triangulation: bool,
    /// Triangles wanted.
    pub triangles: usize,
    /// Width of the picture in pixels.
    pub width: u32,
}

impl Default for DomainStyle {
    fn default() -> Self {
        Self { coordinate: Some(0), levels: 19, triangulation: true, triangles: 1500, width: 800 }
    }
}

/// Draws a domain polygon: corners numbered from 0, concave ones in red with a ring, isolines of one coordinate, coloured by
/// value, on the triangulation that they were found on.
///
/// λ is evaluated at every vertex and, for each point of an isoline, on its edge until λ is within 1e-4 of the level: the
/// lines show the coordinates and not the triangulation.
///
/// # Errors
/// A coordinate that does not exist, numbers of the style out of range, a polygon too thin to be triangulated.
pub fn domain_picture(coordinates: &Coordinates, style: &DomainStyle) -> Result<String, PlotError> {
    let polygon = coordinates.polygon();
    let n = polygon.len();
    check(n, style)?;
    let sampling = Sampling::new(polygon, style.triangles)?;
    let margins = Margins { side: 46.0, top: 78.0, bottom: 58.0 };
    let frame = Frame::new(extent(polygon.vertices().iter().copied())?, style.width, &margins)?;
    let outline = polyline(polygon.vertices().iter().map(|&p| frame.pixels(p)), true);

    let title = format!("Domain polygon, {n} sides, {} coordinates", kind_name(coordinates.kind()));
    let mut page = frame.page(&title).add(path(outline.clone()).set("fill", "#f4f6f8"));
    if style.triangulation {
        page = page.add(triangulation(&sampling, &frame));
    }
    if let Some(index) = style.coordinate {
        page = page.add(isolines(coordinates, &sampling, index, style.levels, &frame)?);
        page = page.add(color_bar(&frame, [0.0, 1.0], &format!("λ of corner {index}"), sequential));
    }
    page = page.add(lines(INK, 2.0).add(path(outline)));
    page = corners(page, polygon, style.coordinate, &frame);
    page = page.add(legend(&frame, !polygon.is_convex()));
    page = page.add(text(&title, DVec2::new(20.0, 27.0), "start").set("font-size", 15));
    Ok(finish(&page))
}

fn check(n: usize, style: &DomainStyle) -> Result<(), PlotError> {
    if let Some(index) = style.coordinate.filter(|&index| index >= n) {
        return Err(PlotError::NoSuch { what: "coordinate", index, count: n });
    }
    check_counts(style.width, style.levels, style.triangles)
}

/// The numbers that both styles have.
pub(crate) fn check_counts(width: u32, levels: usize, triangles: usize) -> Result<(), PlotError> {
    check_count("width in pixels", width as usize, WIDTHS[0], WIDTHS[1])?;
    check_count("number of isolines", levels, 0, MOST_LEVELS)?;
    check_count("number of triangles", triangles, 1, MOST_TRIANGLES)
}

fn check_count(option: &'static str, value: usize, least: usize, most: usize) -> Result<(), PlotError> {
    if (least..=most).contains(&value) {
        return Ok(());
    }
    Err(PlotError::Option { option, value: value as f64, least: least as f64, most: most as f64 })
}

fn kind_name(kind: CoordinateKind) -> &'static str {
    match kind {
        CoordinateKind::Wachspress => "Wachspress",
        CoordinateKind::MeanValue => "mean value",
        _ => "harmonic",
    }
}

fn triangulation(sampling: &Sampling, frame: &Frame) -> Group {
    let mut edges: Vec<[u32; 2]> = sampling
        .triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect();
    edges.sort_unstable();
    edges.dedup();
    // One path of many strokes: a third of the size of one element an edge.
    let strokes =
        edges.iter().map(|edge| polyline(edge.map(|i| frame.pixels(sampling.points[i as usize])), false));
    lines("#d5dbe1", 0.5).add(path(strokes.collect()))
}

fn isolines(
    coordinates: &Coordinates,
    sampling: &Sampling,
    index: usize,
    levels: usize,
    frame: &Frame,
) -> Result<Group, PlotError> {
    let n = coordinates.len();
    let all = sampling.coordinates(coordinates)?;
    let values: Vec<f64> = all.iter().skip(index).step_by(n).copied().collect();
    let mut group = lines(INK, 1.5);
    let mut row = vec![0.0; n];
    for j in 1..=levels {
        let level = j as f64 / (levels + 1) as f64;
        let mut refine = |a: DVec2, b: DVec2, t: f64| {
            let mut value = |t: f64| match coordinates.evaluate(&[a.lerp(b, t)], 0, &mut row) {
                Ok(()) => row[index] - level,
                // An edge along the boundary may leave it by rounding.
                Err(_) => 0.0,
            };
            bisect(&mut value, t)
        };
        let found = contours(&sampling.points, &sampling.triangles, &values, level, &mut refine);
        let data: String = found
            .iter()
            .map(|line| polyline(line.points.iter().map(|&p| frame.pixels(p)), line.closed))
            .collect();
        if !data.is_empty() {
            group = group.add(path(data).set("stroke", hex(sequential(level))));
        }
    }
    Ok(group)
}

/// The root in [0, 1] of a function with one change of sign there, from a first guess, to 1e-4 in the value.
fn bisect(value: &mut dyn FnMut(f64) -> f64, guess: f64) -> f64 {
    const ENOUGH: f64 = 1e-4;
    let mut t = guess;
    let mut at = value(t);
    if at.abs() <= ENOUGH {
        return t;
    }
    let (mut low, mut high) = (0.0, 1.0);
    let rising = value(1.0) > 0.0;
    for _ in 0..20 {
        if (at > 0.0) == rising {
            high = t
        } else {
            low = t
        }
        t = 0.5 * (low + high);
        at = value(t);
        if at.abs() <= ENOUGH {
            break;
        }
    }
    t
}

/// Marks and numbers at the corners; numbers stand outside, on the bisector.
fn corners(page: Document, polygon: &Polygon, chosen: Option<usize>, frame: &Frame) -> Document {
    let n = polygon.len();
    let mut marks = Group::new();
    for i in 0..n {
        let at = frame.pixels(polygon.vertex(i));
        let concave = polygon.is_concave(i);
        let direction = |j: usize| (frame.pixels(polygon.vertex(j)) - at).normalize_or_zero();
        let inward = (direction(i + n - 1) + direction(i + 1)).normalize_or(DVec2::NEG_Y);
        let outward = if concave { inward } else { -inward };
        let color = if concave { ACCENT } else { INK };
        if concave {
            let ring: Circle =
                disc(at, 8.0).set("fill", "none").set("stroke", ACCENT).set("stroke-width", "1.5");
            marks = marks.add(ring);
        }
        marks = marks.add(disc(at, 4.0).set("fill", color));
        let label = at + outward * 19.0 + DVec2::new(0.0, 4.5);
        let weight = if chosen == Some(i) { "bold" } else { "normal" };
        marks =
            marks.add(text(&i.to_string(), label, "middle").set("fill", color).set("font-weight", weight));
    }
    page.add(marks)
}

/// What the marks mean, and how long things are.
fn legend(frame: &Frame, concave: bool) -> Group {
    let left = DVec2::new(24.0, frame.size().y - 20.0);
    let group = Group::new().set("font-size", 12).add(scale_bar(frame, left, 90.0));
    if !concave {
        return group;
    }
    let mark = DVec2::new(frame.size().x - 118.0, left.y);
    group
        .add(disc(mark, 6.0).set("fill", "none").set("stroke", ACCENT).set("stroke-width", "1.5"))
        .add(disc(mark, 3.0).set("fill", ACCENT))
        .add(text("concave corner", mark + DVec2::new(12.0, 4.0), "start"))
}
