//! The NX Bus Function Module of the CPU Unit: its reaction to an error of the unit (manual, 8-3-4).
//!
//! For two families of errors, Control Parameter Error in Master (10410000) and NX Unit I/O Communications
//! Error (80200000), the reaction depends on the fail-soft operation. With *Stop*, I/O refreshing stops on the
//! NX bus, and continues when the error has been reset in the NX Bus Function Module. With *Fail-soft*, only
//! the unit with the error stops, and a reset in the unit is sufficient. After 10410000 the unit needs a restart before
//! the reset: it finds its settings only when it starts.

use nx_bus::{CpuHeader, UnitHeader};

/// The reaction of the NX Bus Function Module to an error of the two families for which the manual makes it
/// depend on this setting (manual, 8-3-4: 10410000 and 80200000).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FailSoftOperation {
    /// *Fail-soft*: only the unit with the error stops; an error reset in the unit is sufficient.
    #[default]
    FailSoft,
    /// *Stop*: I/O refreshing stops until the error is reset in the NX Bus Function Module.
    Stop,
}

/// Whether I/O is refreshed on the NX bus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum IoRefreshing {
    GoesOn,
    /// The NX Bus Function Module has stopped it because of an error of the unit.
    Stopped,
    /// The CPU Unit does not refresh I/O.
    Off,
}

/// A reset of its errors that a program has requested.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum NxBusReset {
    /// None, or it is complete.
    #[default]
    None,
    /// It starts at the end of the task period.
    Asked,
    /// The unit has not completed it yet.
    UnderWay,
}

impl NxBusReset {
    pub(crate) fn is_pending(self) -> bool {
        self != Self::None
    }
}

/// The NX Bus Function Module.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NxBusFunction {
    fail_soft: FailSoftOperation,
    refreshing: IoRefreshing,
    /// Number of error resets; the unit follows it, and reports its own count.
    error_resets: u32,
    /// The unit has not completed the last reset yet.
    awaits_reset: bool,
}

impl NxBusFunction {
    pub(crate) const fn new(fail_soft: FailSoftOperation) -> Self {
        Self { fail_soft, refreshing: IoRefreshing::GoesOn, error_resets: 0, awaits_reset: false }
    }

    pub(crate) const fn refreshing(&self) -> IoRefreshing {
        self.refreshing
    }

    /// Resets the errors here and in the unit.
    pub(crate) const fn reset_errors(&mut self) {
        self.error_resets = self.error_resets.wrapping_add(1);
        self.awaits_reset = true;
    }

    /// Whether the unit has not completed the last reset yet.
    pub(crate) const fn awaits_reset(&self) -> bool {
        self.awaits_reset
    }

    /// The CPU Rack is powered on again: there are no errors. The unit keeps counting resets, so the count continues.
    pub(crate) const fn power_on(&mut self) {
        self.refreshing = IoRefreshing::GoesOn;
        self.awaits_reset = false;
    }

    /// The information for the unit.
    pub(crate) fn tell(&self, header: &mut CpuHeader) {
        header.io_stopped = self.refreshing == IoRefreshing::Stopped;
        header.error_resets = self.error_resets;
    }

    /// Processes the report of the unit; returns whether I/O refreshing stops or continues because of it.
    pub(crate) fn hear(&mut self, header: &UnitHeader) -> Option<IoRefreshing> {
        let has_followed = header.error_resets == self.error_resets;
        let was_reset = self.awaits_reset && has_followed;
        self.awaits_reset &= !has_followed;
        let change = match (self.fail_soft, self.refreshing) {
            // An older error may be the one that the reset is for.
            (FailSoftOperation::Stop, IoRefreshing::GoesOn) if header.fail_soft_error && has_followed => {
                IoRefreshing::Stopped
            }
            (_, IoRefreshing::Stopped) if was_reset && !header.fail_soft_error => IoRefreshing::GoesOn,
            _ => return None,
        };
        self.refreshing = change;
        Some(change)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn heard(fail_soft_error: bool, error_resets: u32) -> UnitHeader {
        UnitHeader { fail_soft_error, error_resets, ..UnitHeader::default() }
    }

    #[test]
    fn with_fail_soft_nothing_stops() {
        let mut bus = NxBusFunction::new(FailSoftOperation::FailSoft);
        assert_eq!(bus.hear(&heard(true, 0)), None);
        assert_eq!(bus.refreshing(), IoRefreshing::GoesOn);
    }

    #[test]
    fn with_stop_only_a_reset_that_the_unit_has_followed_lets_it_go_on() {
        let mut bus = NxBusFunction::new(FailSoftOperation::Stop);
        assert_eq!(bus.hear(&heard(true, 0)), Some(IoRefreshing::Stopped));
        assert_eq!(bus.hear(&heard(false, 0)), None, "a reset in the unit is not enough");
        bus.reset_errors();
        assert_eq!(bus.hear(&heard(false, 0)), None, "the unit has not heard of it yet");
        assert_eq!(bus.hear(&heard(true, 1)), None, "the cause is still there");
        assert_eq!(bus.hear(&heard(false, 1)), None, "that reset is over");
        bus.reset_errors();
        assert_eq!(bus.hear(&heard(false, 2)), Some(IoRefreshing::GoesOn));
    }

    #[test]
    fn an_error_that_a_reset_is_about_stops_nothing_before_the_unit_has_followed_it() {
        let mut bus = NxBusFunction::new(FailSoftOperation::Stop);
        bus.reset_errors();
        assert_eq!(bus.hear(&heard(true, 0)), None, "the reset may be about it");
        assert_eq!(bus.hear(&heard(true, 1)), Some(IoRefreshing::Stopped), "it was not");
    }
}
