//! The section `event_levels` of a unit file.

use user_file::{DeValue, Located, Problem, Reader, Section, values};

use super::keys;
use crate::events::{EventCode, EventLevel};

/// The level that a user assigns to an event whose level can be changed (manual, 8-3-4).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChangedLevel {
    /// Code of the event.
    pub event_code: Located<EventCode>,
    /// Its level: observation or minor fault.
    pub level: Located<EventLevel>,
}

/// Changed levels, in the order of their codes.
pub(super) fn event_levels(reader: &mut Reader<'_>, file: &Section<'_, '_>) -> Vec<ChangedLevel> {
    let Some(section) = reader.section(file, "event_levels") else { return Vec::new() };
    let mut levels = Vec::new();
    for (key, value) in section.entries() {
        let Some(code) = keys::changeable_events().find(|code| code.to_string() == key.value) else {
            let message = format!(
                "`event_levels`: no event `{}` whose level can be changed",
                user_file::shown(key.value)
            );
            let names: Vec<String> = keys::changeable_events().map(|code| code.to_string()).collect();
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            reader.refuse(key.span.unwrap_or_default(), Problem::unknown(message, key.value, &names));
            continue;
        };
        if let Some(level) = reader.read(&section.place_of(key.value), value, level) {
            levels.push(ChangedLevel { event_code: Located { value: code, span: key.span }, level });
        }
    }
    levels.sort_by_key(|level| level.event_code.value);
    levels
}

fn level(place: &str, value: &DeValue<'_>) -> Result<EventLevel, Problem> {
    let choices = [("observation", EventLevel::Observation), ("minor_fault", EventLevel::MinorFault)];
    values::choice(place, value, &choices)
}
