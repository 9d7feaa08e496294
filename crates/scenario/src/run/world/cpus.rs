//! A CPU Unit of a scenario; time passes for those that are due.

use plc::{CpuUnit, CpuUnits, PeriodicTask};
use time::Instant;

use crate::run::story::Story;

/// The CPU Units of a scenario, in the order of the line.
pub(super) type Cpus = CpuUnits<Cpu>;

/// A CPU Unit and the events of its program.
pub(super) struct Cpu {
    pub(super) unit: CpuUnit,
    pub(super) is_running: bool,
    /// A CPU Unit without power does nothing.
    pub(super) has_power: bool,
    pub(super) told: Story,
}

impl Cpu {
    pub(super) fn running(unit: CpuUnit) -> Self {
        Self { unit, is_running: true, has_power: true, told: Story::default() }
    }

    /// Runs a task period; `report` gets the events of its program that were not there a period ago.
    pub(super) fn period(&mut self, now: Instant, report: impl FnMut(&str)) {
        self.unit.cycle(now);
        let events = self.unit.take_events().map(|record| record.event);
        tell(self.told.period(events), report);
    }

    /// The events since its last task period.
    pub(super) fn between(&mut self, report: impl FnMut(&str)) {
        let events = self.unit.take_events().map(|record| record.event);
        tell(self.told.between(events), report);
    }
}

impl PeriodicTask for Cpu {
    fn deadline(&self) -> Instant {
        if self.is_running && self.has_power { self.unit.deadline() } else { Instant::NEVER }
    }
}

fn tell(events: Vec<String>, mut report: impl FnMut(&str)) {
    events.iter().for_each(|words| report(words));
}
