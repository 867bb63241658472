//! Bernstein polynomials in three parameters, whatever the domain: values, derivatives, parts, faces, edges.

use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};
use casteljau_shape::bernstein::{
    BernsteinError, BoxNet, Point, TETRAHEDRON_EIGHTHS, TETRAHEDRON_FACES, TRIANGLE_EDGES, TRIANGLE_QUARTERS,
    TetrahedronNet, WedgeNet, elevate_tensor, multi_indices, restrict_tensor, simplex_count, simplex_index,
};
use casteljau_solid::{Axis, HexahedronFace};

use super::Solid;
use super::face_key::FaceNet;

/// Parameters in the domain of a kind: u, v, w on `[0, 1]` and a 0; all four barycentric coordinates; or those of the triangle
/// and the height on `[0, 1]`.
pub(crate) type Local = [f64; 4];

/// The kind of a domain, and the degrees of a polynomial over it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Degrees {
    Hexahedron([usize; 3]),
    Tetrahedron(usize),
    Wedge([usize; 2]),
}

/// A part of a domain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Part {
    Hexahedron([[f64; 2]; 3]),
    Tetrahedron([[f64; 4]; 4]),
    Wedge([[f64; 3]; 3], [f64; 2]),
}

impl Part {
    /// Eight parts of equal volume.
    pub fn split(&self) -> [Self; 8] {
        let halves = |[a, b]: [f64; 2]| {
            let middle = 0.5 * (a + b);
            [[a, middle], [middle, b]]
        };
        match self {
            Self::Hexahedron(intervals) => {
                let [u, v, w] = intervals.map(halves);
                std::array::from_fn(|i| Self::Hexahedron([u[i >> 2], v[i >> 1 & 1], w[i & 1]]))
            }
            Self::Tetrahedron(corners) => {
                TETRAHEDRON_EIGHTHS.map(|part| Self::Tetrahedron(part.map(|at| combined(corners, at))))
            }
            Self::Wedge(corners, height) => {
                let height = halves(*height);
                std::array::from_fn(|i| {
                    let corners = TRIANGLE_QUARTERS[i >> 1].map(|at| combined(corners, at));
                    Self::Wedge(corners, height[i & 1])
                })
            }
        }
    }
}

fn combined<const V: usize>(corners: &[[f64; V]; V], shares: [f64; V]) -> [f64; V] {
    std::array::from_fn(|entry| corners.iter().zip(shares).map(|(corner, share)| corner[entry] * share).sum())
}

impl Degrees {
    /// The whole domain.
    pub fn whole(self) -> Part {
        let unit = [0.0, 1.0];
        match self {
            Self::Hexahedron(_) => Part::Hexahedron([unit; 3]),
            Self::Tetrahedron(_) => Part::Tetrahedron(std::array::from_fn(|a| {
                std::array::from_fn(|b| if a == b { 1.0 } else { 0.0 })
            })),
            Self::Wedge(_) => Part::Wedge(
                std::array::from_fn(|a| std::array::from_fn(|b| if a == b { 1.0 } else { 0.0 })),
                unit,
            ),
        }
    }

    /// Number of control points.
    pub fn count(self) -> usize {
        match self {
            Self::Hexahedron(degrees) => degrees.iter().map(|d| d + 1).product(),
            Self::Tetrahedron(n) => simplex_count::<4>(n),
            Self::Wedge([n, o]) => simplex_count::<3>(n) * (o + 1),
        }
    }

    /// So many times the degrees.
    pub fn times(self, factor: usize) -> Self {
        match self {
            Self::Hexahedron(degrees) => Self::Hexahedron(degrees.map(|d| d * factor)),
            Self::Tetrahedron(n) => Self::Tetrahedron(n * factor),
            Self::Wedge(degrees) => Self::Wedge(degrees.map(|d| d * factor)),
        }
    }

