//! Requests of the master: what is checked, when the state is reached, what a refusal shows.

use esc::Pdi;
use time::{Duration, Instant};
use wire::{AlControl, AlState, AlStatusCode};

use super::Device;
use crate::conditions;
use crate::config::{OutputsBeforeOp, RefusedInOp};
use crate::machine::{Indication, OpRequest, State};
use crate::state_machine::{Check, Transition, refusal, transition};
use crate::sync_managers::DataDirection;
use crate::unit::Unit;

impl<U: Unit> Device<U> {
    /// Takes a state request when its transition time is over. Until then it remains in AL control, so that a
    /// further write does not count.
    pub(super) fn watch_al_control(&mut self, pdi: &mut Pdi<'_>, now: Instant) {
        let Some(control) = pdi.al_control() else { return };
        let time = self
            .transition(control.state)
            .map_or(Duration::ZERO, |row| self.conduct.transition_times.of(row.from, row.to));
        if now >= *self.machine.request_due.get_or_insert(now + time) {
            self.machine.request_due = None;
            pdi.take_al_control();
            self.on_al_control(control, pdi, now);
        }
    }

    /// A state request (reference 5.3): an error must be acknowledged first, except for a request for INIT.
    fn on_al_control(&mut self, control: AlControl, pdi: &mut Pdi<'_>, now: Instant) {
        if let State::Init { fault: Some(code) } = self.machine.state {
            return self.refuse(AlState::Init, code, pdi, now);
        }
        if matches!(self.machine.indication, Indication::Error(_)) && !self.is_acknowledged_by(control) {
            return;
        }
        let waiting = self.machine.state.take_op_request();
        self.open_sync_managers(pdi);
        let from = self.al_state();
        match self.check_request(control.state, pdi, now) {
            Err(code) => {
                let is_transition = self.transition(control.state).is_some();
                let drops = from == AlState::Op && self.config.refused_in_op == RefusedInOp::DropToSafeOp;
                self.refuse(if drops && !is_transition { AlState::SafeOp } else { from }, code, pdi, now);
            }
            Ok(Answer::WithOutputs(limit)) => {
                // A master that repeats its request does not get more time.
                let deadline = waiting.map_or(now + limit, |request| request.deadline);
                if let State::SafeOp { op_request, .. } = &mut self.machine.state {
                    *op_request = Some(OpRequest { control, deadline });
                }
                self.show(Indication::Nothing, pdi);
            }
            Ok(Answer::Now) => self.reach(control, pdi, now),
        }
    }

    /// The row for a request, if the slave has this transition.
    fn transition(&self, to: AlState) -> Option<&'static Transition> {
        transition(self.al_state(), to).filter(|row| !row.needs_boot() || self.config.has_boot())
    }

    const fn is_acknowledged_by(&self, control: AlControl) -> bool {
        if control.acknowledge {
            !self.conduct.ignores_acknowledge
        } else {
            matches!(control.state, AlState::Init)
        }
    }

    /// Whether `state` can be reached from the present one, and when.
    fn check_request(&mut self, state: AlState, pdi: &Pdi<'_>, now: Instant) -> Result<Answer, AlStatusCode> {
        let Some(row) = self.transition(state) else {
            return Err(self.unit.al_error(now, refusal(self.al_state(), state)));
        };
        match self.conduct.refusals.of(state) {
            Some(code) => Err(code),
            None => self.check(row.check, pdi, now),
        }
    }

    fn check(&mut self, check: Check, pdi: &Pdi<'_>, now: Instant) -> Result<Answer, AlStatusCode> {
        let conditions = match check {
            Check::Nothing => return Ok(Answer::Now),
            Check::Outputs => return Ok(self.when_outputs_come(pdi)),
            Check::Mailbox => conditions::MAILBOX,
            Check::Bootstrap => conditions::BOOTSTRAP,
            Check::ProcessData => self.config.checks,
        };
        let found = self.with_settings(pdi, |settings| settings.findings(conditions));
        self.unit.check_transition(now, check, &found)?;
        Ok(Answer::Now)
    }

    /// OP waits for outputs that are monitored and have not been received yet.
    fn when_outputs_come(&self, pdi: &Pdi<'_>) -> Answer {
        let mut outputs = self.sync_managers_of(DataDirection::Outputs);
        let waits =
            self.has_outputs() && outputs.any(|index| pdi.is_watched(index)) && !self.outputs_received(pdi);
        match self.config.outputs_before_op {
            OutputsBeforeOp::Within(limit) if waits => Answer::WithOutputs(limit),
            OutputsBeforeOp::Within(_) | OutputsBeforeOp::NotRequired => Answer::Now,
        }
    }

    /// The state is reached: no error, and the Explicit Device ID if it is requested.
    pub(super) fn reach(&mut self, control: AlControl, pdi: &mut Pdi<'_>, now: Instant) {
        self.enter(control.state, pdi, now);
        let device_id = self.unit.explicit_device_id().filter(|_| control.device_id_request);
        self.show(device_id.map_or(Indication::Nothing, Indication::DeviceId), pdi);
    }

    /// A refused request: the error is shown in `state`, which differs from the current state if OP is left.
    pub(super) fn refuse(&mut self, state: AlState, code: AlStatusCode, pdi: &mut Pdi<'_>, now: Instant) {
        if state == self.al_state() {
            self.show(Indication::error(code), pdi);
        } else {
            self.fall_back(state, code, pdi, now);
        }
    }
}

/// The time of a permitted transition.
enum Answer {
    Now,
    /// When outputs are received, within this time.
    WithOutputs(Duration),
}
