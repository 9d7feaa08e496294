//! Scenarios as plain values: steps, orders and conditions, with their form in JSON and TOML.
//!
//! No sentences are read here, and the model is independent of the world that its values describe. Units and
//! cables are identified by their numbers, from 1, units also by their names; faults, patterns, variables and programs by their names.

mod act;
mod amount;
mod bytes;
mod calendar;
mod condition;
mod cpu;
mod group;
mod master;
mod names;
mod numbers;
mod random;
mod same;
mod script;
mod spelling;
mod step;
mod step_form;
mod unit;
mod unit_words;
mod units;
mod value;

pub use plant::line::{
    Choice, Delay, Direction, Disturbance, FaultName, FrameFault, FrameKind, Frames, LineOrder, Way,
};

pub use act::MasterAct;
pub use amount::Amount;
pub(crate) use amount::Number;
pub(crate) use bytes::hex;
pub use bytes::{Bytes, Entry};
pub use calendar::Calendar;
pub(crate) use condition::LOGIC_DEPTH_MAX;
pub use condition::{Condition, DataDirection};
pub use cpu::{CpuMode, CpuOrder};
pub(crate) use group::{Branch, in_order};
pub use master::MasterOrder;
pub use names::{IndicatorName, Position, StateName};
pub use numbers::{EventCode, Hex, UserErrorCode};
pub(crate) use random::EXPECTED as RANDOM_EXPECTED;
pub use random::{Draws, RandomSteps};
pub(crate) use random::{RandomForm, RandomTable};
pub(crate) use same::Same;
pub use script::{FileWithProgram, Paths, Script, ScriptMaster, ScriptUnit};
pub use spelling::NotAValue;
pub(crate) use spelling::{hexadecimal, number};
pub use step::{Expectation, Group, Members, Mode, Order, Repetition, ScriptStep, Step, Trigger};
pub(crate) use step_form::StepForm;
pub use unit::{ConductOrder, EventLog, UnitOrder};
pub(crate) use unit::{ID_SWITCH, Needs};
pub(crate) use unit_words::UnitWords;
pub use units::{
    CableNumber, Controller, NoUnitName, UnitName, UnitNumber, UnitRange, UnitSet, UnitSpan, WhichUnit,
};
pub use value::{Quantity, Test};
