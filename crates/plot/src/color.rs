//! Colours. One palette, so that pictures look like one family.

use casteljau_geom::glam::DVec3;

/// A colour, each part 0 to 1.
pub(crate) type Color = DVec3;

pub(crate) const INK: &str = "#1f2933";
pub(crate) const FAINT: &str = "#7b8794";
pub(crate) const ACCENT: &str = "#c62828";
pub(crate) const PAPER: &str = "#ffffff";

const fn color(r: u8, g: u8, b: u8) -> Color {
    Color::new(r as f64 / 255.0, g as f64 / 255.0, b as f64 / 255.0)
}

/// The side a normal points to, and the other one.
pub(crate) const FRONT: Color = color(150, 184, 219);
pub(crate) const BACK: Color = color(224, 190, 140);
/// A surface without a colour of its own, for curvature beyond measure.
pub(crate) const NEUTRAL: Color = color(200, 200, 200);

/// Colours that tell neighbouring control nets apart.
pub(crate) const NETS: [&str; 6] = ["#1565c0", "#2e7d32", "#ad1457", "#ef6c00", "#00838f", "#6a1b9a"];

/// `#rrggbb`.
pub(crate) fn hex(color: Color) -> String {
    let [r, g, b] = color.to_array().map(|x| (x.clamp(0.0, 1.0) * 255.0).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn ramp(stops: &[Color], x: f64) -> Color {
    let x = if x.is_finite() { x.clamp(0.0, 1.0) } else { 0.5 } * (stops.len() - 1) as f64;
    let i = (x as usize).min(stops.len() - 2);
    stops[i].lerp(stops[i + 1], x - i as f64)
}

/// From 0 to 1, dark violet over teal to gold: readable in print and by the colour-blind.
pub(crate) fn sequential(x: f64) -> Color {
    const STOPS: [Color; 5] = [
        color(68, 21, 100),
        color(59, 82, 139),
        color(33, 145, 140),
        color(94, 180, 80),
        color(222, 180, 20),
    ];
    ramp(&STOPS, x)
}

/// From −1 (blue) over 0 (near white) to 1 (red).
pub(crate) fn diverging(x: f64) -> Color {
    const STOPS: [Color; 5] = [
        color(33, 83, 158),
        color(126, 174, 212),
        color(240, 240, 236),
        color(232, 150, 112),
        color(168, 28, 42),
    ];
    ramp(&STOPS, 0.5 * (x + 1.0))
}
