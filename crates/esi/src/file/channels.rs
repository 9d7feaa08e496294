//! FMMUs, SyncManagers and sync units.

use super::element::Element;
use super::place::Place;
use crate::lint::rules;
use crate::{FmmuUsage, SyncManagerType};

/// An element `Fmmu`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FmmuElement {
    /// Its place.
    pub place: Place,
    /// Its purpose; unused for a text that the schema does not have.
    pub usage: FmmuUsage,
    /// The SyncManager that it maps, if indicated.
    pub sync_manager: Option<u8>,
    /// The sync unit that it belongs to, if indicated.
    pub sync_unit: Option<u8>,
    /// Whether it is enabled in OP only.
    pub op_only: bool,
}

/// An element `Sm`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SyncManagerElement {
    /// Its place.
    pub place: Place,
    /// Its text; vendors have words of their own.
    pub text: String,
    /// The purpose that the text names; none if the text is empty or unknown.
    pub named_usage: Option<SyncManagerType>,
    /// Start address.
    pub start: Option<u16>,
    /// Control byte; none for a virtual SyncManager.
    pub control: Option<u8>,
    /// Enable byte.
    pub enable: Option<u8>,
    /// Length unless set otherwise.
    pub default_bytes: Option<u16>,
    /// Minimum length that a master may set.
    pub min_bytes: Option<u16>,
    /// Maximum length that a master may set.
    pub max_bytes: Option<u16>,
    /// Whether it has no registers of its own.
    pub is_virtual: bool,
    /// Whether it is enabled in OP only.
    pub op_only: bool,
    /// Whether it is read or written byte by byte.
    pub one_byte: bool,
    /// Whether the watchdog belongs to it, if indicated beside the control byte.
    pub watchdog: bool,
    /// The sync unit that it belongs to, if indicated.
    pub sync_unit: Option<u8>,
}

/// Mode of a SyncManager, bits 1 and 0 of its control byte.
const MODE_MASK: u8 = 0b11;
const MODE_MAILBOX: u8 = 0b10;
/// Bits 3 and 2: the master writes.
const DIRECTION_MASK: u8 = 0b11 << 2;
const MASTER_WRITES: u8 = 0b01 << 2;

impl SyncManagerElement {
    /// Whether its control byte lets the master write; none without a control byte.
    #[must_use]
    pub fn master_writes(&self) -> Option<bool> {
        Some(self.control? & DIRECTION_MASK == MASTER_WRITES)
    }

    /// Whether its control byte sets one buffer with handshake.
    #[must_use]
    pub fn has_one_buffer(&self) -> bool {
        self.control.is_some_and(|control| control & MODE_MASK == MODE_MAILBOX)
    }

    /// The enable byte as SII category 41 has it.
    #[must_use]
    pub fn enable_byte(&self) -> u8 {
        let flag = |set: bool, bit: u8| if set { 1 << bit } else { 0 };
        self.enable.unwrap_or(0) | flag(self.is_virtual, 2) | flag(self.op_only, 3)
    }

    pub(super) fn read(element: Element<'_>) -> Self {
        let text = element.text();
        let named_usage = match text {
            "MBoxOut" => Some(SyncManagerType::MailboxOut),
            "MBoxIn" => Some(SyncManagerType::MailboxIn),
            "Outputs" => Some(SyncManagerType::Outputs),
            "Inputs" => Some(SyncManagerType::Inputs),
            _ => None,
        };
        Self {
            place: element.place(),
            text: text.to_owned(),
            named_usage,
            start: element.number("StartAddress"),
            control: element.number("ControlByte"),
            enable: element.number("Enable"),
            default_bytes: element.number("DefaultSize"),
            min_bytes: element.number("MinSize"),
            max_bytes: element.number("MaxSize"),
            is_virtual: element.flag("Virtual"),
            op_only: element.flag("OpOnly"),
            one_byte: element.flag("OneByteMode"),
            watchdog: element.flag("Watchdog"),
            sync_unit: element.number("Su"),
        }
    }
}

impl FmmuElement {
    pub(super) fn read(element: Element<'_>) -> Self {
        let usage = match element.text() {
            "Outputs" | "DynamicOutputs" => FmmuUsage::Outputs,
            "Inputs" | "DynamicInputs" => FmmuUsage::Inputs,
            "MBoxState" => FmmuUsage::MailboxState,
            "" => FmmuUsage::Unused,
            _ => {
                element.value().report(rules::FMMU_TEXT, "is no purpose of an FMMU; read as unused");
                FmmuUsage::Unused
            }
        };
        Self {
            place: element.place(),
            usage,
            sync_manager: element.number("Sm"),
            sync_unit: element.number("Su"),
            op_only: element.flag("OpOnly"),
        }
    }
}

/// An element `Su`: SyncManagers whose data are consistent with each other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SyncUnit {
    /// Its place.
    pub place: Place,
    /// Its name.
    pub name: String,
    /// Whether its datagrams are separate from those of others.
    pub separate_sync_unit: bool,
    /// Whether its datagrams are in a frame of their own.
    pub separate_frame: bool,
    /// Whether it depends on the state of the inputs.
    pub depends_on_input_state: bool,
    /// Whether its frames may be repeated.
    pub frame_repeat_support: bool,
}

impl SyncUnit {
    pub(super) fn read(element: Element<'_>) -> Self {
        Self {
            place: element.place(),
            name: element.text().to_owned(),
            separate_sync_unit: element.flag("SeparateSu"),
            separate_frame: element.flag("SeparateFrame"),
            depends_on_input_state: element.flag("DependOnInputState"),
            frame_repeat_support: element.flag("FrameRepeatSupport"),
        }
    }
}
