//! Domains of solids as the search for a point sees them: cut into cells, each with the net over it.

use casteljau_bernstein::{
    BoxNet, SimplexNet, TetrahedronNet, WedgeNet, last_barycentric, restrict_tensor, simplex_count,
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
