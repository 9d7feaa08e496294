//! Indicators and their patterns, from the indicator table of the model.

use coe_kit::indicators::Pattern;
use unit_model::tables::StatusRow;

use super::tables::tables;
use super::{Explanation, Fact, Subject};

/// The names of all indicators.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    tables().indicators.iter().flat_map(|indicator| indicator.names.iter().copied())
}

pub(super) fn explanation(name: &'static str) -> Option<Explanation> {
    let indicator = tables().indicators.iter().find(|indicator| indicator.names.contains(&name))?;
    let facts = indicator.status.iter().map(status).collect();
    let (subject, name) = (Subject::Indicator(name), indicator.shows.to_owned());
    Some(Explanation { subject, name, facts, advice: Vec::new(), sections: Vec::new() })
}

/// The possible observations of each indicator, in the usual spellings, with the indicator: `TS green`, `red ERR LED flickering`.
pub(super) fn lights() -> impl Iterator<Item = (String, &'static str)> {
    tables().indicators.iter().flat_map(|indicator| {
        let statuses = indicator.status.iter().flat_map(seen).collect::<Vec<_>>();
        indicator.names.iter().flat_map(move |name| {
            let kind = name.split_once(' ').map_or(*name, |(kind, _)| kind);
            let all = [name, kind]
                .map(|named| statuses.iter().flat_map(|seen| spellings(named, seen)).collect::<Vec<_>>());
            all.into_iter().flatten().map(move |words| (words, *name))
        })
    })
}

/// The words for a status: a colour, a pattern, or both in either order.
fn seen(status: &StatusRow) -> Vec<String> {
    let pattern = status.pattern.id().replace('_', " ");
    if status.pattern == Pattern::NotLit {
        return ["dark", "off", "out", &pattern].map(str::to_owned).to_vec();
    }
    let colour = status.colour.id();
    // `flashing_1s` without its period.
    let short = pattern.split_once(' ').map(|(first, _)| first).filter(|first| *first == "flashing");
    let mut words = vec![colour.to_owned()];
    for pattern in [Some(pattern.as_str()), short].into_iter().flatten() {
        words.extend([pattern.to_owned(), format!("{colour} {pattern}"), format!("{pattern} {colour}")]);
    }
    words
}

fn spellings(name: &str, seen: &str) -> Vec<String> {
    let names = ["", " LED", " indicator"].map(|what| format!("{name}{what}"));
    names.iter().flat_map(|name| [format!("{name} {seen}"), format!("{seen} {name}")]).collect()
}

fn status(status: &StatusRow) -> Fact {
    let events: Vec<String> = status.events.iter().map(ToString::to_string).collect();
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
    let source = tables().pattern_source(pattern).map(|source| Fact::new("source", source));
    let shown = tables().indicators.iter().flat_map(|indicator| {
        let status = indicator.status.iter().filter(move |status| status.pattern == pattern);
        status.map(|status| {
            let meaning = status.meaning.join("; ");
            Fact::new(indicator.names.join(", "), format!("{}: {meaning}", status.colour.id()))
        })
    });
    let facts = source.into_iter().chain(shown).collect();
    Explanation { subject: Subject::Pattern(pattern), name, facts, advice: Vec::new(), sections: Vec::new() }
}
