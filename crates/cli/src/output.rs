//! Standard output, and files that are written whole or not at all.

use std::io::{self, BufWriter, StdoutLock, Write};
use std::path::Path;

use casteljau::io::{IoError, replace_file};
use serde::Serialize;

use crate::failure::Failure;
use crate::input::is_dash;
use crate::interrupt::{Stoppable, stopped, while_writing};

/// Standard output: lines of text or of JSON.
pub struct Lines {
    out: BufWriter<StdoutLock<'static>>,
}

impl Lines {
    pub fn new() -> Self {
        Self { out: BufWriter::new(io::stdout().lock()) }
    }

    pub fn text(&mut self, line: &str) -> Result<(), Failure> {
        writeln!(self.out, "{line}").map_err(|error| standard(&error))
    }

    /// One object on one line.
    pub fn json(&mut self, object: &impl Serialize) -> Result<(), Failure> {
        serde_json::to_writer(&mut self.out, object).map_err(|error| standard(&error.into()))?;
        writeln!(self.out).map_err(|error| standard(&error))
    }

    /// What is still held goes out; errors would be lost without this.
    pub fn finish(mut self) -> Result<(), Failure> {
        self.out.flush().map_err(|error| standard(&error))
    }
}

fn standard(error: &io::Error) -> Failure {
    match error.kind() {
        io::ErrorKind::BrokenPipe => Failure::ReaderGone,
        _ => Failure::Bad(format!("standard output: cannot write: {error}")),
    }
}

/// Writes a file, or standard output for `-`.
pub fn write(
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> Result<(), IoError>,
) -> Result<(), Failure> {
    if is_dash(path) {
        let mut out = BufWriter::new(io::stdout().lock());
        let written = content(&mut out).and_then(|()| Ok(out.flush()?));
        return written.map_err(|error| match error {
            IoError::System { source, .. } => standard(&source),
            other => Failure::Bad(other.in_file("standard output").to_string()),
        });
    }
    let result = while_writing(|| replace_file(path, |out| content(&mut Stoppable(out))));
    match result {
        Err(IoError::System { source, .. }) if source.kind() == io::ErrorKind::BrokenPipe => {
            Err(Failure::ReaderGone)
        }
        // The signal came too late to stop anything: the file is whole.
        Ok(()) if stopped() => Err(Failure::Interrupted),
        result => Ok(result?),
    }
}
