//! How a unit is synchronised with its master.

use core::fmt;

/// When a unit exchanges its process data (reference 7.2, objects 1C32 and 1C33).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SyncMode {
    /// By the unit's own timer, [`crate::Unit::refresh_period`].
    FreeRun,
    /// Also at every event of the outputs' SyncManagers, or of the inputs' if there are no outputs. The event
    /// requires the PDI interrupt in the control byte (bit 5).
    SmSynchronous,
    /// Like digital outputs without a processor: also at the end of every frame that writes outputs,
    /// independent of the control byte.
    EndOfFrame,
    /// With SYNC0 of the distributed clocks. No slave of this project supports it yet.
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
