//! The current errors: objects 2003 and 2004 with their shared memory, and the error status 2002:01 (manual,
//! 8-3-2 and A-6-7).

use arrayvec::ArrayVec;
use unit_model::CurrentError;

use crate::events::EventLevel;
use crate::status::{MINOR_FAULT_BIT, OBSERVATION_BIT};

/// Maximum number of observations and minor faults together.
pub const CURRENT_ERRORS_MAX: usize = 10;
/// Length of an error in objects 2003 and 2004, in bytes.
pub(crate) const CURRENT_ERROR_BYTES: usize = 12;

const OBSERVATION: u8 = 1 << OBSERVATION_BIT.bit;
const MINOR_FAULT: u8 = 1 << MINOR_FAULT_BIT.bit;
/// Type of error detail without attached information, and with (A34).
const WITHOUT_DETAIL: u32 = 0x0007_0000;
const WITH_DETAIL: u32 = 0x0007_0401;

/// The bytes of an error in objects 2003 and 2004.
#[must_use]
pub fn current_error_bytes(error: &CurrentError) -> [u8; CURRENT_ERROR_BYTES] {
    let kind = if error.detail.is_some() { WITH_DETAIL } else { WITHOUT_DETAIL };
    let mut bytes = [0; CURRENT_ERROR_BYTES];
    let words = [error.event.0, kind, error.detail.unwrap_or(0)];
    for (to, word) in bytes.chunks_exact_mut(4).zip(words) {
        to.copy_from_slice(&word.to_le_bytes());
    }
    bytes
}

/// Both lists, each in the order in which its errors occurred.
#[derive(Debug, Default)]
pub(super) struct CurrentErrors {
    observations: ArrayVec<CurrentError, CURRENT_ERRORS_MAX>,
    minor_faults: ArrayVec<CurrentError, CURRENT_ERRORS_MAX>,
    /// It also includes errors for which there was no room (manual, 8-3-2).
    status: u8,
}

impl CurrentErrors {
    /// Adds an error. An existing one is not added again. There is room for ten: a minor fault replaces the
    /// newest observation, an observation replaces none (A32).
    pub(super) fn add(&mut self, level: EventLevel, error: CurrentError) {
        let is_full = self.observations.len() + self.minor_faults.len() == CURRENT_ERRORS_MAX;
        match level {
            EventLevel::MinorFault => {
                self.status |= MINOR_FAULT;
                if self.minor_faults.contains(&error) {
                    return;
                }
                if !is_full || self.observations.pop().is_some() {
                    self.minor_faults.push(error);
                }
            }
            EventLevel::Observation => {
                self.status |= OBSERVATION;
                if !is_full && !self.observations.contains(&error) {
                    self.observations.push(error);
                }
            }
            EventLevel::Information => {}
        }
    }

    pub(super) fn clear(&mut self) {
        self.observations.clear();
        self.minor_faults.clear();
        self.status = 0;
    }

    pub(super) const fn status(&self) -> u8 {
        self.status
    }

    pub(super) fn of(&self, level: EventLevel) -> &[CurrentError] {
        match level {
            EventLevel::MinorFault => &self.minor_faults,
            EventLevel::Observation => &self.observations,
            EventLevel::Information => &[],
        }
    }
}
