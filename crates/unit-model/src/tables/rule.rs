//! Setting rules with their events.

use wire::AlStatusCode;

use crate::event::EventCode;

/// A setting rule.
#[derive(Clone, Debug)]
pub struct RuleRow {
    /// Its name in data for programs.
    pub id: &'static str,
    /// Its section in the manual.
    pub section: &'static str,
    /// Its requirement.
    pub text: &'static str,
    /// The events that it raises.
    pub events: Vec<RuleEvent>,
}

/// An event of a setting rule. Words are those of data for programs.
#[derive(Clone, Debug)]
pub struct RuleEvent {
    /// Its code.
    pub code: EventCode,
    /// Its name.
    pub name: &'static str,
    /// The kind of settings.
    pub side: &'static str,
    /// The direction of the data.
    pub direction: &'static str,
    /// The time of the check.
    pub checked_at: &'static str,
    /// The AL status code that the master reads; none if the event sets none.
    pub al_status_code: Option<AlStatusCode>,
}
