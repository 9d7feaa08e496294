//! The values that have been reported to the slave stack, so that only changes are actions.

use device::Action;
use wire::AlStatusCode;

/// Fault and station alias as reported.
#[derive(Debug, Default)]
pub(super) struct Reported {
    fault: Option<AlStatusCode>,
    station_alias: Option<u16>,
}

impl Reported {
    pub(super) fn fault(&mut self, fault: Option<AlStatusCode>) -> Option<Action> {
        let is_new = core::mem::replace(&mut self.fault, fault) != fault;
        is_new.then(|| fault.map_or(Action::FaultEnded, Action::Fault))
    }

    /// If no alias has been set, the value loaded from the SII is kept.
    pub(super) fn station_alias(&mut self, alias: Option<u16>) -> Option<Action> {
        let is_new = core::mem::replace(&mut self.station_alias, alias) != alias;
        alias.filter(|_| is_new).map(Action::StationAlias)
    }
}
