//! From a model file to a mesh: `cargo run -p casteljau --example mesh -- models/u.json`.

use casteljau::prelude::*;
use casteljau::tess::{TessellationOptions, no_progress, tessellate};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).ok_or("usage: mesh MODEL")?;
    let (model, _warnings) = read_model_file(path.as_ref())?;
    let patches = model.shapes.iter().map(NamedShape::to_patch).collect::<Result<Vec<_>, _>>()?;
    let (mesh, report) = tessellate(&patches, &TessellationOptions::tolerance(0.05), &mut no_progress)?;
    println!("{} triangles, area {:.3}, closed: {}", mesh.triangles.len(), mesh.area()?, report.is_closed());
    Ok(())
}
