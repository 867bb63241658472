//! Moves points of a triangulation where that widens its least angles.

use casteljau_geom::glam::DVec2;

use super::{POOR_BOUNDARY_ANGLE, POOR_INNER_ANGLE, least_angle};

/// Least angle aimed at in triangles without boundary vertices, in radians: above the promised one by a margin.
const INNER_AIM: f64 = 1.25 * POOR_INNER_ANGLE;
/// Least angle aimed at in triangles with boundary vertices.
const BOUNDARY_AIM: f64 = 1.5 * POOR_BOUNDARY_ANGLE;
/// Most rounds over the poor triangles.
const ROUNDS: usize = 8;

/// Triangles around each point, one list after the other.
struct Stars {
    start: Vec<u32>,
    triangles: Vec<u32>,
}

impl Stars {
    fn new(points: usize, triangles: &[[u32; 3]]) -> Self {
        let mut start = vec![0u32; points + 1];
        triangles.iter().flatten().for_each(|p| start[*p as usize + 1] += 1);
        for i in 0..points {
            start[i + 1] += start[i];
        }
        let mut fill = start.clone();
        let mut list = vec![0u32; 3 * triangles.len()];
        for (t, triangle) in triangles.iter().enumerate() {
            for &p in triangle {
                list[fill[p as usize] as usize] = t as u32;
                fill[p as usize] += 1;
            }
        }
        Self { start, triangles: list }
    }

    fn of(&self, point: usize) -> &[u32] {
        &self.triangles[self.start[point] as usize..self.start[point + 1] as usize]
    }
}

/// Moves points from number `fixed` on, next to poor triangles, downhill in the sum of [`cost`] around them.
///
/// The cost of a triangle that turns over is infinite, so none does.
pub(super) fn widen(points: &mut [DVec2], triangles: &[[u32; 3]], fixed: usize) {
    let corners = |points: &[DVec2], t: u32| triangles[t as usize].map(|i| points[i as usize]);
    let one = |points: &[DVec2], t: u32| {
        let [a, b, c] = corners(points, t);
        cost(least_angle(a, b, c), (triangles[t as usize][0] as usize) < fixed)
    };
    let mut poor: Vec<u32> = (0..triangles.len() as u32).filter(|t| one(points, *t) > 0.0).collect();
    if poor.is_empty() {
        return;
    }
    let stars = Stars::new(points.len(), triangles);
    for _ in 0..ROUNDS {
        let mut moved = false;
        for &t in &poor {
            for p in triangles[t as usize].map(|p| p as usize).into_iter().filter(|p| *p >= fixed) {
                let star = stars.of(p);
                let total = |points: &[DVec2]| star.iter().map(|t| one(points, *t)).sum::<f64>();
                let old = points[p];
                let mut best = (total(points), old);
                if best.0 == 0.0 {
                    continue;
                }
                let start = best.0;
                // Each neighbour is a corner of two triangles around p.
                let sum: DVec2 = star.iter().flat_map(|t| corners(points, *t)).sum();
                let k = star.len() as f64;
                let middle = (sum - old * k) / (2.0 * k);
                let reach =
                    star.iter().flat_map(|t| corners(points, *t)).map(|q| q.distance(old)).sum::<f64>()
                        / (2.0 * k);
                let around = DIRECTIONS
                    .iter()
                    .flat_map(|d| [0.2, 0.05].map(|step| old + DVec2::from(*d) * (step * reach)));
                for candidate in [1.0, 0.5, 0.25].map(|part| old.lerp(middle, part)).into_iter().chain(around)
                {
                    points[p] = candidate;
                    let after = total(points);
                    if after < best.0 {
                        best = (after, candidate);
                    }
                }
                points[p] = best.1;
                moved |= best.0 < start;
            }
        }
        poor.retain(|t| one(points, *t) > 0.0);
        if !moved || poor.is_empty() {
            return;
        }
    }
}

/// Steps tried besides those toward the neighbours' mean.
const DIRECTIONS: [[f64; 2]; 8] = {
    const D: f64 = std::f64::consts::FRAC_1_SQRT_2;
    [[1.0, 0.0], [D, D], [0.0, 1.0], [-D, D], [-1.0, 0.0], [-D, -D], [0.0, -1.0], [D, -D]]
};

/// Squared shortfall of a least angle, as a part of the angle aimed at; at a boundary it weighs less, since there it
/// may be the boundary's own.
fn cost(angle: f64, at_boundary: bool) -> f64 {
    let (aim, weight) = if at_boundary { (BOUNDARY_AIM, 1.0) } else { (INNER_AIM, 20.0) };
    if angle <= 0.0 {
        return f64::INFINITY;
    }
    let missing = (1.0 - angle / aim).max(0.0);
    weight * missing * missing
}
