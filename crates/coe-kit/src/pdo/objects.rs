//! The mapping and assignment objects of one unit, as masters read and write them.
//!
//! A master clears subindex 0, writes the elements, sets subindex 0; complete access comes here as the same
//! sequence. Every element that exists and can be mapped is accepted, also one of the other direction: the model checks
//! at PRE-OP to SAFE-OP whether the settings fit together.

use objects::{AccessRights, Object, ObjectTable};
use wire::{DataType, ObjectIndex, SdoAbort, SubIndex};

use super::PdoEntry;
use super::assignment::is_assignment_object;

/// All mapping and assignment objects of one unit with their present values.
#[derive(Clone, Debug)]
pub struct PdoObjects {
    lists: Vec<List>,
}

/// One object: a count at subindex 0 and its elements, also those beyond the count.
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

impl PdoObjects {
    /// The mapping and assignment objects of a table, with their defaults.
    #[must_use]
    pub fn of_table(table: &ObjectTable) -> Self {
        Self { lists: table.iter().filter_map(List::of_object).collect() }
    }

    /// Gives every object its default again.
    pub fn restore_defaults(&mut self, table: &ObjectTable) {
        for list in &mut self.lists {
            if let Some(object) = table.object(list.index) {
                list.restore_defaults(object);
            }
        }
    }

    /// Whether `index` is a mapping or assignment object.
    #[must_use]
    pub fn has(&self, index: ObjectIndex) -> bool {
        self.list(index).is_some()
    }

    /// Copies the value of an entry into `value`.
    ///
    /// # Errors
    /// The abort code, if there is no such object or no such subindex.
    pub fn read(&self, index: ObjectIndex, sub: SubIndex, value: &mut [u8]) -> Result<(), SdoAbort> {
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

    /// Accepts a count or an element.
    ///
    /// # Errors
    /// The abort code: more elements than there is room for, subindex 0 is not cleared, or what cannot be mapped.
    pub fn write(
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

    /// The PDO mapping objects that `assignment` lists, in the order of their assignment.
    pub fn assigned(&self, assignment: ObjectIndex) -> impl Iterator<Item = ObjectIndex> + '_ {
        let list = self.list(assignment).filter(|list| list.content == Content::Pdos);
        list.into_iter().flat_map(List::pdos)
    }

    /// The entries that the PDO mapping object `pdo` maps, in order, padding included.
    pub fn entries(&self, pdo: ObjectIndex) -> impl Iterator<Item = PdoEntry> + '_ {
        self.list(pdo).into_iter().flat_map(List::counted).map(PdoEntry::of_element)
    }

    /// Length in bytes of all PDOs that `assignment` lists, rounded up at the end.
    #[must_use]
    pub fn size_bytes(&self, assignment: ObjectIndex) -> usize {
        let entries = self.assigned(assignment).flat_map(|pdo| self.entries(pdo));
        entries.map(|entry| usize::from(entry.bit_length)).sum::<usize>().div_ceil(8)
    }

    /// Whether an assigned PDO maps this entry (subindex 0 never is).
    #[must_use]
    pub fn is_mapped(&self, index: ObjectIndex, sub: SubIndex) -> bool {
        let assignments = self.lists.iter().filter(|list| list.content == Content::Pdos);
        let mut entries = assignments.flat_map(List::pdos).flat_map(|pdo| self.entries(pdo));
        entries.any(|entry| (entry.index, entry.sub) == (index, sub))
    }

    /// Every assignment object with the number of elements that it has room for.
    pub(super) fn assignments(&self) -> impl Iterator<Item = (ObjectIndex, usize)> + '_ {
        self.of(Content::Pdos)
    }

    /// Every PDO mapping object with the number of elements that it has room for.
    pub(super) fn mappings(&self) -> impl Iterator<Item = (ObjectIndex, usize)> + '_ {
        self.of(Content::Entries)
    }

    /// The counted elements of an assignment object, those without a PDO included.
    pub(super) fn elements(&self, assignment: ObjectIndex) -> impl Iterator<Item = ObjectIndex> + '_ {
        let elements = self.list(assignment).into_iter().flat_map(List::counted);
        elements.map(|element| ObjectIndex(element as u16))
    }

    fn of(&self, content: Content) -> impl Iterator<Item = (ObjectIndex, usize)> + '_ {
        let lists = self.lists.iter().filter(move |list| list.content == content);
        lists.map(|list| (list.index, list.elements.len()))
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
        let room = object.entries.len().saturating_sub(1);
        let content = match object {
            _ if is_pdo(object) => Content::Entries,
            _ if is_assignment_object(object.index) && room > 0 => Content::Pdos,
            _ => return None,
        };
        let mut list = Self { index: object.index, content, count: 0, elements: vec![0; room] };
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

    /// The PDOs of an assignment object; an element of 0 is none.
    fn pdos(&self) -> impl Iterator<Item = ObjectIndex> + '_ {
        self.counted().filter(|&element| element != 0).map(|element| ObjectIndex(element as u16))
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
                Content::Entries => entry_is_mappable(table, PdoEntry::of_element(number)),
                Content::Pdos => pdo_exists(table, number),
            };
        if !mappable {
            return Err(SdoAbort::NOT_MAPPABLE);
        }
        *element = number;
        Ok(())
    }
}

/// Any entry that a PDO of either direction can carry, with its own length.
fn entry_is_mappable(table: &ObjectTable, mapped: PdoEntry) -> bool {
    table.entry(mapped.index, mapped.sub).is_some_and(|entry| {
        entry.access.intersects(AccessRights::RX_PDO | AccessRights::TX_PDO)
            && entry.bit_length == mapped.bit_length
    })
}

/// Any PDO that exists, of either direction.
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
