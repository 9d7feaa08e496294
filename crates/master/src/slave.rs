//! What the master knows about one slave.

use esi::sii::SiiContents;
use time::Instant;
use wire::{AlState, AlStatus, AlStatusCode};

use crate::access::{Address, word};
use crate::channels::SyncManagerSettings;
use crate::event::{Failure, Outcome};
use crate::information::{DlStatus, EscFeatures, EscInformation};
use crate::mailbox::MailboxConduct;
use crate::queue::{Found, Queue};
use crate::settings::SlaveSettings;
use crate::state::AlReport;

/// One slave of the line, as the search has found it.
#[derive(Debug)]
pub struct Slave {
    pub(crate) address: Address,
    pub(crate) queue: Queue,
    pub(crate) settings: SlaveSettings,
    pub(crate) report: AlReport,
    /// The next read of its mailbox, if there are no other jobs.
    pub(crate) next_listen: Instant,
    information: EscInformation,
    dl_status: DlStatus,
    alias: u16,
    sii: Option<SiiContents>,
}

impl Slave {
    pub(crate) fn new(position: u16, conduct: MailboxConduct) -> Self {
        Self {
            address: Address::Position(position),
            queue: Queue::new(conduct),
            settings: SlaveSettings::default(),
            report: AlReport::NOTHING,
            next_listen: Instant::NEVER,
            information: EscInformation::default(),
            dl_status: DlStatus::default(),
            alias: 0,
            sii: None,
        }
    }

    /// Its address.
    #[must_use]
    pub const fn address(&self) -> Address {
        self.address
    }

    /// The information of its controller.
    #[must_use]
    pub const fn information(&self) -> EscInformation {
        self.information
    }

    /// Its links at the time when it was found.
    #[must_use]
    pub const fn dl_status(&self) -> DlStatus {
        self.dl_status
    }

    /// Its configured station alias at the time when it was found.
    #[must_use]
    pub const fn station_alias(&self) -> u16 {
        self.alias
    }

    /// The contents of its SII; none if it could not be read.
    #[must_use]
    pub const fn sii(&self) -> Option<&SiiContents> {
        self.sii.as_ref()
    }

    /// AL status as last read.
    #[must_use]
    pub const fn al_report(&self) -> AlReport {
        self.report
    }

    /// The settings that are written on its way up.
    #[must_use]
    pub const fn settings(&self) -> &SlaveSettings {
        &self.settings
    }

    /// When its next work is due: its first job, or a read of its mailbox.
    pub(crate) fn deadline(&self) -> Instant {
        if self.queue.is_empty() { self.next_listen } else { self.queue.deadline() }
    }

    /// The SyncManagers of the mailbox in its present state; none for a slave without one.
    pub(crate) fn mailbox(&self) -> Option<(SyncManagerSettings, SyncManagerSettings)> {
        let mailbox = self.settings.mailbox.as_ref()?;
        let in_boot = mailbox.in_boot().filter(|_| self.state() == AlState::Boot);
        Some(in_boot.unwrap_or((mailbox.out, mailbox.inward)))
    }

    /// Stores the result of a job. The settings are made from its SII, unless the caller has changed them.
    pub(crate) fn keep(&mut self, found: Found, outcome: Outcome) {
        match (found, outcome) {
            (Found::Information, Outcome::Data(data)) => {
                self.information = EscInformation::parse(&data).unwrap_or_default();
            }
            (Found::DlStatus, Outcome::Data(data)) => self.dl_status = DlStatus::parse(&data),
            (Found::Alias, Outcome::Data(data)) => self.alias = word(&data),
            (Found::Sii, Outcome::Sii(contents)) => {
                self.settings = SlaveSettings::from_sii(&contents);
                self.adapt_settings();
                self.sii = Some(*contents);
            }
            (Found::Information | Found::DlStatus | Found::Alias | Found::Sii, _) => {}
        }
    }

    /// Features that the controller does not support are not used.
    pub(crate) const fn adapt_settings(&mut self) {
        let features = self.information.features;
        self.settings.bytewise_fmmus |= features.contains(EscFeatures::FMMU_BYTEWISE);
        self.settings.separate_commands |= features.contains(EscFeatures::NO_LRW);
    }

    /// Stores the state that a job has read.
    pub(crate) fn note_state(&mut self, result: &Result<Outcome, Failure>) {
        if let Ok(Outcome::State(report)) | Err(Failure::Refused(report) | Failure::NotReached(report)) =
            result
        {
            self.report = *report;
        }
    }

    /// Stores AL status without its code.
    pub(crate) fn note_status(&mut self, status: AlStatus) {
        let code = if status.error { self.report.code } else { AlStatusCode::NO_ERROR };
        self.report = AlReport { status, code };
    }

    /// Its state, as last read.
    #[must_use]
    pub const fn state(&self) -> AlState {
        self.report.status.state
    }
}
