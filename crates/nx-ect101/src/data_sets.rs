//! The data sets shared by master and CPU Unit, from `tables/allocation.toml` (manual, 5-2, 6-3 and 7-5).
//!
//! A data set has one name and two sides: an I/O entry mapping for the CPU Unit and a PDO mapping object for
//! the master. Entry k of one side is exchanged with entry k of the other.

use std::sync::LazyLock;

use iec_types::Elementary;
use serde::{Deserialize, Deserializer};
use variables::{ModbusAddress, VariableType};
use wire::{ObjectIndex, SubIndex};

use crate::tables;

static ALLOCATION: LazyLock<AllocationFile> =
    LazyLock::new(|| tables::parse("allocation.toml", include_str!("../tables/allocation.toml")));

/// The direction of data.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Direction {
    /// From the EtherCAT master to the CPU Unit: outputs, RxPDO.
    MToC,
    /// From the CPU Unit to the EtherCAT master: inputs, TxPDO.
    CToM,
}

/// The contents of one entry of a data set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DataSetKind {
    /// ARRAY[0..14] OF UINT, 30 bytes.
    Uints,
    /// ARRAY[0..9] OF BYTE, 10 bytes.
    Bytes,
    /// UDINT, 4 bytes.
    Udint,
}

impl Direction {
    /// Both, in the order of their objects.
    pub const ALL: [Self; 2] = [Self::MToC, Self::CToM];

    /// Its name in data for programs.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::MToC => "m_to_c",
            Self::CToM => "c_to_m",
        }
    }

    /// Its assignment object: 1C12 or 1C13.
    #[must_use]
    pub fn assignment(self) -> ObjectIndex {
        Assignment::of(self).object
    }
}

impl DataSetKind {
    /// The three kinds, in the order of their objects.
    pub const ALL: [Self; 3] = [Self::Uints, Self::Bytes, Self::Udint];

    /// The type of an entry (manual, 6-3-2).
    #[must_use]
    pub const fn variable_type(self) -> VariableType {
        match self {
            Self::Uints => VariableType::array(Elementary::Uint, 15),
            Self::Bytes => VariableType::array(Elementary::Byte, 10),
            Self::Udint => VariableType::single(Elementary::Udint),
        }
    }

    /// Modbus registers of an entry: one for each element, a UDINT has two.
    const fn registers(self) -> u16 {
        match self.variable_type() {
            VariableType { elements: Some(elements), .. } => elements,
            VariableType { elementary, elements: None } => elementary.size_bytes().div_ceil(2) as u16,
        }
    }
}

/// One data set and its two sides.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DataSet {
    /// The contents of its entries.
    pub kind: DataSetKind,
    /// Their direction.
    pub direction: Direction,
    /// Its name, the same for the I/O entry mapping and for the PDO mapping object.
    pub name: String,
    /// Name of the object that contains the entries.
    pub entry_name: String,
    /// Name of the series of its I/O ports, as in `UINTs 01 M to C`.
    pub series: String,
    /// NX object of the I/O entries.
    #[serde(deserialize_with = "object_index")]
    pub nx_entry: ObjectIndex,
    /// PDO mapping object.
    #[serde(deserialize_with = "object_index")]
    pub pdo: ObjectIndex,
    /// CoE object of the PDO entries.
    #[serde(deserialize_with = "object_index")]
    pub pdo_entry: ObjectIndex,
    /// Length of one entry in bytes.
    pub entry_bytes: u16,
    /// Entries at the factory setting, when the data set is selected.
    pub default_count: u8,
    /// Maximum number of entries that can be allocated.
    pub max_count: u8,
    /// Whether the factory setting selects it.
    pub default_selected: bool,
    /// First register of its entry 1 for clients of Modbus.
    modbus: u16,
    /// First holding register that forces its entry 1.
    modbus_forced: u16,
}

