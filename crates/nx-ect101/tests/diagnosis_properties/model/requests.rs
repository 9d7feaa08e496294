//! The actions on the unit: of the hardware, the CPU Unit, a user and the master.

use nx_ect101::Fault;
use wire::AlState;

use super::{Error, Model, Situation};
use crate::rows::{self, FAULTS, Found, MINOR_FAULT, MISMATCH_C_TO_M, MISMATCH_M_TO_C, OBSERVATION};
use crate::settings::PdoSetting;

/// Abort code of a value that an entry does not accept.
const VALUE_RANGE: u32 = 0x0609_0030;
/// The value that 2100 accepts: "elcl".
const CLEAR_HISTORY: u32 = 0x6C63_6C65;

/// Hardware and CPU Unit.
impl Model {
    pub(crate) fn inject(&mut self, fault: Fault) {
        let row = rows::of_fault(fault);
        match row.found {
            // System information, of which there is none, and the NX bus.
            Found::Passing => self.occurs(row.event, vec![0, 0]),
            Found::AtOnce => {
                self.forget_bygone(fault);
                self.injected.insert(fault);
                self.find(fault);
            }
            Found::AtStart | Found::ByCheck => drop(self.injected.insert(fault)),
        }
    }

    pub(crate) fn remove(&mut self, fault: Fault) {
        self.injected.remove(&fault);
        if self.is_present(fault) {
            self.seen.insert(Situation::OneOfTwoIoCausesGone);
        }
    }

    /// An I/O communications error ends with its cause, even without a reset.
    fn forget_bygone(&mut self, fault: Fault) {
        if fault == Fault::IoCommunications && !self.is_present(fault) && self.found.remove(&fault) {
            self.untold.remove(&fault);
            self.seen.insert(Situation::IoCauseCameAgain);
        }
    }

    /// A fault is reported when it is found, and not again while it is present.
    fn find(&mut self, fault: Fault) {
        if self.found.insert(fault) {
            self.tell_fault(fault);
        }
    }

    fn tell_fault(&mut self, fault: Fault) {
        let system_information = if fault == Fault::Processing { 4 } else { 0 };
        self.occurs(rows::of_fault(fault).event, vec![0; system_information]);
    }

    /// A refresh, with the system time of the CPU Unit. The first one reports the findings of the start.
    pub(crate) fn refresh(&mut self, time_ns: u64, refreshing: bool) {
        self.time_ns = time_ns;
        if core::mem::take(&mut self.is_starting) {
            let untold = core::mem::take(&mut self.untold);
            for row in FAULTS.iter().filter(|row| untold.contains(&row.fault)) {
                self.tell_fault(row.fault);
            }
            for &(event, detail) in self.io.broken {
                self.stands(event, detail.into_iter().collect());
            }
        }
        let stopped = !refreshing && (self.cpu_stopped || self.cpu_refreshing);
        if stopped {
            self.forget_bygone(Fault::IoCommunications);
        }
        (self.cpu_stopped, self.cpu_refreshing) = (stopped, refreshing);
        if stopped {
            self.find(Fault::IoCommunications);
        } else if self.injected.contains(&Fault::IoCommunications) {
            self.seen.insert(Situation::OneOfTwoIoCausesGone);
        }
    }

    fn stands(&mut self, event: u32, details: Vec<u32>) {
        let standing = (event, details.clone());
        if !self.standing.contains(&standing) {
            self.standing.push(standing);
        }
        self.occurs(event, details);
    }
}

/// A user at the CPU Unit's side.
impl Model {
    /// The errors are reset (8-6); those whose cause persists occur again: faults in their order, then settings.
    pub(crate) fn reset_errors(&mut self) {
        self.clear_errors();
        let io = Fault::IoCommunications;
        if !self.is_present(io) {
            self.found.remove(&io);
            self.untold.remove(&io);
        }
        for row in FAULTS {
            if !self.found.contains(&row.fault) || self.untold.contains(&row.fault) {
                continue;
            }
            if self.is_present(row.fault) {
                self.tell_fault(row.fault);
            } else if row.event != rows::MEMORY_BROKEN {
                // It remains until the unit starts.
                self.seen.insert(Situation::CauseGoneBeforeReset);
                let detail = (row.fault == Fault::Processing).then_some(0);
                self.exists(Error { level: MINOR_FAULT, event: row.event, detail });
            }
        }
        for (event, details) in self.standing.clone() {
            self.occurs(event, details);
        }
    }

    /// 1: system event log, 2: access event log.
    pub(crate) fn clear_event_log(&mut self, number: u32) {
        match number {
            1 => self.clear_history(),
            _ => self.log.access.clear(),
        }
        self.occurs(rows::LOG_CLEARED, vec![number]);
    }

