//! An executable scenario: units, master, steps, all of them checked.

use std::sync::Arc;

use esi::KnownDevice;
use plant::UnitFile;
use plc::{Builtin, Io, Program};
use time::Duration;

use super::master::MasterProgram;
use super::programs::{LoadedProgram, ProgramFile, SiiImage};
use super::recorded::{NotReplayable, RecordedFrames};
use super::warning::Warning;
use crate::model::{Calendar, Condition, Expectation, Members, Order, Step, Trigger};
use crate::random::ReadyDraws;

/// A scenario, ready to be replayed.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// What it demonstrates, in one sentence.
    pub title: String,
    /// The values of the parameters of its file, such as `loss = 1, state = OP`; none: the file has no parameters.
    pub case: Option<String>,
    /// The seed of its random generator.
    pub seed: u64,
    /// The time at which it ends, whatever is still waiting.
    pub limit: Duration,
    /// The units of the line, the one next to the master first.
    pub units: Vec<UnitSource>,
    /// Cycle of the process data.
    pub cycle: Duration,
    /// Start of the cycle within its period, from time 0; none: taken from the seed.
    pub cycle_phase: Option<Duration>,
    /// Date and time at which it starts.
    pub calendar: Calendar,
    /// The master's own user program; none: it only executes the orders of steps.
    pub master: Option<MasterProgram>,
    /// What steps bring to the places of the line.
    pub(crate) brought: Brought,
    /// The steps, in this order.
    pub steps: Vec<PlayedStep>,
    /// The capture whose frames a recorded master sends, as named in the file.
    pub capture: Option<String>,
    /// Its frames, after [`Scenario::load_capture`] has read them.
    pub(crate) recorded: RecordedFrames,
    /// The required trace for the scenario's own seed, byte for byte; none: any.
    pub golden_trace: Option<String>,
    /// The positions of random steps, in the order of the steps.
    pub random: Vec<RandomPart>,
    /// What the file says that is no mistake and tests nothing.
    pub warnings: Vec<Warning>,
}

impl Scenario {
    /// All steps in their order, those of groups once each.
    #[must_use]
    pub fn each_step(&self) -> Vec<&WrittenStep> {
        each_step(&self.steps)
    }

    /// What its steps bring to the places of the line.
    #[must_use]
    pub const fn brought(&self) -> &Brought {
        &self.brought
    }

    /// Stores the bytes of the capture in the file. Without them none of its frames are sent.
    ///
    /// # Errors
    /// [`NotReplayable`].
    pub fn load_capture(&mut self, bytes: &[u8]) -> Result<(), NotReplayable> {
        self.recorded = RecordedFrames::read(bytes)?;
        Ok(())
    }
}

/// One `random` of a scenario.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RandomPart {
    /// The step before which it is inserted.
    pub place: usize,
    /// Number of steps.
    pub count: usize,
    /// Their maximum duration together.
    pub span: Duration,
    /// Its line in the file, from 1.
    pub line: usize,
    /// Its bytes in the file.
    pub bytes: core::ops::Range<usize>,
    /// What they are drawn from; none: the everyday pool.
    pub(crate) draws: Option<ReadyDraws>,
}

/// A unit of the line.
#[derive(Clone, Debug)]
pub struct UnitSource {
    /// Its unit file.
    pub file: UnitFile,
    /// The program of its CPU Unit.
    pub program: UserProgram,
}

impl UnitSource {
    /// What the project of a master has about it.
    pub(crate) fn known_device(&self) -> Arc<KnownDevice> {
        Arc::new(self.file.section().known_device())
    }
}

/// What orders bring to the places of the line, as their files were read.
#[derive(Clone, Debug, Default)]
pub struct Brought {
    /// Programs for CPU Units.
    pub(crate) programs: Vec<LoadedProgram>,
    /// Images for EEPROMs.
    pub(crate) images: Vec<SiiImage>,
    /// Units that take the places of others.
    pub(crate) replacements: Vec<Replacement>,
}

impl Brought {
    /// The unit that takes this place.
    #[must_use]
    pub fn unit_at(&self, position: usize) -> Option<&UnitSource> {
        self.replacements.iter().find(|other| other.unit == position).map(|other| &other.source)
    }
}

/// A unit that takes the place of another one.
#[derive(Clone, Debug)]
pub(crate) struct Replacement {
    /// The position.
    pub(crate) unit: usize,
    /// Its unit file, as named.
    pub(crate) file: String,
    pub(crate) source: UnitSource,
}

/// What a CPU Unit runs.
#[derive(Clone, Debug)]
pub enum UserProgram {
    /// None: the data keep their values.
    None,
    /// A built-in program.
    Builtin(Builtin),
    /// A program in Structured Text.
    StructuredText(Box<ProgramFile>),
    /// A program of a test, created again for each replay.
    Custom(fn() -> Box<dyn Program + Send>),
}

impl UserProgram {
    /// The program in its initial state.
    #[must_use]
    pub fn start(&self) -> Box<dyn Program + Send> {
        match self {
            Self::None => Box::new(|_: &mut Io| {}),
            Self::Builtin(builtin) => builtin.program(),
            Self::StructuredText(file) => Box::new(file.program.clone()),
            Self::Custom(make) => make(),
        }
    }
}

/// An entry of the executable steps.
#[derive(Clone, Debug, PartialEq, Eq)]
#[expect(clippy::large_enum_variant, reason = "nearly all of them are steps")]
pub enum PlayedStep {
    /// A step.
    Step(WrittenStep),
    /// A group of steps.
    Group(WrittenGroup),
}

/// A group of steps, and how it was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrittenGroup {
    /// The time at which it is due.
    pub trigger: Trigger,
    /// Its steps.
    pub members: Members<PlayedStep>,
    /// Its line in the file, from 1; for a script that is not a file, its number.
    pub line: usize,
    /// Its keys.
    pub text: String,
}

/// One step, and how it was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrittenStep {
    /// The step.
    pub step: Step,
    /// Its line in the file, from 1; for a script that is not a file, its number.
    pub line: usize,
    /// The sentence of the order or of the condition, as written.
    pub text: String,
}

/// All steps in their order, those of groups once each.
pub(crate) fn each_step(entries: &[PlayedStep]) -> Vec<&WrittenStep> {
    let mut steps = Vec::new();
    add_steps(entries, &mut steps);
    steps
}

/// All conditions of the steps, and of the groups around them.
pub(crate) fn conditions(entries: &[PlayedStep]) -> Vec<&Condition> {
    let mut conditions = Vec::new();
    add_conditions(entries, &mut conditions);
    conditions
}

fn add_conditions<'s>(entries: &'s [PlayedStep], conditions: &mut Vec<&'s Condition>) {
    for entry in entries {
        match entry {
            PlayedStep::Step(WrittenStep { step, .. }) => {
                conditions.extend(step.trigger.condition());
                if let Order::Expect(Expectation { condition, mode }) = &step.order {
                    conditions.extend([condition].into_iter().chain(mode.condition()));
                }
            }
            PlayedStep::Group(group) => {
                conditions.extend(group.trigger.condition());
                group.members.sequences().iter().for_each(|steps| add_conditions(steps, conditions));
            }
        }
    }
}

fn add_steps<'s>(entries: &'s [PlayedStep], steps: &mut Vec<&'s WrittenStep>) {
    for entry in entries {
        match entry {
            PlayedStep::Step(step) => steps.push(step),
            PlayedStep::Group(group) => {
                group.members.sequences().iter().for_each(|entries| add_steps(entries, steps));
            }
        }
    }
}
