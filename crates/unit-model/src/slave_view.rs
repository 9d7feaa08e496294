//! The state of the slave stack and the line, for the indicators of a unit.

use coe_kit::indicators::PortCondition;
use wire::{AlStatus, AlStatusCode};

/// The visible state of a slave.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SlaveView {
    /// State and error indication, as the master reads them.
    pub al_status: AlStatus,
    /// AL status code, as the master reads it.
    pub al_status_code: AlStatusCode,
    /// Port IN.
    pub in_port: PortCondition,
    /// Port OUT.
    pub out_port: PortCondition,
}

impl SlaveView {
    /// The AL status code, while AL status indicates an error.
    #[must_use]
    pub fn al_error(&self) -> Option<AlStatusCode> {
        self.al_status.error.then_some(self.al_status_code)
    }
}
