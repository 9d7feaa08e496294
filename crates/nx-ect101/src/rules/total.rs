//! Total amount of data: at most 1,200 bytes in each direction, on each side, status not counted (manual,
//! 5-3-2).
//!
//! Passes: 40 entries of 15 UINT, 1,200 bytes.
//! Fails:  40 entries of 15 UINT and one UDINT, 1,204 bytes.

use coe_kit::pdo::PdoSettings;

use crate::allocation::IoAllocation;
use crate::data_sets::{Direction, Limits};
use crate::finding::{Fact, Finding, FindingPlace};
use crate::pdo_settings::data_bytes;
use crate::rule::{Check, Rule};
use crate::rule_kind::{RuleEvents, RuleId, Side};

/// I/O Entry Data Capacity Exceeded.
const IO: RuleEvents = RuleEvents::at_power_on(Side::IoEntry, 0x391D_0000, 0x391C_0000);
/// PDO Entry Data Capacity Exceeded.
const PDO: RuleEvents = RuleEvents::at_safe_op(Side::PdoEntry, 0x392C_0000, 0x392D_0000);

pub(super) const RULE: Rule = Rule {
    id: RuleId::Total,
    section: "5-3-2",
    text: "the data sets of one direction have 1,200 bytes at most, on each side",
    events: &[IO, PDO],
    checks: &[Check::Io(check_io), Check::Pdo(check_pdo)],
};

fn check_io(io: &IoAllocation, findings: &mut Vec<Finding>) {
    check(&IO, |direction| io.data_bytes(direction), findings);
}

fn check_pdo(pdo: &PdoSettings, findings: &mut Vec<Finding>) {
    check(&PDO, |direction| data_bytes(pdo, direction), findings);
}

fn check(events: &RuleEvents, data_bytes: impl Fn(Direction) -> usize, findings: &mut Vec<Finding>) {
    let limit_bytes = usize::from(Limits::of_model().exchange_bytes);
    for direction in Direction::ALL {
        let size_bytes = data_bytes(direction);
        if size_bytes > limit_bytes {
            let (place, fact) = (FindingPlace::Direction(direction), Fact::TooMuchData { size_bytes });
            findings.push(Finding::new(RULE.id, events, place, fact));
        }
    }
}
