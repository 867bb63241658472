//! Where to cut a cell in two: through its necks, far from its corners.

use num_complex::Complex64;

use super::{
    cell::{Cell, Edge, EdgePoint},
    outline::{Outline, dot, segment_distance},
};

/// Most candidate ends of a chord on a cell.
const MOST_ENDS: usize = 240;
/// A chord closer to a corner than this part of its own length is not worth having.
const LEAST_CLEARANCE: f64 = 0.1;
/// The same where there is nothing better.
const CLOSEST: f64 = 0.01;
/// Beyond this part of its length more distance from the corners does not make a chord better.
const MOST_CLEARANCE: f64 = 0.5;
/// Chords of a lower score are not used.
const LEAST_SCORE: f64 = 0.1;
/// Arms narrower than this part of the cell's diameter are cut off.
const NECK: f64 = 0.15;
/// Outer wedges wider than this, in radians, are no gaps.
const OPEN_WEDGE: f64 = 0.1;

/// The best chord of a cell, if there is any good one.
///
/// A chord is good when every corner of the polygon is far from it compared with its length (the functions on both
/// sides are analytic that far beyond it) and when neither part is thin or tiny.
pub(super) fn best_chord(outline: &Outline, cell: &Cell) -> Option<(EdgePoint, EdgePoint)> {
    let area = cell.area();
    best(outline, cell, f64::INFINITY, LEAST_CLEARANCE, |clearance, left, right| {
        let share = left.area().min(right.area()) / area;
        let fatness = left.fatness().min(right.fatness());
        clearance * (fatness / 0.25).clamp(0.0, 1.0) * (share / 0.25).clamp(0.0, 1.0).powf(0.25)
    })
}

/// The chord that parts the corners of a cell most evenly, for cells with many of them; it may pass them closely.
pub(super) fn middle_chord(outline: &Outline, cell: &Cell) -> Option<(EdgePoint, EdgePoint)> {
    let corners = |part: &Cell| part.corners.iter().flatten().count() as f64;
    let half = 0.5 * corners(cell);
    best(outline, cell, f64::INFINITY, CLOSEST, |clearance, left, right| {
        clearance * (corners(left).min(corners(right)) / half).min(1.0)
    })
}

/// The chord that cuts off the longest arm of a cell, if it has one: a chord across something narrow, half its own
/// length or more away from all corners. The tip of a corner is no arm: its series is at home there.
pub(super) fn neck_chord(outline: &Outline, cell: &Cell) -> Option<(EdgePoint, EdgePoint)> {
    let diameter = cell.diameter();
    best(outline, cell, NECK * diameter, MOST_CLEARANCE, |_, left, right| {
        let tip = |part: &Cell| part.corners.iter().flatten().count() < 2;
        let share = left.diameter().min(right.diameter()) / diameter;
        if tip(left) || tip(right) { 0.0 } else { MOST_CLEARANCE * share }
    })
}

/// A chord that parts the two walls of a narrow gap outside a cell (a slot, or what lies between two laps of a
/// spiral): it begins on a wall, two widths from where the gap ends, and crosses the cell by the shortest way.
pub(super) fn gap_chord(outline: &Outline, cell: &Cell) -> Option<(EdgePoint, EdgePoint)> {
    let ends = candidate_ends(outline, cell);
    let widest = NECK * cell.diameter();
    (0..cell.len()).filter_map(|wall| place_on_wall(cell, wall, widest)).find_map(|p| {
        let length = |q: &EdgePoint| (q.z - p.z).norm();
        let (a, b) = cell.ends(p.edge);
        let inward = (b - a) / (b - a).norm() * Complex64::I;
        let good = |q: &&EdgePoint| {
            let clear = outline.vertices.iter().all(|&c| (c - q.z).norm() > LEAST_CLEARANCE * length(q));
            let across = dot(inward, q.z - p.z) > 0.7 * length(q);
            q.edge != p.edge && across && clear && cell.sees(&p, q)
        };
        let q = ends.iter().filter(good).min_by(|a, b| length(a).total_cmp(&length(b)))?;
        Some(if p.edge < q.edge { (p, *q) } else { (*q, p) })
    })
}

