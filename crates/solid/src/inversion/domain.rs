//! Domains of solids as the search for a point sees them: cut into cells, each with the net over it.

use casteljau_bernstein::{
    BoxNet, SimplexNet, TetrahedronNet, WedgeNet, last_barycentric, multi_indices, restrict_tensor,
    simplex_count, simplex_index,
};
use casteljau_geom::glam::{DMat3, DVec3, DVec4};

use crate::SolidError;

/// Coordinates scaled to this sum add up to no more than 1, whatever rounding does.
const INSIDE: f64 = 1.0 - 2.0 * f64::EPSILON;

/// A kind of domain, with the degrees of the net over it.
pub(super) trait Domain {
    /// A part of the domain.
    type Cell: Copy;

    /// The whole.
    fn whole(&self) -> Self::Cell;

    /// The two halves across the direction `axis` (taken modulo the number of directions).
    fn halves(&self, cell: &Self::Cell, axis: usize) -> [Self::Cell; 2];

    /// How many directions there are to halve across.
    fn directions(&self) -> usize;

    /// The edge of a cell, in parameters, that is halved in a direction.
    fn edge(&self, cell: &Self::Cell, axis: usize) -> DVec3;

    /// The middle of a cell.
    fn center(&self, cell: &Self::Cell) -> DVec3;

    /// From the cell's own coordinates, −1 to 1 about its middle, to parameters: half edges as columns.
    fn frame(&self, cell: &Self::Cell) -> DMat3;

    /// A cell about the same middle, so many times as large; it may reach beyond the domain.
    fn grown(&self, cell: &Self::Cell, factor: f64) -> Self::Cell;

    /// Whether a cell contains parameters and all that are no farther from them than `margin` in each.
    fn holds(&self, cell: &Self::Cell, at: DVec3, margin: f64) -> bool;

    /// Whether all parameters no farther than `margin` in each from these are outside the domain.
    fn is_outside(&self, at: DVec3, margin: f64) -> bool;

    /// A bound on `Σ|B|` over a cell: how far rounding may grow where a cell reaches beyond the domain.
    fn growth(&self, cell: &Self::Cell) -> f64;

    /// Hands out the Bernstein coefficients of the derivatives over a cell by its own coordinates, from its net.
    fn slopes(&self, net: &[DVec4], visit: impl FnMut(usize, DVec4));

    /// The net over a cell, in the order of the whole.
    fn restrict(
        &self,
        net: &[DVec4],
        cell: &Self::Cell,
        out: &mut [DVec4],
        work: &mut Vec<DVec4>,
    ) -> Result<(), SolidError>;

    /// Value and first derivatives by the parameters.
    fn jet(&self, net: &[DVec4], at: DVec3) -> [DVec4; 4];

    /// The nearest parameters of the domain, or near ones.
    fn clamp(&self, at: DVec3) -> DVec3;

    /// The sum of the degrees.
    fn degree(&self) -> usize;
}

fn grown_interval([a, b]: [f64; 2], factor: f64) -> [f64; 2] {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a) * factor);
    [middle - half, middle + half]
}

/// The largest `(|1−t| + |t|)ⁿ` of an interval.
fn spread(interval: &[f64; 2], degree: usize) -> f64 {
    let largest = interval.iter().map(|t| (1.0 - t).abs() + t.abs()).fold(1.0, f64::max);
    largest.powi(i32::try_from(degree).unwrap_or(i32::MAX))
}

/// The largest `(Σ|λ|)ⁿ` of corners in (λ₁, λ₂, λ₃), with the last coordinate from the others.
fn simplex_spread(corners: &[DVec3], degree: usize) -> f64 {
    let sum = |c: &DVec3| c.abs().element_sum() + (1.0 - c.element_sum()).abs();
    let largest = corners.iter().map(sum).fold(1.0, f64::max);
    largest.powi(i32::try_from(degree).unwrap_or(i32::MAX))
}

/// Whether the first `count` of the coordinates `M·x`, and 1 less their sum, are at least 0 for all that is within
/// `margin` of x.
fn holds_coordinates(m: DMat3, x: DVec3, margin: f64, count: usize) -> bool {
    let coordinates = m * x;
    let slack = (m.x_axis.abs() + m.y_axis.abs() + m.z_axis.abs()) * margin;
    let (mut sum, mut unsure) = (0.0, 0.0);
    for axis in 0..count {
        if coordinates[axis].is_nan() || coordinates[axis] < slack[axis] {
            return false;
        }
        sum += coordinates[axis];
        unsure += slack[axis];
    }
    sum + unsure <= 1.0
}

