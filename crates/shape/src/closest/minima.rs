//! All local minima of the distance, each isolated from the others.

use casteljau_geom::glam::DVec3;
use casteljau_geom::{Interval, UNIT_ROUNDOFF};

use super::newton::{Stationary, descend};
use super::piece::{Assessment, Piece};
use super::tree::{Area, Tree, Workshop, halves, tolerance};

/// Pieces are not cut below this parameter width; what is undecided then is left to the caller.
const RESOLUTION: f64 = 1.0 / (1_u64 << 26) as f64;
/// Pieces below this width are not cut where rounding makes up much of what is known of them.
const BLURRED: f64 = 1.0 / (1_u64 << 14) as f64;
/// Pieces looked at for one query, at most.
const MOST_PIECES: usize = 20_000;

/// A local minimum of the distance over the domain of a shape with D parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalMinimum<const D: usize> {
    /// The parameters of the point.
    pub parameters: [f64; D],
    /// The exact minimum lies within so much of each parameter, and is the only one there.
    pub uncertainty: [f64; D],
    /// The point of the shape.
    pub point: DVec3,
    /// Its distance from the query.
    pub distance: f64,
}

impl<const D: usize> LocalMinimum<D> {
    /// From parameters of `[0, 1]ᴰ` to those of the shape's intervals.
    pub(super) fn over(self, intervals: [Interval; D]) -> Self {
        let length = |k: usize| intervals[k].length();
        let rounding = |k: usize| {
            let mapped = intervals[k] == Interval::UNIT;
            let largest = intervals[k].start().abs().max(intervals[k].end().abs());
            if mapped { 0.0 } else { 4.0 * UNIT_ROUNDOFF * largest }
        };
        Self {
            parameters: std::array::from_fn(|k| intervals[k].at(self.parameters[k])),
            uncertainty: std::array::from_fn(|k| self.uncertainty[k] * length(k) + rounding(k)),
            ..self
        }
    }
}

/// Boxes of `[0, 1]ᴰ` as boxes of the shape's parameters.
pub(super) fn over<const D: usize>(areas: Vec<Area<D>>, intervals: [Interval; D]) -> Vec<Area<D>> {
    areas.into_iter().map(|area| std::array::from_fn(|k| area[k].map(|s| intervals[k].at(s)))).collect()
}

/// All local minima of the distance from a query.
///
/// Every local minimum over the domain, sides and corners included, is one of `minima` or lies in one of the
/// boxes `unresolved`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LocalMinima<const D: usize> {
    /// The minima that are proved, by increasing distance.
    pub minima: Vec<LocalMinimum<D>>,
    /// Parameter boxes in which it was not decided how many minima there are, if any.
    ///
    /// Empty as a rule. There are such where a minimum is not strict to second order (q at a centre of
    /// curvature), where the gradient vanishes at a corner or the derivative at a cusp: a box goes as far as
    /// rounding hides which way the distance grows, at least 2⁻²⁶. Larger ones appear where a whole curve of
    /// points is equally close, and 20,000 pieces did not suffice to follow it.
    pub unresolved: Vec<[[f64; 2]; D]>,
}

/// A minimum that is alone in some box on which φ is convex.
#[derive(Debug, Clone, Copy)]
pub(super) struct Isolated<const D: usize> {
    pub at: Stationary<D>,
    /// The minimum lies within so much of `at`.
    pub radius: [f64; D],
}

impl<const D: usize> Isolated<D> {
    fn enclosure(&self) -> Area<D> {
        std::array::from_fn(|k| {
            let (x, r) = (self.at.at[k], self.radius[k]);
            [(x - r).max(0.0), (x + r).min(1.0)]
        })
    }
}

/// What a tree knows of the minima in its interior.
#[derive(Debug, Clone)]
pub(super) struct Found<const D: usize> {
    pub isolated: Vec<Isolated<D>>,
    pub unresolved: Vec<Area<D>>,
    /// Boxes on which φ is convex, each around one of the minima in `isolated`.
    around: Vec<Area<D>>,
}

impl<const D: usize> Found<D> {
    /// Whether a box lies where the only minimum is known.
    pub fn covers(&self, area: &Area<D>) -> bool {
        self.around.iter().any(|known| contains(known, area))
    }
}

