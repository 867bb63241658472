use std::fs;
use std::io::{BufWriter, Write};
use std::path::Path;

use crate::IoError;

/// Writes a file whole or not at all.
///
/// The content goes to a temporary file in the same folder, which takes the target's place once everything is written
/// and synchronised; on an error it is removed and an older file stays as it was. An existing file keeps its
/// permissions, a symbolic link keeps pointing at the file that it points at, and what is no regular file (a pipe,
/// `/dev/null`) is written to directly.
///
/// ```
/// use std::io::Write;
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("figure.svg");
/// casteljau_io::replace_file(&path, |out| Ok(out.write_all(b"<svg/>")?))?;
/// assert_eq!(std::fs::read(&path)?, b"<svg/>");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn replace_file(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> Result<(), IoError>,
) -> Result<(), IoError> {
    let name = path.display().to_string();
    let system = |action| {
        let file = name.clone();
        move |source| IoError::System { file, action, source }
    };
    let before = fs::metadata(path).ok();
    if before.as_ref().is_some_and(|data| !data.is_file()) {
        let file = fs::File::options().write(true).open(path).map_err(system("write"))?;
        return through_buffer(file, write).map(drop).map_err(|error| error.in_file(&name));
    }
    let target = match before {
        Some(_) => fs::canonicalize(path).map_err(system("write"))?,
        None => path.to_path_buf(),
    };
    let folder = match target.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".casteljau-");
    #[cfg(unix)]
    let everybody = std::os::unix::fs::PermissionsExt::from_mode(0o666);
    // Temporary files are private unless told otherwise; the umask still has its say.
    #[cfg(unix)]
    builder.permissions(everybody);
    let temporary = builder.tempfile_in(folder).map_err(system("create a file beside it"))?;
    let file = temporary.as_file().try_clone().map_err(system("write"))?;
    let file = through_buffer(file, write).map_err(|error| error.in_file(&name))?;
    if let Some(data) = before {
        file.set_permissions(data.permissions()).map_err(system("write"))?;
    }
    file.sync_all().map_err(system("write"))?;
    temporary.persist(&target).map_err(|error| system("write")(error.error))?;
    Ok(())
}

/// Buffers and flushes.
fn through_buffer(
    file: fs::File,
    write: impl FnOnce(&mut dyn Write) -> Result<(), IoError>,
) -> Result<fs::File, IoError> {
    let mut buffer = BufWriter::with_capacity(1 << 16, file);
    write(&mut buffer)?;
    buffer.into_inner().map_err(|error| error.into_error().into())
}
