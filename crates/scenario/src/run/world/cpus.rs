//! The CPU Units of a scenario; time passes for those that are due.

use core::ops::Range;

use plc::{CpuUnit, Io};
use time::{Deadlines, Instant};

use crate::run::story::Story;

/// A CPU Unit and the events of its program.
pub(super) struct Cpu {
    pub(super) unit: CpuUnit,
    pub(super) is_running: bool,
    pub(super) told: Story,
}

/// One CPU Unit for each unit, in the order of the line.
pub(super) struct Cpus {
    cpus: Vec<Cpu>,
    /// When each begins its next task period.
    deadlines: Deadlines,
}

impl Cpus {
    pub(super) fn new(units: Vec<CpuUnit>) -> Self {
        let deadlines = Deadlines::new(units.len());
        let cpu = |unit| Cpu { unit, is_running: true, told: Story::default() };
        let mut cpus = Self { cpus: units.into_iter().map(cpu).collect(), deadlines };
        cpus.each(0..cpus.cpus.len(), |_| ());
        cpus
    }

    pub(super) fn get(&self, at: usize) -> Option<&Cpu> {
        self.cpus.get(at)
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Cpu> {
        self.cpus.iter()
    }

    /// The memory that programs and I/O share, which no deadline depends on.
    pub(super) fn ios(&mut self) -> impl Iterator<Item = &mut Io> {
        self.cpus.iter_mut().map(|cpu| cpu.unit.io_mut())
    }

    pub(super) fn deadline(&self) -> Instant {
        self.deadlines.first()
    }

    /// Does something to some of them.
    pub(super) fn each(&mut self, positions: Range<usize>, mut order: impl FnMut(&mut Cpu)) {
        for (at, cpu) in self.cpus.iter_mut().enumerate().skip(positions.start).take(positions.len()) {
            order(cpu);
            self.deadlines.set(at, cpu.deadline());
        }
    }

    /// Runs each task that is due; `report` gets the events of its program that were not there a period ago.
    pub(super) fn cycle(&mut self, now: Instant, mut report: impl FnMut(usize, &str)) {
        let mut from = 0;
        while let Some(at) = self.deadlines.next_due(from, now) {
            from = at + 1;
            let Some(cpu) = self.cpus.get_mut(at).filter(|cpu| cpu.is_running) else { continue };
            cpu.unit.cycle(now);
            let events = cpu.unit.take_events().map(|record| record.event);
            cpu.told.period(events).iter().for_each(|words| report(at, words));
            self.deadlines.set(at, cpu.deadline());
        }
    }

    /// The events since their last task periods.
    pub(super) fn report(&mut self, mut report: impl FnMut(usize, &str)) {
        for (at, cpu) in self.cpus.iter_mut().enumerate() {
            let events = cpu.unit.take_events().map(|record| record.event);
            cpu.told.between(events).iter().for_each(|words| report(at, words));
        }
    }
}

impl Cpu {
    fn deadline(&self) -> Instant {
        if self.is_running { self.unit.deadline() } else { Instant::NEVER }
    }
}
