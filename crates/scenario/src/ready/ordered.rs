//! What the steps of a scenario order somewhere, for conditions that are about it.

use crate::model::{ConductOrder, MasterOrder, Order, ScriptStep, UnitOrder, WhichUnit, in_order};

/// What the steps of a scenario order somewhere, as far as conditions are about it.
#[derive(Default)]
pub(super) struct Ordered {
    /// There are random steps, which can order anything.
    pub(super) has_random: bool,
    /// AL status codes with which units refuse states.
    pub(super) codes: Vec<u16>,
    pub(super) reads_register: bool,
    pub(super) sends_message: bool,
    pub(super) sends_frame: bool,
    /// The units to which SDOs are sent, by their positions.
    pub(super) sdos: Vec<usize>,
}

impl Ordered {
    pub(super) fn by(steps: &[ScriptStep]) -> Self {
        let mut ordered = Self::default();
        for entry in in_order(steps) {
            match entry {
                ScriptStep::Random(_) => ordered.has_random = true,
                ScriptStep::Step(step) => ordered.add(&step.order),
                ScriptStep::Group(_) => {}
            }
        }
        ordered
    }

    fn add(&mut self, order: &Order) {
        match order {
            Order::Unit(UnitOrder::Conduct {
                conduct: ConductOrder::Refuse { al_status_code, .. }, ..
            }) => {
                self.codes.push(al_status_code.0);
            }
            Order::Master(order) => {
                self.sdos.extend(sdo_unit(order).map(WhichUnit::position));
                self.reads_register |= matches!(order, MasterOrder::ReadRegister { .. });
                self.sends_message |= matches!(order, MasterOrder::SendMailboxMessage { .. });
                self.sends_frame |= matches!(order, MasterOrder::SendFrame { .. });
            }
            Order::Unit(_) | Order::Cpu(_) | Order::Line(_) | Order::Expect(_) => {}
        }
    }
}

/// The unit to whose mailbox an order sends an SDO.
pub(super) const fn sdo_unit(order: &MasterOrder) -> Option<&WhichUnit> {
    match order {
        MasterOrder::WriteSdo { unit, .. }
        | MasterOrder::ReadSdo { unit, .. }
        | MasterOrder::ReadCompleteSdo { unit, .. }
        | MasterOrder::WriteCompleteSdo { unit, .. }
        | MasterOrder::WriteSdoInSegments { unit, .. }
        | MasterOrder::ReadObjectList { unit, .. }
        | MasterOrder::DescribeObject { unit, .. }
        | MasterOrder::DescribeEntry { unit, .. } => Some(unit),
        MasterOrder::Take { .. }
        | MasterOrder::Request { .. }
        | MasterOrder::ExchangeProcessData { .. }
        | MasterOrder::StopProcessData
        | MasterOrder::SetOutputs { .. }
        | MasterOrder::MapPdo { .. }
        | MasterOrder::AssignPdos { .. }
        | MasterOrder::SetSyncManagerLength { .. }
        | MasterOrder::SetSyncManagerControl { .. }
        | MasterOrder::WriteRegister { .. }
        | MasterOrder::WriteRegisterInHalves { .. }
        | MasterOrder::ReadRegister { .. }
        | MasterOrder::SendMailboxMessage { .. }
        | MasterOrder::SendFrame { .. }
        | MasterOrder::UseMailboxCounter { .. }
        | MasterOrder::ReadNoMailbox
        | MasterOrder::ReadNoEmergencies
        | MasterOrder::Behave
        | MasterOrder::Restart => None,
    }
}
