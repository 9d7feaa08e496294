//! What a step orders, and of whom.

use nx_ect101::{EventLog, Fault};
use plc::OperatingMode;
use time::Duration;
use wire::AlState;

use crate::expectation::Condition;

/// Which units a sentence is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnitSet {
    /// All of them.
    All,
    /// The one at this position, counted from 0.
    One(usize),
}

impl UnitSet {
    /// Positions of the units of a line of `count`.
    pub fn positions(self, count: usize) -> core::ops::Range<usize> {
        match self {
            Self::All => 0..count,
            Self::One(at) => at..(at + 1).min(count),
        }
    }
}

/// Which frames a fault meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameKind {
    /// All.
    Any,
    /// Those of the cyclic exchange.
    ProcessData,
    /// Those that read or write a mailbox.
    Mailbox,
}

/// What one step does.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Order {
    /// The scripted master.
    Master(MasterOrder),
    /// Hands on a unit.
    Unit(UnitOrder),
    /// Its CPU Unit.
    Cpu(CpuOrder),
    /// The line.
    Line(LineOrder),
    /// What has to hold.
    Expect(Expectation),
}

/// What the scripted master does. It works off its orders one after the other, in virtual time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MasterOrder {
    /// Takes units to a state by the way of a real master.
    Take(UnitSet, AlState),
    /// Writes AL control once, whatever follows.
    Request {
        /// Of whom.
        units: UnitSet,
        /// The state bits.
        state: AlState,
        /// Bit 4.
        acknowledge: bool,
    },
    /// Sets the cycle of the process data; they begin with SAFE-OP.
    Exchange(Duration),
    /// Sends no process data any more.
    StopExchange,
    /// Output bytes of a unit, from this place on.
    SetOutputs(usize, usize, Vec<u8>),
    /// Entries of a PDO, in force the next time that PRE-OP is passed.
    Map(usize, u16, Vec<(u16, u8)>),
    /// PDOs of an assignment object, in force the next time that PRE-OP is passed.
    Assign(usize, u16, Vec<u16>),
    /// Lets a SyncManager be set wrongly the next times: its length.
    SyncManagerLength {
        /// Of which unit.
        unit: usize,
        /// Which SyncManager.
        number: u8,
        /// The length in bytes.
        length_bytes: u16,
    },
    /// Lets a SyncManager be set wrongly the next times: its control byte.
    SyncManagerControl {
        /// Of which unit.
        unit: usize,
        /// Which SyncManager.
        number: u8,
        /// The control byte.
        control: u8,
    },
    /// An SDO download.
    WriteSdo(usize, (u16, u8), Vec<u8>),
    /// An SDO upload.
    ReadSdo(usize, (u16, u8)),
    /// A write to the ESC.
    WriteRegister(usize, u16, Vec<u8>),
    /// A write to the ESC in two frames, one for each half.
    WriteInHalves(usize, u16, Vec<u8>),
    /// Uses this mailbox counter from now on, instead of counting.
    MailboxCounter(u8),
    /// Lets the answers lie in the mailboxes.
    ReadNoMailbox,
    /// Does everything right again: counters, lengths, mailboxes.
    Behave,
    /// Starts anew: forgets every order and what it has set.
    Restart,
}

/// What is done to a unit by hand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum UnitOrder {
    /// Restart by support software.
    Restart(UnitSet),
    /// Off and on at once.
    CyclePower(UnitSet),
    /// Off.
    PowerOff(UnitSet),
    /// On.
    PowerOn(UnitSet),
    /// Resets the errors.
    ResetErrors(UnitSet),
    /// Clears a log.
    ClearLog(UnitSet, EventLog),
    /// Turns the ID switch.
    SetIdSwitch(usize, u8),
    /// Flips every bit of a word of the EEPROM.
    SpoilSii(usize, u16),
    /// Erases the EEPROM.
    EraseSii(UnitSet),
    /// Changes how it behaves as a slave.
    Conduct(UnitSet, ConductOrder),
    /// The cause of a fault appears.
    Inject(UnitSet, Fault),
    /// The cause of a fault disappears.
    Remove(UnitSet, Fault),
}

