//! Conditions of one unit, at a position of the line.

use coe_kit::indicators::Pattern;
use user_file::times as times_words;
use wire::{AlState, ObjectIndex, SubIndex};

use super::seen::{Seen, holds, is_often_enough, lie_at, truth};
use crate::model::{Bytes, DataDirection, Entry, EventCode, Hex, IndicatorName, hex};
use crate::run::bench::Bench;

type Check = Result<(), Seen>;

fn name(at: usize) -> String {
    format!("unit {}", at + 1)
}

/// A unit without power is in no state, and shows nothing that is inside it.
pub(super) fn has_power(world: &Bench<'_>, at: usize) -> Check {
    holds(!world.is_off(at), || format!("{} has no power", name(at)))
}

/// The same, for what `not` does not turn into its contrary.
pub(super) fn is_readable(world: &Bench<'_>, at: usize) -> Check {
    has_power(world, at).map_err(Seen::not_readable)
}

pub(super) fn state(world: &mut Bench<'_>, at: usize, state: AlState, code: Option<Hex<u16>>) -> Check {
    has_power(world, at)?;
    let (status, shown) = world.al_status(at);
    let shown_code = status.error.then_some(Hex(shown.0));
    let is_there = (status.state, shown_code) == (state, code);
    holds(is_there, || format!("{} is in {}", name(at), world.state_words(at)))
}

pub(super) fn recorded(world: &mut Bench<'_>, at: usize, event: EventCode, times: Option<u64>) -> Check {
    has_power(world, at)?;
    let seen = world.recorded_times(at, unit_model::EventCode(event.0));
    holds(is_often_enough(seen, times), || {
        format!("{} has recorded it {}; {}", name(at), times_words(seen), world.recorded_words(at))
    })
}

pub(super) fn recorded_again(world: &mut Bench<'_>, at: usize, event: EventCode) -> Check {
    has_power(world, at)?;
    let event = unit_model::EventCode(event.0);
    holds(world.has_recorded_again(at, event), || {
        let times = times_words(world.recorded_times(at, event));
        format!("{} has recorded it {times}, not since the order before", name(at))
    })
}

pub(super) fn recorded_nothing(world: &mut Bench<'_>, at: usize) -> Check {
    has_power(world, at)?;
    holds(world.recorded(at).is_empty(), || format!("{}: {}", name(at), world.recorded_words(at)))
}

pub(super) fn has_error(world: &mut Bench<'_>, at: usize, event: EventCode) -> Check {
    has_power(world, at)?;
    let is_there = world.current_errors(at).iter().any(|code| code.0 == event.0);
    holds(is_there, || format!("{} has {}", name(at), world.current_error_words(at)))
}

pub(super) fn has_no_error(world: &mut Bench<'_>, at: usize) -> Check {
    has_power(world, at)?;
    let status = world.unit(at).error_status();
    let (al_status, _) = world.al_status(at);
    if al_status.error && world.unit(at).model().tables().events.is_empty() {
        return Err(format!("{} is in {}", name(at), world.state_words(at)).into());
    }
    holds(status == 0, || {
        format!("{} has {}, error status {status:#04X}", name(at), world.current_error_words(at))
    })
}

pub(super) fn new_messages(world: &mut Bench<'_>, at: usize, available: bool) -> Check {
    has_power(world, at)?;
    let seen = world.unit(at).has_new_messages();
    holds(seen == available, || format!("{}: New Messages Available is {}", name(at), truth(seen)))
}

pub(super) fn object(world: &mut Bench<'_>, at: usize, entry: Entry, value: &Bytes) -> Check {
    has_power(world, at)?;
    let seen = world.object(at, ObjectIndex(entry.index), SubIndex(entry.sub));
    holds(seen.as_ref() == Ok(&value.0), || match &seen {
        Ok(seen) => format!("it is {}", hex(seen)),
        Err(code) => format!("it is refused with {:#010X}", code.0),
    })
}

pub(super) fn register(world: &mut Bench<'_>, at: usize, register: u16, value: &Bytes) -> Check {
    has_power(world, at)?;
    let seen = world.registers(at, register, value.0.len());
    holds(seen == value.0, || format!("it is {}", hex(&seen)))
}

pub(super) fn outputs(world: &mut Bench<'_>, at: usize, first: u16, bytes: &Bytes) -> Check {
    has_power(world, at)?;
    lie_at(world.io(at).m_to_c(), first.into(), bytes)
}

pub(super) fn inputs(world: &mut Bench<'_>, at: usize, first: u16, bytes: &Bytes) -> Check {
    lie_at(world.inputs(at), first.into(), bytes)
}

pub(super) fn data_valid(world: &mut Bench<'_>, at: usize, valid: bool) -> Check {
    has_power(world, at)?;
    let status = world.unit(at).data_valid();
    let seen = [status.outputs, status.inputs];
    holds(seen == [valid; 2], || {
        let [m_to_c, c_to_m] = seen.map(truth);
        format!("{}: M to C valid is {m_to_c}, C to M valid is {c_to_m}", name(at))
    })
}

pub(super) fn direction_valid(
    world: &mut Bench<'_>,
    at: usize,
    direction: DataDirection,
    valid: bool,
) -> Check {
    has_power(world, at)?;
    let status = world.unit(at).data_valid();
    let seen = match direction {
        DataDirection::MToC => status.outputs,
        DataDirection::CToM => status.inputs,
    };
    holds(seen == valid, || format!("{}: it is {}", name(at), truth(seen)))
}

pub(super) fn io_data_active(world: &mut Bench<'_>, at: usize, active: bool) -> Check {
    has_power(world, at)?;
    let seen = world.io(at).io_data_active();
    holds(seen == active, || format!("{}: NX Unit I/O Data Active Status is {}", name(at), truth(seen)))
}

pub(super) fn error(world: &mut Bench<'_>, at: usize, error: bool) -> Check {
    let seen = world.io(at).unit_error();
    holds(seen == error, || format!("{}: NX Unit Error Status is {}", name(at), truth(seen)))
}

pub(super) fn indicator(world: &mut Bench<'_>, at: usize, indicator: IndicatorName, pattern: &str) -> Check {
    let seen = world.indicator(at, indicator).map(Pattern::id);
    holds(seen == Some(pattern), || match seen {
        Some(seen) => format!("{}: it is {seen}", name(at)),
        None => format!("{} has no indicator {indicator}", name(at)),
    })
}

pub(super) fn working_counter(world: &mut Bench<'_>, at: usize, value: u16) -> Check {
    let seen = world.working_counter(at);
    holds(seen == Some(value), || match seen {
        Some(seen) => format!("it is {seen}"),
        None => "no process data came back".to_owned(),
    })
}
