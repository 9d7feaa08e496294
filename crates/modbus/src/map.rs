//! The addresses of the variables.
//!
//! The first address of a variable is in its table, which the unit model gives. One element of an array is one register,
//! a BYTE in the low byte; a UDINT is two, the low word first. A BOOL is one bit.

mod rows;
mod table;

use plc::{DeviceVariables, Target, Variable, VariableId};

use crate::addresses::Addresses;
use crate::exception::Exception;

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
    /// The greatest number that it takes.
    pub(crate) greatest: u16,
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
            map.add(variables, id, variable);
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

    fn add(&mut self, variables: &DeviceVariables, id: VariableId, variable: &Variable) {
        let Some(modbus) = variable.modbus else { return };
        // The bits of a word are in the map by their word.
        if variables.word_of(variable).is_some_and(has_bits) {
            return;
        }
        let bit = |address, target, tells| Bit { address, target, tells };
        match Table::of(variable) {
            table @ (Table::Coils | Table::DiscreteInputs) => {
                let own = if table == Table::Coils { &mut self.coils } else { &mut self.discrete_inputs };
                let targets = (modbus.first..).zip(elements(id, variable));
                own.extend(targets.map(|(address, target)| bit(address, target, BitTells::Value(0))));
            }
            Table::InputRegisters => self.input_registers.extend(registers(id, variable, modbus.first)),
            Table::HoldingRegisters => self.holding_registers.extend(registers(id, variable, modbus.first)),
        }
        if let Some(first) = modbus.forced {
            let forced = registers(id, variable, first)
                .map(|register| Register { writing: Writing::Forces, ..register });
            self.holding_registers.extend(forced);
            let coils = registers(id, variable, first);
            self.coils.extend(coils.map(|own| bit(own.address, own.target, BitTells::IsForced)));
        }
        if let Some(first) = modbus.bits {
            let bits = (first..).zip(0..8 * variable.variable_type.size_bytes() as u8);
            self.discrete_inputs.extend(
                bits.map(|(address, number)| bit(address, Target::from(id), BitTells::Value(number))),
            );
        }
    }
}

fn has_bits(word: &Variable) -> bool {
    word.modbus.is_some_and(|modbus| modbus.bits.is_some())
}

/// What a client reads and writes by itself: each element of an array, or the variable.
fn elements(id: VariableId, variable: &Variable) -> impl Iterator<Item = Target> {
    let elements = variable.variable_type.elements;
    let whole = elements.is_none().then(|| Target::from(id));
    whole.into_iter().chain((0..elements.unwrap_or(0)).map(move |element| id.element(element)))
}

/// The registers of a variable from this address on.
fn registers(id: VariableId, variable: &Variable, first: u16) -> impl Iterator<Item = Register> {
    let size_bytes = variable.variable_type.elementary.size_bytes();
    let greatest = match (variable.variable_type.is_bool(), size_bytes) {
        (true, _) => 1,
        (false, 1) => u8::MAX.into(),
        (false, _) => u16::MAX,
    };
    let words = elements(id, variable)
        .flat_map(move |target| (0..size_bytes).step_by(2).map(move |start| (target, start)));
    (first..).zip(words).map(move |(address, (target, start))| {
        let length_bytes = (size_bytes - start).min(2);
        Register { address, target, start, length_bytes, greatest, writing: Writing::Writes }
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
