//! The numbers of entries of the data sets on their two sides.

use coe_kit::pdo::PdoSettings;

use crate::allocation::IoAllocation;
use crate::data_sets::{DataSet, DataSetKind, Direction};
use crate::finding::{Amount, FindingPlace};
use crate::pdo_settings::assigned_entries;

impl Amount {
    /// Entries on exactly one side.
    pub(crate) const fn is_one_sided(&self) -> bool {
        (self.io_entries == 0) != (self.pdo_entries == 0)
    }

    /// More entries on one side than on the other.
    pub(crate) const fn is_unequal(&self) -> bool {
        self.io_entries != self.pdo_entries
    }
}

/// The amounts of the three data sets of `direction`.
pub(crate) fn of(io: &IoAllocation, pdo: &PdoSettings, direction: Direction) -> [Amount; 3] {
    DataSetKind::ALL.map(|kind| {
        let pdo_entries = assigned_entries(pdo, DataSet::of(direction, kind)).iter();
        Amount {
            io_entries: io.entries(direction, kind).len(),
            pdo_entries: pdo_entries.filter(|entry| !entry.is_empty()).count(),
        }
    })
}

/// The only data set whose amounts differ, or the direction if there are several.
pub(crate) fn different(direction: Direction, amounts: &[Amount; 3]) -> FindingPlace {
    let mut sets = DataSetKind::ALL.into_iter().zip(amounts).filter(|(_, amount)| amount.is_unequal());
    match (sets.next(), sets.next()) {
        (Some((kind, _)), None) => FindingPlace::DataSet(DataSet::of(direction, kind)),
        _ => FindingPlace::Direction(direction),
    }
}
