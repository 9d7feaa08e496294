//! How the scripted master executes an order. Every order has its arm: a missing one would do nothing.

#![deny(clippy::wildcard_enum_match_arm)]

use ::master::Reading;
use time::Instant;

use super::Master;
use super::operation::{MailboxChannels, Operation};
use super::slave::Slave;
use crate::model::{MasterOrder, UnitNumber, UnitSet};

impl Master {
    /// Accepts an order.
    pub(crate) fn order(&mut self, order: MasterOrder, now: Instant) {
        match order {
            MasterOrder::Take { units, state } => {
                self.process_data.allow();
                self.queue_for(units, now, |unit| Operation::take(unit, state))
            }
            MasterOrder::Request { units, state, acknowledge } => {
                let bits = state.bits() | if acknowledge { 0x10 } else { 0 };
                self.queue_for(units, now, |unit| {
                    Operation::write(unit, 0x0120, bits.to_le_bytes().to_vec())
                });
            }
            MasterOrder::WriteRegister { unit, register, bytes } => {
                let write = |unit| Operation::write(unit, register.0, bytes.0.clone());
                self.queue_for(UnitSet::One(unit), now, write);
            }
            MasterOrder::WriteRegisterInHalves { unit, register, bytes } => {
                let (first, second) = bytes.0.split_at(bytes.0.len().div_ceil(2));
                let behind = register.0.wrapping_add(first.len() as u16);
                for (offset, half) in [(register.0, first), (behind, second)] {
                    let half = half.to_vec();
                    self.queue_for(UnitSet::One(unit), now, |unit| {
                        Operation::write(unit, offset, half.clone())
                    });
                }
            }
            MasterOrder::WriteSdo { unit, entry, value } => {
                self.queue_sdo(unit, now, |unit, channels| {
                    Operation::download(unit, channels, entry, &value.0)
                });
            }
            MasterOrder::ReadSdo { unit, entry } => {
                self.queue_sdo(unit, now, |unit, channels| Operation::upload(unit, channels, entry));
            }
            MasterOrder::ExchangeProcessData { every } => self.process_data.exchange(every, now),
            MasterOrder::StopProcessData => self.process_data.stop(),
            MasterOrder::SetOutputs { unit, at, bytes } => {
                self.process_data.set_outputs(unit.position(), at.into(), &bytes.0);
            }
            MasterOrder::MapPdo { unit, pdo, entries } => {
                self.with_slave(unit, |slave| slave.map(pdo.0, &entries));
            }
            MasterOrder::AssignPdos { unit, object, pdos } => {
                self.with_slave(unit, |slave| slave.assign(object.0, &pdos));
            }
            MasterOrder::SetSyncManagerLength { unit, number, length_bytes } => {
                self.with_slave(unit, |slave| slave.wrong_length(number, length_bytes));
            }
            MasterOrder::SetSyncManagerControl { unit, number, control } => {
                self.with_slave(unit, |slave| slave.wrong_control(number, control.0));
            }
            MasterOrder::UseMailboxCounter { counter } => {
                self.change_mailbox(|conduct| conduct.counter.fixed = Some(counter));
            }
            MasterOrder::ReadNoMailbox => self.change_mailbox(|conduct| conduct.reading = Reading::Never),
            MasterOrder::ReadNoEmergencies => self.looks_for_emergencies = false,
            MasterOrder::Behave => {
                self.looks_for_emergencies = true;
                self.change_mailbox(|conduct| {
                    conduct.counter.fixed = None;
                    conduct.reading = Reading::Always;
                });
                self.slaves.iter_mut().for_each(Slave::behave);
            }
            MasterOrder::Restart => {
                let devices = self.slaves.iter().map(Slave::device).collect();
                let (cycle, phase) = (self.process_data.cycle(), self.process_data.phase());
                let ticket = self.ticket + 1;
                let task = self.task.take().map(|task| task.restart(now));
                *self = Self { ticket, task, ..Self::new(devices, cycle, phase) };
            }
        }
    }

    /// An SDO by the mailbox of a unit; without one the order fails.
    fn queue_sdo(
        &mut self,
        unit: UnitNumber,
        now: Instant,
        order: impl Fn(usize, MailboxChannels) -> Operation,
    ) {
        let number = self.last_sdo.order();
        match self.slaves.get(unit.position()).and_then(Slave::mailbox) {
            Some(channels) => {
                self.queue_for(UnitSet::One(unit), now, |unit| order(unit, channels).ordered_as(number));
            }
            None => {
                let reason = format!("unit {} has no mailbox", unit.position() + 1);
                self.fail(reason);
                self.last_sdo.give_up(Some(number));
            }
        }
    }

    fn with_slave(&mut self, unit: UnitNumber, change: impl FnOnce(&mut Slave)) {
        if let Some(slave) = self.slaves.get_mut(unit.position()) {
            change(slave);
        }
    }

    fn queue_for(&mut self, units: UnitSet, now: Instant, operation: impl Fn(usize) -> Operation) {
        let was_idle = self.operations.is_empty();
        self.operations.extend(units.positions(self.slaves.len()).map(operation));
        if was_idle {
            self.begin(now);
        }
    }
}
