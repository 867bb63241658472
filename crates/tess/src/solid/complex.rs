//! What the solids of a model share: corners, edges, faces; and the lattices that follow from it.

use std::collections::HashMap;

use casteljau_geom::glam::{DVec3, Vec4Swizzles};
use casteljau_shape::bernstein::{TensorNet, TriangleNet};

use super::Solid;
use super::face_key::{FaceKey, FaceNet, Turn};
use super::net::{Degrees, SolidNet};
use super::skin::{collapsed_along, is_point};
use crate::TessError;
use crate::side_curve::SideCurve;
use crate::side_key::SideKey;

/// An edge of a solid: a point, or a curve that it may share.
#[derive(Clone, Copy, Debug)]
enum EdgeUse {
    Point,
    Curve { class: usize, reversed: bool },
}

/// A face of a solid: a point, constant along one of its directions, or a surface that it may share.
#[derive(Clone, Copy, Debug)]
enum FaceUse {
    Point,
    Along(usize),
    Surface { class: usize, turn: Turn },
}

/// One solid among the others.
struct Member {
    net: SolidNet,
    inverted: bool,
    /// Numbers of the corners, edges and faces of all solids from which its own count.
    first_corner: usize,
    edges: Vec<EdgeUse>,
    faces: Vec<FaceUse>,
    /// Which count each group of its edges is divided by.
    groups: [usize; 3],
}

/// A curve that edges lie on.
struct Curve {
    curve: SideCurve,
    symmetric: bool,
}

/// Where a vertex of the lattices is, the same for all solids that have it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Place {
    /// A corner, by its number.
    Corner(u32),
    /// So many steps along an edge.
    Edge(u32, u32),
    /// A place of the lattice on a face.
    Face(u32, [u32; 3]),
    /// A place of the lattice in a solid.
    Inside(u32, [u32; 4]),
}

impl Place {
    /// 0 for a corner, 3 for the inside.
    pub fn dimension(self) -> usize {
        match self {
            Self::Corner(_) => 0,
            Self::Edge(..) => 1,
            Self::Face(..) => 2,
            Self::Inside(..) => 3,
        }
    }
}

/// The corners, edges and faces of all solids, those that are the same counted once.
///
/// Edges and faces are the same where their nets are, to the bit, whichever way they are stored. An edge that is a point makes one
/// corner of its ends; a face that is a point is that corner; a face that is a curve is that edge.
pub(crate) struct Complex {
    members: Vec<Member>,
    curves: Vec<Curve>,
    faces: Vec<FaceNet>,
    corners: Vec<DVec3>,
    /// The corner that each corner of each solid is.
    corner_of: Vec<usize>,
    /// How many counts there are to choose.
    pub counts: usize,
}

