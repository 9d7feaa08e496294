//! The channels as variables of a CPU Unit: `NAME_Output_1` …, which the master sets, and `NAME_Input_1` …, which the
//! CPU Unit sets.

use iec_types::Elementary;
use variables::{
    Area, BusUnit, ModbusAddress, Place, Series, StatusWord, Variable, VariableAccess, VariableTable,
    VariableType, at_specification, variable_name,
};

use crate::channels::Channels;
use crate::settings::TerminalSettings;

/// A terminal has no NX Unit number of its own.
const UNIT_NUMBER: u8 = 1;
/// The series whose entries belong together in both directions.
const SERIES: &str = "Channel";
/// Modbus address of channel 1. The CPU Unit has discrete inputs of its own below it.
const MODBUS_BASE: u16 = 1_000;

/// The variables of a terminal with this name.
pub(crate) fn variable_table(name: &str, settings: &TerminalSettings) -> VariableTable {
    let outputs = channels(name, "Output", settings.outputs, Area::MToC, VariableAccess::ReadOnly);
    let inputs = channels(name, "Input", settings.inputs, Area::CToM, VariableAccess::ReadWrite);
    let unit = BusUnit {
        device_name: name.to_owned(),
        unit_number: UNIT_NUMBER,
        m_to_c_bytes: settings.outputs.length_bytes().into(),
        c_to_m_bytes: settings.inputs.length_bytes().into(),
        status: StatusWord::default(),
    };
    VariableTable::new(unit, outputs.chain(inputs).collect())
}

/// A BOOL for each channel. Its Modbus address is its number from 0 after [`MODBUS_BASE`]: outputs of the master are
/// discrete inputs, its inputs are coils.
fn channels<'a>(
    name: &'a str,
    kind: &'a str,
    channels: Channels,
    area: Area,
    access: VariableAccess,
) -> impl Iterator<Item = Variable> + 'a {
    channels.numbers().map(move |number| {
        let (port, bit) = (format!("{kind} {number}"), number - 1);
        Variable {
            name: variable_name(name, &port),
            at: Some(at_specification(UNIT_NUMBER, &port)),
            port: Some(port),
            variable_type: VariableType::single(Elementary::Bool),
            access,
            place: Place::bit(area, bit.into()),
            series: Some(Series { name: SERIES, number }),
            modbus: Some(ModbusAddress::at(MODBUS_BASE + u16::from(bit))),
            nx_object: None,
            pdo_entry: None,
        }
    })
}
