//! I/O entries that are in no PDO: a master accesses them by SDO, the CPU Unit as usual (manual, A-6-9).
//!
//! The dictionary stores their values. A value that a master writes to 7000:07 is I/O entry 6000:07 on the NX
//! bus, and a value that the CPU Unit writes to 7000:07 there is what a master reads from 6000:07.

use core::ops::Range;

use coe_kit::pdo::PdoObjects;
use objects::Dictionary;
use wire::{ObjectIndex, SubIndex};

use crate::allocation::ImageLayout;
use crate::data_sets::{DataSet, Direction};

/// Maximum number of entries of one direction: 40, 10 and 32.
const MAX_ENTRIES: usize = 82;

/// The entries that the CPU Unit has allocated and that are not in an assigned PDO.
#[derive(Debug)]
pub(super) struct UnmappedEntries {
    m_to_c: Vec<UnmappedEntry>,
    c_to_m: Vec<UnmappedEntry>,
}

#[derive(Debug)]
struct UnmappedEntry {
    /// The CoE object.
    index: ObjectIndex,
    sub: SubIndex,
    /// The position of the entry in the process image.
    bytes: Range<usize>,
}

impl UnmappedEntries {
    /// No entries, with room for all.
    pub(super) fn none() -> Self {
        Self { m_to_c: Vec::with_capacity(MAX_ENTRIES), c_to_m: Vec::with_capacity(MAX_ENTRIES) }
    }

    pub(super) fn clear(&mut self) {
        self.m_to_c.clear();
        self.c_to_m.clear();
    }

    /// Follows this mapping. Every I/O entry has its default again, as in the process images.
    pub(super) fn rebuild(
        &mut self,
        values: &mut Dictionary,
        mapping: &PdoObjects,
        layouts: [&ImageLayout; 2],
    ) {
        self.clear();
        for set in DataSet::all() {
            let [m_to_c, c_to_m] = layouts;
            let (entries, layout) = match set.direction {
                Direction::MToC => (&mut self.m_to_c, m_to_c),
                Direction::CToM => (&mut self.c_to_m, c_to_m),
            };
            for sub in (1..=set.max_count).map(SubIndex) {
                if let Some(value) = values.value_mut(set.pdo_entry, sub) {
                    value.fill(0);
                }
                let place = layout.place(set.direction, set.kind, sub.0);
                if let Some(bytes) = place.filter(|_| !mapping.is_mapped(set.pdo_entry, sub)) {
                    entries.push(UnmappedEntry { index: set.pdo_entry, sub, bytes });
                }
            }
        }
    }

    /// Copies the values that the master has written to the process image M to C.
    pub(super) fn give(&self, values: &Dictionary, image: &mut [u8]) {
        for UnmappedEntry { index, sub, bytes } in &self.m_to_c {
            if let (Some(from), Some(to)) = (values.value(*index, *sub), image.get_mut(bytes.clone())) {
                to.copy_from_slice(from);
            }
        }
    }

    /// Copies the values that the CPU Unit sends from the process image C to M; without an image, the defaults.
    pub(super) fn take(&self, values: &mut Dictionary, image: Option<&[u8]>) {
        for UnmappedEntry { index, sub, bytes } in &self.c_to_m {
            let Some(to) = values.value_mut(*index, *sub) else { continue };
            match image.and_then(|image| image.get(bytes.clone())) {
                Some(from) => to.copy_from_slice(from),
                None => to.fill(0),
            }
        }
    }
}
