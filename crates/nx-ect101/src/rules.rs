//! The setting rules for data exchange, as a table that is read in order (manual, 5-3, 7-5-2 and 7-5-4).
//!
//! A rule checks settings and changes nothing. All rules are evaluated, so that all findings are reported at
//! once. Those of I/O entries are checked at power-on of the NX Unit, the others at PRE-OP to SAFE-OP, in the
//! order of the table.

mod combination;
mod mandatory;
mod matched;
mod order;
mod sm_order;
mod total;
mod r#type;

use coe_kit::pdo::PdoSettings;

use crate::allocation::IoAllocation;
use crate::data_sets::Direction;
use crate::finding::Finding;
use crate::rule::{Check, Rule};

/// Maximum number of findings of one configuration: five by data set and side, six by direction and side.
pub(crate) const MAX_FINDINGS: usize = 5 * 6 + 6 * 2;

/// All rules, in the order in which they are checked.
pub const RULES: &[Rule] = &[
    mandatory::RULE,
    sm_order::RULE,
    r#type::RULE,
    order::RULE,
    total::RULE,
    combination::RULE,
    matched::RULE,
];

/// Adds the findings of all rules.
pub(crate) fn check_all(io: &IoAllocation, pdo: &PdoSettings, findings: &mut Vec<Finding>) {
    for check in checks() {
        match check {
            Check::Io(check) => check(io, findings),
            Check::Pdo(check) => check(pdo, findings),
            Check::Both(check) => check_both(*check, io, pdo, &[], findings),
        }
    }
}

/// Adds the findings of the rules of power-on.
pub(crate) fn check_at_power_on(io: &IoAllocation, findings: &mut Vec<Finding>) {
    for check in checks() {
        if let Check::Io(check) = check {
            check(io, findings);
        }
    }
}

/// Adds the findings of the rules of PRE-OP to SAFE-OP; `at_power_on` are the findings of the rules of power-on.
pub(crate) fn check_at_safe_op(
    io: &IoAllocation,
    pdo: &PdoSettings,
    at_power_on: &[Finding],
    findings: &mut Vec<Finding>,
) {
    for check in checks() {
        match check {
            Check::Io(_) => {}
            Check::Pdo(check) => check(pdo, findings),
            Check::Both(check) => check_both(*check, io, pdo, at_power_on, findings),
        }
    }
}

fn checks() -> impl Iterator<Item = &'static Check> {
    RULES.iter().flat_map(|rule| rule.checks)
}

fn check_both(
    check: fn(&IoAllocation, &PdoSettings, &mut Vec<Finding>),
    io: &IoAllocation,
    pdo: &PdoSettings,
    before: &[Finding],
    findings: &mut Vec<Finding>,
) {
    let known = findings.len();
    check(io, pdo, findings);
    let is_broken = |direction: Direction, findings: &[Finding]| {
        before.iter().chain(findings).any(|finding| finding.direction == direction)
    };
    let broken = [Direction::MToC, Direction::CToM]
        .map(|direction| is_broken(direction, findings.get(..known).unwrap_or_default()));
    let mut at = 0;
    findings.retain(|finding| {
        at += 1;
        at <= known || !broken[finding.direction as usize]
    });
}

#[cfg(test)]
mod tests;