impl Complex {
    pub fn new(solids: &[Solid<'_>]) -> Result<Self, TessError> {
        let mut complex = Self {
            members: Vec::new(),
            curves: Vec::new(),
            faces: Vec::new(),
            corners: Vec::new(),
            corner_of: Vec::new(),
            counts: 0,
        };
        let mut curve_of: HashMap<Vec<u64>, (usize, [usize; 2])> = HashMap::new();
        let mut face_of: HashMap<Vec<u64>, usize> = HashMap::new();
        // Edges that must be divided alike, by numbers of a group or a curve.
        let mut alike: Vec<usize> = Vec::new();
        let mut joined: Vec<usize> = Vec::new();
        let mut count_of_curve: Vec<usize> = Vec::new();
        for (index, &solid) in solids.iter().enumerate() {
            let inverted = solid.is_inverted(index)?;
            let net = SolidNet::new(solid);
            let (degrees, points) = (net.degrees, net.homogeneous());
            let first_corner = joined.len();
            joined.extend(first_corner..first_corner + degrees.corners());
            let groups = [0, 1, 2].map(|group| alike.len() + group.min(degrees.groups() - 1));
            alike.extend(alike.len()..alike.len() + degrees.groups());
            let mut edges = Vec::new();
            for (edge, ends) in degrees.edges().iter().enumerate() {
                let key = SideKey::new(&degrees.edge_net(&points, edge));
                let [start, end] = ends.map(|corner| first_corner + corner);
                if key.collapsed {
                    join(&mut joined, start, end);
                    edges.push(EdgeUse::Point);
                    continue;
                }
                let ends = if key.reversed { [end, start] } else { [start, end] };
                let fresh = complex.curves.len();
                let &mut (class, known) = curve_of.entry(key.bits()).or_insert((fresh, ends));
                if class == fresh {
                    let curve = SideCurve::new(&key)
                        .map_err(|source| TessError::Solid { solid: index, source: source.into() })?;
                    complex.curves.push(Curve { curve, symmetric: key.symmetric });
                    count_of_curve.push(groups[degrees.group(edge)]);
                }
                join(&mut alike, count_of_curve[class], groups[degrees.group(edge)]);
                (0..2).for_each(|i| join(&mut joined, known[i], ends[i]));
                if key.symmetric {
                    join(&mut joined, ends[0], ends[1]);
                }
                edges.push(EdgeUse::Curve { class, reversed: key.reversed });
            }
            let mut faces = Vec::new();
            for face in 0..degrees.faces() {
                let face = degrees.face_net(&points, face);
                faces.push(if is_point(face.points()) {
                    FaceUse::Point
                } else if let Some(direction) = collapsed_along(&face) {
                    FaceUse::Along(direction)
                } else {
                    let key = FaceKey::new(&face);
                    let class = *face_of.entry(key.bits()).or_insert(complex.faces.len());
                    if class == complex.faces.len() {
                        complex.faces.push(key.net);
                    }
                    FaceUse::Surface { class, turn: key.turn }
                });
            }
            complex.members.push(Member { net, inverted, first_corner, edges, faces, groups });
        }
        complex.number(&mut joined, &mut alike)?;
        Ok(complex)
    }

    /// Numbers the corners and the counts that are left.
    fn number(&mut self, joined: &mut [usize], alike: &mut [usize]) -> Result<(), TessError> {
        let mut corner_of = vec![usize::MAX; joined.len()];
        let mut count_of = vec![usize::MAX; alike.len()];
        for (index, member) in self.members.iter_mut().enumerate() {
            let (degrees, points) = (member.net.degrees, member.net.homogeneous());
            for corner in 0..degrees.corners() {
                let number = member.first_corner + corner;
                let root = root(joined, number);
                if corner_of[root] == usize::MAX {
                    corner_of[root] = self.corners.len();
                    let point = points[degrees.corner_index(corner)];
                    let point = point.xyz() / point.w + DVec3::ZERO;
                    if !point.is_finite() {
                        let at =
                            degrees.parameters(degrees.local(degrees.corner_place(corner, [1; 3]), [1; 3]));
                        return Err(TessError::SolidPole { solid: index, at });
                    }
                    self.corners.push(point);
                }
                corner_of[number] = corner_of[root];
            }
            for group in &mut member.groups {
                let root = root(alike, *group);
                if count_of[root] == usize::MAX {
                    count_of[root] = self.counts;
                    self.counts += 1;
                }
                *group = count_of[root];
            }
        }
        self.corner_of = corner_of;
        Ok(())
    }

    /// How many solids.
    pub fn len(&self) -> usize {
        self.members.len()
    }

    /// The largest absolute coordinate of a control point; those at infinity are left out.
    pub fn largest(&self) -> f64 {
        let size = |p: casteljau_geom::glam::DVec4| (p.xyz() / p.w).abs().max_element();
        let all = self.members.iter().flat_map(|member| member.net.homogeneous());
        all.map(size).filter(|size| size.is_finite()).fold(0.0, f64::max)
    }

    pub fn net(&self, solid: usize) -> &SolidNet {
        &self.members[solid].net
    }

    pub fn degrees(&self, solid: usize) -> Degrees {
        self.members[solid].net.degrees
    }

    pub fn is_inverted(&self, solid: usize) -> bool {
        self.members[solid].inverted
    }

    /// Which of the counts to choose a solid's lattice has.
    pub fn groups(&self, solid: usize) -> [usize; 3] {
        self.members[solid].groups
    }

    /// The counts of a solid's lattice.
    pub fn counts_of(&self, solid: usize, chosen: &[u32]) -> [u32; 3] {
        self.members[solid].groups.map(|group| chosen[group])
    }

    /// The same, with 1 for those that a solid of its kind does not have.
    pub fn shown_counts(&self, solid: usize, chosen: &[u32]) -> [u32; 3] {
        let (counts, groups) = (self.counts_of(solid, chosen), self.degrees(solid).groups());
        std::array::from_fn(|group| if group < groups { counts[group] } else { 1 })
    }

    /// Where a place of a solid's lattice is.
    pub fn place(&self, solid: usize, at: [u32; 4], counts: [u32; 3]) -> Place {
        let member = &self.members[solid];
        let degrees = member.net.degrees;
        let mut at = at;
        // A face that is a curve sends its places to an edge, once.
        for _ in 0..3 {
            match degrees.carrier(at, counts) {
                Carrier::Inside => return Place::Inside(solid as u32, at),
                Carrier::Corner(corner) => return self.corner(member, corner),
                Carrier::Edge(edge, step) => {
                    let EdgeUse::Curve { class, reversed } = member.edges[edge] else {
                        return self.corner(member, degrees.edges()[edge][0]);
                    };
                    let count = counts[degrees.group(edge)];
                    let step = if reversed { count - step } else { step };
                    let step = if self.curves[class].symmetric { step.min(count - step) } else { step };
                    return Place::Edge(class as u32, step);
                }
                Carrier::Face(face) => match member.faces[face] {
                    FaceUse::Point => return self.corner(member, degrees.face_corner(face)),
                    FaceUse::Along(direction) => at = degrees.slid(face, direction, at),
                    FaceUse::Surface { class, turn } => {
                        let (steps, _) = degrees.face_steps(face, counts);
                        return Place::Face(class as u32, turn.place(degrees.to_face(face, at), steps));
                    }
                },
            }
        }
        Place::Inside(solid as u32, at)
    }

    fn corner(&self, member: &Member, corner: usize) -> Place {
        Place::Corner(self.corner_of[member.first_corner + corner] as u32)
    }

    /// The point at a place that a solid has at `at` of its lattice: of edges and faces by their canonical nets, so that it does not
    /// depend on the solid.
    pub fn point(
        &self,
        place: Place,
        solid: usize,
        at: [u32; 4],
        counts: [u32; 3],
    ) -> Result<DVec3, TessError> {
        let member = &self.members[solid];
        let degrees = member.net.degrees;
        let point = match place {
            Place::Corner(corner) => self.corners[corner as usize],
            Place::Edge(class, step) => {
                let count = match degrees.carrier(at, counts) {
                    Carrier::Edge(edge, _) => counts[degrees.group(edge)],
                    // A place of a face that is this edge.
                    _ => counts[degrees.group(self.edge_of(member, class))],
                };
                let t = f64::from(step) / f64::from(count);
                self.curves[class as usize]
                    .curve
                    .point(t)
                    .map_err(|source| TessError::Solid { solid, source: source.into() })?
            }
            Place::Face(class, at_face) => {
                let steps = match degrees.carrier(at, counts) {
                    Carrier::Face(face) => match member.faces[face] {
                        FaceUse::Surface { turn, .. } => turn.steps(degrees.face_steps(face, counts).0),
                        _ => [1; 2],
                    },
                    _ => [1; 2],
                };
                let [m, n] = steps.map(f64::from);
                let [i, j, k] = at_face.map(f64::from);
                let point = match &self.faces[class as usize] {
                    FaceNet::Patch(degrees, points) => {
                        TensorNet::validated(points, *degrees).value(i / m, j / n)
                    }
                    FaceNet::Triangle(degree, points) => {
                        TriangleNet::validated(points, *degree).value([i / m, j / m, k / m])
                    }
                };
                point.xyz() / point.w
            }
            Place::Inside(..) => member.net.point(degrees.local(at, counts)),
        };
        let point = point + DVec3::ZERO;
        if point.is_finite() {
            return Ok(point);
        }
        Err(TessError::SolidPole { solid, at: degrees.parameters(degrees.local(at, counts)) })
    }

    fn edge_of(&self, member: &Member, class: u32) -> usize {
        let is = |edge: &EdgeUse| matches!(edge, EdgeUse::Curve { class: own, .. } if *own == class as usize);
        member.edges.iter().position(is).unwrap_or(0)
    }
}

/// What a place of a solid's lattice lies on.
pub(crate) enum Carrier {
    Corner(usize),
    /// An edge, and so many steps from its start.
    Edge(usize, u32),
    Face(usize),
    Inside,
}

impl Carrier {
    /// 0 for a corner, 3 for the inside.
    pub fn dimension(&self) -> usize {
        match self {
            Self::Corner(_) => 0,
            Self::Edge(..) => 1,
            Self::Face(_) => 2,
            Self::Inside => 3,
        }
    }
}

fn root(parent: &mut [usize], mut x: usize) -> usize {
    while parent[x] != x {
        parent[x] = parent[parent[x]];
        x = parent[x];
    }
    x
}

/// The lesser number stays the root, so that the outcome does not depend on the order.
fn join(parent: &mut [usize], a: usize, b: usize) {
    let (a, b) = (root(parent, a), root(parent, b));
    parent[a.max(b)] = a.min(b);
}
