//! PDO mapping and PDO assignment: 1601–1603, 1A00–1A03, 1BFE, 1BFF, 1C12, 1C13, as masters write them.
//!
//! A master clears subindex 0, writes the elements, sets subindex 0; complete access is received here as the
//! same sequence. Every element that exists and can be mapped is accepted here, in either direction: the
//! consistency of the settings is checked at PRE-OP to SAFE-OP, according to the manual's events.

use objects::{AccessRights, Object, ObjectTable};
use wire::{DataType, ObjectIndex, SdoAbort, SubIndex};

use crate::data_sets::{Assignment, Direction};

/// The entry in an element of a PDO mapping object (manual, A-6-5).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct MappedEntry(u32);

impl MappedEntry {
    /// Bits 31 to 16; 0 for padding and for an element without an entry.
    pub(crate) const fn index(self) -> ObjectIndex {
        ObjectIndex((self.0 >> 16) as u16)
    }

    /// Bits 15 to 8.
    pub(crate) const fn sub(self) -> SubIndex {
        SubIndex((self.0 >> 8) as u8)
    }

    /// Bits 7 to 0.
    pub(crate) const fn bit_length(self) -> usize {
        (self.0 & 0xFF) as usize
    }
}

/// All mapping and assignment objects of one unit with their present values.
#[derive(Clone, Debug)]
pub(crate) struct Mapping {
    lists: Vec<List>,
}

/// One object: a count at subindex 0 and its elements, including those beyond the count.
#[derive(Clone, Debug)]
struct List {
    index: ObjectIndex,
    content: Content,
    count: u8,
    elements: Vec<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Content {
    /// Elements are mapped entries, 32 bits.
    Entries,
    /// Elements are PDO mapping objects, 16 bits.
    Pdos,
}

impl Mapping {
    /// The factory setting: the defaults of the table.
    pub(crate) fn factory(table: &ObjectTable) -> Self {
        Self { lists: table.iter().filter_map(List::of_object).collect() }
    }

    /// Sets every object to its default.
    pub(crate) fn restore_defaults(&mut self, table: &ObjectTable) {
        for list in &mut self.lists {
            if let Some(object) = table.object(list.index) {
                list.restore_defaults(object);
            }
        }
    }

    /// Whether `index` is a mapping or assignment object.
    pub(crate) fn has(&self, index: ObjectIndex) -> bool {
        self.list(index).is_some()
    }

    /// Copies the value of an entry into `value`.
    pub(crate) fn read(&self, index: ObjectIndex, sub: SubIndex, value: &mut [u8]) -> Result<(), SdoAbort> {
        let list = self.list(index).ok_or(SdoAbort::OBJECT_DOES_NOT_EXIST)?;
        let number = match sub.0.checked_sub(1) {
            None => u32::from(list.count),
            Some(at) => *list.elements.get(usize::from(at)).ok_or(SdoAbort::SUBINDEX_DOES_NOT_EXIST)?,
        };
        for (to, from) in value.iter_mut().zip(number.to_le_bytes()) {
            *to = from;
        }
        Ok(())
    }

    /// Stores a count or an element.
    pub(crate) fn write(
        &mut self,
        table: &ObjectTable,
        index: ObjectIndex,
        sub: SubIndex,
        value: &[u8],
    ) -> Result<(), SdoAbort> {
        let list = self.list_mut(index).ok_or(SdoAbort::OBJECT_DOES_NOT_EXIST)?;
        let number = little_endian(value);
        match sub.0.checked_sub(1) {
            None => list.set_count(number),
            Some(_) if list.count != 0 => Err(SdoAbort::SUBINDEX_ZERO_NOT_CLEARED),
            Some(at) => list.set_element(table, usize::from(at), number),
        }
    }

    /// The PDO mapping objects that are assigned in `direction`, in the order of their assignment.
    pub(crate) fn assigned(&self, direction: Direction) -> impl Iterator<Item = ObjectIndex> + '_ {
        let list = self.list(Assignment::of(direction).object);
        let elements = list.into_iter().flat_map(List::counted);
        elements.filter(|&element| element != 0).map(|element| ObjectIndex(element as u16))
    }

