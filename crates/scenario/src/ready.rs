//! What a script needs before it can run: its units and programs, and steps that refer to existing names.

mod acts;
mod certain;
mod error;
mod fault_names;
mod files;
mod groups;
mod idle_orders;
mod idle_warnings;
mod known_line;
mod known_parts;
mod line;
mod maker;
mod master;
mod masters_words;
mod model_words;
mod nodes;
mod ordered;
mod other_master;
mod possible;
mod problem;
mod process_data;
mod program_values;
mod programs;
mod random;
mod raw;
mod reach;
mod reports;
mod resolve;
mod standing;
mod steps;
mod times;
mod unit_files;
mod unit_names;
mod units;
mod values;
mod written;

use crate::model::{Script, in_order};
use crate::run::{Brought, RecordedFrames, Scenario, UnitSource};
pub use error::{ErrorPlace, ScenarioError, ScenarioErrors};
pub use files::Files;
pub(crate) use files::{Remembered, Texts};
pub(crate) use groups::DEPTH_MAX;
pub use known_line::{KnownLine, ReadyOrder};
use maker::{Maker, MasterOfLine};
pub(crate) use problem::{Part, Problem, StepPart};
use steps::{Ground, ReadySteps};
pub(crate) use times::LIMIT_MAX;
pub(crate) use unit_names::UnitNames;
pub(crate) use units::is_unit;
pub(crate) use written::{Written, group_words};

/// The remedy for a scenario without steps.
pub(crate) const STEPS_WAY_OUT: &str = "such as `steps = [{ expect = \"unit 1 is in INIT\" }]`";

/// The mistake in a list with nothing in it.
pub(crate) fn empty_list(key: &str) -> String {
    format!("`{key}` is an empty list")
}

/// A script, with the words of its steps.
pub(crate) struct Draft {
    pub(crate) script: Script,
    /// Of each step.
    pub(crate) written: Vec<Written>,
    /// Only steps were left out because of mistakes.
    pub(crate) is_whole: bool,
}

impl Scenario {
    /// An executable scenario from a script. `files` returns the texts of the files that it refers to.
    ///
    /// # Errors
    /// The mistakes: units and programs that cannot be read, values out of range, units and variables that do
    /// not exist, steps whose times run backwards.
    pub fn of(script: Script, files: &mut dyn Files) -> Result<Self, ScenarioErrors> {
        if script.steps.is_empty() {
            let (message, help) = (empty_list("steps"), STEPS_WAY_OUT.to_owned());
            return Err(ScenarioErrors::of_script(vec![Problem { part: Part::Script, message, help }]));
        }
        let entries = in_order(&script.steps).into_iter().enumerate();
        let written = entries.map(|(at, step)| Written::of_script(at, step)).collect();
        let (scenario, problems) = ready(Draft { script, written, is_whole: true }, files);
        if problems.is_empty() { Ok(scenario) } else { Err(ScenarioErrors::of_script(problems)) }
    }
}

/// A scenario, and its mistakes: it is executable if there are none.
pub(crate) fn ready(draft: Draft, files: &mut dyn Files) -> (Scenario, Vec<Problem>) {
    let mut maker = Maker::new(files, draft.script.capture.is_some());
    maker.units(&draft.script.units);
    made(maker, draft)
}

/// The same for a line with another master. Without `units` those of the scenario are on the line.
pub(crate) fn ready_for_line(
    draft: Draft,
    files: &mut dyn Files,
    units: Option<Vec<UnitSource>>,
) -> (Scenario, Vec<Problem>) {
    let mut maker = Maker::new(files, false);
    maker.master_of_line = MasterOfLine::Other;
    match units {
        Some(units) => maker.units_of_line(units, &draft.script),
        None => maker.units(&draft.script.units),
    }
    made(maker, draft)
}

/// The scenario, and all mistakes, of a maker that knows the units.
fn made(mut maker: Maker<'_>, draft: Draft) -> (Scenario, Vec<Problem>) {
    let Draft { mut script, written, is_whole } = draft;
    if is_whole && maker.problems.is_empty() {
        maker.number_units(&mut script.steps);
    }
    // Without the units it is unknown which names and addresses the master's program may use.
    if is_whole && maker.problems.is_empty() {
        maker.master = script.master.as_ref().and_then(|master| maker.master_program(master, &script.steps));
    }
    let ground = if is_whole && maker.problems.is_empty() { Ground::Firm } else { Ground::Missing };
    times::check(&mut maker, &script);
    // A step may put another unit into a place.
    let units = maker.units.clone();
    let ReadySteps { steps, random, .. } = maker.steps(script.steps, written, script.limit, ground);
    maker.check_keys_of_masters(script.capture.is_some(), script.master.is_some());
    let Maker { master, programs, images, replacements, problems, warnings, .. } = maker;
    let scenario = Scenario {
        title: script.title,
        case: None,
        seed: script.seed,
        limit: script.limit,
        units,
        cycle: script.cycle,
        cycle_phase: script.cycle_phase,
        calendar: script.calendar,
        master,
        brought: Brought { programs, images, replacements },
        steps,
        capture: script.capture,
        recorded: RecordedFrames::default(),
        golden_trace: None,
        random,
        warnings,
    };
    (scenario, problems)
}
