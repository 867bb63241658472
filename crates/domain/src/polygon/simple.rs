//! Exact test for simplicity, and distances between sides.

use casteljau_geom::glam::DVec2;

use super::{Orientation, Polygon, turn};
use crate::DomainError;

/// All rules of [`Polygon`], in the order of their cost.
pub(super) fn check(vertices: &[DVec2]) -> Result<Orientation, DomainError> {
    let n = vertices.len();
    if n < 3 {
        return Err(DomainError::TooFewSides { count: n });
    }
    if let Some(corner) = vertices.iter().position(|p| !p.is_finite()) {
        return Err(DomainError::NotFinite { corner, position: vertices[corner].extend(0.0).into() });
    }
    for side in 0..n {
        let [a, b] = ends(vertices, side);
        if a == b {
            return Err(DomainError::ZeroSide { side, position: b.extend(0.0).into() });
        }
    }
    range(vertices)?;
    for corner in 0..n {
        let [a, b] = ends(vertices, corner);
        let c = vertices[(corner + 1) % n];
        // Comparing coordinates decides exactly whether collinear a and c lie on one side of b.
        let ahead = |p: DVec2| if p.x != b.x { p.x > b.x } else { p.y > b.y };
        if turn(a, b, c) == 0.0 && ahead(a) == ahead(c) {
            return Err(DomainError::FoldBack { side: corner, corner, position: b.into() });
        }
    }
    if let Some((first, second)) = first_meeting(vertices) {
        let position = meeting_point(ends(vertices, first), ends(vertices, second)).into();
        return Err(DomainError::SidesMeet { first, second, position });
    }
    // The lexicographically first vertex is convex, and not straight because nothing folds back.
    let mut least = 0;
    for i in 1..n {
        let (p, q) = (vertices[i], vertices[least]);
        if p.x < q.x || (p.x == q.x && p.y < q.y) {
            least = i;
        }
    }
    let [a, b] = ends(vertices, least);
    let left = turn(a, b, vertices[(least + 1) % n]) > 0.0;
    Ok(if left { Orientation::CounterClockwise } else { Orientation::Clockwise })
}

fn range(vertices: &[DVec2]) -> Result<(), DomainError> {
    let [min, max] = extent(vertices);
    let largest = max.max(-min).max_element();
    let size = (max - min).max_element();
    let (least, most) = (Polygon::LEAST_SIZE, Polygon::LARGEST_COORDINATE);
    if largest > most || size < least {
        return Err(DomainError::OutOfRange { largest, size, least, most });
    }
    Ok(())
}

fn ends(vertices: &[DVec2], side: usize) -> [DVec2; 2] {
    let n = vertices.len();
    [vertices[(side + n - 1) % n], vertices[side]]
}

/// Bounding box of at least one point.
pub(super) fn extent(points: &[DVec2]) -> [DVec2; 2] {
    points.iter().fold([points[0]; 2], |[min, max], p| [min.min(*p), max.max(*p)])
}

/// The first pair of sides, neighbours excepted, that share a point; the least first number, then the least
/// second.
///
/// Sides are swept in the order of their left ends, so only those that overlap in x are compared.
fn first_meeting(vertices: &[DVec2]) -> Option<(usize, usize)> {
    let n = vertices.len();
    let boxes: Vec<[DVec2; 2]> = (0..n).map(|i| extent(&ends(vertices, i))).collect();
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&i, &j| boxes[i][0].x.total_cmp(&boxes[j][0].x).then(i.cmp(&j)));
    let mut active: Vec<usize> = Vec::new();
    let mut found: Option<(usize, usize)> = None;
    for i in order {
        let [min, max] = boxes[i];
        active.retain(|&j| boxes[j][1].x >= min.x);
        for &j in &active {
            let pair = (i.min(j), i.max(j));
            let neighbours = pair.1 - pair.0 == 1 || (pair.0 == 0 && pair.1 == n - 1);
            let apart = boxes[j][0].y > max.y || boxes[j][1].y < min.y;
            if !neighbours
                && !apart
                && found.is_none_or(|f| pair < f)
                && meet(ends(vertices, i), ends(vertices, j))
            {
                found = Some(pair);
            }
        }
        active.push(i);
    }
    found
}

/// Whether two closed segments of non-zero length share a point, exactly.
fn meet([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    let (c_side, d_side) = (turn(a, b, c), turn(a, b, d));
    let (a_side, b_side) = (turn(c, d, a), turn(c, d, b));
    if opposite(c_side, d_side) && opposite(a_side, b_side) {
        return true;
    }
    (c_side == 0.0 && within(c, a, b))
        || (d_side == 0.0 && within(d, a, b))
        || (a_side == 0.0 && within(a, c, d))
        || (b_side == 0.0 && within(b, c, d))
}

fn opposite(a: f64, b: f64) -> bool {
    (a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0)
}

/// Whether p, known to be on the line ab, is on the segment ab.
fn within(p: DVec2, a: DVec2, b: DVec2) -> bool {
    let [min, max] = extent(&[a, b]);
    p.cmpge(min).all() && p.cmple(max).all()
}

/// A common point of two segments that meet, to rounding, for messages.
fn meeting_point([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> DVec2 {
    let (start, end) = (turn(c, d, a), turn(c, d, b));
    if opposite(start, end) {
        return a + (b - a) * (start / (start - end));
    }
    let touching = [(c, a, b), (d, a, b), (a, c, d), (b, c, d)];
    let on = |&&(p, a, b): &&(DVec2, DVec2, DVec2)| turn(a, b, p) == 0.0 && within(p, a, b);
    touching.iter().find(on).map_or(a, |t| t.0)
}

/// Least distance between a vertex and a side that it does not end; see [`Polygon::clearance`].
pub(super) fn clearance(vertices: &[DVec2]) -> f64 {
    let n = vertices.len();
    let mut least = f64::INFINITY;
    for side in 0..n {
        let [a, b] = ends(vertices, side);
        let [min, max] = extent(&[a, b]);
        for (i, &p) in vertices.iter().enumerate() {
            let to_box = (min - p).max(p - max).max(DVec2::ZERO);
            if to_box.length_squared() < least * least && i != side && (i + 1) % n != side {
                least = least.min(distance_to_segment(p, a, b).0);
            }
        }
    }
    least
}

/// Distance from p to the segment ab, and the parameter of the nearest point, 0 at a and 1 at b.
pub(super) fn distance_to_segment(p: DVec2, a: DVec2, b: DVec2) -> (f64, f64) {
    let along = b - a;
    let t = ((p - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    let gap = match t {
        0.0 => p.distance(a),
        1.0 => p.distance(b),
        // The exact predicate keeps the digits of distances far below the rounding of the coordinates.
        _ => (turn(a, b, p) / along.length()).abs(),
    };
    (gap, t)
}