impl DataSet {
    /// The six data sets: M to C, then C to M.
    #[must_use]
    pub fn all() -> &'static [Self] {
        &ALLOCATION.data_set
    }

    /// The data set of `kind` in `direction`.
    #[must_use]
    pub fn of(direction: Direction, kind: DataSetKind) -> &'static Self {
        let found = Self::all().iter().find(|set| set.direction == direction && set.kind == kind);
        match found {
            Some(set) => set,
            None => panic!("tables/allocation.toml: no data set {direction:?} {kind:?}"),
        }
    }

    /// Whether it has an entry with this subindex.
    #[must_use]
    pub const fn has(&self, sub: SubIndex) -> bool {
        1 <= sub.0 && sub.0 <= self.max_count
    }

    /// The Modbus addresses of its entry `number`; none if it has no such entry.
    #[must_use]
    pub fn modbus_address(&self, number: u8) -> Option<ModbusAddress> {
        let registers = u16::from(number).checked_sub(1)? * self.kind.registers();
        let (first, forced) = (self.modbus + registers, Some(self.modbus_forced + registers));
        (number <= self.max_count).then_some(ModbusAddress { forced, ..ModbusAddress::at(first) })
    }

    /// The number of its I/O entry mapping in the attached information of events. The two sides use opposite
    /// directions: M to C is 1A01 to 1A03 there (manual, 8-3-4).
    #[must_use]
    pub fn io_mapping(&self) -> ObjectIndex {
        let opposite = match self.direction {
            Direction::MToC => Direction::CToM,
            Direction::CToM => Direction::MToC,
        };
        Self::of(opposite, self.kind).pdo
    }

    /// The data set in the PDO mapping object `pdo`; none for the status PDOs.
    #[must_use]
    pub fn of_pdo(pdo: ObjectIndex) -> Option<&'static Self> {
        Self::all().iter().find(|set| set.pdo == pdo)
    }
}

/// Maximum numbers of bytes of the unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// Data exchanged in one direction, over its three data sets (manual, 5-3-2).
    pub exchange_bytes: u16,
    /// RxPDOs, outputs (manual, 7-5-2).
    pub rxpdo_bytes: u16,
    /// TxPDOs, inputs, status included (manual, 7-5-2).
    pub txpdo_bytes: u16,
}

impl Limits {
    /// The limits of the model.
    #[must_use]
    pub fn of_model() -> Self {
        ALLOCATION.limits
    }
}

/// A PDO mapping object of fixed entries with a status for the master (manual, 7-5-5).
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StatusPdo {
    /// Its index.
    #[serde(deserialize_with = "object_index")]
    pub index: ObjectIndex,
    /// Whether it must be assigned.
    pub mandatory: bool,
}

impl StatusPdo {
    /// All of them.
    #[must_use]
    pub fn all() -> &'static [Self] {
        &ALLOCATION.status_pdo
    }
}

/// A PDO assignment object and the PDOs that it accepts (manual, A-6-6).
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Assignment {
    /// Its index: 1C12 or 1C13.
    #[serde(deserialize_with = "object_index")]
    pub object: ObjectIndex,
    /// The direction of its PDOs.
    pub direction: Direction,
    /// The PDO mapping objects that it accepts, in their correct order.
    #[serde(deserialize_with = "object_indexes")]
    pub allowed: Vec<ObjectIndex>,
}

impl Assignment {
    /// The assignment object of `direction`.
    #[must_use]
    pub fn of(direction: Direction) -> &'static Self {
        match ALLOCATION.assignment.iter().find(|assignment| assignment.direction == direction) {
            Some(assignment) => assignment,
            None => panic!("tables/allocation.toml: no assignment {direction:?}"),
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct AllocationFile {
    limits: Limits,
    data_set: Vec<DataSet>,
    status_pdo: Vec<StatusPdo>,
    assignment: Vec<Assignment>,
}

fn object_index<'de, D: Deserializer<'de>>(deserializer: D) -> Result<ObjectIndex, D::Error> {
    u16::deserialize(deserializer).map(ObjectIndex)
}

fn object_indexes<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<ObjectIndex>, D::Error> {
    Ok(Vec::<u16>::deserialize(deserializer)?.into_iter().map(ObjectIndex).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_data_set_agrees_with_the_object_table() {
        let objects = tables::object_table();
        assert_eq!(DataSet::all().len(), 6);
        for set in DataSet::all() {
            let mapping = objects.object(set.pdo).expect("a PDO mapping object");
            assert_eq!((&mapping.name, mapping.max_sub().0), (&set.name, set.max_count));
            let data = objects.object(set.pdo_entry).expect("an object of the device profile area");
            assert_eq!((&data.name, data.max_sub().0), (&set.entry_name, set.max_count));
            let entry = data.entry(SubIndex(1)).expect("subindex 1");
            assert_eq!(entry.bit_length, set.entry_bytes * 8);
        }
    }

    #[test]
    fn assignments_take_the_mapping_objects_that_exist() {
        let objects = tables::object_table();
        for direction in [Direction::MToC, Direction::CToM] {
            let assignment = Assignment::of(direction);
            assert_eq!(
                objects.object(assignment.object).expect("exists").max_sub().0 as usize,
                assignment.allowed.len()
            );
            assert!(assignment.allowed.iter().all(|&pdo| objects.object(pdo).is_some()));
        }
    }
}
