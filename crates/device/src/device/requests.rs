//! Requests of the master: what is checked, when the state is reached, what a refusal shows.

use esc::{Pdi, SmIndex};
use time::{Duration, Instant};
use wire::{AlControl, AlState, AlStatus, AlStatusCode};

use super::{Device, OpRequest};
use crate::checks;
use crate::config::{OutputsBeforeOp, RefusedInOp};
use crate::state_machine::{Check, refusal, transition};
use crate::unit::Unit;

impl<U: Unit> Device<U> {
    /// Takes a state request when its transition has had its time. Until then it stays in AL control, so that a
    /// further write does not count.
    pub(super) fn watch_al_control(&mut self, pdi: &mut Pdi<'_>, now: Instant) {
        let Some(control) = pdi.al_control() else { return };
        let time = self.conduct.transition_times.of(self.status.state, control.state);
        if now >= *self.request_due.get_or_insert(now + time) {
            self.request_due = None;
            pdi.take_al_control();
            self.on_al_control(control, pdi, now);
        }
    }

    /// A state request (reference 5.3): an error has to be acknowledged first, except on the way to INIT.
    fn on_al_control(&mut self, control: AlControl, pdi: &mut Pdi<'_>, now: Instant) {
        if let Some(code) = self.unit.fault() {
            return self.refuse(AlState::Init, code, pdi, now);
        }
        if self.status.error && !self.is_acknowledged_by(control) {
            return;
        }
        let waiting = self.op_request.take();
        self.open_sync_managers(pdi);
        let from = self.status.state;
        match self.judge(control.state, pdi, now) {
            Err(code) => {
                let is_transition = transition(from, control.state).is_some();
                let drops = from == AlState::Op && self.config.refused_in_op == RefusedInOp::DropToSafeOp;
                self.refuse(if drops && !is_transition { AlState::SafeOp } else { from }, code, pdi, now);
            }
            Ok(Answer::WithOutputs(limit)) => {
                // A master that repeats its request does not get more time.
                let deadline = waiting.map_or(now + limit, |request| request.deadline);
                self.op_request = Some(OpRequest { control, deadline });
                self.show(AlStatus { state: from, ..AlStatus::default() }, AlStatusCode::NO_ERROR, pdi);
            }
            Ok(Answer::Now) => self.reach(control, pdi, now),
        }
    }

    const fn is_acknowledged_by(&self, control: AlControl) -> bool {
        if control.acknowledge {
            !self.conduct.ignores_acknowledge
        } else {
            matches!(control.state, AlState::Init)
        }
    }

    /// Whether `state` can be reached from the present one, and when.
    fn judge(&mut self, state: AlState, pdi: &Pdi<'_>, now: Instant) -> Result<Answer, AlStatusCode> {
        let from = self.status.state;
        let Some(row) = transition(from, state) else {
            return Err(self.unit.al_error(now, refusal(from, state)));
        };
        match self.conduct.refusals.of(state) {
            Some(code) => Err(code),
            None => self.check(row.check, pdi, now),
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
                let has_outputs = self.unit.process_data().outputs_bytes > 0;
                let waits = has_outputs
                    && pdi.is_watched(SmIndex::OUTPUTS)
                    && !pdi.outputs_received(SmIndex::OUTPUTS);
                if let (OutputsBeforeOp::Within(limit), true) = (self.config.outputs_before_op, waits) {
                    return Ok(Answer::WithOutputs(limit));
                }
            }
        }
        Ok(Answer::Now)
    }

    /// The state is reached: no error, and the Explicit Device ID where it is asked for.
    pub(super) fn reach(&mut self, control: AlControl, pdi: &mut Pdi<'_>, now: Instant) {
        self.enter(control.state, pdi, now);
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
    /// As soon as outputs come, within this time.
    WithOutputs(Duration),
}
