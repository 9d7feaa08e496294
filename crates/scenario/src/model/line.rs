//! What happens on the line: cables, and faults of frames.

use time::Duration;

/// What happens to the line between the master and the units.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LineOrder {
    /// Frames meet a fault.
    Disturb(Disturbance),
    /// The cable in front of the unit at this position, or behind the last one.
    Cable {
        /// Counted from 0, the one to the master.
        number: usize,
        /// Whether it is plugged in.
        plugged: bool,
    },
    /// No frame meets a fault any more.
    Quiet,
}

/// Which frames meet a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Disturbance {
    /// What happens to them.
    pub fault: FrameFault,
    /// Of which kind they are.
    pub kind: FrameKind,
    /// Which of them.
    pub choice: Choice,
}

/// What happens to a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameFault {
    /// It gets lost on its way to the units.
    Lose,
    /// It passes the units, and its answer gets lost.
    LoseAnswer,
    /// It comes later.
    Delay(Duration),
    /// It comes twice.
    Duplicate,
    /// It ends early.
    Truncate(usize),
    /// A bit error on the cable in front of the unit at this position.
    Corrupt(usize),
    /// The working counters of its answer are one too low.
    WorkingCounter,
}

/// Which frames a fault meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameKind {
    /// All.
    Any,
    /// Those of the cyclic exchange.
    ProcessData,
    /// Those that read or write a mailbox.
    Mailbox,
}

/// Which frames of a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// So many, beginning with the next one.
    Next(u64),
    /// So many, behind so many others.
    Behind {
        /// Frames that are left alone first.
        skip: u64,
        /// Frames that meet the fault then.
        count: u64,
    },
    /// All from now on.
    All,
    /// Each with this probability, in per cent.
    Percent(u8),
}
