//! The places in a unit file that cause a finding.

use unit_model::FilePlace;
use wire::ObjectIndex;

use crate::data_sets::{DataSet, DataSetKind, Direction};
use crate::finding::{Amount, Fact, Finding};
use crate::rule_kind::Side;
use crate::unit_file::{Entries, Located, UnitFile};

/// The places of a finding; none if the file leaves all of them at the factory setting.
pub(super) fn of(file: &UnitFile, finding: &Finding) -> Vec<FilePlace> {
    let direction = finding.direction;
    match finding.fact {
        Fact::UnitStatusNotAssigned => whole_assignment(file, direction, "0x1A00 is missing"),
        Fact::NotAssignable { place, .. } => assigned(file, direction, place, "not one of its PDOs"),
        Fact::NotAscending { place, after, .. } => {
            assigned(file, direction, place, &format!("must be before {after}"))
        }
        Fact::TxPdosTooLong { .. } => whole_assignment(file, direction, "too long together"),
        Fact::BeyondMaximum { place, maximum, .. } => {
            entry(file, finding, place, &format!("{maximum} entries at most"))
        }
        Fact::IllegalEntry { place, wanted, .. } => {
            entry(file, finding, place, &format!("not an entry of {wanted} that exists"))
        }
        Fact::NotNext { place, wanted, .. } => {
            entry(file, finding, place, &format!("expected subindex {wanted}"))
        }
        Fact::TooMuchData { .. } => sizes(file, finding),
        Fact::OneSided { amounts } | Fact::Unequal { amounts } => differences(file, direction, &amounts),
    }
}

fn located<T>(at: &Located<T>, label: String) -> Option<FilePlace> {
    at.span.clone().map(|span| FilePlace { span, label })
}

fn assignment(file: &UnitFile, direction: Direction) -> Option<&Located<Vec<Located<ObjectIndex>>>> {
    let pdo = &file.pdo.as_ref()?.value;
    match direction {
        Direction::MToC => pdo.assign_rx.as_ref(),
        Direction::CToM => pdo.assign_tx.as_ref(),
    }
}

fn whole_assignment(file: &UnitFile, direction: Direction, label: &str) -> Vec<FilePlace> {
    let list = assignment(file, direction);
    list.and_then(|list| located(list, label.to_owned())).into_iter().collect()
}

fn assigned(file: &UnitFile, direction: Direction, place: usize, label: &str) -> Vec<FilePlace> {
    let element = assignment(file, direction).and_then(|list| list.value.get(place));
    element.and_then(|element| located(element, label.to_owned())).into_iter().collect()
}

/// The entries of a data set on one side, as in the file.
fn entries<'f>(file: &'f UnitFile, side: Side, set: &DataSet) -> Option<&'f Located<Entries>> {
    if side != Side::IoEntry {
        let mappings = &file.pdo.as_ref()?.value.mappings;
        return mappings.iter().find(|mapping| mapping.pdo.value == set.pdo).map(|mapping| &mapping.entries);
    }
    let section = &file.io_allocation.as_ref()?.value;
    let sets = match set.direction {
        Direction::MToC => &section.m_to_c,
        Direction::CToM => &section.c_to_m,
    };
    sets.iter().find(|entries| entries.kind == set.kind).map(|entries| &entries.entries)
}

/// The entry of the finding; the number of entries if the file has the short form.
fn entry(file: &UnitFile, finding: &Finding, place: usize, label: &str) -> Vec<FilePlace> {
    let set = finding.data_set();
    let Some(entries) = set.and_then(|set| entries(file, finding.side, set)) else { return Vec::new() };
    let element = match &entries.value {
        Entries::List(list) => list.get(place),
        Entries::Count(_) => None,
    };
    let place = match element {
        Some(element) => located(element, label.to_owned()),
        None => located(entries, label.to_owned()),
    };
    place.into_iter().collect()
}

/// All entries of the finding's direction and side with their numbers of bytes.
fn sizes(file: &UnitFile, finding: &Finding) -> Vec<FilePlace> {
    let sets = DataSet::all().iter().filter(|set| set.direction == finding.direction);
    let size = |set: &DataSet| {
        let entries = entries(file, finding.side, set)?;
        let count = entries.value.addresses(set.pdo_entry).len();
        let size_bytes = count * usize::from(set.entry_bytes);
        (count > 0).then(|| located(entries, format!("{size_bytes} bytes")))?
    };
    sets.filter_map(size).collect()
}

/// Both sides of the data sets that differ.
fn differences(file: &UnitFile, direction: Direction, amounts: &[Amount; 3]) -> Vec<FilePlace> {
    let mut places = Vec::new();
    let different = DataSetKind::ALL.into_iter().zip(amounts);
    for (kind, amount) in different.filter(|(_, amount)| amount.is_unequal()) {
        let set = DataSet::of(direction, kind);
        let sides = [(Side::IoEntry, amount.io_entries, "I/O"), (Side::PdoEntry, amount.pdo_entries, "PDO")];
        for (side, count, name) in sides {
            let label = format!("{count} {name} {}", if count == 1 { "entry" } else { "entries" });
            // Entries of a PDO that is not assigned do not cause the difference.
            let entries = entries(file, side, set).filter(|_| count > 0);
            places.extend(entries.and_then(|entries| located(entries, label)));
        }
    }
    if places.is_empty() {
        places = whole_assignment(file, direction, "these PDOs");
    }
    places
}
