//! Conditions of the event logs of a unit, and of the messages in its diagnosis history.

use core::ops::Range;

use wire::{ObjectIndex, SubIndex};

use super::seen::{Seen, holds, is_often_enough};
use super::unit::has_power;
use crate::model::{Bytes, EventCode, EventLog, hex};
use crate::run::bench::Bench;

/// The diagnosis history.
const HISTORY: ObjectIndex = ObjectIndex(0x10F3);
/// The subindex before the first message.
const BEFORE_MESSAGES: u8 = 5;
/// The time stamp in a message (ETG.1020).
const TIME_STAMP: Range<usize> = 8..16;

type Check = Result<(), Seen>;

pub(super) fn has(
    world: &mut Bench<'_>,
    at: usize,
    log: EventLog,
    event: EventCode,
    times: Option<u64>,
) -> Check {
    has_power(world, at)?;
    let logged = logged(world, at, log);
    let seen = logged.iter().filter(|logged| **logged == event).count() as u64;
    holds(is_often_enough(seen, times), || format!("unit {}: {}", at + 1, words(&logged)))
}

pub(super) fn is_empty(world: &mut Bench<'_>, at: usize, log: EventLog) -> Check {
    has_power(world, at)?;
    let logged = logged(world, at, log);
    holds(logged.is_empty(), || format!("unit {}: {}", at + 1, words(&logged)))
}

pub(super) fn message(world: &mut Bench<'_>, at: usize, number: Option<u8>, event: EventCode) -> Check {
    has_power(world, at)?;
    let unit = world.unit(at);
    let message =
        number.or(unit.newest_diagnosis_message()).and_then(|number| unit.diagnosis_message(number));
    let seen = message.map(|code| EventCode(code.0));
    holds(seen == Some(event), || match seen {
        Some(seen) => format!("it is {seen}"),
        None => "there is no such message".to_owned(),
    })
}

pub(super) fn message_bytes(world: &mut Bench<'_>, at: usize, number: u8, wanted: &Bytes) -> Check {
    has_power(world, at)?;
    let sub = number.saturating_add(BEFORE_MESSAGES);
    let message = world.object(at, HISTORY, SubIndex(sub)).unwrap_or_default();
    let is_there = world.unit(at).diagnosis_message(number).is_some();
    let outside = |(place, _): &(usize, u8)| !TIME_STAMP.contains(place);
    let seen: Vec<u8> = message.into_iter().enumerate().filter(outside).map(|(_, byte)| byte).collect();
    holds(is_there && seen.starts_with(&wanted.0), || {
        if is_there { format!("they are {}", hex(&seen)) } else { "there is no such message".to_owned() }
    })
}

pub(super) fn message_count(world: &mut Bench<'_>, at: usize, count: u64) -> Check {
    has_power(world, at)?;
    let logged = logged(world, at, EventLog::System);
    holds(logged.len() as u64 == count, || {
        format!("unit {} has {}: {}", at + 1, logged.len(), words(&logged))
    })
}

/// The events in a log, the oldest first.
fn logged(world: &Bench<'_>, at: usize, log: EventLog) -> Vec<EventCode> {
    let log = match log {
        EventLog::System => unit_model::EventLog::System,
        EventLog::Access => unit_model::EventLog::Access,
    };
    world.unit(at).logged(log).into_iter().map(|code| EventCode(code.0)).collect()
}

fn words(logged: &[EventCode]) -> String {
    if logged.is_empty() {
        return "the log is empty".to_owned();
    }
    let codes: Vec<String> = logged.iter().map(EventCode::to_string).collect();
    format!("the log has {}", codes.join(", "))
}
