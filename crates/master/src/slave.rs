//! What the master knows of one slave.

use esi::Timeouts;
use esi::sii::SiiContents;

use crate::access::{Address, word};
use crate::event::{Failure, Outcome};
use crate::information::{DlStatus, EscInformation};
use crate::queue::{Found, Queue};
use crate::state::AlReport;

/// One slave of the line, as the search has found it.
#[derive(Debug)]
pub struct Slave {
    pub(crate) address: Address,
    pub(crate) queue: Queue,
    pub(crate) timeouts: Timeouts,
    pub(crate) report: AlReport,
    information: EscInformation,
    dl_status: DlStatus,
    alias: u16,
    sii: Option<SiiContents>,
}

impl Slave {
    pub(crate) fn new(position: u16) -> Self {
        Self {
            address: Address::Position(position),
            queue: Queue::new(),
            timeouts: Timeouts::default(),
            report: AlReport::NOTHING,
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

    /// Keeps what a job has found.
    pub(crate) fn keep(&mut self, found: Found, outcome: Outcome) {
        match (found, outcome) {
            (Found::Information, Outcome::Data(data)) => {
                self.information = EscInformation::parse(&data).unwrap_or_default();
            }
            (Found::DlStatus, Outcome::Data(data)) => self.dl_status = DlStatus::parse(&data),
            (Found::Alias, Outcome::Data(data)) => self.alias = word(&data),
            (Found::Sii, Outcome::Sii(contents)) => self.sii = Some(*contents),
            (Found::Information | Found::DlStatus | Found::Alias | Found::Sii, _) => {}
        }
    }

    /// Notes the state that a job has seen.
    pub(crate) fn note_state(&mut self, result: &Result<Outcome, Failure>) {
        if let Ok(Outcome::State(report)) | Err(Failure::Refused(report) | Failure::NotReached(report)) =
            result
        {
            self.report = *report;
        }
    }
}
