//! The fields of a GB patch.

use serde::Deserialize;

use super::{Fields, Object};
use crate::model::Shape;
use crate::place::{Step, shorten};
use crate::record::Fault;
use crate::{
    CenterWeightName, CoordinatesName, CornerPointRecord, GbPatchRecord, LayoutRecord, Reason, RibbonRecord,
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GbPatch {
    #[serde(rename = "kind")]
    _kind: String,
    #[serde(rename = "form")]
    _form: Option<String>,
    name: Option<String>,
    ribbons: Vec<Object<Ribbon>>,
    layout: Option<String>,
    domain: Option<Vec<[f64; 2]>>,
    coordinates: Option<String>,
    blend_power: Option<u32>,
    center: Option<[f64; 3]>,
    center_weight: Option<String>,
    #[serde(default)]
    corner_points: Vec<Object<CornerPoint>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Ribbon {
    control_points: Vec<Vec<[f64; 3]>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CornerPoint {
    corner: usize,
    point: [f64; 3],
}

impl Fields for GbPatch {
    fn name(&mut self) -> Option<String> {
        self.name.take()
    }

    fn into_shape(self) -> Result<Shape, Fault> {
        let record = self.into_record().map_err(|(field, reason)| (vec![Step::Field(field)], reason))?;
        Ok(Shape::GbPatch(record))
    }
}

impl GbPatch {
    /// Fills in the defaults; names the field that is too much.
    fn into_record(self) -> Result<GbPatchRecord, (&'static str, Reason)> {
        let default = GbPatchRecord::default();
        let layout = match (self.layout, self.domain) {
            (Some(_), Some(_)) => return Err(("domain", Reason::LayoutAndDomain)),
            (None, Some(domain)) => LayoutRecord::Given(domain),
            (word, None) => named("layout", word, &LayoutRecord::WORDS, default.layout)?,
        };
        let coordinates =
            named("coordinates", self.coordinates, &CoordinatesName::WORDS, default.coordinates)?;
        let center_weight =
            named("center_weight", self.center_weight, &CenterWeightName::WORDS, default.center_weight)?;
        let ribbons = self.ribbons.into_iter().map(|r| RibbonRecord { control_points: r.0.control_points });
        let corners = self
            .corner_points
            .into_iter()
            .map(|c| CornerPointRecord { corner: c.0.corner, point: c.0.point });
        Ok(GbPatchRecord {
            ribbons: ribbons.collect(),
            layout,
            coordinates,
            blend_power: self.blend_power.unwrap_or(default.blend_power),
            center: self.center,
            center_weight,
            corner_points: corners.collect(),
        })
    }
}

/// The value that a word stands for.
fn named<T: Clone>(
    field: &'static str,
    word: Option<String>,
    known: &[(&'static str, T)],
    default: T,
) -> Result<T, (&'static str, Reason)> {
    let Some(word) = word else { return Ok(default) };
    match known.iter().find(|(name, _)| *name == word) {
        Some((_, value)) => Ok(value.clone()),
        None => {
            let known = known.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
            Err((field, Reason::Word { found: shorten(&word, 40), known }))
        }
    }
}
