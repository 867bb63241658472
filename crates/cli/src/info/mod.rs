//! `casteljau info`: what is in a file.

mod classical;
mod gb_patch;
mod solid;

use casteljau::geom::BoundingBox;
use casteljau::io::Geometry;
use serde::Serialize;

use crate::arguments::Selection;
use crate::failure::Failure;
use crate::input::Input;
use crate::output::Lines;

/// A box.
#[derive(Serialize)]
struct Bounds {
    min: [f64; 3],
    max: [f64; 3],
}

impl From<BoundingBox> for Bounds {
    fn from(bounds: BoundingBox) -> Self {
        Self { min: bounds.min.to_array(), max: bounds.max.to_array() }
    }
}

pub fn run(options: &Selection, json: bool) -> Result<(), Failure> {
    let input = Input::read(options)?;
    let mut lines = Lines::new();
    let mut shapes = Vec::new();
    for entry in &input.shapes {
        let (shape, named) = (entry.0, &entry.1);
        let geometry = input.geometry(named)?;
        let title = Input::title(entry);
        if let Geometry::GbPatch(patch) = &geometry {
            let description = gb_patch::describe(shape, named, patch, &input.name)?;
            match json {
                true => lines.json(&description)?,
                false => gb_patch::text(&description, &title, &mut lines)?,
            }
        } else if let Some(description) = solid::describe(shape, named, &geometry) {
            match json {
                true => lines.json(&description)?,
                false => solid::text(&description, &title, &mut lines)?,
            }
        } else {
            let description = classical::describe(shape, named, &geometry)?;
            match json {
                true => lines.json(&description)?,
                false => classical::text(&description, &title, &mut lines)?,
            }
        }
        shapes.push(geometry);
    }
    let patches: Option<Vec<_>> = shapes.iter().map(Geometry::as_gb_patch).collect();
    if let Some(patches) = patches.filter(|patches| !json && patches.len() > 1) {
        gb_patch::whole(&patches, &input.name, &mut lines)?;
    }
    lines.finish()
}
