//! A solid that remembers what it was made of.

use casteljau_shape::{RationalCurve, RationalPatch};

use super::Twist;
use crate::{RationalHexahedron, SolidError};

/// What a solid is made of; polynomial parts are given with weights of 1.
#[derive(Debug, Clone, PartialEq)]
pub enum Construction {
    /// A patch translated along a curve; see [`RationalHexahedron::transitional`].
    Transitional {
        /// The patch S(u, v).
        patch: RationalPatch,
        /// The curve C(w).
        curve: RationalCurve,
    },
    /// A curve rotated about the z axis; see [`RationalHexahedron::rotational`].
    Rotational {
        /// The meridian.
        curve: RationalCurve,
    },
    /// A patch translated along a curve and turned about the z axis; see [`RationalHexahedron::twisted`] and
    /// [`RationalHexahedron::rigidly_twisted`].
    Twisted {
        /// The patch S(u, v).
        patch: RationalPatch,
        /// The curve C(w).
        curve: RationalCurve,
        /// How it is turned.
        twist: Twist,
    },
}

/// A hexahedron with the [`Construction`] that it came from.
///
/// ```
/// use casteljau_solid::{ConstructedSolid, Construction, shape::RationalCurve, geom::glam::DVec3};
/// let curve = RationalCurve::new(&[DVec3::X, DVec3::Z], &[1.0, 1.0])?;
/// let cone = ConstructedSolid::new(Construction::Rotational { curve })?;
/// assert_eq!(cone.hexahedron().degrees(), [2, 2, 1]);
/// # Ok::<(), casteljau_solid::SolidError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ConstructedSolid {
    construction: Construction,
    hexahedron: RationalHexahedron,
}

impl ConstructedSolid {
    /// Carries out the construction.
    ///
    /// # Errors
    /// Those of the construction.
    pub fn new(construction: Construction) -> Result<Self, SolidError> {
        let hexahedron = match &construction {
            Construction::Transitional { patch, curve } => RationalHexahedron::transitional(patch, curve),
            Construction::Rotational { curve } => RationalHexahedron::rotational(curve),
            Construction::Twisted { patch, curve, twist: Twist::PerLayer(angle) } => {
                RationalHexahedron::twisted(patch, curve, *angle)
            }
            Construction::Twisted { patch, curve, twist: Twist::Rigid(angle) } => {
                RationalHexahedron::rigidly_twisted(patch, curve, *angle)
            }
        }?;
        Ok(Self { construction, hexahedron })
    }

    /// What the solid is made of.
    #[must_use]
    pub fn construction(&self) -> &Construction {
        &self.construction
    }

    /// The solid itself.
    #[must_use]
    pub fn hexahedron(&self) -> &RationalHexahedron {
        &self.hexahedron
    }
}
