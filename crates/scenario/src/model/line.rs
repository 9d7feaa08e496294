//! Actions on the line: cables, and faults of frames.

use serde::{Deserialize, Serialize};
use time::Duration;

use super::spelling::{nothing, text};
use super::units::CableNumber;

/// An action on the line between the master and the units.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum LineOrder {
    /// A cable is pulled out.
    Unplug {
        /// Its number.
        cable: CableNumber,
    },
    /// A cable is plugged in.
    Plug {
        /// Its number.
        cable: CableNumber,
    },
    /// Frames get a fault.
    Disturb(Disturbance),
    /// No more faults of frames.
    #[serde(with = "nothing")]
    BeQuiet,
}

/// Which frames get a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Disturbance {
    /// The fault.
    pub fault: FrameFault,
    /// The frames.
    pub frames: Frames,
}

/// A fault of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum FrameFault {
    /// It is lost on its way to the units.
    Lose,
    /// It passes the units, and its answer is lost.
    LoseAnswer,
    /// It is delayed.
    Delay {
        /// The delay.
        #[serde(with = "text")]
        by: Duration,
    },
    /// It passes the units twice.
    Duplicate,
    /// It is shortened.
    Cut {
        /// Its remaining number of bytes.
        length_bytes: u16,
    },
    /// A bit error on a cable.
    Corrupt {
        /// The cable before a unit.
        cable: CableNumber,
    },
    /// The working counters of its answer are too low by one.
    LowerWorkingCounter,
}

/// Frames by their kind, and a selection of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Frames {
    /// The kind.
    #[serde(default)]
    pub kind: FrameKind,
    /// The selection.
    pub choice: Choice,
}

/// A kind of frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FrameKind {
    /// All.
    #[default]
    Any,
    /// Those of the cyclic exchange.
    ProcessData,
    /// Those that read or write a mailbox.
    Mailbox,
}

impl Choice {
    /// Whether it selects no frame at all.
    pub(crate) const fn is_none(self) -> bool {
        matches!(self, Self::Next(0) | Self::Behind { count: 0, .. })
    }
}

/// The selected frames of a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Choice {
    /// This number of frames, starting with the next one.
    Next(u64),
    /// Some frames after others.
    Behind {
        /// Number of frames that first pass without a fault.
        skip: u64,
        /// Number of frames with the fault after that.
        count: u64,
    },
    /// All from now on.
    All,
    /// Each with this probability, in per cent, 1 to 100.
    Percent(u8),
}
