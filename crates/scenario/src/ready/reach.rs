//! What orders and conditions are about: cables, and the subjects of conditions.

use crate::model::{CableNumber, Condition, Controller, LineOrder, Quantity};

pub(super) fn line_of(units: usize) -> String {
    format!("the line has {units} unit{}, counted from 1", if units == 1 { "" } else { "s" })
}

/// The cable of an order if the line has no such cable.
pub(super) fn missing_cable(order: &LineOrder, units: usize) -> Option<CableNumber> {
    let cable = match order {
        // The master of a scenario has one port: no cable leads back from the last unit.
        LineOrder::Unplug { cable } | LineOrder::Plug { cable } => Some(*cable),
        LineOrder::Disturb(disturbance) => disturbance.cable(),
        LineOrder::End { .. } | LineOrder::BeQuiet => None,
    };
    cable.filter(|cable| cable.position() >= units)
}

/// What a condition is about.
pub(super) enum Subject<'c> {
    /// Units, by their numbers.
    Units,
    Controller(&'c Controller),
    Variable,
    Master,
    /// The frames of a capture.
    Capture,
    /// Those of the conditions of which it consists.
    Parts,
}

pub(super) fn subject(condition: &Condition) -> Subject<'_> {
    match condition {
        Condition::State { .. }
        | Condition::Recorded { .. }
        | Condition::RecordedAgain { .. }
        | Condition::RecordedNothing { .. }
        | Condition::HasError { .. }
        | Condition::HasNoError { .. }
        | Condition::DiagnosisConsistent { .. }
        | Condition::NewMessages { .. }
        | Condition::DataValid { .. }
        | Condition::DirectionValid { .. }
        | Condition::IoDataActive { .. }
        | Condition::UnitError { .. }
        | Condition::EmergenciesLost { .. }
        | Condition::EventLogHas { .. }
        | Condition::EventLogEmpty { .. }
        | Condition::DiagnosisMessages { .. }
        | Condition::Indicator { .. }
        | Condition::Object { .. }
        | Condition::Register { .. }
        | Condition::Outputs { .. }
        | Condition::Inputs { .. }
        | Condition::Emergency { unit: Some(_), .. }
        | Condition::DiagnosisMessage { .. }
        | Condition::DiagnosisMessageBytes { .. }
        | Condition::SdoRefused { unit: Some(_), .. }
        | Condition::SdoGave { unit: Some(_), .. }
        | Condition::SdoTaken { unit: Some(_) }
        | Condition::MasterHas { .. }
        | Condition::MasterHasBefore { .. }
        | Condition::ProcessDataCome { .. }
        | Condition::WorkingCounter { .. } => Subject::Units,
        Condition::ProgramVariable { controller, .. }
        | Condition::UserDefinedError { controller, .. }
        | Condition::NoUserDefinedError { controller }
        | Condition::TaskOverrun { controller }
        | Condition::NoTaskOverrun { controller }
        | Condition::ProgramError { controller, .. }
        | Condition::NoProgramError { controller } => Subject::Controller(controller),
        Condition::VariableBytes { .. } | Condition::VariableValue { .. } => Subject::Variable,
        Condition::Cycles { .. }
        | Condition::MasterIdle
        | Condition::MasterGaveUp
        | Condition::MasterGaveUpAgain
        | Condition::SdoRefused { unit: None, .. }
        | Condition::SdoGave { unit: None, .. }
        | Condition::SdoTaken { unit: None }
        | Condition::RegisterGave { .. }
        | Condition::MailboxGave { .. }
        | Condition::MailboxSilent
        | Condition::FrameGave { .. }
        | Condition::FrameLost
        | Condition::EveryWorkingCounterExpected
        | Condition::Emergency { unit: None, .. } => Subject::Master,
        Condition::CaptureReplayed | Condition::AnswersDiffer { .. } => Subject::Capture,
        Condition::Value { of: Quantity::ProgramVariable { controller, .. }, .. } => {
            Subject::Controller(controller)
        }
        Condition::Value { of: Quantity::Variable { .. }, .. } => Subject::Variable,
        Condition::Value { of: Quantity::Emergencies { .. } | Quantity::Cycles, .. } => Subject::Master,
        Condition::Value { .. } => Subject::Units,
        Condition::Not(_) | Condition::AllOf(_) | Condition::AnyOf(_) => Subject::Parts,
    }
}
