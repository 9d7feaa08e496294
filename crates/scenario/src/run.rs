//! Running a scenario: units, CPU Units, line and masters in virtual time, and checking its expectations.

mod all_warnings;
mod bench;
mod caught;
mod check;
mod dice;
mod frame_words;
mod ledger;
mod look;
mod master;
mod met;
mod named_units;
mod observed;
mod play;
mod player;
mod programs;
mod recorded;
mod recording;
mod records;
mod report;
mod running_line;
mod scenario;
mod stack_codes;
mod stage;
mod virtual_stage;
mod warning;
mod witness;
mod world;

pub use bench::{Bench, Lent, LineHands, Notes, Supply};
pub(crate) use check::{is_signed, register_bytes};
pub(crate) use dice::{DICE_OF_STEPS, Dice};
pub use look::Look;
pub use master::MasterProgram;
pub(crate) use master::{MasterVariables, NODE_ADDRESS_MAX, Node, changed_settings};
pub use met::{Fact, FactKind, Met};
pub use play::{Play, Turn};
pub(crate) use player::{ends, is_work, play};
pub use programs::ProgramFile;
pub(crate) use programs::{LoadedProgram, SiiImage};
pub use recorded::{Aspect, DifferenceKind, NotReplayable, RecordedFrames};
pub use recording::Recording;
pub use records::Records;
pub use report::{Failure, FailureKind, Report};
pub use running_line::RunningLine;
pub use scenario::{
    Brought, PlayedStep, RandomPart, Scenario, UnitSource, UserProgram, WrittenGroup, WrittenStep,
};
pub(crate) use scenario::{Replacement, each_step};
pub use warning::Warning;
pub use witness::Witness;
