//! Conditions of the scripted master and of the recorded one.

use super::seen::{Seen, holds};
use crate::model::{Bytes, UnitNumber};
use crate::run::world::World;

type Check = Result<(), Seen>;

pub(super) fn cycles(world: &World, at_least: u64) -> Check {
    let cycles = world.master().cycles();
    holds(cycles >= at_least, || format!("{cycles} cycles are done"))
}

pub(super) fn is_idle(world: &World) -> Check {
    let master = world.master();
    holds(master.is_idle(), || format!("the master is at: {}", master.activity()))
}

pub(super) fn gave_up(world: &World) -> Check {
    holds(world.master().gave_up().is_some(), || "the master has not given up".to_owned())
}

pub(super) fn sdo_refused(world: &World, unit: Option<UnitNumber>, abort_code: u32) -> Check {
    let sdo = world.master().last_sdo(unit);
    holds(sdo.result() == Some(&Err(abort_code)), || sdo.words())
}

pub(super) fn sdo_gave(world: &World, unit: Option<UnitNumber>, value: &Bytes) -> Check {
    let sdo = world.master().last_sdo(unit);
    let is_it = matches!(sdo.result(), Some(Ok(seen)) if *seen == value.0);
    holds(is_it, || sdo.words())
}

pub(super) fn sdo_taken(world: &World, unit: Option<UnitNumber>) -> Check {
    let sdo = world.master().last_sdo(unit);
    holds(matches!(sdo.result(), Some(Ok(_))), || sdo.words())
}

pub(super) fn capture_replayed(world: &World) -> Check {
    let recorded = world.recorded_master();
    holds(recorded.is_done(), || recorded.progress())
}

pub(super) fn answers_differ(world: &World, at_most: u64) -> Check {
    let recorded = world.recorded_master();
    let count = recorded.difference_count();
    holds(count <= at_most, || format!("{count} answers differ; {}", recorded.differences().join("; ")))
}
