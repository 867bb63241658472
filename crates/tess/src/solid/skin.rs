//! The surface of solids: their faces, outside out, without those between neighbours.

use std::collections::HashMap;
use std::ops::ControlFlow;

use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};
use casteljau_mesh::{MeshSink, TriangleMesh};
use casteljau_shape::{
    BezierPatch, BezierTriangle, Patch, RationalPatch, RationalTriangle, ShapeError, Triangle,
};
use casteljau_solid::{BezierHexahedron, BezierTetrahedron, BezierWedge, HexahedronFace, SolidError};

use super::face_key::{FaceKey, FaceNet};
use super::{AsSolid, FaceId, Solid};
use crate::charted::{Lift, is_collapsed};
use crate::side_key::SideKey;
use crate::{AsFace, Face, Report, TessError, TessellationOptions, tessellate_into};

/// What becomes of a face that two solids share to the bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum SharedFaces {
    /// It is left out: the surface is that of the solids together.
    #[default]
    Dropped,
    /// Both solids keep it, and with it their own surfaces.
    Kept,
}

/// The shape of a face.
#[derive(Clone, Debug)]
enum FaceShape {
    Patch(Patch),
    RationalPatch(RationalPatch),
    Triangle(Triangle),
    RationalTriangle(RationalTriangle),
}

/// A face of a [`Skin`], with its normal out of the solid.
#[derive(Clone, Debug)]
pub struct SkinFace {
    /// Which face it is.
    pub id: FaceId,
    shape: FaceShape,
}

impl AsFace for SkinFace {
    fn as_face(&self) -> Face<'_> {
        match &self.shape {
            FaceShape::Patch(patch) => patch.into(),
            FaceShape::RationalPatch(patch) => patch.into(),
            FaceShape::Triangle(triangle) => triangle.into(),
            FaceShape::RationalTriangle(triangle) => triangle.into(),
        }
    }
}

/// The surface of solids, face by face.
///
/// A face's normal points out of its solid: as the kind of solid has it where the Jacobian is positive at the middle of
/// the domain, turned around where it is negative there. A solid whose Jacobian changes its sign has no outside; its faces follow the middle.
///
/// Two faces are the same where their nets are, to the bit, under one of the turns of a rectangle or a triangle, as for
/// sides ([`SideSamples`](crate::SideSamples)). Faces that are a point, or a curve to the bit, have no part in the surface: the faces
/// beside them meet there. A patch between two poles, opposite sides that are points, comes in two halves with a pole each, which mesh
/// better, where all faces along its other sides do.
///
/// ```
/// use casteljau_solid::{Axis, Hexahedron};
/// use casteljau_tess::{FaceId, SharedFaces, Skin};
/// let (left, right) = Hexahedron::unit_cube().split(Axis::U, 0.5)?;
/// let skin = Skin::new(&[left, right], SharedFaces::Dropped)?;
/// assert_eq!(skin.faces().len(), 10);
/// assert_eq!(skin.shared(), [[FaceId { solid: 0, face: 1 }, FaceId { solid: 1, face: 0 }]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Skin {
    faces: Vec<SkinFace>,
    shared: Vec<[FaceId; 2]>,
    overlapping: Vec<FaceId>,
    collapsed: Vec<FaceId>,
    inverted: Vec<usize>,
}

