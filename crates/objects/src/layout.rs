//! The positions of an object's entries in complete access (ETG.1000.6, complete access).
//!
//! Subindex 0 of an array or record takes 16 bits if the access begins there: the value and a byte 0. Entries
//! follow in the order of their subindexes; gaps take no space. Bit types follow each other bitwise; every
//! other entry begins at a whole byte.

use core::ops::Range;

use wire::SubIndex;

use crate::{AccessRights, Object, ObjectCode};

/// The position of one entry in the bytes of a complete access.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Slot {
    /// The entry's subindex.
    pub sub: SubIndex,
    /// Bits before it.
    pub bit_offset: usize,
    /// Its length in bits, without padding.
    pub bit_length: usize,
    /// Whether it follows its neighbour bitwise; if not, it has whole bytes.
    pub bit_packed: bool,
    /// Who may access it.
    pub access: AccessRights,
}

impl Slot {
    /// Length of the value in bytes, as in an SDO to the entry alone.
    #[must_use]
    pub const fn size_bytes(self) -> usize {
        self.bit_length.div_ceil(8)
    }

    /// Bit after the value.
    #[must_use]
    pub const fn bit_end(self) -> usize {
        self.bit_offset + if self.bit_packed { self.bit_length } else { self.size_bytes() * 8 }
    }

    /// Whether the whole value is within the first `length_bytes` bytes.
    #[must_use]
    pub const fn is_within(self, length_bytes: usize) -> bool {
        self.bit_end() <= length_bytes * 8
    }

    /// Copies the value from `octets` to `value`, whose length is [`Slot::size_bytes`].
    pub fn load(self, octets: &[u8], value: &mut [u8]) {
        value.fill(0);
        copy_bits(octets, self.bit_offset, value, 0, self.bit_end() - self.bit_offset);
    }

    /// Copies `value` to its position in `octets`.
    pub fn store(self, value: &[u8], octets: &mut [u8]) {
        copy_bits(value, 0, octets, self.bit_offset, self.bit_end() - self.bit_offset);
    }

    /// The bytes of the value, if it has whole bytes.
    pub(crate) fn whole_octets(self) -> Option<Range<usize>> {
        (!self.bit_packed).then(|| self.bit_offset / 8..self.bit_end() / 8)
    }
}

/// The position of an iteration over the slots of one object; it holds no borrow of the object.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cursor {
    entry: usize,
    bit: usize,
}

impl Cursor {
    pub(crate) fn new(object: &Object, first: SubIndex) -> Self {
        Self { entry: object.entries.partition_point(|entry| entry.sub < first), bit: 0 }
    }

    pub(crate) fn advance(&mut self, object: &Object) -> Option<Slot> {
        const COUNT_BITS: usize = 16;
        let entry = object.entries.get(self.entry)?;
        let bit_packed = entry.is_bit_packed();
        let slot = Slot {
            sub: entry.sub,
            bit_offset: if bit_packed { self.bit } else { self.bit.next_multiple_of(8) },
            bit_length: usize::from(entry.bit_length),
            bit_packed,
            access: entry.access,
        };
        let is_count = entry.sub == SubIndex::ZERO && object.code != ObjectCode::Variable;
        self.bit = if is_count { COUNT_BITS } else { slot.bit_end() };
        self.entry += 1;
        Some(slot)
    }
}

/// The slots of one object, in the order of the bytes.
#[derive(Clone, Copy, Debug)]
pub struct Layout<'a> {
    object: &'a Object,
    cursor: Cursor,
}

impl Object {
    /// The position of each entry in a complete access from `first` on (0 or 1).
    #[must_use]
    pub fn layout(&self, first: SubIndex) -> Layout<'_> {
        Layout { object: self, cursor: Cursor::new(self, first) }
    }
}

impl Layout<'_> {
    /// Bytes of the entries up to subindex `last`, the last bits rounded up.
    #[must_use]
    pub fn length_bytes_to(mut self, last: SubIndex) -> usize {
        let mut length_bits = 0;
        while let Some(slot) = self.next() {
            if slot.sub > last {
                break;
            }
            length_bits = self.cursor.bit;
        }
        length_bits.div_ceil(8)
    }

    /// Bytes of all entries.
    #[must_use]
    pub fn length_bytes(self) -> usize {
        self.length_bytes_to(SubIndex(u8::MAX))
    }
}

impl Iterator for Layout<'_> {
    type Item = Slot;

    fn next(&mut self) -> Option<Slot> {
        self.cursor.advance(self.object)
    }
}

/// Copies `bit_length` bits; bits outside either slice are skipped.
fn copy_bits(from: &[u8], from_bit: usize, to: &mut [u8], to_bit: usize, bit_length: usize) {
    for bit in 0..bit_length {
        let (source, target) = (from_bit + bit, to_bit + bit);
        let Some(&octet) = from.get(source / 8) else { return };
        let Some(slot) = to.get_mut(target / 8) else { return };
        let mask = 1 << (target % 8);
        *slot = if octet >> (source % 8) & 1 == 0 { *slot & !mask } else { *slot | mask };
    }
}
