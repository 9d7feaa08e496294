//! What orders cause after they are done.

use plant::line::{Choice, Direction, FrameKind};

use super::reach::Reach;
use super::request::Request;
use super::written::{BytesAt, Place};
use crate::model::{
    CpuOrder, Disturbance, FrameFault, Frames, LineOrder, MasterOrder, Order, UnitOrder, UnitSet,
};

/// What an order causes after it is done.
pub(super) enum Effect<'a> {
    /// Nothing that decides a condition, or nothing later.
    Nothing,
    Request(Request<'a>),
    /// It writes these bytes.
    Written(BytesAt<'a>),
    /// Process data do not return as before.
    Interrupted(Interrupted<'a>),
    /// Frames reach these units.
    Contact(Reach<'a>),
    /// The cause of a fault appears.
    Fault(Reach<'a>),
    /// The CPU Units exchange no I/O data.
    IoStopped {
        reach: Reach<'a>,
        /// NX Unit I/O Data Active Status shows it, because the task runs.
        is_seen: bool,
    },
    IoStarted(Reach<'a>),
}

/// Process data that do not return as before.
pub(super) struct Interrupted<'a> {
    pub(super) reach: Reach<'a>,
    /// The units get none until another order: they leave OP.
    pub(super) leaves_op: bool,
}

pub(super) fn effect(order: &Order) -> Effect<'_> {
    match order {
        Order::Master(order) => of_master(order),
        Order::Unit(order) => of_unit(order),
        Order::Cpu(order) => of_cpu(order),
        Order::Line(order) => of_line(order),
        Order::Expect(_) => Effect::Nothing,
    }
}

const fn interrupted(reach: Reach<'_>) -> Effect<'_> {
    Effect::Interrupted(Interrupted { reach, leaves_op: true })
}

fn of_master(order: &MasterOrder) -> Effect<'_> {
    match order {
        MasterOrder::Take { units, state } => {
            Effect::Request(Request { reach: Reach::Units(units), state: *state, acknowledges: true })
        }
        MasterOrder::Request { units, state, acknowledge } => {
            Effect::Request(Request { reach: Reach::Units(units), state: *state, acknowledges: *acknowledge })
        }
        MasterOrder::SetOutputs { unit, at, bytes } => {
            Effect::Written(BytesAt { unit, place: Place::Outputs(*at), bytes })
        }
        MasterOrder::WriteRegister { unit, register, bytes }
        | MasterOrder::WriteRegisterInHalves { unit, register, bytes } => {
            Effect::Written(BytesAt { unit, place: Place::Register(register.0), bytes })
        }
        MasterOrder::WriteSdo { unit, entry, value }
        | MasterOrder::WriteSdoInSegments { unit, entry, value } => {
            Effect::Written(BytesAt { unit, place: Place::Entry(*entry), bytes: value })
        }
        MasterOrder::WriteCompleteSdo { unit, entry, value } => {
            Effect::Written(BytesAt { unit, place: Place::Object(*entry), bytes: value })
        }
        // A master that restarts sends no process data until it takes units to SAFE-OP.
        MasterOrder::StopProcessData | MasterOrder::Restart => interrupted(Reach::ALL),
        // Settings of the master, and what it only reads or sends as it is.
        MasterOrder::ExchangeProcessData { .. }
        | MasterOrder::MapPdo { .. }
        | MasterOrder::AssignPdos { .. }
        | MasterOrder::SetSyncManagerLength { .. }
        | MasterOrder::SetSyncManagerControl { .. }
        | MasterOrder::ReadSdo { .. }
        | MasterOrder::ReadCompleteSdo { .. }
        | MasterOrder::ReadObjectList { .. }
        | MasterOrder::DescribeObject { .. }
        | MasterOrder::DescribeEntry { .. }
        | MasterOrder::ReadRegister { .. }
        | MasterOrder::SendMailboxMessage { .. }
        | MasterOrder::SendFrame { .. }
        | MasterOrder::UseMailboxCounter { .. }
        | MasterOrder::ReadNoMailbox
        | MasterOrder::ReadNoEmergencies
        | MasterOrder::Behave => Effect::Nothing,
    }
}

fn of_unit(order: &UnitOrder) -> Effect<'_> {
    match order {
        UnitOrder::InjectFault { units, .. } => Effect::Fault(Reach::Units(units)),
        // The units themselves have changed at once, those behind them get no frames.
        UnitOrder::PowerOff { units } => interrupted(behind(units)),
        UnitOrder::PowerOn { units } => Effect::Contact(behind(units)),
        // They change the unit at once, or how it answers later orders.
        UnitOrder::Restart { .. }
        | UnitOrder::CyclePower { .. }
        | UnitOrder::ResetErrors { .. }
        | UnitOrder::ClearEventLog { .. }
        | UnitOrder::SetIdSwitch { .. }
        | UnitOrder::InvertSiiWord { .. }
        | UnitOrder::EraseSii { .. }
        | UnitOrder::LoadSii { .. }
        | UnitOrder::Replace { .. }
        | UnitOrder::Conduct { .. }
        // The effect of a fault stays until its recovery.
        | UnitOrder::RemoveFault { .. } => Effect::Nothing,
    }
}

fn of_cpu(order: &CpuOrder) -> Effect<'_> {
    match order {
        CpuOrder::StopIoRefreshing { units } => {
            Effect::IoStopped { reach: Reach::Units(units), is_seen: true }
        }
        CpuOrder::StopTask { units } => Effect::IoStopped { reach: Reach::Units(units), is_seen: false },
        CpuOrder::StartIoRefreshing { units } => Effect::IoStarted(Reach::Units(units)),
        CpuOrder::PowerOffRack { units } => interrupted(behind(units)),
        CpuOrder::PowerOnRack { units } => Effect::Contact(behind(units)),
        // They change the CPU Unit at once, or the program decides.
        CpuOrder::SetMode { .. }
        | CpuOrder::StartTask { .. }
        | CpuOrder::ResetNxBusErrors { .. }
        | CpuOrder::CycleRackPower { .. }
        | CpuOrder::SendNxMessages { .. }
        | CpuOrder::SetInputs { .. }
        | CpuOrder::JumpSystemTime { .. }
        | CpuOrder::Write { .. }
        | CpuOrder::Force { .. }
        | CpuOrder::Release { .. }
        | CpuOrder::ReleaseAll { .. }
        | CpuOrder::Load { .. } => Effect::Nothing,
    }
}

fn of_line(order: &LineOrder) -> Effect<'_> {
    match order {
        LineOrder::Unplug { cable } => interrupted(Reach::behind(cable.position())),
        LineOrder::Plug { cable } => Effect::Contact(Reach::behind(cable.position())),
        LineOrder::Disturb(disturbance) => of_disturbance(disturbance),
        LineOrder::End { .. } | LineOrder::BeQuiet => Effect::Nothing,
    }
}

