//! Solids: their faces, shaded or coloured by curvature, with isolines and nets.

use casteljau_geom::glam::DVec4;
use casteljau_shape::bernstein::{multi_indices, simplex_index};
use casteljau_shape::{RationalPatch, RationalTriangle};
use casteljau_solid::{
    Axis, Hexahedron, HexahedronFace, ParametricSolid, RationalHexahedron, RationalTetrahedron,
    RationalWedge, SolidDomain, SolidError, Tetrahedron, Wedge,
};

use crate::domain_picture::check_counts;
use crate::surface_picture::{Net, Whole, triangle_lines};
use crate::{PlotError, SurfaceShape, SurfaceStyle};

/// A solid to draw.
#[derive(Clone, Debug, PartialEq)]
pub enum SolidShape {
    /// A tensor-product solid.
    Hexahedron(RationalHexahedron),
    /// A tetrahedron.
    Tetrahedron(RationalTetrahedron),
    /// A wedge.
    Wedge(RationalWedge),
}

macro_rules! from_solids {
    ($($variant:ident, $polynomial:ty, $rational:ty;)*) => {$(
        impl From<&$polynomial> for SolidShape {
            fn from(solid: &$polynomial) -> Self {
                Self::$variant(solid.clone().into())
            }
        }

        impl From<&$rational> for SolidShape {
            fn from(solid: &$rational) -> Self {
                Self::$variant(solid.clone())
            }
        }
    )*};
}

from_solids! {
    Hexahedron, Hexahedron, RationalHexahedron;
    Tetrahedron, Tetrahedron, RationalTetrahedron;
    Wedge, Wedge, RationalWedge;
}

/// Places along each parameter at which the sign of the Jacobian is looked at.
const LOOKS: usize = 5;

/// Draws solids by their faces, in the look of [`surface_picture`](crate::surface_picture): isolines are those of the faces,
/// nets those of the solids. Faces that look away are left out, except of a solid whose Jacobian is seen to change its
/// sign, and without shading.
///
/// # Errors
/// No solid, numbers of the style out of range, a pole among the places drawn, a face all of whose weights are zero;
/// [`PlotError::NoConstruction`] where de Casteljau's construction is asked for.
///
/// ```
/// use casteljau_plot::{SolidShape, SurfaceStyle, solid_picture};
/// use casteljau_solid::Hexahedron;
/// let picture = solid_picture(&[SolidShape::from(&Hexahedron::unit_cube())], &SurfaceStyle::default())?;
/// assert!(picture.starts_with("<svg"));
/// # Ok::<(), casteljau_plot::PlotError>(())
/// ```
pub fn solid_picture(solids: &[SolidShape], style: &SurfaceStyle) -> Result<String, PlotError> {
    check_counts(style.width, style.levels, style.triangles)?;
    if style.construction.is_some() {
        return Err(PlotError::NoConstruction);
    }
    let mut faces = Vec::new();
    let mut closed = true;
    for solid in solids {
        let sense = solid.sense();
        closed &= sense.is_some();
        faces.extend(solid.faces(sense.unwrap_or(true))?);
    }
    let whole = Whole {
        surfaces: &faces,
        nets: solids.iter().map(|solid| Net { points: solid.net(), lines: solid.net_lines() }).collect(),
        net_in_front: false,
        constructions: Vec::new(),
        closed,
        title: title(solids),
    };
    whole.picture(style)
}

fn title(solids: &[SolidShape]) -> String {
    let kind = |plain: bool| if plain { "Bézier" } else { "rational Bézier" };
    match solids {
        [SolidShape::Hexahedron(solid)] => {
            let [l, m, n] = solid.degrees();
            format!("{} hexahedron of degrees {l} × {m} × {n}", kind(solid.weights().all(|w| w == 1.0)))
        }
        [SolidShape::Tetrahedron(solid)] => {
            format!("{} tetrahedron of degree {}", kind(solid.weights().all(|w| w == 1.0)), solid.degree())
        }
        [SolidShape::Wedge(solid)] => {
            let [n, o] = solid.degrees();
            format!("{} wedge of degrees {n} × {o}", kind(solid.weights().all(|w| w == 1.0)))
        }
        _ => format!("{} Bézier solids", solids.len()),
    }
}

impl SolidShape {
    fn solid(&self) -> &dyn ParametricSolid {
        match self {
            Self::Hexahedron(solid) => solid,
            Self::Tetrahedron(solid) => solid,
            Self::Wedge(solid) => solid,
        }
    }

    fn net(&self) -> Vec<DVec4> {
        match self {
            Self::Hexahedron(solid) => solid.control_points().to_vec(),
            Self::Tetrahedron(solid) => solid.control_points().to_vec(),
            Self::Wedge(solid) => solid.control_points().to_vec(),
        }
    }

    /// Whether the Jacobian is positive, or negative, as far as it is looked at; `None` where it is both.
    fn sense(&self) -> Option<bool> {
        let solid = self.solid();
        let share = |i: usize| (i as f64 + 0.5) / LOOKS as f64;
        let looks = (0..LOOKS.pow(3)).map(|i| [i % LOOKS, i / LOOKS % LOOKS, i / LOOKS / LOOKS].map(share));
        let values: Vec<f64> = looks
            .filter_map(|[x, y, z]| {
                solid
                    .try_jacobian(match solid.domain() {
                        SolidDomain::Box([u, v, w]) => [u.at(x), v.at(y), w.at(z)],
                        SolidDomain::Tetrahedron => {
                            let (b, c) = ((1.0 - x) * y, (1.0 - x) * (1.0 - y) * z);
                            [x, b, c]
                        }
                        SolidDomain::Wedge(height) => [x, (1.0 - x) * y, height.at(z)],
                    })
                    .ok()
            })
            .collect();
        match (values.iter().all(|j| *j >= 0.0), values.iter().all(|j| *j <= 0.0)) {
            (true, _) => Some(true),
            (false, true) => Some(false),
            (false, false) => None,
        }
    }

