//! A scenario of the parts of its file.

use plc::DeviceVariables;
use time::Duration;
use toml::Spanned;

use super::entries::{File, StepEntry, UnitEntry};
use super::reader::Reader;
use crate::run::{RandomPart, RecordedFrames, Scenario, Step};

/// Seed of a scenario that names none.
const DEFAULT_SEED: u64 = 1;
const DEFAULT_LIMIT: Duration = Duration::from_secs(60);
const DEFAULT_CYCLE: Duration = Duration::from_millis(1);
/// The unit of a scenario that names none.
const DEFAULT_UNIT: &str = "model = \"nx-ect101\"";

impl Reader<'_> {
    pub(crate) fn scenario(&mut self, file: File) -> Scenario {
        self.read_units(file.units);
        if let Some(entry) = file.master {
            self.master = self.master_program(entry, &file.steps);
        }
        self.is_ground_missing = !self.errors.is_empty();
        let limit = file.limit.and_then(|limit| self.duration(&limit)).unwrap_or(DEFAULT_LIMIT);
        let cycle = file.cycle.and_then(|cycle| self.cycle(&cycle)).unwrap_or(DEFAULT_CYCLE);
        let cycle_phase = file.cycle_phase.and_then(|phase| self.duration(&phase));
        let (steps, random) = self.read_steps(file.steps, limit);
        Scenario {
            title: file.title.into_inner(),
            seed: file.seed.unwrap_or(DEFAULT_SEED),
            limit,
            units: core::mem::take(&mut self.units),
            cycle,
            cycle_phase,
            master: self.master.take(),
            programs: core::mem::take(&mut self.programs),
            steps,
            capture: file.capture,
            recorded: RecordedFrames::default(),
            golden_trace: None,
            random,
        }
    }

    fn read_units(&mut self, entries: Vec<Spanned<UnitEntry>>) {
        let mut units = Vec::new();
        for entry in entries {
            let span = entry.span();
            if let Some(unit) = self.unit(entry) {
                units.push(unit);
                self.unit_spans.push(span);
            }
        }
        if units.is_empty() && self.errors.is_empty() {
            units.extend(self.default_unit(DEFAULT_UNIT));
        }
        self.variables = units.iter().map(|unit| DeviceVariables::of_unit_file(&unit.file)).collect();
        self.units = units;
    }

    fn read_steps(
        &mut self,
        entries: Vec<Spanned<StepEntry>>,
        limit: Duration,
    ) -> (Vec<Step>, Option<RandomPart>) {
        let mut steps = Vec::new();
        let mut reached = Duration::ZERO;
        let mut random = None;
        for entry in entries {
            let span = entry.span();
            let entry = entry.into_inner();
            if entry.random.is_some() {
                self.random(&entry, span, steps.len(), &mut random);
                continue;
            }
            let repetition = self.repetition(&entry, span.clone());
            if let Some(step) = self.step(entry, span.clone()) {
                self.check_order(&step.trigger, &mut reached, limit, span);
                let again = repetition.map(|(times, trigger)| (0..times).map(move |_| trigger.clone()));
                let again = again.into_iter().flatten().map(|trigger| Step { trigger, ..step.clone() });
                let again: Vec<_> = again.collect();
                steps.push(step);
                steps.extend(again);
            }
        }
        (steps, random)
    }
}
