//! The fields of solids that are made of patches and curves.

use casteljau_solid::Twist;
use serde::Deserialize;

use super::{Fields, Object, curve, patch};
use crate::construction_record::within;
use crate::model::Shape;
use crate::place::{Step, shorten};
use crate::record::Fault;
use crate::{CurveRecord, Part, PatchRecord, Reason, RotationalRecord, TransitionalRecord, TwistedRecord};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Transitional {
    #[serde(rename = "kind")]
    _kind: String,
    name: Option<String>,
    patch: Object<patch::Patch>,
    curve: Object<curve::Curve>,
}

impl Fields for Transitional {
    fn name(&mut self) -> Option<String> {
        self.name.take()
    }

    fn into_shape(self) -> Result<Shape, Fault> {
        let (patch, curve) = (patch_part(self.patch)?, curve_part(self.curve)?);
        Ok(Shape::TransitionalSolid(TransitionalRecord { patch, curve }))
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Rotational {
    #[serde(rename = "kind")]
    _kind: String,
    name: Option<String>,
    curve: Object<curve::Curve>,
}

impl Fields for Rotational {
    fn name(&mut self) -> Option<String> {
        self.name.take()
    }

    fn into_shape(self) -> Result<Shape, Fault> {
        Ok(Shape::RotationalSolid(RotationalRecord { curve: curve_part(self.curve)? }))
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Twisted {
    #[serde(rename = "kind")]
    _kind: String,
    name: Option<String>,
    patch: Object<patch::Patch>,
    curve: Object<curve::Curve>,
    angle: Option<f64>,
    rigid_angle: Option<f64>,
}

impl Fields for Twisted {
    fn name(&mut self) -> Option<String> {
        self.name.take()
    }

    fn into_shape(self) -> Result<Shape, Fault> {
        let twist = match (self.angle, self.rigid_angle) {
            (Some(angle), None) => Twist::PerLayer(angle),
            (None, Some(angle)) => Twist::Rigid(angle),
            (Some(_), Some(_)) => return Err((vec![Step::Field("rigid_angle")], Reason::TwoAngles)),
            (None, None) => return Err((Vec::new(), Reason::NoAngle)),
        };
        let (patch, curve) = (patch_part(self.patch)?, curve_part(self.curve)?);
        Ok(Shape::TwistedSolid(TwistedRecord { patch, curve, twist }))
    }
}

fn patch_part(Object(mut fields): Object<patch::Patch>) -> Result<Part<PatchRecord>, Fault> {
    check_kind("patch", fields.kind())?;
    let name = fields.name();
    let record = fields.into_record().map_err(|fault| within("patch", fault))?;
    Ok(Part { name, record })
}

fn curve_part(Object(mut fields): Object<curve::Curve>) -> Result<Part<CurveRecord>, Fault> {
    check_kind("curve", fields.kind())?;
    let name = fields.name();
    let record = fields.into_record().map_err(|fault| within("curve", fault))?;
    Ok(Part { name, record })
}

/// A part is of the kind that its field is called after, and need not say so.
fn check_kind(field: &'static str, kind: Option<&str>) -> Result<(), Fault> {
    match kind {
        Some(kind) if kind != field => {
            let reason = Reason::PartKind { expected: field, found: shorten(kind, 40) };
            Err((vec![Step::Field(field), Step::Field("kind")], reason))
        }
        _ => Ok(()),
    }
}
