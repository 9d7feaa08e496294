use iec_types::Elementary;
use variables::{
    Area, BusUnit, ModbusAddress, Place, StatusWord, Variable, VariableAccess, VariableTable, VariableType,
    at_specification, variable_name,
};

use crate::description::INPUTS_BYTES;

const UNIT_NUMBER: u8 = 1;

/// One variable, such as `C1_Count`. Its position is in the image from the unit to the CPU Unit, which only reads it.
pub(crate) fn variable_table(name: &str) -> VariableTable {
    let port = "Count";
    let count = Variable {
        name: variable_name(name, port),
        at: Some(at_specification(UNIT_NUMBER, port)),
        port: Some(port.to_owned()),
        variable_type: VariableType::single(Elementary::Uint),
        access: VariableAccess::ReadOnly,
        place: Place::whole(Area::MToC, 0, INPUTS_BYTES.into()),
        series: None,
        modbus: Some(ModbusAddress::at(1_000)),
        nx_object: None,
        pdo_entry: None,
    };
    let unit = BusUnit {
        device_name: name.to_owned(),
        unit_number: UNIT_NUMBER,
        m_to_c_bytes: INPUTS_BYTES.into(),
        c_to_m_bytes: 0,
        status: StatusWord::default(),
    };
    VariableTable::new(unit, vec![count])
}
