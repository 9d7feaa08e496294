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
use crate::events::EventCode;
use crate::finding::{Finding, Side};

/// Maximum number of findings of one configuration: five by data set and side, six by direction and side.
pub(crate) const MAX_FINDINGS: usize = 5 * 6 + 6 * 2;

/// A setting rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum RuleId {
    /// The requirements for every PDO setting.
    Mandatory,
    /// Allocation order to the SyncManager.
    SmOrder,
    /// Type of entry.
    Type,
    /// Order of entry.
    Order,
    /// Total amount of data.
    Total,
    /// Combination of data.
    Combination,
    /// Matched amount of data.
    Matched,
}

impl RuleId {
    /// Its name in data for programs.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::Mandatory => "mandatory",
            Self::SmOrder => "sm_order",
            Self::Type => "type",
            Self::Order => "order",
            Self::Total => "total",
            Self::Combination => "combination",
            Self::Matched => "matched",
        }
    }
}

/// The time at which a rule is checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Moment {
    /// At power-on of the NX Unit: a violation prevents the start of I/O refreshing, EtherCAT continues.
    PowerOn,
    /// When the master requests SAFE-OP: a violation with an AL status code keeps the unit in PRE-OP.
    PreOpToSafeOp,
}

/// The events of a rule for one side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RuleEvents {
    /// The side.
    pub side: Side,
    /// The time of the check.
    pub moment: Moment,
    /// Event for data from the master to the CPU Unit.
    pub m_to_c: EventCode,
    /// Event for data from the CPU Unit to the master.
    pub c_to_m: EventCode,
}

impl RuleEvents {
    /// The event for data of `direction`.
    #[must_use]
    pub const fn of(&self, direction: Direction) -> EventCode {
        match direction {
            Direction::MToC => self.m_to_c,
            Direction::CToM => self.c_to_m,
        }
    }

    const fn at_power_on(side: Side, m_to_c: u32, c_to_m: u32) -> Self {
        Self { side, moment: Moment::PowerOn, m_to_c: EventCode(m_to_c), c_to_m: EventCode(c_to_m) }
    }

    const fn at_safe_op(side: Side, m_to_c: u32, c_to_m: u32) -> Self {
        Self { side, moment: Moment::PreOpToSafeOp, m_to_c: EventCode(m_to_c), c_to_m: EventCode(c_to_m) }
    }
}

/// A row of the table.
#[derive(Debug)]
pub struct Rule {
    /// The rule.
    pub id: RuleId,
    /// Its section in the manual.
    pub section: &'static str,
    /// Its requirement.
    pub text: &'static str,
    /// The events that it raises.
    pub events: &'static [RuleEvents],
    /// Its check.
    checks: &'static [Check],
}

/// A check, by the settings that it needs.
#[derive(Debug)]
enum Check {
    Io(fn(&IoAllocation, &mut Vec<Finding>)),
    Pdo(fn(&PdoSettings, &mut Vec<Finding>)),
    /// Compares both sides; evaluated in a direction whose other rules are satisfied (manual, 5-3-5).
    Both(fn(&IoAllocation, &PdoSettings, &mut Vec<Finding>)),
}

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
