//! From descriptions to patches and back; what the patch refuses is placed in the file.

use casteljau_gb::glam::{DVec2, DVec3};
use casteljau_gb::{
    CenterWeight, ConcavePatch, ConcavePatchBuilder, CoordinateKind, GbError, LayoutKind, Polygon, Ribbon,
};

use crate::model::{NamedShape, Shape};
use crate::place::Step;
use crate::record::Fault;
use crate::{
    CenterWeightName, CoordinatesName, CornerPointRecord, GbPatchRecord, IoError, LayoutRecord, Reason,
    RibbonRecord,
};

impl NamedShape {
    /// The builder of the patch that is described, for further options; [`placed`](Self::placed) puts file and line to
    /// what its `build` refuses.
    ///
    /// Error: a shape of another kind; a ribbon or a domain polygon that is none, at its place in the file.
    pub fn patch_builder(&self) -> Result<ConcavePatchBuilder, IoError> {
        let Shape::GbPatch(record) = &self.shape else {
            let reason = Reason::NotGbPatch { kind: self.shape.kind() };
            return Err(self.fault((vec![Step::Field("kind")], reason)));
        };
        record.check().and_then(|()| builder(record)).map_err(|fault| self.fault(fault))
    }

    /// The patch that is described, with coordinates of the default accuracy.
    ///
    /// Error: what the builder or the patch refuse, at its place in the file.
    /// Cost: that of the coordinates, some 10 ms for harmonic ones.
    ///
    /// ```
    /// use casteljau_io::model::Model;
    /// let text = r#"{"casteljau": 1, "shapes": [{"kind": "gb_patch", "ribbons": [
    ///   {"control_points": [[[0, 0, 0], [1, 0, 0]]]},
    ///   {"control_points": [[[1, 0, 0], [0, 1, 0]]]},
    ///   {"control_points": [[[0, 1, 0], [0, 0, 0.1]]]}]}]}"#;
    /// let error = Model::read(text, "tile.json")?.shapes[0].to_patch().unwrap_err();
    /// assert!(error.to_string().starts_with("tile.json:2:"), "{error}");
    /// assert!(error.to_string().contains("shapes[0].ribbons[0]: side 2 ends 1.000e-1 away from the start of side 0"));
    /// # Ok::<(), casteljau_io::IoError>(())
    /// ```
    pub fn to_patch(&self) -> Result<ConcavePatch, IoError> {
        self.patch_builder()?.build().map_err(|error| self.placed(error))
    }

    /// An error of the patch as an error of the file: with the place of what it is about.
    pub fn placed(&self, error: GbError) -> IoError {
        let steps = match &self.shape {
            Shape::GbPatch(record) => part(&error, record),
            _ => Vec::new(),
        };
        self.fault((steps, Reason::Geometry(Box::new(error))))
    }

    pub(crate) fn fault(&self, (steps, reason): Fault) -> IoError {
        IoError::invalid(self.place_of(&steps), reason)
    }
}

/// The part of the description that an error of the patch is about; nothing if it is about the whole.
fn part(error: &GbError, record: &GbPatchRecord) -> Vec<Step> {
    let ribbon = |side: usize| vec![Step::Field("ribbons"), Step::Index(side)];
    let corner_point = |corner: usize| {
        let index = record.corner_points.iter().position(|entry| entry.corner == corner);
        index.map_or(Vec::new(), |index| vec![Step::Field("corner_points"), Step::Index(index)])
    };
    match error {
        GbError::ZeroLengthSide { side, .. } => ribbon(*side),
        GbError::CornerGap { next, .. } => ribbon(*next),
        // Corner i is where side i ends.
        GbError::EqualCorners { second, .. } => ribbon(*second),
        GbError::BlendPower { .. } => vec![Step::Field("blend_power")],
        GbError::MissingCenter { .. } | GbError::CenterWeightOnBoundary { .. } => {
            vec![Step::Field("center_weight")]
        }
        GbError::Point { place: casteljau_gb::Place::Center, .. } => vec![Step::Field("center")],
        GbError::CornerPointOnBoundary { corner, .. }
        | GbError::NoSuchCorner { corner, .. }
        | GbError::RepeatedCornerPoint { corner }
        | GbError::Point { place: casteljau_gb::Place::CornerPoint { corner }, .. } => corner_point(*corner),
        GbError::DomainSize { .. } | GbError::Domain(_)
            if matches!(record.layout, LayoutRecord::Given(_)) =>
        {
            vec![Step::Field("domain")]
        }
        _ => Vec::new(),
    }
}

