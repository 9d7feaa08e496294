//! The parts of a scenario that are ready, and the mistakes so far.

use plc::DeviceVariables;
use time::Duration;

use super::fault_names::FaultNames;
use super::files::Files;
use super::ordered::Ordered;
use super::problem::{Part, Problem};
use super::program_values::LastingValue;
use super::standing::Standing;
use crate::run::{LoadedProgram, MasterProgram, Replacement, SiiImage, UnitSource, Warning};

/// The master of a scenario.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum MasterOfLine {
    /// The scripted one.
    #[default]
    Scripted,
    /// Another one, which acts by itself.
    Other,
}

/// Makes a scenario ready.
pub(super) struct Maker<'f> {
    /// Returns the texts of files.
    pub(super) files: &'f mut dyn Files,
    pub(super) units: Vec<UnitSource>,
    /// The device variables of the units.
    pub(super) variables: Vec<DeviceVariables>,
    /// The master's own program.
    pub(super) master: Option<MasterProgram>,
    /// Who sends frames to the units.
    pub(super) master_of_line: MasterOfLine,
    /// It refers to a capture.
    pub(super) has_capture: bool,
    /// Programs that steps load.
    pub(super) programs: Vec<LoadedProgram>,
    /// Images that steps load into EEPROMs.
    pub(super) images: Vec<SiiImage>,
    /// Units that take the places of others.
    pub(super) replacements: Vec<Replacement>,
    /// The steps that load them, and their units.
    pub(super) loads: Vec<(usize, usize)>,
    /// Units whose last load has a mistake: their program is not known.
    pub(super) unreadable: Vec<usize>,
    /// Values of programs' variables that are checked to the end.
    pub(super) lasting_values: Vec<LastingValue>,
    /// Orders follow each other as steps; else the line that runs decides what is at work.
    pub(super) follows_steps: bool,
    /// The faults of frames with names in the steps so far.
    pub(super) fault_names: FaultNames,
    /// What all steps order.
    pub(super) ordered: Ordered,
    /// What the orders of the steps so far have changed.
    pub(super) standing: Standing,
    /// Number of steps and groups so far.
    pub(super) entries: usize,
    /// The latest time at which the scenario ends.
    pub(super) limit: Duration,
    pub(super) problems: Vec<Problem>,
    /// Steps that are no mistakes and test nothing.
    pub(super) warnings: Vec<Warning>,
}

impl<'f> Maker<'f> {
    pub(super) fn new(files: &'f mut dyn Files, has_capture: bool) -> Self {
        Self {
            files,
            has_capture,
            units: Vec::new(),
            variables: Vec::new(),
            master: None,
            master_of_line: MasterOfLine::default(),
            programs: Vec::new(),
            images: Vec::new(),
            replacements: Vec::new(),
            loads: Vec::new(),
            unreadable: Vec::new(),
            lasting_values: Vec::new(),
            follows_steps: true,
            fault_names: FaultNames::default(),
            ordered: Ordered::default(),
            standing: Standing::default(),
            entries: 0,
            limit: Duration::ZERO,
            problems: Vec::new(),
            warnings: Vec::new(),
        }
    }

    pub(super) fn refuse(&mut self, part: Part, message: impl Into<String>, help: impl Into<String>) {
        self.problems.push(Problem { part, message: message.into(), help: help.into() });
    }
}
