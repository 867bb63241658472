//! Writing by hand, so that a row of control points is a line and not thirty.

use std::io::Write;

use super::{Model, Shape};
use crate::record::word;
use crate::shape_record::UNIT;
use crate::{CenterWeightName, CoordinatesName, GbPatchRecord, IoError, LayoutRecord, NetRecord};

/// Writes a model that has been checked: all numbers are finite, so that `{:?}`, which is Rust's shortest round-trip
/// form, is JSON.
pub(super) fn write(model: &Model, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    write!(out, "{{\n  \"casteljau\": 1,\n  \"shapes\": [")?;
    for (index, shape) in model.shapes.iter().enumerate() {
        write!(out, "{}\n    ", if index == 0 { "" } else { "," })?;
        write!(out, "{{\n      \"kind\": \"{}\"", shape.shape.kind())?;
        if let Some(name) = &shape.name {
            write!(out, ",\n      \"name\": ")?;
            serde_json::to_writer(&mut *out, name).map_err(std::io::Error::from)?;
        }
        write_fields(&shape.shape, out)?;
        write!(out, "\n    }}")?;
    }
    writeln!(out, "{}]\n}}", if model.shapes.is_empty() { "" } else { "\n  " })?;
    Ok(())
}

/// Everything but kind and name, each field beginning with its comma.
fn write_fields(shape: &Shape, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    match shape {
        Shape::Curve(curve) => {
            write!(out, ",\n      \"degree\": {}", curve.net.len().saturating_sub(1))?;
            write_net(&curve.net, None, out)?;
            write_intervals("interval", &curve.interval, &UNIT, out)
        }
        Shape::PowerCurve(curve) => {
            write_list("coefficients", &curve.coefficients, None, out)?;
            write_intervals("interval", &curve.interval, &UNIT, out)
        }
        Shape::Patch(patch) => {
            write!(out, ",\n      \"degree\": {:?}", patch.degrees)?;
            write_net(&patch.net, Some(patch.degrees[1] + 1), out)?;
            write_intervals("intervals", patch.intervals.as_flattened(), [UNIT; 2].as_flattened(), out)
        }
        Shape::PowerPatch(patch) => {
            write_list("coefficients", &patch.coefficients, Some(patch.degrees[1] + 1), out)?;
            write_intervals("intervals", patch.intervals.as_flattened(), [UNIT; 2].as_flattened(), out)
        }
        Shape::Triangle(triangle) => {
            write!(out, ",\n      \"degree\": {}", triangle.degree)?;
            write_net(&triangle.net, None, out)
        }
        Shape::GbPatch(record) => write_gb_patch(record, out),
    }
}

/// The net in the form that it has; nested where a length of rows is given.
fn write_net(net: &NetRecord, row: Option<usize>, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    match net {
        NetRecord::Points(points) => write_list("control_points", points, row, out),
        NetRecord::Weighted { points, weights } => {
            write_list("control_points", points, row, out)?;
            write_list("weights", weights, row, out)
        }
        NetRecord::Homogeneous(points) => write_list("homogeneous", points, row, out),
    }
}

/// A field of numbers or points: on one line, or one row a line.
fn write_list<T: std::fmt::Debug>(
    field: &str,
    items: &[T],
    row: Option<usize>,
    out: &mut (impl Write + ?Sized),
) -> Result<(), IoError> {
    // `{:?}` of a slice of numbers, or of arrays of them, is JSON.
    let Some(row) = row else {
        return Ok(write!(out, ",\n      \"{field}\": {items:?}")?);
    };
    write!(out, ",\n      \"{field}\": [")?;
    for (index, items) in items.chunks(row).enumerate() {
        write!(out, "{}\n        {items:?}", if index == 0 { "" } else { "," })?;
    }
    Ok(write!(out, "\n      ]")?)
}

/// Intervals, unless they are what a file without them means; −0 is not 0 here.
fn write_intervals(
    field: &str,
    ends: &[f64],
    default: &[f64],
    out: &mut (impl Write + ?Sized),
) -> Result<(), IoError> {
    if ends.iter().map(|x| x.to_bits()).eq(default.iter().map(|x| x.to_bits())) {
        return Ok(());
    }
    match ends {
        [a, b, c, d] => write!(out, ",\n      \"{field}\": [[{a:?}, {b:?}], [{c:?}, {d:?}]]")?,
        _ => write!(out, ",\n      \"{field}\": {ends:?}")?,
    }
    Ok(())
}

fn write_gb_patch(record: &GbPatchRecord, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
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
