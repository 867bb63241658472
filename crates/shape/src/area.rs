//! Surface area by adaptive quadrature.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use casteljau_geom::UNIT_ROUNDOFF;
use casteljau_geom::glam::DVec3;

use crate::arc_length::check_accuracy;
use crate::quadrature::gauss;
use crate::{ShapeError, SurfaceDomain};

/// At most so many cells are looked at.
const MOST_CELLS: usize = 8_000;

/// ∂u and ∂v at given parameters.
type Tangents<'a> = dyn Fn([f64; 2]) -> Result<[DVec3; 2], ShapeError> + 'a;

/// `∬ |∂u × ∂v| du dv` over the domain. See [`ParametricSurface::area`](crate::ParametricSurface::area).
pub(crate) fn area(tangents: &Tangents<'_>, domain: SurfaceDomain, relative: f64) -> Result<f64, ShapeError> {
    check_accuracy(relative)?;
    let rule: Vec<(f64, f64)> = gauss().collect();
    let cell = |corner: [f64; 2], width: f64| Cell::new(tangents, domain, &rule, corner, width);
    let node = |whole: Cell| {
        let half = 0.5 * whole.width;
        let [x, y] = whole.corner;
        let corners = [[x, y], [x + half, y], [x, y + half], [x + half, y + half]];
        let mut quarters = Vec::with_capacity(4);
        for corner in corners {
            quarters.push(cell(corner, half)?);
        }
        Ok::<_, ShapeError>(Node::new(&whole, quarters))
    };
    // The worst node is refined first, so that creases get no more cells than the sum of all errors asks for.
    let mut nodes = BinaryHeap::from([node(cell([0.0, 0.0], 1.0)?)?]);
    loop {
        let sum = |member: fn(&Node) -> f64| nodes.iter().map(member).sum::<f64>();
        let (area, error) = (sum(|n| n.area), sum(|n| n.change) + sum(|n| n.rounding));
        if area > 0.0 && error <= relative * area {
            return Ok(area);
        }
        let cells = nodes.len();
        let hopeless = nodes.peek().is_none_or(|worst| worst.change <= worst.rounding);
        if cells >= MOST_CELLS || hopeless {
            let reached = if area > 0.0 { error / area } else { f64::INFINITY };
            return Err(ShapeError::Area { area, reached, relative, cells });
        }
        // A quarter of the nodes at once: the sums above are few.
        for _ in 0..cells.div_ceil(4) {
            let Some(worst) = nodes.pop() else { break };
            for quarter in worst.quarters {
                nodes.push(node(quarter)?);
            }
        }
    }
}

/// A cell with its quarters.
struct Node {
    quarters: Vec<Cell>,
    /// By the rule on the quarters.
    area: f64,
    /// From the rule on the whole: an estimate of the error.
    change: f64,
    rounding: f64,
}

impl Node {
    fn new(whole: &Cell, quarters: Vec<Cell>) -> Self {
        let area: f64 = quarters.iter().map(|q| q.area).sum();
        let rounding = quarters.iter().map(|q| q.rounding).sum();
        Self { quarters, area, change: (area - whole.area).abs(), rounding }
    }
}

impl Ord for Node {
    fn cmp(&self, other: &Self) -> Ordering {
        self.change.total_cmp(&other.change)
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
    /// A bound on the rounding of the area.
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
        let (mut area, mut sides) = (0.0, 0.0);
        for &(s, a) in rule {
            for &(t, b) in rule {
                let [x, y] = [corner[0] + width * s, corner[1] + width * t];
                // On a triangle the square's side x = 1 collapses to a vertex.
                let (parameters, jacobian) = match domain {
                    SurfaceDomain::Rectangle([u, v]) => ([u.at(x), v.at(y)], u.length() * v.length()),
                    SurfaceDomain::Triangle => ([x, (1.0 - x) * y], 1.0 - x),
                };
                let [du, dv] = tangents(parameters)?;
                let weight = a * b * jacobian;
                area += weight * du.cross(dv).length();
                sides += weight * du.length() * dv.length();
            }
        }
        let square = width * width;
        // Each factor is right to some roundings; sixteen cover low degrees and the sum.
        Ok(Self { corner, width, area: area * square, rounding: 16.0 * UNIT_ROUNDOFF * sides * square })
    }
}
