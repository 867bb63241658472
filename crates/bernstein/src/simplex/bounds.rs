//! Bounds of scalar polynomials over a simplex: by the hull, and tight ones by subdivision.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::de_casteljau::raised;
use super::index::{multi_indices, simplex_index, vertex_place};
use super::net::SimplexNet;
use super::restriction::replace_vertex;

/// Subdivision ends when it holds so many numbers, 128 MB.
const MOST_NUMBERS: usize = 1 << 24;

/// Unit roundoff.
const U: f64 = f64::EPSILON / 2.0;

/// Enclosures of the least and the greatest value of a polynomial over its domain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SimplexExtremes {
    /// Two numbers that the least value lies between.
    pub min: [f64; 2],
    /// Two numbers that the greatest value lies between.
    pub max: [f64; 2],
}

impl<const V: usize> SimplexNet<'_, f64, V> {
    /// The least and the greatest control point: by the convex hull property all values over the simplex lie
    /// between them. No points give `[∞, −∞]`.
    #[must_use]
    pub fn hull(&self) -> [f64; 2] {
        hull(self.points())
    }

    /// The least and the greatest value over the simplex, each enclosed in an interval no longer than `tolerance`,
    /// an absolute one.
    ///
    /// The part with the greatest control point is halved, across the edge along which its points differ most,
    /// until that point is within the tolerance of the greatest value found at a vertex. Enclosures are certified:
    /// rounding, at most n·u·max|P_β| for each halving, is counted. **They are longer than the tolerance** where
    /// that is below what rounding allows, or where 128 MB are full, as may happen for an extreme along a whole
    /// curve and tolerances below some 10⁻⁸ of the range: compare. Cost: near an extreme the distance shrinks by
    /// 4 with every halving of all edges; memory is allocated for the parts.
    ///
    /// ```
    /// use casteljau_bernstein::TriangleNet;
    /// let net = TriangleNet::new(&[0.0, 0.5, 0.0, 0.0, 0.0, 0.0], 2)?; // λ₁λ₂
    /// let extremes = net.extremes(1e-9);
    /// assert_eq!(extremes.min[0], 0.0);
    /// assert!(extremes.max[0] <= 0.25 && 0.25 <= extremes.max[1] && extremes.max[1] < 0.25 + 1e-9);
    /// # Ok::<(), casteljau_bernstein::BernsteinError>(())
    /// ```
    #[must_use]
    pub fn extremes(&self, tolerance: f64) -> SimplexExtremes {
        let n = self.degree();
        let vertices: [usize; V] = std::array::from_fn(|vertex| vertex_place::<V>(n, vertex));
        extremes(self.points(), n, &vertices, tolerance, |net| halves::<V>(n, net))
    }
}

/// The least and the greatest number.
pub(crate) fn hull(points: &[f64]) -> [f64; 2] {
    points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &p| [low.min(p), high.max(p)])
}

/// Extremes by halving; `degree` is the number of roundings that a point sees in one halving, `vertices` the places
/// where control points are values.
pub(crate) fn extremes(
    points: &[f64],
    degree: usize,
    vertices: &[usize],
    tolerance: f64,
    halve: impl Fn(&[f64]) -> [Vec<f64>; 2],
) -> SimplexExtremes {
    let mirrored: Vec<f64> = points.iter().map(|p| -p).collect();
    let [low, high] = maximum(mirrored, degree, vertices, tolerance, &halve);
    SimplexExtremes { min: [-high, -low], max: maximum(points.to_vec(), degree, vertices, tolerance, &halve) }
}

/// A part of the domain that may hold the greatest value.
struct Part {
    greatest: f64,
    depth: usize,
    net: Vec<f64>,
}

impl Part {
    fn new(net: Vec<f64>, depth: usize) -> Self {
        Self { greatest: hull(&net)[1], depth, net }
    }
}

impl PartialEq for Part {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Part {}

impl PartialOrd for Part {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Part {
    fn cmp(&self, other: &Self) -> Ordering {
        self.greatest.total_cmp(&other.greatest)
    }
}

fn maximum(
    points: Vec<f64>,
    degree: usize,
    vertices: &[usize],
    tolerance: f64,
    halve: &impl Fn(&[f64]) -> [Vec<f64>; 2],
) -> [f64; 2] {
    let at_vertices =
        |net: &[f64]| vertices.iter().filter_map(|&v| net.get(v)).fold(f64::NEG_INFINITY, |m, &p| m.max(p));
    let size = points.iter().fold(0.0, |m: f64, p| m.max(p.abs()));
    let rounding = |depth: usize| (depth * degree) as f64 * U * size;
    let most = MOST_NUMBERS / points.len().max(1);
    let mut found = at_vertices(&points);
    let mut deepest = 0;
    let mut parts = BinaryHeap::from([Part::new(points, 0)]);
    loop {
        let top = parts.peek().map_or(found, |part| part.greatest.max(found));
        let enclosure = [found - rounding(deepest), top + rounding(deepest)];
        // Written so that tolerances that are no numbers end it.
        let longer = enclosure[1] - enclosure[0] > tolerance;
        if top <= found || !longer || 2.0 * rounding(deepest) > tolerance || parts.len() >= most {
            return enclosure;
        }
        let Some(part) = parts.pop() else { return enclosure };
        deepest = deepest.max(part.depth + 1);
        for half in halve(&part.net) {
            found = found.max(at_vertices(&half));
            let half = Part::new(half, part.depth + 1);
            if half.greatest > found {
                parts.push(half);
            }
        }
    }
}

/// Halves across the edge along which the control points differ most.
fn halves<const V: usize>(n: usize, net: &[f64]) -> [Vec<f64>; 2] {
    let (edge, _) = steepest_edge::<V>(n, 1, net);
    halves_across::<V>(n, 1, edge, net)
}

/// The edge along which control points, in rows of `width`, differ most, and by how much.
pub(crate) fn steepest_edge<const V: usize>(n: usize, width: usize, net: &[f64]) -> ([usize; 2], f64) {
    let (mut edge, mut most) = ([0, 1], 0.0);
    let Some(lower) = n.checked_sub(1) else { return (edge, most) };
    for index in multi_indices::<V>(lower) {
        let row = |vertex: usize| &net[simplex_index(raised(index, vertex)) * width..][..width];
        for a in 0..V {
            for b in a + 1..V {
                let differs = row(a).iter().zip(row(b)).fold(0.0, |m: f64, (x, y)| m.max((x - y).abs()));
                if differs > most {
                    (edge, most) = ([a, b], differs);
                }
            }
        }
    }
    (edge, most)
}

/// Halves across one edge.
pub(crate) fn halves_across<const V: usize>(
    n: usize,
    width: usize,
    [a, b]: [usize; 2],
    net: &[f64],
) -> [Vec<f64>; 2] {
    let mut middle = [0.0; V];
    (middle[a], middle[b]) = (0.5, 0.5);
    [b, a].map(|vertex| {
        let mut half = net.to_vec();
        replace_vertex(n, width, vertex, middle, &mut half);
        half
    })
}
