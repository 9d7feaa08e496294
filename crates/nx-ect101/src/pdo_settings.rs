//! The settings of a master: the entries of each PDO and the PDOs of each SyncManager, correct or not.

use wire::{ObjectIndex, SubIndex};

use crate::data_sets::{Assignment, DataSet, Direction, StatusPdo};
use crate::mapping::{MappedEntry, Mapping};
use crate::tables::object_table;
use crate::unit_file::{EntryAddress, PdoSection};

/// Maximum number of entries in the mapping object of a data set; memory for them is allocated at once.
const MAX_ENTRIES: usize = 40;
/// Maximum number of PDOs in an assignment object.
const MAX_ASSIGNED: usize = 6;

/// One element of a PDO mapping object.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PdoEntry {
    /// The mapped CoE object; 0 for padding and for an element without an entry.
    pub index: ObjectIndex,
    /// Subindex in it.
    pub sub: SubIndex,
    /// Length in the PDO, in bits.
    pub bit_length: u16,
}

impl PdoEntry {
    /// The entry at `address` with the length of its object; 0 bits for an entry that does not exist. An entry
    /// beyond the highest subindex of a data set has the same length as those before it.
    #[must_use]
    pub fn at(address: EntryAddress) -> Self {
        let EntryAddress { index, sub } = address;
        let of_data_set = DataSet::all().iter().find(|set| set.pdo_entry == index);
        let bit_length = match of_data_set {
            Some(set) => set.entry_bytes * 8,
            None => object_table().entry(index, sub).map_or(0, |entry| entry.bit_length),
        };
        Self { index, sub, bit_length }
    }

    /// Whether the element maps no entry.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.index.0 == 0 && self.bit_length == 0
    }
}

/// PDO mapping and PDO assignment of one unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PdoSettings {
    rx: Vec<ObjectIndex>,
    tx: Vec<ObjectIndex>,
    /// Every PDO mapping object with its entries, ascending by index.
    mappings: Vec<(ObjectIndex, Vec<PdoEntry>)>,
}

impl PdoSettings {
    /// The factory setting (manual, 7-5-4).
    #[must_use]
    pub fn factory() -> Self {
        Self::of_mapping(&Mapping::factory(&object_table()))
    }

    /// The factory setting with the changes of a unit file's section.
    #[must_use]
    pub fn of_section(section: &PdoSection) -> Self {
        let mut settings = Self::factory();
        let assigned = [(Direction::MToC, &section.assign_rx), (Direction::CToM, &section.assign_tx)];
        for (direction, pdos) in assigned {
            if let Some(pdos) = pdos {
                settings.assign(direction, pdos.value.iter().map(|pdo| pdo.value));
            }
        }
        for mapping in &section.mappings {
            let pdo = mapping.pdo.value;
            let index = DataSet::of_pdo(pdo).map_or(ObjectIndex(0), |set| set.pdo_entry);
            settings.map(pdo, mapping.entries.value.addresses(index).into_iter().map(PdoEntry::at));
        }
        settings
    }

    /// The contents of the mapping and assignment objects of a unit.
    pub(crate) fn of_mapping(mapping: &Mapping) -> Self {
        let pdos =
            DataSet::all().iter().map(|set| set.pdo).chain(StatusPdo::all().iter().map(|pdo| pdo.index));
        let mut mappings: Vec<_> = pdos.map(|pdo| (pdo, Vec::with_capacity(MAX_ENTRIES))).collect();
        mappings.sort_by_key(|(pdo, _)| *pdo);
        let room = || Vec::with_capacity(MAX_ASSIGNED);
        let mut settings = Self { rx: room(), tx: room(), mappings };
        settings.follow(mapping);
        settings
    }

    /// Copies the present contents of the mapping and assignment objects to existing memory.
    pub(crate) fn follow(&mut self, mapping: &Mapping) {
        self.assign(Direction::MToC, mapping.assigned(Direction::MToC));
        self.assign(Direction::CToM, mapping.assigned(Direction::CToM));
        for (pdo, entries) in &mut self.mappings {
            entries.clear();
            entries.extend(mapping.entries(*pdo).map(PdoEntry::from));
        }
    }

    /// Assigns exactly these PDOs, in this order; index 0 is an element without PDO.
    pub fn assign(&mut self, direction: Direction, pdos: impl IntoIterator<Item = ObjectIndex>) {
        let list = match direction {
            Direction::MToC => &mut self.rx,
            Direction::CToM => &mut self.tx,
        };
        list.clear();
        list.extend(pdos);
    }

