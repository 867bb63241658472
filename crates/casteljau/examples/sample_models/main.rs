//! Writes the sample models: `cargo run -p casteljau --example sample_models -- models`.

mod classical;
mod designs;
mod guide;
mod plan;
mod solids;

use casteljau::io::write_model_file;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args_os().nth(1).ok_or("usage: sample_models FOLDER")?;
    for (name, model) in designs::all().into_iter().chain(classical::all()?).chain(solids::all()?) {
        let path = std::path::Path::new(&folder).join(name);
        write_model_file(&path, &model)?;
        println!("{}", path.display());
    }
    Ok(())
}
