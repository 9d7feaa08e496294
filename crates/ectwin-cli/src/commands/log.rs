//! `ectwin log FILE.nvm`: the event logs that a unit has stored, with causes and corrections.

mod document;
mod rows;

use std::path::Path;

use storage::StoredFile;
use unit_model::tables::EventRow;
use unit_model::{EventLog, MemoryDamage, Model, StoredLogs, StoredRecord};
use user_file::on_one_line;

use crate::cli::LogArgs;
use crate::failure::Failure;
use crate::output;
use rows::{row_of, time};

/// Prints the logs, the oldest record first. The file is not changed, also while a unit uses it.
pub(crate) fn run(args: &LogArgs) -> Result<(), Failure> {
    let (model, logs) = read(&args.memory)?;
    if args.json {
        return output::print(output::json(&document::Document::of(model, &logs))?.as_bytes());
    }
    output::print_text(&for_people(&args.memory, model, &logs))
}

fn read(path: &Path) -> Result<(&'static dyn Model, StoredLogs), Failure> {
    let unreadable = |message: String, help: &str| Failure::Refused {
        message: format!("cannot read {}: {message}", path.display()),
        help: help.to_owned(),
    };
    let help = "give the file that `storage` of a unit file names, such as N1.nvm";
    let bytes = StoredFile::peek(path).map_err(|error| unreadable(error.to_string(), help))?;
    let bytes = bytes.ok_or_else(|| unreadable("there is no such file".to_owned(), help))?;
    plant::stored_logs(&bytes).map_err(|damage| match damage {
        MemoryDamage::NoMemory => unreadable("it is not the memory of a unit".to_owned(), help),
        MemoryDamage::Damaged(reason) => unreadable(
            format!("the memory is damaged: {reason}"),
            "a unit with it records an event of its own; the next start with `storage` renames the file and makes a new one",
        ),
    })
}

fn for_people(path: &Path, model: &'static dyn Model, logs: &StoredLogs) -> String {
    let StoredLogs { serial, records } = logs;
    let count = match records.len() {
        1 => "1 record".to_owned(),
        count => format!("{count} records"),
    };
    let head = format!("{}: {}, serial number {serial}: {count}\n", output::shown(path), model.name());
    let records = records.iter().map(|record| one(model, record));
    core::iter::once(head).chain(records).collect()
}

fn one(model: &'static dyn Model, record: &StoredRecord) -> String {
    let StoredRecord { log, event, time_ns } = record;
    let row = row_of(model, record);
    let name = row.map_or("", |row| row.name);
    let time = time(*time_ns).unwrap_or_else(|| "time not known".to_owned());
    let mut text =
        format!("\n{time}  {}  {} {name} ({})\n", log_words(*log), event.code, event.level.words());
    let mut line =
        |label: &str, words: &str| text.push_str(&format!("  {label:<11} {}\n", on_one_line(words)));
    for (number, value) in (1..).zip(event.attached.values()) {
        let meaning = row.and_then(|row| meaning_of(row, number)).unwrap_or_default();
        line("attached", &format!("{number}: {value:#X} {meaning}"));
    }
    for advice in row.iter().flat_map(|row| &row.causes) {
        line("cause", &advice.cause);
        line("correction", &advice.correction);
    }
    text
}

/// The meaning of a piece of attached information.
fn meaning_of(row: &'static EventRow, number: usize) -> Option<&'static str> {
    let section = row.sections.iter().find(|section| section.heading == "Attached information")?;
    section.facts.iter().find(|fact| fact.label == number.to_string()).map(|fact| fact.text.as_str())
}

const fn log_words(log: EventLog) -> &'static str {
    match log {
        EventLog::System => "system event log",
        EventLog::Access => "access event log",
        EventLog::None => "no log",
    }
}
