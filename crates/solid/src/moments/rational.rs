//! Moments of rational solids by adaptive quadrature.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use casteljau_bernstein::elevate;
use casteljau_bernstein::glam::{DVec3, DVec4};

use super::gauss::{Cell, Integrand};
use super::{Integrals, MassProperties, assembled};
use crate::SolidError;
use crate::certificate::{SolidDegrees, exponent};

/// The stated error is so many times the change from a cell to its halves.
const CAUTION: f64 = 4.0;

/// At most so many cells are looked at.
const MOST_CELLS: usize = 8_000;

/// All ten integrals about a point, to a relative error.
pub(super) fn integrate(
    points: &[DVec4],
    degrees: SolidDegrees,
    reference: DVec3,
    relative: f64,
) -> Result<MassProperties, SolidError> {
    let mut net: Vec<DVec4> = points.iter().map(|p| (p.truncate() - reference * p.w).extend(p.w)).collect();
    let largest = |of: fn(&DVec4) -> f64| net.iter().map(of).fold(0.0, f64::max);
    let in_weight = exponent(largest(|p| p.w.abs()));
    let in_space = exponent(largest(|p| p.truncate().abs().max_element())) - in_weight;
    for p in &mut net {
        let weight = 2_f64.powi(-in_weight);
        *p = (p.truncate() * weight * 2_f64.powi(-in_space)).extend(p.w * weight);
    }
    let (mut net, degrees) = as_hexahedron(net, degrees)?;
    even_out(&mut net, degrees);
    let integrand = Integrand::new(net, degrees);
    let mut nodes = BinaryHeap::from([Node::new(&integrand, integrand.cell([[0.0, 1.0]; 3]))]);
    let mut cells = 3;
    let scales = [3 * in_space, in_space];
    loop {
        let sum = |of: &dyn Fn(&Node) -> f64| nodes.iter().map(of).sum::<f64>();
        let sums: Integrals = std::array::from_fn(|k| sum(&|n: &Node| n.sums[k]));
        let mut errors = [0.0; 10];
        let mut reached = 0.0_f64;
        for (k, error) in errors.iter_mut().enumerate() {
            let kind = KINDS[k];
            *error = sum(&|n: &Node| n.errors[k] + n.rounding[kind]);
            let size = sum(&|n: &Node| n.sizes[kind]);
            if *error > 0.0 {
                reached = reached.max(*error / size);
            }
        }
        if reached <= relative {
            return Ok(assembled(sums, errors, reference, scales));
        }
        let hopeless = nodes.peek().is_none_or(|worst| worst.error <= worst.floor);
        if cells >= MOST_CELLS || hopeless || reached.is_nan() {
            let volume = assembled(sums, errors, reference, scales).volume;
            return Err(SolidError::Moments { volume, reached, relative, cells });
        }
        // A quarter of the nodes at once: the sums above are few.
        for _ in 0..nodes.len().div_ceil(4) {
            let Some(worst) = nodes.pop() else { break };
            for half in worst.halves {
                nodes.push(Node::new(&integrand, half));
                cells += 2;
            }
        }
    }
}

/// Which of the sizes belongs to an integral.
const KINDS: [usize; 10] = [0, 1, 1, 1, 2, 2, 2, 2, 2, 2];

/// A cell with its halves.
struct Node {
    halves: [Cell; 2],
    /// By the rule on the halves.
    sums: Integrals,
    sizes: [f64; 3],
    rounding: [f64; 3],
    /// Estimates of the errors.
    errors: Integrals,
    /// The largest of them, the solid being of size 1.
    error: f64,
    /// What cannot be had better for rounding.
    floor: f64,
}

