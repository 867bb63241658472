//! Models, from files and from standard input.

use std::fs::File;
use std::io::{Read, Write};
use std::path::Path;

use casteljau::domain::HarmonicOptions;
use casteljau::gb::ConcavePatch;
use casteljau::io::model::{Model, NamedShape, Shape};
use casteljau::io::{Geometry, IoError, MAX_FILE_BYTES, ModelFormat, read_model_bytes, read_model_file};

use crate::arguments::Selection;
use crate::failure::Failure;
use crate::progress::waiting;

/// What standard input is called in messages.
pub const STANDARD_INPUT: &str = "standard input";

pub fn is_dash(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// The shapes that are asked for, with their numbers.
pub struct Input {
    pub name: String,
    pub shapes: Vec<(usize, NamedShape)>,
    accuracy: Option<f64>,
}

impl Input {
    /// Reads the model and picks the shape, or all. Warnings go to standard error.
    pub fn read(selection: &Selection) -> Result<Self, Failure> {
        let least = HarmonicOptions::LEAST_TARGET;
        if let Some(accuracy) = selection.accuracy.filter(|x| !(least..=1.0).contains(x)) {
            return Err(Failure::Usage(format!("--accuracy must be {least:e} to 1, not {accuracy:e}")));
        }
        let name = if is_dash(&selection.model) {
            STANDARD_INPUT.into()
        } else {
            selection.model.display().to_string()
        };
        let model = read(&selection.model, &name)?;
        let count = model.shapes.len();
        let all = model.shapes.into_iter().enumerate();
        let shapes: Vec<_> = match selection.shape {
            None => all.collect(),
            Some(shape) => all.filter(|(index, _)| *index == shape).collect(),
        };
        match (shapes.is_empty(), selection.shape) {
            (false, _) => Ok(Self { name, shapes, accuracy: selection.accuracy }),
            (true, None) => Err(Failure::Bad(format!("{name}: there are no shapes in the file"))),
            (true, Some(shape)) => {
                let holds = if count == 1 { "1 shape".into() } else { format!("{count} shapes") };
                Err(Failure::Bad(format!(
                    "{name}: there is no shape {shape}: the file has {holds}, counted from 0"
                )))
            }
        }
    }

    /// The patches of all shapes, with the place in the file for what one of them refuses.
    pub fn patches(&self) -> Result<Vec<ConcavePatch>, Failure> {
        self.shapes.iter().map(|(_, shape)| self.patch(shape)).collect()
    }

    /// What a shape describes, GB patches with the coordinates' accuracy that is asked for.
    pub fn geometry(&self, shape: &NamedShape) -> Result<Geometry, Failure> {
        match shape.shape {
            Shape::GbPatch(_) => Ok(Geometry::GbPatch(Box::new(self.patch(shape)?))),
            _ => Ok(shape.to_geometry()?),
        }
    }

    /// One of them.
    pub fn patch(&self, shape: &NamedShape) -> Result<ConcavePatch, Failure> {
        let mut builder = shape.patch_builder()?;
        if let Some(accuracy) = self.accuracy {
            builder = builder.accuracy(accuracy);
        }
        let built = waiting("setting up the coordinates of the domain", || builder.build());
        Ok(built.map_err(|error| shape.placed(error))?)
    }

    /// Shape `index` of the file as a person would call it.
    pub fn title((index, shape): &(usize, NamedShape)) -> String {
        match &shape.name {
            Some(name) => format!("shape {index} “{}”", name.escape_debug()),
            None => format!("shape {index}"),
        }
    }
}

/// By the ending where it is known; standard input, and files of other endings, by what they begin with.
fn read(path: &Path, name: &str) -> Result<Model, Failure> {
    let (model, warnings) = if is_dash(path) {
        read_model_bytes(&read_all(std::io::stdin().lock(), name)?, name, None)?
    } else {
        match ModelFormat::of_path(path) {
            Ok(_) => read_model_file(path)?,
            Err(unknown @ IoError::Ending { .. }) => {
                let file = File::open(path).map_err(|error| cannot_read(name, &error))?;
                let bytes = read_all(file, name)?;
                if !looks_like_model(&bytes) {
                    return Err(unknown.into());
                }
                read_model_bytes(&bytes, name, None)?
            }
            Err(other) => return Err(other.into()),
        }
    };
    for warning in warnings {
        let _ = writeln!(std::io::stderr(), "warning: {warning}");
    }
    Ok(model)
}

/// An object, as JSON has it, an element, as `.vtu` begins with one, or a number, as `.cgb` does.
fn looks_like_model(bytes: &[u8]) -> bool {
    let first = bytes.iter().find(|byte| !byte.is_ascii_whitespace());
    first.is_none_or(|byte| matches!(byte, b'{' | b'<') || byte.is_ascii_digit())
}

pub fn cannot_read(name: &str, error: &std::io::Error) -> Failure {
    Failure::Bad(format!("{name}: cannot read: {error}"))
}

/// Everything, up to the limit for models: the reader of models refuses one byte more.
fn read_all(input: impl Read, name: &str) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    input.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes).map_err(|error| cannot_read(name, &error))?;
    Ok(bytes)
}