/// A fault of frames, if it is certain that it meets the next process data.
fn of_disturbance(disturbance: &Disturbance) -> Effect<'_> {
    let Disturbance { fault, frames, way, lasts, .. } = disturbance;
    if !meets_process_data(frames) {
        return Effect::Nothing;
    }
    let is_kept_from_units = match fault {
        FrameFault::Lose | FrameFault::Cut { .. } | FrameFault::Corrupt { .. } => {
            way.direction == Direction::Outward
        }
        FrameFault::LoseAnswer
        | FrameFault::LowerWorkingCounter
        | FrameFault::LowerWorkingCounterBy { .. } => false,
        // The frames come, twice or later.
        FrameFault::Delay { .. } | FrameFault::Duplicate | FrameFault::Swap => return Effect::Nothing,
    };
    let reach = match (&frames.unit, disturbance.cable()) {
        (Some(unit), _) => Reach::one(unit),
        (None, Some(cable)) => Reach::behind(cable.position()),
        (None, None) => Reach::ALL,
    };
    let leaves_op = is_kept_from_units && frames.choice == Choice::All && lasts.is_none();
    Effect::Interrupted(Interrupted { reach, leaves_op })
}

const fn meets_process_data(frames: &Frames) -> bool {
    let has_process_data = match frames.kind {
        FrameKind::Any | FrameKind::ProcessData | FrameKind::Lrw => true,
        FrameKind::Mailbox
        | FrameKind::Sii
        | FrameKind::Nop
        | FrameKind::Aprd
        | FrameKind::Apwr
        | FrameKind::Aprw
        | FrameKind::Fprd
        | FrameKind::Fpwr
        | FrameKind::Fprw
        | FrameKind::Brd
        | FrameKind::Bwr
        | FrameKind::Brw
        | FrameKind::Lrd
        | FrameKind::Lwr
        | FrameKind::Armw
        | FrameKind::Frmw => false,
    };
    let is_certain = match frames.choice {
        Choice::All => true,
        // The next frame of any kind may be another one.
        Choice::Next(_) => !matches!(frames.kind, FrameKind::Any),
        Choice::Behind { .. } | Choice::Percent(_) | Choice::PerMille(_) | Choice::Every(_) => false,
    };
    has_process_data && is_certain
}

/// The first of these units, and all behind it.
fn behind(units: &UnitSet) -> Reach<'_> {
    Reach::behind(units.first())
}
