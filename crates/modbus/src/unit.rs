//! One unit of the line, as clients read and write it.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use plc::outside::{Change, ChangeRefused, Operation, OutsideEnd, Snapshot, Ticket};
use plc::{Target, VariableError, VariableValue};

use crate::addresses::Addresses;
use crate::exception::Exception;
use crate::map::{Bit, BitTells, ModbusMap, Register, Table, Writing};

/// How long a write request waits for the task period that executes it.
const PATIENCE: Duration = Duration::from_secs(1);
/// Interval of its checks: the shortest that the timers of the runtime offer.
const LOOK: Duration = Duration::from_millis(1);

/// A unit shared by all connections.
pub(crate) struct Unit {
    map: ModbusMap,
    /// Locked only while values are copied.
    end: Mutex<OutsideEnd>,
    /// One request writes at a time, so that the half of a value that it has read before is still valid when it writes.
    writing: tokio::sync::Mutex<()>,
}

impl Unit {
    pub(crate) fn new(map: ModbusMap, end: OutsideEnd) -> Self {
        Self { map, end: Mutex::new(end), writing: tokio::sync::Mutex::new(()) }
    }

    /// Bits of one image.
    pub(crate) fn bits(&self, table: Table, addresses: Addresses) -> Result<Vec<bool>, Exception> {
        let bits = self.map.bits(table, addresses)?;
        let mut end = self.end();
        let image = end.newest();
        bits.iter().map(|bit| read_bit(image, bit)).collect()
    }

    /// Registers of one image.
    pub(crate) fn registers(&self, table: Table, addresses: Addresses) -> Result<Vec<u16>, Exception> {
        let registers = self.map.registers(table, addresses)?;
        let mut end = self.end();
        let image = end.newest();
        registers.iter().map(|register| read_register(image, register)).collect()
    }

    /// Writes registers, all of them in one task period, and waits until they are written.
    pub(crate) async fn write_registers(
        &self,
        addresses: Addresses,
        values: &[u16],
    ) -> Result<(), Exception> {
        let registers = self.map.registers(Table::HoldingRegisters, addresses)?;
        self.change(|image| register_changes(image, registers, values)).await
    }

    /// Writes a register to (present value AND `and_mask`) OR (`or_mask` AND NOT `and_mask`).
    pub(crate) async fn mask_register(
        &self,
        address: u16,
        and_mask: u16,
        or_mask: u16,
    ) -> Result<(), Exception> {
        let registers =
            self.map.registers(Table::HoldingRegisters, Addresses { first: address, quantity: 1 })?;
        let masked = |present: u16| present & and_mask | or_mask & !and_mask;
        self.change(|image| {
            let present = registers.iter().map(|register| read_register(image, register).map(masked));
            register_changes(image, registers, &present.collect::<Result<Vec<_>, _>>()?)
        })
        .await
    }

    /// Writes outputs that are one bit, and forces elements with their present values or releases them.
    pub(crate) async fn write_coils(&self, addresses: Addresses, values: &[bool]) -> Result<(), Exception> {
        let coils = self.map.bits(Table::Coils, addresses)?;
        let changes = coils.iter().zip(values).map(|(coil, &value)| {
            let operation = match (coil.tells, value) {
                (BitTells::Value(_), _) => Operation::Write([value.into()].into_iter().collect()),
                (BitTells::IsForced, true) => Operation::ForceAsItIs,
                (BitTells::IsForced, false) => Operation::Release,
            };
            Change { target: coil.target, operation }
        });
        let changes: Vec<_> = changes.collect();
        self.change(|_| Ok(changes.clone())).await
    }

    /// Sends the changes that `make` derives from the newest image, and waits until they have been made.
    async fn change(
        &self,
        mut make: impl FnMut(Snapshot<'_>) -> Result<Vec<Change>, Exception>,
    ) -> Result<(), Exception> {
        let patience_ends = Instant::now() + PATIENCE;
        let _alone = self.writing.lock().await;
        let ticket = loop {
            match self.send(&mut make)? {
                Some(ticket) => break ticket,
                None if Instant::now() >= patience_ends => return Err(Exception::ServerDeviceBusy),
                None => tokio::time::sleep(LOOK).await,
            }
        };
        while !self.end().newest().has_taken(ticket) {
            if Instant::now() >= patience_ends {
                return Err(Exception::Acknowledge);
            }
            tokio::time::sleep(LOOK).await;
        }
        Ok(())
    }

    /// None: there is no room yet.
    fn send(
        &self,
        make: &mut impl FnMut(Snapshot<'_>) -> Result<Vec<Change>, Exception>,
    ) -> Result<Option<Ticket>, Exception> {
        let mut end = self.end();
        let changes = make(end.newest())?;
        match end.send(&changes) {
            Ok(ticket) => Ok(Some(ticket)),
            Err(ChangeRefused::Full { .. }) => Ok(None),
            Err(ChangeRefused::Variable { .. } | ChangeRefused::NotReachable) => {
                Err(Exception::ServerDeviceFailure)
            }
        }
    }

    /// A connection that panicked left the end consistent: it is complete after each call.
    fn end(&self) -> MutexGuard<'_, OutsideEnd> {
        self.end.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A variable of the map that the unit does not have: map and end belong to different units.
fn is_not_there(_: VariableError) -> Exception {
    Exception::ServerDeviceFailure
}

fn read_bit(image: Snapshot<'_>, bit: &Bit) -> Result<bool, Exception> {
    match bit.tells {
        BitTells::IsForced => image.is_forced(bit.target).map_err(is_not_there),
        BitTells::Value(number) => {
            let value = image.read(bit.target).map_err(is_not_there)?;
            let octet = value.get(usize::from(number / 8)).copied().unwrap_or_default();
            Ok(octet >> (number % 8) & 1 != 0)
        }
    }
}

fn read_register(image: Snapshot<'_>, register: &Register) -> Result<u16, Exception> {
    let value = image.read(register.target).map_err(is_not_there)?;
    let octets = value.iter().skip(register.start).take(register.length_bytes);
    Ok(octets.rev().fold(0, |word, octet| word << 8 | u16::from(*octet)))
}

/// One change for each element to which these registers belong. If an element is written in part, the rest
/// keeps the value in the image.
fn register_changes(
    image: Snapshot<'_>,
    registers: &[Register],
    values: &[u16],
) -> Result<Vec<Change>, Exception> {
    let mut changes: Vec<(Target, Writing, VariableValue)> = Vec::new();
    for (register, &new) in registers.iter().zip(values) {
        if new > register.greatest {
            return Err(Exception::IllegalDataValue);
        }
        if changes.last().is_none_or(|(target, ..)| *target != register.target) {
            let present = image.read(register.target).map_err(is_not_there)?;
            changes.push((register.target, register.writing, present));
        }
        let value = changes.last_mut().into_iter().flat_map(|(_, _, value)| value.iter_mut());
        for (octet, byte) in value.skip(register.start).take(register.length_bytes).zip(new.to_le_bytes()) {
            *octet = byte;
        }
    }
    let change = |(target, writing, value)| {
        let operation = match writing {
            Writing::Writes => Operation::Write(value),
            Writing::Forces => Operation::Force(value),
        };
        Change { target, operation }
    };
    Ok(changes.into_iter().map(change).collect())
}
