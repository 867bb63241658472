//! The plan of a face, and its ribbons.

use casteljau::io::RibbonRecord;

use crate::guide::{Guide, Series};

type Point = [f64; 2];

/// A side of a plan: where it ends, and how its ribbon is made.
#[derive(Clone, Copy, Debug)]
pub struct Side {
    /// The vertex at its end.
    pub end: Point,
    /// The middle control point of a side that is a parabola in the plan.
    pub bend: Option<Point>,
    pub degree: usize,
    pub layers: usize,
}

/// A straight side.
pub fn straight(u: f64, v: f64, degree: usize, layers: usize) -> Side {
    Side { end: [u, v], bend: None, degree, layers }
}

/// A side bent towards a control point.
pub fn bent(bend: Point, end: Point, degree: usize, layers: usize) -> Side {
    Side { end, bend: Some(bend), degree, layers }
}

/// The ribbons of a face, one a side.
///
/// Across a side, the strip leads along its neighbours: into the neighbour at a convex corner, on along the neighbour's
/// own direction at a concave one, and in between linearly.
pub fn ribbons(guide: &Guide, plan: &[Side]) -> Vec<RibbonRecord> {
    let n = plan.len();
    let start = |i: usize| plan[(i + n - 1) % n].end;
    // 1 for a plan that runs counter-clockwise.
    let sense = (0..n).map(|i| cross(start(i), plan[i].end)).sum::<f64>().signum();
    // Derivatives of the sides' plans at their ends.
    let leaving = |i: usize| match plan[i].bend {
        Some(bend) => scaled(minus(bend, start(i)), 2.0),
        None => minus(plan[i].end, start(i)),
    };
    let arriving = |i: usize| match plan[i].bend {
        Some(bend) => scaled(minus(plan[i].end, bend), 2.0),
        None => minus(plan[i].end, start(i)),
    };
    let ribbon = |i: usize| {
        let (before, after) = ((i + n - 1) % n, (i + 1) % n);
        let concave = |a: Point, b: Point| sense * cross(a, b) < 0.0;
        let first = scaled(arriving(before), if concave(arriving(before), leaving(i)) { 1.0 } else { -1.0 });
        let last = scaled(leaving(after), if concave(arriving(i), leaving(after)) { -1.0 } else { 1.0 });
        let strip = std::array::from_fn(|axis| strip(&plan[i], start(i), first, last, axis));
        let values = guide.along(&strip).map(|series| series.control_values(plan[i].degree));
        let [x, y, z] = &values;
        let point = |k: usize, j: usize| [x[k][j], y[k][j], z[k][j]].map(rounded);
        let row = |k: usize| (0..=plan[i].degree).map(|j| point(k, j)).collect();
        RibbonRecord { control_points: (0..plan[i].layers).map(row).collect() }
    };
    (0..n).map(ribbon).collect()
}

/// One coordinate of the plan of a strip: the side's parabola, and h times a direction that is linear in s.
fn strip(side: &Side, start: Point, first: Point, last: Point, axis: usize) -> Series {
    let (a, c) = (start[axis], side.end[axis]);
    let b = side.bend.map_or(0.5 * (a + c), |bend| bend[axis]);
    let mut rows = vec![vec![0.0]; side.layers];
    rows[0] = match side.bend {
        Some(_) => vec![a, 2.0 * (b - a), a - 2.0 * b + c],
        None => vec![a, c - a],
    };
    if let Some(row) = rows.get_mut(1) {
        *row = vec![first[axis], last[axis] - first[axis]];
    }
    Series(rows)
}

/// To a millionth of a unit, so that files can be read by people; equal points stay equal.
fn rounded(x: f64) -> f64 {
    let rounded = (x * 1e6).round() / 1e6;
    // No −0.
    rounded + 0.0
}

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

fn scaled(a: Point, factor: f64) -> Point {
    [a[0] * factor, a[1] * factor]
}
