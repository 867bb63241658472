use std::fs::File;
use std::io::{Read, Write};
use std::path::Path;

use crate::cgb::{self, Warning};
use crate::mesh_file::ending;
use crate::model::{Model, NamedShape, Shape};
use crate::{IoError, Place, Reason, replace_file, vtu};

/// The largest model file that is read: 256 MiB, which is some three million control points.
pub const MAX_FILE_BYTES: u64 = 1 << 28;

/// The endings that [`read_model_file`] and [`write_model_file`] know.
pub const MODEL_ENDINGS: &str = "json, cgb, vtu";

/// A model format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ModelFormat {
    /// The [model file](crate::model).
    Json,
    /// [`cgb`]: one concave GB patch.
    Cgb,
    /// [`vtu`]: Bézier cells.
    Vtu,
}

impl ModelFormat {
    /// The format that the ending of a path names, in either case of letters.
    ///
    /// ```
    /// use casteljau_io::ModelFormat;
    /// assert!(matches!(ModelFormat::of_path("U.cgb".as_ref()), Ok(ModelFormat::Cgb)));
    /// let error = ModelFormat::of_path("pocket5.gbp".as_ref()).unwrap_err();
    /// assert_eq!(error.to_string(), "pocket5.gbp: the format .gbp is not supported yet; supported: json, cgb, vtu");
    /// ```
    pub fn of_path(path: &Path) -> Result<Self, IoError> {
        let ending = ending(path);
        let file = path.display().to_string();
        match ending.to_ascii_lowercase().as_str() {
            "json" => Ok(Self::Json),
            "cgb" => Ok(Self::Cgb),
            "vtu" => Ok(Self::Vtu),
            "gbp" => {
                let reason = Reason::FormatNotYet { ending, supported: MODEL_ENDINGS };
                Err(IoError::invalid(Place::file(file), reason))
            }
            _ => Err(IoError::Ending { file, ending, known: MODEL_ENDINGS.into() }),
        }
    }
}

/// Reads a model in the format that the path's ending names, with what could not be taken as it stands.
///
/// Error: what [`read_model_bytes`] says, or the system, each with the path.
pub fn read_model_file(path: &Path) -> Result<(Model, Vec<Warning>), IoError> {
    let format = ModelFormat::of_path(path)?;
    let name = path.display().to_string();
    let system = |source| IoError::System { file: name.clone(), action: "read", source };
    let content = File::open(path).map_err(system)?;
    if content.metadata().map_err(system)?.len() > MAX_FILE_BYTES {
        return Err(IoError::invalid(Place::file(name), Reason::TooLong { limit: MAX_FILE_BYTES }));
    }
    let mut bytes = Vec::new();
    // Pipes and devices have no length to look at: one byte more than allowed tells one that is too long.
    content.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes).map_err(system)?;
    read_model_bytes(&bytes, &name, Some(format))
}

/// Reads a model from the content of a file; without a format, what starts like an object is JSON, what starts like an XML
/// element `.vtu` and the rest `.cgb`.
///
/// `file` is the name for messages. A byte-order mark is skipped. Memory: linear in the content.
/// Error: [`IoError::Invalid`] with file, line or path.
///
/// ```
/// let error = casteljau_io::read_model_bytes(b"\x7fELF\xff", "a.out", None).unwrap_err();
/// assert_eq!(error.to_string(), "a.out:1: not a text file: byte 4 is 0xff, which is not UTF-8");
/// ```
pub fn read_model_bytes(
    bytes: &[u8],
    file: &str,
    format: Option<ModelFormat>,
) -> Result<(Model, Vec<Warning>), IoError> {
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(IoError::invalid(Place::file(file), Reason::TooLong { limit: MAX_FILE_BYTES }));
    }
    let start = bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(bytes).trim_ascii_start();
    if format.map_or_else(|| start.starts_with(b"<"), |format| format == ModelFormat::Vtu) {
        // Its data may be no text.
        return Ok((vtu::read(bytes, file)?, Vec::new()));
    }
    let text = str::from_utf8(bytes).map_err(|error| {
        let offset = error.valid_up_to();
        let line = 1 + bytes[..offset].iter().filter(|&&byte| byte == b'\n').count();
        IoError::invalid(Place::line(file, line), Reason::NotText { offset, byte: bytes[offset] })
    })?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let format = format.unwrap_or_else(|| match text.trim_ascii_start().starts_with('{') {
        true => ModelFormat::Json,
        false => ModelFormat::Cgb,
    });
    match format {
        ModelFormat::Json => Ok((Model::read(text, file)?, Vec::new())),
        ModelFormat::Vtu => Ok((vtu::read(bytes, file)?, Vec::new())),
        ModelFormat::Cgb => {
            let read = cgb::read(text, file)?;
            let shape = NamedShape::from_cgb(read.record, file, read.ribbon_lines);
            Ok((Model { shapes: vec![shape] }, read.warnings))
        }
    }
}

/// Writes a model in the format that the path's ending names, [whole or not at all](replace_file).
///
/// Error: unknown ending; a model that the format cannot hold (`.cgb` holds one patch, and not every one; `.vtu` no GB patch); a shape that
/// reading would refuse; or what the system says. Each names the path.
pub fn write_model_file(path: &Path, model: &Model) -> Result<(), IoError> {
    let format = ModelFormat::of_path(path)?;
    replace_file(path, |out| write_model(model, format, out))
}

/// Writes a model in a format. Error: as for [`write_model_file`], without the path.
pub fn write_model(
    model: &Model,
    format: ModelFormat,
    out: &mut (impl Write + ?Sized),
) -> Result<(), IoError> {
    let unwritable =
        |what| Err(IoError::invalid(Place::default(), Reason::Unwritable { format: "cgb", what }));
    match (format, model.shapes.as_slice()) {
        (ModelFormat::Json, _) => model.write(out),
        (ModelFormat::Vtu, _) => vtu::write(model, out),
        (ModelFormat::Cgb, [NamedShape { shape: Shape::GbPatch(record), .. }]) => {
            cgb::write(record, cgb::DEFAULT_TOLERANCE, out)
        }
        (ModelFormat::Cgb, [NamedShape { shape, .. }]) => {
            unwritable(format!("a shape of kind `{}`, only `gb_patch`", shape.kind()))
        }
        (ModelFormat::Cgb, shapes) => unwritable(format!("{} shapes, only one", shapes.len())),
    }
}