impl Skin {
    /// The surface of solids.
    ///
    /// # Errors
    /// [`TessError::FlatSolid`] for one without volume, [`TessError::Solid`] for one with a pole in its middle, or with a
    /// face whose weights are all zero.
    pub fn new<S: AsSolid>(solids: &[S], shared: SharedFaces) -> Result<Self, TessError> {
        let mut skin = Self::default();
        let mut all: Vec<SkinFace> = Vec::new();
        let mut known: HashMap<Vec<u64>, Vec<(usize, bool)>> = HashMap::new();
        for (index, solid) in solids.iter().enumerate() {
            let solid = solid.as_solid();
            let inverted = solid.is_inverted(index)?;
            if inverted {
                skin.inverted.push(index);
            }
            for face in 0..solid.faces() {
                let id = FaceId { solid: index, face };
                let wrong = |source| TessError::Solid { solid: index, source };
                let shape = face_shape(solid, face, inverted).map_err(wrong)?;
                if is_degenerate(&shape.net()) {
                    skin.collapsed.push(id);
                    continue;
                }
                if shared == SharedFaces::Dropped {
                    let key = FaceKey::new(&shape.net());
                    known.entry(key.bits()).or_default().push((all.len(), key.turn.is_odd()));
                }
                all.push(SkinFace { id, shape });
            }
        }
        let mut dropped = vec![false; all.len()];
        let mut groups: Vec<&Vec<(usize, bool)>> = known.values().filter(|uses| uses.len() > 1).collect();
        groups.sort_unstable();
        for uses in groups {
            match uses[..] {
                [(a, a_odd), (b, b_odd)] if a_odd != b_odd => {
                    skin.shared.push([all[a].id, all[b].id]);
                    (dropped[a], dropped[b]) = (true, true);
                }
                _ => skin.overlapping.extend(uses.iter().map(|&(face, _)| all[face].id)),
            }
        }
        let kept = all.into_iter().zip(dropped).filter(|(_, dropped)| !dropped);
        skin.faces = halved(kept.map(|(face, _)| face).collect())?;
        Ok(skin)
    }

    /// The faces that make the surface.
    #[must_use]
    pub fn faces(&self) -> &[SkinFace] {
        &self.faces
    }

    /// The pairs of faces that were left out, two solids, or one with itself, lying on the two sides.
    #[must_use]
    pub fn shared(&self) -> &[[FaceId; 2]] {
        &self.shared
    }

    /// Faces that are the same as others but do not lie between exactly two solids: kept, and the solids overlap there.
    #[must_use]
    pub fn overlapping(&self) -> &[FaceId] {
        &self.overlapping
    }

    /// Faces that are a point or a curve.
    #[must_use]
    pub fn collapsed(&self) -> &[FaceId] {
        &self.collapsed
    }

    /// Solids whose Jacobian is negative.
    #[must_use]
    pub fn inverted(&self) -> &[usize] {
        &self.inverted
    }
}