    /// The net of the same polynomial in higher degrees.
    pub fn elevate<P: Point>(self, points: &[P], to: Self) -> Result<Vec<P>, BernsteinError> {
        let mut out = vec![P::ZERO; to.count()];
        match (self, to) {
            (Self::Hexahedron(from), Self::Hexahedron(to)) => elevate_tensor(points, from, to, &mut out)?,
            (Self::Tetrahedron(n), Self::Tetrahedron(to)) => {
                TetrahedronNet::new(points, n)?.elevate(to, &mut out)?;
            }
            (Self::Wedge(from), Self::Wedge(to)) => WedgeNet::new(points, from)?.elevate(to, &mut out)?,
            // Both are of one kind.
            _ => {}
        }
        Ok(out)
    }

    /// The sum of the degrees, which roundings grow with.
    pub fn total(self) -> usize {
        match self {
            Self::Hexahedron([l, m, n]) => l + m + n,
            Self::Tetrahedron(n) => n,
            Self::Wedge([n, o]) => n + o,
        }
    }

    pub fn value<P: Point>(self, points: &[P], at: Local) -> P {
        let [a, b, c, d] = at;
        match self {
            Self::Hexahedron(degrees) => BoxNet::validated(points, degrees).value(a, b, c),
            Self::Tetrahedron(n) => TetrahedronNet::validated(points, n).value(at),
            Self::Wedge(degrees) => WedgeNet::validated(points, degrees).value([a, b, c], d),
        }
    }

    /// Value and first derivatives: by u, v and w; by λ₁, λ₂ and λ₃, λ₄ being eliminated; or by λ₁, λ₂ and the height.
    pub fn partials<P: Point>(self, points: &[P], at: Local) -> [P; 4] {
        let mut out = [P::ZERO; 4];
        let [a, b, c, d] = at;
        match self {
            Self::Hexahedron(degrees) => BoxNet::validated(points, degrees).partials(a, b, c, &mut out),
            Self::Tetrahedron(n) => TetrahedronNet::validated(points, n).partials(at, &mut out),
            Self::Wedge(degrees) => WedgeNet::validated(points, degrees).partials([a, b, c], d, &mut out),
        }
        out
    }

    /// The net over a part.
    pub fn restrict<P: Point>(self, points: &[P], part: &Part) -> Result<Vec<P>, BernsteinError> {
        let mut out = vec![P::ZERO; points.len()];
        match (self, part) {
            (Self::Hexahedron(degrees), Part::Hexahedron(intervals)) => {
                restrict_tensor(points, degrees, *intervals, &mut out)?;
            }
            (Self::Tetrahedron(n), Part::Tetrahedron(corners)) => {
                let mut scratch = vec![P::ZERO; 4 * points.len()];
                TetrahedronNet::new(points, n)?.restrict(*corners, &mut out, &mut scratch)?;
            }
            (Self::Wedge(degrees), Part::Wedge(corners, height)) => {
                let mut scratch = vec![P::ZERO; 5 * simplex_count::<3>(degrees[0])];
                WedgeNet::new(points, degrees)?.restrict(*corners, *height, &mut out, &mut scratch)?;
            }
            // Parts are made of the whole of the same kind.
            _ => out.copy_from_slice(points),
        }
        Ok(out)
    }