    /// Maps exactly these entries in `pdo`, in this order. Ignored if it is not a PDO mapping object.
    pub fn map(&mut self, pdo: ObjectIndex, entries: impl IntoIterator<Item = PdoEntry>) {
        if let Some((_, list)) = self.mappings.iter_mut().find(|(known, _)| *known == pdo) {
            list.clear();
            list.extend(entries);
        }
    }

    /// The elements of the assignment object of `direction`, including those without PDO.
    #[must_use]
    pub fn assignment(&self, direction: Direction) -> &[ObjectIndex] {
        match direction {
            Direction::MToC => &self.rx,
            Direction::CToM => &self.tx,
        }
    }

    /// The PDOs that are assigned in `direction`, in the order of their assignment.
    pub fn assigned(&self, direction: Direction) -> impl Iterator<Item = ObjectIndex> + '_ {
        self.assignment(direction).iter().copied().filter(|pdo| pdo.0 != 0)
    }

    /// The entries of `pdo`, including padding; none if it is not a PDO mapping object.
    #[must_use]
    pub fn entries(&self, pdo: ObjectIndex) -> &[PdoEntry] {
        self.mappings.iter().find(|(known, _)| *known == pdo).map_or(&[], |(_, entries)| entries)
    }

    /// The entries of a data set, if its PDO is assigned; otherwise empty.
    #[must_use]
    pub fn assigned_entries(&self, set: &DataSet) -> &[PdoEntry] {
        if self.assigned(set.direction).any(|pdo| pdo == set.pdo) { self.entries(set.pdo) } else { &[] }
    }

    /// Length of all assigned PDOs of `direction` in bytes, rounded up at the end.
    #[must_use]
    pub fn size_bytes(&self, direction: Direction) -> usize {
        self.bytes_of(direction, |_| true)
    }

    /// Length of the assigned data sets of `direction` in bytes: [`Self::size_bytes`] without the status.
    #[must_use]
    pub fn data_bytes(&self, direction: Direction) -> usize {
        self.bytes_of(direction, |pdo| DataSet::of_pdo(pdo).is_some())
    }

    fn bytes_of(&self, direction: Direction, counts: impl Fn(ObjectIndex) -> bool) -> usize {
        let pdos = self.assigned(direction).filter(|&pdo| is_assignable(direction, pdo) && counts(pdo));
        let bits = pdos.flat_map(|pdo| self.entries(pdo)).map(|entry| usize::from(entry.bit_length));
        bits.sum::<usize>().div_ceil(8)
    }
}

/// Whether the assignment object of `direction` accepts this PDO.
pub(crate) fn is_assignable(direction: Direction, pdo: ObjectIndex) -> bool {
    Assignment::of(direction).allowed.contains(&pdo)
}

impl From<MappedEntry> for PdoEntry {
    fn from(entry: MappedEntry) -> Self {
        let bit_length = u16::try_from(entry.bit_length()).unwrap_or(u16::MAX);
        Self { index: entry.index(), sub: entry.sub(), bit_length }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_factory_setting_has_the_manuals_sizes() {
        let settings = PdoSettings::factory();
        assert_eq!((settings.size_bytes(Direction::MToC), settings.data_bytes(Direction::MToC)), (180, 180));
        assert_eq!((settings.size_bytes(Direction::CToM), settings.data_bytes(Direction::CToM)), (183, 180));
        assert_eq!(settings.assignment(Direction::CToM), [0x1A00, 0x1A01, 0x1BFE].map(ObjectIndex));
    }

    #[test]
    fn following_a_mapping_allocates_nothing() {
        let mapping = Mapping::factory(&object_table());
        let mut settings = PdoSettings::of_mapping(&mapping);
        let rooms = |settings: &PdoSettings| {
            let entries = settings.mappings.iter().map(|(_, entries)| entries.as_ptr()).collect::<Vec<_>>();
            (settings.rx.as_ptr(), settings.tx.as_ptr(), entries)
        };
        let before = rooms(&settings);
        settings.follow(&mapping);
        assert_eq!(rooms(&settings), before);
        assert!(settings.mappings.iter().all(|(_, entries)| entries.capacity() >= MAX_ENTRIES));
    }

    #[test]
    fn an_entry_has_the_length_of_its_object() {
        let at = |index, sub| PdoEntry::at(EntryAddress { index: ObjectIndex(index), sub: SubIndex(sub) });
        assert_eq!(at(0x7000, 0x29).bit_length, 240, "beyond the highest subindex");
        assert_eq!((at(0x6003, 1).bit_length, at(0x5555, 1).bit_length), (1, 0));
        assert!(at(0, 0).is_empty() && !at(0x5555, 1).is_empty());
    }
}
