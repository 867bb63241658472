//! Writing by hand, so that a row of control points is a line and not thirty.

use std::fmt::Debug;
use std::io::Write;

use super::{Model, Shape};
use crate::record::word;
use crate::shape_record::UNIT;
use crate::{
    CenterWeightName, CoordinatesName, CurveRecord, GbPatchRecord, IoError, LayoutRecord, NetRecord, Part,
    PatchRecord,
};

/// Blanks before the fields of a shape, and before those of a shape inside it.
const FIELD: usize = 6;
const PART_FIELD: usize = 8;

/// Writes a model that has been checked: all numbers are finite, so that `{:?}`, which is Rust's shortest round-trip
/// form, is JSON.
pub(super) fn write(model: &Model, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    write!(out, "{{\n  \"casteljau\": 1,\n  \"shapes\": [")?;
    for (index, shape) in model.shapes.iter().enumerate() {
        write!(out, "{}\n    {{", if index == 0 { "" } else { "," })?;
        write_head(shape.shape.kind(), shape.name.as_deref(), FIELD, out)?;
        write_fields(&shape.shape, out)?;
        write!(out, "\n    }}")?;
    }
    writeln!(out, "{}]\n}}", if model.shapes.is_empty() { "" } else { "\n  " })?;
    Ok(())
}

/// Kind and name.
fn write_head(
    kind: &str,
    name: Option<&str>,
    indent: usize,
    out: &mut (impl Write + ?Sized),
) -> Result<(), IoError> {
    write!(out, "\n{:indent$}\"kind\": \"{kind}\"", "")?;
    if let Some(name) = name {
        write_key("name", indent, out)?;
        serde_json::to_writer(&mut *out, name).map_err(std::io::Error::from)?;
    }
    Ok(())
}

/// The comma behind the field before, and the name of the next one.
fn write_key(field: &str, indent: usize, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    Ok(write!(out, ",\n{:indent$}\"{field}\": ", "")?)
}

/// Everything but kind and name, each field beginning with its comma.
fn write_fields(shape: &Shape, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    match shape {
        Shape::Curve(curve) => write_curve(curve, FIELD, out),
        Shape::PowerCurve(curve) => {
            write_list("coefficients", &curve.coefficients, &[], FIELD, out)?;
            write_interval("interval", curve.interval, FIELD, out)
        }
        Shape::Patch(patch) => write_patch(patch, FIELD, out),
        Shape::PowerPatch(patch) => {
            write_list("coefficients", &patch.coefficients, &[patch.degrees[1] + 1], FIELD, out)?;
            write_intervals(&patch.intervals, FIELD, out)
        }
        Shape::Triangle(triangle) => {
            write_value("degree", &triangle.degree, FIELD, out)?;
            write_net(&triangle.net, &[], FIELD, out)
        }
        Shape::Tetrahedron(solid) => {
            write_value("degree", &solid.degree, FIELD, out)?;
            write_net(&solid.net, &[], FIELD, out)
        }
        Shape::Hexahedron(solid) => {
            write_value("degree", &solid.degrees, FIELD, out)?;
            write_net(&solid.net, &solid.rows(), FIELD, out)?;
            write_intervals(&solid.intervals, FIELD, out)
        }
        Shape::Wedge(solid) => {
            write_value("degree", &solid.degrees, FIELD, out)?;
            write_net(&solid.net, &[solid.column()], FIELD, out)?;
            write_interval("interval", solid.interval, FIELD, out)
        }
        Shape::TransitionalSolid(solid) => {
            write_patch_part(&solid.patch, out)?;
            write_curve_part(&solid.curve, out)
        }
        Shape::RotationalSolid(solid) => write_curve_part(&solid.curve, out),
        Shape::TwistedSolid(solid) => {
            write_patch_part(&solid.patch, out)?;
            write_curve_part(&solid.curve, out)?;
            let (field, angle) = solid.angle();
            write_value(field, &angle, FIELD, out)
        }
        Shape::GbPatch(record) => write_gb_patch(record, out),
    }
}

fn write_curve(curve: &CurveRecord, indent: usize, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    write_value("degree", &curve.net.len().saturating_sub(1), indent, out)?;
    write_net(&curve.net, &[], indent, out)?;
    write_interval("interval", curve.interval, indent, out)
}

