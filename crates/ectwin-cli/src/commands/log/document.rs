//! The logs as a JSON document.

use serde::Serialize;
use unit_model::{EventLevel, EventLog, Model, StoredLogs, StoredRecord};

use super::rows::{row_of, time};

/// The logs of a unit.
#[derive(Serialize)]
pub(super) struct Document<'a> {
    model: &'a str,
    serial: u32,
    records: Vec<Row>,
}

#[derive(Serialize)]
struct Row {
    log: EventLog,
    /// None: the unit did not know the time.
    time: Option<String>,
    time_ns: u64,
    event: String,
    name: Option<&'static str>,
    level: EventLevel,
    attached: Vec<u32>,
    causes: Vec<Cause>,
}

#[derive(Serialize)]
struct Cause {
    cause: &'static str,
    correction: &'static str,
}

impl<'a> Document<'a> {
    pub(super) fn of(model: &'static dyn Model, logs: &StoredLogs) -> Self {
        let records = logs.records.iter().map(|record| row(model, record)).collect();
        Self { model: model.name(), serial: logs.serial, records }
    }
}

fn row(model: &'static dyn Model, record: &StoredRecord) -> Row {
    let StoredRecord { log, event, time_ns } = *record;
    let known = row_of(model, record);
    let causes = known.iter().flat_map(|row| &row.causes);
    Row {
        log,
        time: time(time_ns),
        time_ns,
        event: event.code.to_string(),
        name: known.map(|row| row.name),
        level: event.level,
        attached: event.attached.values().to_vec(),
        causes: causes.map(|advice| Cause { cause: &advice.cause, correction: &advice.correction }).collect(),
    }
}
