//! Orders of the scripted master.

use time::Duration;
use wire::AlState;

use super::units::UnitSet;

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
