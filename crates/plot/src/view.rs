use casteljau_geom::glam::{DVec2, DVec3};

/// An orthographic view: where the eye is, infinitely far away.
///
/// *Azimuth* is the angle of the eye about the z axis, counter-clockwise from +x; *elevation* its angle above the xy plane,
/// both in degrees. The z axis points up in the picture, or, seen from straight above or below, as azimuth tells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    right: DVec3,
    up: DVec3,
    toward: DVec3,
}

impl View {
    /// The names that [`View::named`] knows.
    pub const NAMES: [&'static str; 7] = ["iso", "top", "bottom", "front", "back", "left", "right"];

    /// The view from a direction, in degrees. Angles that are not finite count as 0.
    ///
    /// ```
    /// use casteljau_plot::View;
    /// assert_eq!(View::from_angles(-90.0, 90.0), View::named("top").unwrap());
    /// ```
    #[must_use]
    pub fn from_angles(azimuth: f64, elevation: f64) -> Self {
        let (sin_a, cos_a) = sin_cos_degrees(azimuth);
        let (sin_e, cos_e) = sin_cos_degrees(elevation);
        let right = DVec3::new(-sin_a, cos_a, 0.0);
        let toward = DVec3::new(cos_e * cos_a, cos_e * sin_a, sin_e);
        Self { right, up: toward.cross(right), toward }
    }

    /// A view by its name: the six faces of the drawing cube, `front` being seen from −y and `right` from +x, and `iso`,
    /// seen from (1, −1, 1).
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let (azimuth, elevation) = match name {
            "iso" => (-45.0, 0.5_f64.sqrt().atan().to_degrees()),
            "top" => (-90.0, 90.0),
            "bottom" => (-90.0, -90.0),
            "front" => (-90.0, 0.0),
            "back" => (90.0, 0.0),
            "left" => (180.0, 0.0),
            "right" => (0.0, 0.0),
            _ => return None,
        };
        Some(Self::from_angles(azimuth, elevation))
    }

    /// Place in the picture, x to the right and y up, in model units.
    #[must_use]
    pub fn project(&self, p: DVec3) -> DVec2 {
        DVec2::new(p.dot(self.right), p.dot(self.up))
    }

    /// Distance toward the eye: the larger of two depths is in front.
    #[must_use]
    pub fn depth(&self, p: DVec3) -> f64 {
        p.dot(self.toward)
    }

    /// Unit vector toward the eye.
    #[must_use]
    pub fn toward(&self) -> DVec3 {
        self.toward
    }

    /// Unit direction toward a light above the eye's left shoulder.
    pub(crate) fn light(&self) -> DVec3 {
        (0.55 * self.toward + 0.6 * self.up - 0.6 * self.right).normalize()
    }
}

impl Default for View {
    /// From azimuth −60° and elevation 35°.
    fn default() -> Self {
        Self::from_angles(-60.0, 35.0)
    }
}

/// Exact at multiples of 90°, so that a view along an axis has no crumbs of the others.
fn sin_cos_degrees(angle: f64) -> (f64, f64) {
    let angle = if angle.is_finite() { angle.rem_euclid(360.0) } else { 0.0 };
    match angle {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => angle.to_radians().sin_cos(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_of_the_named_views() {
        let see = |name: &str, p: DVec3| View::named(name).unwrap().project(p).to_array();
        assert_eq!(see("top", DVec3::new(1.0, 2.0, 3.0)), [1.0, 2.0]);
        assert_eq!(see("bottom", DVec3::new(1.0, 2.0, 3.0)), [1.0, -2.0]);
        assert_eq!(see("front", DVec3::new(1.0, 2.0, 3.0)), [1.0, 3.0]);
        assert_eq!(see("back", DVec3::new(1.0, 2.0, 3.0)), [-1.0, 3.0]);
        assert_eq!(see("right", DVec3::new(1.0, 2.0, 3.0)), [2.0, 3.0]);
        assert_eq!(see("left", DVec3::new(1.0, 2.0, 3.0)), [-2.0, 3.0]);
        assert_eq!(View::named("sideways"), None);
        let iso = View::named("iso").unwrap();
        assert!((iso.toward() - DVec3::new(1.0, -1.0, 1.0).normalize()).length() < 1e-15);
        assert!(View::from_angles(f64::NAN, f64::INFINITY).project(DVec3::ONE).is_finite());
    }
}
