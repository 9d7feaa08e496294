//! Conditions: what can be true.

use serde::{Deserialize, Serialize};
use time::Duration;
use wire::AlState;

use super::act::MasterAct;
use super::bytes::{Bytes, Entry};
use super::names::{IndicatorName, Position, state};
use super::numbers::{EventCode, Hex, UserErrorCode};
use super::spelling::{nothing, text};
use super::unit::EventLog;
use super::units::{Controller, UnitSet, WhichUnit};
use super::value::{Quantity, Test};

/// What can be true.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "the table of sentences says what each one means")]
pub enum Condition {
    /// Without a code: no error is indicated.
    State {
        units: UnitSet,
        #[serde(with = "state")]
        state: AlState,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        al_status_code: Option<Hex<u16>>,
    },
    /// Without times: at least once.
    Recorded {
        units: UnitSet,
        event: EventCode,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        times: Option<u64>,
    },
    /// Since the orders directly before the step.
    RecordedAgain {
        units: UnitSet,
        event: EventCode,
    },
    RecordedNothing {
        units: UnitSet,
    },
    HasError {
        units: UnitSet,
        event: EventCode,
    },
    HasNoError {
        units: UnitSet,
    },
    /// Of its events, its diagnosis history, its current errors and its emergencies none contradicts another.
    DiagnosisConsistent {
        units: UnitSet,
        consistent: bool,
    },
    NewMessages {
        units: UnitSet,
        available: bool,
    },
    Object {
        unit: WhichUnit,
        entry: Entry,
        value: Bytes,
    },
    Register {
        unit: WhichUnit,
        register: Hex<u16>,
        value: Bytes,
    },
    /// From byte `at` on, as in the CPU Unit.
    Outputs {
        unit: WhichUnit,
        #[serde(default)]
        at: u16,
        bytes: Bytes,
    },
    /// From byte `at` on, as in the master.
    Inputs {
        unit: WhichUnit,
        #[serde(default)]
        at: u16,
        bytes: Bytes,
    },
    /// Its first bytes, little endian.
    VariableBytes {
        variable: String,
        bytes: Bytes,
    },
    VariableValue {
        variable: String,
        value: String,
    },
    ProgramVariable {
        controller: Controller,
        name: String,
        value: String,
    },
    /// Without times: it was not reset.
    UserDefinedError {
        controller: Controller,
        code: UserErrorCode,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        times: Option<u64>,
    },
    NoUserDefinedError {
        controller: Controller,
    },
    TaskOverrun {
        controller: Controller,
    },
    NoTaskOverrun {
        controller: Controller,
    },
    /// Without a position: anywhere.
    ProgramError {
        controller: Controller,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        position: Option<Position>,
    },
    NoProgramError {
        controller: Controller,
    },
    DataValid {
        units: UnitSet,
        valid: bool,
    },
    DirectionValid {
        units: UnitSet,
        direction: DataDirection,
        valid: bool,
    },
    IoDataActive {
        units: UnitSet,
        active: bool,
    },
    UnitError {
        units: UnitSet,
        error: bool,
    },
    Indicator {
        indicator: IndicatorName,
        units: UnitSet,
        pattern: String,
    },
    WorkingCounter {
        unit: WhichUnit,
        value: u16,
    },
    Cycles {
        at_least: u64,
    },
    #[serde(with = "nothing")]
    MasterIdle,
    #[serde(with = "nothing")]
    MasterGaveUp,
    /// Since the orders directly before the step.
    #[serde(with = "nothing")]
    MasterGaveUpAgain,
    /// Without a unit: of all units, as in the next two.
    SdoRefused {
        #[serde(default, skip_serializing_if = "Option::is_none")]
        unit: Option<WhichUnit>,
        abort_code: Hex<u32>,
    },
    SdoGave {
        #[serde(default, skip_serializing_if = "Option::is_none")]
        unit: Option<WhichUnit>,
        value: Bytes,
    },
    SdoTaken {
        #[serde(default, skip_serializing_if = "Option::is_none")]
        unit: Option<WhichUnit>,
    },
    /// The value of the register that was ordered last.
    RegisterGave {
        value: Bytes,
    },
    /// The answer to the mailbox message that was sent last, with its header.
    MailboxGave {
        message: Bytes,
    },
    #[serde(with = "nothing")]
    MailboxSilent,
    /// The first bytes of the frame that was sent last, as it came back.
    FrameGave {
        frame: Bytes,
    },
    #[serde(with = "nothing")]
    FrameLost,
    #[serde(with = "nothing")]
    EveryWorkingCounterExpected,
    /// Without times: at least once. Without unit, register or data: any.
    Emergency {
        code: Hex<u16>,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        unit: Option<WhichUnit>,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        register: Option<Hex<u8>>,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        data: Option<Bytes>,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        times: Option<u64>,
    },
    /// Exactly this number, since each of the units was switched on.
    EmergenciesLost {
        units: UnitSet,
        times: u64,
    },
    /// Without times: at least once.
    EventLogHas {
        log: EventLog,
        units: UnitSet,
        event: EventCode,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        times: Option<u64>,
    },
    EventLogEmpty {
        log: EventLog,
        units: UnitSet,
    },
    /// By its number from 1, which is 10F3:06; without a number the newest one.
    DiagnosisMessage {
        unit: WhichUnit,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        number: Option<u8>,
        event: EventCode,
    },
    /// The bytes before and after its time stamp, from the first one on.
    DiagnosisMessageBytes {
        unit: WhichUnit,
        number: u8,
        bytes: Bytes,
    },
    /// Number of messages in the diagnosis history.
    DiagnosisMessages {
        units: UnitSet,
        count: u64,
    },
    /// Since the beginning. Without times: at least once.
    MasterHas {
        act: MasterAct,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        times: Option<u64>,
    },
    /// The first time of the one is before the first time of the other, or the other has not come.
    MasterHasBefore {
        first: MasterAct,
        then: MasterAct,
    },
    /// The mean of the last periods, with this deviation.
    ProcessDataCome {
        unit: WhichUnit,
        #[serde(with = "text")]
        period: Duration,
        percent: u8,
    },
    #[serde(with = "nothing")]
    CaptureReplayed,
    AnswersDiffer {
        at_most: u64,
    },
    /// A value passes a test.
    Value {
        of: Quantity,
        test: Test,
    },
    /// The part is false.
    Not(Box<Self>),
    /// Every part is true.
    AllOf(Vec<Self>),
    /// At least one part is true.
    AnyOf(Vec<Self>),
}

