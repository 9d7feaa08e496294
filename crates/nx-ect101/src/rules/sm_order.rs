//! Allocation order to the SyncManager: PDOs are assigned in ascending order of their indexes (manual, 5-3-6).
//!
//! Passes: 1C13 = 1A00, 1A01, 1A03.
//! Fails:  1C13 = 1A03, 1A00, 1A01; 1C12 = 1601, 1601.

use coe_kit::pdo::PdoSettings;

use crate::data_sets::Direction;
use crate::finding::{Fact, Finding, FindingPlace};
use crate::pdo_settings::is_assignable;
use crate::rule::{Check, Rule};
use crate::rule_kind::{RuleEvents, RuleId, Side};

/// Incorrect RxPDO Mapping Order and Incorrect TxPDO Mapping Order.
const ASSIGNMENT: RuleEvents = RuleEvents::at_safe_op(Side::Assignment, 0x392E_0000, 0x392F_0000);

pub(super) const RULE: Rule = Rule {
    id: RuleId::SmOrder,
    section: "5-3-6",
    text: "PDOs are assigned to a SyncManager in ascending order of their indexes, each once",
    events: &[ASSIGNMENT],
    checks: &[Check::Pdo(check)],
};

fn check(pdo: &PdoSettings, findings: &mut Vec<Finding>) {
    for direction in Direction::ALL {
        let place = FindingPlace::Direction(direction);
        let fact = not_ascending(pdo, direction);
        findings.extend(fact.map(|fact| Finding::new(RULE.id, &ASSIGNMENT, place, fact)));
    }
}

/// The first PDO whose index is not above that of the PDO before it. A PDO that cannot be assigned in this
/// direction is ignored in the order; the rule `mandatory` reports it.
fn not_ascending(pdo: &PdoSettings, direction: Direction) -> Option<Fact> {
    let elements = pdo.assignment(direction.assignment()).iter().copied().enumerate();
    let mut before = None;
    for (place, pdo) in elements.filter(|&(_, pdo)| is_assignable(direction, pdo)) {
        if let Some(after) = before.replace(pdo).filter(|&before| before >= pdo) {
            return Some(Fact::NotAscending { place, pdo, after });
        }
    }
    None
}
