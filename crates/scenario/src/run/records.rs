//! What a unit has recorded since it is in the line, as its model reports it.

use unit_model::{EventCode, Model};

use super::ledger::{Ledger, emergency_code};

/// The events of a unit.
#[derive(Debug, Default)]
pub(crate) struct Records {
    events: Vec<EventCode>,
    /// Its diagnosis history, as these events say.
    ledger: Ledger,
}

impl Records {
    /// It records an event of its model.
    pub(crate) fn record(&mut self, model: &dyn Model, event: EventCode) {
        self.events.push(event);
        if let Some(code) = emergency_code(model, event) {
            self.ledger.record(code);
        }
    }

    /// Its events, the oldest first.
    pub(crate) fn events(&self) -> &[EventCode] {
        &self.events
    }

    pub(crate) const fn ledger_mut(&mut self) -> &mut Ledger {
        &mut self.ledger
    }
}
