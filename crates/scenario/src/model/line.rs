//! What happens on the line: cables, and faults of frames.

use serde::{Deserialize, Serialize};
use time::Duration;

use super::spelling::{nothing, text};
use super::units::CableNumber;

/// What happens to the line between the master and the units.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum LineOrder {
    /// A cable is pulled out.
    Unplug {
        /// Which one.
        cable: CableNumber,
    },
    /// A cable is plugged in.
    Plug {
        /// Which one.
        cable: CableNumber,
    },
    /// Frames meet a fault.
    Disturb(Disturbance),
    /// No frame meets a fault any more.
    #[serde(with = "nothing")]
    BeQuiet,
}

/// Which frames meet a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Disturbance {
    /// What happens to them.
    pub fault: FrameFault,
    /// Which ones.
    pub frames: Frames,
}

/// What happens to a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum FrameFault {
    /// It gets lost on its way to the units.
    Lose,
    /// It passes the units, and its answer gets lost.
    LoseAnswer,
    /// It comes later.
    Delay {
        /// By this time.
        #[serde(with = "text")]
        by: Duration,
    },
    /// It passes the units twice.
    Duplicate,
    /// It ends early.
    Cut {
        /// It has as many bytes then.
        length_bytes: u16,
    },
    /// A bit error on a cable.
    Corrupt {
        /// The cable in front of a unit.
        cable: CableNumber,
    },
    /// The working counters of its answer are one too low.
    LowerWorkingCounter,
}

/// Frames by their kind, and which of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Frames {
    /// Of which kind they are.
    #[serde(default)]
    pub kind: FrameKind,
    /// Which of them.
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

/// Which frames of a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Choice {
    /// As many, beginning with the next one.
    Next(u64),
    /// Some behind others.
    Behind {
        /// Frames that pass without a fault first.
        skip: u64,
        /// Frames that meet the fault then.
        count: u64,
    },
    /// All from now on.
    All,
    /// Each with this probability, in per cent, 1 to 100.
    Percent(u8),
}
