//! Matched amount of data: a data set has the same number of entries on both sides (manual, 5-3-5).
//!
//! Passes: 6 PDO entries and 6 I/O entries.
//! Fails:  6 PDO entries and 4 I/O entries; then the first four are exchanged.
//!
//! One finding contains all data sets of a direction. The rule `combination` covers a data set without entries
//! on one side; it raises the same event for the direction.

use coe_kit::pdo::PdoSettings;

use crate::allocation::IoAllocation;
use crate::amounts::{self, different};
use crate::data_sets::Direction;
use crate::finding::{Amount, Fact, Finding};
use crate::rule::{Check, Rule};
use crate::rule_kind::{RuleEvents, RuleId, Side};

/// Data Size Mismatched between PDO Entry and I/O Entry.
const PDO: RuleEvents = RuleEvents::at_safe_op(Side::PdoEntry, 0x3917_0000, 0x3916_0000);

pub(super) const RULE: Rule = Rule {
    id: RuleId::Matched,
    section: "5-3-5",
    text: "a data set has the same amount of data on both sides",
    events: &[PDO],
    checks: &[Check::Both(check)],
};

fn check(io: &IoAllocation, pdo: &PdoSettings, findings: &mut Vec<Finding>) {
    for direction in Direction::ALL {
        let amounts = amounts::of(io, pdo, direction);
        let one_sided = amounts.iter().any(|amount| amount.is_one_sided());
        if !one_sided && amounts.iter().any(Amount::is_unequal) {
            let place = different(direction, &amounts);
            findings.push(Finding::new(RULE.id, &PDO, place, Fact::Unequal { amounts }));
        }
    }
}
