//! What a record of a stored log means.

use scenario::model::Calendar;
use unit_model::tables::EventRow;
use unit_model::{Model, StoredRecord};

/// The row of the event in the table of its model.
pub(super) fn row_of(model: &'static dyn Model, record: &StoredRecord) -> Option<&'static EventRow> {
    model.tables().events.iter().find(|row| row.code == record.event.code)
}

/// Date and time with milliseconds; none if the unit did not know the time.
pub(super) fn time(time_ns: u64) -> Option<String> {
    let millis = time_ns / 1_000_000 % 1_000;
    (time_ns > 0).then(|| format!("{}.{millis:03}Z", Calendar::from_nanos(time_ns)))
}
