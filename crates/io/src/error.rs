use std::io;

use casteljau_mesh::MeshError;
use thiserror::Error;

use crate::{Place, Reason};

/// Why a file could not be read or written. `Display` is `FILE:LINE: what and why`.
///
/// ```
/// use casteljau_io::{IoError, Reason, read_model_bytes};
/// let error = read_model_bytes(b"0 1 0.2 0\n1000000000\n0 0 0\n", "u.cgb", None).unwrap_err();
/// assert!(matches!(&error, IoError::Invalid { reason: Reason::Promised { promised: 1_000_000_000, .. }, .. }));
/// assert!(error.to_string().starts_with("u.cgb:2: "));
/// ```
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum IoError {
    /// The system refused.
    #[error("{file}: cannot {action}: {source}")]
    System {
        /// The file's name as the caller gave it; `output` for a stream.
        file: String,
        /// `"read"`, `"write"` or the like.
        action: &'static str,
        /// What the system said.
        source: io::Error,
    },
    /// The ending of a path does not say the format.
    #[error("{file}: the ending `{ending}` is not known; known endings: {known}")]
    Ending {
        /// The path.
        file: String,
        /// What stands after its last dot.
        ending: String,
        /// The endings that are known here.
        known: String,
    },
    /// The file's content is wrong, or the model cannot be written in this format.
    #[error("{place}: {reason}")]
    Invalid {
        /// File, line and path.
        place: Box<Place>,
        /// What and why.
        #[source]
        reason: Reason,
    },
    /// The mesh that was to be written is wrong.
    #[error("{file}: cannot write the mesh: {source}")]
    Mesh {
        /// The file's name as the caller gave it; `output` for a stream.
        file: String,
        /// What is wrong with it.
        source: MeshError,
    },
}

impl IoError {
    /// The same error about another file: writers to a stream do not know the path.
    pub fn in_file(mut self, name: &str) -> Self {
        match &mut self {
            Self::System { file, .. } | Self::Ending { file, .. } | Self::Mesh { file, .. } => {
                *file = name.into()
            }
            Self::Invalid { place, .. } => place.file = name.into(),
        }
        self
    }

    pub(crate) fn invalid(place: Place, reason: Reason) -> Self {
        Self::Invalid { place: Box::new(place), reason }
    }
}

/// What a stream is called in messages.
pub(crate) const STREAM: &str = "output";

/// An error of the stream that is written to.
impl From<io::Error> for IoError {
    fn from(source: io::Error) -> Self {
        Self::System { file: STREAM.into(), action: "write", source }
    }
}

impl From<MeshError> for IoError {
    fn from(source: MeshError) -> Self {
        Self::Mesh { file: STREAM.into(), source }
    }
}
