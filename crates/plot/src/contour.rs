//! Marching triangles: the lines on a triangulation along which a function has a value.

use std::collections::HashMap;

use casteljau_geom::glam::DVec2;

/// A connected piece of a level line, in the plane of the triangulation.
pub(crate) struct Contour {
    pub(crate) points: Vec<DVec2>,
    pub(crate) closed: bool,
}

type Edge = (u32, u32);

/// The lines `value = level`. Vertices without a finite value, and the triangles at them, are left out.
///
/// `refine(a, b, t)` may move the crossing found at `a + t (b − a)` along its edge, returning another t.
pub(crate) fn contours(
    points: &[DVec2],
    triangles: &[[u32; 3]],
    values: &[f64],
    level: f64,
    refine: &mut dyn FnMut(DVec2, DVec2, f64) -> f64,
) -> Vec<Contour> {
    let above = |i: u32| values[i as usize] >= level;
    let mut next: HashMap<Edge, [Option<Edge>; 2]> = HashMap::new();
    let mut order = Vec::new();
    for corners in triangles {
        if corners.iter().any(|&i| !values[i as usize].is_finite()) {
            continue;
        }
        let crossed: Vec<Edge> = [(0, 1), (1, 2), (2, 0)]
            .into_iter()
            .map(|(a, b)| (corners[a].min(corners[b]), corners[a].max(corners[b])))
            .filter(|&(a, b)| above(a) != above(b))
            .collect();
        // A triangle is crossed on two edges or on none.
        if let [a, b] = crossed[..] {
            for (from, to) in [(a, b), (b, a)] {
                let slots = next.entry(from).or_insert_with(|| {
                    order.push(from);
                    [None, None]
                });
                if let Some(free) = slots.iter_mut().find(|slot| slot.is_none()) {
                    *free = Some(to);
                }
            }
        }
    }
    let mut place = |(a, b): Edge| {
        let (p, q) = (points[a as usize], points[b as usize]);
        let (x, y) = (values[a as usize], values[b as usize]);
        let t = ((level - x) / (y - x)).clamp(0.0, 1.0);
        p.lerp(q, refine(p, q, t).clamp(0.0, 1.0))
    };
    let mut found = Vec::new();
    // Open lines first, from their ends; what is left are loops.
    let ends = order.iter().filter(|edge| next[*edge][1].is_none()).copied().collect::<Vec<_>>();
    for start in ends.into_iter().chain(order) {
        let Some(mut links) = next.remove(&start) else { continue };
        let closed = links[1].is_some();
        let mut line = vec![place(start)];
        let mut at = start;
        while let Some(to) = links.into_iter().flatten().find(|edge| *edge != at && next.contains_key(edge)) {
            line.push(place(to));
            at = to;
            links = next.remove(&to).unwrap_or_default();
        }
        found.push(Contour { points: line, closed });
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_loop_and_an_open_line() {
        // A square of four triangles about its middle.
        let points = [(0., 0.), (2., 0.), (2., 2.), (0., 2.), (1., 1.)].map(|(x, y)| DVec2::new(x, y));
        let triangles = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
        let mut keep = |_, _, t| t;
        let around = contours(&points, &triangles, &[0., 0., 0., 0., 1.], 0.5, &mut keep);
        assert_eq!(around.len(), 1);
        assert!(around[0].closed && around[0].points.len() == 4);
        let across = contours(&points, &triangles, &[0., 1., 1., 0., 0.5], 0.25, &mut keep);
        assert_eq!(across.len(), 1);
        assert!(!across[0].closed && across[0].points.iter().all(|p| (p.x - 0.5).abs() < 1e-15));
        let holed = contours(&points, &triangles, &[f64::NAN, 1., 1., 0., 0.5], 0.25, &mut keep);
        assert_eq!(holed[0].points.len(), 2);
    }
}