/// Maximum depth of conditions in conditions.
pub(crate) const LOGIC_DEPTH_MAX: usize = 16;

impl Condition {
    /// The conditions of which it consists; none for one that looks at the world itself.
    #[must_use]
    pub fn parts(&self) -> &[Self] {
        match self {
            Self::Not(part) => core::slice::from_ref(part),
            Self::AllOf(parts) | Self::AnyOf(parts) => parts,
            _ => &[],
        }
    }

    /// Whether it is false at the beginning of its step, because a value has not changed yet.
    pub(crate) fn needs_a_change(&self) -> bool {
        match self {
            Self::Value { test: Test::Changes, .. } => true,
            Self::AllOf(parts) => parts.iter().any(Self::needs_a_change),
            Self::AnyOf(parts) => parts.iter().all(Self::needs_a_change),
            _ => false,
        }
    }

    /// How deep its conditions are nested; 0 without parts.
    pub(crate) fn depth(&self) -> usize {
        self.parts().iter().map(|part| part.depth() + 1).max().unwrap_or(0)
    }
}

/// The direction of data between the EtherCAT master and the CPU Unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DataDirection {
    /// From the EtherCAT master to the CPU Unit.
    MToC,
    /// From the CPU Unit to the EtherCAT master.
    CToM,
}