    /// The net of the derivative by parameter `by`, as in [`partials`](Self::partials).
    pub fn derivative<P: Point>(self, points: &[P], by: usize) -> (Self, Vec<P>) {
        let zero = || (self, vec![P::ZERO; points.len()]);
        match self {
            Self::Hexahedron(degrees) => {
                if degrees[by] == 0 {
                    return zero();
                }
                let [l, m, n] = degrees;
                let stride = [(m + 1) * (n + 1), n + 1, 1][by];
                let mut lower = degrees;
                lower[by] -= 1;
                let mut out = Vec::with_capacity(Self::Hexahedron(lower).count());
                for i in 0..=lower[0].min(l) {
                    for j in 0..=lower[1] {
                        for k in 0..=lower[2] {
                            let at = (i * (m + 1) + j) * (n + 1) + k;
                            out.push((points[at + stride] - points[at]) * degrees[by] as f64);
                        }
                    }
                }
                (Self::Hexahedron(lower), out)
            }
            Self::Tetrahedron(0) => zero(),
            Self::Tetrahedron(n) => {
                let difference = |index: [usize; 4]| {
                    let (mut up, mut last) = (index, index);
                    up[by] += 1;
                    last[3] += 1;
                    (points[simplex_index(up)] - points[simplex_index(last)]) * n as f64
                };
                (Self::Tetrahedron(n - 1), multi_indices::<4>(n - 1).map(difference).collect())
            }
            Self::Wedge([n, o]) if by == 2 => {
                if o == 0 {
                    return zero();
                }
                let columns = points.chunks(o + 1);
                let out = columns.flat_map(|column| column.windows(2).map(|w| (w[1] - w[0]) * o as f64));
                (Self::Wedge([n, o - 1]), out.collect())
            }
            Self::Wedge([0, _]) => zero(),
            Self::Wedge([n, o]) => {
                let mut out = Vec::with_capacity(Self::Wedge([n - 1, o]).count());
                for index in multi_indices::<3>(n - 1) {
                    let (mut up, mut last) = (index, index);
                    up[by] += 1;
                    last[2] += 1;
                    let [up, last] = [up, last].map(|index| simplex_index(index) * (o + 1));
                    out.extend((0..=o).map(|k| (points[up + k] - points[last + k]) * n as f64));
                }
                (Self::Wedge([n - 1, o]), out)
            }
        }
    }

    /// How many corners.
    pub fn corners(self) -> usize {
        match self {
            Self::Hexahedron(_) => 8,
            Self::Tetrahedron(_) => 4,
            Self::Wedge(_) => 6,
        }
    }

