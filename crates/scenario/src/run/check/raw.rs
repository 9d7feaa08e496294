//! Conditions of what the master has read without any service: registers, mailbox messages, frames, working counters.

use super::master::scripted;
use super::seen::{Seen, holds};
use crate::model::Bytes;
use crate::run::bench::Bench;
use crate::run::master::Kind;

type Check = Result<(), Seen>;

pub(super) fn register(world: &Bench<'_>, value: &Bytes) -> Check {
    let last = scripted(world)?.raw().register();
    holds(last.bytes() == Some(&value.0), || last.words(Kind::Register))
}

pub(super) fn mailbox(world: &Bench<'_>, message: &Bytes) -> Check {
    let last = scripted(world)?.raw().mailbox();
    holds(last.bytes() == Some(&message.0), || last.words(Kind::Mailbox))
}

pub(super) fn mailbox_is_silent(world: &Bench<'_>) -> Check {
    let last = scripted(world)?.raw().mailbox();
    holds(last.is_missing(), || last.words(Kind::Mailbox))
}

pub(super) fn frame(world: &Bench<'_>, frame: &Bytes) -> Check {
    let last = scripted(world)?.raw().frame();
    holds(last.bytes().is_some_and(|bytes| bytes.starts_with(&frame.0)), || last.words(Kind::Frame))
}

pub(super) fn frame_is_lost(world: &Bench<'_>) -> Check {
    let last = scripted(world)?.raw().frame();
    holds(last.is_missing(), || last.words(Kind::Frame))
}

pub(super) fn working_counters(world: &Bench<'_>) -> Check {
    let counters = scripted(world)?.working_counters();
    if counters.is_empty() {
        return Err(Seen::not_there("no process data are exchanged"));
    }
    let wrong = counters.iter().enumerate().find(|(_, (counter, expected))| *counter != Some(*expected));
    wrong.map_or(Ok(()), |(at, (counter, expected))| {
        let counter = counter.map_or("has not returned".to_owned(), |counter| format!("has {counter}"));
        Err(format!("datagram {} {counter}, expected {expected}", at + 1).into())
    })
}
