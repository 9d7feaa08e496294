//! Orders of the scripted master.

use serde::{Deserialize, Serialize};
use time::Duration;
use wire::AlState;

use super::bytes::{Bytes, Entry};
use super::names::state;
use super::numbers::Hex;
use super::spelling::{nothing, text};
use super::units::{UnitNumber, UnitSet};

/// What the scripted master does. It works off its orders one after the other, in virtual time.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "the table of sentences says what each value means")]
pub enum MasterOrder {
    /// Takes units to a state by the way of a real master.
    Take {
        units: UnitSet,
        #[serde(with = "state")]
        state: AlState,
    },
    /// Writes AL control once, with bit 4 for an acknowledge.
    Request {
        units: UnitSet,
        #[serde(with = "state")]
        state: AlState,
        #[serde(default)]
        acknowledge: bool,
    },
    /// Sets the cycle of the process data, which begin with SAFE-OP.
    ExchangeProcessData {
        #[serde(with = "text")]
        every: Duration,
    },
    /// Sends no process data until they are exchanged again.
    #[serde(with = "nothing")]
    StopProcessData,
    /// Output bytes of a unit from byte `at` on.
    SetOutputs {
        unit: UnitNumber,
        #[serde(default)]
        at: u16,
        bytes: Bytes,
    },
    /// Entries of a PDO, in force the next time that PRE-OP is passed.
    MapPdo { unit: UnitNumber, pdo: Hex<u16>, entries: Vec<Entry> },
    /// PDOs of an assignment object, in force the next time that PRE-OP is passed.
    AssignPdos { unit: UnitNumber, object: Hex<u16>, pdos: Vec<Hex<u16>> },
    /// Lets a SyncManager be set wrongly the next times: its length.
    SetSyncManagerLength { unit: UnitNumber, number: u8, length_bytes: u16 },
    /// Lets a SyncManager be set wrongly the next times: its control byte.
    SetSyncManagerControl { unit: UnitNumber, number: u8, control: Hex<u8> },
    /// An SDO download.
    WriteSdo { unit: UnitNumber, entry: Entry, value: Bytes },
    /// An SDO upload.
    ReadSdo { unit: UnitNumber, entry: Entry },
    /// A write to the ESC.
    WriteRegister { unit: UnitNumber, register: Hex<u16>, bytes: Bytes },
    /// A write to the ESC in two frames, one for each half.
    WriteRegisterInHalves { unit: UnitNumber, register: Hex<u16>, bytes: Bytes },
    /// Uses this mailbox counter from now on, instead of counting.
    UseMailboxCounter { counter: u8 },
    /// Leaves the answers in the mailboxes.
    #[serde(with = "nothing")]
    ReadNoMailbox,
    /// Does everything right again: counters, lengths, mailboxes.
    #[serde(with = "nothing")]
    Behave,
    /// Starts again: forgets every order and what it has set.
    #[serde(with = "nothing")]
    Restart,
}
