//! From model coordinates to pixels, and from pixels to SVG.

use casteljau_geom::glam::DVec2;
use svg::Document;
use svg::node::Value;
use svg::node::element::{Circle, Group, Line, Path, Rectangle, Text};

use crate::PlotError;
use crate::color::{INK, PAPER};

/// The map from the plane of the picture, y up, to pixels, y down.
pub(crate) struct Frame {
    scale: f64,
    /// Middle of the drawing, in the plane.
    center: DVec2,
    /// The same in pixels.
    middle: DVec2,
    size: DVec2,
}

/// Room around the drawing, in pixels: at the sides, above, below.
pub(crate) struct Margins {
    pub(crate) side: f64,
    pub(crate) top: f64,
    pub(crate) bottom: f64,
}

/// The box of points in the plane.
pub(crate) fn extent(points: impl IntoIterator<Item = DVec2>) -> Result<[DVec2; 2], PlotError> {
    let mut points = points.into_iter();
    let first = points.next().ok_or(PlotError::Nothing)?;
    let grow = |[low, high]: [DVec2; 2], p: DVec2| p.is_finite().then(|| [low.min(p), high.max(p)]);
    std::iter::once(first).chain(points).try_fold([first; 2], grow).ok_or(PlotError::NotFinite)
}

impl Frame {
    /// Fits a box into a picture of `width` pixels; the picture is as high as it must be, within 0.3 to 1.2 of its width.
    pub(crate) fn new([low, high]: [DVec2; 2], width: u32, margins: &Margins) -> Result<Self, PlotError> {
        let width = f64::from(width);
        let extent = high - low;
        let largest = extent.max_element();
        if !largest.is_finite() {
            return Err(PlotError::NotFinite);
        }
        // A shape seen edge-on, or no larger than a point, still gets a picture.
        let extent = extent.max(DVec2::splat(if largest > 0.0 { 1e-3 * largest } else { 1.0 }));
        let room_x = width - 2.0 * margins.side;
        let height = (room_x * extent.y / extent.x).clamp(0.3 * width, 1.2 * width);
        let scale = (room_x / extent.x).min(height / extent.y);
        let size = DVec2::new(width, (height.min(scale * extent.y) + margins.top + margins.bottom).ceil());
        let middle = DVec2::new(0.5 * width, 0.5 * (size.y + margins.top - margins.bottom));
        let center = 0.5 * low + 0.5 * high;
        if !(scale.is_finite() && scale > 0.0) {
            return Err(PlotError::NotFinite);
        }
        Ok(Self { scale, center, middle, size })
    }

    /// Pixels a model unit.
    pub(crate) fn scale(&self) -> f64 {
        self.scale
    }

    /// Width and height of the picture.
    pub(crate) fn size(&self) -> DVec2 {
        self.size
    }

    pub(crate) fn pixels(&self, p: DVec2) -> DVec2 {
        let d = (p - self.center) * self.scale;
        DVec2::new(self.middle.x + d.x, self.middle.y - d.y)
    }

    /// An empty page.
    pub(crate) fn page(&self, title: &str) -> Document {
        let [w, h] = self.size.to_array();
        Document::new()
            .set("viewBox", format!("0 0 {} {}", number(w), number(h)))
            .set("width", number(w))
            .set("height", number(h))
            .set("font-family", "Helvetica, Arial, sans-serif")
            .set("font-size", 13)
            .add(svg::node::element::Title::new(title))
            .add(Rectangle::new().set("width", number(w)).set("height", number(h)).set("fill", PAPER))
    }
}

/// The text of a finished page.
pub(crate) fn finish(page: &Document) -> String {
    let mut text = page.to_string();
    text.push('\n');
    text
}

/// A pixel coordinate with two decimals at most. What is not finite, which the frame excludes, would be 0.
pub(crate) fn number(x: f64) -> String {
    if !x.is_finite() {
        return "0".into();
    }
    let text = format!("{x:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

/// Path data of an open or closed polyline in pixels.
pub(crate) fn polyline(points: impl IntoIterator<Item = DVec2>, closed: bool) -> String {
    let mut data = String::new();
    for (index, p) in points.into_iter().enumerate() {
        data.push_str(if index == 0 { "M" } else { "L" });
        data.push_str(&number(p.x));
        data.push(' ');
        data.push_str(&number(p.y));
    }
    if closed {
        data.push('Z');
    }
    data
}

pub(crate) fn path(data: String) -> Path {
    Path::new().set("d", data)
}

/// A group of lines.
pub(crate) fn lines(color: impl Into<Value>, width: f64) -> Group {
    Group::new()
        .set("fill", "none")
        .set("stroke", color)
        .set("stroke-width", number(width))
        .set("stroke-linejoin", "round")
        .set("stroke-linecap", "round")
}

pub(crate) fn line(a: DVec2, b: DVec2) -> Line {
    Line::new().set("x1", number(a.x)).set("y1", number(a.y)).set("x2", number(b.x)).set("y2", number(b.y))
}

pub(crate) fn disc(center: DVec2, radius: f64) -> Circle {
    Circle::new().set("cx", number(center.x)).set("cy", number(center.y)).set("r", number(radius))
}

/// Text with its middle at a place, or its left end with `anchor` "start".
pub(crate) fn text(content: &str, at: DVec2, anchor: &str) -> Text {
    Text::new(content)
        .set("x", number(at.x))
        .set("y", number(at.y))
        .set("text-anchor", anchor)
        .set("fill", INK)
}
