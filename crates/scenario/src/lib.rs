//! Scenarios: units, a scripted master, CPU Units, faults and expectations in virtual time.
//!
//! [`model`] contains actions and expectations as plain values. [`words`] contains their sentences. A file or a
//! [`Script`](model::Script) becomes a [`Scenario`], whose replay is the same on every machine. Nothing here
//! reads a clock or a file: the caller passes texts in and gets bytes out.

mod builder;
mod dice_use;
mod file;
pub mod model;
pub mod pool;
mod random;
mod ready;
mod refused;
mod replay;
mod run;
mod search;
mod trace_difference;
mod vacuous;
pub mod words;

pub use builder::ScenarioBuilder;
pub use ready::{ErrorPlace, Files, KnownLine, ReadyOrder, ScenarioError, ScenarioErrors};
pub use refused::{Reason, Refused};
pub use run::{
    Aspect, Bench, Brought, DifferenceKind, Fact, FactKind, Failure, FailureKind, Lent, LineHands, Look,
    MasterProgram, Met, NotReplayable, Notes, Play, PlayedStep, ProgramFile, RandomPart, RecordedFrames,
    Recording, Records, Report, RunningLine, Scenario, Supply, Turn, UnitSource, UserProgram, Warning,
    Witness, WrittenGroup, WrittenStep,
};
pub use search::{Found, Search, Trial};
pub use trace_difference::{TraceDifference, trace_differences};
pub use user_file::Wanted;
pub use vacuous::{Vacuity, VacuousStep};
