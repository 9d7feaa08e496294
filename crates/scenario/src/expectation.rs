//! Conditions: what can hold in a world, and what is seen where it does not.

mod program;

use core::fmt;

use nx_ect101::{EventCode, EventLevel, Pattern};
use wire::{AlState, ObjectIndex, SubIndex};

use crate::hex::hex;
use crate::orders::UnitSet;
use crate::programs::Controller;
use crate::sentence::IndicatorName;
use crate::world::World;

/// What can hold.
#[derive(Clone, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the table of sentences tells what each one means")]
pub enum Condition {
    State { units: UnitSet, state: AlState, code: Option<u16> },
    Recorded { units: UnitSet, event: EventCode, times: Option<u64> },
    RecordedNothing(UnitSet),
    HasError { units: UnitSet, event: EventCode },
    HasNoError(UnitSet),
    NewMessages { units: UnitSet, available: bool },
    Object { unit: usize, entry: (u16, u8), value: Vec<u8> },
    Variable { name: String, bytes: Vec<u8> },
    Value { name: String, value: String },
    ProgramVariable { of: Controller, name: String, value: String },
    UserDefinedError { at: Controller, code: u16, times: Option<u64> },
    NoUserDefinedError(Controller),
    TaskOverrun { of: Controller, seen: bool },
    ProgramError { of: Controller, position: Option<(usize, usize)> },
    NoProgramError(Controller),
    Register { unit: usize, offset: u16, value: Vec<u8> },
    Outputs { unit: usize, bytes: Vec<u8> },
    Inputs { unit: usize, at: usize, bytes: Vec<u8> },
    OutputsFrom { unit: usize, at: usize, bytes: Vec<u8> },
    DataValid { units: UnitSet, valid: bool },
    DirectionValid { units: UnitSet, m_to_c: bool, valid: bool },
    IoDataActive { units: UnitSet, active: bool },
    UnitError { units: UnitSet, error: bool },
    Shows { indicator: IndicatorName, units: UnitSet, pattern: Pattern },
    WorkingCounter { unit: usize, value: u16 },
    Cycles(u64),
    MasterIdle,
    MasterGaveUp,
    SdoRefused(u32),
    SdoGave(Vec<u8>),
    SdoTaken,
    Emergency { code: u16, times: Option<u64> },
    CaptureReplayed,
    AnswersDiffer { at_most: u64 },
}

/// What was seen instead.
pub(crate) type Seen = String;

impl Condition {
    /// The units that it names, for a check that they exist.
    pub(crate) fn units(&self) -> Option<UnitSet> {
        match self {
            Self::State { units, .. }
            | Self::Recorded { units, .. }
            | Self::RecordedNothing(units)
            | Self::HasError { units, .. }
            | Self::HasNoError(units)
            | Self::NewMessages { units, .. }
            | Self::DataValid { units, .. }
            | Self::DirectionValid { units, .. }
            | Self::IoDataActive { units, .. }
            | Self::UnitError { units, .. }
            | Self::Shows { units, .. } => Some(*units),
            Self::Object { unit, .. }
            | Self::Register { unit, .. }
            | Self::Outputs { unit, .. }
            | Self::OutputsFrom { unit, .. }
            | Self::Inputs { unit, .. }
            | Self::WorkingCounter { unit, .. } => Some(UnitSet::One(*unit)),
            Self::Cycles(_)
            | Self::MasterIdle
            | Self::MasterGaveUp
            | Self::SdoRefused(_)
            | Self::SdoGave(_)
            | Self::SdoTaken
            | Self::Variable { .. }
            | Self::Value { .. }
            | Self::ProgramVariable { .. }
            | Self::UserDefinedError { .. }
            | Self::NoUserDefinedError(_)
            | Self::TaskOverrun { .. }
            | Self::ProgramError { .. }
            | Self::NoProgramError(_)
            | Self::CaptureReplayed
            | Self::AnswersDiffer { .. }
            | Self::Emergency { .. } => None,
        }
    }

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
                holds(errors.contains(event), || format!("{name} has {}", codes(&errors)))
            }
            Self::HasNoError(_) => {
                let (status, errors) = (world.unit(at).error_status(), world.current_errors(at));
                holds(status == 0, || format!("{name} has {}, error status {status:#04X}", codes(&errors)))
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

pub(crate) fn codes(codes: &[EventCode]) -> String {
    let words: Vec<String> = codes.iter().map(EventCode::to_string).collect();
    if words.is_empty() { "no error".to_owned() } else { words.join(", ") }
}

/// The two levels of current errors, the more severe first.
pub(crate) const CURRENT: [EventLevel; 2] = [EventLevel::MinorFault, EventLevel::Observation];

/// A state as a sentence names it.
pub(crate) struct StateName(pub(crate) AlState);

impl fmt::Display for StateName {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            AlState::Init => formatter.write_str("INIT"),
            AlState::PreOp => formatter.write_str("PRE-OP"),
            AlState::SafeOp => formatter.write_str("SAFE-OP"),
            AlState::Op => formatter.write_str("OP"),
            AlState::Boot => formatter.write_str("BOOT"),
            AlState::Other(bits) => write!(formatter, "{bits:#04X}"),
        }
    }
}
