//! Scenarios: units, a scripted master, CPU Units, faults and expectations in virtual time.
//!
//! [`model`] is what happens and what must follow, as plain values. [`words`] spells it in sentences. A file or a
//! [`Script`](model::Script) becomes a [`Scenario`], whose replay is the same on every machine. Nothing here reads a
//! clock or a file: the caller gives texts in and takes bytes out.

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
pub use ready::{ErrorPlace, Files, ScenarioError, ScenarioErrors};
pub use run::{
    Aspect, DifferenceKind, Failure, MasterProgram, NotReplayable, ProgramFile, RandomPart, RecordedFrames,
    Recording, Report, Scenario, UnitSource, UserProgram, WrittenStep,
};
pub use search::Found;
pub use user_file::Wanted;
