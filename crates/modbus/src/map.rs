//! The addresses of the variables.
//!
//! One element of an array is one register, a BYTE in the low byte; a UDINT is two, the low word first. Each
//! data set has its fixed place whatever is allocated, so that another entry changes no address.

mod bases;
mod rows;
mod table;

use nx_ect101::{DataSetKind, Direction};
use plc::{DeviceVariables, Target, VariableId, VariableSource};

use crate::addresses::Addresses;
use crate::exception::Exception;

pub use bases::{
    BYTES_BASE, ERROR_TABLE_BASE, FORCED_C_TO_M_BASE, FORCED_M_TO_C_BASE, IO_DATA_ACTIVE, MESSAGE_TABLE_BASE,
    SLAVE_STATUS, SLAVE_STATUS_BITS_BASE, UDINT_BASE, UINTS_BASE, UNIT_ERROR,
};
pub use rows::MapRow;
pub use table::Table;

/// The addresses of the variables of one CPU Unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModbusMap {
    rows: Vec<MapRow>,
    /// Sorted by address, like the following lists.
    input_registers: Vec<Register>,
    holding_registers: Vec<Register>,
    discrete_inputs: Vec<Bit>,
    coils: Vec<Bit>,
}

/// A register: an element, or two bytes of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Register {
    pub(crate) address: u16,
    pub(crate) target: Target,
    pub(crate) start: usize,
    /// One of a BYTE, otherwise two.
    pub(crate) length_bytes: usize,
    pub(crate) writing: Writing,
}

/// The effect of writing the register.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Writing {
    /// It sets the next value of an output.
    Writes,
    Forces,
}

/// A coil or a discrete input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Bit {
    pub(crate) address: u16,
    pub(crate) target: Target,
    pub(crate) tells: BitTells,
}

/// The meaning of a bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BitTells {
    /// One bit of the value, counted from the least significant.
    Value(u8),
    /// Whether the element is forced.
    IsForced,
}

trait Addressed {
    fn address(&self) -> u16;
}

impl Addressed for Register {
    fn address(&self) -> u16 {
        self.address
    }
}

impl Addressed for Bit {
    fn address(&self) -> u16 {
        self.address
    }
}

impl ModbusMap {
    /// The addresses of these variables.
    #[must_use]
    pub fn of(variables: &DeviceVariables) -> Self {
        let rows = rows::of(variables);
        let mut map = Self {
            input_registers: Vec::new(),
            holding_registers: Vec::new(),
            discrete_inputs: Vec::new(),
            coils: Vec::new(),
            rows,
        };
        for (id, variable) in variables.iter() {
            map.add(id, variable.source);
        }
        map.input_registers.sort_by_key(Addressed::address);
        map.holding_registers.sort_by_key(Addressed::address);
        map.discrete_inputs.sort_by_key(Addressed::address);
        map.coils.sort_by_key(Addressed::address);
        map
    }

    /// A row for each variable that has addresses, in the order of the I/O map.
    #[must_use]
    pub fn rows(&self) -> &[MapRow] {
        &self.rows
    }

    /// The registers at these addresses: all of them exist, or the request is refused.
    pub(crate) fn registers(&self, table: Table, addresses: Addresses) -> Result<&[Register], Exception> {
        match table {
            Table::InputRegisters => found(&self.input_registers, addresses),
            Table::HoldingRegisters => found(&self.holding_registers, addresses),
            Table::Coils | Table::DiscreteInputs => Err(Exception::IllegalDataAddress),
        }
    }

    /// The bits at these addresses: all of them exist, or the request is refused.
    pub(crate) fn bits(&self, table: Table, addresses: Addresses) -> Result<&[Bit], Exception> {
        match table {
            Table::Coils => found(&self.coils, addresses),
            Table::DiscreteInputs => found(&self.discrete_inputs, addresses),
            Table::InputRegisters | Table::HoldingRegisters => Err(Exception::IllegalDataAddress),
        }
    }

    fn add(&mut self, id: VariableId, source: VariableSource) {
        let bit = |address, target, bit| Bit { address, target, tells: BitTells::Value(bit) };
        let table = |base: u16| {
            let elements = 0..plc::SYSTEM_TABLE_ELEMENTS;
            elements.map(move |element| bit(base + element, id.element(element), 0))
        };
        match source {
            VariableSource::Entry { direction, kind, number } => self.add_entry(id, direction, kind, number),
            VariableSource::SlaveStatus => {
                let writing = Writing::Forces;
                let word =
                    Register { address: SLAVE_STATUS, target: id.into(), start: 0, length_bytes: 2, writing };
                self.input_registers.push(word);
                self.discrete_inputs
                    .extend((0..16).map(|n| bit(SLAVE_STATUS_BITS_BASE + u16::from(n), id.into(), n)));
            }
            // The bits of the word already have addresses.
            VariableSource::SlaveStatusBit { .. } => {}
            VariableSource::IoDataActive => self.discrete_inputs.push(bit(IO_DATA_ACTIVE, id.into(), 0)),
            VariableSource::UnitError => self.discrete_inputs.push(bit(UNIT_ERROR, id.into(), 0)),
            VariableSource::UnitMessageActiveTable => self.discrete_inputs.extend(table(MESSAGE_TABLE_BASE)),
            VariableSource::UnitErrorFlagTable => self.discrete_inputs.extend(table(ERROR_TABLE_BASE)),
        }
    }

    fn add_entry(&mut self, id: VariableId, direction: Direction, kind: DataSetKind, number: u8) {
        let Some(first) = rows::entry_address(kind, number) else { return };
        let (forced, own) = match direction {
            Direction::MToC => (FORCED_M_TO_C_BASE, &mut self.input_registers),
            Direction::CToM => (FORCED_C_TO_M_BASE, &mut self.holding_registers),
        };
        own.extend(entry_registers(id, kind, first, Writing::Writes));
        let forced: Vec<_> = entry_registers(id, kind, forced + first, Writing::Forces).collect();
        self.coils.extend(forced.iter().map(|register| Bit {
            address: register.address,
            target: register.target,
            tells: BitTells::IsForced,
        }));
        self.holding_registers.extend(forced);
    }
}

fn entry_registers(
    id: VariableId,
    kind: DataSetKind,
    first: u16,
    writing: Writing,
) -> impl Iterator<Item = Register> {
    (0..rows::entry_registers(kind)).map(move |place| {
        let (target, start, length_bytes) = match kind {
            DataSetKind::Uints => (id.element(place), 0, 2),
            DataSetKind::Bytes => (id.element(place), 0, 1),
            DataSetKind::Udint => (id.into(), 2 * usize::from(place), 2),
        };
        Register { address: first + place, target, start, length_bytes, writing }
    })
}

/// All of these addresses in a sorted list without duplicates.
fn found<T: Addressed>(list: &[T], addresses: Addresses) -> Result<&[T], Exception> {
    let start = list.partition_point(|row| row.address() < addresses.first);
    let rows = list.get(start..).and_then(|rows| rows.get(..usize::from(addresses.quantity)));
    let last = addresses.first.checked_add(addresses.quantity.saturating_sub(1));
    rows.filter(|rows| {
        rows.first().is_some_and(|row| row.address() == addresses.first)
            && rows.last().map(Addressed::address) == last
    })
    .ok_or(Exception::IllegalDataAddress)
}

#[cfg(test)]
mod tests;
