//! The reaction of the unit to its settings.

use crate::events::EventLevel;
use crate::finding::Finding;
use crate::rule_kind::Moment;
use crate::rules::RULES;
use crate::verdict::Verdict;

/// The reaction of the unit to these settings, in a few words.
pub(super) fn of(verdict: &Verdict, level: impl Fn(&Finding) -> EventLevel) -> String {
    let at_power_on = verdict.findings.iter().any(|finding| {
        let rule = RULES.iter().find(|rule| rule.id == finding.rule);
        let mut events = rule.into_iter().flat_map(|rule| rule.events);
        events.any(|events| events.side == finding.side && events.moment == Moment::PowerOn)
    });
    let al_status_code = verdict.findings.iter().find_map(Finding::al_status_code);
    let mut parts = Vec::new();
    if at_power_on {
        parts.push("I/O refreshing does not start".to_owned());
    }
    if let Some(code) = al_status_code {
        parts.push(format!("the unit stays in PRE-OP with AL status code {code}"));
    }
    let is_warning = |finding| level(finding) == EventLevel::Observation;
    let noun = if verdict.findings.iter().all(is_warning) { "warning" } else { "finding" };
    let findings = match verdict.findings.len() {
        0 => return "the setting rules are satisfied".to_owned(),
        1 => format!("1 {noun}"),
        findings => format!("{findings} {noun}s"),
    };
    match parts.is_empty() {
        true => format!("{findings}; only what both sides have is exchanged"),
        false => format!("{findings}: {}; nothing is exchanged", parts.join(", ")),
    }
}
