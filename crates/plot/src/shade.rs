//! Surfaces as triangles in the light, or coloured by a value.

use casteljau_geom::glam::DVec3;

use crate::View;
use crate::color::{BACK, FRONT, NEUTRAL, diverging, hex};
use crate::scene::Scene;

/// A triangulated surface.
pub(crate) struct Skin<'a> {
    pub(crate) points: &'a [DVec3],
    /// Unit normals; zero where there is none.
    pub(crate) normals: &'a [DVec3],
    pub(crate) triangles: &'a [[u32; 3]],
    /// Values from −1 to 1 to colour the points by, NaN where there is none; empty for the light alone.
    pub(crate) values: &'a [f64],
}

/// Draws the triangles. With `closed`, those are left out whose normal looks away.
pub(crate) fn shade(scene: &mut Scene, skin: &Skin<'_>, view: &View, closed: bool) {
    let light = view.light();
    let halfway = (light + view.toward()).normalize_or_zero();
    for corners in skin.triangles {
        let points = corners.map(|i| skin.points[i as usize]);
        // The surface's normal, not the triangle's: a clockwise domain's triangles are counter-clockwise all the same.
        let normal = corners.iter().map(|&i| skin.normals[i as usize]).sum::<DVec3>().normalize_or_zero();
        let facing = normal.dot(view.toward());
        if closed && facing < 0.0 {
            continue;
        }
        let toward = if facing < 0.0 { -normal } else { normal };
        let brightness = toward.dot(light).max(0.0);
        let color = if skin.values.is_empty() {
            let glint = 0.12 * toward.dot(halfway).max(0.0).powi(24);
            let base = if facing < 0.0 { BACK } else { FRONT };
            base * (0.42 + 0.72 * brightness) + DVec3::splat(glint)
        } else {
            let known = || corners.iter().map(|&i| skin.values[i as usize]).filter(|x| x.is_finite());
            let base = match known().count() {
                0 => NEUTRAL,
                count => diverging((known().sum::<f64>() / count as f64).clamp(-1.0, 1.0)),
            };
            base * (0.85 + 0.15 * brightness)
        };
        scene.triangle(points, hex(color));
    }
}

/// The value that gets the full colour: 95 % of the values are smaller.
pub(crate) fn color_scale(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.map(f64::abs).filter(|x| x.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    let scale = values.get(values.len() * 19 / 20).copied().unwrap_or(1.0);
    if scale > 0.0 { scale } else { 1.0 }
}
