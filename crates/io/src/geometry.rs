use casteljau_gb::ConcavePatch;
use casteljau_geom::BoundingBox;
use casteljau_shape::{
    Curve, ParametricCurve, ParametricSurface, Patch, PowerCurve, PowerPatch, RationalCurve, RationalPatch,
    RationalTriangle, Triangle,
};
use casteljau_solid::{
    ConstructedSolid, Hexahedron, ParametricSolid, RationalHexahedron, RationalTetrahedron, RationalWedge,
    Tetrahedron, Wedge,
};

use crate::IoError;
use crate::model::{NamedShape, Shape};

/// A shape that answers: made of what a file describes.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Geometry {
    /// A polynomial curve.
    Curve(Curve),
    /// A rational curve.
    RationalCurve(RationalCurve),
    /// A polynomial curve in the power basis.
    PowerCurve(PowerCurve),
    /// A polynomial patch.
    Patch(Patch),
    /// A rational patch.
    RationalPatch(RationalPatch),
    /// A polynomial patch in the power basis.
    PowerPatch(PowerPatch),
    /// A polynomial triangle.
    Triangle(Triangle),
    /// A rational triangle.
    RationalTriangle(RationalTriangle),
    /// A polynomial tetrahedron.
    Tetrahedron(Tetrahedron),
    /// A rational tetrahedron.
    RationalTetrahedron(RationalTetrahedron),
    /// A polynomial tensor-product solid.
    Hexahedron(Hexahedron),
    /// A rational tensor-product solid.
    RationalHexahedron(RationalHexahedron),
    /// A polynomial wedge.
    Wedge(Wedge),
    /// A rational wedge.
    RationalWedge(RationalWedge),
    /// A transitional, rotational or twisted solid.
    Constructed(Box<ConstructedSolid>),
    /// A concave GB patch.
    GbPatch(Box<ConcavePatch>),
}

impl Geometry {
    /// The shape as a curve, if it is one.
    pub fn as_curve(&self) -> Option<&dyn ParametricCurve> {
        match self {
            Self::Curve(curve) => Some(curve),
            Self::RationalCurve(curve) => Some(curve),
            Self::PowerCurve(curve) => Some(curve),
            _ => None,
        }
    }

    /// The shape as a surface over a rectangle or a triangle, if it is one.
    pub fn as_surface(&self) -> Option<&dyn ParametricSurface> {
        match self {
            Self::Patch(patch) => Some(patch),
            Self::RationalPatch(patch) => Some(patch),
            Self::PowerPatch(patch) => Some(patch),
            Self::Triangle(triangle) => Some(triangle),
            Self::RationalTriangle(triangle) => Some(triangle),
            _ => None,
        }
    }

    /// The shape as a solid, if it is one.
    pub fn as_solid(&self) -> Option<&dyn ParametricSolid> {
        match self {
            Self::Tetrahedron(solid) => Some(solid),
            Self::RationalTetrahedron(solid) => Some(solid),
            Self::Hexahedron(solid) => Some(solid),
            Self::RationalHexahedron(solid) => Some(solid),
            Self::Wedge(solid) => Some(solid),
            Self::RationalWedge(solid) => Some(solid),
            Self::Constructed(solid) => Some(solid.hexahedron()),
            _ => None,
        }
    }

    /// The shape as a GB patch, if it is one.
    pub fn as_gb_patch(&self) -> Option<&ConcavePatch> {
        match self {
            Self::GbPatch(patch) => Some(patch),
            _ => None,
        }
    }

    /// Whether there is a denominator; that of a constructed solid is none where all weights are 1.
    pub fn is_rational(&self) -> bool {
        match self {
            Self::RationalCurve(_)
            | Self::RationalPatch(_)
            | Self::RationalTriangle(_)
            | Self::RationalTetrahedron(_)
            | Self::RationalHexahedron(_)
            | Self::RationalWedge(_) => true,
            Self::Constructed(solid) => solid.hexahedron().weights().any(|w| w != 1.0),
            _ => false,
        }
    }

    /// The box around the control points, which contains the shape over its domain.
    ///
    /// `None` where control points say nothing: weights of both signs or zero, and the power basis.
    pub fn control_box(&self) -> Option<BoundingBox> {
        match self {
            Self::Curve(curve) => Some(curve.bounding_box()),
            Self::RationalCurve(curve) => curve.hull_box(),
            Self::Patch(patch) => Some(patch.bounding_box()),
            Self::RationalPatch(patch) => patch.hull_box(),
            Self::Triangle(triangle) => Some(triangle.bounding_box()),
            Self::RationalTriangle(triangle) => triangle.hull_box(),
            Self::Tetrahedron(solid) => Some(solid.bounding_box()),
            Self::RationalTetrahedron(solid) => solid.hull_box(),
            Self::Hexahedron(solid) => Some(solid.bounding_box()),
            Self::RationalHexahedron(solid) => solid.hull_box(),
            Self::Wedge(solid) => Some(solid.bounding_box()),
            Self::RationalWedge(solid) => solid.hull_box(),
            Self::Constructed(solid) => solid.hexahedron().hull_box(),
            Self::GbPatch(patch) => Some(patch.bounding_box()),
            Self::PowerCurve(_) | Self::PowerPatch(_) => None,
        }
    }
}

impl NamedShape {
    /// The shape that is described.
    ///
    /// ```
    /// use casteljau_io::{Geometry, model::Model};
    /// use casteljau_shape::geom::glam::DVec3;
    /// let text = r#"{"casteljau": 1, "shapes": [{"kind": "curve", "degree": 2,
    ///   "control_points": [[1, 0, 0], [1, 1, 0], [0, 1, 0]], "weights": [1, 1, 2], "interval": [0, 4]}]}"#;
    /// let Geometry::RationalCurve(arc) = Model::read(text, "arc.json")?.shapes[0].to_geometry()? else {
    ///     return Ok(())
    /// };
    /// assert_eq!(arc.point(2.0)?, DVec3::new(0.6, 0.8, 0.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// What the shape's constructor refuses, at its place in the file. Cost: a copy of the net; for GB patches see
    /// [`to_patch`](Self::to_patch).
    pub fn to_geometry(&self) -> Result<Geometry, IoError> {
        let built = match &self.shape {
            Shape::Curve(record) => record.build(),
            Shape::PowerCurve(record) => record.build(),
            Shape::Patch(record) => record.build(),
            Shape::PowerPatch(record) => record.build(),
            Shape::Triangle(record) => record.build(),
            Shape::Tetrahedron(record) => record.build(),
            Shape::Hexahedron(record) => record.build(),
            Shape::Wedge(record) => record.build(),
            Shape::TransitionalSolid(record) => record.build(),
            Shape::RotationalSolid(record) => record.build(),
            Shape::TwistedSolid(record) => record.build(),
            Shape::GbPatch(_) => return Ok(Geometry::GbPatch(Box::new(self.to_patch()?))),
        };
        built.map_err(|fault| self.fault(fault))
    }
}
