//! How the scripted master executes an order. Every order has its arm: a missing one would do nothing.

#![deny(clippy::wildcard_enum_match_arm)]

use ::master::Reading;
use time::Instant;

use super::operation::{MailboxChannels, Operation};
use super::raw::Kind;
use super::sdo_service::SdoService;
use super::slave::Slave;
use super::{GivenUp, Master};
use crate::model::{MasterOrder, UnitSet, WhichUnit};

impl Master {
    /// Accepts an order.
    pub(crate) fn order(&mut self, order: MasterOrder, now: Instant) {
        self.given_up.order();
        match order {
            MasterOrder::Take { units, state } => {
                self.process_data.allow();
                self.queue_for(&units, now, |unit| Operation::take(unit, state))
            }
            MasterOrder::Request { units, state, acknowledge } => {
                let bits = state.bits() | if acknowledge { 0x10 } else { 0 };
                self.queue_for(&units, now, |unit| {
                    Operation::write(unit, 0x0120, bits.to_le_bytes().to_vec())
                });
            }
            MasterOrder::WriteRegister { unit, register, bytes } => {
                let write = |unit| Operation::write(unit, register.0, bytes.0.clone());
                self.queue_of(&unit, now, write);
            }
            MasterOrder::WriteRegisterInHalves { unit, register, bytes } => {
                let (first, second) = bytes.0.split_at(bytes.0.len().div_ceil(2));
                let behind = register.0.wrapping_add(first.len() as u16);
                for (offset, half) in [(register.0, first), (behind, second)] {
                    let half = half.to_vec();
                    self.queue_of(&unit, now, |unit| Operation::write(unit, offset, half.clone()));
                }
            }
            MasterOrder::WriteSdo { unit, entry, value } => {
                self.queue_sdo(&unit, now, |unit, channels| {
                    Operation::download(unit, channels, entry, &value.0)
                });
            }
            MasterOrder::ReadSdo { unit, entry } => {
                self.queue_sdo(&unit, now, |unit, channels| Operation::upload(unit, channels, entry));
            }
            order @ (MasterOrder::ReadCompleteSdo { .. }
            | MasterOrder::WriteCompleteSdo { .. }
            | MasterOrder::WriteSdoInSegments { .. }
            | MasterOrder::ReadObjectList { .. }
            | MasterOrder::DescribeObject { .. }
            | MasterOrder::DescribeEntry { .. }) => {
                if let Some(request) = SdoService::of(&order) {
                    self.queue_sdo(&request.unit, now, |unit, channels| request.operation(unit, channels));
                }
            }
            MasterOrder::ReadRegister { unit, register, length_bytes } => {
                let length_bytes = length_bytes.unwrap_or_else(|| width_bytes(register.0));
                let number = self.raw.order(Kind::Register);
                self.queue_of(&unit, now, |unit| {
                    Operation::read_register(unit, register.0, length_bytes, number)
                });
            }
            MasterOrder::SendMailboxMessage { unit, message } => self.queue_message(&unit, &message.0, now),
            MasterOrder::SendFrame { frame } => self.raw.order_frame(frame.0),
            MasterOrder::ExchangeProcessData { every } => self.process_data.exchange(every, now),
            MasterOrder::StopProcessData => self.process_data.stop(),
            MasterOrder::SetOutputs { unit, at, bytes } => {
                self.process_data.set_outputs(unit.position(), at.into(), &bytes.0);
            }
            MasterOrder::MapPdo { unit, pdo, entries } => {
                self.with_slave(&unit, |slave| slave.map(pdo.0, &entries));
            }
            MasterOrder::AssignPdos { unit, object, pdos } => {
                self.with_slave(&unit, |slave| slave.assign(object.0, &pdos));
            }
            MasterOrder::SetSyncManagerLength { unit, number, length_bytes } => {
                self.with_slave(&unit, |slave| slave.wrong_length(number, length_bytes));
            }
            MasterOrder::SetSyncManagerControl { unit, number, control } => {
                self.with_slave(&unit, |slave| slave.wrong_control(number, control.0));
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
                let task = self.task.take().map(|task| task.restart(now));
                let mut flights = core::mem::take(&mut self.flights);
                flights.forget(|_| true);
                let raw = self.raw.restarted();
                let mut given_up = core::mem::take(&mut self.given_up);
                given_up.start();
                *self = Self { flights, raw, task, given_up, ..Self::new(devices, cycle, phase) };
            }
        }
    }

    /// An SDO by the mailbox of a unit; without one the order fails.
    fn queue_sdo(
        &mut self,
        unit: &WhichUnit,
        now: Instant,
        order: impl Fn(usize, MailboxChannels) -> Operation,
    ) {
        let number = self.last_sdos.order(unit.position());
        match self.slaves.get(unit.position()).and_then(Slave::mailbox) {
            Some(channels) => {
                self.queue_of(unit, now, |unit| order(unit, channels).ordered_as(number));
            }
            None => {
                self.fail_without_mailbox(unit, now);
                self.last_sdos.give_up(unit.position(), Some(number));
            }
        }
    }

    /// A mailbox message as it is; without a mailbox the order fails.
    fn queue_message(&mut self, unit: &WhichUnit, message: &[u8], now: Instant) {
        let number = self.raw.order(Kind::Mailbox);
        match self.slaves.get(unit.position()).and_then(Slave::mailbox) {
            Some(channels) => {
                self.queue_of(unit, now, |unit| Operation::message(unit, channels, message.to_vec(), number))
            }
            None => {
                self.fail_without_mailbox(unit, now);
                self.raw.give_up(number);
            }
        }
    }

    fn fail_without_mailbox(&mut self, unit: &WhichUnit, now: Instant) {
        let at = unit.position();
        let reason = format!("unit {} has no mailbox", at + 1);
        self.fail(GivenUp { at: now, unit: at, order: self.given_up.last(), reason });
    }

    fn with_slave(&mut self, unit: &WhichUnit, change: impl FnOnce(&mut Slave)) {
        if let Some(slave) = self.slaves.get_mut(unit.position()) {
            change(slave);
        }
    }

    fn queue_of(&mut self, unit: &WhichUnit, now: Instant, operation: impl Fn(usize) -> Operation) {
        self.queue_for(&UnitSet::One(unit.clone()), now, operation);
    }

    fn queue_for(&mut self, units: &UnitSet, now: Instant, operation: impl Fn(usize) -> Operation) {
        let was_idle = self.operations.is_empty();
        let order = self.given_up.last();
        let of_order = |operation: Operation| operation.of_order(order);
        self.operations.extend(units.positions(self.slaves.len()).map(operation).map(of_order));
        if was_idle {
            self.begin(now);
        }
    }
}

/// The width of the register at an offset; one byte where none begins.
fn width_bytes(offset: u16) -> u16 {
    let is_at = |row: &&esc::Register| {
        let behind = offset.checked_sub(row.offset);
        behind.is_some_and(|behind| {
            row.stride_bytes.max(1) * row.count > behind && behind % row.stride_bytes.max(1) == 0
        })
    };
    esc::REGISTERS.iter().find(is_at).map_or(1, |row| row.size_bytes)
}
