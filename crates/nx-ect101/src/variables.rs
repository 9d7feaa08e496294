//! The variables of the unit, as a table for its CPU Unit (manual, 6-3-2 and A-3-3).

use iec_types::Elementary;
use variables::{
    Area, BusUnit, ModbusAddress, Place, STATUS_BYTES, Series, StatusWord, Variable, VariableAccess,
    VariableTable, VariableType, at_specification, variable_name,
};
use wire::{EntryAddress, SubIndex};

use crate::allocation::{ImageLayout, IoAllocation};
use crate::data_sets::{DataSet, DataSetKind, Direction};
use crate::status::{SLAVE_STATUS_BITS, StatusBit};
use nx_bus::SlaveStatus;

const SLAVE_STATUS_PORT: &str = "EtherCAT Slave Status";
/// Input register of EtherCAT Slave Status.
const SLAVE_STATUS_REGISTER: u16 = 3000;
/// Discrete input of its bit 0.
const SLAVE_STATUS_DISCRETE_INPUT: u16 = 0;

/// EtherCAT Slave Status for the CPU Unit.
fn status_word() -> StatusWord {
    let off = SlaveStatus { ready_to_write_message: false, ..SlaveStatus::default() };
    StatusWord {
        m_to_c_valid: SlaveStatus { m_to_c_valid: true, ..off }.bits(),
        c_to_m_valid: SlaveStatus { c_to_m_valid: true, ..off }.bits(),
    }
}

/// The variables of a unit with this device name, NX Unit number and I/O allocation: I/O ports M to C, C to M, EtherCAT
/// Slave Status. Each I/O entry that belongs to its data set has one, and so has each bit of EtherCAT Slave Status.
#[must_use]
pub fn variable_table(device_name: &str, unit_number: u8, allocation: &IoAllocation) -> VariableTable {
    let [m_to_c, c_to_m] = Direction::ALL.map(|direction| allocation.layout(direction));
    let ports = Ports { device_name, unit_number };
    let mut list = ports.entries(Direction::MToC, &m_to_c);
    list.extend(ports.entries(Direction::CToM, &c_to_m));
    list.extend(ports.statuses());
    let unit = BusUnit {
        device_name: device_name.to_owned(),
        unit_number,
        m_to_c_bytes: m_to_c.size_bytes(),
        c_to_m_bytes: c_to_m.size_bytes(),
        status: status_word(),
    };
    VariableTable::new(unit, list)
}

/// Makes the variables of one unit.
struct Ports<'a> {
    device_name: &'a str,
    unit_number: u8,
}

impl Ports<'_> {
    /// The entries of one direction, in the order of the image. An entry that is in the wrong data set, or occurs
    /// a second time, has no I/O port.
    fn entries(&self, direction: Direction, layout: &ImageLayout) -> Vec<Variable> {
        let mut entries = Vec::new();
        for kind in DataSetKind::ALL {
            let set = DataSet::of(direction, kind);
            for number in 0..=u8::MAX {
                if let Some(bytes) = layout.place(direction, kind, number) {
                    entries.push(self.entry(set, number, bytes.start));
                }
            }
        }
        entries.sort_by_key(|variable| variable.place.start);
        entries
    }

    fn entry(&self, set: &'static DataSet, number: u8, start: usize) -> Variable {
        let (area, way, access) = match set.direction {
            Direction::MToC => (Area::MToC, "M to C", VariableAccess::ReadOnly),
            Direction::CToM => (Area::CToM, "C to M", VariableAccess::ReadWrite),
        };
        let port = format!("{} {number:02} {way}", set.series);
        let place = Place::whole(area, start, usize::from(set.entry_bytes));
        let at = |index| EntryAddress { index, sub: SubIndex(number) };
        Variable {
            access,
            series: Some(Series { name: &set.series, number }),
            modbus: set.modbus_address(number),
            nx_object: Some(at(set.nx_entry)),
            pdo_entry: Some(at(set.pdo_entry)),
            ..self.port("", &port, set.kind.variable_type(), place)
        }
    }

    /// EtherCAT Slave Status and its bits.
    fn statuses(&self) -> Vec<Variable> {
        let (index, sub) = SlaveStatus::NX_OBJECT;
        let nx_object = Some(EntryAddress { index, sub });
        let status = |path: &str, port: &str, elementary, modbus, place| {
            let variable = self.port(path, port, VariableType::single(elementary), place);
            Variable { nx_object, modbus: Some(modbus), ..variable }
        };
        let bits = Some(SLAVE_STATUS_DISCRETE_INPUT);
        let modbus = ModbusAddress { bits, ..ModbusAddress::at(SLAVE_STATUS_REGISTER) };
        let place = Place::whole(Area::Status, 0, STATUS_BYTES);
        let mut list = vec![status("", SLAVE_STATUS_PORT, Elementary::Word, modbus, place)];
        list.extend(SLAVE_STATUS_BITS.iter().map(|&StatusBit { bit, port }| {
            let modbus = ModbusAddress::at(SLAVE_STATUS_DISCRETE_INPUT + u16::from(bit));
            let place = Place::bit(Area::Status, usize::from(bit));
            status(&format!("{SLAVE_STATUS_PORT}/"), port, Elementary::Bool, modbus, place)
        }));
        list
    }

    /// A read-only variable of an I/O port.
    fn port(&self, path: &str, port: &str, variable_type: VariableType, place: Place) -> Variable {
        Variable {
            name: variable_name(self.device_name, port),
            port: Some(port.to_owned()),
            at: Some(at_specification(self.unit_number, &format!("{path}{port}"))),
            variable_type,
            access: VariableAccess::ReadOnly,
            place,
            series: None,
            modbus: None,
            nx_object: None,
            pdo_entry: None,
        }
    }
}
