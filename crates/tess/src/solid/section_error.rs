//! How far a surface through solids is from its triangles.

use casteljau_geom::glam::DVec3;

use super::complex::Complex;
use super::field::Level;
use super::march::Crossing;
use super::net::{Degrees, Local};
use crate::measure::{distance_to_segment, distance_to_triangle};

/// Steps of Newton's method toward the surface.
const STEPS: usize = 12;

/// Measures triangles of a surface.
pub(crate) struct Gauge<'a> {
    pub complex: &'a Complex,
    pub levels: &'a [Level],
    /// Only edges on faces of solids: the triangles lie on the surface themselves.
    pub outline_only: bool,
}

impl Gauge<'_> {
    /// The largest distance from the triangle of the surface's points that belong to its centroid and the middles of its edges; for an
    /// edge on a face of the solid that of the point on the surface and that face from the edge. Where such a point is not found the size of
    /// the triangle stands in.
    pub fn error(&self, solid: usize, corners: [Crossing; 3], points: &[DVec3]) -> f64 {
        let [a, b, c] = corners.map(|c| points[c.vertex as usize]);
        let degrees = self.complex.degrees(solid);
        let mut worst = 0.0f64;
        for (k, ends) in [[a, b], [b, c], [c, a]].into_iter().enumerate() {
            let pair = [corners[k].local, corners[(k + 1) % 3].local];
            let fixed = fixed(degrees, &pair);
            let on_face = fixed.iter().any(|f| *f);
            if !on_face && self.outline_only {
                continue;
            }
            let error = match self.nearby(solid, middle(&pair), fixed) {
                Some(point) if on_face => distance_to_segment(point, ends[0], ends[1]),
                Some(point) => distance_to_triangle(point, [a, b, c]),
                None => ends[0].distance(ends[1]),
            };
            worst = worst.max(error);
        }
        if !self.outline_only {
            let error = match self.nearby(solid, middle(&corners.map(|c| c.local)), [false; 4]) {
                Some(point) => distance_to_triangle(point, [a, b, c]),
                None => a.distance(b).max(b.distance(c)).max(c.distance(a)),
            };
            worst = worst.max(error);
        }
        worst
    }

    /// The point of the surface that Newton's method along the level's gradient in the parameters leads to, `fixed` ones staying.
    fn nearby(&self, solid: usize, start: Local, fixed: [bool; 4]) -> Option<DVec3> {
        let level = &self.levels[solid];
        let mut at = start;
        for _ in 0..STEPS {
            let [value, a, b, c] = level.degrees.partials(&level.coefficients, at);
            // Newton's method ends within a few roundings.
            if value.abs() <= 16.0 * level.rounding {
                let point = self.complex.net(solid).point(at);
                return point.is_finite().then_some(point);
            }
            let along = direction(level.degrees, [a, b, c], fixed);
            let square: f64 = along.iter().map(|x| x * x).sum();
            let step = -value / square;
            if !step.is_finite() {
                return None;
            }
            for (x, along) in at.iter_mut().zip(along) {
                *x += step * along;
            }
            if at.iter().any(|x| !(-0.5..=1.5).contains(x)) {
                return None;
            }
        }
        None
    }
}

/// The steepest direction in the parameters, those that are fixed left out and barycentric coordinates kept at their sum.
fn direction(degrees: Degrees, [a, b, c]: [f64; 3], fixed: [bool; 4]) -> Local {
    let (mut along, barycentric): (Local, usize) = match degrees {
        Degrees::Hexahedron(_) => ([a, b, c, 0.0], 0),
        Degrees::Tetrahedron(_) => ([a, b, c, 0.0], 4),
        Degrees::Wedge(_) => ([a, b, 0.0, c], 3),
    };
    let free = (0..barycentric).filter(|&i| !fixed[i]).count();
    let mean = (0..barycentric).filter(|&i| !fixed[i]).map(|i| along[i]).sum::<f64>() / free.max(1) as f64;
    along[..barycentric].iter_mut().for_each(|x| *x -= mean);
    for (x, fixed) in along.iter_mut().zip(fixed) {
        if fixed {
            *x = 0.0;
        }
    }
    along
}

/// The parameters that all places have at an end of their range.
pub(crate) fn fixed(degrees: Degrees, places: &[Local]) -> [bool; 4] {
    std::array::from_fn(|a| {
        let all = |value: f64| places.iter().all(|at| at[a] == value);
        match degrees {
            Degrees::Hexahedron(_) => a < 3 && (all(0.0) || all(1.0)),
            Degrees::Tetrahedron(_) => all(0.0),
            Degrees::Wedge(_) => all(0.0) || a == 3 && all(1.0),
        }
    })
}

fn middle(places: &[Local]) -> Local {
    std::array::from_fn(|a| places.iter().map(|at| at[a]).sum::<f64>() / places.len() as f64)
}
