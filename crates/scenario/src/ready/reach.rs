//! Which units an order is about, so that it can be told whether they are there.

use crate::model::{CpuOrder, MasterOrder, UnitOrder, UnitSet};

pub(crate) fn line_of(units: usize) -> String {
    format!("the line has {units} unit{}, counted from 1", if units == 1 { "" } else { "s" })
}

impl UnitSet {
    pub(crate) const fn exists(self, count: usize) -> bool {
        match self {
            Self::All => true,
            Self::One(at) => at < count,
        }
    }
}

pub(crate) fn unit_of_master(order: &MasterOrder) -> Option<UnitSet> {
    match order {
        MasterOrder::Take(units, _) | MasterOrder::Request { units, .. } => Some(*units),
        MasterOrder::SetOutputs(unit, ..)
        | MasterOrder::Map(unit, ..)
        | MasterOrder::Assign(unit, ..)
        | MasterOrder::SyncManagerLength { unit, .. }
        | MasterOrder::SyncManagerControl { unit, .. }
        | MasterOrder::WriteSdo(unit, ..)
        | MasterOrder::ReadSdo(unit, _)
        | MasterOrder::WriteInHalves(unit, ..)
        | MasterOrder::WriteRegister(unit, ..) => Some(UnitSet::One(*unit)),
        _ => None,
    }
}

pub(crate) fn unit_of_unit(order: &UnitOrder) -> UnitSet {
    match order {
        UnitOrder::Restart(units)
        | UnitOrder::CyclePower(units)
        | UnitOrder::PowerOff(units)
        | UnitOrder::PowerOn(units)
        | UnitOrder::ResetErrors(units)
        | UnitOrder::ClearLog(units, _)
        | UnitOrder::EraseSii(units)
        | UnitOrder::Conduct(units, _)
        | UnitOrder::Inject(units, _)
        | UnitOrder::Remove(units, _) => *units,
        UnitOrder::SetIdSwitch(unit, _) | UnitOrder::SpoilSii(unit, _) => UnitSet::One(*unit),
    }
}

pub(crate) fn unit_of_cpu(order: &CpuOrder) -> Option<UnitSet> {
    match order {
        CpuOrder::SetMode(units, _)
        | CpuOrder::SetIoRefreshing(units, _)
        | CpuOrder::SetTaskRunning(units, _)
        | CpuOrder::ReleaseAll(units)
        | CpuOrder::ResetNxBus(units)
        | CpuOrder::CycleRackPower(units)
        | CpuOrder::JumpTime(units, _) => Some(*units),
        CpuOrder::SetInputs(unit, _) | CpuOrder::Load { unit, .. } => Some(UnitSet::One(*unit)),
        CpuOrder::Force { .. } | CpuOrder::Write { .. } | CpuOrder::Release(_) => None,
    }
}
