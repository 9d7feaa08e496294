//! Conditions of the scripted master and of the recorded one.

use super::seen::{Seen, holds};
use crate::model::{Bytes, WhichUnit};
use crate::run::bench::Bench;
use crate::run::master::Master;
use crate::run::recorded::Recorded;

type Check = Result<(), Seen>;

/// The scripted master.
pub(super) fn scripted<'b>(world: &'b Bench<'_>) -> Result<&'b Master, Seen> {
    world.master().ok_or_else(|| Seen::not_there("there is no scripted master"))
}

fn recorded<'b>(world: &'b Bench<'_>) -> Result<&'b Recorded, Seen> {
    world.recorded_master().ok_or_else(|| Seen::not_there("there is no recorded master"))
}

pub(super) fn cycles(world: &Bench<'_>, at_least: u64) -> Check {
    let cycles = scripted(world)?.cycles();
    holds(cycles >= at_least, || format!("{cycles} cycles are done"))
}

pub(super) fn is_idle(world: &Bench<'_>) -> Check {
    let master = scripted(world)?;
    holds(master.is_idle(), || format!("the master is at: {}", master.activity()))
}

pub(super) fn gave_up(world: &Bench<'_>) -> Check {
    holds(scripted(world)?.has_given_up(), || "the master has not given up".to_owned())
}

pub(super) fn gave_up_again(world: &Bench<'_>) -> Check {
    let master = scripted(world)?;
    holds(master.has_given_up_again(), || match master.has_given_up() {
        true => "the master has not given up since the order before".to_owned(),
        false => "the master has not given up".to_owned(),
    })
}

pub(super) fn sdo_refused(world: &Bench<'_>, unit: Option<&WhichUnit>, abort_code: u32) -> Check {
    let sdo = scripted(world)?.last_sdo(unit);
    holds(sdo.result() == Some(&Err(abort_code)), || sdo.words())
}

pub(super) fn sdo_gave(world: &Bench<'_>, unit: Option<&WhichUnit>, value: &Bytes) -> Check {
    let sdo = scripted(world)?.last_sdo(unit);
    let is_it = matches!(sdo.result(), Some(Ok(seen)) if *seen == value.0);
    holds(is_it, || sdo.words())
}

pub(super) fn sdo_taken(world: &Bench<'_>, unit: Option<&WhichUnit>) -> Check {
    let sdo = scripted(world)?.last_sdo(unit);
    holds(matches!(sdo.result(), Some(Ok(_))), || sdo.words())
}

pub(super) fn capture_replayed(world: &Bench<'_>) -> Check {
    let recorded = recorded(world)?;
    holds(recorded.is_done(), || recorded.progress())
}

pub(super) fn answers_differ(world: &Bench<'_>, at_most: u64) -> Check {
    let recorded = recorded(world)?;
    let count = recorded.difference_count();
    holds(count <= at_most, || format!("{count} answers differ; {}", recorded.differences().join("; ")))
}
