//! An element of a PDO mapping object.

use objects::{ObjectCode, ObjectTable};
use wire::{EntryAddress, ObjectIndex, SubIndex};

/// One element of a PDO mapping object.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PdoEntry {
    /// The object that is mapped; 0 for padding and for an element that maps nothing.
    pub index: ObjectIndex,
    /// Subindex in it.
    pub sub: SubIndex,
    /// Length in the PDO, in bits.
    pub bit_length: u16,
}

impl PdoEntry {
    /// The entry of an element's value: index in bits 31 to 16, subindex in 15 to 8, length in 7 to 0.
    #[must_use]
    pub const fn of_element(element: u32) -> Self {
        let [bit_length, sub, low, high] = element.to_le_bytes();
        let index = ObjectIndex(u16::from_le_bytes([low, high]));
        Self { index, sub: SubIndex(sub), bit_length: bit_length as u16 }
    }

    /// The value of the element. A length beyond 255 bits has no place in it: its low byte is what remains.
    #[must_use]
    pub const fn element(self) -> u32 {
        let [low, high] = self.index.0.to_le_bytes();
        u32::from_le_bytes([self.bit_length.to_le_bytes()[0], self.sub.0, low, high])
    }

    /// The entry at `address` with the length that the table has for it. An element behind the last one of an array has
    /// the length of the last one; an entry that does not exist has 0 bits.
    #[must_use]
    pub fn of_table(table: &ObjectTable, address: EntryAddress) -> Self {
        let EntryAddress { index, sub } = address;
        let object = table.object(index);
        let last =
            object.filter(|object| object.code == ObjectCode::Array).and_then(|array| array.entries.last());
        let entry = object.and_then(|object| object.entry(sub)).or(last);
        Self { index, sub, bit_length: entry.map_or(0, |entry| entry.bit_length) }
    }

    /// Whether the element maps nothing at all.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.index.0 == 0 && self.bit_length == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_element_has_index_subindex_and_length() {
        let entry = PdoEntry { index: ObjectIndex(0x7000), sub: SubIndex(0x29), bit_length: 0xF0 };
        assert_eq!(PdoEntry::of_element(0x7000_29F0), entry);
        assert_eq!(entry.element(), 0x7000_29F0);
        assert!(
            PdoEntry::of_element(0).is_empty() && !PdoEntry::of_element(8).is_empty(),
            "padding is an entry"
        );
    }
}
