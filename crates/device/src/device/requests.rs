//! Requests of the master: what is checked, when the state is reached, what a refusal shows.

use esc::{Pdi, SmIndex};
use time::Instant;
use wire::{AlControl, AlState, AlStatus, AlStatusCode};

use super::Device;
use crate::checks;
use crate::config::{OutputsBeforeOp, RefusedInOp};
use crate::state_machine::{Check, refusal, transition};
use crate::unit::Unit;

impl<U: Unit> Device<U> {
    /// A state request (reference 5.3): an error has to be acknowledged first, except on the way to INIT.
    pub(super) fn on_al_control(&mut self, control: AlControl, pdi: &mut Pdi<'_>, now: Instant) {
        if let Some(code) = self.unit.fault() {
            return self.refuse(AlState::Init, code, pdi, now);
        }
        if self.status.error && !control.acknowledge && control.state != AlState::Init {
            return;
        }
        self.op_deadline = None;
        self.open_sync_managers(pdi);
        let from = self.status.state;
        match transition(from, control.state) {
            None => {
                let code = self.unit.al_error(now, refusal(from, control.state));
                let drops = from == AlState::Op && self.config.refused_in_op == RefusedInOp::DropToSafeOp;
                self.refuse(if drops { AlState::SafeOp } else { from }, code, pdi, now);
            }
            Some(row) => match self.check(row.check, pdi, now) {
                Err(code) => self.refuse(from, code, pdi, now),
                Ok(Answer::Later(deadline)) => {
                    self.op_deadline = Some(deadline);
                    self.show(AlStatus { state: from, ..AlStatus::default() }, AlStatusCode::NO_ERROR, pdi);
                }
                Ok(Answer::Now) => {
                    self.enter(control.state, pdi, now);
                    self.confirm(control, pdi);
                }
            },
        }
    }

    fn check(&mut self, check: Check, pdi: &Pdi<'_>, now: Instant) -> Result<Answer, AlStatusCode> {
        match check {
            Check::Nothing => {}
            Check::Mailbox => {
                let found = checks::mailbox(&self.config, pdi);
                self.unit.check_transition(now, check, &found)?;
            }
            Check::ProcessData => {
                let found = checks::process_data(&self.config, self.unit.process_data(), pdi);
                self.unit.check_transition(now, check, &found)?;
            }
            Check::Outputs => {
                let waits =
                    self.unit.process_data().outputs_bytes > 0 && !pdi.outputs_received(SmIndex::OUTPUTS);
                if let (OutputsBeforeOp::Within(limit), true) = (self.config.outputs_before_op, waits) {
                    return Ok(Answer::Later(now + limit));
                }
            }
        }
        Ok(Answer::Now)
    }

    /// The state is reached: no error, and the Explicit Device ID where it is asked for.
    fn confirm(&mut self, control: AlControl, pdi: &mut Pdi<'_>) {
        let device_id = self.unit.explicit_device_id().filter(|_| control.device_id_request);
        let status = AlStatus { state: control.state, error: false, device_id_loaded: device_id.is_some() };
        self.show(status, AlStatusCode(device_id.unwrap_or(0)), pdi);
    }

    /// A refused request: the error is shown in `state`, which differs from the current one where OP drops.
    pub(super) fn refuse(&mut self, state: AlState, code: AlStatusCode, pdi: &mut Pdi<'_>, now: Instant) {
        if state == self.status.state {
            self.show_error(state, code, pdi);
        } else {
            self.fall_back(state, code, pdi, now);
        }
    }
}

/// When a transition that may happen happens.
enum Answer {
    Now,
    /// As soon as outputs come, at the latest then.
    Later(Instant),
}
