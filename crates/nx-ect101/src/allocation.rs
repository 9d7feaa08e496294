//! The I/O allocation: the entries that the CPU Unit exchanges with the unit, and their positions (manual, 6-3).

use core::ops::Range;

use wire::{ObjectIndex, SubIndex};

use crate::data_sets::{DataSet, DataSetKind, Direction};

/// Length of the EtherCAT Slave Status, NX object 6003:01, in bytes. It is always allocated (manual, 6-3-2).
pub const SLAVE_STATUS_BYTES: usize = 2;

/// One I/O entry that the CPU Unit has allocated, correct or not: an entry of another data set keeps its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct IoEntry {
    /// NX object.
    pub index: ObjectIndex,
    /// Subindex in it.
    pub sub: SubIndex,
}

impl IoEntry {
    /// Length in bytes; 0 if it is not an NX object that accepts I/O allocations.
    #[must_use]
    pub fn size_bytes(self) -> usize {
        let set = DataSet::all().iter().find(|set| set.nx_entry == self.index);
        set.map_or(0, |set| usize::from(set.entry_bytes))
    }
}

/// The I/O entries of one unit by data set. A data set without entries is not selected.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct IoAllocation {
    m_to_c: [Vec<IoEntry>; 3],
    c_to_m: [Vec<IoEntry>; 3],
}

impl IoAllocation {
    /// No data set is selected.
    #[must_use]
    pub const fn empty() -> Self {
        Self { m_to_c: [const { Vec::new() }; 3], c_to_m: [const { Vec::new() }; 3] }
    }

    /// The factory setting (manual, 6-3-1).
    #[must_use]
    pub fn factory() -> Self {
        let mut allocation = Self::empty();
        for set in DataSet::all().iter().filter(|set| set.default_selected) {
            allocation.select(set.direction, set.kind, set.default_count);
        }
        allocation
    }

    /// Selects a data set with its entries 1 to `count`, in order.
    pub fn select(&mut self, direction: Direction, kind: DataSetKind, count: u8) {
        let index = DataSet::of(direction, kind).nx_entry;
        let entries = (1..=count).map(|sub| IoEntry { index, sub: SubIndex(sub) }).collect();
        self.allocate(direction, kind, entries);
    }

    /// Gives a data set exactly these entries.
    pub fn allocate(&mut self, direction: Direction, kind: DataSetKind, entries: Vec<IoEntry>) {
        let sets = match direction {
            Direction::MToC => &mut self.m_to_c,
            Direction::CToM => &mut self.c_to_m,
        };
        sets[kind as usize] = entries;
    }

    /// The entries of a data set, in the order of their allocation.
    #[must_use]
    pub fn entries(&self, direction: Direction, kind: DataSetKind) -> &[IoEntry] {
        let sets = match direction {
            Direction::MToC => &self.m_to_c,
            Direction::CToM => &self.c_to_m,
        };
        &sets[kind as usize]
    }

    /// Length of all entries of `direction` in bytes.
    #[must_use]
    pub fn data_bytes(&self, direction: Direction) -> usize {
        let entries = DataSetKind::ALL.into_iter().flat_map(|kind| self.entries(direction, kind));
        entries.map(|entry| entry.size_bytes()).sum()
    }

    /// The position of each entry in the process image of `direction`.
    #[must_use]
    pub fn layout(&self, direction: Direction) -> ImageLayout {
        ImageLayout::of(DataSetKind::ALL.map(|kind| self.entries(direction, kind)))
    }

    /// The total size of the I/O data between CPU Unit and unit in bytes: both directions and the EtherCAT
    /// Slave Status. It determines T_slave (manual, 7-9-1).
    #[must_use]
    pub fn total_bytes(&self) -> usize {
        self.layout(Direction::MToC).size_bytes()
            + self.layout(Direction::CToM).size_bytes()
            + SLAVE_STATUS_BYTES
    }
}

/// The positions of the entries of one direction in a process image: data set by data set, in the order of
/// their allocation, without gaps.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ImageLayout {
    places: Vec<Place>,
    size_bytes: usize,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Place {
    kind: DataSetKind,
    entry: IoEntry,
    bytes: Range<usize>,
}

impl ImageLayout {
    fn of(sets: [&[IoEntry]; 3]) -> Self {
        let mut layout = Self::default();
        for (kind, entries) in DataSetKind::ALL.into_iter().zip(sets) {
            for &entry in entries {
                let start = layout.size_bytes;
                layout.size_bytes = start + entry.size_bytes();
                layout.places.push(Place { kind, entry, bytes: start..layout.size_bytes });
            }
        }
        layout
    }

    /// Length of the image in bytes.
    #[must_use]
    pub const fn size_bytes(&self) -> usize {
        self.size_bytes
    }

    /// The position of entry `number` (its subindex) of the data set of `kind`; none if it is not allocated there.
    #[must_use]
    pub fn place(&self, direction: Direction, kind: DataSetKind, number: u8) -> Option<Range<usize>> {
        let wanted = IoEntry { index: DataSet::of(direction, kind).nx_entry, sub: SubIndex(number) };
        let found = self.places.iter().find(|place| place.kind == kind && place.entry == wanted);
        found.map(|place| place.bytes.clone())
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// An allocation of this number of 15 UINT, 10 BYTE and UDINT entries, the same in both directions.
    pub(crate) fn symmetric(counts: [u8; 3]) -> IoAllocation {
        let mut allocation = IoAllocation::empty();
        for (kind, count) in DataSetKind::ALL.into_iter().zip(counts) {
            allocation.select(Direction::MToC, kind, count);
            allocation.select(Direction::CToM, kind, count);
        }
        allocation
    }

    #[test]
    fn the_manuals_examples_have_the_manuals_sizes() {
        assert_eq!(IoAllocation::factory(), symmetric([6, 0, 0]));
        let examples =
            [([6, 0, 0], 180), ([40, 0, 0], 1200), ([10, 10, 30], 520), ([20, 0, 32], 728), ([6, 0, 4], 196)];
        for (counts, size_bytes) in examples {
            let allocation = symmetric(counts);
            assert_eq!(allocation.layout(Direction::MToC).size_bytes(), size_bytes);
            assert_eq!(allocation.total_bytes(), 2 * size_bytes + 2);
        }
    }

    #[test]
    fn entries_lie_one_after_the_other() {
        let layout = symmetric([2, 1, 1]).layout(Direction::CToM);
        let place = |kind, sub| layout.place(Direction::CToM, kind, sub);
        assert_eq!(place(DataSetKind::Uints, 2), Some(30..60));
        assert_eq!(place(DataSetKind::Bytes, 1), Some(60..70));
        assert_eq!(place(DataSetKind::Udint, 1), Some(70..74));
        assert_eq!(place(DataSetKind::Udint, 2), None);
    }

    #[test]
    fn an_entry_of_another_data_set_takes_room_and_is_not_found() {
        let mut allocation = IoAllocation::empty();
        let stray = IoEntry { index: ObjectIndex(0x6001), sub: SubIndex(1) };
        allocation.allocate(Direction::MToC, DataSetKind::Uints, vec![stray]);
        let layout = allocation.layout(Direction::MToC);
        assert_eq!(layout.size_bytes(), 10);
        assert_eq!(layout.place(Direction::MToC, DataSetKind::Bytes, 1), None);
    }
}
