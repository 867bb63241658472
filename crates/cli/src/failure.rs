use std::process::ExitCode;

/// Why the program ends without having done everything.
#[derive(Debug)]
pub enum Failure {
    /// The input or the result is bad.
    Bad(String),
    /// The command line makes no sense.
    Usage(String),
    /// Nobody reads what is written: no reason to complain.
    ReaderGone,
    /// Ctrl-C.
    Interrupted,
}

impl Failure {
    /// Says it on standard error and gives the exit status.
    pub fn report(self) -> ExitCode {
        use std::io::Write;
        let (message, status) = match self {
            Self::Bad(message) => (message, 1),
            Self::Usage(message) => (message, 2),
            Self::ReaderGone => return ExitCode::SUCCESS,
            Self::Interrupted => ("interrupted".into(), 130),
        };
        // eprintln! panics where standard error is closed.
        let _ = writeln!(std::io::stderr(), "error: {message}");
        ExitCode::from(status)
    }
}

impl<E: Into<casteljau::Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        if crate::interrupt::stopped() { Self::Interrupted } else { Self::Bad(error.into().to_string()) }
    }
}
