//! What explains a picture: colour bar, axes, scale.

use casteljau_geom::glam::{DVec2, DVec3};
use svg::node::element::{Group, Rectangle};

use crate::View;
use crate::canvas::{Frame, line, lines, number, text};
use crate::color::{Color, FAINT, hex};

/// A bar of colours in the upper right corner, from the first to the second value.
pub(crate) fn color_bar(frame: &Frame, range: [f64; 2], label: &str, color: impl Fn(f64) -> Color) -> Group {
    const STEPS: usize = 48;
    const LENGTH: f64 = 144.0;
    let corner = DVec2::new(frame.size().x - LENGTH - 36.0, 30.0);
    let mut group = Group::new().set("font-size", 11);
    let diverges = range[0] < 0.0;
    for step in 0..STEPS {
        let x = (step as f64 + 0.5) / STEPS as f64;
        let value = if diverges { 2.0 * x - 1.0 } else { x };
        group = group.add(
            Rectangle::new()
                .set("x", number(corner.x + LENGTH * step as f64 / STEPS as f64))
                .set("y", number(corner.y))
                .set("width", number(LENGTH / STEPS as f64 + 0.3))
                .set("height", 9)
                .set("fill", hex(color(value))),
        );
    }
    let below = corner.y + 21.0;
    group
        .add(text(label, corner + DVec2::new(LENGTH / 2.0, -6.0), "middle").set("font-size", 12))
        .add(text(&short(range[0]), DVec2::new(corner.x, below), "middle"))
        .add(text(&short(range[1]), DVec2::new(corner.x + LENGTH, below), "middle"))
}

/// Three digits.
pub(crate) fn short(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    if (1e-3..1e5).contains(&x.abs()) {
        let digits = (2 - x.abs().log10().floor() as i32).max(0) as usize;
        let text = format!("{x:.digits$}");
        return if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.').into()
        } else {
            text
        };
    }
    format!("{x:.2e}")
}

/// The three axes in the lower left corner, those that point at the eye left out, and a scale bar beside them.
pub(crate) fn axes_and_scale(frame: &Frame, view: &View) -> Group {
    const LENGTH: f64 = 30.0;
    let origin = DVec2::new(54.0, frame.size().y - 44.0);
    let mut group = Group::new().set("font-size", 11);
    let axes = [(DVec3::X, "x", "#c62828"), (DVec3::Y, "y", "#2e7d32"), (DVec3::Z, "z", "#1565c0")];
    for (axis, name, color) in axes {
        let seen = view.project(axis);
        let along = DVec2::new(seen.x, -seen.y);
        if along.length() > 0.1 {
            let tip = origin + along * LENGTH;
            let label = origin + along * LENGTH + along.normalize_or_zero() * 9.0 + DVec2::new(0.0, 3.5);
            group = group.add(lines(color, 2.0).add(line(origin, tip)));
            group = group.add(text(name, label, "middle").set("fill", color));
        }
    }
    let length = 110.0;
    group.add(scale_bar(frame, frame.size() - DVec2::new(24.0 + length, 24.0), length))
}

/// A bar of a round length, in units of the picture, as long as `room` pixels at most.
pub(crate) fn scale_bar(frame: &Frame, start: DVec2, room: f64) -> Group {
    let length = scale_length(room / frame.scale());
    let end = start + DVec2::new(length * frame.scale(), 0.0);
    let tick = DVec2::new(0.0, 4.0);
    let bar = lines(FAINT, 1.5)
        .add(line(start, end))
        .add(line(start - tick, start + tick))
        .add(line(end - tick, end + tick));
    let label = start.midpoint(end) - DVec2::new(0.0, 8.0);
    Group::new().add(bar).add(text(&short(length), label, "middle"))
}

/// The largest of 1, 2, 5 times a power of ten that is no longer than `most`.
fn scale_length(most: f64) -> f64 {
    if !(most.is_finite() && most > 0.0) {
        return 0.0;
    }
    let exponent = most.log10().floor() as i32;
    // Through text, so that the number prints as it is meant.
    let candidate = |digit: u8, exponent: i32| format!("{digit}e{exponent}").parse().unwrap_or(0.0);
    let fits = [5, 2, 1].into_iter().map(|digit| candidate(digit, exponent)).find(|&x: &f64| x <= most);
    fits.unwrap_or_else(|| candidate(5, exponent - 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_lengths_and_short_numbers() {
        let lengths = [1.0, 4.9, 5.0, 0.0199, 2.5e7].map(scale_length);
        assert_eq!(lengths, [1.0, 2.0, 5.0, 0.01, 2e7]);
        assert_eq!(scale_length(f64::NAN), 0.0);
        let words = [0.0, 0.1, 20.0, -0.00345678, 123456.0, 1e-9].map(short);
        assert_eq!(words, ["0", "0.1", "20", "-0.00346", "1.23e5", "1.00e-9"]);
    }
}
