//! The lattice over a domain: its places, what they lie on, and its cells.

use casteljau_shape::bernstein::{TRIANGLE_EDGES, last_barycentric, simplex_count, simplex_index};

use super::complex::Carrier;
use super::net::{Degrees, Local};

/// A cell of a lattice, by places: as the cells of a mesh, right side out in the parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum LatticeCell {
    Hexahedron([[u32; 4]; 8]),
    Tetrahedron([[u32; 4]; 4]),
    Wedge([[u32; 4]; 6]),
}

impl LatticeCell {
    pub fn places(&self) -> &[[u32; 4]] {
        match self {
            Self::Hexahedron(places) => places,
            Self::Tetrahedron(places) => places,
            Self::Wedge(places) => places,
        }
    }
}

impl Degrees {
    /// Local parameters of a place; exactly 0 and 1 on the faces.
    pub fn local(self, at: [u32; 4], counts: [u32; 3]) -> Local {
        let [a, b, c, d] = at.map(f64::from);
        let [l, m, n] = counts.map(f64::from);
        match self {
            Self::Hexahedron(_) => [a / l, b / m, c / n, 0.0],
            Self::Tetrahedron(_) => [a / l, b / l, c / l, d / l],
            Self::Wedge(_) => [a / l, b / l, c / l, d / m],
        }
    }

    /// What an error names a place by: u, v, w; three barycentric coordinates; two and the height.
    pub fn parameters(self, at: Local) -> [f64; 3] {
        match self {
            Self::Hexahedron(_) | Self::Tetrahedron(_) => [at[0], at[1], at[2]],
            Self::Wedge(_) => [at[0], at[1], at[3]],
        }
    }

    /// Local parameters from what [`parameters`](Self::parameters) names a place by.
    pub fn completed(self, [a, b, c]: [f64; 3]) -> Local {
        match self {
            Self::Hexahedron(_) => [a, b, c, 0.0],
            Self::Tetrahedron(_) => [a, b, c, last_barycentric(&[a, b, c])],
            Self::Wedge(_) => [a, b, last_barycentric(&[a, b]), c],
        }
    }

    /// Number of places.
    pub fn places(self, counts: [u32; 3]) -> usize {
        let [l, m, n] = counts.map(|n| n as usize);
        match self {
            Self::Hexahedron(_) => (l + 1) * (m + 1) * (n + 1),
            Self::Tetrahedron(_) => simplex_count::<4>(l),
            Self::Wedge(_) => simplex_count::<3>(l) * (m + 1),
        }
    }

    /// About how many places, for counts of any size.
    pub fn expected_places(self, counts: [u32; 3]) -> f64 {
        let [l, m, n] = counts.map(|n| f64::from(n) + 1.0);
        match self {
            Self::Hexahedron(_) => l * m * n,
            Self::Tetrahedron(_) => l * (l + 1.0) * (l + 2.0) / 6.0,
            Self::Wedge(_) => l * (l + 1.0) / 2.0 * m,
        }
    }

    /// The number of a place.
    pub fn place_index(self, at: [u32; 4], counts: [u32; 3]) -> usize {
        let [_, m, n] = counts.map(|n| n as usize);
        let [a, b, c, d] = at.map(|x| x as usize);
        match self {
            Self::Hexahedron(_) => (a * (m + 1) + b) * (n + 1) + c,
            Self::Tetrahedron(_) => simplex_index([a, b, c, d]),
            Self::Wedge(_) => simplex_index([a, b, c]) * (m + 1) + d,
        }
    }

    /// What a place lies on.
    pub fn carrier(self, at: [u32; 4], counts: [u32; 3]) -> Carrier {
        match self {
            Self::Hexahedron(_) => {
                let inner: [bool; 3] = std::array::from_fn(|a| at[a] != 0 && at[a] != counts[a]);
                let end = |axis: usize| usize::from(at[axis] != 0);
                match inner {
                    [true, true, true] => Carrier::Inside,
                    [false, true, true] => Carrier::Face(end(0)),
                    [true, false, true] => Carrier::Face(2 + end(1)),
                    [true, true, false] => Carrier::Face(4 + end(2)),
                    [true, false, false] => Carrier::Edge(2 * end(1) + end(2), at[0]),
                    [false, true, false] => Carrier::Edge(4 + 2 * end(0) + end(2), at[1]),
                    [false, false, true] => Carrier::Edge(8 + 2 * end(0) + end(1), at[2]),
                    [false, false, false] => Carrier::Corner(4 * end(0) + 2 * end(1) + end(2)),
                }
            }
            Self::Tetrahedron(_) => {
                let zeros = at.iter().filter(|&&x| x == 0).count();
                let first = |zero: bool| at.iter().position(|&x| (x == 0) == zero).unwrap_or(0);
                match zeros {
                    0 => Carrier::Inside,
                    1 => Carrier::Face(first(true)),
                    2 => {
                        let a = first(false);
                        let b = at.iter().rposition(|&x| x != 0).unwrap_or(0);
                        Carrier::Edge(self.edge_between(a, b), at[b])
                    }
                    _ => Carrier::Corner(first(false)),
                }
            }
            Self::Wedge(_) => {
                let triangle = [at[0], at[1], at[2]];
                let zeros = triangle.iter().filter(|&&x| x == 0).count();
                let first = |zero: bool| triangle.iter().position(|&x| (x == 0) == zero).unwrap_or(0);
                let top = usize::from(at[3] != 0);
                match (zeros, at[3] == 0 || at[3] == counts[1]) {
                    (0, false) => Carrier::Inside,
                    (0, true) => Carrier::Face(3 + top),
                    (1, false) => Carrier::Face(first(true)),
                    (1, true) => {
                        let a = first(false);
                        let b = triangle.iter().rposition(|&x| x != 0).unwrap_or(0);
                        Carrier::Edge(self.edge_between(2 * a + top, 2 * b + top), at[b])
                    }
                    (_, false) => Carrier::Edge(6 + first(false), at[3]),
                    (_, true) => Carrier::Corner(2 * first(false) + top),
                }
            }
        }
    }