impl Node {
    fn new(integrand: &Integrand, whole: Cell) -> Self {
        let roughest = (0..3)
            .fold(0, |best, axis| if whole.roughness[axis] > whole.roughness[best] { axis } else { best });
        let [a, b] = whole.bounds[roughest];
        let halves = [[a, 0.5 * (a + b)], [0.5 * (a + b), b]].map(|part| {
            let mut bounds = whole.bounds;
            bounds[roughest] = part;
            integrand.cell(bounds)
        });
        let both = |of: &dyn Fn(&Cell) -> f64| halves.iter().map(of).sum::<f64>();
        let sums: Integrals = std::array::from_fn(|k| both(&|c: &Cell| c.sums[k]));
        let sizes = std::array::from_fn(|k| both(&|c: &Cell| c.sizes[k]));
        let rounding = std::array::from_fn(|k| both(&|c: &Cell| c.rounding[k]));
        // Halving along one axis says nothing about the others: what varies fastest along them is not integrated exactly
        // either, and each rule forgets less than it sees of that.
        let others: f64 = (0..3).filter(|&axis| axis != roughest).map(|axis| whole.roughness[axis]).sum();
        let share = whole.sizes[0] + whole.sizes[2];
        let unseen = if share > 0.0 { others * (others / share) } else { 0.0 };
        let errors: Integrals = std::array::from_fn(|k| CAUTION * ((sums[k] - whole.sums[k]).abs() + unseen));
        let error = errors.iter().fold(0.0_f64, |most, &e| most.max(e));
        let floor = rounding.iter().fold(0.0_f64, |most, &e| most.max(e));
        Self { halves, sums, sizes, rounding, errors, error, floor }
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

/// A tetrahedron over (r, s, t) ↦ λ = (r, (1−r)s, (1−r)(1−s)t, …), a wedge over (r, s, w): hexahedra with collapsed sides.
///
/// `n!/β! λ^β = B_{β₁}ⁿ(r) · B_{β₂}^{n−β₁}(s) · B_{β₃}^{n−β₁−β₂}(t)`, the latter two elevated to degree n.
fn as_hexahedron(net: Vec<DVec4>, degrees: SolidDegrees) -> Result<(Vec<DVec4>, [usize; 3]), SolidError> {
    let (n, o) = match degrees {
        SolidDegrees::Hexahedron(degrees) => return Ok((net, degrees)),
        SolidDegrees::Tetrahedron(n) => (n, n),
        SolidDegrees::Wedge([n, o]) => (n, o),
    };
    let place = |i: usize, j: usize, k: usize| (i * (n + 1) + j) * (o + 1) + k;
    let mut out = vec![DVec4::ZERO; (n + 1) * (n + 1) * (o + 1)];
    let (mut row, mut column) = (vec![DVec4::ZERO; o + 1], vec![DVec4::ZERO; n + 1]);
    for i in 0..=n {
        // Rows of s of the degree n − i, each point being a row of t of the degree o.
        let mut rows = Vec::new();
        for j in 0..=n - i {
            let points: Vec<DVec4> = match degrees {
                SolidDegrees::Wedge(_) => (0..=o).map(|k| net[degrees.place([i, j, k])]).collect(),
                _ => (0..=n - i - j).map(|k| net[degrees.place([i, j, k])]).collect(),
            };
            elevate(&points, &mut row)?;
            rows.push(row.clone());
        }
        for k in 0..=o {
            let points: Vec<DVec4> = rows.iter().map(|row| row[k]).collect();
            elevate(&points, &mut column)?;
            for (j, &p) in column.iter().enumerate() {
                out[place(i, j, k)] = p;
            }
        }
    }
    Ok((out, [n, n, o]))
}

/// Brings weights of opposite faces to one size, `Hᵢⱼₖ · aⁱ bʲ cᵏ` with powers of two: a change of parameters u → u/(u+s(1−u)).
fn even_out(net: &mut [DVec4], degrees: [usize; 3]) {
    let indices = SolidDegrees::Hexahedron(degrees).indices();
    let slopes: [f64; 3] = std::array::from_fn(|axis| {
        let middle = 0.5 * degrees[axis] as f64;
        let (mut product, mut square) = (0.0, 0.0);
        for (p, index) in net.iter().zip(&indices).filter(|(p, _)| p.w != 0.0) {
            let off = index[axis] as f64 - middle;
            product += off * p.w.abs().log2();
            square += off * off;
        }
        if square > 0.0 { (product / square).round() } else { 0.0 }
    });
    for (p, index) in net.iter_mut().zip(&indices) {
        let power: f64 = (0..3).map(|axis| slopes[axis] * index[axis] as f64).sum();
        *p *= 2_f64.powf(-power);
    }
}
