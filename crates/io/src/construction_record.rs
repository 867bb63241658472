//! Solids as files describe them by what they are made of.

use casteljau_shape::{RationalCurve, RationalPatch};
use casteljau_solid::{ConstructedSolid, Construction, SolidError, Twist};

use crate::model::Shape;
use crate::place::Step;
use crate::record::Fault;
use crate::{CurveRecord, Geometry, PatchRecord, Reason};

/// A shape that a solid is made of, and its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Part<R> {
    /// The name, if it has one.
    pub name: Option<String>,
    /// The shape.
    pub record: R,
}

impl<R> From<R> for Part<R> {
    /// Without a name.
    fn from(record: R) -> Self {
        Self { name: None, record }
    }
}

/// A patch translated along a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct TransitionalRecord {
    /// The patch.
    pub patch: Part<PatchRecord>,
    /// The curve.
    pub curve: Part<CurveRecord>,
}

/// A curve rotated about the z axis.
#[derive(Clone, Debug, PartialEq)]
pub struct RotationalRecord {
    /// The meridian.
    pub curve: Part<CurveRecord>,
}

/// A patch translated along a curve and turned about the z axis.
#[derive(Clone, Debug, PartialEq)]
pub struct TwistedRecord {
    /// The patch.
    pub patch: Part<PatchRecord>,
    /// The curve.
    pub curve: Part<CurveRecord>,
    /// How it is turned: `angle` of the file per layer of control points, `rigid_angle` in all.
    pub twist: Twist,
}

impl TransitionalRecord {
    pub(crate) fn build(&self) -> Result<Geometry, Fault> {
        let (patch, curve) = (patch(&self.patch)?, curve(&self.curve)?);
        built(Construction::Transitional { patch, curve }, None)
    }
}

impl RotationalRecord {
    pub(crate) fn build(&self) -> Result<Geometry, Fault> {
        built(Construction::Rotational { curve: curve(&self.curve)? }, None)
    }
}

impl TwistedRecord {
    pub(crate) fn build(&self) -> Result<Geometry, Fault> {
        let (patch, curve) = (patch(&self.patch)?, curve(&self.curve)?);
        built(Construction::Twisted { patch, curve, twist: self.twist }, Some(self.angle().0))
    }

    /// The field that holds the angle, and the angle.
    pub(crate) fn angle(&self) -> (&'static str, f64) {
        match self.twist {
            Twist::PerLayer(angle) => ("angle", angle),
            Twist::Rigid(angle) => ("rigid_angle", angle),
        }
    }
}

fn patch(part: &Part<PatchRecord>) -> Result<RationalPatch, Fault> {
    match part.record.build().map_err(|fault| within("patch", fault))? {
        Geometry::Patch(patch) => Ok(patch.into()),
        Geometry::RationalPatch(patch) => Ok(patch),
        _ => Err((vec![Step::Field("patch")], Reason::NoNet)),
    }
}

fn curve(part: &Part<CurveRecord>) -> Result<RationalCurve, Fault> {
    match part.record.build().map_err(|fault| within("curve", fault))? {
        Geometry::Curve(curve) => Ok(curve.into()),
        Geometry::RationalCurve(curve) => Ok(curve),
        _ => Err((vec![Step::Field("curve")], Reason::NoNet)),
    }
}

/// A fault of a part, its steps leading on from the whole.
pub(crate) fn within(field: &'static str, (steps, reason): Fault) -> Fault {
    ([vec![Step::Field(field)], steps].concat(), reason)
}

/// The solid. What it refuses is said of the angle where it is about that, otherwise of the whole.
fn built(construction: Construction, angle: Option<&'static str>) -> Result<Geometry, Fault> {
    let solid = ConstructedSolid::new(construction).map_err(|error| {
        let steps = match error {
            SolidError::Construction { what: "angle of the twist", .. } | SolidError::Kernel(_) => {
                angle.map(Step::Field).into_iter().collect()
            }
            SolidError::Construction { .. } => vec![Step::Field("curve")],
            _ => Vec::new(),
        };
        (steps, Reason::Solid(Box::new(error)))
    })?;
    Ok(Geometry::Constructed(Box::new(solid)))
}

/// The description of a constructed solid by what it is made of, whose nets are written homogeneous.
impl From<&Construction> for Shape {
    fn from(construction: &Construction) -> Self {
        match construction {
            Construction::Transitional { patch, curve } => Self::TransitionalSolid(TransitionalRecord {
                patch: PatchRecord::from(patch).into(),
                curve: CurveRecord::from(curve).into(),
            }),
            Construction::Rotational { curve } => {
                Self::RotationalSolid(RotationalRecord { curve: CurveRecord::from(curve).into() })
            }
            Construction::Twisted { patch, curve, twist } => Self::TwistedSolid(TwistedRecord {
                patch: PatchRecord::from(patch).into(),
                curve: CurveRecord::from(curve).into(),
                twist: *twist,
            }),
        }
    }
}
