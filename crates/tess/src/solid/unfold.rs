//! Triangles in a plane that are turned over, and how they are turned back.

use std::collections::HashMap;

use casteljau_geom::glam::DVec3;

use crate::topology::Topology;

/// Triangles lower than this part of their longest side are mended, too, as those without area are not told from them.
const THIN: f64 = 1e-6;
/// Rounds of flips and moves.
const ROUNDS: usize = 24;

/// Flips edges and moves inner vertices of a mesh in a plane while that mends triangles that are turned over or thin to nothing.
///
/// A triangle with a side along a curved line of the lattice, lower than the curve is high, comes out turned over: within the
/// tolerance, and yet over its neighbours. Where many inner vertices lie beyond one edge of the outline, some stay so. `pull` moves a point onto the plane. Vertices of the outline stay, to the bit.
pub(crate) fn unfold(
    triangles: &mut Vec<[u32; 3]>,
    points: &mut [DVec3],
    normal: DVec3,
    pull: &dyn Fn(DVec3) -> DVec3,
) {
    let mut uses: HashMap<[u32; 2], usize> = HashMap::new();
    for &[a, b, c] in triangles.iter() {
        for [a, b] in [[a, b], [b, c], [c, a]] {
            *uses.entry([a.min(b), a.max(b)]).or_default() += 1;
        }
    }
    if uses.values().any(|&n| n > 2) {
        return; // Solids that overlap.
    }
    let mut topology = Topology::new(std::mem::take(triangles), points.len());
    let mut star = Vec::new();
    for _ in 0..ROUNDS {
        let mut changes = 0;
        for t in 0..topology.triangles.len() as u32 {
            if shape(topology.triangles[t as usize], points, normal) > THIN {
                continue;
            }
            if flip(&mut topology, t, points, normal, &mut uses) {
                changes += 1;
                continue;
            }
            for vertex in topology.triangles[t as usize] {
                topology.star(vertex, &mut star);
                changes += usize::from(move_to_middle(&topology, &star, vertex, points, normal, pull));
            }
        }
        if changes == 0 {
            break;
        }
    }
    *triangles = topology.triangles;
}

/// Twice the area in units of the longest side squared, negative where the triangle is turned over.
fn shape(corners: [u32; 3], points: &[DVec3], normal: DVec3) -> f64 {
    let [a, b, c] = corners.map(|v| points[v as usize]);
    let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
    // Divided one after the other: squares of small numbers vanish.
    let shape = ((b - a) / longest).cross((c - a) / longest).dot(normal);
    if shape.is_nan() { 0.0 } else { shape }
}

/// Flips the edge of a triangle after which the worse of two triangles is best, if that gains anything.
fn flip(
    topology: &mut Topology,
    t: u32,
    points: &[DVec3],
    normal: DVec3,
    uses: &mut HashMap<[u32; 2], usize>,
) -> bool {
    let own = topology.triangles[t as usize];
    let after = |k: usize| {
        let (u, j) = topology.beyond(t, k)?;
        let other = topology.triangles[u as usize];
        let [a, b, c] = [own[k], own[(k + 1) % 3], own[(k + 2) % 3]];
        let d = other[j];
        let taken = a == d || uses.contains_key(&[a.min(d), a.max(d)]);
        let least = shape([a, b, d], points, normal).min(shape([a, d, c], points, normal));
        let before = shape(own, points, normal).min(shape(other, points, normal));
        (!taken && least > before).then_some((k, least, [a, d], [b, c]))
    };
    let best = (0..3).filter_map(after).max_by(|x, y| x.1.total_cmp(&y.1));
    let Some((k, _, [a, d], [b, c])) = best else { return false };
    topology.flip(t, k);
    uses.remove(&[b.min(c), b.max(c)]);
    uses.insert([a.min(d), a.max(d)], 2);
    true
}

/// Moves an inner vertex to the middle of its neighbours, if the worst triangle around it gets better by that.
fn move_to_middle(
    topology: &Topology,
    star: &[u32],
    vertex: u32,
    points: &mut [DVec3],
    normal: DVec3,
    pull: &dyn Fn(DVec3) -> DVec3,
) -> bool {
    let worst = |points: &[DVec3]| {
        let shapes = star.iter().map(|&t| shape(topology.triangles[t as usize], points, normal));
        shapes.fold(f64::INFINITY, f64::min)
    };
    let around = star.iter().flat_map(|&t| topology.triangles[t as usize]).filter(|&v| v != vertex);
    let (sum, count) =
        around.fold((DVec3::ZERO, 0.0), |(sum, count), v| (sum + points[v as usize], count + 1.0));
    if count == 0.0 {
        return false; // On the outline.
    }
    let (before, old) = (worst(points), points[vertex as usize]);
    points[vertex as usize] = pull(sum / count) + DVec3::ZERO;
    if worst(points) > before {
        return true;
    }
    points[vertex as usize] = old;
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vertex_beyond_the_outline_comes_back_in() {
        // A square around a vertex that lies outside of it.
        let mut points = [DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y, DVec3::new(0.5, -0.25, 0.0)];
        let mut triangles: Vec<[u32; 3]> = (0..4).map(|i| [i, (i + 1) % 4, 4]).collect();
        unfold(&mut triangles, &mut points, DVec3::Z, &|p| p);
        assert!(triangles.iter().all(|&t| shape(t, &points, DVec3::Z) > 0.1));
    }
}
