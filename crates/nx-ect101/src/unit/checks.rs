//! The checks of the unit for requests of the master: its own findings in addition to the stack's, and the
//! events of both.

use wire::AlStatusCode;

use crate::diagnosis::Occurrence;
use crate::events::Event;
use crate::fault::Fault;
use crate::finding::Finding;
use crate::rules;
use crate::unit::NxEct101;

impl NxEct101 {
    /// INIT to PRE-OP.
    pub(super) fn check_mailbox(&mut self, found: &[AlStatusCode]) -> Result<(), AlStatusCode> {
        let sii_is_right = self.verify_sii(found.contains(&AlStatusCode::EEPROM_ERROR));
        self.raise_all(found.iter().copied());
        sii_is_right?;
        found.first().map_or(Ok(()), |&code| Err(code))
    }

    /// The controller has loaded the SII, and it contains vendor, product and revision of the unit.
    fn verify_sii(&mut self, has_eeprom_error: bool) -> Result<(), AlStatusCode> {
        let diagnosis = &mut self.objects.diagnosis;
        let fault = Fault::SiiVerification;
        if has_eeprom_error || !self.memory.sii_is_own() {
            diagnosis.see(fault);
        } else if diagnosis.is_present(fault) {
            diagnosis.find(fault);
        } else {
            return Ok(());
        }
        Err(self.stop_in_init().unwrap_or(AlStatusCode::NO_VALID_FIRMWARE))
    }

    /// PRE-OP to SAFE-OP. All violations are recorded, the first finding is reported to the master: the
    /// mapping, the SyncManagers, the synchronization type, DC, buffers, watchdog; then mismatches, which stop
    /// nothing.
    pub(super) fn check_process_data(&mut self, found: &[AlStatusCode]) -> Result<(), AlStatusCode> {
        self.read_pdo_rules();
        let mapping = self.raise_broken_rules();
        let found = found.iter().copied();
        let sync_managers = found.clone().filter(is_sync_manager);
        let others = found.filter(|code| !is_sync_manager(code));
        self.raise_all(sync_managers.clone());
        let sync_mode = self.check_sync_mode();
        self.raise_all(others.clone());
        let first = mapping.or_else(|| sync_managers.chain(sync_mode).chain(others).next());
        self.raise_mismatches();
        if let Some(code) = first {
            self.settle_mismatches();
            return Err(code);
        }
        self.plan.rebuild(&self.pdo, &self.m_to_c_layout, &self.c_to_m_layout);
        self.objects.begin_exchange(&self.m_to_c_layout, &self.c_to_m_layout);
        // Data that the new mapping does not exchange have their default value again.
        self.m_to_c.fill(0);
        Ok(())
    }

    fn read_pdo_rules(&mut self) {
        self.pdo.follow(&self.objects.mapping);
        self.pdo_findings.clear();
        rules::check_at_safe_op(
            &self.settings.io_allocation,
            &self.pdo,
            &self.io_findings,
            &mut self.pdo_findings,
        );
    }

    /// The events of the rules that keep the unit in PRE-OP, and the AL status code of the first.
    fn raise_broken_rules(&mut self) -> Option<AlStatusCode> {
        let broken = self.pdo_findings.iter().filter(|finding| finding.al_status_code().is_some());
        for finding in broken.clone() {
            self.objects.diagnosis.raise(Occurrence::of_finding(finding));
        }
        broken.clone().find_map(Finding::al_status_code)
    }

    /// The master has set another synchronization than Free-Run; objects 1C32 and 1C33 accept no other value,
    /// so it is an injected fault (A17).
    fn check_sync_mode(&mut self) -> Option<AlStatusCode> {
        let fault = Fault::SmEventMode;
        if !self.objects.diagnosis.is_present(fault) {
            return None;
        }
        self.objects.diagnosis.raise(Occurrence::of_fault(fault));
        fault.al_status_code()
    }

    /// Mismatches of sizes persist while data are exchanged.
    fn raise_mismatches(&mut self) {
        let mismatches = self.pdo_findings.iter().filter(|finding| finding.al_status_code().is_none());
        for finding in mismatches {
            self.objects.diagnosis.raise_standing(Occurrence::of_finding(finding));
        }
    }

    /// No data are exchanged any more, so that there is no mismatch.
    pub(super) fn settle_mismatches(&mut self) {
        let is_mismatch = |code| matches!(code, Event::MISMATCH_C_TO_M | Event::MISMATCH_M_TO_C);
        self.objects.diagnosis.settle(is_mismatch);
    }

    fn raise_all(&mut self, codes: impl IntoIterator<Item = AlStatusCode>) {
        for code in codes {
            self.raise_al_error(code);
        }
    }

    /// The event of an AL status code that the stack has found, and the code as the unit reports it: its list
    /// (manual, 8-5-2) has none for BOOT.
    pub(super) fn raise_al_error(&mut self, code: AlStatusCode) -> AlStatusCode {
        let code = match code {
            AlStatusCode::BOOTSTRAP_NOT_SUPPORTED => AlStatusCode::INVALID_REQUESTED_STATE_CHANGE,
            code => code,
        };
        if let Some(event) = Event::of_al_status_code(code).next() {
            self.objects.diagnosis.raise(Occurrence::bare(event.code));
        }
        code
    }
}

fn is_sync_manager(code: &AlStatusCode) -> bool {
    matches!(*code, AlStatusCode::INVALID_OUTPUT_CONFIGURATION | AlStatusCode::INVALID_INPUT_CONFIGURATION)
}