    /// The edges, each from one corner to another: along u, v, then w; of a tetrahedron by its vertices; of a wedge those of the
    /// lower and of the upper triangle, then those of the height. Corners are numbered u v w in binary, and 2·vertex + top.
    pub fn edges(self) -> &'static [[usize; 2]] {
        const HEXAHEDRON: [[usize; 2]; 12] =
            [[0, 4], [1, 5], [2, 6], [3, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 1], [2, 3], [4, 5], [6, 7]];
        const TETRAHEDRON: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
        const WEDGE: [[usize; 2]; 9] =
            [[0, 2], [0, 4], [2, 4], [1, 3], [1, 5], [3, 5], [0, 1], [2, 3], [4, 5]];
        match self {
            Self::Hexahedron(_) => &HEXAHEDRON,
            Self::Tetrahedron(_) => &TETRAHEDRON,
            Self::Wedge(_) => &WEDGE,
        }
    }

    /// Which of up to three counts of the lattice an edge is divided by.
    pub fn group(self, edge: usize) -> usize {
        match self {
            Self::Hexahedron(_) => edge / 4,
            Self::Tetrahedron(_) => 0,
            Self::Wedge(_) => usize::from(edge >= 6),
        }
    }

    /// How many counts the lattice has.
    pub fn groups(self) -> usize {
        match self {
            Self::Hexahedron(_) => 3,
            Self::Tetrahedron(_) => 1,
            Self::Wedge(_) => 2,
        }
    }

    /// The count by which a parameter is divided.
    pub fn group_of(self, parameter: usize) -> usize {
        match self {
            Self::Hexahedron(_) => parameter,
            Self::Tetrahedron(_) => 0,
            Self::Wedge(_) => usize::from(parameter == 2),
        }
    }

    /// The count by which each of three parameters is divided.
    pub fn steps(self, counts: [u32; 3]) -> [u32; 3] {
        match self {
            Self::Hexahedron(_) => counts,
            Self::Tetrahedron(_) => [counts[0]; 3],
            Self::Wedge(_) => [counts[0], counts[0], counts[1]],
        }
    }

    /// The index of a control point at a place of the lattice that has the degrees for counts.
    fn index(self, at: [usize; 4]) -> usize {
        let [a, b, c, d] = at;
        match self {
            Self::Hexahedron([_, m, n]) => (a * (m + 1) + b) * (n + 1) + c,
            Self::Tetrahedron(_) => simplex_index(at),
            Self::Wedge([_, o]) => simplex_index([a, b, c]) * (o + 1) + d,
        }
    }

    /// The place of a corner in the lattice with these counts.
    fn corner(self, corner: usize, counts: [usize; 3]) -> [usize; 4] {
        match self {
            Self::Hexahedron(_) => {
                let bit = |axis: usize| (corner >> (2 - axis) & 1) * counts[axis];
                [bit(0), bit(1), bit(2), 0]
            }
            Self::Tetrahedron(_) => std::array::from_fn(|a| if a == corner { counts[0] } else { 0 }),
            Self::Wedge(_) => {
                let mut at: [usize; 4] = std::array::from_fn(|a| if a == corner / 2 { counts[0] } else { 0 });
                at[3] = (corner & 1) * counts[1];
                at
            }
        }
    }

    /// The index of a corner's control point.
    pub fn corner_index(self, corner: usize) -> usize {
        self.index(self.corner(corner, self.degrees()))
    }

    /// As [`corner`](Self::corner), of a lattice to be divided.
    pub fn corner_place(self, corner: usize, counts: [u32; 3]) -> [u32; 4] {
        self.corner(corner, counts.map(|n| n as usize)).map(|x| x as u32)
    }

    fn degrees(self) -> [usize; 3] {
        match self {
            Self::Hexahedron(degrees) => degrees,
            Self::Tetrahedron(n) => [n, 0, 0],
            Self::Wedge([n, o]) => [n, o, 0],
        }
    }

    /// The control points along an edge.
    pub fn edge_net<P: Copy>(self, points: &[P], edge: usize) -> Vec<P> {
        let degrees = self.degrees();
        let [from, to] = self.edges()[edge].map(|corner| self.corner(corner, degrees));
        let count = degrees[self.group(edge)];
        let at = |i: usize| {
            // From one corner to the other in equal steps of the lattice; of degree 0 there is one point.
            std::array::from_fn(|a| (from[a] * (count - i) + to[a] * i).checked_div(count).unwrap_or(from[a]))
        };
        (0..=count).map(|i| points[self.index(at(i))]).collect()
    }

    /// How many faces.
    pub fn faces(self) -> usize {
        match self {
            Self::Hexahedron(_) => 6,
            Self::Tetrahedron(_) => 4,
            Self::Wedge(_) => 5,
        }
    }

    /// The net of a face.
    pub fn face_net(self, points: &[DVec4], face: usize) -> FaceNet {
        let place = |at: [usize; 3]| points[self.index(self.on_face(face, at, self.degrees()))];
        match self.face_steps(face, self.degrees()) {
            ([m, n], true) => {
                let net = (0..=m).flat_map(|i| (0..=n).map(move |j| [i, j, 0]));
                FaceNet::Patch([m, n], net.map(place).collect())
            }
            ([n, _], false) => FaceNet::Triangle(n, multi_indices::<3>(n).map(place).collect()),
        }
    }

    /// The counts of the lattice on a face, and whether it is a patch.
    pub fn face_steps<N: Copy>(self, face: usize, counts: [N; 3]) -> ([N; 2], bool) {
        match self {
            Self::Hexahedron(_) => {
                let [a, b] = HexahedronFace::ALL[face].axis.others().map(axis_index);
                ([counts[a], counts[b]], true)
            }
            Self::Wedge(_) if face < 3 => ([counts[0], counts[1]], true),
            _ => ([counts[0]; 2], false),
        }
    }

    /// From a place on a face to the place in the solid's lattice.
    fn on_face(self, face: usize, [i, j, k]: [usize; 3], counts: [usize; 3]) -> [usize; 4] {
        let mut at = [0; 4];
        match self {
            Self::Hexahedron(_) => {
                let HexahedronFace { axis, at_end } = HexahedronFace::ALL[face];
                let [a, b] = axis.others().map(axis_index);
                at[axis_index(axis)] = if at_end { counts[axis_index(axis)] } else { 0 };
                (at[a], at[b]) = (i, j);
            }
            Self::Tetrahedron(_) => {
                for (vertex, entry) in TETRAHEDRON_FACES[face].into_iter().zip([i, j, k]) {
                    at[vertex] = entry;
                }
            }
            Self::Wedge(_) if face < 3 => {
                let [a, b] = TRIANGLE_EDGES[face];
                (at[a], at[b], at[3]) = (counts[0] - i, i, j);
            }
            Self::Wedge(_) => at = [i, j, k, if face == 4 { counts[1] } else { 0 }],
        }
        at
    }

    /// From a place in the solid's lattice to that on a face it lies on.
    pub fn to_face(self, face: usize, at: [u32; 4]) -> [u32; 3] {
        match self {
            Self::Hexahedron(_) => {
                let [a, b] = HexahedronFace::ALL[face].axis.others().map(axis_index);
                [at[a], at[b], 0]
            }
            Self::Tetrahedron(_) => TETRAHEDRON_FACES[face].map(|vertex| at[vertex]),
            Self::Wedge(_) if face < 3 => [at[TRIANGLE_EDGES[face][1]], at[3], 0],
            Self::Wedge(_) => [at[0], at[1], at[2]],
        }
    }
}

