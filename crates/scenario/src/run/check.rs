//! Whether a condition is true in a world, and the actual state if it is not.
//!
//! Every condition has its arm: a condition that is missing here would always be true.

#![deny(clippy::wildcard_enum_match_arm)]

mod acts;
mod diagnosis;
mod emergency;
mod logic;
mod logs;
mod master;
mod program;
mod raw;
mod seen;
mod unit;
mod value;

use super::bench::Bench;
use super::observed::Observed;
use crate::model::{Condition, UnitSet, WhichUnit};

pub(super) use seen::Seen;
pub(super) use value::passes;
pub(crate) use value::{is_signed, register_bytes};

/// Whether a condition is true now; otherwise the actual state. `observed` has the values at the beginning of its step.
pub(super) fn check(
    condition: &Condition,
    observed: &mut Observed,
    world: &mut Bench<'_>,
) -> Result<(), Seen> {
    match condition {
        Condition::State { units, state, al_status_code } => {
            each(units, world, |world, at| unit::state(world, at, *state, *al_status_code))
        }
        Condition::Recorded { units, event, times } => {
            each(units, world, |world, at| unit::recorded(world, at, *event, *times))
        }
        Condition::RecordedAgain { units, event } => {
            each(units, world, |world, at| unit::recorded_again(world, at, *event))
        }
        Condition::RecordedNothing { units } => each(units, world, unit::recorded_nothing),
        Condition::HasError { units, event } => {
            each(units, world, |world, at| unit::has_error(world, at, *event))
        }
        Condition::HasNoError { units } => each(units, world, unit::has_no_error),
        Condition::DiagnosisConsistent { units, consistent } => {
            each(units, world, |world, at| diagnosis::is_consistent(world, at, *consistent))
        }
        Condition::NewMessages { units, available } => {
            each(units, world, |world, at| unit::new_messages(world, at, *available))
        }
        Condition::Object { unit, entry, value } => {
            of_unit(unit, world, |world, at| unit::object(world, at, *entry, value))
        }
        Condition::Register { unit, register, value } => {
            of_unit(unit, world, |world, at| unit::register(world, at, register.0, value))
        }
        Condition::Outputs { unit, at: first, bytes } => {
            of_unit(unit, world, |world, at| unit::outputs(world, at, *first, bytes))
        }
        Condition::Inputs { unit, at: first, bytes } => {
            of_unit(unit, world, |world, at| unit::inputs(world, at, *first, bytes))
        }
        Condition::DataValid { units, valid } => {
            each(units, world, |world, at| unit::data_valid(world, at, *valid))
        }
        Condition::DirectionValid { units, direction, valid } => {
            each(units, world, |world, at| unit::direction_valid(world, at, *direction, *valid))
        }
        Condition::IoDataActive { units, active } => {
            each(units, world, |world, at| unit::io_data_active(world, at, *active))
        }
        Condition::UnitError { units, error } => {
            each(units, world, |world, at| unit::error(world, at, *error))
        }
        Condition::Indicator { indicator, units, pattern } => {
            each(units, world, |world, at| unit::indicator(world, at, *indicator, pattern))
        }
        Condition::WorkingCounter { unit, value } => {
            of_unit(unit, world, |world, at| unit::working_counter(world, at, *value))
        }
        Condition::MasterHas { act, times } => acts::has(world, act, *times),
        Condition::MasterHasBefore { first, then } => acts::has_before(world, first, then),
        Condition::ProcessDataCome { unit, period, percent } => {
            of_unit(unit, world, |world, at| acts::process_data_come(world, at, *period, *percent))
        }
        Condition::VariableBytes { variable, bytes } => program::variable_bytes(world, variable, bytes),
        Condition::VariableValue { variable, value } => program::variable_value(world, variable, value),
        Condition::ProgramVariable { controller, name, value } => {
            program::variable_of(world, controller, name, value)
        }
        Condition::UserDefinedError { controller, code, times } => {
            program::user_defined_error(world, controller, *code, *times)
        }
        Condition::NoUserDefinedError { controller } => program::no_user_defined_error(world, controller),
        Condition::TaskOverrun { controller } => program::task_overrun(world, controller, true),
        Condition::NoTaskOverrun { controller } => program::task_overrun(world, controller, false),
        Condition::ProgramError { controller, position } => program::error(world, controller, *position),
        Condition::NoProgramError { controller } => program::no_error(world, controller),
        Condition::Cycles { at_least } => master::cycles(world, *at_least),
        Condition::MasterIdle => master::is_idle(world),
        Condition::MasterGaveUp => master::gave_up(world),
        Condition::MasterGaveUpAgain => master::gave_up_again(world),
        Condition::SdoRefused { unit, abort_code } => master::sdo_refused(world, unit.as_ref(), abort_code.0),
        Condition::SdoGave { unit, value } => master::sdo_gave(world, unit.as_ref(), value),
        Condition::SdoTaken { unit } => master::sdo_taken(world, unit.as_ref()),
        Condition::RegisterGave { value } => raw::register(world, value),
        Condition::MailboxGave { message } => raw::mailbox(world, message),
        Condition::MailboxSilent => raw::mailbox_is_silent(world),
        Condition::FrameGave { frame } => raw::frame(world, frame),
        Condition::FrameLost => raw::frame_is_lost(world),
        Condition::EveryWorkingCounterExpected => raw::working_counters(world),
        Condition::Emergency { code, unit, register, data, times } => {
            let wanted = emergency::Wanted {
                code: code.0,
                unit: unit.as_ref(),
                register: *register,
                data: data.as_ref(),
            };
            emergency::received(world, &wanted, *times)
        }
        Condition::EmergenciesLost { units, times } => {
            each(units, world, |world, at| emergency::lost(world, at, *times))
        }
        Condition::EventLogHas { log, units, event, times } => {
            each(units, world, |world, at| logs::has(world, at, *log, *event, *times))
        }
        Condition::EventLogEmpty { log, units } => {
            each(units, world, |world, at| logs::is_empty(world, at, *log))
        }
        Condition::DiagnosisMessage { unit, number, event } => {
            of_unit(unit, world, |world, at| logs::message(world, at, *number, *event))
        }
        Condition::DiagnosisMessageBytes { unit, number, bytes } => {
            of_unit(unit, world, |world, at| logs::message_bytes(world, at, *number, bytes))
        }
        Condition::DiagnosisMessages { units, count } => {
            each(units, world, |world, at| logs::message_count(world, at, *count))
        }
        Condition::CaptureReplayed => master::capture_replayed(world),
        Condition::AnswersDiffer { at_most } => master::answers_differ(world, *at_most),
        Condition::Value { of, test } => value::value(of, test, observed, world, check),
        Condition::Not(part) => logic::not(part, check(part, observed, world)),
        Condition::AllOf(parts) => logic::all_of(parts, |part| check(part, observed, world)),
        Condition::AnyOf(parts) => logic::any_of(parts, |part| check(part, observed, world)),
    }
}

/// Whether it is true for each of these units; false for a unit that does not exist.
fn each(
    units: &UnitSet,
    world: &mut Bench<'_>,
    mut check: impl FnMut(&mut Bench<'_>, usize) -> Result<(), Seen>,
) -> Result<(), Seen> {
    let mut positions = units.positions(world.count()).peekable();
    if positions.peek().is_none() {
        return Err(Seen::not_there(format!("{units}: not there")));
    }
    positions.try_for_each(|at| check(world, at))
}

/// The same for one unit.
fn of_unit(
    unit: &WhichUnit,
    world: &mut Bench<'_>,
    check: impl FnOnce(&mut Bench<'_>, usize) -> Result<(), Seen>,
) -> Result<(), Seen> {
    let at = unit.position();
    if at < world.count() { check(world, at) } else { Err(Seen::not_there(format!("{unit}: not there"))) }
}
