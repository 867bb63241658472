use casteljau_domain::DomainError;
use casteljau_gb::GbError;
use casteljau_geom::glam::DVec3;
use casteljau_mesh::MeshError;
use casteljau_shape::ShapeError;
use casteljau_solid::SolidError;

use crate::FaceId;

/// What can be wrong with a tessellation, and where. Patches are counted from 0.
///
/// ```
/// use casteljau_gb::ConcavePatch;
/// use casteljau_tess::{TessError, TessellationOptions, no_progress, tessellate};
/// let nothing = tessellate::<ConcavePatch>(&[], &TessellationOptions::resolution(8), &mut no_progress);
/// assert_eq!(nothing.unwrap_err(), TessError::Empty);
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TessError {
    /// No patch was given.
    #[error("there is no patch to tessellate")]
    Empty,
    /// A chord tolerance that is no number, not positive, infinite, or below what rounding leaves of the coordinates.
    #[error(
        "the chord tolerance is {value:e}; for this model it must be a finite number from {least:.1e} up"
    )]
    Tolerance {
        /// The tolerance, in model units.
        value: f64,
        /// The least one accepted, in model units.
        least: f64,
    },
    /// A resolution below 1.
    #[error("the resolution is {value} samples a side, at least 1 is needed")]
    Resolution {
        /// The resolution.
        value: usize,
    },
    /// The mesh would have more vertices than allowed. Found out from an estimate where that is far beyond the limit,
    /// so that nothing was allocated for it.
    #[error("about {needed:.3e} vertices are needed by patch {patch}, {limit} are allowed")]
    TooManyVertices {
        /// The patch in work.
        patch: usize,
        /// Vertices needed up to there, roughly.
        needed: f64,
        /// [`TessellationOptions::max_vertices`](crate::TessellationOptions::max_vertices).
        limit: usize,
    },
    /// Refinement ended before the chord tolerance was kept everywhere.
    #[error(
        "patch {patch} is within {reached:.3e} of its mesh of {vertices} vertices only, not within {tolerance:.3e}"
    )]
    ToleranceMissed {
        /// The patch.
        patch: usize,
        /// The tolerance, in model units.
        tolerance: f64,
        /// Largest chord error left, in model units.
        reached: f64,
        /// Vertices of the patch at that time.
        vertices: usize,
    },
    /// The progress callback asked to stop.
    #[error("cancelled at {:.0} %", 100.0 * fraction)]
    Cancelled {
        /// How much was done, 0 to 1.
        fraction: f64,
    },
    /// A Bézier patch or triangle could not be evaluated: it has a pole.
    ///
    /// ```
    /// use casteljau_shape::{RationalPatch, geom::glam::DVec3};
    /// use casteljau_tess::{TessError, TessellationOptions, no_progress, tessellate};
    /// let net = [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::ONE];
    /// let patch = RationalPatch::new([1, 1], &net, &[1.0, 1.0, -1.0, -1.0])?; // pole at u = ½
    /// let refused = tessellate(&[patch], &TessellationOptions::resolution(8), &mut no_progress);
    /// assert!(matches!(refused, Err(TessError::Shape { patch: 0, .. })));
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    #[error("patch {patch}: {source}")]
    Shape {
        /// The patch.
        patch: usize,
        /// What it said.
        source: ShapeError,
    },
    /// A patch could not be evaluated.
    #[error("patch {patch}: {source}")]
    Patch {
        /// The patch.
        patch: usize,
        /// What it said.
        source: GbError,
    },
    /// The domain of a patch could not be triangulated.
    #[error("the domain of patch {patch}: {source}")]
    Domain {
        /// The patch.
        patch: usize,
        /// What is wrong with it.
        source: DomainError,
    },
    /// A face of a solid could not be meshed.
    ///
    /// ```
    /// use casteljau_solid::{RationalTetrahedron, geom::glam::DVec3};
    /// use casteljau_tess::{FaceId, SharedFaces, TessError, TessellationOptions, no_progress, tessellate_solids};
    /// let corners = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ZERO];
    /// let solid = RationalTetrahedron::new(1, &corners, &[-1.0, 2.0, 2.0, 2.0])?; // poles across three faces
    /// let options = TessellationOptions::resolution(4);
    /// let refused = tessellate_solids(&[solid], SharedFaces::Dropped, &options, &mut no_progress);
    /// assert!(matches!(refused, Err(TessError::Face { id: FaceId { solid: 0, face: 1 }, .. })));
    /// # Ok::<(), casteljau_solid::SolidError>(())
    /// ```
    #[error("face {} of solid {}: {source}", .id.face, .id.solid)]
    Face {
        /// Which face.
        id: FaceId,
        /// What is wrong; the patch in it counts the faces of the surface.
        source: Box<TessError>,
    },
    /// A solid could not be evaluated.
    #[error("solid {solid}: {source}")]
    Solid {
        /// The solid.
        solid: usize,
        /// What it said.
        source: SolidError,
    },
    /// The Jacobian of a solid is zero at its middle and at all of a few other places: it has no inside.
    ///
    /// ```
    /// use casteljau_solid::{Tetrahedron, geom::glam::DVec3};
    /// use casteljau_tess::{SharedFaces, Skin, TessError};
    /// let flat = Tetrahedron::new(1, [DVec3::X, DVec3::Y, DVec3::ZERO, DVec3::ZERO])?;
    /// assert!(matches!(Skin::new(&[flat], SharedFaces::Kept), Err(TessError::FlatSolid { solid: 0 })));
    /// # Ok::<(), casteljau_solid::SolidError>(())
    /// ```
    #[error("the Jacobian of solid {solid} is zero wherever it was asked for: it has no inside")]
    FlatSolid {
        /// The solid.
        solid: usize,
    },
    /// The cells of solids would have more vertices than allowed.
    ///
    /// ```
    /// use casteljau_solid::Hexahedron;
    /// use casteljau_tess::{TessError, VolumeOptions, no_progress, volume_mesh};
    /// let options = VolumeOptions { max_vertices: 1000, ..VolumeOptions::resolution(20) };
    /// let refused = volume_mesh(&[Hexahedron::unit_cube()], &options, &mut no_progress);
    /// assert_eq!(refused, Err(TessError::TooManySolidVertices { solid: 0, needed: 9261.0, limit: 1000 }));
    /// ```
    #[error("about {needed:.3e} vertices are needed by solid {solid}, {limit} are allowed")]
    TooManySolidVertices {
        /// The solid in work.
        solid: usize,
        /// Vertices needed up to there, roughly.
        needed: f64,
        /// The limit.
        limit: usize,
    },
    /// A plane without a direction, or a number in it that is not finite.
    ///
    /// ```
    /// use casteljau_solid::Hexahedron;
    /// use casteljau_tess::{SectionOptions, TessError, geom::glam::DVec3, no_progress, slice};
    /// let options = SectionOptions::tolerance(1e-3);
    /// let refused = slice(&[Hexahedron::unit_cube()], DVec3::ZERO, 1.0, &options, &mut no_progress);
    /// assert!(matches!(refused, Err(TessError::Plane { .. })));
    /// ```
    #[error("there is no plane {} x + {} y + {} z = {offset}", .normal.x, .normal.y, .normal.z)]
    Plane {
        /// The normal.
        normal: DVec3,
        /// The offset.
        offset: f64,
    },
    /// A number of a scalar field, or a number of fields, that there can be no surface of.
    ///
    /// ```
    /// use casteljau_tess::{SolidField, TessError};
    /// let refused = SolidField::tetrahedron(1, [0.0; 5]);
    /// assert_eq!(refused, Err(TessError::Field { what: "number of coefficients", value: 5.0 }));
    /// ```
    #[error("a field cannot be used with this {what}: {value}")]
    Field {
        /// What is wrong.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A field over another kind of domain than that of its solid.
    ///
    /// ```
    /// use casteljau_solid::Hexahedron;
    /// use casteljau_tess::{SectionOptions, SolidField, TessError, iso_surface, no_progress};
    /// let (cube, field) = (Hexahedron::unit_cube(), SolidField::wedge([0, 0], [1.0])?);
    /// let options = SectionOptions::tolerance(1e-3);
    /// let refused = iso_surface(&[cube], &[field], 1.0, &options, &mut no_progress);
    /// assert!(matches!(refused, Err(TessError::FieldKind { solid: 0 })));
    /// # Ok::<(), TessError>(())
    /// ```
    #[error("the field of solid {solid} is over another kind of domain")]
    FieldKind {
        /// The solid.
        solid: usize,
    },
    /// Halving ended before a slice or an iso-surface was within the tolerance everywhere: it has a singular point, or bends
    /// too much.
    #[error(
        "the surface in solid {solid} is within {reached:.3e} of its mesh of {vertices} vertices only, not within {tolerance:.3e}"
    )]
    SectionMissed {
        /// The solid with the largest error.
        solid: usize,
        /// The tolerance, in model units.
        tolerance: f64,
        /// The largest chord error left, in model units.
        reached: f64,
        /// Vertices of the mesh at that time.
        vertices: usize,
    },
    /// The weights of a solid change their sign somewhere: there it has a pole, or so nearly that no bound shows it has none.
    #[error("solid {solid} has a pole, or its weights have two signs, near ({}, {}, {}) of its domain", .at[0], .at[1], .at[2])]
    SolidPole {
        /// The solid.
        solid: usize,
        /// Where: u, v, w on `[0, 1]`; the first three barycentric coordinates; or the first two and the height on `[0, 1]`.
        at: [f64; 3],
    },
    /// The sink refused a vertex or a triangle.
    #[error("the sink: {0}")]
    Sink(#[from] MeshError),
}

impl TessError {
    /// The patch that it is about.
    pub(crate) fn patch(&self) -> Option<usize> {
        match *self {
            Self::TooManyVertices { patch, .. }
            | Self::ToleranceMissed { patch, .. }
            | Self::Shape { patch, .. }
            | Self::Patch { patch, .. }
            | Self::Domain { patch, .. } => Some(patch),
            _ => None,
        }
    }
}
