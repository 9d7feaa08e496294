//! What the pool has to know of a unit.

use esc::{EcatAccess, REGISTERS};
use esi::Pdo;
use objects::AccessRights;
use unit_model::UnitSection;

use crate::model::Entry;

/// Objects of a maker: parameters and information.
const OF_MAKER: core::ops::RangeInclusive<u16> = 0x2000..=0x5FFF;
/// A longer value says no more than one of this length.
const VALUE_BYTES_MAX: usize = 8;
/// Assignment of the PDOs of a direction.
const ASSIGNMENTS: [u16; 2] = [0x1C12, 0x1C13];

/// The parts of a unit that a mark can draw from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct KnownUnit {
    pub(super) faults: Vec<&'static str>,
    pub(super) readable: Vec<Entry>,
    /// With their length in bytes.
    pub(super) writable: Vec<(Entry, usize)>,
    /// Those of the maker.
    pub(super) parameters: Vec<(Entry, usize)>,
    /// With their default entries.
    pub(super) pdos: Vec<(u16, Vec<Entry>)>,
    pub(super) assignments: Vec<u16>,
    pub(super) sync_managers: usize,
}

impl KnownUnit {
    pub(crate) fn of(unit: &dyn UnitSection) -> Self {
        let objects = unit.objects();
        let entries = || {
            objects.iter().flat_map(|object| {
                object.entries.iter().map(|entry| {
                    let name = Entry { index: object.index.0, sub: entry.sub.0 };
                    (name, entry.access, entry.size_bytes())
                })
            })
        };
        let readable = entries().filter(|(_, access, _)| access.intersects(AccessRights::READ));
        let writable: Vec<(Entry, usize)> = entries()
            .filter(|(_, access, length)| {
                access.intersects(AccessRights::WRITE) && *length <= VALUE_BYTES_MAX
            })
            .map(|(name, _, length)| (name, length))
            .collect();
        let description = unit.description();
        let pdos = description.rx_pdos.iter().chain(&description.tx_pdos).map(pdo);
        Self {
            faults: unit.model().faults().to_vec(),
            readable: readable.map(|(name, _, _)| name).collect(),
            parameters: writable.iter().copied().filter(|(name, _)| OF_MAKER.contains(&name.index)).collect(),
            pdos: pdos.collect(),
            assignments: ASSIGNMENTS
                .into_iter()
                .filter(|index| writable.iter().any(|(name, _)| name.index == *index))
                .collect(),
            sync_managers: description.sync_managers.len(),
            writable,
        }
    }

    /// A unit that has something for each mark.
    pub(crate) fn example() -> Self {
        let entry = Entry { index: 0x2000, sub: 1 };
        Self {
            faults: plant::models().iter().flat_map(|model| model.faults()).copied().take(1).collect(),
            readable: vec![entry],
            writable: vec![(entry, 1)],
            parameters: vec![(entry, 1)],
            pdos: vec![(0x1600, vec![entry])],
            assignments: ASSIGNMENTS.to_vec(),
            sync_managers: 4,
        }
    }

    /// Whether the dictionary has this entry.
    pub(super) fn has_entry(&self, entry: Entry) -> bool {
        self.readable.contains(&entry) || self.writable.iter().any(|(name, _)| *name == entry)
    }
}

fn pdo(pdo: &Pdo) -> (u16, Vec<Entry>) {
    let entries = pdo.entries.iter().filter(|entry| entry.index.0 != 0);
    (pdo.index.0, entries.map(|entry| Entry { index: entry.index.0, sub: entry.sub.0 }).collect())
}

/// Registers that a master may write, with their length in bytes.
pub(super) fn registers() -> Vec<(u16, usize)> {
    let rows = REGISTERS.iter().filter(|register| register.ecat == EcatAccess::ReadWrite);
    rows.map(|register| (register.offset, usize::from(register.size_bytes))).collect()
}
