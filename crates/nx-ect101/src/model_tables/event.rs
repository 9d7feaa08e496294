//! The rows of events: their attributes, and their explanation.

use unit_model::tables::{Advice, EmergencyCode, EventRow, Fact, Record, Section};

use super::{channels, words};
use crate::events::{AttachedInformation, EcatEffect, Event, IndicatorStatus, Notified};

pub(super) fn row(event: &'static Event) -> EventRow {
    let emergency = |code| EmergencyCode { code, is_sent: event.emergency_notified == Notified::Possible };
    EventRow {
        code: event.code,
        name: &event.name,
        level: event.level,
        has_changeable_level: event.changeable_level,
        al_status_code: event.al_status_code,
        emergency: event.emergency_code.map(emergency),
        recovery: words::recovery(event.recovery),
        facts: vec![
            Fact::new("meaning", event.meaning.as_str()),
            Fact::new("level", level_fact(event)),
            Fact::new("detected", words::detected(event.detection_timing)),
            Fact::new("in ectwin", event.in_ectwin.as_str()),
        ],
        causes: event.causes.iter().map(|row| Advice::new(&row.cause, &row.correction)).collect(),
        sections: sections(event),
        record: Record::of(event),
    }
}

/// Its sections, without empty ones.
fn sections(event: &Event) -> Vec<Section> {
    let sections = [
        ("What the EtherCAT master sees", channels::master(event)),
        ("What the CPU Unit sees", channels::cpu_unit(event)),
        ("Indicators", indicators(event)),
        ("Attached information", attached(event)),
        ("Logs and recovery", logs(event)),
    ];
    let sections = sections.into_iter().filter(|(_, facts)| !facts.is_empty());
    sections.map(|(heading, facts)| Section { heading: heading.into(), facts }).collect()
}

fn level_fact(event: &Event) -> String {
    let changeable =
        if event.changeable_level { ", or observation by `[event_levels]` of the unit file" } else { "" };
    format!("{}{changeable}", event.level.words())
}

fn indicators(event: &Event) -> Vec<Fact> {
    let rows =
        [("RUN", event.run), ("ERR", event.err), ("TS green", event.ts_green), ("TS red", event.ts_red)];
    let touched = |(label, status): (&'static str, IndicatorStatus)| {
        let pattern = words::indicator(status)?;
        Some(match label {
            "RUN" => Fact::new(label, run(event, pattern)),
            _ => Fact::new(label, pattern),
        })
    };
    let facts: Vec<Fact> = rows.into_iter().filter_map(touched).collect();
    if facts.is_empty() { vec![Fact::new("all", "as without the event")] } else { facts }
}

/// RUN depends only on the state. Where an event does not change it, the manual's row is that of one state.
fn run(event: &Event, pattern: &str) -> String {
    match event.ecat_effect {
        EcatEffect::NotAffected | EcatEffect::RetainState => format!(
            "shows the EtherCAT state, which this event does not change (in the manual's table: {pattern})"
        ),
        EcatEffect::StopInit | EcatEffect::StopPreop | EcatEffect::EnterSafeop | EcatEffect::Restart => {
            pattern.to_owned()
        }
    }
}

fn attached(event: &Event) -> Vec<Fact> {
    event.attached_information.iter().map(attached_fact).collect()
}

fn attached_fact(information: &AttachedInformation) -> Fact {
    let values = information.values.iter().map(|(value, meaning)| format!("{value} {meaning}"));
    let values: Vec<String> = values.collect();
    let meaning = words::attached(&information.meaning);
    let text = if values.is_empty() { meaning.into() } else { format!("{meaning}: {}", values.join("; ")) };
    Fact::new(information.n.to_string(), text)
}

fn logs(event: &Event) -> Vec<Fact> {
    vec![
        Fact::new("event log", words::event_log(event.event_log)),
        Fact::new("recovery", words::recovery(event.recovery)),
    ]
}
