//! Units get power, in phases that the seed decides where their files leave them out.

use plant::{PowerConditions, Powered};
use time::{Duration, Instant};
use unit_model::PowerOn;

use crate::run::bench::Supply;
use crate::run::dice::{Dice, dice_of_phases};
use crate::run::scenario::UnitSource;

/// The participants of the units that take the places of others begin here, so that their phases are their own.
const FIRST_REPLACEMENT: u64 = 1 << 32;

/// Gives power by a seed.
pub(super) struct SeededSupply {
    pub(super) seed: u64,
    /// The system time at the start.
    pub(super) calendar_ns: u64,
}

impl Supply for SeededSupply {
    fn power(&self, number: usize, unit: &UnitSource, now: Instant) -> Powered {
        let dice = dice_of_phases(self.seed, FIRST_REPLACEMENT + number as u64);
        powered(unit, dice, now, self.calendar_ns)
    }
}

/// A unit with its CPU Unit, according to its file. Phases that are left out are random.
pub(super) fn powered(source: &UnitSource, mut dice: Dice, now: Instant, calendar_ns: u64) -> Powered {
    let file = &source.file;
    let refresh_phase = dice.phase(file.section().refresh_period().unwrap_or(Duration::ZERO));
    let program = source.program.start();
    // A CONFIGURATION sets the period, whatever the unit file says.
    let own_period = program.task_period().filter(|period| !period.is_zero());
    let task_period = own_period.unwrap_or(file.cpu().task_period.value);
    let conditions = PowerConditions {
        unit: PowerOn { refresh_phase, ..PowerOn::default() },
        task_phase: dice.phase(task_period),
        seed: if file.behaviours().is_random() { dice.next() } else { 0 },
        system_time_ns: Some(calendar_ns.saturating_add(now.as_nanos())),
    };
    file.power_on(now, &conditions, program)
}
