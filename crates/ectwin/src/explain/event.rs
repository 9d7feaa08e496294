//! The explanation of an event of the NX-ECT101, from the rows of its event table.

mod channels;
mod words;

use nx_ect101::{AttachedInformation, EcatEffect, Event, EventCode, IndicatorStatus};

use super::{Advice, Explanation, Fact, Section, Subject};

pub(super) use channels::when_emergencies_are_sent;
pub(super) use words::{level, recovery};

pub(super) fn explanation(code: EventCode) -> Option<Explanation> {
    let event = Event::find(code)?;
    let facts = vec![
        Fact::new("meaning", event.meaning.as_str()),
        Fact::new("level", level_fact(event)),
        Fact::new("detected", words::detected(event.detection_timing)),
        Fact::new("in ectwin", event.in_ectwin.as_str()),
    ];
    let sections = [
        section("What the EtherCAT master sees", channels::master(event)),
        section("What the CPU Unit sees", channels::cpu_unit(event)),
        section("Indicators", indicators(event)),
        section("Attached information", attached(event)),
        section("Logs and recovery", logs(event)),
    ];
    Some(Explanation {
        subject: Subject::Event(code),
        name: event.name.clone(),
        facts,
        advice: advice(event),
        sections: sections.into_iter().flatten().collect(),
    })
}

/// Causes with their corrections.
pub(super) fn advice(event: &'static Event) -> Vec<Advice> {
    let advice = event.causes.iter();
    advice.map(|row| Advice { cause: &row.cause, correction: &row.correction }).collect()
}

/// A section, unless it is empty.
pub(super) fn section(heading: &'static str, facts: Vec<Fact>) -> Vec<Section> {
    if facts.is_empty() { Vec::new() } else { vec![Section { heading, facts }] }
}

/// The events with a code, one fact each.
pub(super) fn event_facts(events: impl Iterator<Item = &'static Event>) -> Vec<Fact> {
    events.map(|event| Fact::new("event", format!("{} {}", event.code, event.name))).collect()
}

fn level_fact(event: &Event) -> String {
    let changeable =
        if event.changeable_level { ", or observation by `[event_levels]` of the unit file" } else { "" };
    format!("{}{changeable}", level(event.level))
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
    let label = match information.n {
        1 => "1",
        2 => "2",
        3 => "3",
        _ => "4",
    };
    let values = information.values.iter().map(|(value, meaning)| format!("{value} {meaning}"));
    let values: Vec<String> = values.collect();
    let meaning = words::attached(&information.meaning);
    let told = if values.is_empty() { meaning.into() } else { format!("{meaning}: {}", values.join("; ")) };
    Fact::new(label, told)
}

fn logs(event: &Event) -> Vec<Fact> {
    vec![
        Fact::new("event log", words::event_log(event.event_log)),
        Fact::new("recovery", recovery(event.recovery)),
    ]
}
