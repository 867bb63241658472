//! The solids that a mesh can be made of.

use casteljau_geom::{SolidJet, power_of_two_below};
use casteljau_shape::bernstein::multi_indices;
use casteljau_solid::{
    ConstructedSolid, Hexahedron, ParametricSolid, RationalHexahedron, RationalTetrahedron, RationalWedge,
    SolidError, Tetrahedron, Wedge,
};

use crate::TessError;

/// A solid of a model, of any kind.
///
/// Faces are numbered as the kind does:
/// - of a hexahedron as in [`HexahedronFace::ALL`](casteljau_solid::HexahedronFace::ALL): u at its start and end, then v, then w;
/// - of a tetrahedron by the vertex opposite;
/// - of a wedge: 0 to 2 the quads by the triangle's vertex opposite, 3 the triangle at the start of the height, 4 that at its end.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum Solid<'a> {
    /// A tensor-product solid.
    Hexahedron(&'a Hexahedron),
    /// A rational tensor-product solid.
    RationalHexahedron(&'a RationalHexahedron),
    /// A tetrahedron.
    Tetrahedron(&'a Tetrahedron),
    /// A rational tetrahedron.
    RationalTetrahedron(&'a RationalTetrahedron),
    /// A wedge.
    Wedge(&'a Wedge),
    /// A rational wedge.
    RationalWedge(&'a RationalWedge),
}

/// Whatever is a [`Solid`]: lists of one kind are meshed as they are, mixed ones as lists of solids.
pub trait AsSolid {
    /// The shape as a solid.
    fn as_solid(&self) -> Solid<'_>;
}

impl AsSolid for Solid<'_> {
    fn as_solid(&self) -> Solid<'_> {
        *self
    }
}

impl<T: AsSolid + ?Sized> AsSolid for &T {
    fn as_solid(&self) -> Solid<'_> {
        (**self).as_solid()
    }
}

impl AsSolid for ConstructedSolid {
    fn as_solid(&self) -> Solid<'_> {
        Solid::RationalHexahedron(self.hexahedron())
    }
}

impl<'a> From<&'a ConstructedSolid> for Solid<'a> {
    fn from(solid: &'a ConstructedSolid) -> Self {
        Self::RationalHexahedron(solid.hexahedron())
    }
}

macro_rules! solids {
    ($($kind:ident),*) => {$(
        impl<'a> From<&'a $kind> for Solid<'a> {
            fn from(solid: &'a $kind) -> Self {
                Self::$kind(solid)
            }
        }

        impl AsSolid for $kind {
            fn as_solid(&self) -> Solid<'_> {
                Solid::$kind(self)
            }
        }
    )*};
}

solids!(Hexahedron, RationalHexahedron, Tetrahedron, RationalTetrahedron, Wedge, RationalWedge);

/// One face of one solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FaceId {
    /// The solid, in the order given.
    pub solid: usize,
    /// The face of that solid; see [`Solid`].
    pub face: usize,
}

impl Solid<'_> {
    /// How many faces it has.
    #[must_use]
    pub fn faces(&self) -> usize {
        match self {
            Self::Hexahedron(_) | Self::RationalHexahedron(_) => 6,
            Self::Tetrahedron(_) | Self::RationalTetrahedron(_) => 4,
            Self::Wedge(_) | Self::RationalWedge(_) => 5,
        }
    }

    /// The same solid, asked as any.
    #[must_use]
    pub fn parametric(&self) -> &dyn ParametricSolid {
        match self {
            Self::Hexahedron(solid) => *solid,
            Self::RationalHexahedron(solid) => *solid,
            Self::Tetrahedron(solid) => *solid,
            Self::RationalTetrahedron(solid) => *solid,
            Self::Wedge(solid) => *solid,
            Self::RationalWedge(solid) => *solid,
        }
    }

    /// Whether the Jacobian is negative: at the middle of the domain or, where it is zero there, at the first of a few
    /// other places where it is not.
    pub(crate) fn is_inverted(&self, index: usize) -> Result<bool, TessError> {
        let solid = self.parametric();
        let domain = solid.domain();
        let wrong = |source: SolidError| TessError::Solid { solid: index, source };
        // Its sign only: each derivative is brought near 1 by a power of two, so that no product of three leaves the range of numbers.
        let jacobian = |at: [f64; 3]| {
            let SolidJet { du, dv, dw, .. } = solid.try_jet(at).map_err(wrong)?;
            let [u, v, w] = [du, dv, dw].map(|d| d / power_of_two_below(d.abs().max_element()));
            Ok::<f64, TessError>(u.dot(v.cross(w)))
        };
        let at_center = jacobian(domain.center())?;
        if at_center != 0.0 {
            return Ok(at_center < 0.0);
        }
        // Barycentric in the domain's own coordinates; a tetrahedron's corner of the box is inside every domain.
        let steps = multi_indices::<4>(7).filter(|at| at.iter().all(|&i| i > 0));
        for [i, j, k, _] in steps {
            let local = [i, j, k].map(|i| i as f64 / 7.0);
            let at = match domain {
                casteljau_solid::SolidDomain::Box(intervals) => {
                    std::array::from_fn(|axis| intervals[axis].at(local[axis]))
                }
                casteljau_solid::SolidDomain::Wedge(height) => [local[0], local[1], height.at(local[2])],
                casteljau_solid::SolidDomain::Tetrahedron => local,
            };
            let jacobian = jacobian(at)?;
            if jacobian != 0.0 {
                return Ok(jacobian < 0.0);
            }
        }
        Err(TessError::FlatSolid { solid: index })
    }
}
