//! The settings of a unit, before it is powered on.

pub use coe_kit::history::NewestAcknowledged;
use device::StartUp;
use time::Duration;
pub use unit_model::LevelNotChangeable;
use unit_model::keys::{SlaveKeys, Timing};

use crate::allocation::IoAllocation;
use crate::events::{Event, EventCode, EventLevel};
use crate::identification::Identification;
use crate::timing::start_up;
use crate::unit_file::UnitFile;
use crate::unit_information::UnitInformation;

/// The settings of one unit, on its case and by its support software.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitSettings {
    /// Serial number, object 1018:04.
    pub serial: u32,
    /// ID switch, 0x00 to 0xFF. 0x00: the ID is set by software.
    pub id_switch: u8,
    /// ID set by software at the factory, effective while the ID switch is at 0x00; 0: none. An ID set by a
    /// master is in the [non-volatile memory](crate::NonVolatileMemory).
    pub software_id: u16,
    /// Versions, lot and type of this unit.
    pub information: UnitInformation,
    /// Whether the times of the manual are simulated.
    pub timing: Timing,
    /// Its behaviour as an EtherCAT slave.
    pub slave: SlaveKeys,
    /// From power-on to the first step of the unit, at the first power-on and at later starts.
    pub start_up: StartUp,
    /// From the first step of the unit to its first refresh.
    pub refresh_phase: Duration,
    /// I/O allocation of the CPU Unit.
    pub io_allocation: IoAllocation,
    /// Event levels that the user has changed.
    pub event_levels: EventLevels,
    /// The value of object 10F3:03: the manual describes both (A-6-4).
    pub newest_acknowledged: NewestAcknowledged,
}

/// The Event Level Settings (manual, 6-5-1), effective from the start of the unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EventLevels {
    /// For 39160000, if a user has set it.
    mismatch_c_to_m: Option<EventLevel>,
    /// For 39170000.
    mismatch_m_to_c: Option<EventLevel>,
}

impl EventLevels {
    /// Changes the level of an event.
    ///
    /// # Errors
    /// [`LevelNotChangeable`]: the manual permits changes of 39160000 and 39170000, to minor fault and observation.
    pub fn set(&mut self, code: EventCode, level: EventLevel) -> Result<(), LevelNotChangeable> {
        if level == EventLevel::Information {
            return Err(LevelNotChangeable);
        }
        let place = match code {
            Event::MISMATCH_C_TO_M => &mut self.mismatch_c_to_m,
            Event::MISMATCH_M_TO_C => &mut self.mismatch_m_to_c,
            _ => return Err(LevelNotChangeable),
        };
        *place = Some(level);
        Ok(())
    }

    /// The level of an event.
    #[must_use]
    pub fn of(self, event: &Event) -> EventLevel {
        let changed = match event.code {
            Event::MISMATCH_C_TO_M => self.mismatch_c_to_m,
            Event::MISMATCH_M_TO_C => self.mismatch_m_to_c,
            _ => None,
        };
        changed.unwrap_or(event.level)
    }

    /// The reader of unit files has refused events whose level cannot be changed.
    fn from_unit_file(file: &UnitFile) -> Self {
        let mut levels = Self::default();
        for changed in &file.event_levels {
            let code = changed.event_code.value;
            let taken = levels.set(code, changed.level.value);
            debug_assert_eq!(taken, Ok(()), "{code}");
        }
        levels
    }
}

impl UnitSettings {
    /// The settings of a unit file; values that are left out are those of [`UnitSettings::default`].
    #[must_use]
    pub fn from_unit_file(file: &UnitFile) -> Self {
        Self {
            serial: file.serial.value,
            id_switch: file.id_switch.value,
            software_id: file.alias.as_ref().map_or(0, |alias| alias.value),
            information: file.information.clone(),
            timing: file.timing.value,
            slave: file.slave.clone(),
            start_up: start_up(file.timing.value, file.start_up.as_ref().map(|named| named.value)),
            refresh_phase: file.refresh_phase.as_ref().map_or(Duration::ZERO, |phase| phase.value),
            io_allocation: file.io_allocation(),
            event_levels: EventLevels::from_unit_file(file),
            newest_acknowledged: NewestAcknowledged::default(),
        }
    }

    /// The Explicit Device ID at power-on: the ID switch, or the software ID while it is at 0x00; 0: none.
    #[must_use]
    pub fn explicit_device_id(&self) -> u16 {
        let id = Identification::at_power_on(self.id_switch, self.software_id);
        id.explicit_device_id().unwrap_or(0)
    }
}

impl Default for UnitSettings {
    /// The factory setting with the ID switch at 0x01, as in the manual's example (A-1-2).
    fn default() -> Self {
        Self {
            serial: 1,
            id_switch: 0x01,
            software_id: 0,
            information: UnitInformation::default(),
            timing: Timing::Exact,
            slave: SlaveKeys::default(),
            start_up: start_up(Timing::Exact, None),
            refresh_phase: Duration::ZERO,
            io_allocation: IoAllocation::factory(),
            event_levels: EventLevels::default(),
            newest_acknowledged: NewestAcknowledged::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_levels_that_can_be_changed_are_those_of_the_table() {
        for event in Event::all() {
            let mut levels = EventLevels::default();
            let changed = levels.set(event.code, EventLevel::Observation).is_ok();
            assert_eq!(changed, event.changeable_level, "{}", event.code);
            let level = if changed { EventLevel::Observation } else { event.level };
            assert_eq!(levels.of(event), level, "{}", event.code);
        }
    }
}