fn axis_index(axis: Axis) -> usize {
    axis as usize
}

/// A solid's net.
#[derive(Clone, Debug)]
pub(crate) enum Points {
    Polynomial(Vec<DVec3>),
    Rational(Vec<DVec4>),
}

/// A solid as polynomials over its domain.
#[derive(Clone, Debug)]
pub(crate) struct SolidNet {
    pub degrees: Degrees,
    pub points: Points,
}

impl SolidNet {
    pub fn new(solid: Solid<'_>) -> Self {
        let polynomial =
            |degrees, points: &[DVec3]| Self { degrees, points: Points::Polynomial(points.to_vec()) };
        let rational =
            |degrees, points: &[DVec4]| Self { degrees, points: Points::Rational(points.to_vec()) };
        match solid {
            Solid::Hexahedron(s) => polynomial(Degrees::Hexahedron(s.degrees()), s.control_points()),
            Solid::RationalHexahedron(s) => rational(Degrees::Hexahedron(s.degrees()), s.control_points()),
            Solid::Tetrahedron(s) => polynomial(Degrees::Tetrahedron(s.degree()), s.control_points()),
            Solid::RationalTetrahedron(s) => rational(Degrees::Tetrahedron(s.degree()), s.control_points()),
            Solid::Wedge(s) => polynomial(Degrees::Wedge(s.degrees()), s.control_points()),
            Solid::RationalWedge(s) => rational(Degrees::Wedge(s.degrees()), s.control_points()),
        }
    }

    /// The homogeneous control points.
    pub fn homogeneous(&self) -> Vec<DVec4> {
        match &self.points {
            Points::Polynomial(points) => points.iter().map(|p| p.extend(1.0)).collect(),
            Points::Rational(points) => points.clone(),
        }
    }

    /// Point and derivatives by the parameters of [`Degrees::partials`], by the quotient rule; not finite at a pole.
    pub fn jet(&self, at: Local) -> [DVec3; 4] {
        match &self.points {
            Points::Polynomial(points) => self.degrees.partials(points, at),
            Points::Rational(points) => {
                let [p, a, b, c] = self.degrees.partials(points, at);
                let point = p.xyz() / p.w;
                let by = |d: DVec4| (d.xyz() - point * d.w) / p.w;
                [point, by(a), by(b), by(c)]
            }
        }
    }

