//! The rows of setting rules.

use unit_model::tables::{RuleEvent, RuleRow};

use crate::data_sets::Direction;
use crate::events::Event;
use crate::rule::Rule;
use crate::rule_kind::{Moment, RuleEvents};

pub(super) fn row(rule: &Rule) -> RuleRow {
    let events = rule.events.iter().flat_map(|events| Direction::ALL.map(|way| event(events, way)));
    RuleRow { id: rule.id.id(), section: rule.section, text: rule.text, events: events.collect() }
}

fn event(events: &RuleEvents, direction: Direction) -> RuleEvent {
    let code = events.of(direction);
    let event = Event::find(code);
    RuleEvent {
        code,
        name: event.map_or("", |event| event.name.as_str()),
        side: events.side.id(),
        direction: direction.id(),
        checked_at: match events.moment {
            Moment::PowerOn => "nx_unit_power_on",
            Moment::PreOpToSafeOp => "preop_to_safeop",
        },
        al_status_code: event.and_then(|event| event.al_status_code),
    }
}
