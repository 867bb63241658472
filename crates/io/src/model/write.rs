//! Writing by hand, so that a row of control points is a line and not thirty.

use std::io::Write;

use super::{Model, NamedShape, Shape};
use crate::record::word;
use crate::{CenterWeightName, CoordinatesName, GbPatchRecord, IoError, LayoutRecord};

/// Writes a model that has been checked: all numbers are finite, so that `{:?}`, which is Rust's shortest round-trip
/// form, is JSON.
pub(super) fn write(model: &Model, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    write!(out, "{{\n  \"casteljau\": 1,\n  \"shapes\": [")?;
    for (index, shape) in model.shapes.iter().enumerate() {
        write!(out, "{}\n    ", if index == 0 { "" } else { "," })?;
        let NamedShape { name, shape: Shape::GbPatch(record), .. } = shape;
        write_gb_patch(name.as_deref(), record, out)?;
    }
    writeln!(out, "{}]\n}}", if model.shapes.is_empty() { "" } else { "\n  " })?;
    Ok(())
}

fn write_gb_patch(
    name: Option<&str>,
    record: &GbPatchRecord,
    out: &mut (impl Write + ?Sized),
) -> Result<(), IoError> {
    write!(out, "{{\n      \"kind\": \"gb_patch\"")?;
    if let Some(name) = name {
        write!(out, ",\n      \"name\": ")?;
        serde_json::to_writer(&mut *out, name).map_err(std::io::Error::from)?;
    }
    write!(out, ",\n      \"form\": \"concave\",\n      \"ribbons\": [")?;
    for (side, ribbon) in record.ribbons.iter().enumerate() {
        write!(out, "{}\n        {{\"control_points\": [", if side == 0 { "" } else { "," })?;
        for (row, points) in ribbon.control_points.iter().enumerate() {
            write!(out, "{}\n          ", if row == 0 { "" } else { "," })?;
            write_points(points, out)?;
        }
        write!(out, "\n        ]}}")?;
    }
    write!(out, "\n      ],\n      ")?;
    match &record.layout {
        LayoutRecord::Given(domain) => {
            write!(out, "\"domain\": ")?;
            write_points(domain, out)?;
        }
        layout => write!(out, "\"layout\": \"{}\"", word(&LayoutRecord::WORDS, layout))?,
    }
    let coordinates = word(&CoordinatesName::WORDS, &record.coordinates);
    write!(
        out,
        ",\n      \"coordinates\": \"{coordinates}\",\n      \"blend_power\": {}",
        record.blend_power
    )?;
    if let Some(center) = &record.center {
        write!(out, ",\n      \"center\": {center:?}")?;
    }
    let weight = word(&CenterWeightName::WORDS, &record.center_weight);
    write!(out, ",\n      \"center_weight\": \"{weight}\"")?;
    if !record.corner_points.is_empty() {
        write!(out, ",\n      \"corner_points\": [")?;
        for (index, entry) in record.corner_points.iter().enumerate() {
            let comma = if index == 0 { "" } else { "," };
            write!(out, "{comma}\n        {{\"corner\": {}, \"point\": {:?}}}", entry.corner, entry.point)?;
        }
        write!(out, "\n      ]")?;
    }
    write!(out, "\n    }}")?;
    Ok(())
}

/// `[[x, y, z], …]` on one line.
fn write_points<const N: usize>(points: &[[f64; N]], out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    write!(out, "[")?;
    for (index, point) in points.iter().enumerate() {
        write!(out, "{}{point:?}", if index == 0 { "" } else { ", " })?;
    }
    write!(out, "]")?;
    Ok(())
}
