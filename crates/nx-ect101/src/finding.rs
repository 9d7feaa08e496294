//! The findings of setting rules: the event, the place, and the fact with its numbers.

mod words;

use wire::{AlStatusCode, ObjectIndex, SubIndex};

use crate::data_sets::{DataSet, Direction};
use crate::events::{Event, EventCode, EventLevel};
use crate::rule_kind::{RuleEvents, RuleId, Side};
use crate::settings::EventLevels;
use crate::unit_file::EntryAddress;

/// A rule that is violated. Its message and its correction are made on request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The rule.
    pub rule: RuleId,
    /// The event that it raises.
    pub event: EventCode,
    /// The kind of settings.
    pub side: Side,
    /// The direction.
    pub direction: Direction,
    /// The data set, as the index in the event's attached information: on the master's side the PDO mapping
    /// object, on the CPU Unit's side the I/O entry mapping (manual, 8-3-4). None if it concerns no data set,
    /// or several at once.
    pub data_set: Option<ObjectIndex>,
    /// The violation.
    pub fact: Fact,
}

/// The violation. A `place` counts elements of a list as the user has set it, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fact {
    /// 1A00 is not assigned.
    UnitStatusNotAssigned,
    /// An element of the PDO assignment is not a PDO of this direction.
    NotAssignable {
        /// Its position in the assignment.
        place: usize,
        /// Its value.
        pdo: ObjectIndex,
    },
    /// A PDO maps an entry of its data set that does not exist, or more entries than there is room for.
    BeyondMaximum {
        /// The first such entry in the list.
        place: usize,
        /// Number of mapped entries.
        entries: usize,
        /// Maximum number of entries of the data set.
        maximum: u8,
    },
    /// The TxPDOs are too long although their data is not: because of the status.
    TxPdosTooLong {
        /// Their length.
        size_bytes: usize,
        /// The maximum.
        limit_bytes: u16,
    },
    /// A PDO is assigned after one with a higher index, or twice.
    NotAscending {
        /// Its position in the assignment.
        place: usize,
        /// Its value.
        pdo: ObjectIndex,
        /// The value before it.
        after: ObjectIndex,
    },
    /// An entry that does not belong to the data set.
    IllegalEntry {
        /// Its position in the list.
        place: usize,
        /// Its value.
        entry: EntryAddress,
        /// The expected value.
        wanted: ObjectIndex,
    },
    /// An entry whose subindex is not the next one.
    NotNext {
        /// Its position in the list.
        place: usize,
        /// Its value.
        entry: EntryAddress,
        /// The expected next subindex.
        wanted: SubIndex,
    },
    /// More data in one direction than the unit exchanges.
    TooMuchData {
        /// The total amount.
        size_bytes: usize,
    },
    /// A data set has entries only on one side.
    OneSided {
        /// Entries of the three data sets of the direction.
        amounts: [Amount; 3],
    },
    /// A data set has more entries on one side than on the other.
    Unequal {
        /// Entries of the three data sets of the direction.
        amounts: [Amount; 3],
    },
}

/// The settings that a finding concerns.
#[derive(Clone, Copy, Debug)]
pub(crate) enum FindingPlace {
    DataSet(&'static DataSet),
    Direction(Direction),
}

/// The numbers of entries of a data set on its two sides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Amount {
    /// Entries that the CPU Unit has allocated.
    pub io_entries: usize,
    /// Entries that the assigned PDO maps.
    pub pdo_entries: usize,
}

impl Finding {
    /// A finding of `rule` for a data set, or for a whole direction.
    pub(crate) fn new(rule: RuleId, events: &RuleEvents, place: FindingPlace, fact: Fact) -> Self {
        let (direction, data_set) = match place {
            FindingPlace::DataSet(set) => match events.side {
                Side::IoEntry => (set.direction, Some(set.io_mapping())),
                Side::PdoEntry | Side::Assignment => (set.direction, Some(set.pdo)),
            },
            FindingPlace::Direction(direction) => (direction, None),
        };
        Self { rule, event: events.of(direction), side: events.side, direction, data_set, fact }
    }

    /// The row of the event that it raises.
    pub(crate) fn event_row(&self) -> Option<&'static Event> {
        Event::find(self.event)
    }

    /// The event's name in the manual; empty for a code that is not in its table.
    #[must_use]
    pub fn event_name(&self) -> &'static str {
        self.event_row().map_or("", |event| event.name.as_str())
    }

    /// The level of its event, as the user has set it.
    #[must_use]
    pub fn level(&self, levels: EventLevels) -> EventLevel {
        self.event_row().map_or(EventLevel::MinorFault, |event| levels.of(event))
    }

    /// The AL status code for the master when it requests SAFE-OP; none if the unit accepts.
    #[must_use]
    pub fn al_status_code(&self) -> Option<AlStatusCode> {
        self.event_row()?.al_status_code
    }

    /// The data set; none if it concerns no data set, or several at once.
    #[must_use]
    pub fn data_set(&self) -> Option<&'static DataSet> {
        let index = self.data_set?;
        let number = |set: &DataSet| match self.side {
            Side::IoEntry => set.io_mapping(),
            Side::PdoEntry | Side::Assignment => set.pdo,
        };
        DataSet::all().iter().find(|set| set.direction == self.direction && number(set) == index)
    }
}
