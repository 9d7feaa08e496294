//! What the master knows of one slave.

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
    /// The next look into its mailbox, if nothing else is to be done.
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

    /// How it is addressed.
    #[must_use]
    pub const fn address(&self) -> Address {
        self.address
    }

    /// What its controller is.
    #[must_use]
    pub const fn information(&self) -> EscInformation {
        self.information
    }

    /// Its links, when it was found.
    #[must_use]
    pub const fn dl_status(&self) -> DlStatus {
        self.dl_status
    }

    /// Its configured station alias, when it was found.
    #[must_use]
    pub const fn station_alias(&self) -> u16 {
        self.alias
    }

    /// The contents of its SII; none if it could not be read.
    #[must_use]
    pub const fn sii(&self) -> Option<&SiiContents> {
        self.sii.as_ref()
    }

    /// AL status as it was read last.
    #[must_use]
    pub const fn al_report(&self) -> AlReport {
        self.report
    }

    /// What is set at it on its way up.
    #[must_use]
    pub const fn settings(&self) -> &SlaveSettings {
        &self.settings
    }

    /// When something of it is due: its first job, or a look into its mailbox.
    pub(crate) fn deadline(&self) -> Instant {
        if self.queue.is_empty() { self.next_listen } else { self.queue.deadline() }
    }

    /// The SyncManagers of the mailbox that its state has; none for a slave without one.
    pub(crate) fn mailbox(&self) -> Option<(SyncManagerSettings, SyncManagerSettings)> {
        let mailbox = self.settings.mailbox.as_ref()?;
        let in_boot = mailbox.in_boot().filter(|_| self.state() == AlState::Boot);
        Some(in_boot.unwrap_or((mailbox.out, mailbox.inward)))
    }

    /// Keeps what a job has found. By its SII it is set up, unless somebody changes that.
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

    /// What the controller cannot do is not asked of it.
    pub(crate) const fn adapt_settings(&mut self) {
        let features = self.information.features;
        self.settings.bytewise_fmmus |= features.contains(EscFeatures::FMMU_BYTEWISE);
        self.settings.separate_commands |= features.contains(EscFeatures::NO_LRW);
    }

    /// Notes the state that a job has seen.
    pub(crate) fn note_state(&mut self, result: &Result<Outcome, Failure>) {
        if let Ok(Outcome::State(report)) | Err(Failure::Refused(report) | Failure::NotReached(report)) =
            result
        {
            self.report = *report;
        }
    }

    /// Notes AL status without its code.
    pub(crate) fn note_status(&mut self, status: AlStatus) {
        let code = if status.error { self.report.code } else { AlStatusCode::NO_ERROR };
        self.report = AlReport { status, code };
    }

    /// Its state, as it was read last.
    #[must_use]
    pub const fn state(&self) -> AlState {
        self.report.status.state
    }
}
