//! Why a slave leaves its state without a request: SyncManagers that change, outputs that are missing.

use esc::Pdi;
use time::Instant;
use wire::{AlState, AlStatusCode};

use super::Device;
use crate::conditions;
use crate::machine::{Indication, State};
use crate::unit::Unit;

impl<U: Unit> Device<U> {
    /// SyncManagers that become invalid cause a fall-back (reference 5.5).
    pub(super) fn watch_sync_managers(&mut self, pdi: &mut Pdi<'_>, now: Instant) {
        let (mailbox, process_data) = match self.machine.state {
            State::Init { .. } => return,
            State::Boot => (conditions::WATCHED_BOOTSTRAP, None),
            State::PreOp => (conditions::WATCHED_MAILBOX, None),
            State::SafeOp { .. } | State::Op { .. } => {
                (conditions::WATCHED_MAILBOX, Some(self.config.watched))
            }
        };
        let found = self.with_settings(pdi, |settings| settings.findings(mailbox));
        if !found.is_empty() {
            return self.drop_to(AlState::Init, &found, pdi, now);
        }
        if let Some(watched) = process_data {
            let found = self.with_settings(pdi, |settings| settings.findings(watched));
            self.drop_to(AlState::PreOp, &found, pdi, now);
        }
    }

    pub(super) fn watch_op_request(&mut self, pdi: &mut Pdi<'_>, now: Instant) {
        let Some(request) = self.machine.state.op_request() else { return };
        if self.outputs_received(pdi) {
            self.machine.state.take_op_request();
            self.reach(request.control, pdi, now);
        } else if now >= request.deadline {
            self.machine.state.take_op_request();
            let code = self.unit.al_error(now, AlStatusCode::SYNC_MANAGER_WATCHDOG);
            self.refuse(AlState::SafeOp, code, pdi, now);
        }
    }

    /// The reasons of the stack to leave the state, if there are any: the unit receives all of them, the first
    /// one is shown.
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

    /// The slave leaves its state without a request. When it leaves OP, the outputs, or the inputs of a unit
    /// without outputs, are closed until the master acknowledges, so that it sees the working counter drop
    /// (reference 5.5, C063).
    pub(super) fn fall_back(&mut self, state: AlState, code: AlStatusCode, pdi: &mut Pdi<'_>, now: Instant) {
        self.machine.state.take_op_request();
        self.enter(state, pdi, now);
        if state == AlState::SafeOp {
            self.close_process_data(pdi);
        }
        self.show(Indication::error(code), pdi);
    }
}
