//! Conditions: what can hold.

use nx_ect101::{EventCode, Pattern};
use wire::AlState;

use super::units::{Controller, UnitSet};

/// What can hold.
#[derive(Clone, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the table of sentences tells what each one means")]
pub enum Condition {
    State { units: UnitSet, state: AlState, code: Option<u16> },
    Recorded { units: UnitSet, event: EventCode, times: Option<u64> },
    RecordedNothing(UnitSet),
    HasError { units: UnitSet, event: EventCode },
    HasNoError(UnitSet),
    NewMessages { units: UnitSet, available: bool },
    Object { unit: usize, entry: (u16, u8), value: Vec<u8> },
    Variable { name: String, bytes: Vec<u8> },
    Value { name: String, value: String },
    ProgramVariable { of: Controller, name: String, value: String },
    UserDefinedError { at: Controller, code: u16, times: Option<u64> },
    NoUserDefinedError(Controller),
    TaskOverrun { of: Controller, seen: bool },
    ProgramError { of: Controller, position: Option<(usize, usize)> },
    NoProgramError(Controller),
    Register { unit: usize, offset: u16, value: Vec<u8> },
    Outputs { unit: usize, bytes: Vec<u8> },
    Inputs { unit: usize, at: usize, bytes: Vec<u8> },
    OutputsFrom { unit: usize, at: usize, bytes: Vec<u8> },
    DataValid { units: UnitSet, valid: bool },
    DirectionValid { units: UnitSet, m_to_c: bool, valid: bool },
    IoDataActive { units: UnitSet, active: bool },
    UnitError { units: UnitSet, error: bool },
    Shows { indicator: IndicatorName, units: UnitSet, pattern: Pattern },
    WorkingCounter { unit: usize, value: u16 },
    Cycles(u64),
    MasterIdle,
    MasterGaveUp,
    SdoRefused(u32),
    SdoGave(Vec<u8>),
    SdoTaken,
    Emergency { code: u16, times: Option<u64> },
    CaptureReplayed,
    AnswersDiffer { at_most: u64 },
}

impl Condition {
    /// The units that it names, for a check that they exist.
    pub(crate) fn units(&self) -> Option<UnitSet> {
        match self {
            Self::State { units, .. }
            | Self::Recorded { units, .. }
            | Self::RecordedNothing(units)
            | Self::HasError { units, .. }
            | Self::HasNoError(units)
            | Self::NewMessages { units, .. }
            | Self::DataValid { units, .. }
            | Self::DirectionValid { units, .. }
            | Self::IoDataActive { units, .. }
            | Self::UnitError { units, .. }
            | Self::Shows { units, .. } => Some(*units),
            Self::Object { unit, .. }
            | Self::Register { unit, .. }
            | Self::Outputs { unit, .. }
            | Self::OutputsFrom { unit, .. }
            | Self::Inputs { unit, .. }
            | Self::WorkingCounter { unit, .. } => Some(UnitSet::One(*unit)),
            Self::Cycles(_)
            | Self::MasterIdle
            | Self::MasterGaveUp
            | Self::SdoRefused(_)
            | Self::SdoGave(_)
            | Self::SdoTaken
            | Self::Variable { .. }
            | Self::Value { .. }
            | Self::ProgramVariable { .. }
            | Self::UserDefinedError { .. }
            | Self::NoUserDefinedError(_)
            | Self::TaskOverrun { .. }
            | Self::ProgramError { .. }
            | Self::NoProgramError(_)
            | Self::CaptureReplayed
            | Self::AnswersDiffer { .. }
            | Self::Emergency { .. } => None,
        }
    }

    /// Whose user program it is about, if it is about one.
    pub(crate) const fn controller(&self) -> Option<Controller> {
        match self {
            Self::ProgramVariable { of, .. }
            | Self::UserDefinedError { at: of, .. }
            | Self::NoUserDefinedError(of)
            | Self::TaskOverrun { of, .. }
            | Self::ProgramError { of, .. }
            | Self::NoProgramError(of) => Some(*of),
            _ => None,
        }
    }
}

/// An indicator of a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IndicatorName {
    /// RUN.
    Run,
    /// ERR.
    Err,
    /// L/A IN.
    LinkIn,
    /// L/A OUT.
    LinkOut,
    /// TS, green.
    TsGreen,
    /// TS, red.
    TsRed,
}
