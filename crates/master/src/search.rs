//! Finding slaves: the initial writes to all of them, in SOEM's order, and how they are counted.

use crate::access::{Access, Answer, Dialogue, Patience, Progress};
use crate::registers::{self as at, FMMU_BYTES, SYNC_MANAGER_BYTES};

/// FMMUs and SyncManagers that are cleared: the number of an ET1100.
const CHANNELS: usize = 8;
const ZEROS: [u8; CHANNELS * FMMU_BYTES as usize] = [0; CHANNELS * FMMU_BYTES as usize];

/// One step of the search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Step {
    /// A write to all slaves, whether a slave accepts it or not.
    Clear { offset: u16, data: &'static [u8] },
    /// The working counter of a read by all slaves is their number.
    Count,
}

const fn clear(offset: u16, data: &'static [u8]) -> Step {
    Step::Clear { offset, data }
}

const fn zeros(offset: u16, length_bytes: usize) -> Step {
    Step::Clear { offset, data: ZEROS.split_at(length_bytes).0 }
}

/// Reference 5.8, lines 1 to 10.
const STEPS: &[Step] = &[
    // No station alias, so that every address refers to one slave; INIT, with an acknowledge.
    zeros(at::DL_CONTROL + 3, 1),
    clear(at::AL_CONTROL, &[0x11, 0]),
    Step::Count,
    // All ports open and close automatically.
    zeros(at::DL_CONTROL + 1, 1),
    clear(at::ECAT_EVENT_MASK, &[0x04, 0]),
    zeros(at::PORT_ERRORS, 8),
    zeros(at::FMMU, CHANNELS * FMMU_BYTES as usize),
    zeros(at::SYNC_MANAGER, CHANNELS * SYNC_MANAGER_BYTES as usize),
    zeros(at::DC_ACTIVATION, 1),
    zeros(at::SYSTEM_TIME, 4),
    clear(at::SPEED_COUNTER_START, &[0x00, 0x10]),
    clear(at::TIME_FILTERS, &[0x00, 0x0C]),
    // No slave keeps an address of an earlier search.
    zeros(at::STATION_ADDRESS, 2),
    // Receive times of this frame at all ports.
    zeros(at::RECEIVE_TIMES, 4),
];

/// Takes all slaves to INIT, clears the settings of an earlier master, and counts the slaves.
#[derive(Clone, Debug, Default)]
pub struct Search {
    step: usize,
    found: u16,
}

impl Search {
    /// Number of slaves that have answered.
    #[must_use]
    pub const fn found(&self) -> u16 {
        self.found
    }

    fn step(&self) -> Step {
        STEPS.get(self.step).copied().unwrap_or(Step::Count)
    }
}

impl Dialogue for Search {
    fn access(&self) -> Access<'_> {
        match self.step() {
            Step::Clear { offset, data } => Access::Write { offset, data },
            Step::Count => Access::Read { offset: at::INFORMATION, length_bytes: 2 },
        }
    }

    fn answer(&mut self, answer: Option<Answer<'_>>) -> Progress {
        let Some(answer) = answer else { return Progress::Next };
        let is_count = self.step() == Step::Count;
        if is_count {
            self.found = answer.working_counter;
        }
        self.step += 1;
        let is_empty = is_count && self.found == 0;
        if is_empty || self.step == STEPS.len() { Progress::Done } else { Progress::NextStage }
    }

    fn patience(&self) -> Patience {
        Patience::Access
    }
}
