//! The map for display: a row for each variable.

use core::ops::RangeInclusive;

use plc::{DeviceVariables, Variable, VariableId};

use super::table::Table;

/// The addresses of one variable, counted from 0 as in the protocol.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MapRow {
    /// The variable.
    pub variable: VariableId,
    /// The table in which it is read, and written if it is an output.
    pub table: Table,
    /// Its addresses there.
    pub addresses: RangeInclusive<u16>,
    /// The holding registers that force an I/O entry; the coils with the same numbers show and release the forcing.
    pub forced: Option<RangeInclusive<u16>>,
}

/// The rows of all variables that have addresses.
pub(super) fn of(variables: &DeviceVariables) -> Vec<MapRow> {
    variables.iter().filter_map(|(id, variable)| row(id, variable)).collect()
}

fn row(id: VariableId, variable: &Variable) -> Option<MapRow> {
    let modbus = variable.modbus?;
    let range = |first: u16| first..=first + (count(variable) - 1);
    Some(MapRow {
        variable: id,
        table: Table::of(variable),
        addresses: range(modbus.first),
        forced: modbus.forced.map(range),
    })
}

/// How many bits or registers a variable has; at least one.
fn count(variable: &Variable) -> u16 {
    let elements = variable.variable_type.elements.unwrap_or(1);
    // An elementary type has eight bytes at most.
    (elements * variable.variable_type.elementary.size_bytes().div_ceil(2) as u16).max(1)
}