/// `[0, 1]³` under a tensor-product net.
pub(super) struct Cube(pub [usize; 3]);

impl Domain for Cube {
    type Cell = [[f64; 2]; 3];

    fn whole(&self) -> Self::Cell {
        [[0.0, 1.0]; 3]
    }

    fn halves(&self, cell: &Self::Cell, axis: usize) -> [Self::Cell; 2] {
        let axis = axis % 3;
        let [a, b] = cell[axis];
        let middle = 0.5 * (a + b);
        [[a, middle], [middle, b]].map(|half| {
            let mut child = *cell;
            child[axis] = half;
            child
        })
    }

    fn directions(&self) -> usize {
        3
    }

    fn edge(&self, cell: &Self::Cell, axis: usize) -> DVec3 {
        let [a, b] = cell[axis % 3];
        DVec3::AXES[axis % 3] * (b - a)
    }

    fn center(&self, cell: &Self::Cell) -> DVec3 {
        DVec3::from_array(cell.map(|[a, b]| 0.5 * (a + b)))
    }

    fn frame(&self, cell: &Self::Cell) -> DMat3 {
        DMat3::from_diagonal(DVec3::from_array(cell.map(|[a, b]| 0.5 * (b - a))))
    }

    fn grown(&self, cell: &Self::Cell, factor: f64) -> Self::Cell {
        cell.map(|interval| grown_interval(interval, factor))
    }

    fn holds(&self, cell: &Self::Cell, at: DVec3, margin: f64) -> bool {
        (0..3).all(|axis| cell[axis][0] <= at[axis] - margin && at[axis] + margin <= cell[axis][1])
    }

    fn is_outside(&self, at: DVec3, margin: f64) -> bool {
        at.cmplt(DVec3::splat(-margin)).any() || at.cmpgt(DVec3::splat(1.0 + margin)).any()
    }

    fn growth(&self, cell: &Self::Cell) -> f64 {
        cell.iter().zip(self.0).map(|(&interval, degree)| spread(&interval, degree)).product()
    }

    fn slopes(&self, net: &[DVec4], mut visit: impl FnMut(usize, DVec4)) {
        let [l, m, n] = self.0;
        let strides = [(m + 1) * (n + 1), n + 1, 1];
        for (place, &p) in net.iter().enumerate() {
            let index = [place / strides[0], place / strides[1] % (m + 1), place % (n + 1)];
            for (axis, degree) in [l, m, n].into_iter().enumerate() {
                if index[axis] < degree {
                    visit(axis, (net[place + strides[axis]] - p) * (0.5 * degree as f64));
                }
            }
        }
    }

    fn restrict(
        &self,
        net: &[DVec4],
        cell: &Self::Cell,
        out: &mut [DVec4],
        _: &mut Vec<DVec4>,
    ) -> Result<(), SolidError> {
        Ok(restrict_tensor(net, self.0, *cell, out)?)
    }

    fn jet(&self, net: &[DVec4], at: DVec3) -> [DVec4; 4] {
        let mut jet = [DVec4::ZERO; 4];
        BoxNet::validated(net, self.0).partials(at.x, at.y, at.z, &mut jet);
        jet
    }

    fn clamp(&self, at: DVec3) -> DVec3 {
        at.clamp(DVec3::ZERO, DVec3::ONE)
    }

    fn degree(&self) -> usize {
        self.0.iter().sum()
    }
}

/// The unit tetrahedron in (λ₁, λ₂, λ₃).
pub(super) struct Corner(pub usize);

/// The edges of a tetrahedron, two by two opposite.
const EDGES: [[usize; 2]; 6] = [[0, 1], [2, 3], [0, 2], [1, 3], [0, 3], [1, 2]];

/// The half of a simplex with `new` in place of vertex `vertex`.
fn replaced<const V: usize>(corners: &[DVec3; V], vertex: usize, new: DVec3) -> [DVec3; V] {
    let mut half = *corners;
    half[vertex] = new;
    half
}

impl Domain for Corner {
    type Cell = [DVec3; 4];

