//! Reading a scenario file.

mod master;
mod nodes;
mod reach;
mod resolve;
mod steps;
mod times;
mod units;

use core::ops::Range;

use plc::DeviceVariables;
use serde::Deserialize;
use time::Duration;
use toml::Spanned;
use user_file::{Mistakes, Wanted, of_another_kind};

use super::{RandomPart, Scenario, ScenarioError, ScenarioErrors, Step, Trigger, UnitSource, UserProgram};
use crate::files::{Files, Texts};
use crate::master::MasterProgram;
use crate::programs::LoadedProgram;
use crate::recorded::RecordedFrames;
use master::MasterEntry;
use units::UnitEntry;

/// Seed of a scenario that names none.
const DEFAULT_SEED: u64 = 1;
const DEFAULT_LIMIT: Duration = Duration::from_secs(60);
const DEFAULT_CYCLE: Duration = Duration::from_millis(1);
/// The unit of a scenario that names none.
const DEFAULT_UNIT: &str = "model = \"nx-ect101\"";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    title: Spanned<String>,
    seed: Option<u64>,
    limit: Option<Spanned<String>>,
    cycle: Option<Spanned<String>>,
    cycle_phase: Option<Spanned<String>>,
    capture: Option<String>,
    master: Option<Spanned<MasterEntry>>,
    #[serde(default)]
    units: Vec<Spanned<UnitEntry>>,
    steps: Vec<Spanned<StepEntry>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StepEntry {
    at: Option<Spanned<String>>,
    after: Option<Spanned<String>>,
    when: Option<Spanned<String>>,
    master: Option<Spanned<String>>,
    unit: Option<Spanned<String>>,
    cpu: Option<Spanned<String>>,
    line: Option<Spanned<String>>,
    expect: Option<Spanned<String>>,
    never: Option<Spanned<String>>,
    within: Option<Spanned<String>>,
    r#for: Option<Spanned<String>>,
    until: Option<Spanned<String>>,
    repeat: Option<Spanned<u64>>,
    every: Option<Spanned<String>>,
    jitter: Option<Spanned<String>>,
    random: Option<Spanned<u64>>,
}

impl Scenario {
    /// Reads the text of a scenario file. `files` gives the text of a unit file or of a user program that it names,
    /// by its path as it is seen from the scenario.
    ///
    /// # Errors
    /// What is wrong, in the order of the file: text that is no TOML (then nothing else is judged),
    /// unknown keys, sentences that are none, units that do not exist, steps that contradict each other, and what is
    /// wrong with programs, with its place in their files.
    pub fn parse(
        text: &str,
        files: impl FnMut(&str) -> Result<String, String>,
    ) -> Result<Self, ScenarioErrors> {
        Self::parse_with(text, &mut Texts(files))
    }

    /// Reads the text of a scenario file that may name folders of programs too.
    ///
    /// # Errors
    /// As [`Scenario::parse`].
    pub fn parse_with(text: &str, files: &mut dyn Files) -> Result<Self, ScenarioErrors> {
        let alone = |span: Range<usize>, message: String, help: String| ScenarioErrors {
            list: vec![ScenarioError::new(text, span, message, help)],
            more: 0,
        };
        if let Some(refusal) = of_another_kind(text.as_bytes(), "", Wanted::Scenario) {
            return Err(alone(0..0, refusal.message, refusal.help));
        }
        let file: File = toml::from_str(text).map_err(|error| {
            alone(error.span().unwrap_or_default(), error.message().to_owned(), String::new())
        })?;
        let mut reader = Reader {
            text,
            files,
            units: Vec::new(),
            unit_spans: Vec::new(),
            variables: Vec::new(),
            master: None,
            is_ground_missing: false,
            programs: Vec::new(),
            errors: Mistakes::default(),
        };
        let scenario = reader.scenario(file);
        if reader.errors.is_empty() {
            return Ok(scenario);
        }
        let (list, more) = reader.errors.into_parts();
        Err(ScenarioErrors { list, more })
    }
}

struct Reader<'a> {
    text: &'a str,
    /// Gives the texts of files.
    files: &'a mut dyn Files,
    units: Vec<UnitSource>,
    /// Where each of them is in the file.
    unit_spans: Vec<Range<usize>>,
    /// Their device variables.
    variables: Vec<DeviceVariables>,
    /// The master's own program.
    master: Option<MasterProgram>,
    /// A unit or a program is wrong, so that nobody can tell what steps may name.
    is_ground_missing: bool,
    /// Programs that steps load.
    programs: Vec<LoadedProgram>,
    errors: Mistakes<ScenarioError>,
}

impl Reader<'_> {
    fn refuse(&mut self, span: Range<usize>, message: impl Into<String>, help: impl Into<String>) {
        let text = self.text;
        self.errors.note(span.start, || ScenarioError::new(text, span, message.into(), help.into()));
    }

    fn scenario(&mut self, file: File) -> Scenario {
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
