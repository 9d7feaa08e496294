//! The variables of the master's user program: the PDO entries of its slaves as device variables, and the
//! system-defined tables (manual, A-4-3 and A-5-1).

use std::sync::Arc;

use ::master::{Direction, SlaveSettings};
use coe_kit::pdo::{PdoEntry, PdoSettings, assignment_object};
use esi::{KnownDevice, NamedBit};
use objects::AccessRights;
use plc::{VariableType, variable_name};
use st::{Elementary, Global};
use wire::EntryAddress;

/// Number of node addresses with an element in the tables, from 1 on.
pub(crate) const NODE_ADDRESS_MAX: u16 = 192;

/// A unit for the master's program.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    /// Its position in the line.
    pub(crate) unit: usize,
    /// Its node address, 1 to [`NODE_ADDRESS_MAX`]: the ID of the unit (manual, 3-3).
    pub(crate) address: u16,
    /// First part of its device variables.
    pub(crate) device_name: String,
    /// What the master's project has about it.
    pub(crate) device: Arc<KnownDevice>,
}

/// The meaning of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Source {
    /// `_EC_PDSlavTbl`: the slaves that are in OP and exchange process data.
    ProcessDataTable,
    /// `_EC_MBXSlavTbl`: the slaves that have a mailbox.
    MailboxTable,
    /// An entry of a PDO of the unit at this position.
    Entry { unit: usize, direction: Direction, address: EntryAddress },
    /// One bit of an entry among the inputs.
    InputBit { unit: usize, address: EntryAddress, bit: u8 },
}

impl Source {
    /// Its unit.
    pub(crate) const fn unit(&self) -> Option<usize> {
        match self {
            Self::Entry { unit, .. } | Self::InputBit { unit, .. } => Some(*unit),
            Self::ProcessDataTable | Self::MailboxTable => None,
        }
    }

    /// Its position in the process data with these settings; none if it is not mapped.
    pub(crate) fn place(&self, device: &KnownDevice, settings: &PdoSettings) -> Option<Place> {
        match *self {
            Self::Entry { direction, address, .. } => place(device, settings, direction, address),
            Self::InputBit { address, bit, .. } => {
                let entry = place(device, settings, Direction::Inputs, address)?;
                Some(Place { start: entry.start + usize::from(bit), length: 1 })
            }
            Self::ProcessDataTable | Self::MailboxTable => None,
        }
    }
}

/// The variables of one master.
#[derive(Clone, Debug)]
pub(crate) struct MasterVariables {
    pub(crate) globals: Vec<Global>,
    /// The meaning of each of them.
    pub(crate) sources: Vec<Source>,
}

impl MasterVariables {
    /// The variables of every master.
    pub(crate) fn new() -> Self {
        let mut variables = Self { globals: Vec::new(), sources: Vec::new() };
        variables.add("_EC_PDSlavTbl", Source::ProcessDataTable);
        variables.add("_EC_MBXSlavTbl", Source::MailboxTable);
        variables
    }

    fn add(&mut self, name: &str, source: Source) {
        self.globals.push(Global {
            name: name.to_owned(),
            at: None,
            type_name: format!("ARRAY[1..{NODE_ADDRESS_MAX}] OF BOOL"),
            writable: false,
            constant: None,
        });
        self.sources.push(source);
    }

    /// Adds the PDO entries of a unit with these settings, unless they already exist.
    pub(crate) fn add_slave(&mut self, node: &Node, settings: &PdoSettings) {
        for direction in [Direction::Outputs, Direction::Inputs] {
            for (entry, _) in entries(&node.device, settings, direction) {
                self.add_entry(node, direction, entry);
            }
        }
    }

    fn add_entry(&mut self, node: &Node, direction: Direction, entry: PdoEntry) {
        let address = EntryAddress { index: entry.index, sub: entry.sub };
        let source = Source::Entry { unit: node.unit, direction, address };
        let object = node.device.objects.entry(entry.index, entry.sub);
        let (Some(object), false) = (object, self.sources.contains(&source)) else { return };
        let Some(type_name) = type_of(object, direction, entry) else { return };
        let is_writable = direction == Direction::Outputs;
        self.add_port(node, "", &object.name, &type_name.to_string(), is_writable, source);
        let path = format!("{}/", object.name);
        let bits =
            node.device.bits.iter().filter(|bit| direction == Direction::Inputs && bit.entry == address);
        for &NamedBit { bit, name, .. } in bits {
            let source = Source::InputBit { unit: node.unit, address, bit };
            self.add_port(node, &path, name, "BOOL", false, source);
        }
    }

    fn add_port(
        &mut self,
        node: &Node,
        path: &str,
        port: &str,
        type_name: &str,
        writable: bool,
        source: Source,
    ) {
        self.globals.push(Global {
            name: variable_name(&node.device_name, port),
            at: Some(format!("ECAT://node#{}/{path}{port}", node.address)),
            type_name: type_name.to_owned(),
            writable,
            constant: None,
        });
        self.sources.push(source);
    }
}

/// None for an entry that cannot be mapped in this direction, and for one without a type of variables.
fn type_of(object: &objects::Entry, direction: Direction, entry: PdoEntry) -> Option<VariableType> {
    let rights = match direction {
        Direction::Outputs => AccessRights::RX_PDO,
        Direction::Inputs => AccessRights::TX_PDO,
    };
    let data_type = Some(object.data_type).filter(|_| object.access.contains(rights))?;
    let (name, elements) = esi::element_type(data_type, entry.bit_length)?;
    Elementary::named(name).map(|elementary| VariableType { elementary, elements })
}

/// The position of an entry in the process data of its direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    /// Its first bit.
    pub(crate) start: usize,
    /// Its number of bits.
    pub(crate) length: usize,
}