    /// The entries in the PDO mapping object `pdo`, in order, including padding.
    pub(crate) fn entries(&self, pdo: ObjectIndex) -> impl Iterator<Item = MappedEntry> + '_ {
        self.list(pdo).into_iter().flat_map(List::counted).map(MappedEntry)
    }

    /// Length in bytes of all assigned PDOs of `direction`, rounded up at the end.
    pub(crate) fn size_bytes(&self, direction: Direction) -> usize {
        let entries = self.assigned(direction).flat_map(|pdo| self.entries(pdo));
        entries.map(MappedEntry::bit_length).sum::<usize>().div_ceil(8)
    }

    /// Whether an assigned PDO contains this entry (subindex 0 is never contained).
    pub(crate) fn is_mapped(&self, index: ObjectIndex, sub: SubIndex) -> bool {
        Direction::ALL.into_iter().any(|direction| {
            let mut entries = self.assigned(direction).flat_map(|pdo| self.entries(pdo));
            entries.any(|entry| (entry.index(), entry.sub()) == (index, sub))
        })
    }

    fn list(&self, index: ObjectIndex) -> Option<&List> {
        self.lists.iter().find(|list| list.index == index)
    }

    fn list_mut(&mut self, index: ObjectIndex) -> Option<&mut List> {
        self.lists.iter_mut().find(|list| list.index == index)
    }
}

impl List {
    /// The list of a mapping or assignment object; none for every other object.
    fn of_object(object: &Object) -> Option<Self> {
        let is_assignment =
            Direction::ALL.into_iter().any(|direction| Assignment::of(direction).object == object.index);
        let content = match is_assignment {
            true => Content::Pdos,
            false if is_pdo(object) => Content::Entries,
            false => return None,
        };
        let elements = vec![0; object.entries.len().saturating_sub(1)];
        let mut list = Self { index: object.index, content, count: 0, elements };
        list.restore_defaults(object);
        Some(list)
    }

    fn restore_defaults(&mut self, object: &Object) {
        let mut numbers = object.entries.iter().map(|entry| little_endian(&entry.default));
        self.count = numbers.next().map_or(0, |count| count as u8);
        for (element, number) in self.elements.iter_mut().zip(numbers) {
            *element = number;
        }
    }

    fn counted(&self) -> impl Iterator<Item = u32> + '_ {
        self.elements.iter().copied().take(usize::from(self.count))
    }

    fn set_count(&mut self, count: u32) -> Result<(), SdoAbort> {
        let count = u8::try_from(count).map_err(|_| SdoAbort::PDO_LENGTH_EXCEEDED)?;
        if usize::from(count) > self.elements.len() {
            return Err(SdoAbort::PDO_LENGTH_EXCEEDED);
        }
        self.count = count;
        Ok(())
    }

    fn set_element(&mut self, table: &ObjectTable, at: usize, number: u32) -> Result<(), SdoAbort> {
        let element = self.elements.get_mut(at).ok_or(SdoAbort::PDO_LENGTH_EXCEEDED)?;
        let mappable = number == 0
            || match self.content {
                Content::Entries => entry_is_mappable(table, MappedEntry(number)),
                Content::Pdos => pdo_exists(table, number),
            };
        if !mappable {
            return Err(SdoAbort::NOT_MAPPABLE);
        }
        *element = number;
        Ok(())
    }
}

/// Any entry that can be in a PDO of either direction, with its correct length: the rules about entries and
/// their PDOs are checked at PRE-OP to SAFE-OP, otherwise their events could never occur.
fn entry_is_mappable(table: &ObjectTable, mapped: MappedEntry) -> bool {
    let entry = table.entry(mapped.index(), mapped.sub());
    entry.is_some_and(|entry| {
        entry.access.intersects(AccessRights::RX_PDO | AccessRights::TX_PDO)
            && usize::from(entry.bit_length) == mapped.bit_length()
    })
}

/// Any PDO that exists, for the same reason: a PDO of the other direction has its events too.
fn pdo_exists(table: &ObjectTable, number: u32) -> bool {
    let index = u16::try_from(number).ok().map(ObjectIndex);
    index.and_then(|index| table.object(index)).is_some_and(is_pdo)
}

/// Whether it is a PDO mapping object.
fn is_pdo(object: &Object) -> bool {
    object.data_type == DataType::PDO_MAPPING
}

/// A value of at most four bytes, little endian.
fn little_endian(value: &[u8]) -> u32 {
    value.iter().take(4).rev().fold(0, |number, &byte| number << 8 | u32::from(byte))
}

#[cfg(test)]
pub(crate) mod tests;