    fn whole(&self) -> Self::Cell {
        [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ZERO]
    }

    fn halves(&self, cell: &Self::Cell, axis: usize) -> [Self::Cell; 2] {
        let [a, b] = EDGES[axis % 6];
        let middle = 0.5 * (cell[a] + cell[b]);
        [replaced(cell, b, middle), replaced(cell, a, middle)]
    }

    fn directions(&self) -> usize {
        6
    }

    fn edge(&self, cell: &Self::Cell, axis: usize) -> DVec3 {
        let [a, b] = EDGES[axis % 6];
        cell[b] - cell[a]
    }

    fn center(&self, cell: &Self::Cell) -> DVec3 {
        0.25 * (cell[0] + cell[1] + cell[2] + cell[3])
    }

    fn frame(&self, [a, b, c, d]: &Self::Cell) -> DMat3 {
        DMat3::from_cols(0.5 * (a - d), 0.5 * (b - d), 0.5 * (c - d))
    }

    fn grown(&self, cell: &Self::Cell, factor: f64) -> Self::Cell {
        let center = self.center(cell);
        cell.map(|corner| center + factor * (corner - center))
    }

    fn holds(&self, cell: &Self::Cell, at: DVec3, margin: f64) -> bool {
        let to_local = (2.0 * self.frame(cell)).inverse();
        holds_coordinates(to_local, at - cell[3], margin, 3)
    }

    fn is_outside(&self, at: DVec3, margin: f64) -> bool {
        at.cmplt(DVec3::splat(-margin)).any() || at.element_sum() > 1.0 + 3.0 * margin
    }

    fn growth(&self, cell: &Self::Cell) -> f64 {
        simplex_spread(cell, self.0)
    }

    fn slopes(&self, net: &[DVec4], mut visit: impl FnMut(usize, DVec4)) {
        let Some(lower) = self.0.checked_sub(1) else { return };
        for index in multi_indices::<4>(lower) {
            let at = |vertex: usize| {
                let mut raised = index;
                raised[vertex] += 1;
                net[simplex_index(raised)]
            };
            for axis in 0..3 {
                visit(axis, (at(axis) - at(3)) * (0.5 * self.0 as f64));
            }
        }
    }

    fn restrict(
        &self,
        net: &[DVec4],
        cell: &Self::Cell,
        out: &mut [DVec4],
        work: &mut Vec<DVec4>,
    ) -> Result<(), SolidError> {
        work.resize(4 * net.len(), DVec4::ZERO);
        let corners = cell.map(|c| [c.x, c.y, c.z, last_barycentric(&c.to_array())]);
        Ok(TetrahedronNet::validated(net, self.0).restrict(corners, out, work)?)
    }

    fn jet(&self, net: &[DVec4], at: DVec3) -> [DVec4; 4] {
        let mut jet = [DVec4::ZERO; 4];
        let lambda = [at.x, at.y, at.z, last_barycentric(&at.to_array())];
        SimplexNet::<DVec4, 4>::validated(net, self.0).partials(lambda, &mut jet);
        jet
    }

    fn clamp(&self, at: DVec3) -> DVec3 {
        let inside = at.max(DVec3::ZERO);
        let sum = inside.element_sum();
        if sum > 1.0 { inside * (INSIDE / sum) } else { inside }
    }

    fn degree(&self) -> usize {
        self.0
    }
}

/// The unit triangle in (λ₁, λ₂) × `[0, 1]`.
pub(super) struct Prism(pub [usize; 2]);

/// A triangle of (λ₁, λ₂, 0) and an interval of w.
#[derive(Clone, Copy)]
pub(super) struct PrismCell {
    corners: [DVec3; 3],
    height: [f64; 2],
}

impl Domain for Prism {
    type Cell = PrismCell;

    fn whole(&self) -> PrismCell {
        PrismCell { corners: [DVec3::X, DVec3::Y, DVec3::ZERO], height: [0.0, 1.0] }
    }

    fn halves(&self, cell: &PrismCell, axis: usize) -> [PrismCell; 2] {
        if axis % 4 == 3 {
            let [a, b] = cell.height;
            let middle = 0.5 * (a + b);
            return [[a, middle], [middle, b]].map(|height| PrismCell { height, ..*cell });
        }
        let [a, b] = [[0, 1], [1, 2], [2, 0]][axis % 4];
        let middle = 0.5 * (cell.corners[a] + cell.corners[b]);
        [b, a].map(|vertex| PrismCell { corners: replaced(&cell.corners, vertex, middle), ..*cell })
    }

