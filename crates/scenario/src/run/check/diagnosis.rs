//! Whether a unit's diagnosis agrees with its events: history, current errors, emergencies.

use unit_model::EventLevel;
use wire::{ObjectIndex, SubIndex};

use super::seen::{Seen, holds};
use super::unit::is_readable;
use crate::run::bench::Bench;
use crate::run::ledger::{FIRST, History, MESSAGES};

/// The diagnosis history of ETG.1020.
const HISTORY: ObjectIndex = ObjectIndex(0x10F3);

/// Whether nothing of it contradicts something else. A unit without power shows nothing: it is neither of the two.
pub(super) fn is_consistent(world: &mut Bench<'_>, at: usize, wanted: bool) -> Result<(), Seen> {
    is_readable(world, at)?;
    let contradiction = contradiction(world, at);
    holds(contradiction.is_none() == wanted, || {
        let unit = format!("unit {}", at + 1);
        contradiction
            .map_or_else(|| format!("{unit} shows no contradiction"), |words| format!("{unit}: {words}"))
    })
}

fn contradiction(world: &mut Bench<'_>, at: usize) -> Option<String> {
    let history = history(world, at)?;
    let flag = byte(world, at, 4)?;
    let has_new = world.unit(at).has_new_messages();
    if (flag != 0) != has_new {
        return Some(format!("10F3:04 is {flag}, and the process data have {has_new}"));
    }
    world
        .ledger_mut(at)
        .compare(&history)
        .err()
        .or_else(|| errors(world, at))
        .or_else(|| emergencies(world, at))
}

fn history(world: &mut Bench<'_>, at: usize) -> Option<History> {
    let (stored, newest) = (byte(world, at, 1)?, byte(world, at, 2)?);
    let subs = (FIRST..).take(MESSAGES);
    let messages = subs.map(|sub| world.object(at, HISTORY, SubIndex(sub)).unwrap_or_default()).collect();
    Some(History { stored, newest, messages })
}

fn byte(world: &mut Bench<'_>, at: usize, sub: u8) -> Option<u8> {
    world.object(at, HISTORY, SubIndex(sub)).ok()?.first().copied()
}

/// An error status without an error, or an error without it.
fn errors(world: &Bench<'_>, at: usize) -> Option<String> {
    let unit = world.unit(at);
    let (status, errors) = (unit.error_status(), world.current_errors(at).len());
    let minor_faults = unit.current_errors(EventLevel::MinorFault).len();
    ((status == 0) != (errors == 0))
        .then(|| format!("the error status is {status:02X}, and there are {errors} current errors, {minor_faults} of them minor faults"))
}

/// More emergencies of a code than events that have it.
fn emergencies(world: &Bench<'_>, at: usize) -> Option<String> {
    world.received_codes(at).into_iter().find_map(|(code, received)| {
        let recorded = world.recorded_with(at, code);
        (received > recorded).then(|| {
            format!(
                "the master has received emergency {code:04X} {received} times, and {recorded} events have it"
            )
        })
    })
}
