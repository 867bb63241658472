//! Surface area by adaptive quadrature, with an estimate of its error.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use casteljau_geom::UNIT_ROUNDOFF;
use casteljau_geom::glam::DVec3;

use crate::arc_length::check_accuracy;
use crate::quadrature::gauss;
use crate::{ShapeError, SurfaceDomain};

/// The stated error is so many times the changes from level to level: at a fold these are of the size of the error, and
/// by chance may be a fraction of it.
const CAUTION: f64 = 4.0;

/// At most so many cells are looked at.
const MOST_CELLS: usize = 8_000;

/// S, ∂u and ∂v at given parameters.
type Tangents<'a> = dyn Fn([f64; 2]) -> Result<[DVec3; 3], ShapeError> + 'a;

/// An area with its stated error; see [`ParametricSurface::area_with_error`](crate::ParametricSurface::area_with_error).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredArea {
    /// The area, in squares of the unit of the control points.
    pub area: f64,
    /// An estimate of the largest error of the area, in the same unit: no proven bound.
    pub error: f64,
    /// The number of cells that were looked at.
    pub cells: usize,
}

/// `∬ |∂u × ∂v| du dv` over the domain.
pub(crate) fn area(
    tangents: &Tangents<'_>,
    domain: SurfaceDomain,
    relative: f64,
) -> Result<MeasuredArea, ShapeError> {
    check_accuracy(relative)?;
    let rule: Vec<(f64, f64)> = gauss().collect();
    let cell = |corner: [f64; 2], width: f64| Cell::new(tangents, domain, &rule, corner, width);
    let node = |whole: Cell, before: f64| {
        let half = 0.5 * whole.width;
        let [x, y] = whole.corner;
        let corners = [[x, y], [x + half, y], [x, y + half], [x + half, y + half]];
        let mut quarters = Vec::with_capacity(4);
        for corner in corners {
            quarters.push(cell(corner, half)?);
        }
        Ok::<_, ShapeError>(Node::new(&whole, quarters, before))
    };
    // The worst node is refined first, so that creases get no more cells than the sum of all errors asks for.
    let mut nodes = BinaryHeap::from([node(cell([0.0, 0.0], 1.0)?, f64::INFINITY)?]);
    loop {
        let sum = |member: fn(&Node) -> f64| nodes.iter().map(member).sum::<f64>();
        let (area, error) = (sum(|n| n.area), sum(|n| n.error) + sum(|n| n.rounding));
        if area > 0.0 && error <= relative * area {
            return Ok(MeasuredArea { area, error, cells: nodes.len() });
        }
        let cells = nodes.len();
        let hopeless = nodes.peek().is_none_or(|worst| worst.error <= worst.rounding);
        if cells >= MOST_CELLS || hopeless {
            let reached = if area > 0.0 { error / area } else { f64::INFINITY };
            return Err(ShapeError::Area { area, reached, relative, cells });
        }
        // A quarter of the nodes at once: the sums above are few.
        for _ in 0..cells.div_ceil(4) {
            let Some(worst) = nodes.pop() else { break };
            for quarter in worst.quarters {
                nodes.push(node(quarter, worst.change)?);
            }
        }
    }
}

/// A cell with its quarters.
struct Node {
    quarters: Vec<Cell>,
    /// By the rule on the quarters.
    area: f64,
    /// From the rule on the whole.
    change: f64,
    /// An estimate of the error.
    error: f64,
    rounding: f64,
}

impl Node {
    /// `before` is the change of the node that the whole is a quarter of.
    fn new(whole: &Cell, quarters: Vec<Cell>, before: f64) -> Self {
        let area: f64 = quarters.iter().map(|q| q.area).sum();
        let rounding = quarters.iter().map(|q| q.rounding).sum();
        let change = (area - whole.area).abs();
        // Two rules may agree by chance. Along a fold the error falls by no more than four from level to level, so the
        // four nodes of a quarter each keep a sixteenth of the change before; on smooth surfaces the change falls much
        // faster, and the price is one level.
        let error = CAUTION * change.max(before / 16.0);
        Self { quarters, area, change, error, rounding }
    }
}

impl Ord for Node {
    fn cmp(&self, other: &Self) -> Ordering {
        self.error.total_cmp(&other.error)
    }
}

impl PartialOrd for Node {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Node {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Node {}

/// A square of the unit square that the domain is mapped to, with its area by one application of Gauss's rule.
struct Cell {
    corner: [f64; 2],
    width: f64,
    area: f64,
    /// What rounding does to the area.
    rounding: f64,
}

impl Cell {
    fn new(
        tangents: &Tangents<'_>,
        domain: SurfaceDomain,
        rule: &[(f64, f64)],
        corner: [f64; 2],
        width: f64,
    ) -> Result<Self, ShapeError> {
        let lengths = domain.lengths();
        let (mut area, mut sides, mut places) = (0.0, 0.0, 0.0);
        for &(s, a) in rule {
            for &(t, b) in rule {
                let [x, y] = [corner[0] + width * s, corner[1] + width * t];
                // On a triangle the square's side x = 1 collapses to a vertex.
                let (parameters, jacobian) = match domain {
                    SurfaceDomain::Rectangle([u, v]) => ([u.at(x), v.at(y)], 1.0),
                    SurfaceDomain::Triangle => ([x, (1.0 - x) * y], 1.0 - x),
                };
                let [point, du, dv] = tangents(parameters)?;
                let [du, dv] = [du * lengths[0], dv * lengths[1]];
                let weight = a * b * jacobian;
                area += weight * du.cross(dv).length();
                sides += weight * du.length() * dv.length();
                places += weight * point.length() * (du.length() + dv.length());
            }
        }
        let square = width * width;
        // Each factor is right to some roundings; sixteen cover low degrees and the sum. Derivatives are differences of
        // places, whose own rounding stays in them: it matters far from the origin.
        let rounding = UNIT_ROUNDOFF * (16.0 * sides + 64.0 * places) * square;
        Ok(Self { corner, width, area: area * square, rounding })
    }
}
