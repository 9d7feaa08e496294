//! Scenarios: units, a scripted master, CPU Units, faults and expectations in virtual time.
//!
//! A file says what happens and what must follow; a replay is the same on every machine. Nothing here reads a
//! clock or a file: who does gives texts in and takes bytes out.

mod builder;
mod dice;
mod expectation;
mod files;
mod hex;
mod line;
mod master;
mod orders;
mod programs;
mod random;
mod recorded;
mod recording;
mod replay;
mod scenario;
mod search;
pub mod sentence;
pub mod sentences;
mod story;
mod world;

pub use builder::ScenarioBuilder;
pub use expectation::Condition;
pub use files::Files;
pub use master::MasterProgram;
pub use orders::{
    Choice, ConductOrder, CpuOrder, Disturbance, Expectation, FrameFault, FrameKind, LineOrder, MasterOrder,
    Mode, Order, UnitOrder, UnitSet,
};
pub use programs::{Controller, ProgramFile};
pub use recorded::{Aspect, DifferenceKind, NotReplayable, RecordedFrames};
pub use recording::Recording;
pub use replay::{Failure, Report};
pub use scenario::{
    RandomPart, Scenario, ScenarioError, ScenarioErrors, Step, Trigger, UnitSource, UserProgram,
};
pub use search::Found;
pub use user_file::Wanted;
