//! PDO mapping and assignment of this model: the factory setting, that of a unit file, sizes of each direction.

use coe_kit::pdo::{PdoEntry, PdoObjects, PdoSettings};
use wire::{EntryAddress, ObjectIndex};

use crate::data_sets::{Assignment, DataSet, Direction};
use crate::tables::object_table;
use crate::unit_file::PdoSection;

/// The factory setting (manual, 7-5-4).
#[must_use]
pub fn factory() -> PdoSettings {
    PdoSettings::of_objects(&PdoObjects::of_table(&object_table()))
}

/// The factory setting with what the section of a unit file changes.
#[must_use]
pub fn of_section(section: &PdoSection) -> PdoSettings {
    let mut settings = factory();
    let assigned = [(Direction::MToC, &section.assign_rx), (Direction::CToM, &section.assign_tx)];
    for (direction, pdos) in assigned {
        if let Some(pdos) = pdos {
            settings.assign(direction.assignment(), pdos.value.iter().map(|pdo| pdo.value));
        }
    }
    for mapping in &section.mappings {
        let pdo = mapping.pdo.value;
        let index = DataSet::of_pdo(pdo).map_or(ObjectIndex(0), |set| set.pdo_entry);
        settings.map(pdo, mapping.entries.value.addresses(index).into_iter().map(entry_at));
    }
    settings
}

/// The entry at `address` with the length of its object. In the object of a data set every subindex has the length of an
/// entry, also one that does not exist: it counts as the master declares it.
#[must_use]
pub fn entry_at(address: EntryAddress) -> PdoEntry {
    let EntryAddress { index, sub } = address;
    match DataSet::all().iter().find(|set| set.pdo_entry == index) {
        Some(set) => PdoEntry { index, sub, bit_length: set.entry_bytes * 8 },
        None => PdoEntry::of_table(&object_table(), address),
    }
}

/// The entries of a data set, if its PDO is assigned; else none.
#[must_use]
pub(crate) fn assigned_entries<'a>(settings: &'a PdoSettings, set: &DataSet) -> &'a [PdoEntry] {
    let is_assigned = settings.assigned(set.direction.assignment()).any(|pdo| pdo == set.pdo);
    if is_assigned { settings.entries(set.pdo) } else { &[] }
}

/// Length of all PDOs that are assigned in `direction` and can be, in bytes, rounded up at the end.
#[must_use]
pub fn size_bytes(settings: &PdoSettings, direction: Direction) -> usize {
    settings.size_bytes(direction.assignment(), |pdo| is_assignable(direction, pdo))
}

/// Length of the assigned data sets of `direction` in bytes: what [`size_bytes`] has without the status.
#[must_use]
pub(crate) fn data_bytes(settings: &PdoSettings, direction: Direction) -> usize {
    let counts = |pdo| is_assignable(direction, pdo) && DataSet::of_pdo(pdo).is_some();
    settings.size_bytes(direction.assignment(), counts)
}

/// Whether the assignment object of `direction` accepts this PDO.
pub(crate) fn is_assignable(direction: Direction, pdo: ObjectIndex) -> bool {
    Assignment::of(direction).allowed.contains(&pdo)
}

#[cfg(test)]
pub(crate) mod tests;