/// The position of an entry with these settings; none if it is not mapped.
fn place(
    device: &KnownDevice,
    settings: &PdoSettings,
    direction: Direction,
    address: EntryAddress,
) -> Option<Place> {
    let is_at = |entry: PdoEntry| (entry.index, entry.sub) == (address.index, address.sub);
    entries(device, settings, direction).find(|(entry, _)| is_at(*entry)).map(|(_, place)| place)
}

/// The entries of a direction with their places: SyncManager after SyncManager, each from a byte on.
fn entries(
    device: &KnownDevice,
    settings: &PdoSettings,
    direction: Direction,
) -> impl Iterator<Item = (PdoEntry, Place)> {
    let channels = SlaveSettings::from_description(&device.description);
    let assignments: Vec<_> =
        channels.areas(direction).map(|area| assignment_object(area.sync_manager.number)).collect();
    let starts = assignments.into_iter().scan(0, |start, assignment| {
        let of_this = *start;
        *start += 8 * settings.size_bytes(assignment, |_| true);
        Some((of_this, assignment))
    });
    starts.flat_map(|(start, assignment)| {
        settings.placed(assignment).map(move |placed| {
            let place = Place { start: start + placed.bits.start, length: placed.bits.len() };
            (placed.entry, place)
        })
    })
}

impl Place {
    /// The value in the form of a variable: whole bytes, or a bit as 0 or 1. Data that have not been received
    /// yet are 0.
    pub(crate) fn take(self, image: &[u8], value: &mut Vec<u8>) {
        let rest = image.get(self.start / 8..).unwrap_or_default();
        if self.length == 1 {
            let byte = rest.first().copied().unwrap_or(0);
            return value.push(byte >> (self.start % 8) & 1);
        }
        let length_bytes = self.length.div_ceil(8);
        value.extend(rest.iter().take(length_bytes));
        value.resize(value.len().max(length_bytes), 0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wire::{ObjectIndex, SubIndex};

    fn device() -> Arc<KnownDevice> {
        let file =
            plant::UnitFile::parse("model = \"nx-ect101\"").unwrap_or_else(|errors| panic!("{errors}"));
        Arc::new(file.section().known_device())
    }

    /// The factory setting and, of each direction, the first UDINT.
    fn settings() -> PdoSettings {
        let mut settings = PdoSettings::of_description(&device().description);
        settings.assign(assignment_object(2), [0x1601, 0x1603].map(ObjectIndex));
        settings.assign(assignment_object(3), [0x1A00, 0x1A01, 0x1A03, 0x1BFE, 0x1BFF].map(ObjectIndex));
        settings
    }

    #[test]
    fn the_entries_of_a_slave_have_the_manuals_names() {
        let node = Node { unit: 0, address: 1, device_name: "E001".into(), device: device() };
        let mut variables = MasterVariables::new();
        variables.add_slave(&node, &settings());
        let find = |name: &str| variables.globals.iter().find(|global| global.name == name);
        for (name, at, type_name, writable) in [
            ("E001_UDINT_01_C_to_M", "ECAT://node#1/UDINT 01 C to M", "UDINT", false),
            ("E001_UINTs_06_M_to_C", "ECAT://node#1/UINTs 06 M to C", "ARRAY[0..14] OF UINT", true),
            (
                "E001_Data_from_CPU_Unit_to_EtherCAT_Master_Valid",
                "ECAT://node#1/Data from CPU Unit to EtherCAT Master Valid",
                "BOOL",
                false,
            ),
            ("E001_Sysmac_Error_Status", "ECAT://node#1/Sysmac Error Status", "USINT", false),
            ("E001_New_Messages_Available", "ECAT://node#1/New Messages Available", "BOOL", false),
            ("E001_Observation", "ECAT://node#1/Sysmac Error Status/Observation", "BOOL", false),
            ("E001_Minor_Fault", "ECAT://node#1/Sysmac Error Status/Minor Fault", "BOOL", false),
        ] {
            let global = find(name).unwrap_or_else(|| panic!("{name}"));
            assert_eq!(
                (global.at.as_deref(), global.type_name.as_str(), global.writable),
                (Some(at), type_name, writable)
            );
        }
        let before = variables.globals.len();
        variables.add_slave(&node, &settings());
        assert_eq!(variables.globals.len(), before, "each entry once");
    }

    #[test]
    fn entries_lie_behind_each_other() {
        let address = |index, sub| EntryAddress { index: ObjectIndex(index), sub: SubIndex(sub) };
        let place = |direction, index, sub| {
            let place = place(&device(), &settings(), direction, address(index, sub));
            place.map(|place| (place.start, place.length))
        };
        assert_eq!(place(Direction::Inputs, 0x6003, 2), Some((1, 1)));
        assert_eq!(place(Direction::Inputs, 0x6000, 1), Some((16, 240)));
        assert_eq!(place(Direction::Inputs, 0x6002, 1), Some((16 + 6 * 240, 32)));
        assert_eq!(place(Direction::Outputs, 0x7002, 1), Some((6 * 240, 32)));
        assert_eq!(place(Direction::Outputs, 0x7001, 1), None);
    }

    #[test]
    fn a_bit_is_taken_as_a_bool() {
        let taken = |start, length, image: &[u8]| {
            let mut value = Vec::new();
            Place { start, length }.take(image, &mut value);
            value
        };
        assert_eq!(
            (taken(1, 1, &[0x02]), taken(2, 1, &[0x02]), taken(9, 1, &[0x02])),
            (vec![1], vec![0], vec![0])
        );
        assert_eq!((taken(8, 16, &[1, 2, 3]), taken(8, 16, &[1, 2])), (vec![2, 3], vec![2, 0]));
    }
}