fn write_patch(patch: &PatchRecord, indent: usize, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    write_value("degree", &patch.degrees, indent, out)?;
    write_net(&patch.net, &[patch.degrees[1] + 1], indent, out)?;
    write_intervals(&patch.intervals, indent, out)
}

fn write_curve_part(part: &Part<CurveRecord>, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    write_key("curve", FIELD, out)?;
    write!(out, "{{")?;
    write_head("curve", part.name.as_deref(), PART_FIELD, out)?;
    write_curve(&part.record, PART_FIELD, out)?;
    Ok(write!(out, "\n{:FIELD$}}}", "")?)
}

fn write_patch_part(part: &Part<PatchRecord>, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    write_key("patch", FIELD, out)?;
    write!(out, "{{")?;
    write_head("patch", part.name.as_deref(), PART_FIELD, out)?;
    write_patch(&part.record, PART_FIELD, out)?;
    Ok(write!(out, "\n{:FIELD$}}}", "")?)
}

/// The net in the form that it has, nested in rows as for [`write_list`].
fn write_net(
    net: &NetRecord,
    rows: &[usize],
    indent: usize,
    out: &mut (impl Write + ?Sized),
) -> Result<(), IoError> {
    match net {
        NetRecord::Points(points) => write_list("control_points", points, rows, indent, out),
        NetRecord::Weighted { points, weights } => {
            write_list("control_points", points, rows, indent, out)?;
            write_list("weights", weights, rows, indent, out)
        }
        NetRecord::Homogeneous(points) => write_list("homogeneous", points, rows, indent, out),
    }
}

/// A field whose `{:?}` is JSON, as that of numbers and of arrays of them is.
fn write_value(
    field: &str,
    value: &(impl Debug + ?Sized),
    indent: usize,
    out: &mut (impl Write + ?Sized),
) -> Result<(), IoError> {
    write_key(field, indent, out)?;
    Ok(write!(out, "{value:?}")?)
}

/// A field of numbers or points: on one line; one row a line, given the length of a row; slabs of rows, given the number of
/// rows in a slab and their length.
fn write_list<T: Debug>(
    field: &str,
    items: &[T],
    rows: &[usize],
    indent: usize,
    out: &mut (impl Write + ?Sized),
) -> Result<(), IoError> {
    let Some((&last, outer)) = rows.split_last() else {
        return write_value(field, items, indent, out);
    };
    write_key(field, indent, out)?;
    write!(out, "[")?;
    // What is not nested further is one slab without brackets.
    let (open, close) = if outer.is_empty() { ("", "") } else { ("[", "]") };
    let slab = if outer.is_empty() { items.len() } else { outer.iter().product::<usize>() * last };
    for (index, slab) in items.chunks(slab.max(1)).enumerate() {
        for (line, row) in slab.chunks(last.max(1)).enumerate() {
            let comma = if index + line == 0 { "" } else { "," };
            let bracket = match line {
                0 => open,
                // As wide as the bracket, for the eye.
                _ if !open.is_empty() => " ",
                _ => "",
            };
            // The comma between slabs stands behind the bracket that closes the one before.
            write!(out, "{comma}\n{:indent$}  {bracket}{row:?}", "")?;
        }
        write!(out, "{close}")?;
    }
    Ok(write!(out, "\n{:indent$}]", "")?)
}

/// An interval, unless it is what a file without it means; −0 is not 0 here.
fn write_interval(
    field: &str,
    ends: [f64; 2],
    indent: usize,
    out: &mut (impl Write + ?Sized),
) -> Result<(), IoError> {
    match is_unit(&ends) {
        true => Ok(()),
        false => write_value(field, &ends, indent, out),
    }
}

fn write_intervals(
    intervals: &[[f64; 2]],
    indent: usize,
    out: &mut (impl Write + ?Sized),
) -> Result<(), IoError> {
    match intervals.iter().all(is_unit) {
        true => Ok(()),
        false => write_value("intervals", intervals, indent, out),
    }
}

fn is_unit(ends: &[f64; 2]) -> bool {
    ends.map(f64::to_bits) == UNIT.map(f64::to_bits)
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
