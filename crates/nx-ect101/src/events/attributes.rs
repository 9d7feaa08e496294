//! The attributes of events, in the words of `tables/events.toml`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// The recovery from an error (manual, 8-3-4, for the NX bus of CPU Units).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Recovery {
    /// Reset the error in the unit.
    ResetErrorInSlaveUnit,
    /// Make the I/O allocation settings again.
    RedoIoAllocationSettings,
    /// Cycle the power of the unit, or restart the NX bus.
    CycleUnitPowerOrRestartNxBus,
    /// Cycle the power of the unit.
    CycleSlaveUnitPower,
    /// Cycle the power of the unit.
    CycleUnitPower,
    /// Cycle the power of the unit, then reset the error in the NX Bus Function Module.
    CycleNxUnitPowerThenResetErrorInNxBusFm,
    /// Restart the unit, then reset the error, where the fail-soft setting determines.
    RestartNxUnitThenResetErrorByFailsoft,
    /// Reset the error, where the fail-soft setting determines.
    ResetErrorByFailsoft,
    /// No recovery is necessary.
    None,
}

/// The time at which an event is detected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum DetectionTiming {
    /// At power-on of the unit.
    NxUnitPowerOn,
    /// When EtherCAT communications are established.
    EcatCommunicationsEstablished,
    /// INIT to PRE-OP.
    InitToPreop,
    /// PRE-OP to SAFE-OP.
    PreopToSafeop,
    /// Any state transition.
    EcatStateTransition,
    /// Continuously.
    Continuous,
    /// During NX message communications.
    NxMessageCommunications,
    /// When a user commands it.
    UserCommand,
    /// Not defined in the manual.
    Unspecified,
}

/// The effect of an event on I/O refreshing with the CPU Unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum IoRefreshEffect {
    /// It continues.
    Continues,
    /// It continues; data are exchanged as far as the sizes of both sides match.
    ContinuesPartialExchange,
    /// It does not start.
    NotPerformed,
    /// It stops.
    Stops,
    /// No effect.
    NotAffected,
    /// It starts again after the restart.
    ResumesAfterRestart,
}

/// The effect of an event on EtherCAT communications.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum EcatEffect {
    /// They stop in INIT and do not leave it again.
    StopInit,
    /// They remain in PRE-OP.
    StopPreop,
    /// They keep their state.
    RetainState,
    /// They go to SAFE-OP.
    EnterSafeop,
    /// No effect.
    NotAffected,
    /// They start again after the restart.
    Restart,
}

/// Whether an emergency message can report an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Notified {
    /// Possible.
    Possible,
    /// Not possible.
    NotPossible,
}

/// The effect of an event on an indicator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum IndicatorStatus {
    /// Lit.
    Lit,
    /// Not lit.
    NotLit,
    /// Flashing at intervals of 1 s.
    #[serde(rename = "flashing_1s")]
    Flashing1s,
    /// Flashing at intervals of 2 s.
    #[serde(rename = "flashing_2s")]
    Flashing2s,
    /// Flickering.
    Flickering,
    /// Blinking.
    Blinking,
    /// Single flash.
    SingleFlash,
    /// Double flash.
    DoubleFlash,
    /// Undefined in the manual: the event does not change the indicator.
    Undefined,
    /// The event is not in the manual's table of indicators.
    NotListed,
}

/// A piece of attached information of an event.
#[derive(Debug, Deserialize, Serialize)]
pub struct AttachedInformation {
    /// Its number, 1 to 4.
    pub n: u8,
    /// Its meaning.
    pub meaning: String,
    /// The meanings of its values, if the manual defines them.
    pub values: BTreeMap<String, String>,
}

/// A cause of an event.
#[derive(Debug, Deserialize, Serialize)]
pub struct Cause {
    /// The cause, a sentence.
    pub cause: String,
    /// The correction, a sentence.
    pub correction: String,
}

/// Eight hexadecimal digits.
pub(super) mod code {
    use serde::{Deserialize, Deserializer, Serializer};

    use crate::events::EventCode;

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<EventCode, D::Error> {
        let digits = String::deserialize(deserializer)?;
        u32::from_str_radix(&digits, 16).map(EventCode).map_err(serde::de::Error::custom)
    }

    pub(crate) fn serialize<S: Serializer>(code: &EventCode, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(code)
    }
}

/// Four hexadecimal digits, or "none".
pub(super) mod emergency_code {
    use serde::{Deserialize, Deserializer, Serializer};

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<u16>, D::Error> {
        let digits = String::deserialize(deserializer)?;
        if digits == "none" {
            return Ok(None);
        }
        u16::from_str_radix(&digits, 16).map(Some).map_err(serde::de::Error::custom)
    }

    pub(crate) fn serialize<S: Serializer>(code: &Option<u16>, serializer: S) -> Result<S::Ok, S::Error> {
        match code {
            Some(code) => serializer.collect_str(&format_args!("{code:04X}")),
            None => serializer.serialize_str("none"),
        }
    }
}

/// Four hexadecimal digits, or "none".
pub(super) mod al_status_code {
    use serde::{Deserializer, Serializer};
    use wire::AlStatusCode;

    use super::emergency_code;

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<AlStatusCode>, D::Error> {
        Ok(emergency_code::deserialize(deserializer)?.map(AlStatusCode))
    }

    pub(crate) fn serialize<S: Serializer>(
        code: &Option<AlStatusCode>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        emergency_code::serialize(&code.map(|code| code.0), serializer)
    }
}
