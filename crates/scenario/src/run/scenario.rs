//! A scenario that can be run: units, master, steps, all of them checked.

use nx_ect101::unit_file::UnitFile;
use plc::{Builtin, Io, Program};
use time::Duration;

use super::master::MasterProgram;
use super::programs::{LoadedProgram, ProgramFile};
use super::recorded::{NotReplayable, RecordedFrames};
use crate::model::Step;

/// A scenario, ready to be replayed.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// What it shows, in one sentence.
    pub title: String,
    /// The seed of its dice.
    pub seed: u64,
    /// The moment at which it is over, whatever waits.
    pub limit: Duration,
    /// The units of the line, the one next to the master first.
    pub units: Vec<UnitSource>,
    /// Cycle of the process data.
    pub cycle: Duration,
    /// Where in its period the cycle lies, from time 0; none: the seed decides.
    pub cycle_phase: Option<Duration>,
    /// The master's own user program; none: it only does what steps order.
    pub master: Option<MasterProgram>,
    /// Programs that steps load into CPU Units.
    pub(crate) programs: Vec<LoadedProgram>,
    /// What happens, in this order.
    pub steps: Vec<WrittenStep>,
    /// The capture whose frames a recorded master sends, as the file names it.
    pub capture: Option<String>,
    /// Its frames, once [`Scenario::load_capture`] has read them.
    pub(crate) recorded: RecordedFrames,
    /// The trace that the scenario's own seed has to give, byte for byte; none: any.
    pub golden_trace: Option<String>,
    /// Where the dice add steps of their own; none: nowhere.
    pub random: Option<RandomPart>,
}

impl Scenario {
    /// Takes the bytes of the capture that the file names. Without them nothing of it is sent.
    ///
    /// # Errors
    /// [`NotReplayable`].
    pub fn load_capture(&mut self, bytes: &[u8]) -> Result<(), NotReplayable> {
        self.recorded = RecordedFrames::read(bytes)?;
        Ok(())
    }
}

/// The part of a scenario that its dice write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RandomPart {
    /// In front of which step it goes.
    pub place: usize,
    /// How many steps.
    pub count: usize,
    /// How long they take together, at most.
    pub span: Duration,
    /// Its line in the file, from 1.
    pub line: usize,
    /// Its bytes in the file.
    pub bytes: core::ops::Range<usize>,
}

/// A unit of the line.
#[derive(Clone, Debug)]
pub struct UnitSource {
    /// Its unit file.
    pub file: UnitFile,
    /// What its CPU Unit runs.
    pub program: UserProgram,
}

/// What a CPU Unit runs.
#[derive(Clone, Debug)]
pub enum UserProgram {
    /// Nothing: the data stay as they are set.
    None,
    /// A program that needs no file.
    Builtin(Builtin),
    /// A program in Structured Text.
    StructuredText(Box<ProgramFile>),
    /// A program of a test, made anew for each replay.
    Custom(fn() -> Box<dyn Program + Send>),
}

impl UserProgram {
    pub(crate) fn start(&self) -> Box<dyn Program + Send> {
        match self {
            Self::None => Box::new(|_: &mut Io| {}),
            Self::Builtin(builtin) => builtin.program(),
            Self::StructuredText(file) => Box::new(file.program.clone()),
            Self::Custom(make) => make(),
        }
    }
}

/// One step, and how it was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrittenStep {
    /// The step.
    pub step: Step,
    /// Its line in the file, from 1; of a script that is no file, its number.
    pub line: usize,
    /// The sentence of the order or of the condition, as it was written.
    pub text: String,
}