/// How a unit behaves as a slave, until it is told otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConductOrder {
    /// Every transition takes this time.
    EveryTransition(Duration),
    /// The transition with these letters takes this time.
    Transition(&'static str, Duration),
    /// Each SII command takes this time.
    SiiTime(Duration),
    /// The SII is busy for this time from now on.
    SiiBusy(Duration),
    /// An SDO is answered after this time.
    SdoTime(Duration),
    /// A state is refused with this AL status code.
    Refuse(AlState, u16),
    /// The acknowledge of an error is ignored.
    IgnoreAcknowledge,
    /// Times are those of the unit file again, and nothing else is refused or ignored.
    Behave,
}

/// What is done to a CPU Unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CpuOrder {
    /// Changes the mode.
    SetMode(UnitSet, OperatingMode),
    /// Stops or starts I/O refreshing.
    SetIoRefreshing(UnitSet, bool),
    /// Stops or starts the primary periodic task.
    SetTaskRunning(UnitSet, bool),
    /// All bytes C to M.
    SetInputs(usize, Vec<u8>),
    /// The system time jumps ahead.
    JumpTime(UnitSet, Duration),
    /// Fixes a device variable, or an element of it, at a value until it is released.
    Force {
        /// Its name.
        variable: String,
        /// The value as text.
        value: String,
    },
    /// Writes a device variable, or an element of it, once.
    Write {
        /// Its name.
        variable: String,
        /// The value as text.
        value: String,
    },
    /// Releases a device variable, or an element of it.
    Release(String),
    /// Releases everything.
    ReleaseAll(UnitSet),
    /// Resets the errors of the NX Bus Function Module, and those of the unit.
    ResetNxBus(UnitSet),
    /// Turns the power of CPU Unit and unit off, and on at once.
    CycleRackPower(UnitSet),
    /// Replaces the user program, in PROGRAM mode.
    Load {
        /// Of which unit.
        unit: usize,
        /// The file, as the step names it.
        file: String,
    },
}

/// What happens to the line between the master and the units.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LineOrder {
    /// Frames meet a fault.
    Disturb(Disturbance),
    /// The cable in front of the unit at this position, or behind the last one.
    Cable {
        /// Counted from 0, the one to the master.
        number: usize,
        /// Whether it is plugged in.
        plugged: bool,
    },
    /// No frame meets a fault any more.
    Quiet,
}

/// What happens to a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameFault {
    /// It gets lost on its way to the units.
    Lose,
    /// It passes the units, and its answer gets lost.
    LoseAnswer,
    /// It comes later.
    Delay(Duration),
    /// It comes twice.
    Duplicate,
    /// It ends early.
    Truncate(usize),
    /// A bit error on the cable in front of the unit at this position.
    Corrupt(usize),
    /// The working counters of its answer are one too low.
    WorkingCounter,
}

/// Which frames meet a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Disturbance {
    /// What happens to them.
    pub fault: FrameFault,
    /// Of which kind they are.
    pub kind: FrameKind,
    /// Which of them.
    pub choice: Choice,
}

/// Which frames of a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// So many, beginning with the next one.
    Next(u64),
    /// So many, behind so many others.
    Behind {
        /// Frames that are left alone first.
        skip: u64,
        /// Frames that meet the fault then.
        count: u64,
    },
    /// All from now on.
    All,
    /// Each with this probability, in per cent.
    Percent(u8),
}

/// What has to hold, and when.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expectation {
    /// What has to hold.
    pub condition: Condition,
    /// When.
    pub mode: Mode,
}

/// When an expectation has to hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Now.
    Now,
    /// At some moment before this time has passed.
    Within(Duration),
    /// At no moment, from now to the end.
    Never,
    /// At every moment until this time has passed.
    For(Duration),
    /// At every moment until this holds.
    Until(Condition),
    /// At no moment until this holds.
    NeverUntil(Condition),
}
