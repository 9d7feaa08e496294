//! `ectwin list indicators`: the meaning of each indicator, and the patterns over time.

use std::fmt::Write;

use coe_kit::indicators::Pattern;
use serde::Serialize;
use unit_model::ModelTables;
use unit_model::tables::{self, IndicatorRow as Indicator};

use crate::cli::ListArgs;
use crate::failure::Failure;
use crate::output;

/// The JSON document. Event codes have eight hexadecimal digits.
#[derive(Serialize)]
struct Document {
    indicators: Vec<IndicatorRow>,
    patterns: Vec<PatternRow>,
}

#[derive(Serialize)]
struct IndicatorRow {
    name: &'static str,
    shows: &'static str,
    status: Vec<StatusRow>,
}

#[derive(Serialize)]
struct StatusRow {
    colour: &'static str,
    pattern: &'static str,
    meaning: &'static [&'static str],
    events: Vec<String>,
}

/// `steps_ms` are lit, dark, lit, dark …; none for a pattern that never changes.
#[derive(Serialize)]
struct PatternRow {
    name: &'static str,
    steps_ms: &'static [u64],
    source: Option<&'static str>,
}

pub(crate) fn run(args: &ListArgs) -> Result<(), Failure> {
    let document = document(args.tables());
    if args.json {
        return output::print(output::json(&document)?.as_bytes());
    }
    let text = args.text("indicators", document.indicators.len(), || as_text(&document));
    output::print(text.as_bytes())
}

fn document(tables: &'static ModelTables) -> Document {
    Document {
        indicators: tables.indicators.iter().flat_map(indicator_rows).collect(),
        patterns: Pattern::ALL.into_iter().map(|pattern| pattern_row(tables, pattern)).collect(),
    }
}

/// L/A IN and L/A OUT are two indicators with the same meanings.
fn indicator_rows(indicator: &'static Indicator) -> impl Iterator<Item = IndicatorRow> {
    let row = |name| IndicatorRow {
        name,
        shows: indicator.shows,
        status: indicator.status.iter().map(status_row).collect(),
    };
    indicator.names.iter().map(move |name| row(name))
}

fn status_row(status: &'static tables::StatusRow) -> StatusRow {
    StatusRow {
        colour: status.colour.id(),
        pattern: status.pattern.id(),
        meaning: &status.meaning,
        events: status.events.iter().map(ToString::to_string).collect(),
    }
}

fn pattern_row(tables: &ModelTables, pattern: Pattern) -> PatternRow {
    PatternRow { name: pattern.id(), steps_ms: pattern.steps_ms(), source: tables.pattern_source(pattern) }
}

fn as_text(document: &Document) -> String {
    let mut text = String::new();
    for IndicatorRow { name, shows, status } in &document.indicators {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{name}: {shows}");
        for StatusRow { colour, pattern, meaning, events } in status {
            let _ = writeln!(text, "   {colour:<5}  {pattern:<12}  {}", meaning.join("; "));
            for codes in events.chunks(8) {
                let _ = writeln!(text, "   {:<21}{}", "", codes.join(" "));
            }
        }
    }
    text.push_str("Patterns, lit and dark in ms:\n");
    for PatternRow { name, steps_ms, source } in &document.patterns {
        if let Some(source) = source {
            let steps: Vec<String> = steps_ms.iter().map(u64::to_string).collect();
            let _ = writeln!(text, "   {name:<12}  {:<18}  {source}", steps.join(" "));
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn json() -> serde_json::Value {
        let text = output::json(&document(plant::default_model().tables())).ok().unwrap();
        serde_json::from_str(&text).unwrap()
    }

    #[test]
    fn the_json_document_tells_indicators_and_patterns() {
        let json = json();
        let names: Vec<&str> =
            json["indicators"].as_array().unwrap().iter().filter_map(|row| row["name"].as_str()).collect();
        assert_eq!(names, ["RUN", "ERR", "L/A IN", "L/A OUT", "TS"]);
        let patterns = json["patterns"].as_array().unwrap();
        let double_flash = patterns.iter().find(|row| row["name"] == "double_flash").unwrap();
        assert_eq!(double_flash["steps_ms"], serde_json::json!([200, 200, 200, 1000]));
        assert_eq!(patterns.len(), 8);
    }

    /// Manual, 3-2-1 and 3-2-2, in which each list of errors is beside its pattern.
    #[test]
    fn events_stand_beside_the_pattern_that_shows_them() {
        let json = json();
        let status = |indicator: usize, row: usize| json["indicators"][indicator]["status"][row].clone();
        let events = |indicator, row| status(indicator, row)["events"].as_array().unwrap().len();
        assert_eq!(status(1, 1)["events"], serde_json::json!(["09450000"]));
        assert_eq!(status(1, 4)["pattern"], "blinking");
        assert_eq!(events(1, 4), 20);
        assert_eq!(
            status(4, 0)["events"],
            serde_json::json!(["00200000", "10410000", "40200000", "80240000"])
        );
        assert_eq!(status(4, 1)["events"], serde_json::json!(["80200000"]));
        assert_eq!(events(4, 4), 6, "I/O entry setting errors");
    }

    #[test]
    fn the_text_has_every_meaning_and_every_event() {
        let text = as_text(&document(plant::default_model().tables()));
        for status in document(plant::default_model().tables())
            .indicators
            .into_iter()
            .flat_map(|indicator| indicator.status)
        {
            assert!(text.contains(&status.meaning.join("; ")));
            assert!(status.events.iter().all(|code| text.contains(code.as_str())));
        }
    }
}
