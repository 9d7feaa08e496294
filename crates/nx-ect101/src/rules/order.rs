//! Order of entry: subindexes ascend from 01 without a gap (manual, 5-3-4; forward feed means packed).
//!
//! Passes: 7000:01, 7000:02, 7000:03, 7000:04.
//! Fails:  7000:01, 7000:03, 7000:02, 7000:04; 7000:02, 7000:03, 7000:04; 7000:01, 7000:02, 7000:04.
//!
//! The rule `type` covers an entry of another data set: if the order would be correct with this entry removed,
//! or replaced by the missing entry, it counts as correct.

use coe_kit::pdo::PdoSettings;
use wire::{ObjectIndex, SubIndex};

use crate::allocation::IoAllocation;
use crate::data_sets::DataSet;
use crate::finding::{Fact, Finding, FindingPlace};
use crate::pdo_settings::assigned_entries;
use crate::rule::{Check, Rule};
use crate::rule_kind::{RuleEvents, RuleId, Side};
use crate::unit_file::EntryAddress;

/// Incorrect I/O Entry Order.
const IO: RuleEvents = RuleEvents::at_power_on(Side::IoEntry, 0x3919_0000, 0x3913_0000);
/// Incorrect PDO Entry Order.
const PDO: RuleEvents = RuleEvents::at_safe_op(Side::PdoEntry, 0x3914_0000, 0x3915_0000);

pub(super) const RULE: Rule = Rule {
    id: RuleId::Order,
    section: "5-3-4",
    text: "the entries of a mapping are in ascending order of their subindexes, from 01, without a gap",
    events: &[IO, PDO],
    checks: &[Check::Io(check_io), Check::Pdo(check_pdo)],
};

fn check_io(io: &IoAllocation, findings: &mut Vec<Finding>) {
    for set in DataSet::all() {
        let entries = io.entries(set.direction, set.kind).iter();
        let elements = entries.map(|entry| element(set, set.nx_entry, entry.index, entry.sub));
        let fact = not_next(set.nx_entry, elements);
        findings.extend(fact.map(|fact| Finding::new(RULE.id, &IO, FindingPlace::DataSet(set), fact)));
    }
}

fn check_pdo(pdo: &PdoSettings, findings: &mut Vec<Finding>) {
    for set in DataSet::all() {
        let entries = assigned_entries(pdo, set).iter();
        let elements = entries.map(|entry| match entry.is_empty() {
            true => Element::Empty,
            false => element(set, set.pdo_entry, entry.index, entry.sub),
        });
        let fact = not_next(set.pdo_entry, elements);
        findings.extend(fact.map(|fact| Finding::new(RULE.id, &PDO, FindingPlace::DataSet(set), fact)));
    }
}

/// An element of a mapping, as the rule of order treats it.
enum Element {
    /// An entry of the data set.
    Own(SubIndex),
    /// An entry of another data set.
    Stray,
    /// No entry: a gap, unless only such elements follow.
    Empty,
}

fn element(set: &DataSet, own: ObjectIndex, index: ObjectIndex, sub: SubIndex) -> Element {
    if index == own && set.has(sub) { Element::Own(sub) } else { Element::Stray }
}

/// The first entry that is not the next one.
fn not_next(index: ObjectIndex, elements: impl Iterator<Item = Element>) -> Option<Fact> {
    // The next subindex is one of `next..=next + strays`.
    let (mut next, mut strays, mut gap) = (1u8, 0u8, false);
    for (place, element) in elements.enumerate() {
        let sub = match element {
            Element::Empty => {
                gap = true;
                continue;
            }
            Element::Stray => {
                strays = strays.saturating_add(1);
                continue;
            }
            Element::Own(sub) => sub,
        };
        if gap || !(next..=next.saturating_add(strays)).contains(&sub.0) {
            let entry = EntryAddress { index, sub };
            return Some(Fact::NotNext { place, entry, wanted: SubIndex(next) });
        }
        (next, strays) = (sub.0.saturating_add(1), 0);
    }
    None
}