    /// A point; not finite at a pole, which is refused before.
    pub fn point(&self, at: Local) -> DVec3 {
        match &self.points {
            Points::Polynomial(points) => self.degrees.value(points, at),
            Points::Rational(points) => {
                let p = self.degrees.value(points, at);
                p.xyz() / p.w
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_and_edges_lie_where_the_lattice_says() {
        let all = [Degrees::Hexahedron([1, 2, 3]), Degrees::Tetrahedron(3), Degrees::Wedge([2, 3])];
        for degrees in all {
            let points: Vec<DVec4> =
                (0..degrees.count()).map(|i| DVec4::new(i as f64, 0.0, 0.0, 1.0)).collect();
            for face in 0..degrees.faces() {
                let net = degrees.face_net(&points, face);
                // Every point of the net, taken back from the solid's lattice to the face.
                let counts = degrees.degrees();
                let (steps, patch) = degrees.face_steps(face, counts);
                let places: Vec<[usize; 3]> = if patch {
                    (0..=steps[0]).flat_map(|i| (0..=steps[1]).map(move |j| [i, j, 0])).collect()
                } else {
                    multi_indices::<3>(steps[0]).collect()
                };
                for (place, point) in places.into_iter().zip(net.points()) {
                    let at = degrees.on_face(face, place, counts);
                    assert_eq!(points[degrees.index(at)], *point);
                    assert_eq!(degrees.to_face(face, at.map(|x| x as u32)), place.map(|x| x as u32));
                }
            }
            for (edge, ends) in degrees.edges().iter().enumerate() {
                let net = degrees.edge_net(&points, edge);
                let [from, to] = ends.map(|c| points[degrees.index(degrees.corner(c, degrees.degrees()))]);
                assert_eq!((net[0], net[net.len() - 1]), (from, to));
                assert_eq!(net.len(), degrees.degrees()[degrees.group(edge)] + 1);
            }
        }
    }

    #[test]
    fn derivative_nets_and_parts_agree_with_the_kernels() {
        let parts = |degrees: Degrees| degrees.whole().split()[5];
        for degrees in [Degrees::Hexahedron([1, 2, 3]), Degrees::Tetrahedron(3), Degrees::Wedge([2, 3])] {
            let points: Vec<f64> = (0..degrees.count()).map(|i| ((i * i * 7) % 11) as f64).collect();
            let (at, local) = match degrees {
                Degrees::Hexahedron(_) => ([0.75, 0.125, 0.625, 0.0], [0.5, 0.25, 0.25, 0.0]),
                Degrees::Tetrahedron(_) => {
                    let Part::Tetrahedron(corners) = parts(degrees) else { panic!() };
                    (combined(&corners, [0.25, 0.25, 0.25, 0.25]), [0.25; 4])
                }
                Degrees::Wedge(_) => {
                    let Part::Wedge(corners, [a, b]) = parts(degrees) else { panic!() };
                    let [x, y, z] = combined(&corners, [0.5, 0.25, 0.25]);
                    ([x, y, z, 0.5 * (a + b)], [0.5, 0.25, 0.25, 0.5])
                }
            };
            let at = match parts(degrees) {
                Part::Hexahedron(intervals) => {
                    let [u, v, w] = [0, 1, 2].map(|a| {
                        let [low, high] = intervals[a];
                        low + (high - low) * local[a]
                    });
                    [u, v, w, 0.0]
                }
                _ => at,
            };
            let part = degrees.restrict(&points, &parts(degrees)).unwrap();
            // A dozen roundings of values below 11.
            assert!((degrees.value(&part, local) - degrees.value(&points, at)).abs() < 1e-13);
            let partials = degrees.partials(&points, at);
            for by in 0..3 {
                let (lower, net) = degrees.derivative(&points, by);
                assert!((lower.value(&net, at) - partials[by + 1]).abs() < 1e-12, "{degrees:?} {by}");
            }
        }
    }
}
