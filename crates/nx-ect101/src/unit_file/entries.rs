//! Entries of data sets and PDO mappings, as the user wrote them.

use user_file::Located;
use wire::{EntryAddress, ObjectIndex, SubIndex};

use crate::allocation::{IoAllocation, IoEntry};
use crate::data_sets::{DataSet, DataSetKind, Direction};

/// The entries of a data set or PDO mapping.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Entries {
    /// Short form: subindexes 1 to this number, in order. It may exceed the number of existing entries.
    Count(u8),
    /// Long form: exactly these, in this order, correct or not.
    List(Vec<Located<EntryAddress>>),
}

impl Entries {
    /// All entries in order; those of the short form are entries of `index`.
    #[must_use]
    pub fn addresses(&self, index: ObjectIndex) -> Vec<EntryAddress> {
        match self {
            Self::Count(count) => {
                (1..=*count).map(|sub| EntryAddress { index, sub: SubIndex(sub) }).collect()
            }
            Self::List(list) => list.iter().map(|entry| entry.value).collect(),
        }
    }
}

/// A selected data set of the I/O allocation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DataSetEntries {
    /// The data set.
    pub kind: DataSetKind,
    /// Its entries.
    pub entries: Located<Entries>,
}

/// Section `[io_allocation]`. A data set that is left out is not selected.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct IoAllocationSection {
    /// Selected data sets from the master to the CPU Unit.
    pub m_to_c: Vec<DataSetEntries>,
    /// Selected data sets from the CPU Unit to the master.
    pub c_to_m: Vec<DataSetEntries>,
}

impl IoAllocationSection {
    /// The allocation in the section, correct or not.
    pub(super) fn to_allocation(&self) -> IoAllocation {
        let mut allocation = IoAllocation::empty();
        for (direction, sets) in [(Direction::MToC, &self.m_to_c), (Direction::CToM, &self.c_to_m)] {
            for set in sets {
                let addresses = set.entries.value.addresses(DataSet::of(direction, set.kind).nx_entry);
                let entries = addresses.into_iter().map(|EntryAddress { index, sub }| IoEntry { index, sub });
                allocation.allocate(direction, set.kind, entries.collect());
            }
        }
        allocation
    }
}

/// The entries of one PDO mapping object.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MappingEntries {
    /// Index of the mapping object: 0x1601 to 0x1603 or 0x1A01 to 0x1A03.
    pub pdo: Located<ObjectIndex>,
    /// Its entries, by their CoE addresses.
    pub entries: Located<Entries>,
}

/// Section `[pdo]`: the settings of the master. Values that are left out are those of the factory setting.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PdoSection {
    /// RxPDO assignment, 1C12.
    pub assign_rx: Option<Located<Vec<Located<ObjectIndex>>>>,
    /// TxPDO assignment, 1C13.
    pub assign_tx: Option<Located<Vec<Located<ObjectIndex>>>>,
    /// PDO mappings, in the order of their indexes.
    pub mappings: Vec<MappingEntries>,
}
