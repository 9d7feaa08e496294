//! What happens on a line and in its units, as small values: made in one place, for traces, logs and other programs.

use coe_kit::indicators::Pattern;
use esc::{Port, SmIndex};
use mailbox::{MessageNote, SdoNote};
use time::Instant;
use unit_model::RecordedEvent;
use wire::{AlStatus, AlStatusCode, Emergency};

/// Something that has happened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Happening {
    /// When.
    pub at: Instant,
    /// The position of its unit in the line, counted from 0; none: it concerns the whole line.
    pub position: Option<u16>,
    /// What.
    pub kind: HappeningKind,
}

/// What has happened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HappeningKind {
    /// A unit was switched on or off.
    Power {
        /// Whether it has power now.
        on: bool,
    },
    /// A unit shows another state or another AL status code.
    State {
        /// AL status before.
        before: AlStatus,
        /// AL status.
        status: AlStatus,
        /// AL status code.
        code: AlStatusCode,
    },
    /// A unit has recorded an event.
    Event(RecordedEvent),
    /// An emergency is ready for the master to read.
    Emergency(Emergency),
    /// Emergencies are lost: there was no room for them, or no mailbox.
    EmergenciesLost {
        /// Their number.
        count: u64,
    },
    /// An SDO has ended.
    Sdo(SdoNote),
    /// A unit has taken a mailbox message of the master.
    MessageReceived(MessageNote),
    /// A mailbox message is ready for the master to read.
    MessageSent(MessageNote),
    /// The process data of a SyncManager, when a unit has left PRE-OP for SAFE-OP.
    Mapping(Mapping),
    /// A port of a unit has a link, or has lost it.
    Link {
        /// The port.
        port: Port,
        /// Whether there is a link.
        present: bool,
    },
    /// An indicator has another pattern.
    Indicator {
        /// Its place in [`unit_model::Model::indicators`].
        place: u8,
        /// What it does now.
        pattern: Pattern,
    },
    /// The cause of a fault of a unit was injected, or removed.
    Fault {
        /// Its place in [`unit_model::Model::faults`].
        place: u8,
        /// Whether it is there now.
        injected: bool,
    },
    /// The medium to the master has lost its carrier, or has it again.
    Carrier {
        /// Whether there is a carrier.
        present: bool,
    },
    /// A master has begun to send frames, or has sent none for [`super::MASTER_GONE_AFTER`].
    Master {
        /// Whether it sends frames.
        present: bool,
    },
    /// A fault of frames has ended, by an order or by itself.
    FrameFaultEnded {
        /// Its number, counted from 1 on this line.
        number: u32,
    },
}

/// How a master has mapped the process data of a SyncManager.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mapping {
    /// The SyncManager.
    pub sync_manager: SmIndex,
    /// Whether the master writes it: outputs.
    pub is_outputs: bool,
    /// Its first byte in the memory of the ESC.
    pub physical_start: u16,
    /// Its length.
    pub length_bytes: u16,
    /// The first logical byte that an FMMU maps to it; none without one.
    pub logical_start: Option<u32>,
}
