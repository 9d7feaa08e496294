//! The units that orders and conditions name, to be replaced by their numbers and to be checked.

use plant::line::LineOrder;

use super::condition::Condition;
use super::cpu::CpuOrder;
use super::master::MasterOrder;
use super::step::Order;
use super::unit::UnitOrder;
use super::units::{Controller, UnitSet, UnitSpan, WhichUnit};
use super::value::Quantity;

/// The units that a value names.
pub(crate) enum UnitWords<'v> {
    One(&'v mut WhichUnit),
    Two([&'v mut WhichUnit; 2]),
    Set(&'v mut UnitSet),
}

impl<'v> UnitWords<'v> {
    /// Those that are named one by one.
    pub(crate) fn each(self) -> Vec<&'v mut WhichUnit> {
        match self {
            Self::One(unit) | Self::Set(UnitSet::One(unit)) => vec![unit],
            Self::Two(units) => units.into(),
            Self::Set(UnitSet::All) => Vec::new(),
            Self::Set(UnitSet::Several(spans)) => {
                let one = |span: &'v mut UnitSpan| match span {
                    UnitSpan::One(unit) => Some(unit),
                    UnitSpan::Range(_) => None,
                };
                spans.iter_mut().filter_map(one).collect()
            }
        }
    }

    /// All of them.
    pub(crate) fn set(&self) -> UnitSet {
        match self {
            Self::One(unit) => UnitSet::One(WhichUnit::clone(unit)),
            Self::Two([one, other]) if one == other => UnitSet::One(WhichUnit::clone(one)),
            Self::Two(units) => {
                UnitSet::Several(units.iter().map(|unit| UnitSpan::One(WhichUnit::clone(unit))).collect())
            }
            Self::Set(units) => UnitSet::clone(units),
        }
    }
}

impl Order {
    /// The units of an order; none if it names none, or if it is an expectation.
    pub(crate) fn unit_words(&mut self) -> Option<UnitWords<'_>> {
        match self {
            Self::Master(order) => of_master(order),
            Self::Unit(order) => Some(of_unit(order)),
            Self::Cpu(order) => of_cpu(order),
            Self::Line(LineOrder::Disturb(disturbance)) => {
                disturbance.frames.unit.as_mut().map(UnitWords::One)
            }
            Self::Line(
                LineOrder::Unplug { .. }
                | LineOrder::Plug { .. }
                | LineOrder::End { .. }
                | LineOrder::BeQuiet,
            )
            | Self::Expect(_) => None,
        }
    }
}

fn of_master(order: &mut MasterOrder) -> Option<UnitWords<'_>> {
    match order {
        MasterOrder::Take { units, .. } | MasterOrder::Request { units, .. } => Some(UnitWords::Set(units)),
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
        | MasterOrder::WriteRegister { unit, .. } => Some(UnitWords::One(unit)),
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

const fn of_unit(order: &mut UnitOrder) -> UnitWords<'_> {
    match order {
        UnitOrder::Restart { units }
        | UnitOrder::CyclePower { units }
        | UnitOrder::PowerOff { units }
        | UnitOrder::PowerOn { units }
        | UnitOrder::ResetErrors { units }
        | UnitOrder::ClearEventLog { units, .. }
        | UnitOrder::EraseSii { units }
        | UnitOrder::Conduct { units, .. }
        | UnitOrder::InjectFault { units, .. }
        | UnitOrder::RemoveFault { units, .. } => UnitWords::Set(units),
        UnitOrder::SetIdSwitch { unit, .. }
        | UnitOrder::InvertSiiWord { unit, .. }
        | UnitOrder::LoadSii { unit, .. }
        | UnitOrder::Replace { unit, .. } => UnitWords::One(unit),
    }
}

const fn of_cpu(order: &mut CpuOrder) -> Option<UnitWords<'_>> {
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
        | CpuOrder::JumpSystemTime { units, .. } => Some(UnitWords::Set(units)),
        CpuOrder::SetInputs { unit, .. } | CpuOrder::Load { unit, .. } => Some(UnitWords::One(unit)),
        CpuOrder::Force { .. } | CpuOrder::Write { .. } | CpuOrder::Release { .. } => None,
    }
}

