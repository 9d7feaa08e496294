//! The map for display: a row for each variable.

use core::ops::RangeInclusive;

use nx_ect101::{DataSet, DataSetKind, Direction};
use plc::{DeviceVariables, SYSTEM_TABLE_ELEMENTS, VariableId, VariableSource};

use super::bases::{
    BYTES_BASE, ERROR_TABLE_BASE, FORCED_C_TO_M_BASE, FORCED_M_TO_C_BASE, IO_DATA_ACTIVE, MESSAGE_TABLE_BASE,
    SLAVE_STATUS, SLAVE_STATUS_BITS_BASE, UDINT_BASE, UINTS_BASE, UNIT_ERROR,
};
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
    variables.iter().filter_map(|(id, variable)| row(id, variable.source)).collect()
}

/// First register of an entry, without an offset; none if the data set has no such entry.
pub(super) fn entry_address(kind: DataSetKind, number: u8) -> Option<u16> {
    let base = match kind {
        DataSetKind::Uints => UINTS_BASE,
        DataSetKind::Bytes => BYTES_BASE,
        DataSetKind::Udint => UDINT_BASE,
    };
    let place = u16::from(number).checked_sub(1)?;
    let entries = Direction::ALL.map(|direction| DataSet::of(direction, kind).max_count);
    entries.iter().all(|entries| number <= *entries).then(|| base + place * entry_registers(kind))
}

/// Registers of one entry.
pub(super) const fn entry_registers(kind: DataSetKind) -> u16 {
    match kind {
        DataSetKind::Uints => 15,
        DataSetKind::Bytes => 10,
        DataSetKind::Udint => 2,
    }
}

fn row(variable: VariableId, source: VariableSource) -> Option<MapRow> {
    let bits = |first: u16, count: u16| MapRow {
        variable,
        table: Table::DiscreteInputs,
        addresses: first..=first + count - 1,
        forced: None,
    };
    Some(match source {
        VariableSource::Entry { direction, kind, number } => {
            let first = entry_address(kind, number)?;
            let last = first + entry_registers(kind) - 1;
            let (table, forced) = match direction {
                Direction::MToC => (Table::InputRegisters, FORCED_M_TO_C_BASE),
                Direction::CToM => (Table::HoldingRegisters, FORCED_C_TO_M_BASE),
            };
            let forced = Some(forced + first..=forced + last);
            MapRow { variable, table, addresses: first..=last, forced }
        }
        VariableSource::SlaveStatus => MapRow {
            variable,
            table: Table::InputRegisters,
            addresses: SLAVE_STATUS..=SLAVE_STATUS,
            forced: None,
        },
        VariableSource::SlaveStatusBit { bit } => bits(SLAVE_STATUS_BITS_BASE + u16::from(bit), 1),
        VariableSource::IoDataActive => bits(IO_DATA_ACTIVE, 1),
        VariableSource::UnitError => bits(UNIT_ERROR, 1),
        VariableSource::UnitMessageActiveTable => bits(MESSAGE_TABLE_BASE, SYSTEM_TABLE_ELEMENTS),
        VariableSource::UnitErrorFlagTable => bits(ERROR_TABLE_BASE, SYSTEM_TABLE_ELEMENTS),
    })
}
