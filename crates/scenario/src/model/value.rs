//! Comparisons: what has a value, and tests of values.

use serde::{Deserialize, Serialize};

use super::act::MasterAct;
use super::amount::Amount;
use super::bytes::{Bytes, Entry};
use super::numbers::{EventCode, Hex};
use super::units::{Controller, UnitSet, WhichUnit};

/// What has a value.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "the tables of sentences say what each one means")]
pub enum Quantity {
    Object {
        unit: WhichUnit,
        entry: Entry,
    },
    Register {
        unit: WhichUnit,
        register: Hex<u16>,
    },
    /// One byte, as in the CPU Unit.
    OutputByte {
        unit: WhichUnit,
        at: u16,
    },
    /// One byte, as in the master.
    InputByte {
        unit: WhichUnit,
        at: u16,
    },
    /// All bytes, as in the CPU Unit.
    Outputs {
        unit: WhichUnit,
    },
    /// All bytes, as in the master.
    Inputs {
        unit: WhichUnit,
    },
    Variable {
        variable: String,
    },
    ProgramVariable {
        controller: Controller,
        name: String,
    },
    WorkingCounter {
        unit: WhichUnit,
    },
    /// How often the unit has recorded the event since it was switched on.
    Records {
        unit: WhichUnit,
        event: EventCode,
    },
    /// How often the master has done something.
    Acts {
        act: MasterAct,
    },
    /// The mean of the last periods of the process data of a unit.
    MeanPeriod {
        unit: WhichUnit,
    },
    /// The longest of them.
    LongestPeriod {
        unit: WhichUnit,
    },
    /// How many emergencies the master has received; without a code all of them.
    Emergencies {
        #[serde(default, skip_serializing_if = "Option::is_none")]
        code: Option<Hex<u16>>,
    },
    /// Cycles of the process data that are done.
    #[serde(with = "super::spelling::nothing")]
    Cycles,
}

impl Quantity {
    /// The units that it is about; none if it is about the master, or a variable finds its unit by its name.
    #[must_use]
    pub fn units(&self) -> Option<UnitSet> {
        match self {
            Self::Object { unit, .. }
            | Self::Register { unit, .. }
            | Self::OutputByte { unit, .. }
            | Self::InputByte { unit, .. }
            | Self::Outputs { unit }
            | Self::Inputs { unit }
            | Self::WorkingCounter { unit }
            | Self::MeanPeriod { unit }
            | Self::LongestPeriod { unit }
            | Self::Records { unit, .. } => Some(UnitSet::One(unit.clone())),
            Self::Acts { act } => Some(UnitSet::One(act.unit().clone())),
            Self::Variable { .. }
            | Self::ProgramVariable { .. }
            | Self::Emergencies { .. }
            | Self::Cycles => None,
        }
    }
}

/// A test of a value.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "the table of sentences says what each one means")]
pub enum Test {
    /// It has a value, and not the one that the sentence with `is` has after it: bytes of objects, registers, process
    /// data and device variables, a value of a variable of a program, a number.
    IsNot(String),
    /// It is this number: only what is counted.
    Equals(Amount),
    AtLeast(Amount),
    AtMost(Amount),
    Above(Amount),
    Below(Amount),
    Between {
        from: Amount,
        to: Amount,
    },
    BeginsWith(Bytes),
    HasBits(Hex<u32>),
    HasNoBits(Hex<u32>),
    /// It is this truth value: only a device variable of type BOOL.
    Is(bool),
    /// It is another value than at the beginning of the step.
    #[serde(with = "super::spelling::nothing")]
    Changes,
}
