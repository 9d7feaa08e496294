//! Setting rules, from the tables of the model.

use unit_model::tables::RuleRow;

use super::tables::tables;
use super::{Explanation, Fact, Subject};

pub(super) fn names() -> impl Iterator<Item = &'static str> {
    tables().rules.iter().map(|rule| rule.id)
}

pub(super) fn explanation(name: &'static str) -> Option<Explanation> {
    let rule = tables().rules.iter().find(|rule| rule.id == name)?;
    Some(Explanation {
        subject: Subject::Rule(name),
        name: rule.text.to_owned(),
        facts: vec![Fact::new("manual", rule.section), Fact::new("events", events(rule))],
        advice: Vec::new(),
        sections: Vec::new(),
    })
}

/// The events of a rule, each once.
fn events(rule: &RuleRow) -> String {
    let mut events: Vec<String> = Vec::new();
    for event in &rule.events {
        let event = format!("{} {}", event.code, event.name);
        if !events.contains(&event) {
            events.push(event);
        }
    }
    events.join(", ")
}