    fn edge_between(self, a: usize, b: usize) -> usize {
        self.edges().iter().position(|&ends| ends == [a, b]).unwrap_or(0)
    }

    /// A corner of a face.
    pub fn face_corner(self, face: usize) -> usize {
        match self {
            // The bit of the face's axis.
            Self::Hexahedron(_) => (face & 1) << (2 - face / 2),
            Self::Tetrahedron(_) => usize::from(face == 0),
            Self::Wedge(_) if face < 3 => 2 * TRIANGLE_EDGES[face][0],
            Self::Wedge(_) => face - 3,
        }
    }

    /// A place of a patch, moved to its start along a direction of it.
    pub fn slid(self, face: usize, direction: usize, at: [u32; 4]) -> [u32; 4] {
        let mut at = at;
        match self {
            Self::Hexahedron(_) => {
                let axes = [[1, 2], [0, 2], [0, 1]][face / 2];
                at[axes[direction]] = 0;
            }
            Self::Wedge(_) if face < 3 && direction == 0 => {
                let [a, b] = TRIANGLE_EDGES[face];
                at[a] += at[b];
                at[b] = 0;
            }
            Self::Wedge(_) => at[3] = 0,
            Self::Tetrahedron(_) => {}
        }
        at
    }

    /// Calls for every place.
    pub fn each_place<E>(
        self,
        counts: [u32; 3],
        mut call: impl FnMut([u32; 4]) -> Result<(), E>,
    ) -> Result<(), E> {
        let [l, m, n] = counts;
        match self {
            Self::Hexahedron(_) => {
                for a in 0..=l {
                    for b in 0..=m {
                        for c in 0..=n {
                            call([a, b, c, 0])?;
                        }
                    }
                }
            }
            Self::Tetrahedron(_) => {
                for a in 0..=l {
                    for b in 0..=l - a {
                        for c in 0..=l - a - b {
                            call([a, b, c, l - a - b - c])?;
                        }
                    }
                }
            }
            Self::Wedge(_) => {
                for a in 0..=l {
                    for b in 0..=l - a {
                        for d in 0..=m {
                            call([a, b, l - a - b, d])?;
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// Calls for every cell: boxes; the tetrahedra into which [`cube_tetrahedra`] cut a tetrahedron; triangle × step of the height.
    pub fn each_cell<E>(
        self,
        counts: [u32; 3],
        mut call: impl FnMut(LatticeCell) -> Result<(), E>,
    ) -> Result<(), E> {
        let [l, m, n] = counts;
        match self {
            Self::Hexahedron(_) => {
                for a in 0..l {
                    for b in 0..m {
                        for c in 0..n {
                            call(hexahedron([a, b, c]))?;
                        }
                    }
                }
            }
            Self::Tetrahedron(_) => {
                for x in 0..l {
                    for y in 0..=x {
                        for z in 0..=y {
                            for tetrahedron in cube_tetrahedra([x, y, z], l) {
                                call(tetrahedron)?;
                            }
                        }
                    }
                }
            }
            Self::Wedge(_) => {
                for a in 0..l {
                    for b in 0..l - a {
                        for d in 0..m {
                            for wedge in wedges(a, b, l - a - b, d).into_iter().flatten() {
                                call(wedge)?;
                            }
                        }
                    }
                }
            }
        }
        Ok(())
    }
}

/// The box above a place.
pub(crate) fn hexahedron([a, b, c]: [u32; 3]) -> LatticeCell {
    let at = |i: u32, j: u32, k: u32| [a + i, b + j, c + k, 0];
    LatticeCell::Hexahedron([
        at(0, 0, 0),
        at(1, 0, 0),
        at(1, 1, 0),
        at(0, 1, 0),
        at(0, 0, 1),
        at(1, 0, 1),
        at(1, 1, 1),
        at(0, 1, 1),
    ])
}

/// The triangle with its three corners one step up from (a, b, c − 1), times a step of the height; and the one across its edge
/// from the second corner to the first, if that is in the domain.
pub(crate) fn wedges(a: u32, b: u32, c: u32, d: u32) -> [Option<LatticeCell>; 2] {
    let wedge = |corners: [[u32; 3]; 3]| {
        let at = |corner: usize, top: u32| {
            let [a, b, c] = corners[corner];
            [a, b, c, d + top]
        };
        LatticeCell::Wedge([at(0, 0), at(1, 0), at(2, 0), at(0, 1), at(1, 1), at(2, 1)])
    };
    let upright = wedge([[a + 1, b, c - 1], [a, b + 1, c - 1], [a, b, c]]);
    let turned = (c >= 2).then(|| wedge([[a, b + 1, c - 1], [a + 1, b, c - 1], [a + 1, b + 1, c - 2]]));
    [Some(upright), turned]
}

/// The tetrahedra of the cube above (x, y, z) that lie in n ≥ x ≥ y ≥ z ≥ 0, where the barycentric coordinates are
/// (n − x, x − y, y − z, z)/n: all, over all cubes, are n³, and they cut each face into the n² triangles of its lattice.
///
/// Source: Freudenthal, "Simplizialzerlegungen von beschränkter Flachheit" (1942); Edelsbrunner and Grayson, "Edgewise
/// subdivision of a simplex" (2000).
pub(crate) fn cube_tetrahedra(cube: [u32; 3], n: u32) -> impl Iterator<Item = LatticeCell> {
    const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
    ORDERS.into_iter().enumerate().filter_map(move |(number, order)| {
        let mut corners = [cube; 4];
        for step in 0..3 {
            for corner in &mut corners[step + 1..] {
                corner[order[step]] += 1;
            }
        }
        let inside = |[x, y, z]: [u32; 3]| n >= x && x >= y && y >= z;
        if !corners.into_iter().all(inside) {
            return None;
        }
        let [a, b, c, d] = corners.map(|[x, y, z]| [n - x, x - y, y - z, z]);
        // (x, y, z) → (λ₁, λ₂, λ₃) keeps or turns the orientation, and every other order of steps turns it again.
        Some(LatticeCell::Tetrahedron(if number < 3 { [a, c, b, d] } else { [a, b, c, d] }))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;

    /// Cells tile the domain: their volumes in the parameters are positive and add up to the whole.
    #[test]
    fn cells_tile_the_domain() {
        for (degrees, counts, whole) in [
            (Degrees::Hexahedron([1; 3]), [2, 3, 4], 1.0),
            (Degrees::Tetrahedron(1), [4, 4, 4], 1.0 / 6.0),
            (Degrees::Wedge([1, 1]), [4, 3, 1], 0.5),
        ] {
            let mut total = 0.0;
            let mut cells = 0;
            let add = |cell: LatticeCell| {
                let at = |place: [u32; 4]| degrees.parameters(degrees.local(place, counts));
                let p = cell.places();
                let span = |o: usize, a: usize, b: usize, c: usize| {
                    let [o, a, b, c] = [o, a, b, c].map(|i| at(p[i]));
                    let [a, b, c] = [a, b, c].map(|x| [0, 1, 2].map(|k| x[k] - o[k]));
                    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                        + a[2] * (b[0] * c[1] - b[1] * c[0])
                };
                let volume = match cell {
                    LatticeCell::Hexahedron(_) => span(0, 1, 3, 4),
                    LatticeCell::Wedge(_) => 0.5 * span(0, 1, 2, 3),
                    LatticeCell::Tetrahedron(_) => span(0, 1, 2, 3) / 6.0,
                };
                assert!(volume > 0.0, "{cell:?}");
                total += volume;
                cells += 1;
                Ok::<(), ()>(())
            };
            degrees.each_cell(counts, add).unwrap();
            assert!((total - whole).abs() < 1e-14, "{degrees:?} {total} {cells}");
        }
    }

    #[test]
    fn places_are_numbered_once_each() {
        for (degrees, counts) in [
            (Degrees::Hexahedron([1; 3]), [2, 3, 4]),
            (Degrees::Tetrahedron(1), [4, 4, 4]),
            (Degrees::Wedge([1, 1]), [4, 3, 1]),
        ] {
            let mut met: HashMap<usize, usize> = HashMap::new();
            degrees
                .each_place(counts, |at| {
                    *met.entry(degrees.place_index(at, counts)).or_default() += 1;
                    Ok::<(), ()>(())
                })
                .unwrap();
            assert_eq!(met.len(), degrees.places(counts));
            assert!(met.iter().all(|(&place, &times)| place < met.len() && times == 1));
            assert_eq!(degrees.expected_places(counts), met.len() as f64);
        }
    }
}
