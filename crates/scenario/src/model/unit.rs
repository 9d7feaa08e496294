//! Actions on a unit by hand, and its conduct as a slave.

use serde::{Deserialize, Serialize};
use time::Duration;
use wire::AlState;

use super::names::state;
use super::numbers::Hex;
use super::spelling::text;
use super::units::{UnitSet, WhichUnit};

/// The name of the switch that gives a unit its ID.
pub(crate) const ID_SWITCH: &str = "ID";

/// An action on a unit by hand.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "the table of sentences says what each value means")]
pub enum UnitOrder {
    /// Restart by support software.
    Restart { units: UnitSet },
    /// Power off, and on again immediately.
    CyclePower { units: UnitSet },
    /// Power off.
    PowerOff { units: UnitSet },
    /// Power on.
    PowerOn { units: UnitSet },
    /// Resets the errors.
    ResetErrors { units: UnitSet },
    /// Clears a log.
    ClearEventLog { units: UnitSet, log: EventLog },
    /// Turns the ID switch.
    SetIdSwitch { unit: WhichUnit, id: Hex<u8> },
    /// Flips every bit of a word of the EEPROM.
    InvertSiiWord { unit: WhichUnit, word: u16 },
    /// Erases the EEPROM.
    EraseSii { units: UnitSet },
    /// Replaces the EEPROM by the image in this file, relative to the scenario.
    LoadSii {
        unit: WhichUnit,
        file: String,
        /// Also with defects.
        #[serde(default, skip_serializing_if = "core::ops::Not::not")]
        as_it_is: bool,
    },
    /// Another unit takes its place: that of this unit file, relative to the scenario.
    Replace { unit: WhichUnit, file: String },
    /// Changes its conduct as a slave.
    Conduct { units: UnitSet, conduct: ConductOrder },
    /// The cause of a fault appears, with its name in the unit model.
    InjectFault { units: UnitSet, fault: String },
    /// The cause of a fault disappears.
    RemoveFault { units: UnitSet, fault: String },
}

/// The unit that an order needs to have an effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Needs<'a> {
    /// Any: a hand changes its hardware, its supply or its settings.
    Nothing,
    /// One without power: it gets it.
    NoPower,
    /// One with power: its software or its communication carries out the order.
    Power,
    /// One in which this fault can occur.
    PowerForFault(&'a str),
}

impl UnitOrder {
    /// The units of the order.
    pub(crate) fn units(&self) -> UnitSet {
        match self {
            Self::Restart { units }
            | Self::CyclePower { units }
            | Self::PowerOff { units }
            | Self::PowerOn { units }
            | Self::ResetErrors { units }
            | Self::ClearEventLog { units, .. }
            | Self::EraseSii { units }
            | Self::Conduct { units, .. }
            | Self::InjectFault { units, .. }
            | Self::RemoveFault { units, .. } => units.clone(),
            Self::SetIdSwitch { unit, .. }
            | Self::InvertSiiWord { unit, .. }
            | Self::LoadSii { unit, .. }
            | Self::Replace { unit, .. } => UnitSet::One(unit.clone()),
        }
    }

    /// What a unit needs so that the order has an effect on it.
    pub(crate) fn needs(&self) -> Needs<'_> {
        match self {
            Self::Restart { .. }
            | Self::ResetErrors { .. }
            | Self::ClearEventLog { .. }
            | Self::PowerOff { .. } => Needs::Power,
            Self::InjectFault { fault, .. } => Needs::PowerForFault(fault),
            Self::Conduct { conduct, .. } => conduct.needs(),
            Self::PowerOn { .. } => Needs::NoPower,
            Self::CyclePower { .. }
            | Self::SetIdSwitch { .. }
            | Self::InvertSiiWord { .. }
            | Self::EraseSii { .. }
            | Self::LoadSii { .. }
            | Self::Replace { .. }
            | Self::RemoveFault { .. } => Needs::Nothing,
        }
    }
}

/// A log of events.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EventLog {
    /// The system event log.
    System,
    /// The access event log.
    Access,
}

/// The conduct of a unit as a slave, until it is changed again.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "the table of sentences says what each value means")]
pub enum ConductOrder {
    /// Every transition takes this time.
    EveryTransition {
        #[serde(with = "text")]
        time: Duration,
    },
    /// The transition with these letters takes this time.
    Transition {
        transition: String,
        #[serde(with = "text")]
        time: Duration,
    },
    /// Each SII command takes this time.
    SiiCommands {
        #[serde(with = "text")]
        time: Duration,
    },
    /// The SII is busy for this time from now on.
    SiiBusy {
        #[serde(with = "text")]
        time: Duration,
    },
    /// An SDO is answered after this time.
    Sdos {
        #[serde(with = "text")]
        time: Duration,
    },
    /// A state is refused with this AL status code.
    Refuse {
        #[serde(with = "state")]
        state: AlState,
        al_status_code: Hex<u16>,
    },
    /// The acknowledge of an error is ignored.
    IgnoreAcknowledges,
    /// Times are those of the unit file again, and all other changes of the conduct are cleared.
    Behave,
}

impl ConductOrder {
    const fn needs(&self) -> Needs<'static> {
        match self {
            // A state of the ESC, which a start resets.
            Self::SiiBusy { .. } => Needs::Power,
            Self::EveryTransition { .. }
            | Self::Transition { .. }
            | Self::SiiCommands { .. }
            | Self::Sdos { .. }
            | Self::Refuse { .. }
            | Self::IgnoreAcknowledges
            | Self::Behave => Needs::Nothing,
        }
    }
}
