//! Combination of data: a data set is selected on both sides or on neither (manual, 5-3-1).
//!
//! Passes: 15 UINT arrays from the master on the CPU Unit's side, 1601 on the master's side.
//! Fails:  15 UINT arrays from the master on the CPU Unit's side, 1602 on the master's side.
//!
//! A data set is selected if it has entries. One finding contains all data sets of a direction.

use coe_kit::pdo::PdoSettings;

use crate::allocation::IoAllocation;
use crate::amounts::{self, different};
use crate::data_sets::Direction;
use crate::finding::{Fact, Finding};
use crate::rule::{Check, Rule};
use crate::rule_kind::{RuleEvents, RuleId, Side};

/// Data Size Mismatched between PDO Entry and I/O Entry.
const ASSIGNMENT: RuleEvents = RuleEvents::at_safe_op(Side::Assignment, 0x3917_0000, 0x3916_0000);

pub(super) const RULE: Rule = Rule {
    id: RuleId::Combination,
    section: "5-3-1",
    text: "the same data sets are selected on both sides",
    events: &[ASSIGNMENT],
    checks: &[Check::Both(check)],
};

fn check(io: &IoAllocation, pdo: &PdoSettings, findings: &mut Vec<Finding>) {
    for direction in Direction::ALL {
        let amounts = amounts::of(io, pdo, direction);
        if amounts.iter().any(|amount| amount.is_one_sided()) {
            let place = different(direction, &amounts);
            findings.push(Finding::new(RULE.id, &ASSIGNMENT, place, Fact::OneSided { amounts }));
        }
    }
}