/// Tessellates the surface of solids into one mesh, closed where the solids meet to the bit or not at all.
///
/// [`Skin`] says which faces that are, [`tessellate`](crate::tessellate) how they are meshed; sides in the [`Report`]
/// count faces in the order of [`Skin::faces`].
///
/// ```
/// use casteljau_solid::{RationalHexahedron, shape::RationalCurve, geom::glam::{DVec3, dvec3}};
/// use casteljau_tess::{SharedFaces, TessellationOptions, no_progress, tessellate_solids};
/// let half_circle = [-DVec3::Z, dvec3(2., 0., -1.), dvec3(2., 0., 1.), DVec3::Z];
/// let meridian = RationalCurve::new(&half_circle, &[1.0, 1.0 / 3.0, 1.0 / 3.0, 1.0])?;
/// let ball = RationalHexahedron::rotational(&meridian)?;
/// let options = TessellationOptions::tolerance(1e-3);
/// let (mesh, _, skin) = tessellate_solids(&[ball], SharedFaces::Dropped, &options, &mut no_progress)?;
/// let audit = mesh.audit()?;
/// assert!(audit.closed && audit.manifold && audit.oriented && audit.degenerate == 0);
/// assert_eq!(skin.collapsed().len(), 2); // the poles
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of [`Skin::new`] and of [`tessellate`](crate::tessellate), the latter as [`TessError::Face`] where they are about a face.
pub fn tessellate_solids<S: AsSolid>(
    solids: &[S],
    shared: SharedFaces,
    options: &TessellationOptions,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<(TriangleMesh, Report, Skin), TessError> {
    let skin = Skin::new(solids, shared)?;
    let mut mesh = TriangleMesh::default();
    let report = skin.tessellate_into(options, &mut mesh, progress)?;
    Ok((mesh, report, skin))
}

impl Skin {
    /// Tessellates the faces into a sink; see [`tessellate_solids`].
    ///
    /// # Errors
    /// Those of [`tessellate`](crate::tessellate), as [`TessError::Face`] where they are about a face.
    pub fn tessellate_into(
        &self,
        options: &TessellationOptions,
        sink: &mut dyn MeshSink,
        progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Report, TessError> {
        tessellate_into(&self.faces, options, sink, progress).map_err(|source| {
            match source.patch().and_then(|patch| self.faces.get(patch)) {
                Some(face) => TessError::Face { id: face.id, source: Box::new(source) },
                None => source,
            }
        })
    }
}

impl FaceShape {
    fn net(&self) -> FaceNet {
        fn lift<P: Lift>(points: &[P]) -> Vec<DVec4> {
            points.iter().map(|&p| p.lift()).collect()
        }
        match self {
            Self::Patch(patch) => FaceNet::Patch(patch.degrees(), lift(patch.control_points())),
            Self::RationalPatch(patch) => FaceNet::Patch(patch.degrees(), lift(patch.control_points())),
            Self::Triangle(triangle) => FaceNet::Triangle(triangle.degree(), lift(triangle.control_points())),
            Self::RationalTriangle(triangle) => {
                FaceNet::Triangle(triangle.degree(), lift(triangle.control_points()))
            }
        }
    }
}

/// Face number `face`, its normal outward.
fn face_shape(solid: Solid<'_>, face: usize, inverted: bool) -> Result<FaceShape, SolidError> {
    fn hexahedron<P: Lift>(
        solid: &BezierHexahedron<P>,
        face: usize,
        inverted: bool,
    ) -> Result<BezierPatch<P>, SolidError> {
        let face = HexahedronFace::ALL[face];
        let patch = solid.face(face)?;
        Ok(if face.is_outward() == inverted { patch.swapped() } else { patch })
    }
    fn tetrahedron<P: Lift>(
        solid: &BezierTetrahedron<P>,
        face: usize,
        inverted: bool,
    ) -> Result<BezierTriangle<P>, SolidError> {
        turned(solid.face(face)?, inverted)
    }
    fn turned<P: Lift>(triangle: BezierTriangle<P>, inverted: bool) -> Result<BezierTriangle<P>, SolidError> {
        Ok(if inverted { triangle.permuted([0, 2, 1])? } else { triangle })
    }
    fn wedge_patch<P: Lift>(
        solid: &BezierWedge<P>,
        face: usize,
        inverted: bool,
    ) -> Result<BezierPatch<P>, SolidError> {
        let patch = solid.quad_face(face)?;
        Ok(if inverted { patch.swapped() } else { patch })
    }
    fn wedge_triangle<P: Lift>(
        solid: &BezierWedge<P>,
        face: usize,
        inverted: bool,
    ) -> Result<BezierTriangle<P>, SolidError> {
        let top = face == 4;
        turned(solid.triangle_face(top)?, inverted == top)
    }
    Ok(match solid {
        Solid::Hexahedron(solid) => FaceShape::Patch(hexahedron(solid, face, inverted)?),
        Solid::RationalHexahedron(solid) => FaceShape::RationalPatch(hexahedron(solid, face, inverted)?),
        Solid::Tetrahedron(solid) => FaceShape::Triangle(tetrahedron(solid, face, inverted)?),
        Solid::RationalTetrahedron(solid) => FaceShape::RationalTriangle(tetrahedron(solid, face, inverted)?),
        Solid::Wedge(solid) if face < 3 => FaceShape::Patch(wedge_patch(solid, face, inverted)?),
        Solid::RationalWedge(solid) if face < 3 => {
            FaceShape::RationalPatch(wedge_patch(solid, face, inverted)?)
        }
        Solid::Wedge(solid) => FaceShape::Triangle(wedge_triangle(solid, face, inverted)?),
        Solid::RationalWedge(solid) => FaceShape::RationalTriangle(wedge_triangle(solid, face, inverted)?),
    })
}

/// The faces, those between two poles cut in the middle.
///
/// A side that is cut must be cut for all who have it: faces are taken back from the cut until that holds.
fn halved(faces: Vec<SkinFace>) -> Result<Vec<SkinFace>, TessError> {
    let keys = |face: &SkinFace| face.shape.net().sides().iter().map(|s| SideKey::new(s)).collect();
    let sides: Vec<Vec<SideKey>> = faces.iter().map(keys).collect();
    // The direction from pole to pole: the sides 0 and 2, or 1 and 3, are the poles.
    let mut cut: Vec<Option<usize>> = sides
        .iter()
        .map(|sides| match sides[..].iter().map(|key| key.collapsed).collect::<Vec<_>>()[..] {
            [true, false, true, false] => Some(1),
            [false, true, false, true] => Some(0),
            _ => None,
        })
        .collect();
    let mut users: HashMap<Vec<u64>, Vec<(usize, usize)>> = HashMap::new();
    for (face, sides) in sides.iter().enumerate() {
        for (side, key) in sides.iter().enumerate().filter(|(_, key)| !key.collapsed) {
            users.entry(key.bits()).or_default().push((face, side));
        }
    }
    loop {
        // The sides that a cut goes across are 1 and 3 along v, 0 and 2 along u.
        let whole = |&(face, side): &(usize, usize)| cut[face].is_none_or(|direction| side % 2 != direction);
        let kept = |face: usize| {
            let along = sides[face].iter().filter(|key| !key.collapsed);
            along.flat_map(|key| users[&key.bits()].iter()).any(whole)
        };
        let taken_back: Vec<usize> =
            (0..faces.len()).filter(|&face| cut[face].is_some() && kept(face)).collect();
        if taken_back.is_empty() {
            break;
        }
        taken_back.into_iter().for_each(|face| cut[face] = None);
    }
    let mut out = Vec::with_capacity(faces.len());
    for (face, cut) in faces.into_iter().zip(cut) {
        let SkinFace { id, shape } = face;
        let wrong = |source: ShapeError| TessError::Solid { solid: id.solid, source: source.into() };
        match (shape, cut) {
            (FaceShape::Patch(patch), Some(direction)) => {
                let halves = split(&patch, direction).map_err(wrong)?;
                out.extend(halves.map(|half| SkinFace { id, shape: FaceShape::Patch(half) }));
            }
            (FaceShape::RationalPatch(patch), Some(direction)) => {
                let halves = split(&patch, direction).map_err(wrong)?;
                out.extend(halves.map(|half| SkinFace { id, shape: FaceShape::RationalPatch(half) }));
            }
            (shape, _) => out.push(SkinFace { id, shape }),
        }
    }
    Ok(out)
}

/// The halves of a patch along u (0) or v (1).
fn split<P: Lift>(patch: &BezierPatch<P>, direction: usize) -> Result<[BezierPatch<P>; 2], ShapeError> {
    let [u, v] = patch.intervals();
    let (a, b) = if direction == 0 { patch.split_u(u.at(0.5))? } else { patch.split_v(v.at(0.5))? };
    Ok([a, b])
}

/// Whether a face is one point, but for rounding, or one curve, run through in one direction, to the bit.
pub(crate) fn is_degenerate(net: &FaceNet) -> bool {
    is_point(net.points()) || collapsed_along(net).is_some()
}

/// Whether all points of a net are one, but for rounding.
pub(crate) fn is_point(net: &[DVec4]) -> bool {
    let points: Vec<DVec3> = net.iter().map(|p| p.xyz() / p.w).filter(|p| p.is_finite()).collect();
    points.len() == net.len() && is_collapsed(&points)
}

/// The direction of a patch, 0 or 1, along which nothing changes: its rows are points, and the sides along the other direction are
/// the same curve, to the bit and not turned around.
pub(crate) fn collapsed_along(net: &FaceNet) -> Option<usize> {
    let FaceNet::Patch([m, n], points) = net else { return None };
    let row = |direction: usize, place: usize| -> Vec<DVec4> {
        match direction {
            0 => points.iter().skip(place).step_by(n + 1).copied().collect(),
            _ => points[place * (n + 1)..(place + 1) * (n + 1)].to_vec(),
        }
    };
    (0..2).find(|&direction| {
        let (across, last) = if direction == 0 { (*n, *m) } else { (*m, *n) };
        let side = |place: usize| SideKey::new(&row(1 - direction, place));
        let (first, second) = (side(0), side(last));
        first.bits() == second.bits()
            && first.reversed == second.reversed
            && (0..=across).all(|place| is_point(&row(direction, place)))
    })
}
