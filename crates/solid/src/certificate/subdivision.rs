//! A polynomial over a part of the domain of a solid, and the part cut into two.

use casteljau_bernstein::glam::DVec2;
use casteljau_bernstein::{TetrahedronNet, WedgeNet, subdivide_along};

use super::net::SolidDegrees;
use crate::SolidError;

/// Where a part lies, by the parameters of its ends and vertices.
#[derive(Debug, Clone, Copy)]
pub(super) enum Place {
    Hexahedron([[f64; 2]; 3]),
    Tetrahedron([[f64; 4]; 4]),
    Wedge([[f64; 3]; 3], [f64; 2]),
}

impl Place {
    /// The whole domain.
    pub fn whole(degrees: SolidDegrees) -> Self {
        match degrees {
            SolidDegrees::Hexahedron(_) => Self::Hexahedron([[0.0, 1.0]; 3]),
            SolidDegrees::Tetrahedron(_) => Self::Tetrahedron(identity()),
            SolidDegrees::Wedge(_) => Self::Wedge(identity(), [0.0, 1.0]),
        }
    }

    /// The parameters in the middle.
    pub fn center(&self) -> [f64; 3] {
        let middle = |[a, b]: [f64; 2]| 0.5 * (a + b);
        match self {
            Self::Hexahedron(ends) => ends.map(middle),
            Self::Tetrahedron(v) => std::array::from_fn(|a| 0.25 * (v[0][a] + v[1][a] + v[2][a] + v[3][a])),
            Self::Wedge(v, ends) => {
                let mean = |a: usize| (v[0][a] + v[1][a] + v[2][a]) / 3.0;
                [mean(0), mean(1), middle(*ends)]
            }
        }
    }

    /// The parameters of the corners, each with the indices of the coefficient that is the value there.
    pub fn corners(&self, degrees: SolidDegrees) -> Vec<([usize; 3], [f64; 3])> {
        let [l, m, n] = degrees.along();
        match self {
            Self::Hexahedron([u, v, w]) => (0..8)
                .map(|c| {
                    let [i, j, k] = [c >> 2, c >> 1 & 1, c & 1];
                    ([i * l, j * m, k * n], [u[i], v[j], w[k]])
                })
                .collect(),
            Self::Tetrahedron(vertices) => (0..4)
                .map(|c| {
                    let [x, y, z, _] = vertices[c];
                    (std::array::from_fn(|a| if a == c { l } else { 0 }), [x, y, z])
                })
                .collect(),
            Self::Wedge(vertices, ends) => (0..6)
                .map(|c| {
                    let (vertex, end) = (c / 2, c % 2);
                    let [x, y, _] = vertices[vertex];
                    let index = |a: usize| if a == vertex { l } else { 0 };
                    ([index(0), index(1), end * n], [x, y, ends[end]])
                })
                .collect(),
        }
    }
}

fn identity<const V: usize>() -> [[f64; V]; V] {
    std::array::from_fn(|row| std::array::from_fn(|column| if row == column { 1.0 } else { 0.0 }))
}

/// A polynomial over a part: its coefficients, each with the scale of its error.
#[derive(Debug, Clone)]
pub(super) struct Cell {
    pub place: Place,
    /// (value, scale).
    pub coefficients: Vec<DVec2>,
    /// How often the whole was cut.
    pub cuts: u32,
}

/// A way of cutting: across an interval, or at the middle of an edge between two vertices.
#[derive(Debug, Clone, Copy)]
enum Cut {
    Axis(usize),
    Edge([usize; 2]),
}

impl Cell {
    /// The two halves along the axis or edge that bends the coefficients most.
    ///
    /// The coefficients come to the values at their places as the square of the width, in proportion to the second
    /// differences along an edge, so the largest of these are where a cut helps most. Every step of de Casteljau's
    /// algorithm rounds once.
    pub fn halves(&self, degrees: SolidDegrees) -> Result<[Self; 2], SolidError> {
        let cut = self.most_useful(degrees);
        let mut near = Self { cuts: self.cuts + 1, ..self.clone() };
        let mut far = near.clone();
        let (points, below, above) = (&self.coefficients, &mut near.coefficients, &mut far.coefficients);
        match (degrees, cut) {
            (SolidDegrees::Hexahedron(d), Cut::Axis(axis)) => {
                subdivide_along(points, d, axis, 0.5, below, above)?;
            }
            (SolidDegrees::Tetrahedron(n), Cut::Edge(edge)) => {
                TetrahedronNet::validated(points, n).split_edge(edge, 0.5, below, above)?;
            }
            (SolidDegrees::Wedge(d), Cut::Edge(edge)) => {
                WedgeNet::validated(points, d).split_edge(edge, 0.5, below, above)?;
            }
            (SolidDegrees::Wedge(d), _) => WedgeNet::validated(points, d).split_height(0.5, below, above)?,
            _ => {}
        }
        match (&mut near.place, &mut far.place, cut) {
            (Place::Hexahedron(near), Place::Hexahedron(far), Cut::Axis(axis)) => {
                halve(&mut near[axis], &mut far[axis]);
            }
            (Place::Tetrahedron(near), Place::Tetrahedron(far), Cut::Edge(edge)) => bisect(near, far, edge),
            (Place::Wedge(near, _), Place::Wedge(far, _), Cut::Edge(edge)) => bisect(near, far, edge),
            (Place::Wedge(_, near), Place::Wedge(_, far), _) => halve(near, far),
            _ => {}
        }
        Ok([near, far])
    }

