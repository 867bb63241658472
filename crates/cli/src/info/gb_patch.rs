use casteljau::gb::{ConcavePatch, Ribbon};
use casteljau::io::model::NamedShape;
use casteljau::tess::{TessellationOptions, tessellate};
use serde::Serialize;

use super::Bounds;
use crate::failure::Failure;
use crate::number::{brief, human, tuple};
use crate::output::Lines;
use crate::progress::Progress;
use crate::words;

/// Samples a side of the coarser of the two meshes that area and volume are found from.
const RESOLUTION: usize = 32;

/// A GB patch. `bounds` is the box of its control points; `area_error` an estimate; an open shape has no volume.
#[derive(Serialize)]
pub struct Description {
    shape: usize,
    kind: &'static str,
    name: Option<String>,
    sides: usize,
    degrees: Vec<usize>,
    layers: Vec<usize>,
    blend_power: u32,
    layout: &'static str,
    coordinates: &'static str,
    certificate: f64,
    center: Option<[f64; 3]>,
    center_weight: &'static str,
    corner_points: usize,
    continuity: Vec<String>,
    bounds: Bounds,
    area: f64,
    area_error: f64,
    volume: Option<f64>,
}

pub fn describe(
    shape: usize,
    named: &NamedShape,
    patch: &ConcavePatch,
    file: &str,
) -> Result<Description, Failure> {
    let ([area, area_error], volume) = measures(&[patch], file)?;
    Ok(Description {
        shape,
        kind: named.shape.kind(),
        name: named.name.clone(),
        sides: patch.sides(),
        degrees: patch.ribbons().iter().map(Ribbon::degree).collect(),
        layers: patch.ribbons().iter().map(Ribbon::layers).collect(),
        blend_power: patch.blend_power(),
        layout: words::layout(patch),
        coordinates: words::coordinates(patch),
        certificate: patch.coordinates().certificate(),
        center: patch.center().map(|p| p.to_array()),
        center_weight: words::center_weight(patch),
        corner_points: patch.corner_points().len(),
        continuity: patch.continuity().iter().map(|c| format!("G{}", c.geometric())).collect(),
        bounds: patch.bounding_box().into(),
        area,
        area_error,
        volume: volume.map(|[volume, _]| volume),
    })
}

/// A number and an estimate of its error.
type Estimate = [f64; 2];

/// Area, and the volume of what is closed, from meshes of two resolutions: inscribed triangles miss O(h²).
fn measures(patches: &[&ConcavePatch], name: &str) -> Result<(Estimate, Option<Estimate>), Failure> {
    let mut progress = Progress::new("measuring");
    let mut at = |resolution: usize, [from, to]: [f64; 2]| -> Result<(f64, Option<f64>), Failure> {
        let options = TessellationOptions { normals: false, ..TessellationOptions::resolution(resolution) };
        let mut tell = |fraction: f64| progress.tell(from + (to - from) * fraction);
        let (mesh, report) = tessellate(patches, &options, &mut tell)
            .map_err(|error| Failure::Bad(format!("{name}: {error}")))?;
        let volume = if report.is_closed() { Some(mesh.signed_volume()?) } else { None };
        Ok((mesh.area()?, volume))
    };
    let coarse = at(RESOLUTION, [0.0, 0.2])?;
    let fine = at(2 * RESOLUTION, [0.2, 1.0])?;
    let extrapolated = |coarse: f64, fine: f64| {
        let missing = (fine - coarse) / 3.0;
        [fine + missing, missing.abs()]
    };
    let volume = coarse.1.zip(fine.1).map(|(coarse, fine)| extrapolated(coarse, fine));
    Ok((extrapolated(coarse.0, fine.0), volume))
}

fn estimate([value, error]: Estimate) -> String {
    format!("{} ± {}", human(value), brief(error))
}

/// What the shapes of a file are together; a line for a person only.
pub fn whole(patches: &[&ConcavePatch], file: &str, lines: &mut Lines) -> Result<(), Failure> {
    let (area, volume) = measures(patches, file)?;
    let count = patches.len();
    lines.text(&match volume {
        Some(volume) => {
            format!("together {count} shapes, closed: area {}, volume {}", estimate(area), estimate(volume))
        }
        None => format!("together {count} shapes, open: area {}", estimate(area)),
    })
}

pub fn text(description: &Description, title: &str, lines: &mut Lines) -> Result<(), Failure> {
    let list = |values: &[usize]| {
        let words: Vec<String> = values.iter().map(usize::to_string).collect();
        words.join(" ")
    };
    let Description { kind, sides, layout, coordinates, .. } = description;
    lines.text(&format!("{title}: {kind}, {sides} sides"))?;
    lines.text(&format!("  degrees      {}", list(&description.degrees)))?;
    lines.text(&format!("  layers       {}", list(&description.layers)))?;
    lines.text(&format!("  blend power  {}", description.blend_power))?;
    lines.text(&format!("  continuity   {}", description.continuity.join(" ")))?;
    let certificate = brief(description.certificate);
    lines.text(&format!("  domain       {layout}, {coordinates} coordinates right to {certificate}"))?;
    if let Some(center) = &description.center {
        lines.text(&format!("  center       {}, weight {}", tuple(center), description.center_weight))?;
    }
    if description.corner_points > 0 {
        lines.text(&format!("  corners      {} extra control points", description.corner_points))?;
    }
    lines.text(&format!(
        "  bounds       {} to {}",
        tuple(&description.bounds.min),
        tuple(&description.bounds.max)
    ))?;
    lines.text(&format!("  area         {}", estimate([description.area, description.area_error])))?;
    match description.volume {
        Some(volume) => lines.text(&format!("  volume       {}", human(volume))),
        None => lines.text("  volume       none, the shape is open"),
    }
}
