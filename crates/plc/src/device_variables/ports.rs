//! The I/O ports of the unit and the variables of the NX bus (manual, 6-3-2, A-3-3 and A-5).

use nx_ect101::{DataSet, DataSetKind, Direction, ImageLayout, SLAVE_STATUS_BITS, StatusBit};
use st::Elementary;

use super::memory::{Area, Place};
use super::variable::{Variable, VariableAccess, VariableType};

/// Elements of the system-defined tables: the NX Bus Function Module and 32 NX Units (manual, A-5-1).
pub const SYSTEM_TABLE_ELEMENTS: u16 = 33;

const TABLE_BYTES: usize = SYSTEM_TABLE_ELEMENTS as usize;
/// Positions of the parts of the status image.
pub(crate) const SLAVE_STATUS: usize = 0;
pub(crate) const IO_DATA_ACTIVE: usize = 2;
pub(crate) const UNIT_ERROR: usize = 3;
pub(crate) const MESSAGE_TABLE: usize = 4;
pub(crate) const ERROR_TABLE: usize = MESSAGE_TABLE + TABLE_BYTES;
/// Length of the status image in bytes.
pub(crate) const STATUS_BYTES: usize = ERROR_TABLE + TABLE_BYTES;

/// The meaning of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum VariableSource {
    /// An I/O entry of a data set.
    Entry {
        /// The direction of the data.
        direction: Direction,
        /// The data set.
        kind: DataSetKind,
        /// Number of the entry, its subindex.
        number: u8,
    },
    /// EtherCAT Slave Status, the whole word.
    SlaveStatus,
    /// One bit of it.
    SlaveStatusBit {
        /// Its number, 0 to 15.
        bit: u8,
    },
    /// NX Unit I/O Data Active Status.
    IoDataActive,
    /// NX Unit Error Status.
    UnitError,
    /// `_NXB_UnitMsgActiveTbl`: which NX Units support message communications.
    UnitMessageActiveTable,
    /// `_NXB_UnitErrFlagTbl`: which NX Units have an error.
    UnitErrorFlagTable,
}

/// The port that contains a location instead of data: NX_ReadObj and NX_WriteObj need a variable that is
/// assigned to it.
const NODE_LOCATION_PORT: &str = "Node location information";
const SLAVE_STATUS_PORT: &str = "EtherCAT Slave Status";

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
            at: at(unit_number, "", NODE_LOCATION_PORT),
            type_name: "_sNXUNIT_ID",
            unit_number,
        }
    }
}

/// Makes the variables of one unit.
pub(super) struct Ports<'a> {
    pub(super) device_name: &'a str,
    pub(super) unit_number: u8,
}

impl Ports<'_> {
    /// The entries of one direction, in the order of the image. An entry that is in the wrong data set, or
    /// occurs a second time, has no I/O port.
    pub(super) fn entries(&self, direction: Direction, layout: &ImageLayout) -> Vec<Variable> {
        let mut entries = Vec::new();
        for kind in DataSetKind::ALL {
            for number in 0..=u8::MAX {
                if let Some(bytes) = layout.place(direction, kind, number) {
                    entries.push((bytes.start, self.entry(direction, kind, number, bytes.start)));
                }
            }
        }
        entries.sort_by_key(|(start, _)| *start);
        entries.into_iter().map(|(_, variable)| variable).collect()
    }

    fn entry(&self, direction: Direction, kind: DataSetKind, number: u8, start: usize) -> Variable {
        let set = match kind {
            DataSetKind::Uints => "UINTs",
            DataSetKind::Bytes => "BYTES",
            DataSetKind::Udint => "UDINT",
        };
        let variable_type = VariableType::of_entry(kind);
        let (area, way, access) = match direction {
            Direction::MToC => (Area::MToC, "M to C", VariableAccess::ReadOnly),
            Direction::CToM => (Area::CToM, "C to M", VariableAccess::ReadWrite),
        };
        let length_bytes = usize::from(DataSet::of(direction, kind).entry_bytes);
        let source = VariableSource::Entry { direction, kind, number };
        let port = format!("{set} {number:02} {way}");
        let place = Place::whole(area, start, length_bytes);
        Variable { access, ..self.port(self.device_name, "", &port, variable_type, source, place) }
    }

    /// EtherCAT Slave Status and its bits, and the statuses of the unit in the NX Bus Function Module.
    pub(super) fn statuses(&self) -> Vec<Variable> {
        let (word, bool) = (VariableType::single(Elementary::Word), VariableType::single(Elementary::Bool));
        let place = Place::whole(Area::Status, SLAVE_STATUS, 2);
        let source = VariableSource::SlaveStatus;
        let mut list = vec![self.port(self.device_name, "", SLAVE_STATUS_PORT, word, source, place)];
        for StatusBit { bit, port } in SLAVE_STATUS_BITS {
            let place = Place::bit(Area::Status, SLAVE_STATUS, bit);
            let (path, source) = (format!("{SLAVE_STATUS_PORT}/"), VariableSource::SlaveStatusBit { bit });
            list.push(self.port(self.device_name, &path, port, bool, source, place));
        }
        let prefix = format!("NXBus_{}", self.device_name);
        let of_bus = [
            ("NX Unit I/O Data Active Status", VariableSource::IoDataActive, IO_DATA_ACTIVE),
            ("NX Unit Error Status", VariableSource::UnitError, UNIT_ERROR),
        ];
        for (port, source, start) in of_bus {
            let place = Place::whole(Area::Status, start, 1);
            list.push(self.port(&prefix, "", port, bool, source, place));
        }
        list
    }

    /// A read-only variable of an I/O port.
    fn port(
        &self,
        prefix: &str,
        path: &str,
        port: &str,
        variable_type: VariableType,
        source: VariableSource,
        place: Place,
    ) -> Variable {
        Variable {
            name: variable_name(prefix, port),
            port: Some(port.to_owned()),
            at: Some(at(self.unit_number, path, port)),
            variable_type,
            access: VariableAccess::ReadOnly,
            source,
            place,
        }
    }
}

fn at(unit_number: u8, path: &str, port: &str) -> String {
    format!("IOBus://unit#{unit_number}/{path}{port}")
}

/// The default name of a variable of an I/O port (manual, 6-1-2): the device name and the port's, with `_` for
/// every character that is not a letter or a digit.
#[must_use]
pub fn variable_name(device_name: &str, port: &str) -> String {
    let words = port.replace(|character: char| !character.is_ascii_alphanumeric(), "_");
    format!("{device_name}_{words}")
}

/// The system-defined variables: they have no device name, and no AT specification.
pub(super) fn system_defined() -> [Variable; 2] {
    let tables = [
        ("_NXB_UnitMsgActiveTbl", VariableSource::UnitMessageActiveTable, MESSAGE_TABLE),
        ("_NXB_UnitErrFlagTbl", VariableSource::UnitErrorFlagTable, ERROR_TABLE),
    ];
    tables.map(|(name, source, start)| Variable {
        name: name.to_owned(),
        port: None,
        at: None,
        variable_type: VariableType::array(Elementary::Bool, SYSTEM_TABLE_ELEMENTS),
        access: VariableAccess::ReadOnly,
        source,
        place: Place::whole(Area::Status, start, TABLE_BYTES),
    })
}
