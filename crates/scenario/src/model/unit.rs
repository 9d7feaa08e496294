//! What is done to a unit by hand, and how it behaves as a slave.

use nx_ect101::{EventLog, Fault};
use time::Duration;
use wire::AlState;

use super::units::UnitSet;

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
