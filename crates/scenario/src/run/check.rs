//! Whether a condition holds in a world, and what is seen where it does not.

mod program;

use wire::{ObjectIndex, SubIndex};

use super::world::World;
use crate::model::{Condition, hex};

/// What was seen instead.
pub(crate) type Seen = String;

impl Condition {
    /// Whether it holds now; else what is seen instead.
    pub(crate) fn check(&self, world: &mut World) -> Result<(), Seen> {
        match (self.units(), self.controller()) {
            (Some(units), _) => units.positions(world.count()).try_for_each(|at| self.check_unit(at, world)),
            (None, Some(controller)) => self.check_program(controller, world),
            (None, None) => self.check_master(world),
        }
    }

    fn check_unit(&self, at: usize, world: &mut World) -> Result<(), Seen> {
        let name = format!("unit {}", at + 1);
        match self {
            Self::State { state, code, .. } => {
                let (status, shown) = world.al_status(at);
                let shown_code = status.error.then_some(shown.0);
                let words = world.state_words(at);
                holds((status.state, shown_code) == (*state, *code), || format!("{name} is in {words}"))
            }
            Self::Recorded { event, times, .. } => {
                let seen = world.recorded(at).iter().filter(|code| *code == event).count() as u64;
                let enough = times.map_or(seen > 0, |times| seen == times);
                holds(enough, || format!("{name} has recorded it {seen} times; {}", world.recorded_words(at)))
            }
            Self::RecordedNothing(_) => {
                holds(world.recorded(at).is_empty(), || format!("{name}: {}", world.recorded_words(at)))
            }
            Self::HasError { event, .. } => {
                let errors = world.current_errors(at);
                holds(errors.contains(event), || format!("{name} has {}", world.current_error_words(at)))
            }
            Self::HasNoError(_) => {
                let status = world.unit(at).error_status();
                let words =
                    || format!("{name} has {}, error status {status:#04X}", world.current_error_words(at));
                holds(status == 0, words)
            }
            Self::NewMessages { available, .. } => {
                let seen = world.unit(at).has_new_messages();
                holds(seen == *available, || format!("{name}: New Messages Available is {}", truth(seen)))
            }
            Self::Object { entry, value, .. } => {
                let seen = world.object(at, ObjectIndex(entry.0), SubIndex(entry.1));
                holds(seen.as_deref() == Ok(value), || match &seen {
                    Ok(seen) => format!("it is {}", hex(seen)),
                    Err(code) => format!("it is refused with {:#010X}", code.0),
                })
            }
            Self::Register { offset, value, .. } => {
                let seen = world.registers(at, *offset, value.len());
                holds(seen == *value, || format!("it is {}", hex(&seen)))
            }
            Self::Outputs { bytes, .. } => begins(world.io(at).m_to_c(), bytes),
            Self::OutputsFrom { at: first, bytes, .. } => {
                begins(world.io(at).m_to_c().get(*first..).unwrap_or_default(), bytes)
            }
            Self::DirectionValid { m_to_c, valid, .. } => {
                let status = world.unit(at).slave_status();
                let seen = if *m_to_c { status.m_to_c_valid } else { status.c_to_m_valid };
                holds(seen == *valid, || format!("{name}: it is {}", truth(seen)))
            }
            Self::Inputs { at: first, bytes, .. } => {
                begins(world.inputs(at).get(*first..).unwrap_or_default(), bytes)
            }
            Self::DataValid { valid, .. } => {
                let status = world.unit(at).slave_status();
                let seen = [status.m_to_c_valid, status.c_to_m_valid];
                holds(seen == [*valid; 2], || {
                    format!("{name}: M to C valid is {}, C to M valid is {}", truth(seen[0]), truth(seen[1]))
                })
            }
            Self::IoDataActive { active, .. } => {
                let seen = world.io(at).io_data_active();
                holds(seen == *active, || {
                    format!("{name}: NX Unit I/O Data Active Status is {}", truth(seen))
                })
            }
            Self::UnitError { error, .. } => {
                let seen = world.io(at).unit_error();
                holds(seen == *error, || format!("{name}: NX Unit Error Status is {}", truth(seen)))
            }
            Self::Shows { indicator, pattern, .. } => {
                let seen = world.indicator(at, *indicator);
                holds(seen == *pattern, || format!("{name}: it is {}", seen.id()))
            }
            Self::WorkingCounter { value, .. } => {
                let seen = world.working_counter(at);
                holds(seen == Some(*value), || match seen {
                    Some(seen) => format!("it is {seen}"),
                    None => "no process data came back".to_owned(),
                })
            }
            _ => Ok(()),
        }
    }

    fn check_master(&self, world: &mut World) -> Result<(), Seen> {
        let world = &*world;
        let master = world.master();
        match self {
            Self::Variable { name, bytes } => begins(&world.variable(name).unwrap_or_default(), bytes),
            Self::Value { name, value } => is_text(world.variable_text(name), value),
            Self::Cycles(cycles) => {
                holds(master.cycles() >= *cycles, || format!("{} cycles are done", master.cycles()))
            }
            Self::MasterIdle => {
                holds(master.is_idle(), || format!("the master is at: {}", master.activity()))
            }
            Self::MasterGaveUp => {
                holds(master.gave_up().is_some(), || "the master has not given up".to_owned())
            }
            Self::SdoRefused(code) => {
                holds(master.last_sdo().result() == Some(&Err(*code)), || master.last_sdo().words())
            }
            Self::SdoGave(bytes) => {
                holds(master.last_sdo().result() == Some(&Ok(bytes.clone())), || master.last_sdo().words())
            }
            Self::SdoTaken => {
                holds(matches!(master.last_sdo().result(), Some(Ok(_))), || master.last_sdo().words())
            }
            Self::Emergency { code, times } => {
                let seen = master.emergencies().iter().filter(|received| *received == code).count() as u64;
                let enough = times.map_or(seen > 0, |times| seen == times);
                let all: Vec<String> =
                    master.emergencies().iter().map(|code| format!("{code:04X}")).collect();
                holds(enough, || format!("it came {seen} times; all that came: [{}]", all.join(", ")))
            }
            Self::CaptureReplayed => {
                holds(world.recorded_master().is_done(), || world.recorded_master().progress())
            }
            Self::AnswersDiffer { at_most } => {
                let recorded = world.recorded_master();
                let count = recorded.difference_count();
                holds(count <= *at_most, || {
                    format!("{count} answers differ; {}", recorded.differences().join("; "))
                })
            }
            _ => Ok(()),
        }
    }
}

fn holds(condition: bool, seen: impl FnOnce() -> Seen) -> Result<(), Seen> {
    if condition { Ok(()) } else { Err(seen()) }
}

fn begins(seen: &[u8], wanted: &[u8]) -> Result<(), Seen> {
    let head = seen.get(..wanted.len()).unwrap_or(seen);
    holds(head == wanted, || format!("they are {}", hex(head)))
}

fn is_text(seen: Option<String>, wanted: &str) -> Result<(), Seen> {
    holds(seen.as_deref() == Some(wanted), || match seen {
        Some(seen) => format!("it is {seen}"),
        None => "it is not there".to_owned(),
    })
}

fn truth(value: bool) -> &'static str {
    if value { "TRUE" } else { "FALSE" }
}
