//! The settings of a master, checked against a table of conditions.

use arrayvec::ArrayVec;
use esc::{Pdi, SmDirection, SmIndex, SmMode, SyncManagerSettings};
use wire::AlStatusCode;

use crate::conditions::{Condition, Requirement};
use crate::config::DeviceConfig;
use crate::sync_managers::{
    Area, Buffers, DataDirection, MailboxAreas, ProcessDataConfig, SYNC_MANAGERS_MAX,
};
use crate::sync_mode::SyncMode;

/// The AL status codes of all violated conditions, each once, in the order of their priority.
pub(crate) type Findings = ArrayVec<AlStatusCode, 16>;

/// Lengths of the process data that the present mapping requires, in the order of [`DeviceConfig::process_data`].
pub(crate) type Lengths = ArrayVec<u16, SYNC_MANAGERS_MAX>;

/// The settings of a master together with the expected ones.
pub(crate) struct Settings<'a, 'p> {
    pub(crate) config: &'a DeviceConfig,
    pub(crate) lengths: &'a Lengths,
    pub(crate) sync_mode: SyncMode,
    pub(crate) pdi: &'a Pdi<'p>,
}

impl Settings<'_, '_> {
    /// The violated conditions, in the order of a table.
    pub(crate) fn findings(&self, conditions: &[Condition]) -> Findings {
        let mut findings = Findings::new();
        for condition in conditions {
            if !self.meets(condition.requires) && !findings.contains(&condition.otherwise) {
                // If a table has more codes, only the first ones are reported.
                let _ = findings.try_push(condition.otherwise);
            }
        }
        findings
    }

    fn meets(&self, requirement: Requirement) -> bool {
        match requirement {
            Requirement::SiiLoaded => self.pdi.sii_loaded(),
            Requirement::Mailbox => {
                self.config.mailbox.is_none_or(|mailbox| self.is_mailbox(mailbox.standard))
            }
            Requirement::BootstrapMailbox => {
                let bootstrap = self.config.mailbox.and_then(|mailbox| mailbox.bootstrap);
                bootstrap.is_some_and(|areas| self.is_mailbox(areas))
            }
            Requirement::Areas(direction) => self
                .of(direction)
                .all(|(described, length_bytes, set)| has_area(described, length_bytes, &set)),
            Requirement::Buffers(direction) => {
                self.of(direction).all(|(described, _, set)| !set.enabled || has_buffers(described, &set))
            }
            Requirement::Offered(mode) => self.sync_mode != mode || self.config.sync_modes.contains(&mode),
            Requirement::WatchdogTrigger => {
                let mut outputs = self
                    .of(DataDirection::Outputs)
                    .filter(|&(_, length_bytes, _)| length_bytes > 0)
                    .peekable();
                outputs.peek().is_none()
                    || self.pdi.watchdog_time() == 0
                    || outputs.any(|(.., set)| set.watchdog_trigger)
            }
        }
    }

    fn is_mailbox(&self, areas: MailboxAreas) -> bool {
        let fits = |index, area: Area, direction| {
            let set = self.pdi.sync_manager(index);
            set.enabled
                && set.mode == SmMode::Mailbox
                && set.direction == direction
                && set.start == area.start
                && set.length_bytes == area.length_bytes
        };
        fits(SmIndex::MAILBOX_RECEIVE, areas.receive, SmDirection::EcatWrites)
            && fits(SmIndex::MAILBOX_SEND, areas.send, SmDirection::EcatReads)
    }

    /// The SyncManagers of a direction: as described, the length of their data, as set.
    fn of(
        &self,
        direction: DataDirection,
    ) -> impl Iterator<Item = (&ProcessDataConfig, u16, SyncManagerSettings)> {
        let all = self.config.process_data.iter().zip(self.lengths);
        all.filter(move |(described, _)| described.direction == direction).map(
            |(described, &length_bytes)| {
                (described, length_bytes, self.pdi.sync_manager(described.sync_manager))
            },
        )
    }
}

fn has_area(described: &ProcessDataConfig, length_bytes: u16, set: &SyncManagerSettings) -> bool {
    if length_bytes == 0 {
        return !set.enabled || set.length_bytes == 0;
    }
    let direction = match described.direction {
        DataDirection::Outputs => SmDirection::EcatWrites,
        DataDirection::Inputs => SmDirection::EcatReads,
    };
    set.enabled
        && set.direction == direction
        && set.start == described.start
        && set.length_bytes == length_bytes
}

fn has_buffers(described: &ProcessDataConfig, set: &SyncManagerSettings) -> bool {
    match described.buffers {
        Buffers::Three => set.mode == SmMode::Buffered,
        Buffers::One => set.mode == SmMode::Mailbox,
        Buffers::OneOrThree => matches!(set.mode, SmMode::Buffered | SmMode::Mailbox),
    }
}