    /// The faces, their normals outward where the Jacobian is positive, or negative if not `positive`.
    fn faces(&self, positive: bool) -> Result<Vec<SurfaceShape>, SolidError> {
        let mut faces = Vec::with_capacity(6);
        let patch = |patch: RationalPatch, outward: bool| {
            SurfaceShape::Patch(if outward == positive { patch } else { patch.swapped() })
        };
        let triangle = |triangle: RationalTriangle, outward: bool| {
            let outward = outward == positive;
            let triangle = if outward { triangle } else { triangle.permuted([1, 0, 2])? };
            Ok::<_, SolidError>(SurfaceShape::Triangle(triangle))
        };
        match self {
            Self::Hexahedron(solid) => {
                for face in HexahedronFace::ALL {
                    faces.push(patch(solid.face(face)?, face.is_outward()));
                }
            }
            Self::Tetrahedron(solid) => {
                for opposite in 0..4 {
                    faces.push(triangle(solid.face(opposite)?, true)?);
                }
            }
            Self::Wedge(solid) => {
                for opposite in 0..3 {
                    faces.push(patch(solid.quad_face(opposite)?, true));
                }
                for top in [false, true] {
                    faces.push(triangle(solid.triangle_face(top)?, top)?);
                }
            }
        }
        Ok(faces)
    }

    /// The lines of the control net.
    fn net_lines(&self) -> Vec<Vec<DVec4>> {
        match self {
            Self::Hexahedron(solid) => {
                let degrees = solid.degrees();
                let mut lines = Vec::new();
                for axis in Axis::ALL {
                    let [a, b, c] = match axis {
                        Axis::U => [0, 1, 2],
                        Axis::V => [1, 0, 2],
                        Axis::W => [2, 0, 1],
                    };
                    for (i, j) in (0..=degrees[b]).flat_map(|i| (0..=degrees[c]).map(move |j| (i, j))) {
                        let point = |k: usize| {
                            let mut index = [0; 3];
                            (index[a], index[b], index[c]) = (k, i, j);
                            solid.control_point(index)
                        };
                        lines.push((0..=degrees[a]).filter_map(point).collect());
                    }
                }
                lines
            }
            Self::Tetrahedron(solid) => {
                let (n, net) = (solid.degree(), solid.control_points());
                let point = |index: [usize; 4]| net.get(simplex_index(index)).copied();
                let mut lines = Vec::new();
                // The triangles of constant λ₁, and the lines between them.
                for c in 0..=n {
                    let rest = n - c;
                    let slice: Vec<DVec4> =
                        multi_indices::<3>(rest).filter_map(|[i, j, k]| point([c, i, j, k])).collect();
                    lines.extend(triangle_lines(&slice, rest));
                }
                for [i, j, k] in multi_indices::<3>(n) {
                    for [di, dj, dk] in [[1, 0, 0], [0, 1, 0], [0, 0, 1]] {
                        let along = |c: usize| {
                            let index =
                                [i.checked_sub(c * di)?, j.checked_sub(c * dj)?, k.checked_sub(c * dk)?];
                            point([c, index[0], index[1], index[2]])
                        };
                        let line: Vec<DVec4> = (0..=n).map_while(along).collect();
                        if line.len() > 1 {
                            lines.push(line);
                        }
                    }
                }
                lines
            }
            Self::Wedge(solid) => {
                let [n, o] = solid.degrees();
                let net = solid.control_points();
                let layer = |k: usize| net.iter().skip(k).step_by(o + 1).copied().collect::<Vec<_>>();
                let layers = (0..=o).flat_map(|k| triangle_lines(&layer(k), n));
                layers.chain(net.chunks(o + 1).map(<[DVec4]>::to_vec)).collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use casteljau_geom::glam::DVec3;

    use super::*;

    /// A tetrahedron, inside out or not, has every edge of its net, and normals that point outward.
    #[test]
    fn faces_look_outward() {
        let corners = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ZERO];
        let turned = [DVec3::Y, DVec3::X, DVec3::Z, DVec3::ZERO];
        for (corners, sense) in [(corners, true), (turned, false)] {
            let solid = SolidShape::from(&Tetrahedron::new(1, corners).unwrap());
            assert_eq!(solid.sense(), Some(sense));
            assert_eq!(solid.net_lines().iter().map(|line| line.len() - 1).sum::<usize>(), 6);
            for face in solid.faces(sense).unwrap() {
                let SurfaceShape::Triangle(face) = face else { continue };
                let outward = face.point(0.3, 0.3).unwrap() - DVec3::splat(0.25);
                assert!(face.jet(0.3, 0.3).unwrap().normal().unwrap().dot(outward) > 0.0);
            }
        }
        let wedge = [DVec3::X, DVec3::X + DVec3::Z, DVec3::Y, DVec3::Y + DVec3::Z, DVec3::ZERO, DVec3::Z];
        let wedge = SolidShape::from(&Wedge::new([1, 1], wedge).unwrap());
        assert_eq!((wedge.sense(), wedge.net_lines().len()), (Some(true), 9));
        let cube = SolidShape::from(&Hexahedron::unit_cube());
        assert_eq!((cube.sense(), cube.net_lines().len()), (Some(true), 12));
    }
}
