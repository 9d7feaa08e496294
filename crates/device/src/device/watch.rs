//! Why a slave leaves its state on its own: faults of its unit, SyncManagers that go, outputs that do not come.

use esc::{Pdi, SmIndex};
use time::Instant;
use wire::{AlState, AlStatusCode};

use super::{Device, error_status};
use crate::checks;
use crate::unit::Unit;

impl<U: Unit> Device<U> {
    /// A fault of the unit takes the slave to INIT, whenever it comes. An Explicit Device ID in place of the AL
    /// status code can have the same number, so all that is shown counts.
    pub(super) fn watch_fault(&mut self, pdi: &mut Pdi<'_>, now: Instant) {
        if let Some(code) = self.unit.fault()
            && (self.status, self.code) != (error_status(AlState::Init, code), code)
        {
            self.refuse(AlState::Init, code, pdi, now);
        }
    }

    /// SyncManagers that become invalid take the slave down (reference 5.5).
    pub(super) fn watch_sync_managers(&mut self, pdi: &mut Pdi<'_>, now: Instant) {
        let state = self.status.state;
        if state == AlState::Init {
            return;
        }
        let mailbox = self.config.mailbox.as_ref();
        if let Some(Err(code)) = mailbox.map(|mailbox| checks::mailbox_sync_managers(mailbox, pdi)) {
            return self.drop_to(AlState::Init, &[code], pdi, now);
        }
        if matches!(state, AlState::SafeOp | AlState::Op) {
            let found = checks::watched_process_data(&self.config, self.unit.process_data(), pdi);
            self.drop_to(AlState::PreOp, &found, pdi, now);
        }
    }

    pub(super) fn watch_op_request(&mut self, pdi: &mut Pdi<'_>, now: Instant) {
        let Some(request) = self.op_request else { return };
        if pdi.outputs_received(SmIndex::OUTPUTS) {
            self.op_request = None;
            self.reach(request.control, pdi, now);
        } else if now >= request.deadline {
            self.op_request = None;
            let code = self.unit.al_error(now, AlStatusCode::SYNC_MANAGER_WATCHDOG);
            self.refuse(AlState::SafeOp, code, pdi, now);
        }
    }

    /// The stack itself has reasons to leave the state, if any: the unit hears of all, the first one is shown.
    pub(super) fn drop_to(
        &mut self,
        state: AlState,
        found: &[AlStatusCode],
        pdi: &mut Pdi<'_>,
        now: Instant,
    ) {
        let mut first = None;
        for &code in found {
            let code = self.unit.al_error(now, code);
            first.get_or_insert(code);
        }
        if let Some(code) = first {
            self.fall_back(state, code, pdi, now);
        }
    }

    /// The slave leaves its state on its own. Out of OP the outputs, or the inputs of a unit without outputs,
    /// are closed until the master acknowledges, so that it sees the working counter drop (reference 5.5, C063).
    pub(super) fn fall_back(&mut self, state: AlState, code: AlStatusCode, pdi: &mut Pdi<'_>, now: Instant) {
        self.op_request = None;
        self.enter(state, pdi, now);
        if state == AlState::SafeOp {
            let has_outputs = self.unit.process_data().outputs_bytes > 0;
            pdi.set_deactivated(if has_outputs { SmIndex::OUTPUTS } else { SmIndex::INPUTS }, true);
        }
        self.show_error(state, code, pdi);
    }
}