/// Of a description that has been checked.
fn builder(record: &GbPatchRecord) -> Result<ConcavePatchBuilder, Fault> {
    let ribbons = record.ribbons.iter().enumerate().map(|(side, ribbon)| {
        let rows = &ribbon.control_points;
        let degree = rows.first().map_or(0, Vec::len).saturating_sub(1);
        let points = rows.iter().flatten().map(|&p| DVec3::from(p)).collect();
        Ribbon::new(degree, rows.len(), points).map_err(|source| {
            let steps = [Step::Field("ribbons"), Step::Index(side), Step::Field("control_points")];
            let point = match source {
                GbError::Point { place: casteljau_gb::Place::Ribbon { j, k }, .. } => {
                    vec![Step::Index(k), Step::Index(j)]
                }
                _ => Vec::new(),
            };
            ([&steps[..], &point].concat(), Reason::Ribbon { side, source: Box::new(source) })
        })
    });
    let mut builder = ConcavePatch::builder(ribbons.collect::<Result<_, _>>()?);
    builder = match &record.layout {
        LayoutRecord::Projection => builder.layout(LayoutKind::Projection),
        LayoutRecord::Heuristic => builder.layout(LayoutKind::Heuristic),
        LayoutRecord::Regular => builder.layout(LayoutKind::Regular),
        LayoutRecord::Given(vertices) => {
            let polygon = Polygon::new(vertices.iter().map(|&uv| DVec2::from(uv)).collect());
            builder.domain(polygon.map_err(|error| {
                let error = GbError::from(error);
                (part(&error, record), Reason::Geometry(Box::new(error)))
            })?)
        }
    };
    builder = builder.coordinates(match record.coordinates {
        CoordinatesName::Harmonic => CoordinateKind::Harmonic,
        CoordinatesName::Wachspress => CoordinateKind::Wachspress,
        CoordinatesName::MeanValue => CoordinateKind::MeanValue,
    });
    builder = builder.blend_power(record.blend_power).center_weight(match record.center_weight {
        CenterWeightName::None => CenterWeight::None,
        CenterWeightName::Deficiency => CenterWeight::Deficiency,
        CenterWeightName::Nth => CenterWeight::Nth,
        CenterWeightName::Harmonic => CenterWeight::Harmonic,
    });
    if let Some(center) = record.center {
        builder = builder.center(center.into());
    }
    for entry in &record.corner_points {
        builder = builder.corner_point(entry.corner, entry.point.into());
    }
    Ok(builder)
}

/// The description of a patch, for writing it.
///
/// A domain polygon that the caller gave is written out; one that was laid out is described by the kind of its layout,
/// which makes the same polygon again.
impl From<&ConcavePatch> for GbPatchRecord {
    fn from(patch: &ConcavePatch) -> Self {
        let ribbon = |ribbon: &Ribbon| RibbonRecord {
            control_points: (0..ribbon.layers())
                .map(|k| ribbon.row(k).iter().map(DVec3::to_array).collect())
                .collect(),
        };
        Self {
            ribbons: patch.ribbons().iter().map(ribbon).collect(),
            layout: match patch.layout() {
                LayoutKind::Projection => LayoutRecord::Projection,
                LayoutKind::Heuristic => LayoutRecord::Heuristic,
                LayoutKind::Regular => LayoutRecord::Regular,
                _ => LayoutRecord::Given(patch.domain().vertices().iter().map(DVec2::to_array).collect()),
            },
            coordinates: match patch.coordinates().kind() {
                CoordinateKind::Wachspress => CoordinatesName::Wachspress,
                CoordinateKind::MeanValue => CoordinatesName::MeanValue,
                _ => CoordinatesName::Harmonic,
            },
            blend_power: patch.blend_power(),
            center: patch.center().map(|center| center.to_array()),
            center_weight: match patch.center_weight() {
                CenterWeight::Deficiency => CenterWeightName::Deficiency,
                CenterWeight::Nth => CenterWeightName::Nth,
                CenterWeight::Harmonic => CenterWeightName::Harmonic,
                _ => CenterWeightName::None,
            },
            corner_points: patch
                .corner_points()
                .iter()
                .map(|entry| CornerPointRecord { corner: entry.corner, point: entry.point.to_array() })
                .collect(),
        }
    }
}
