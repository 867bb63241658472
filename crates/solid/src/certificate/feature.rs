//! The corners, edges and faces of the domain of a solid, and on which of them a polynomial vanishes.

use std::fmt;

use super::net::SolidDegrees;

/// A corner, an edge or a face of the domain of a solid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Feature {
    /// The corner (u, v, w) of a hexahedron; each is 0 or 1.
    Corner([u8; 3]),
    /// The edge of a hexahedron along parameter `axis` (0 for u), the other two being 0 or 1.
    Edge {
        /// The parameter that is free.
        axis: u8,
        /// The values of the other two, in order.
        at: [u8; 2],
    },
    /// The face of a hexahedron where parameter `axis` is 0 or 1.
    Face {
        /// The parameter that is fixed.
        axis: u8,
        /// Its value.
        at: u8,
    },
    /// A vertex of a tetrahedron, from 0: there its barycentric coordinate is 1.
    Vertex(u8),
    /// The edge of a tetrahedron between two vertices.
    SimplexEdge([u8; 2]),
    /// The face of a tetrahedron opposite a vertex.
    SimplexFace {
        /// The vertex, whose barycentric coordinate is 0 on the face.
        opposite: u8,
    },
    /// A vertex of the lower (w = 0) or upper (w = 1) triangle of a wedge.
    WedgeVertex {
        /// Vertex of the triangle, from 0.
        vertex: u8,
        /// The value of w.
        w: u8,
    },
    /// An edge of the lower or upper triangle of a wedge.
    WedgeEdge {
        /// Vertices of the triangle.
        vertices: [u8; 2],
        /// The value of w.
        w: u8,
    },
    /// The edge of a wedge along the height at a vertex of the triangle.
    WedgeRib {
        /// Vertex of the triangle.
        vertex: u8,
    },
    /// The lower or upper triangle of a wedge.
    WedgeTriangle {
        /// The value of w.
        w: u8,
    },
    /// The four-sided face of a wedge opposite a vertex of the triangle.
    WedgeSide {
        /// The vertex, whose barycentric coordinate is 0 on the face.
        opposite: u8,
    },
}

impl fmt::Display for Feature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = |axis: u8| ['u', 'v', 'w'].get(usize::from(axis)).copied().unwrap_or('?');
        match *self {
            Self::Corner([u, v, w]) => write!(f, "corner ({u}, {v}, {w})"),
            Self::Edge { axis, at: [a, b] } => {
                let (first, second) = (u8::from(axis == 0), if axis == 2 { 1 } else { 2 });
                write!(f, "edge {} = {a}, {} = {b}", name(first), name(second))
            }
            Self::Face { axis, at } => write!(f, "face {} = {at}", name(axis)),
            Self::Vertex(vertex) => write!(f, "vertex {vertex}"),
            Self::SimplexEdge([a, b]) => write!(f, "edge {a}–{b}"),
            Self::SimplexFace { opposite } | Self::WedgeSide { opposite } => {
                write!(f, "face opposite vertex {opposite}")
            }
            Self::WedgeVertex { vertex, w } => write!(f, "vertex {vertex}, w = {w}"),
            Self::WedgeEdge { vertices: [a, b], w } => write!(f, "edge {a}–{b}, w = {w}"),
            Self::WedgeRib { vertex } => write!(f, "edge along w at vertex {vertex}"),
            Self::WedgeTriangle { w } => write!(f, "face w = {w}"),
        }
    }
}

/// The faces of every dimension on which a polynomial vanishes, named by the largest of them.
///
/// `present` has bit s set where a coefficient with support s is not zero. On a face the polynomial has the coefficients
/// whose supports lie in that of the face for its own, so it vanishes there exactly when none of them is present.
pub(super) fn vanishing(degrees: SolidDegrees, present: u64) -> Vec<Feature> {
    let vanishes = |face: u8| (0..64).all(|s| present >> s & 1 == 0 || s & !face != 0);
    let all = faces(degrees);
    let zero: Vec<(u8, Feature)> = all.into_iter().filter(|&(bits, _)| vanishes(bits)).collect();
    let inside_another = |bits: u8| zero.iter().any(|&(other, _)| other != bits && bits & !other == 0);
    zero.iter().filter(|&&(bits, _)| !inside_another(bits)).map(|&(_, feature)| feature).collect()
}

/// All proper faces with their bits: faces, then edges, then corners.
fn faces(degrees: SolidDegrees) -> Vec<(u8, Feature)> {
    let mut all = Vec::with_capacity(26);
    match degrees {
        SolidDegrees::Hexahedron(_) => {
            for (axis, at) in pairs(3, 2) {
                let rest = 0b11_1111 & !(0b11 << (2 * axis));
                all.push((rest | 1 << (2 * axis + at), Feature::Face { axis, at }));
            }
            for axis in [2, 1, 0] {
                let (first, second) = (u8::from(axis == 0), if axis == 2 { 1 } else { 2 });
                for (a, b) in pairs(2, 2) {
                    let bits = 0b11 << (2 * axis) | 1 << (2 * first + a) | 1 << (2 * second + b);
                    all.push((bits, Feature::Edge { axis, at: [a, b] }));
                }
            }
            for corner in 0..8_u8 {
                let at = [corner >> 2, corner >> 1 & 1, corner & 1];
                all.push((1 << at[0] | 1 << (2 + at[1]) | 1 << (4 + at[2]), Feature::Corner(at)));
            }
        }
        SolidDegrees::Tetrahedron(_) => {
            all.extend((0..4).map(|opposite| (0b1111 & !(1 << opposite), Feature::SimplexFace { opposite })));
            let edges = pairs(4, 4).filter(|(a, b)| a < b);
            all.extend(edges.map(|(a, b)| (1 << a | 1 << b, Feature::SimplexEdge([a, b]))));
            all.extend((0..4).map(|vertex| (1 << vertex, Feature::Vertex(vertex))));
        }
        SolidDegrees::Wedge(_) => {
            all.extend((0..2).map(|w| (0b111 | 8 << w, Feature::WedgeTriangle { w })));
            let sides = (0..3).map(|opposite| (0b1_1111 & !(1 << opposite), Feature::WedgeSide { opposite }));
            all.extend(sides);
            all.extend((0..3).map(|vertex| (0b1_1000 | 1 << vertex, Feature::WedgeRib { vertex })));
            for w in 0..2 {
                for (a, b) in pairs(3, 3).filter(|(a, b)| a < b) {
                    all.push((1 << a | 1 << b | 8 << w, Feature::WedgeEdge { vertices: [a, b], w }));
                }
            }
            all.extend(
                pairs(2, 3).map(|(w, vertex)| (1 << vertex | 8 << w, Feature::WedgeVertex { vertex, w })),
            );
        }
    }
    all
}

fn pairs(m: u8, n: u8) -> impl Iterator<Item = (u8, u8)> {
    (0..m).flat_map(move |a| (0..n).map(move |b| (a, b)))
}
