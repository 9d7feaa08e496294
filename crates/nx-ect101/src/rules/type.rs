//! Type of entry: a mapping contains only entries of its own data set (manual, 5-3-3).
//!
//! Passes: 7000:01 for 15 UINT arrays from the CPU Unit to the master, on the CPU Unit's side.
//! Fails:  7001:01 there; 7000:29 there, which does not exist. On the master's side the rule `mandatory` reports
//! entries that do not exist.

use coe_kit::pdo::PdoSettings;

use crate::allocation::IoAllocation;
use crate::data_sets::DataSet;
use crate::finding::{Fact, Finding, FindingPlace};
use crate::pdo_settings::assigned_entries;
use crate::rule::{Check, Rule};
use crate::rule_kind::{RuleEvents, RuleId, Side};
use crate::unit_file::EntryAddress;

/// Illegal I/O Entry Added.
const IO: RuleEvents = RuleEvents::at_power_on(Side::IoEntry, 0x391B_0000, 0x391A_0000);
/// Illegal PDO Entry Added.
const PDO: RuleEvents = RuleEvents::at_safe_op(Side::PdoEntry, 0x391E_0000, 0x391F_0000);

pub(super) const RULE: Rule = Rule {
    id: RuleId::Type,
    section: "5-3-3",
    text: "a mapping has only entries of its own data set",
    events: &[IO, PDO],
    checks: &[Check::Io(check_io), Check::Pdo(check_pdo)],
};

fn check_io(io: &IoAllocation, findings: &mut Vec<Finding>) {
    for set in DataSet::all() {
        let mut entries = io.entries(set.direction, set.kind).iter().enumerate();
        let stray = entries.find(|(_, entry)| entry.index != set.nx_entry || !set.has(entry.sub));
        findings.extend(stray.map(|(place, entry)| {
            let entry = EntryAddress { index: entry.index, sub: entry.sub };
            let fact = Fact::IllegalEntry { place, entry, wanted: set.nx_entry };
            Finding::new(RULE.id, &IO, FindingPlace::DataSet(set), fact)
        }));
    }
}

fn check_pdo(pdo: &PdoSettings, findings: &mut Vec<Finding>) {
    for set in DataSet::all() {
        let mut entries = assigned_entries(pdo, set).iter().enumerate();
        let stray = entries.find(|(_, entry)| entry.index != set.pdo_entry && !entry.is_empty());
        findings.extend(stray.map(|(place, entry)| {
            let entry = EntryAddress { index: entry.index, sub: entry.sub };
            let fact = Fact::IllegalEntry { place, entry, wanted: set.pdo_entry };
            Finding::new(RULE.id, &PDO, FindingPlace::DataSet(set), fact)
        }));
    }
}