    /// Whether the level can be changed; it is effective from the next start (6-5-1).
    pub(crate) fn set_level(&mut self, event: u32, level: u16) -> bool {
        let changeable = matches!(event, MISMATCH_C_TO_M | MISMATCH_M_TO_C);
        let taken = changeable && matches!(level, OBSERVATION | MINOR_FAULT);
        if taken {
            self.set_levels.push((event, level));
        }
        taken
    }
}

/// The master, by SDO.
impl Model {
    /// Writes 10F3:03.
    pub(crate) fn acknowledge(&mut self, sub: u8) -> Result<(), u32> {
        if sub == 0 {
            self.clear_history();
            return Ok(());
        }
        if self.log.at(sub).is_none() {
            self.seen.insert(Situation::EmptySlotAcknowledged);
            return Err(VALUE_RANGE);
        }
        self.last_acknowledged = sub;
        if sub == self.log.newest() {
            self.log_changed |= !self.log.acknowledged;
            self.log.acknowledged = true;
        } else {
            self.seen.insert(Situation::OlderAcknowledged);
        }
        Ok(())
    }

    /// Writes 10F3:05.
    pub(crate) fn set_flags(&mut self, flags: u16) -> Result<(), u32> {
        if flags > 1 {
            return Err(VALUE_RANGE);
        }
        self.emergencies_enabled = flags == 1;
        Ok(())
    }

    /// Writes 2002:02.
    pub(crate) fn write_clear_errors(&mut self, value: u8) -> Result<(), u32> {
        if value != 1 {
            return Err(VALUE_RANGE);
        }
        self.reset_errors();
        Ok(())
    }

    /// Writes 2100.
    pub(crate) fn write_clear_history(&mut self, value: u32) -> Result<(), u32> {
        if value != CLEAR_HISTORY {
            return Err(VALUE_RANGE);
        }
        self.clear_history();
        Ok(())
    }

    /// No event reports that the master has cleared the log.
    fn clear_history(&mut self) {
        self.log.clear_history();
        self.last_acknowledged = 0;
        self.log_changed = true;
    }
}

/// The master, by the state machine.
impl Model {
    /// The stack refuses a request, or leaves a state. Returns the AL status code for the master.
    pub(crate) fn al_error(&mut self, code: u16) -> u16 {
        let (event, code) = rows::of_al_status_code(code);
        self.tell(&event.map(|event| (event, None)).into_iter().collect::<Vec<_>>());
        code
    }

    pub(crate) fn enter(&mut self, state: AlState) {
        self.state = state;
        if !matches!(state, AlState::SafeOp | AlState::Op) {
            // No data are exchanged, so that no sizes must match.
            self.standing.retain(|(event, _)| !matches!(*event, MISMATCH_C_TO_M | MISMATCH_M_TO_C));
        }
    }

    /// INIT to PRE-OP.
    pub(crate) fn check_mailbox(&mut self, found: &[u16]) -> Result<(), u16> {
        self.sii_not_loaded |= found.contains(&0x0051);
        let sii_is_wrong = self.is_present(Fault::SiiVerification);
        if sii_is_wrong {
            self.find(Fault::SiiVerification);
        }
        for &code in found {
            self.al_error(code);
        }
        let first = if sii_is_wrong { Some(&0x0014) } else { found.first() };
        first.map_or(Ok(()), |&code| Err(code))
    }

    /// PRE-OP to SAFE-OP: all violations are reported, the first one stops the unit.
    pub(crate) fn check_process_data(&mut self, setting: &PdoSetting, found: &[u16]) -> Result<(), u16> {
        self.tell(setting.broken);
        let mut codes: Vec<u16> = setting.broken.iter().map(|told| al_status_code(told.0)).collect();
        let sm_codes: Vec<u16> =
            found.iter().copied().filter(|code| matches!(code, 0x001D | 0x001E)).collect();
        sm_codes.iter().for_each(|&code| codes.push(self.al_error(code)));
        if self.is_present(Fault::SmEventMode) {
            self.tell_fault(Fault::SmEventMode);
            codes.push(0x0028);
        }
        let others = found.iter().copied().filter(|code| !sm_codes.contains(code));
        others.for_each(|code| codes.push(self.al_error(code)));
        for (way, event) in [MISMATCH_M_TO_C, MISMATCH_C_TO_M].into_iter().enumerate() {
            if setting.mismatch[way] && self.io.is_sound[way] {
                self.stands(event, Vec::new());
            }
        }
        let Some(&first) = codes.first() else {
            self.mapped = setting.clone();
            return Ok(());
        };
        self.enter(AlState::PreOp);
        Err(first)
    }
}

/// AL status code of a wrong PDO setting (8-5-2).
fn al_status_code(event: u32) -> u16 {
    match event {
        0x3509_0000 | 0x3915_0000 | 0x391F_0000 | 0x392D_0000 | 0x392F_0000 => 0x0024,
        _ => 0x0025,
    }
}
