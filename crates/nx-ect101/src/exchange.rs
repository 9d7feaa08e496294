//! The exchange plan: which bytes of the SyncManagers and of the process images correspond.
//!
//! The plan is made when the mapping is fixed, at PRE-OP to SAFE-OP, so that a refresh only copies. An entry is
//! included if it exists on both sides: the PDO mapping object of a data set maps subindex k, and the CPU Unit
//! has allocated I/O entry k of the same data set (manual, 5-2 and 5-3-5).

use core::ops::Range;

use coe_kit::exchange::{BitField, CopyPlan};
use coe_kit::pdo::{PdoEntry, PdoSettings, PlacedEntry};

use crate::allocation::ImageLayout;
use crate::data_sets::{DataSet, Direction};
use crate::status::NxUnitStatus;

/// Maximum number of entries of one direction: six assigned PDOs of 40 entries.
const MAX_ENTRIES: usize = 240;

/// The copies of both directions and the status fields among the inputs.
#[derive(Debug)]
pub struct ExchangePlan {
    /// Outputs to process image M to C.
    m_to_c: CopyPlan,
    /// Process image C to M to inputs.
    c_to_m: CopyPlan,
    /// Status among the inputs.
    status: Vec<StatusField>,
}

/// Where a status is among the inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct StatusField {
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
            m_to_c: CopyPlan::with_room(MAX_ENTRIES),
            c_to_m: CopyPlan::with_room(MAX_ENTRIES),
            status: Vec::with_capacity(MAX_ENTRIES),
        }
    }

    /// The copies of `direction`: outputs to process image M to C, or process image C to M to inputs.
    #[must_use]
    pub const fn copies(&self, direction: Direction) -> &CopyPlan {
        match direction {
            Direction::MToC => &self.m_to_c,
            Direction::CToM => &self.c_to_m,
        }
    }

    /// Adds the status to inputs that are zero where it is.
    pub(crate) fn put_status(&self, status: StatusToMaster, inputs: &mut [u8]) {
        for StatusField { source, bit_offset } in &self.status {
            let (value, bit_length) = source.value(status);
            BitField { bit_offset: *bit_offset, bit_length }.put(value.into(), inputs);
        }
    }

    /// Discards the old plan and makes the one for these settings.
    pub(crate) fn rebuild(&mut self, pdo: &PdoSettings, m_to_c: &ImageLayout, c_to_m: &ImageLayout) {
        self.m_to_c.clear();
        self.c_to_m.clear();
        self.status.clear();
        for placed in pdo.placed(Direction::MToC.assignment()) {
            if let Some((mapped, place)) = pair(&placed, m_to_c) {
                self.m_to_c.add(mapped, place.start);
            }
        }
        for placed in pdo.placed(Direction::CToM.assignment()) {
            if let Some(source) = StatusSource::of(placed.entry) {
                self.status.push(StatusField { source, bit_offset: placed.bits.start });
            } else if let Some((mapped, place)) = pair(&placed, c_to_m) {
                self.c_to_m.add(place, mapped.start);
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

/// The bytes of an entry in the SyncManager and in the process image; none if one side does not have it, if
/// the PDO is not the one of its data set, or if stray bits before it have moved it off a byte boundary.
fn pair(placed: &PlacedEntry, layout: &ImageLayout) -> Option<(Range<usize>, Range<usize>)> {
    let PlacedEntry { pdo, entry, bits } = placed;
    let set = DataSet::of_pdo(*pdo).filter(|set| set.pdo_entry == entry.index)?;
    let place = layout.place(set.direction, set.kind, entry.sub.0)?;
    let mapped = bits.start / 8..bits.end / 8;
    (bits.start.is_multiple_of(8) && mapped.len() == place.len()).then_some((mapped, place))
}

#[cfg(test)]
mod tests;
