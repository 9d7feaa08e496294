//! What a master does to a unit, as the unit and its line see it: the same for a scripted master and for a real one.

use serde::{Deserialize, Serialize};
use wire::AlState;

use super::bytes::{Bytes, Entry};
use super::names::state;
use super::numbers::Hex;
use super::units::WhichUnit;

/// Something that a master can do to a unit.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "the table of sentences says what each one means")]
pub enum MasterAct {
    /// The unit has given a value.
    ReadSdo {
        unit: WhichUnit,
        entry: Entry,
    },
    /// The unit has taken the value; without a value, any.
    WriteSdo {
        unit: WhichUnit,
        entry: Entry,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        value: Option<Bytes>,
    },
    ReadRegister {
        unit: WhichUnit,
        register: Hex<u16>,
    },
    /// Without bytes, any.
    WriteRegister {
        unit: WhichUnit,
        register: Hex<u16>,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        bytes: Option<Bytes>,
    },
    ReadSiiWord {
        unit: WhichUnit,
        word: Hex<u16>,
    },
    /// With or without an acknowledge.
    RequestState {
        unit: WhichUnit,
        #[serde(with = "state")]
        state: AlState,
    },
    AcknowledgeError {
        unit: WhichUnit,
    },
    SendOutputs {
        unit: WhichUnit,
    },
    MiscountMailbox {
        unit: WhichUnit,
    },
}

impl MasterAct {
    /// The unit to which it is done.
    #[must_use]
    pub const fn unit(&self) -> &WhichUnit {
        match self {
            Self::ReadSdo { unit, .. }
            | Self::WriteSdo { unit, .. }
            | Self::ReadRegister { unit, .. }
            | Self::WriteRegister { unit, .. }
            | Self::ReadSiiWord { unit, .. }
            | Self::RequestState { unit, .. }
            | Self::AcknowledgeError { unit }
            | Self::SendOutputs { unit }
            | Self::MiscountMailbox { unit } => unit,
        }
    }

    pub(crate) const fn unit_mut(&mut self) -> &mut WhichUnit {
        match self {
            Self::ReadSdo { unit, .. }
            | Self::WriteSdo { unit, .. }
            | Self::ReadRegister { unit, .. }
            | Self::WriteRegister { unit, .. }
            | Self::ReadSiiWord { unit, .. }
            | Self::RequestState { unit, .. }
            | Self::AcknowledgeError { unit }
            | Self::SendOutputs { unit }
            | Self::MiscountMailbox { unit } => unit,
        }
    }
}
