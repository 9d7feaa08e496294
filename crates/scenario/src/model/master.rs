//! Orders of the scripted master.

use serde::{Deserialize, Serialize};
use time::Duration;
use wire::AlState;

use super::bytes::{Bytes, Entry};
use super::names::state;
use super::numbers::Hex;
use super::spelling::{nothing, text};
use super::units::{UnitSet, WhichUnit};

/// An action of the scripted master. It executes its orders one after the other, in virtual time.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "the table of sentences says what each value means")]
pub enum MasterOrder {
    /// Takes units to a state with the sequence of a real master.
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
        unit: WhichUnit,
        #[serde(default)]
        at: u16,
        bytes: Bytes,
    },
    /// Entries of a PDO, effective at the next transition to PRE-OP.
    MapPdo { unit: WhichUnit, pdo: Hex<u16>, entries: Vec<Entry> },
    /// PDOs of an assignment object, effective at the next transition to PRE-OP.
    AssignPdos { unit: WhichUnit, object: Hex<u16>, pdos: Vec<Hex<u16>> },
    /// Sets a wrong length of a SyncManager from the next time on.
    SetSyncManagerLength { unit: WhichUnit, number: u8, length_bytes: u16 },
    /// Sets a wrong control byte of a SyncManager from the next time on.
    SetSyncManagerControl { unit: WhichUnit, number: u8, control: Hex<u8> },
    /// An SDO download.
    WriteSdo { unit: WhichUnit, entry: Entry, value: Bytes },
    /// An SDO upload.
    ReadSdo { unit: WhichUnit, entry: Entry },
    /// A write to the ESC.
    WriteRegister { unit: WhichUnit, register: Hex<u16>, bytes: Bytes },
    /// A write to the ESC in two frames, one for each half.
    WriteRegisterInHalves { unit: WhichUnit, register: Hex<u16>, bytes: Bytes },
    /// An SDO upload of a whole object, from subindex 0 or 1 on.
    ReadCompleteSdo { unit: WhichUnit, entry: Entry },
    /// An SDO download of a whole object, from subindex 0 or 1 on.
    WriteCompleteSdo { unit: WhichUnit, entry: Entry, value: Bytes },
    /// An SDO download in segments of seven bytes, however short the value is.
    WriteSdoInSegments { unit: WhichUnit, entry: Entry, value: Bytes },
    /// SDO information: the objects of a list, or the lengths of the lists.
    ReadObjectList { unit: WhichUnit, list: u16 },
    /// SDO information: the description of an object.
    DescribeObject { unit: WhichUnit, object: Hex<u16> },
    /// SDO information: the description of an entry.
    DescribeEntry { unit: WhichUnit, entry: Entry },
    /// A read of the ESC; without a length as long as the register.
    ReadRegister {
        unit: WhichUnit,
        register: Hex<u16>,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        length_bytes: Option<u16>,
    },
    /// A whole mailbox message, header first.
    SendMailboxMessage { unit: WhichUnit, message: Bytes },
    /// A whole Ethernet frame, without frame check sequence.
    SendFrame { frame: Bytes },
    /// Uses this mailbox counter from now on, instead of counting.
    UseMailboxCounter { counter: u8 },
    /// Leaves the answers in the mailboxes.
    #[serde(with = "nothing")]
    ReadNoMailbox,
    /// Does not look for emergencies any more.
    #[serde(with = "nothing")]
    ReadNoEmergencies,
    /// Corrects everything again: counters, lengths, mailboxes.
    #[serde(with = "nothing")]
    Behave,
    /// Restarts: discards all orders and all settings.
    #[serde(with = "nothing")]
    Restart,
}
