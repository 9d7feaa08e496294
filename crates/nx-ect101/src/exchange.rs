//! The exchange plan: which bytes of the SyncManagers and of the process images correspond.
//!
//! The plan is made when the mapping is fixed, at PRE-OP to SAFE-OP, so that a refresh only copies. An entry is
//! included if it exists on both sides: the PDO mapping object of a data set maps subindex k, and the CPU Unit
//! has allocated I/O entry k of the same data set (manual, 5-2 and 5-3-5).

use core::ops::Range;

use wire::ObjectIndex;

use crate::allocation::ImageLayout;
use crate::data_sets::{DataSet, Direction};
use crate::pdo_settings::{PdoEntry, PdoSettings};
use crate::status::NxUnitStatus;

/// Maximum number of entries of one direction: six assigned PDOs of 40 entries.
const MAX_ENTRIES: usize = 240;

/// The copies of both directions and the status fields among the inputs.
#[derive(Debug)]
pub struct ExchangePlan {
    /// Outputs to process image M to C.
    pub(crate) m_to_c: Vec<ByteCopy>,
    /// Process image C to M to inputs.
    pub(crate) c_to_m: Vec<ByteCopy>,
    /// Status among the inputs.
    pub(crate) status: Vec<StatusField>,
}

/// A run of bytes that is copied from one image to the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ByteCopy {
    /// Its start in the source image.
    pub from: usize,
    /// Its start in the target image.
    pub to: usize,
    /// Its length.
    pub length_bytes: usize,
}

/// The position of a status in the inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct StatusField {
    source: StatusSource,
    bit_offset: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum StatusSource {
    /// 6003 at this subindex.
    NxUnitStatus(u8),
    /// 10F3:04.
    NewMessages,
    /// 2002:01.
    SysmacError,
}

/// The status of the unit for the master, in the inputs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct StatusToMaster {
    /// 6003.
    pub(crate) nx_unit: NxUnitStatus,
    /// 10F3:04, New Messages Available.
    pub(crate) new_messages: bool,
    /// 2002:01, Sysmac Error Status.
    pub(crate) sysmac_error: u8,
}

impl ExchangePlan {
    /// A plan that exchanges nothing, with room for the largest one.
    pub(crate) fn empty() -> Self {
        Self {
            m_to_c: Vec::with_capacity(MAX_ENTRIES),
            c_to_m: Vec::with_capacity(MAX_ENTRIES),
            status: Vec::with_capacity(MAX_ENTRIES),
        }
    }

    /// The copies of `direction`: outputs to process image M to C, or process image C to M to inputs.
    #[must_use]
    pub fn copies(&self, direction: Direction) -> &[ByteCopy] {
        match direction {
            Direction::MToC => &self.m_to_c,
            Direction::CToM => &self.c_to_m,
        }
    }

    /// Executes the copies of `direction`. A copy outside either image is skipped.
    pub fn apply(&self, direction: Direction, from: &[u8], to: &mut [u8]) {
        copy(self.copies(direction), from, to);
    }

    /// Discards the old plan and makes the one for these settings.
    pub(crate) fn rebuild(&mut self, pdo: &PdoSettings, m_to_c: &ImageLayout, c_to_m: &ImageLayout) {
        self.m_to_c.clear();
        self.c_to_m.clear();
        self.status.clear();
        for (pdo, entry, bits) in mapped_entries(pdo, Direction::MToC) {
            if let Some((mapped, place)) = pair(pdo, entry, &bits, m_to_c) {
                push(&mut self.m_to_c, mapped, place);
            }
        }
        for (pdo, entry, bits) in mapped_entries(pdo, Direction::CToM) {
            if let Some(source) = StatusSource::of(entry) {
                self.status.push(StatusField { source, bit_offset: bits.start });
            } else if let Some((mapped, place)) = pair(pdo, entry, &bits, c_to_m) {
                push(&mut self.c_to_m, place, mapped);
            }
        }
    }
}

impl StatusSource {
    fn of(entry: PdoEntry) -> Option<Self> {
        match (entry.index.0, entry.sub.0) {
            (0x6003, sub) => Some(Self::NxUnitStatus(sub)),
            (0x10F3, 0x04) => Some(Self::NewMessages),
            (0x2002, 0x01) => Some(Self::SysmacError),
            _ => None,
        }
    }

    const fn value(self, status: StatusToMaster) -> (u8, usize) {
        match self {
            Self::NxUnitStatus(sub) => (status.nx_unit.bit(sub) as u8, 1),
            Self::NewMessages => (status.new_messages as u8, 1),
            Self::SysmacError => (status.sysmac_error, 8),
        }
    }
}

/// Every mapped entry of `direction` with its PDO and its bits in the SyncManager.
fn mapped_entries(
    settings: &PdoSettings,
    direction: Direction,
) -> impl Iterator<Item = (ObjectIndex, PdoEntry, Range<usize>)> + '_ {
    let entries = settings
        .assigned(direction)
        .flat_map(|pdo| settings.entries(pdo).iter().map(move |&entry| (pdo, entry)));
    entries.scan(0, |offset, (pdo, entry)| {
        let start = *offset;
        *offset += usize::from(entry.bit_length);
        Some((pdo, entry, start..*offset))
    })
}

/// The bytes of an entry in the SyncManager and in the process image; none if it does not exist on one side, if
/// the PDO does not belong to its data set, or if additional bits before it have moved it off a byte boundary.
fn pair(
    pdo: ObjectIndex,
    entry: PdoEntry,
    bits: &Range<usize>,
    layout: &ImageLayout,
) -> Option<(Range<usize>, Range<usize>)> {
    let set = DataSet::of_pdo(pdo).filter(|set| set.pdo_entry == entry.index)?;
    let place = layout.place(set.direction, set.kind, entry.sub.0)?;
    let mapped = bits.start / 8..bits.end / 8;
    (bits.start.is_multiple_of(8) && mapped.len() == place.len()).then_some((mapped, place))
}

/// Adds a copy, merged with the last one if both continue it.
fn push(copies: &mut Vec<ByteCopy>, from: Range<usize>, to: Range<usize>) {
    let length_bytes = from.len();
    match copies.last_mut() {
        Some(last)
            if last.from + last.length_bytes == from.start && last.to + last.length_bytes == to.start =>
        {
            last.length_bytes += length_bytes;
        }
        _ => copies.push(ByteCopy { from: from.start, to: to.start, length_bytes }),
    }
}

/// Executes the copies. A copy outside either image is skipped.
pub(crate) fn copy(copies: &[ByteCopy], from: &[u8], to: &mut [u8]) {
    for copy in copies {
        let source = from.get(copy.from..copy.from + copy.length_bytes);
        let target = to.get_mut(copy.to..copy.to + copy.length_bytes);
        if let (Some(source), Some(target)) = (source, target) {
            target.copy_from_slice(source);
        }
    }
}

/// Adds the status to inputs whose status bits are zero.
pub(crate) fn put_status(fields: &[StatusField], status: StatusToMaster, inputs: &mut [u8]) {
    for field in fields {
        let (value, bit_length) = field.source.value(status);
        for bit in 0..bit_length {
            let at = field.bit_offset + bit;
            if let Some(byte) = inputs.get_mut(at / 8) {
                *byte |= (value >> bit & 1) << (at % 8);
            }
        }
    }
}

#[cfg(test)]
mod tests;
