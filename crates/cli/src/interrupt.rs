//! Ctrl-C: ends the program at once, except while a file is written; then the writing fails and the half file goes.

use std::io::{self, Write};
use std::sync::atomic::{AtomicBool, Ordering};

static WRITING: AtomicBool = AtomicBool::new(false);
static STOPPED: AtomicBool = AtomicBool::new(false);

/// The exit status of a program that a signal ended.
const STATUS: i32 = 130;

pub fn install() {
    let stop = || {
        if WRITING.load(Ordering::SeqCst) {
            STOPPED.store(true, Ordering::SeqCst);
        } else {
            std::process::exit(STATUS);
        }
    };
    // Without a handler the signal still ends the program; only a temporary file could be left.
    let _ = ctrlc::set_handler(stop);
}

/// Whether a signal came while a file was written.
pub fn stopped() -> bool {
    STOPPED.load(Ordering::SeqCst)
}

/// Runs what writes a file.
pub fn while_writing<T>(write: impl FnOnce() -> T) -> T {
    WRITING.store(true, Ordering::SeqCst);
    let result = write();
    WRITING.store(false, Ordering::SeqCst);
    result
}

/// A writer that fails once a signal came.
pub struct Stoppable<W>(pub W);

impl<W: Write> Write for Stoppable<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if stopped() { Err(io::Error::other("interrupted")) } else { self.0.write(bytes) }
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}
