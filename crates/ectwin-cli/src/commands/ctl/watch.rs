//! `ctl watch`: what happens, as it happens.

use std::time::{Duration, Instant as Now};

use control::client::{Answered, Client, ClientError, Streamed};
use control::messages::{Subscribed, VariableReport, Verb};
use ectwin::Instant;
use ectwin::happenings::{KINDS, log_line};
use serde_json::{Map, Value};
use user_file::nearest;

use super::twin;
use super::variables::value_words;
use crate::cli::CtlArgs;
use crate::failure::Failure;
use crate::failure_document::or_document;
use crate::interrupt::Interrupt;
use crate::output::{self, People, Reader};

/// Time between two looks for a signal.
const LOOK_AGAIN: Duration = Duration::from_millis(100);

/// Prints records until a signal, the end of the twin, or that of the reader.
pub(super) fn run(args: &CtlArgs, subjects: &[String]) -> Result<(), Failure> {
    let interrupt = Interrupt::watch()?;
    let (mut client, subscribed) = or_document(args.json, subscribe(args, subjects))?;
    People::Stderr.print_line(format_args!("watching {}", subscribed.join(", ")))?;
    while interrupt.signal().is_none() {
        let streamed = match client.next_record(Some(Now::now() + LOOK_AGAIN)) {
            Ok(None) => continue,
            Ok(Some(streamed)) => streamed,
            Err(ClientError::Ended) => return People::Stderr.print_line("the twin has ended"),
            Err(error) => return Err(twin::failure(error)),
        };
        let line = if args.json { as_json(&streamed) } else { output::for_terminals(&for_people(&streamed)) };
        if output::print_to_reader(line.as_bytes())? == Reader::Gone {
            break;
        }
    }
    Ok(())
}

fn subscribe(args: &CtlArgs, subjects: &[String]) -> Result<(Client, Vec<String>), Failure> {
    let mut client = twin::connect(args)?;
    let subscribed = client.ask(Verb::Subscribe(kinds(subjects)));
    let Answered::<Subscribed> { content, .. } =
        subscribed.map_err(|error| twin::failure(with_nearest_kinds(error, subjects)))?;
    Ok((client, content.subscribed))
}

/// A word that is no variable can be a kind that is written wrongly.
fn with_nearest_kinds(error: ClientError, subjects: &[String]) -> ClientError {
    let ClientError::Refused(mut refusal) = error else { return error };
    let names: Vec<&str> = KINDS.iter().map(|kind| kind.name).filter(|name| !is_in(subjects, name)).collect();
    refusal.nearest.extend(subjects.iter().filter_map(|subject| nearest(subject, &names)));
    ClientError::Refused(refusal)
}

fn is_in(subjects: &[String], name: &str) -> bool {
    subjects.iter().any(|subject| subject == name)
}

/// Kinds of records, and `variable:NAME` for each other word.
fn kinds(subjects: &[String]) -> Vec<String> {
    let those = |is_one: fn(&str) -> bool| {
        KINDS.iter().filter(move |kind| is_one(kind.shown_by)).map(|kind| kind.name.to_owned())
    };
    if subjects.is_empty() {
        return those(|shown_by| shown_by == "-v").collect();
    }
    let kinds = subjects.iter().flat_map(|subject| {
        let is_kind = KINDS.iter().any(|kind| kind.name == subject);
        match subject.as_str() {
            "all" => those(|_| true).collect(),
            _ if is_kind || subject.starts_with("variable:") => vec![subject.clone()],
            name => vec![format!("variable:{name}")],
        }
    });
    kinds.collect()
}

fn as_json(streamed: &Streamed) -> String {
    match streamed {
        Streamed::Record(record) => format!("{}\n", Value::Object(record.clone())),
        Streamed::Lost(count) => format!("{{\"lost\":{count}}}\n"),
    }
}

/// A line as in the log.
fn for_people(streamed: &Streamed) -> String {
    let record = match streamed {
        Streamed::Record(record) => record,
        Streamed::Lost(count) => {
            return format!("{count} records are missing here: more came than could be taken\n");
        }
    };
    let number = |name: &str| record.get(name).and_then(Value::as_u64);
    let text = |name: &str| record.get(name).and_then(Value::as_str);
    let at = Instant::from_nanos(number("at_ns").unwrap_or_default());
    let unit = number("unit").map(|unit| (unit, text("name").unwrap_or_default()));
    let words = match text("variable") {
        Some(name) => variable(name, record),
        None => text("text").unwrap_or_default().to_owned(),
    };
    format!("{}\n", log_line(at, unit, &words))
}

/// The words of a changed variable, which is no event.
fn variable(name: &str, record: &Map<String, Value>) -> String {
    match serde_json::from_value(Value::Object(record.clone())) {
        Ok(VariableReport { value, validity, forced, .. }) => {
            let forced = if forced { ", forced" } else { "" };
            format!("{name} is {} ({validity}{forced})", value_words(&value))
        }
        Err(_) => name.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_is_a_kind_of_records_or_a_variable() {
        let kinds = |words: &[&str]| kinds(&words.iter().map(|word| (*word).to_owned()).collect::<Vec<_>>());
        assert_eq!(kinds(&["state", "N1_X", "variable:state"]), ["state", "variable:N1_X", "variable:state"]);
        assert_eq!(kinds(&["all"]).len(), KINDS.len());
        let usual = kinds(&[]);
        assert!(usual.contains(&"event".to_owned()) && !usual.contains(&"message".to_owned()), "{usual:?}");
    }
}