impl<const D: usize> Tree<D> {
    /// All minima of φ but those that lie on sides of `[0, 1]ᴰ` with a gradient other than zero.
    ///
    /// A minimum found is surrounded by a box as large as φ is seen to be convex on; pieces in such a box need
    /// no further look.
    pub fn minima(&self, q: DVec3) -> Found<D> {
        let mut found = Found { isolated: Vec::new(), unresolved: Vec::new(), around: Vec::new() };
        let mut work = Workshop::default();
        // Places in the tree, or none for pieces beyond it.
        let mut stack: Vec<(Option<usize>, Area<D>)> = vec![(Some(0), [[0.0, 1.0]; D])];
        let mut looked = 0;
        while let Some((place, area)) = stack.pop() {
            if found.covers(&area) {
                continue;
            }
            if looked >= MOST_PIECES {
                found.unresolved.push(area);
                continue;
            }
            looked += 1;
            let node = place.and_then(|place| self.nodes.get(place));
            let made = if node.is_none() { work.piece(&self.net, &area) } else { None };
            let Some(piece) = node.map(|node| &node.piece).or(made.as_ref()) else {
                found.unresolved.push(area);
                continue;
            };
            let known = piece.assess(q, f64::INFINITY);
            if known.barren {
                continue;
            }
            if known.convex.is_some()
                && let Some((isolated, around)) = self.isolate(q, &area, &known, &mut work)
            {
                // Two convex boxes share their minimum, or it is sought in smaller pieces which of them has it.
                let enclosure = isolated.enclosure();
                if found.covers(&enclosure) {
                    found.around.push(around);
                    continue;
                }
                if !found.isolated.iter().any(|other| meet(&other.enclosure(), &enclosure)) {
                    found.around.push(around);
                    found.isolated.push(isolated);
                    continue;
                }
            }
            let axis = self.axis(&area, known.spread);
            let width = (0..D).map(|k| area[k][1] - area[k][0]).fold(0.0, f64::max);
            let blurred = width <= BLURRED && piece.is_rounded(q, known.spread[axis]);
            if width <= RESOLUTION || blurred || self.is_level(piece, q) {
                found.unresolved.push(area);
                continue;
            }
            let axis = if area[axis][1] - area[axis][0] <= RESOLUTION { D - 1 - axis } else { axis };
            let first = node.map(|node| node.halves).filter(|&first| first > 0);
            match first {
                Some(first) => {
                    stack.extend([first + 1, first].map(|place| (Some(place), self.nodes[place].area)))
                }
                None => {
                    let [a, b] = halves(area, axis);
                    stack.extend([(None, b), (None, a)]);
                }
            }
        }
        found.unresolved = clusters(found.unresolved);
        found
    }

    /// Whether φ is the same all over the piece, to rounding: a collapsed side, for one.
    fn is_level(&self, piece: &Piece<D>, q: DVec3) -> bool {
        let distance = piece.center.distance(q);
        let radius = piece.radius();
        (distance + radius) * radius <= tolerance(0.5 * distance * distance, self.net.rounding())
    }

    /// The minimum of φ on a convex piece, in a box around it on which φ is still convex and which covers the
    /// piece; `None` where the minimum lies elsewhere or the box is not convex.
    fn isolate(
        &self,
        q: DVec3,
        area: &Area<D>,
        known: &Assessment<D>,
        work: &mut Workshop,
    ) -> Option<(Isolated<D>, Area<D>)> {
        let from = std::array::from_fn(|k| {
            let [a, b] = area[k];
            0.5 * (a + b) + 0.5 * (b - a) * known.start[k]
        });
        let at = descend(&self.net, q, from);
        if (0..D).any(|k| at.at[k] < area[k][0] || at.at[k] > area[k][1]) {
            return None;
        }
        let around: Area<D> = std::array::from_fn(|k| {
            let width = area[k][1] - area[k][0];
            // A hair wider, so that the piece lies inside whatever rounding does.
            let reach = width * (1.0 + 1e-9);
            [(at.at[k] - reach).max(0.0), (at.at[k] + reach).min(1.0)]
        });
        let curvature = work.piece::<D>(&self.net, &around)?.assess(q, f64::INFINITY).convex?;
        // φ(x) ≥ φ(p) + g·(x−p) + ½ Σ cᵢ (xᵢ−pᵢ)², so the minimum is within 2|g|/√c in the norm of c.
        let half: [f64; D] = std::array::from_fn(|k| 0.5 * (around[k][1] - around[k][0]));
        let descent: f64 = (0..D)
            .map(|k| {
                let unsure = self.gradient_rounding(&at, k);
                let (down, up) = (unsure - at.gradient[k], unsure + at.gradient[k]);
                // Only a slope that leads into the domain can be followed.
                let slope = match at.at[k] {
                    x if x <= 0.0 => down.max(0.0),
                    x if x >= 1.0 => up.max(0.0),
                    _ => down.max(up),
                };
                (slope * half[k]).powi(2) / curvature[k]
            })
            .sum();
        let radius = std::array::from_fn(|k| 2.0 * (descent / curvature[k]).sqrt() * half[k]);
        let enclosed = (0..D).all(|k| {
            let [a, b] = around[k];
            (a == 0.0 || at.at[k] - radius[k] > a) && (b == 1.0 || at.at[k] + radius[k] < b)
        });
        enclosed.then_some((Isolated { at, radius }, around))
    }
}

fn contains<const D: usize>(outer: &Area<D>, inner: &Area<D>) -> bool {
    (0..D).all(|k| outer[k][0] <= inner[k][0] && inner[k][1] <= outer[k][1])
}

fn meet<const D: usize>(a: &Area<D>, b: &Area<D>) -> bool {
    (0..D).all(|k| a[k][0] <= b[k][1] && b[k][0] <= a[k][1])
}

/// The boxes around all groups of boxes that touch.
pub(crate) fn clusters<const D: usize>(areas: Vec<[[f64; 2]; D]>) -> Vec<[[f64; 2]; D]> {
    let mut groups: Vec<[[f64; 2]; D]> = Vec::new();
    for mut area in areas {
        // A group that is met may meet others when it has grown.
        while let Some(place) = groups.iter().position(|group| meet(group, &area)) {
            let group = groups.swap_remove(place);
            area = std::array::from_fn(|k| [area[k][0].min(group[k][0]), area[k][1].max(group[k][1])]);
        }
        groups.push(area);
    }
    groups.sort_by(|a, b| {
        (0..D).map(|k| a[k][0].total_cmp(&b[k][0])).find(|o| o.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
    });
    groups
}

/// Whether a number is positive or negative, where its uncertainty leaves that certain.
pub(super) fn sign(x: f64, uncertainty: f64) -> Option<bool> {
    if x.abs() > uncertainty { Some(x > 0.0) } else { None }
}