    fn most_useful(&self, degrees: SolidDegrees) -> Cut {
        let cuts = match self.place {
            Place::Hexahedron(ends) => (0..3).map(|axis| (Cut::Axis(axis), width(ends[axis]))).collect(),
            Place::Tetrahedron(vertices) => edges(&vertices),
            Place::Wedge(vertices, ends) => {
                let mut cuts = edges(&vertices);
                cuts.push((Cut::Axis(2), width(ends)));
                cuts
            }
        };
        let mut best = (Cut::Axis(0), [-1.0; 2]);
        for (cut, length) in cuts {
            let merit = [self.bending(degrees, cut), length];
            if merit[0] > best.1[0] || (merit[0] == best.1[0] && merit[1] > best.1[1]) {
                best = (cut, merit);
            }
        }
        best.0
    }

    /// The largest second difference along a direction, times what the degree makes of it.
    fn bending(&self, degrees: SolidDegrees, cut: Cut) -> f64 {
        let n = match cut {
            Cut::Axis(axis) => degrees.along()[axis],
            Cut::Edge(_) => degrees.along()[0],
        };
        if n < 2 {
            return 0.0;
        }
        let mut most = 0.0_f64;
        let mut see = |a: [usize; 3], b: [usize; 3], c: [usize; 3]| {
            let [a, b, c] = [a, b, c].map(|index| self.coefficients[degrees.place(index)].x);
            most = most.max((a - 2.0 * b + c).abs());
        };
        for index in degrees.indices() {
            match cut {
                Cut::Axis(axis) => {
                    if index[axis] + 2 <= n {
                        see(index, raised(index, axis, 1), raised(index, axis, 2));
                    }
                }
                Cut::Edge([a, b]) => {
                    // From two steps of a to two of b; the last vertex has no index of its own.
                    let own = |vertex: usize| match degrees {
                        SolidDegrees::Tetrahedron(_) => vertex < 3,
                        _ => vertex < 2,
                    };
                    if index[a] < 2 {
                        continue;
                    }
                    let step = |k: usize| {
                        let mut moved = index;
                        moved[a] -= k;
                        if own(b) {
                            moved[b] += k;
                        }
                        moved
                    };
                    see(index, step(1), step(2));
                }
            }
        }
        most * n as f64
    }
}

fn raised(mut index: [usize; 3], axis: usize, by: usize) -> [usize; 3] {
    index[axis] += by;
    index
}

fn width([a, b]: [f64; 2]) -> f64 {
    b - a
}

fn halve(near: &mut [f64; 2], far: &mut [f64; 2]) {
    let middle = 0.5 * (near[0] + near[1]);
    (near[1], far[0]) = (middle, middle);
}

/// The midpoint of the edge takes the place of b in the part near a, that of a in the other.
fn bisect<const V: usize>(near: &mut [[f64; V]; V], far: &mut [[f64; V]; V], [a, b]: [usize; 2]) {
    let middle: [f64; V] = std::array::from_fn(|k| 0.5 * (near[a][k] + near[b][k]));
    (near[b], far[a]) = (middle, middle);
}

/// All edges between vertices with their lengths in barycentric coordinates.
fn edges<const V: usize>(vertices: &[[f64; V]; V]) -> Vec<(Cut, f64)> {
    let mut all = Vec::with_capacity(7);
    for a in 0..V {
        for b in a + 1..V {
            let squares = (0..V).map(|k| (vertices[a][k] - vertices[b][k]).powi(2));
            all.push((Cut::Edge([a, b]), squares.sum::<f64>().sqrt()));
        }
    }
    all
}
