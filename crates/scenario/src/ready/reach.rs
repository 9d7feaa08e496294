//! The units of an order, to check whether they exist.

use crate::model::{
    CableNumber, Condition, Controller, CpuOrder, LineOrder, MasterOrder, Quantity, UnitNumber, UnitSet,
};

pub(super) fn line_of(units: usize) -> String {
    format!("the line has {units} unit{}, counted from 1", if units == 1 { "" } else { "s" })
}

impl UnitSet {
    pub(super) const fn exists(self, count: usize) -> bool {
        match self {
            Self::All => true,
            Self::One(unit) => unit.position() < count,
        }
    }
}

pub(super) fn unit_of_master(order: &MasterOrder) -> Option<UnitSet> {
    match order {
        MasterOrder::Take { units, .. } | MasterOrder::Request { units, .. } => Some(*units),
        MasterOrder::SetOutputs { unit, .. }
        | MasterOrder::MapPdo { unit, .. }
        | MasterOrder::AssignPdos { unit, .. }
        | MasterOrder::SetSyncManagerLength { unit, .. }
        | MasterOrder::SetSyncManagerControl { unit, .. }
        | MasterOrder::WriteSdo { unit, .. }
        | MasterOrder::ReadSdo { unit, .. }
        | MasterOrder::ReadCompleteSdo { unit, .. }
        | MasterOrder::WriteCompleteSdo { unit, .. }
        | MasterOrder::WriteSdoInSegments { unit, .. }
        | MasterOrder::ReadObjectList { unit, .. }
        | MasterOrder::DescribeObject { unit, .. }
        | MasterOrder::DescribeEntry { unit, .. }
        | MasterOrder::ReadRegister { unit, .. }
        | MasterOrder::SendMailboxMessage { unit, .. }
        | MasterOrder::WriteRegisterInHalves { unit, .. }
        | MasterOrder::WriteRegister { unit, .. } => Some(UnitSet::One(*unit)),
        MasterOrder::ExchangeProcessData { .. }
        | MasterOrder::StopProcessData
        | MasterOrder::UseMailboxCounter { .. }
        | MasterOrder::SendFrame { .. }
        | MasterOrder::ReadNoMailbox
        | MasterOrder::ReadNoEmergencies
        | MasterOrder::Behave
        | MasterOrder::Restart => None,
    }
}

pub(super) fn unit_of_cpu(order: &CpuOrder) -> Option<UnitSet> {
    match order {
        CpuOrder::SetMode { units, .. }
        | CpuOrder::StopIoRefreshing { units }
        | CpuOrder::StartIoRefreshing { units }
        | CpuOrder::StopTask { units }
        | CpuOrder::StartTask { units }
        | CpuOrder::ReleaseAll { units }
        | CpuOrder::ResetNxBusErrors { units }
        | CpuOrder::CycleRackPower { units }
        | CpuOrder::PowerOffRack { units }
        | CpuOrder::SendNxMessages { units, .. }
        | CpuOrder::PowerOnRack { units }
        | CpuOrder::JumpSystemTime { units, .. } => Some(*units),
        CpuOrder::SetInputs { unit, .. } | CpuOrder::Load { unit, .. } => Some(UnitSet::One(*unit)),
        CpuOrder::Force { .. } | CpuOrder::Write { .. } | CpuOrder::Release { .. } => None,
    }
}

/// Whether the cable of an order exists.
pub(super) fn is_cable_there(order: &LineOrder, units: usize) -> bool {
    match order {
        // The master of a scenario has one port: no cable leads back from the last unit.
        LineOrder::Unplug { cable } | LineOrder::Plug { cable } => cable.position() < units,
        LineOrder::Disturb(disturbance) => {
            let unit = disturbance.frames.unit.map(UnitNumber::position);
            let cable = disturbance.cable().map(CableNumber::position);
            unit.into_iter().chain(cable).all(|position| position < units)
        }
        LineOrder::End { .. } | LineOrder::BeQuiet => true,
    }
}

/// The units of a condition.
pub(super) enum Subject {
    Units(UnitSet),
    Controller(Controller),
    Variable,
    Master,
    /// The frames of a capture.
    Capture,
    /// Those of the conditions of which it consists.
    Parts,
}

pub(super) fn subject(condition: &Condition) -> Subject {
    match condition {
        Condition::State { units, .. }
        | Condition::Recorded { units, .. }
        | Condition::RecordedNothing { units }
        | Condition::HasError { units, .. }
        | Condition::HasNoError { units }
        | Condition::DiagnosisConsistent { units, .. }
        | Condition::NewMessages { units, .. }
        | Condition::DataValid { units, .. }
        | Condition::DirectionValid { units, .. }
        | Condition::IoDataActive { units, .. }
        | Condition::UnitError { units, .. }
        | Condition::EmergenciesLost { units, .. }
        | Condition::EventLogHas { units, .. }
        | Condition::EventLogEmpty { units, .. }
        | Condition::DiagnosisMessages { units, .. }
        | Condition::Indicator { units, .. } => Subject::Units(*units),
        Condition::Object { unit, .. }
        | Condition::Register { unit, .. }
        | Condition::Outputs { unit, .. }
        | Condition::Inputs { unit, .. }
        | Condition::Emergency { unit: Some(unit), .. }
        | Condition::DiagnosisMessage { unit, .. }
        | Condition::DiagnosisMessageBytes { unit, .. }
        | Condition::SdoRefused { unit: Some(unit), .. }
        | Condition::SdoGave { unit: Some(unit), .. }
        | Condition::SdoTaken { unit: Some(unit) }
        | Condition::WorkingCounter { unit, .. } => Subject::Units(UnitSet::One(*unit)),
        Condition::ProgramVariable { controller, .. }
        | Condition::UserDefinedError { controller, .. }
        | Condition::NoUserDefinedError { controller }
        | Condition::TaskOverrun { controller }
        | Condition::NoTaskOverrun { controller }
        | Condition::ProgramError { controller, .. }
        | Condition::NoProgramError { controller } => Subject::Controller(*controller),
        Condition::VariableBytes { .. } | Condition::VariableValue { .. } => Subject::Variable,
        Condition::Cycles { .. }
        | Condition::MasterIdle
        | Condition::MasterGaveUp
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
            Subject::Controller(*controller)
        }
        Condition::Value { of: Quantity::Variable { .. }, .. } => Subject::Variable,
        Condition::Value { of, .. } => of.units().map_or(Subject::Master, Subject::Units),
        Condition::Not(_) | Condition::AllOf(_) | Condition::AnyOf(_) => Subject::Parts,
    }
}
