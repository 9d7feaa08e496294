//! Indicators and their patterns, from the indicator table of the model.

use coe_kit::indicators::Pattern;
use nx_ect101::{Indicator, IndicatorMeaning, pattern_source};

use super::{Explanation, Fact, Subject};

/// The names of all indicators.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    Indicator::all().iter().flat_map(|indicator| indicator.names.iter().map(String::as_str))
}

pub(super) fn explanation(name: &'static str) -> Option<Explanation> {
    let indicator =
        Indicator::all().iter().find(|indicator| indicator.names.iter().any(|known| known == name))?;
    let facts = indicator.status.iter().map(status).collect();
    let (subject, name) = (Subject::Indicator(name), indicator.shows.clone());
    Some(Explanation { subject, name, facts, advice: Vec::new(), sections: Vec::new() })
}

fn status(status: &IndicatorMeaning) -> Fact {
    let events: Vec<String> = status.events().map(|code| code.to_string()).collect();
    let events = if events.is_empty() { String::new() } else { format!(" ({})", events.join(" ")) };
    let (pattern, meaning) = (words(status.pattern), status.meaning.join("; "));
    let colour = if status.pattern == Pattern::NotLit { "dark" } else { status.colour.id() };
    Fact::new(colour, format!("{pattern}: {meaning}{events}"))
}

/// The pattern with its times.
fn words(pattern: Pattern) -> String {
    match times(pattern) {
        Some(times) => format!("{} ({times})", pattern.id()),
        None => pattern.id().to_owned(),
    }
}

/// Lit and dark times; none for a steady pattern.
fn times(pattern: Pattern) -> Option<String> {
    let steps = pattern.steps_ms().iter().zip(["lit", "dark"].iter().cycle());
    let steps: Vec<String> = steps.map(|(ms, light)| format!("{ms} ms {light}")).collect();
    (!steps.is_empty()).then(|| steps.join(", "))
}

pub(super) fn pattern(pattern: Pattern) -> Explanation {
    let name = times(pattern).unwrap_or_else(|| "steady".into());
    let source = pattern_source(pattern).map(|source| Fact::new("source", source));
    let shown = Indicator::all().iter().flat_map(|indicator| {
        let status = indicator.status.iter().filter(move |status| status.pattern == pattern);
        status.map(|status| {
            let meaning = status.meaning.join("; ");
            Fact::new(indicator.names.join(", "), format!("{}: {meaning}", status.colour.id()))
        })
    });
    let facts = source.into_iter().chain(shown).collect();
    Explanation { subject: Subject::Pattern(pattern), name, facts, advice: Vec::new(), sections: Vec::new() }
}
