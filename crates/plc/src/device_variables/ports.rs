//! The variables that the CPU Unit adds: what its NX bus reports of the unit, and the system-defined tables (manual, A-3-3
//! and A-5).

use st::Elementary;
use variables::{
    Area, BusUnit, ModbusAddress, Place, Variable, VariableAccess, VariableType, at_specification,
    variable_name,
};

/// Elements of the system-defined tables: the NX Bus Function Module and 32 NX Units (manual, A-5-1).
pub const SYSTEM_TABLE_ELEMENTS: u16 = 33;

const TABLE_BYTES: usize = SYSTEM_TABLE_ELEMENTS as usize;
/// Where they lie in the image of the CPU Unit itself.
pub(crate) const IO_DATA_ACTIVE: usize = 0;
pub(crate) const UNIT_ERROR: usize = 1;
pub(crate) const MESSAGE_TABLE: usize = 2;
pub(crate) const ERROR_TABLE: usize = MESSAGE_TABLE + TABLE_BYTES;
/// Length of that image in bytes.
pub(crate) const CPU_UNIT_BYTES: usize = ERROR_TABLE + TABLE_BYTES;

/// A variable of the CPU Unit itself: its name or that of its I/O port, its place, its discrete input for clients of
/// Modbus.
struct Row {
    name: &'static str,
    start: usize,
    discrete_input: u16,
}

const OF_BUS: [Row; 2] = [
    Row { name: "NX Unit I/O Data Active Status", start: IO_DATA_ACTIVE, discrete_input: 16 },
    Row { name: "NX Unit Error Status", start: UNIT_ERROR, discrete_input: 17 },
];

const SYSTEM_DEFINED: [Row; 2] = [
    Row { name: "_NXB_UnitMsgActiveTbl", start: MESSAGE_TABLE, discrete_input: 100 },
    Row { name: "_NXB_UnitErrFlagTbl", start: ERROR_TABLE, discrete_input: 200 },
];

/// The port that is no data but a place: NX_ReadObj and NX_WriteObj ask for a variable that is assigned to it.
const NODE_LOCATION_PORT: &str = "Node location information";

/// The location of a unit, for NX_ReadObj and NX_WriteObj: a constant of its CPU Unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NodeLocation {
    /// Name of the variable.
    pub name: String,
    /// Name of the I/O port.
    pub port: &'static str,
    /// AT specification.
    pub at: String,
    /// Type of the variable, a structure.
    pub type_name: &'static str,
    /// Value of its member `UnitNo`.
    pub unit_number: u8,
}

impl NodeLocation {
    pub(super) fn new(device_name: &str, unit_number: u8) -> Self {
        Self {
            name: variable_name(device_name, NODE_LOCATION_PORT),
            port: NODE_LOCATION_PORT,
            at: at_specification(unit_number, NODE_LOCATION_PORT),
            type_name: "_sNXUNIT_ID",
            unit_number,
        }
    }
}

/// What the NX Bus Function Module reports of the unit: I/O ports of the NX bus.
pub(super) fn of_bus(unit: &BusUnit) -> [Variable; 2] {
    let prefix = format!("NXBus_{}", unit.device_name);
    OF_BUS.map(|row| Variable {
        name: variable_name(&prefix, row.name),
        port: Some(row.name.to_owned()),
        at: Some(at_specification(unit.unit_number, row.name)),
        ..row.variable(VariableType::single(Elementary::Bool))
    })
}

/// The system-defined variables: they have no device name, and no AT specification.
pub(super) fn system_defined() -> [Variable; 2] {
    SYSTEM_DEFINED.map(|row| row.variable(VariableType::array(Elementary::Bool, SYSTEM_TABLE_ELEMENTS)))
}

impl Row {
    fn variable(&self, variable_type: VariableType) -> Variable {
        Variable {
            name: self.name.to_owned(),
            port: None,
            at: None,
            variable_type,
            access: VariableAccess::ReadOnly,
            place: Place::whole(Area::CpuUnit, self.start, variable_type.size_bytes()),
            series: None,
            modbus: Some(ModbusAddress::at(self.discrete_input)),
            nx_object: None,
            pdo_entry: None,
        }
    }
}
