//! Conditions that only a master of a scenario knows: what it has sent, read and received.

use crate::model::{Condition, Controller, Quantity};

/// The condition, or the part of it, that is about the scripted or the recorded master; none: no part is.
pub(super) fn is_of_master(condition: &Condition) -> Option<&Condition> {
    let is_of_it = match condition {
        Condition::Not(part) => return is_of_master(part),
        Condition::AllOf(parts) | Condition::AnyOf(parts) => return parts.iter().find_map(is_of_master),
        // The inputs are those that the master has received.
        Condition::Inputs { .. }
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
        | Condition::EveryWorkingCounterExpected
        | Condition::Emergency { .. }
        | Condition::CaptureReplayed
        | Condition::AnswersDiffer { .. } => true,
        Condition::ProgramVariable { controller, .. }
        | Condition::UserDefinedError { controller, .. }
        | Condition::NoUserDefinedError { controller }
        | Condition::TaskOverrun { controller }
        | Condition::NoTaskOverrun { controller }
        | Condition::ProgramError { controller, .. }
        | Condition::NoProgramError { controller } => is_master(controller),
        Condition::Value { of, .. } => has_masters_value(of),
        Condition::MasterHas { .. }
        | Condition::MasterHasBefore { .. }
        | Condition::ProcessDataCome { .. }
        | Condition::WorkingCounter { .. }
        | Condition::State { .. }
        | Condition::Recorded { .. }
        | Condition::RecordedAgain { .. }
        | Condition::RecordedNothing { .. }
        | Condition::HasError { .. }
        | Condition::HasNoError { .. }
        | Condition::DiagnosisConsistent { .. }
        | Condition::NewMessages { .. }
        | Condition::Object { .. }
        | Condition::Register { .. }
        | Condition::Outputs { .. }
        | Condition::VariableBytes { .. }
        | Condition::VariableValue { .. }
        | Condition::DataValid { .. }
        | Condition::DirectionValid { .. }
        | Condition::IoDataActive { .. }
        | Condition::UnitError { .. }
        | Condition::Indicator { .. }
        | Condition::EmergenciesLost { .. }
        | Condition::EventLogHas { .. }
        | Condition::EventLogEmpty { .. }
        | Condition::DiagnosisMessage { .. }
        | Condition::DiagnosisMessageBytes { .. }
        | Condition::DiagnosisMessages { .. } => false,
    };
    is_of_it.then_some(condition)
}

fn is_master(controller: &Controller) -> bool {
    *controller == Controller::Master
}

fn has_masters_value(of: &Quantity) -> bool {
    match of {
        Quantity::InputByte { .. }
        | Quantity::Inputs { .. }
        | Quantity::Emergencies { .. }
        | Quantity::Cycles => true,
        Quantity::ProgramVariable { controller, .. } => is_master(controller),
        Quantity::Object { .. }
        | Quantity::Acts { .. }
        | Quantity::MeanPeriod { .. }
        | Quantity::LongestPeriod { .. }
        | Quantity::WorkingCounter { .. }
        | Quantity::Register { .. }
        | Quantity::OutputByte { .. }
        | Quantity::Outputs { .. }
        | Quantity::Variable { .. }
        | Quantity::Records { .. } => false,
    }
}
