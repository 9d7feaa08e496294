//! The actions of the unit, performed immediately.

use esc::Pdi;
use time::Instant;
use wire::{AlState, Emergency};

use super::Device;
use crate::action::Action;
use crate::machine::State;
use crate::unit::{RefreshCause, Unit};

impl<U: Unit> Device<U> {
    /// Performs the actions of the unit until there are no more.
    pub(super) fn take_actions(&mut self, pdi: &mut Pdi<'_>, now: Instant) {
        while let Some(action) = self.unit.take_action() {
            self.act(action, pdi, now);
        }
    }

    fn act(&mut self, action: Action, pdi: &mut Pdi<'_>, now: Instant) {
        match action {
            Action::Fault(code) => {
                self.refuse(AlState::Init, code, pdi, now);
                self.machine.state = State::Init { fault: Some(code) };
            }
            Action::FaultEnded => {
                if let State::Init { fault } = &mut self.machine.state {
                    *fault = None;
                }
            }
            Action::StationAlias(alias) => pdi.set_station_alias(alias),
            Action::Refresh => self.exchange(RefreshCause::Change, pdi, now),
            Action::Emergency(emergency) => {
                // Lost ones are counted.
                let _ = self.queue_emergency(emergency);
            }
        }
    }

    /// Queues an emergency message, if the state has CoE; false if it is lost, which is counted.
    pub fn queue_emergency(&mut self, emergency: Emergency) -> bool {
        let has_coe = matches!(self.al_state(), AlState::PreOp | AlState::SafeOp | AlState::Op);
        let mailbox = self.mailbox.as_mut().filter(|_| has_coe);
        let is_queued = mailbox.is_some_and(|mailbox| mailbox.mailbox().queue_emergency(emergency).is_ok());
        self.emergencies_lost += u64::from(!is_queued);
        is_queued
    }

    /// Number of emergencies since power-on for which there was no room in the unit, no mailbox in their state,
    /// or no room in it. Those that were waiting when the slave went to INIT are not included.
    #[must_use]
    pub fn emergencies_lost(&self) -> u64 {
        self.emergencies_lost + self.unit.emergencies_lost()
    }
}
