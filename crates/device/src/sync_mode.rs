//! How a unit is synchronised with its master.

use core::fmt;

/// When a unit exchanges its process data (reference 7.2, objects 1C32 and 1C33).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SyncMode {
    /// By a timer of its own, [`crate::Unit::refresh_period`].
    FreeRun,
    /// Also with every event of the outputs' SyncManagers, or of the inputs' where there are no outputs. The event
    /// needs the PDI interrupt in the control byte (bit 5).
    SmSynchronous,
    /// As digital outputs without a processor: also with the end of every frame that writes outputs, whatever the
    /// control byte says.
    EndOfFrame,
    /// With SYNC0 of the distributed clocks. No slave of ours follows it yet.
    Dc,
}

impl fmt::Display for SyncMode {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::FreeRun => "Free-Run",
            Self::SmSynchronous => "SM-synchronous",
            Self::EndOfFrame => "end of frame",
            Self::Dc => "DC",
        })
    }
}