impl Controller {
    const fn unit_words(&mut self) -> Option<UnitWords<'_>> {
        match self {
            Self::Master => None,
            Self::Unit(unit) => Some(UnitWords::One(unit)),
        }
    }
}

impl Condition {
    /// The units of a condition itself, without those of its parts; none if it names none.
    pub(crate) fn unit_words(&mut self) -> Option<UnitWords<'_>> {
        match self {
            Self::State { units, .. }
            | Self::Recorded { units, .. }
            | Self::RecordedAgain { units, .. }
            | Self::RecordedNothing { units }
            | Self::HasError { units, .. }
            | Self::HasNoError { units }
            | Self::DiagnosisConsistent { units, .. }
            | Self::NewMessages { units, .. }
            | Self::DataValid { units, .. }
            | Self::DirectionValid { units, .. }
            | Self::IoDataActive { units, .. }
            | Self::UnitError { units, .. }
            | Self::EmergenciesLost { units, .. }
            | Self::EventLogHas { units, .. }
            | Self::EventLogEmpty { units, .. }
            | Self::DiagnosisMessages { units, .. }
            | Self::Indicator { units, .. } => Some(UnitWords::Set(units)),
            Self::Object { unit, .. }
            | Self::Register { unit, .. }
            | Self::Outputs { unit, .. }
            | Self::Inputs { unit, .. }
            | Self::DiagnosisMessage { unit, .. }
            | Self::DiagnosisMessageBytes { unit, .. }
            | Self::ProcessDataCome { unit, .. }
            | Self::WorkingCounter { unit, .. } => Some(UnitWords::One(unit)),
            Self::MasterHas { act, .. } => Some(UnitWords::One(act.unit_mut())),
            Self::MasterHasBefore { first, then } => {
                Some(UnitWords::Two([first.unit_mut(), then.unit_mut()]))
            }
            Self::Emergency { unit, .. }
            | Self::SdoRefused { unit, .. }
            | Self::SdoGave { unit, .. }
            | Self::SdoTaken { unit } => unit.as_mut().map(UnitWords::One),
            Self::ProgramVariable { controller, .. }
            | Self::UserDefinedError { controller, .. }
            | Self::NoUserDefinedError { controller }
            | Self::TaskOverrun { controller }
            | Self::NoTaskOverrun { controller }
            | Self::ProgramError { controller, .. }
            | Self::NoProgramError { controller } => controller.unit_words(),
            Self::Value { of, .. } => of.unit_words(),
            Self::VariableBytes { .. }
            | Self::VariableValue { .. }
            | Self::Cycles { .. }
            | Self::MasterIdle
            | Self::MasterGaveUp
            | Self::MasterGaveUpAgain
            | Self::RegisterGave { .. }
            | Self::MailboxGave { .. }
            | Self::MailboxSilent
            | Self::FrameGave { .. }
            | Self::FrameLost
            | Self::EveryWorkingCounterExpected
            | Self::CaptureReplayed
            | Self::AnswersDiffer { .. }
            | Self::Not(_)
            | Self::AllOf(_)
            | Self::AnyOf(_) => None,
        }
    }

    /// The conditions of which it consists, to be changed.
    pub(crate) fn parts_mut(&mut self) -> &mut [Self] {
        match self {
            Self::Not(part) => core::slice::from_mut(part),
            Self::AllOf(parts) | Self::AnyOf(parts) => parts,
            _ => &mut [],
        }
    }
}

impl Quantity {
    fn unit_words(&mut self) -> Option<UnitWords<'_>> {
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
            | Self::Records { unit, .. } => Some(UnitWords::One(unit)),
            Self::Acts { act } => Some(UnitWords::One(act.unit_mut())),
            Self::ProgramVariable { controller, .. } => controller.unit_words(),
            Self::Variable { .. } | Self::Emergencies { .. } | Self::Cycles => None,
        }
    }
}
