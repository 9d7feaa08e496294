//! A setting rule as a row of the table.

use coe_kit::pdo::PdoSettings;

use crate::allocation::IoAllocation;
use crate::finding::Finding;
use crate::rule_kind::{RuleEvents, RuleId};

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
    pub(crate) checks: &'static [Check],
}

/// A check, by the settings that it needs.
#[derive(Debug)]
pub(crate) enum Check {
    Io(fn(&IoAllocation, &mut Vec<Finding>)),
    Pdo(fn(&PdoSettings, &mut Vec<Finding>)),
    /// Compares both sides; evaluated in a direction whose other rules are satisfied (manual, 5-3-5).
    Both(fn(&IoAllocation, &PdoSettings, &mut Vec<Finding>)),
}
