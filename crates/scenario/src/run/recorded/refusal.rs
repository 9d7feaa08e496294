//! Why a capture cannot be replayed.

use core::fmt;

use capture::NotACapture;
use time::Duration;

use super::{DURATION_MAX, SILENCE_MAX};

/// Why the frames of a capture cannot be sent again.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotReplayable {
    /// Its bytes are not a capture.
    NotACapture(NotACapture),
    /// The master pauses for too long.
    Silence {
        /// The frame after the pause, from 1.
        frame: usize,
        /// The duration of the pause.
        silence: Duration,
    },
    /// It lasts too long.
    TooLong {
        /// The first frame that is too late, from 1.
        frame: usize,
    },
}

impl fmt::Display for NotReplayable {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotACapture(reason) => reason.fmt(formatter),
            Self::Silence { frame, silence } => write!(
                formatter,
                "the master is silent for {silence} before its frame {frame}; {SILENCE_MAX} are the most \
                 (`editcap -A` and `-B` cut a capture)"
            ),
            Self::TooLong { frame } => write!(
                formatter,
                "the master's frame {frame} comes more than {DURATION_MAX} after its first one \
                 (`editcap -A` and `-B` cut a capture)"
            ),
        }
    }
}

impl core::error::Error for NotReplayable {}

impl From<NotACapture> for NotReplayable {
    fn from(reason: NotACapture) -> Self {
        Self::NotACapture(reason)
    }
}