/// Where a chord may begin on a wall of a gap no wider than `widest` and at least three widths deep.
fn place_on_wall(cell: &Cell, wall: usize, widest: f64) -> Option<EdgePoint> {
    let Edge::Side(_) = cell.edges[wall] else { return None };
    let n = cell.len();
    let (a, b) = cell.ends(wall);
    let length = (b - a).norm();
    let along = (b - a) / length;
    let width = |s: f64| cell.ray(a + along * s, along * -Complex64::I, 1e-9);
    // The other wall is seen from the middle; the gap ends where the way round to it is shorter.
    let (middle, other) = width(0.5 * length);
    if middle > widest || middle <= 0.0 {
        return None;
    }
    let forward = (other + n - wall) % n <= (wall + n - other) % n;
    let from_end = |s: f64| if forward { length - s } else { s };
    let depth = (0..4).map(|i| 0.5 * length * 0.5_f64.powi(i)).find(|&s| width(from_end(s)).0 <= widest)?;
    let local = width(from_end(depth)).0;
    let s = from_end((2.0 * local).max(0.02 * length));
    let deep = 3.0 * local < length && width(s).0 <= 1.5 * local;
    // Two sides of one corner have its series between them, which is enough unless they all but touch.
    let next = (wall + 1) % n == other || (other + 1) % n == wall;
    let open = next && local > OPEN_WEDGE * depth;
    (deep && !open).then_some(EdgePoint { edge: wall, z: a + along * s })
}

/// The chord of highest score among those that are no longer than `longest` and clear of the corners by `least` of
/// their length. The score is at most the clearance, which counts up to [`MOST_CLEARANCE`].
fn best(
    outline: &Outline,
    cell: &Cell,
    longest: f64,
    least: f64,
    score: impl Fn(f64, &Cell, &Cell) -> f64,
) -> Option<(EdgePoint, EdgePoint)> {
    let ends = candidate_ends(outline, cell);
    let mut pairs = Vec::new();
    for (x, p) in ends.iter().enumerate() {
        for (y, q) in ends.iter().enumerate().skip(x + 1) {
            let length = (q.z - p.z).norm();
            if p.edge != q.edge && length <= longest {
                let clearance = (clearance(outline, p.z, q.z, least * length) / length).min(MOST_CLEARANCE);
                if clearance >= least {
                    pairs.push((clearance, x, y));
                }
            }
        }
    }
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut best = (0.0, None);
    for (clearance, x, y) in pairs {
        if clearance <= best.0 {
            break;
        }
        let (p, q) = (&ends[x], &ends[y]);
        if !cell.sees(p, q) {
            continue;
        }
        let (left, right) = cell.split(p, q, 0);
        let score = score(clearance, &left, &right);
        if score > best.0 {
            best = (score, Some((*p, *q)));
        }
    }
    best.1.filter(|_| best.0 >= LEAST_SCORE.min(least))
}

/// Distance of the segment from the nearest corner; a lower one than `enough` may be any value below it.
fn clearance(outline: &Outline, p: Complex64, q: Complex64, enough: f64) -> f64 {
    let mut least = f64::INFINITY;
    for &c in &outline.vertices {
        least = least.min(segment_distance(c, p, q));
        if least < enough {
            break;
        }
    }
    least
}

/// Points on the edges, evenly, towards the ends, and opposite the corners.
fn candidate_ends(outline: &Outline, cell: &Cell) -> Vec<EdgePoint> {
    let per_edge = (MOST_ENDS / cell.len()).clamp(3, 11);
    let mut out = Vec::new();
    for edge in 0..cell.len() {
        let (a, b) = cell.ends(edge);
        let d = b - a;
        let mut places: Vec<f64> =
            (0..per_edge).map(|i| (i as f64 + 1.0) / (per_edge as f64 + 1.0)).collect();
        let opposite = outline.vertices.iter().map(|&c| dot(d, c - a) / d.norm_sqr());
        places.extend(opposite.filter(|t| (0.02..=0.98).contains(t)).take(2 * per_edge));
        let mut near = 0.5 / (per_edge as f64 + 1.0);
        while near * d.norm() > 1e-4 && places.len() < 5 * per_edge {
            places.extend([near, 1.0 - near]);
            near *= 0.5;
        }
        places.sort_by(f64::total_cmp);
        places.dedup_by(|x, y| (*x - *y).abs() < 1e-9);
        out.extend(places.into_iter().map(|t| EdgePoint { edge, z: a + d * t }));
    }
    out
}
