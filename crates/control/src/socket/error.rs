//! Why a socket cannot be made.

use core::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Why a socket cannot be made at a path.
#[derive(Debug)]
pub struct BindError {
    path: PathBuf,
    why: Why,
}

/// The reason.
#[derive(Debug)]
pub(super) enum Why {
    InUse,
    NoSocket,
    TooLong {
        limit_bytes: usize,
    },
    /// The folder is not only the user's.
    Foreign,
    Refused(io::Error),
}

impl BindError {
    pub(super) fn new(path: &Path, why: Why) -> Self {
        Self { path: path.to_owned(), why }
    }

    /// The remedy.
    #[must_use]
    pub fn help(&self) -> String {
        match &self.why {
            Why::InUse => "end that twin, or choose another path: `--control PATH`",
            Why::NoSocket => "choose another path: no file is replaced by a socket",
            Why::TooLong { .. } => "choose a shorter path, such as one in /tmp",
            Why::Foreign => {
                "choose a path in a folder of your own, `--control PATH`, or set XDG_RUNTIME_DIR to one that only you reach"
            }
            Why::Refused(_) => "choose a path in a folder that exists and that you may write to: `--control PATH`",
        }
        .to_owned()
    }
}

impl fmt::Display for BindError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let path = self.path.display();
        match &self.why {
            Why::InUse => write!(formatter, "another twin uses the control socket {path}"),
            Why::NoSocket => write!(formatter, "{path} exists and is no socket"),
            Why::TooLong { limit_bytes } => {
                let length_bytes = self.path.as_os_str().len();
                write!(
                    formatter,
                    "the path {path} has {length_bytes} bytes, and that of a socket at most {limit_bytes}"
                )
            }
            Why::Foreign => write!(formatter, "the folder {path} is not one that only you reach"),
            Why::Refused(error) => write!(formatter, "the control socket {path} cannot be made: {error}"),
        }
    }
}

impl std::error::Error for BindError {}

impl From<io::Error> for Why {
    fn from(error: io::Error) -> Self {
        Self::Refused(error)
    }
}
