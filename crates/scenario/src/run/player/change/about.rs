//! What a condition is about, as far as orders decide it.

use coe_kit::indicators;
use wire::AlState;

use super::written::{BytesAt, Place};
use crate::model::{Condition, DataDirection, EventLog, IndicatorName, Quantity, Test, UnitSet, WhichUnit};

/// What a condition is about.
pub(super) enum About<'a> {
    /// Something in the world.
    World(Subject<'a>),
    Not(&'a Condition),
    AllOf(&'a [Condition]),
    AnyOf(&'a [Condition]),
}

/// Something in the world, as a condition wants it.
pub(super) enum Subject<'a> {
    /// The state of units, or what follows from it; with an AL status code it is an error in this state.
    State {
        units: &'a UnitSet,
        holds_in: HoldsIn<'a>,
        has_code: bool,
    },
    /// Data … Valid; without a direction both.
    Valid {
        units: &'a UnitSet,
        direction: Option<DataDirection>,
        valid: bool,
    },
    /// Bytes that an order can write.
    Bytes(BytesAt<'a>),
    /// A test of a value.
    Value {
        of: &'a Quantity,
        test: &'a Test,
    },
    /// Units without an error, or without a record of one.
    Healthy(&'a UnitSet),
    IoDataActive {
        units: &'a UnitSet,
        active: bool,
    },
    WorkingCounter {
        unit: &'a WhichUnit,
        value: u16,
    },
    EveryWorkingCounter,
    /// What orders do not decide, or have decided when they are done: what has happened, answers, programs, and so on.
    Other,
}

/// The states in which a condition holds.
pub(super) enum HoldsIn<'a> {
    This(AlState),
    /// Those in which RUN shows this pattern.
    Run(&'a str),
}

impl HoldsIn<'_> {
    pub(super) fn in_state(&self, state: AlState) -> bool {
        match self {
            Self::This(this) => *this == state,
            Self::Run(pattern) => indicators::run(state).id() == *pattern,
        }
    }

    /// Whether this is the only state.
    pub(super) fn only(&self, state: AlState) -> bool {
        let others = [AlState::Init, AlState::PreOp, AlState::SafeOp, AlState::Op, AlState::Boot];
        self.in_state(state) && !others.into_iter().any(|other| other != state && self.in_state(other))
    }
}

pub(super) fn about(condition: &Condition) -> About<'_> {
    About::World(match condition {
        Condition::Not(part) => return About::Not(part),
        Condition::AllOf(parts) => return About::AllOf(parts),
        Condition::AnyOf(parts) => return About::AnyOf(parts),
        Condition::State { units, state, al_status_code } => {
            Subject::State { units, holds_in: HoldsIn::This(*state), has_code: al_status_code.is_some() }
        }
        Condition::Indicator { indicator: IndicatorName::Run, units, pattern } => {
            Subject::State { units, holds_in: HoldsIn::Run(pattern), has_code: false }
        }
        Condition::DataValid { units, valid } => Subject::Valid { units, direction: None, valid: *valid },
        Condition::DirectionValid { units, direction, valid } => {
            Subject::Valid { units, direction: Some(*direction), valid: *valid }
        }
        Condition::Outputs { unit, at, bytes } => {
            Subject::Bytes(BytesAt { unit, place: Place::Outputs(*at), bytes })
        }
        Condition::Register { unit, register, value } => {
            Subject::Bytes(BytesAt { unit, place: Place::Register(register.0), bytes: value })
        }
        Condition::Object { unit, entry, value } => {
            Subject::Bytes(BytesAt { unit, place: Place::Entry(*entry), bytes: value })
        }
        Condition::Value { of, test } => Subject::Value { of, test },
        Condition::HasNoError { units }
        | Condition::RecordedNothing { units }
        | Condition::NewMessages { units, available: false }
        | Condition::EventLogEmpty { log: EventLog::System, units }
        | Condition::UnitError { units, error: false } => Subject::Healthy(units),
        Condition::IoDataActive { units, active } => Subject::IoDataActive { units, active: *active },
        Condition::WorkingCounter { unit, value } => Subject::WorkingCounter { unit, value: *value },
        Condition::EveryWorkingCounterExpected => Subject::EveryWorkingCounter,
        Condition::Recorded { .. }
        | Condition::RecordedAgain { .. }
        | Condition::HasError { .. }
        | Condition::DiagnosisConsistent { .. }
        | Condition::NewMessages { available: true, .. }
        | Condition::Inputs { .. }
        | Condition::VariableBytes { .. }
        | Condition::VariableValue { .. }
        | Condition::ProgramVariable { .. }
        | Condition::UserDefinedError { .. }
        | Condition::NoUserDefinedError { .. }
        | Condition::TaskOverrun { .. }
        | Condition::NoTaskOverrun { .. }
        | Condition::ProgramError { .. }
        | Condition::NoProgramError { .. }
        | Condition::UnitError { error: true, .. }
        | Condition::Indicator {
            indicator:
                IndicatorName::Err
                | IndicatorName::LinkIn
                | IndicatorName::LinkOut
                | IndicatorName::TsGreen
                | IndicatorName::TsRed,
            ..
        }
        | Condition::MasterHas { .. }
        | Condition::MasterHasBefore { .. }
        | Condition::ProcessDataCome { .. }
        | Condition::Cycles { .. }
        | Condition::MasterIdle
        | Condition::MasterGaveUp
        | Condition::MasterGaveUpAgain
        | Condition::SdoRefused { .. }
        | Condition::SdoGave { .. }
        | Condition::SdoTaken { .. }
        | Condition::RegisterGave { .. }
        | Condition::MailboxGave { .. }
        | Condition::MailboxSilent
        | Condition::FrameGave { .. }
        | Condition::FrameLost
        | Condition::Emergency { .. }
        | Condition::EmergenciesLost { .. }
        | Condition::EventLogHas { .. }
        | Condition::EventLogEmpty { log: EventLog::Access, .. }
        | Condition::DiagnosisMessage { .. }
        | Condition::DiagnosisMessageBytes { .. }
        | Condition::DiagnosisMessages { .. }
        | Condition::CaptureReplayed
        | Condition::AnswersDiffer { .. } => Subject::Other,
    })
}
