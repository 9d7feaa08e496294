//! Scenarios: units, a scripted master, CPU Units, faults and expectations in virtual time.
//!
//! A file says what happens and what must follow; a replay is the same on every machine. Nothing here reads a
//! clock or a file: who does gives texts in and takes bytes out.

mod builder;
mod file;
pub mod model;
mod random;
mod ready;
mod replay;
mod run;
mod search;
pub mod words;

pub use builder::ScenarioBuilder;
pub use file::{ScenarioError, ScenarioErrors};
pub use model::{
    Choice, Condition, ConductOrder, Controller, CpuOrder, Disturbance, Expectation, FrameFault, FrameKind,
    LineOrder, MasterOrder, Mode, Order, Trigger, UnitOrder, UnitSet,
};
pub use ready::Files;
pub use run::{
    Aspect, DifferenceKind, Failure, MasterProgram, NotReplayable, ProgramFile, RandomPart, RecordedFrames,
    Recording, Report, Scenario, Step, UnitSource, UserProgram,
};
pub use search::Found;
pub use user_file::Wanted;
