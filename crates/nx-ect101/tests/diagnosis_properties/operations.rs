//! Random operations on a unit.

use device::Start;
use nx_ect101::{EventLevel, EventLog, Fault};
use proptest::prelude::*;
use proptest::sample::{Index, select, subsequence};
use wire::AlState;

use crate::rows::{MISMATCH_C_TO_M, MISMATCH_M_TO_C};

/// Maximum number of operations of one sequence.
const LENGTH_MAX: usize = 48;
/// The codes that the stack may find in the settings, in the order of their priority.
const AGAINST_SETTINGS: [u16; 5] = [0x001D, 0x001E, 0x0030, 0x0029, 0x001F];
/// Other codes of the stack: one code of BOOT and one without an event of the unit.
const AL_ERRORS: [u16; 8] = [0x0011, 0x0012, 0x0013, 0x0016, 0x001B, 0x001D, 0x001E, 0x0042];

/// The settings of a unit.
#[derive(Clone, Debug)]
pub(crate) struct Setup {
    pub(crate) io: Index,
    /// Object 10F3:03 reads the value written last.
    pub(crate) reads_last_acknowledged: bool,
    /// The user has set both mismatches to observation.
    pub(crate) mismatches_are_observations: bool,
}

/// One operation.
#[derive(Clone, Debug)]
pub(crate) enum Operation {
    Inject(Fault),
    Remove(Fault),
    AlErrors { code: u16, times: u8 },
    AskForPreOp { found: Vec<u16> },
    AskForSafeOp { setting: Index, found: Vec<u16> },
    AskForOp,
    Leave(AlState),
    Refresh { time_ns: u64, refreshing: bool },
    Write(Write),
    ResetErrors { times: u8 },
    ClearEventLog { log: EventLog, times: u8 },
    SetLevel { event: u32, level: EventLevel },
    Restart(Start),
    PowerCycle { damaged: bool },
    TakeEmergencies(usize),
}

/// An SDO download, correct or not.
#[derive(Clone, Debug)]
pub(crate) enum Write {
    Acknowledge(u8),
    AcknowledgeNewest,
    Flags(u16),
    ClearErrors(u8),
    ClearHistory(u32),
}

pub(crate) fn setups() -> impl Strategy<Value = Setup> {
    let setup = |(io, reads_last_acknowledged, mismatches_are_observations)| Setup {
        io,
        reads_last_acknowledged,
        mismatches_are_observations,
    };
    (any::<Index>(), any::<bool>(), any::<bool>()).prop_map(setup)
}

pub(crate) fn sequences() -> impl Strategy<Value = Vec<Operation>> {
    proptest::collection::vec(operations(), 1..=LENGTH_MAX)
}

fn operations() -> impl Strategy<Value = Operation> {
    prop_oneof![
        4 => faults().prop_map(Operation::Inject),
        4 => faults().prop_map(Operation::Remove),
        6 => al_errors(),
        1 => subsequence(vec![0x0051, 0x0016], 0..=2).prop_map(|found| Operation::AskForPreOp { found }),
        9 => ask_for_safe_op(),
        2 => Just(Operation::AskForOp),
        2 => select(vec![AlState::Init, AlState::PreOp, AlState::SafeOp]).prop_map(Operation::Leave),
        9 => refresh(),
        9 => writes().prop_map(Operation::Write),
        4 => often().prop_map(|times| Operation::ResetErrors { times }),
        1 => clear_event_log(),
        2 => set_level(),
        1 => select(vec![Start::PowerOn, Start::Restart, Start::Restart, Start::EscReset])
            .prop_map(Operation::Restart),
        1 => (0..10u8).prop_map(|dice| Operation::PowerCycle { damaged: dice == 0 }),
        2 => (0..20usize).prop_map(Operation::TakeEmergencies),
    ]
}

/// Those that do not change the state of the unit are more frequent, so that there are more reports.
fn faults() -> impl Strategy<Value = Fault> {
    prop_oneof![
        select(Fault::ALL.to_vec()),
        select(vec![Fault::IoCommunications, Fault::SmEventMode, Fault::MessageCommunications]),
    ]
}

fn al_errors() -> impl Strategy<Value = Operation> {
    (select(AL_ERRORS.to_vec()), often()).prop_map(|(code, times)| Operation::AlErrors { code, times })
}

/// Usually once, and sometimes more often than there are records.
fn often() -> impl Strategy<Value = u8> {
    prop_oneof![9 => Just(1), 1 => 2..=40u8]
}

fn clear_event_log() -> impl Strategy<Value = Operation> {
    let log = select(vec![EventLog::System, EventLog::Access, EventLog::None]);
    (log, often()).prop_map(|(log, times)| Operation::ClearEventLog { log, times })
}

fn ask_for_safe_op() -> impl Strategy<Value = Operation> {
    let found = prop_oneof![2 => Just(vec![]), 1 => subsequence(AGAINST_SETTINGS.to_vec(), 0..=5)];
    let operation = |(setting, found)| Operation::AskForSafeOp { setting, found };
    (any::<Index>(), found).prop_map(operation)
}

fn refresh() -> impl Strategy<Value = Operation> {
    let time_ns = prop_oneof![Just(0), any::<u64>()];
    (time_ns, any::<bool>()).prop_map(|(time_ns, refreshing)| Operation::Refresh { time_ns, refreshing })
}

fn writes() -> impl Strategy<Value = Write> {
    prop_oneof![
        3 => prop_oneof![0..=0x28u8, any::<u8>()].prop_map(Write::Acknowledge),
        3 => Just(Write::AcknowledgeNewest),
        4 => prop_oneof![9 => Just(1), 2 => 0..=3u16, 1 => any::<u16>()].prop_map(Write::Flags),
        1 => prop_oneof![Just(1), any::<u8>()].prop_map(Write::ClearErrors),
        1 => prop_oneof![Just(0x6C63_6C65), Just(0x6C63_6C64), any::<u32>()].prop_map(Write::ClearHistory),
    ]
}

fn set_level() -> impl Strategy<Value = Operation> {
    let events = select(vec![MISMATCH_M_TO_C, MISMATCH_C_TO_M, 0x8022_0000, 0x3509_0000, 0x1234_0000]);
    let levels = select(vec![EventLevel::Observation, EventLevel::MinorFault, EventLevel::Information]);
    (events, levels).prop_map(|(event, level)| Operation::SetLevel { event, level })
}