    fn directions(&self) -> usize {
        4
    }

    fn edge(&self, cell: &PrismCell, axis: usize) -> DVec3 {
        if axis % 4 == 3 {
            return DVec3::Z * (cell.height[1] - cell.height[0]);
        }
        let [a, b] = [[0, 1], [1, 2], [2, 0]][axis % 4];
        cell.corners[b] - cell.corners[a]
    }

    fn center(&self, cell: &PrismCell) -> DVec3 {
        let [a, b, c] = cell.corners;
        (a + b + c) / 3.0 + DVec3::Z * (0.5 * (cell.height[0] + cell.height[1]))
    }

    fn frame(&self, cell: &PrismCell) -> DMat3 {
        let ([a, b, c], [bottom, top]) = (cell.corners, cell.height);
        DMat3::from_cols(0.5 * (a - c), 0.5 * (b - c), DVec3::Z * (0.5 * (top - bottom)))
    }

    fn grown(&self, cell: &PrismCell, factor: f64) -> PrismCell {
        let [a, b, c] = cell.corners;
        let center = (a + b + c) / 3.0;
        PrismCell {
            corners: cell.corners.map(|corner| center + factor * (corner - center)),
            height: grown_interval(cell.height, factor),
        }
    }

    fn holds(&self, cell: &PrismCell, at: DVec3, margin: f64) -> bool {
        let [bottom, top] = cell.height;
        let to_local = (2.0 * self.frame(cell)).inverse();
        let from_corner = at - cell.corners[2] - DVec3::Z * bottom;
        bottom <= at.z - margin && at.z + margin <= top && holds_coordinates(to_local, from_corner, margin, 2)
    }

    fn is_outside(&self, at: DVec3, margin: f64) -> bool {
        at.cmplt(DVec3::splat(-margin)).any() || at.z > 1.0 + margin || at.x + at.y > 1.0 + 2.0 * margin
    }

    fn growth(&self, cell: &PrismCell) -> f64 {
        simplex_spread(&cell.corners, self.0[0]) * spread(&cell.height, self.0[1])
    }

    fn slopes(&self, net: &[DVec4], mut visit: impl FnMut(usize, DVec4)) {
        let [n, o] = self.0;
        for (place, &p) in net.iter().enumerate() {
            if place % (o + 1) < o {
                visit(2, (net[place + 1] - p) * (0.5 * o as f64));
            }
        }
        let Some(lower) = n.checked_sub(1) else { return };
        for index in multi_indices::<3>(lower) {
            for k in 0..=o {
                let at = |vertex: usize| {
                    let mut raised = index;
                    raised[vertex] += 1;
                    net[simplex_index(raised) * (o + 1) + k]
                };
                for axis in 0..2 {
                    visit(axis, (at(axis) - at(2)) * (0.5 * n as f64));
                }
            }
        }
    }

    fn restrict(
        &self,
        net: &[DVec4],
        cell: &PrismCell,
        out: &mut [DVec4],
        work: &mut Vec<DVec4>,
    ) -> Result<(), SolidError> {
        work.resize(5 * simplex_count::<3>(self.0[0]), DVec4::ZERO);
        let corners = cell.corners.map(|c| [c.x, c.y, last_barycentric(&[c.x, c.y])]);
        Ok(WedgeNet::validated(net, self.0).restrict(corners, cell.height, out, work)?)
    }

    fn jet(&self, net: &[DVec4], at: DVec3) -> [DVec4; 4] {
        let mut jet = [DVec4::ZERO; 4];
        let lambda = [at.x, at.y, last_barycentric(&[at.x, at.y])];
        WedgeNet::validated(net, self.0).partials(lambda, at.z, &mut jet);
        jet
    }

    fn clamp(&self, at: DVec3) -> DVec3 {
        let inside = at.clamp(DVec3::ZERO, DVec3::ONE);
        let sum = inside.x + inside.y;
        let scale = if sum > 1.0 { INSIDE / sum } else { 1.0 };
        DVec3::new(inside.x * scale, inside.y * scale, inside.z)
    }

    fn degree(&self) -> usize {
        self.0.iter().sum()
    }
}
