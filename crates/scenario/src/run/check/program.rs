//! Conditions of device variables and of user programs: their variables, and what they have reported.

use super::seen::{Seen, holds, is_often_enough, is_text, lie_at};
use plc::Reports;

use crate::model::{Bytes, Controller, Position, UserErrorCode};
use crate::run::bench::Bench;

type Check = Result<(), Seen>;

pub(super) fn variable_bytes(world: &Bench<'_>, variable: &str, bytes: &Bytes) -> Check {
    lie_at(&world.variable(variable).unwrap_or_default(), 0, bytes)
}

pub(super) fn variable_value(world: &Bench<'_>, variable: &str, value: &str) -> Check {
    is_text(world.variable_text(variable), value)
}

pub(super) fn variable_of(world: &Bench<'_>, controller: &Controller, name: &str, value: &str) -> Check {
    is_text(world.program_variable(controller, name), value)
}

pub(super) fn user_defined_error(
    world: &Bench<'_>,
    controller: &Controller,
    code: UserErrorCode,
    times: Option<u64>,
) -> Check {
    let story = story(world, controller)?;
    let (seen, stands) = story.alarm(code.0);
    let is_so = if times.is_some() { is_often_enough(seen, times) } else { stands };
    holds(is_so, || story.alarm_words())
}

pub(super) fn no_user_defined_error(world: &Bench<'_>, controller: &Controller) -> Check {
    let story = story(world, controller)?;
    holds(!story.has_alarms(), || story.alarm_words())
}

pub(super) fn task_overrun(world: &Bench<'_>, controller: &Controller, wanted: bool) -> Check {
    let overruns = story(world, controller)?.overruns();
    holds((overruns > 0) == wanted, || format!("there were {overruns} overruns"))
}

pub(super) fn error(world: &Bench<'_>, controller: &Controller, position: Option<Position>) -> Check {
    let story = story(world, controller)?;
    let is_there = story.errors().iter().any(|trouble| {
        position.is_none_or(|Position { line, column }| (line, column) == (trouble.line, trouble.column))
    });
    holds(is_there, || story.error_words())
}

pub(super) fn no_error(world: &Bench<'_>, controller: &Controller) -> Check {
    let story = story(world, controller)?;
    holds(story.errors().is_empty(), || story.error_words())
}

fn story<'b>(world: &'b Bench<'_>, controller: &Controller) -> Result<&'b Reports, Seen> {
    world.told(controller).ok_or_else(|| Seen::not_there(format!("{controller} is not there")))
}
