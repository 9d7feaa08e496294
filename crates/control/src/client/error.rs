//! Why a request has no answer.

use core::fmt;
use std::io;
use std::path::PathBuf;
use std::time::Duration;

use crate::messages::Refusal;

/// Characters of a line that is none of the channel, in its message.
const SHOWN_CHARACTERS: usize = 80;

/// Why a request has no answer.
#[derive(Debug)]
pub enum ClientError {
    /// No twin answers at this path.
    NotThere {
        /// The path.
        path: PathBuf,
        /// The reason of the system.
        source: io::Error,
    },
    /// The twin refuses the request. Nothing has changed.
    Refused(Refusal),
    /// The twin has ended, or has closed the connection.
    Ended,
    /// The twin has not answered for this time.
    Silent {
        /// The time.
        waited: Duration,
    },
    /// What answers is not a twin: the beginning of its line.
    NoTwin(String),
    /// The system refuses the socket.
    System(io::Error),
}

impl ClientError {
    pub(super) fn no_twin(line: &[u8]) -> Self {
        let line = String::from_utf8_lossy(line);
        Self::NoTwin(line.trim_end().chars().take(SHOWN_CHARACTERS).collect())
    }
}

impl fmt::Display for ClientError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotThere { path, source } => {
                write!(formatter, "no twin answers at {}: {source}", path.display())
            }
            Self::Refused(refusal) => refusal.fmt(formatter),
            Self::Ended => formatter.write_str("the twin has ended, or has closed the connection"),
            Self::Silent { waited } => write!(formatter, "the twin has not answered for {waited:?}"),
            Self::NoTwin(line) => write!(formatter, "what answers is not a twin: it says `{line}`"),
            Self::System(source) => write!(formatter, "the socket cannot be used: {source}"),
        }
    }
}

impl std::error::Error for ClientError {}
