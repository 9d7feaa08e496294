//! What a unit shows, for everybody: it is published by the thread of the units and read without waiting for it.

use std::sync::atomic::{AtomicU64, Ordering};

use device::Device;
use wire::{AlStatus, AlStatusCode};

/// What a unit shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnitStatus {
    /// Whether the unit is switched on.
    pub has_power: bool,
    /// State and error indication, as the master reads them.
    pub al_status: AlStatus,
    /// AL status code, as the master reads it.
    pub al_status_code: AlStatusCode,
}

impl UnitStatus {
    fn of<U: device::Unit>(device: &Device<U>) -> Self {
        Self {
            has_power: !device.is_off(),
            al_status: device.al_status(),
            al_status_code: device.al_status_code(),
        }
    }

    /// Bits 0 to 15: AL status; 16 to 31: AL status code; 32: power.
    const fn bits(self) -> u64 {
        self.al_status.bits() as u64 | (self.al_status_code.0 as u64) << 16 | (self.has_power as u64) << 32
    }

    const fn from_bits(bits: u64) -> Self {
        Self {
            has_power: bits >> 32 & 1 == 1,
            al_status: AlStatus::from_bits(bits as u16),
            al_status_code: AlStatusCode((bits >> 16) as u16),
        }
    }
}

/// The status of each unit of a line. A status is one number, so that its parts are of the same moment.
#[derive(Debug)]
pub(super) struct Published(Box<[AtomicU64]>);

impl Published {
    /// The status of this number of units, before the first one is published.
    pub(super) fn of(units: usize) -> Self {
        Self((0..units).map(|_| AtomicU64::new(0)).collect())
    }

    /// Publishes what a unit shows. A position beyond the line has no effect.
    pub(super) fn publish<U: device::Unit>(&self, position: usize, device: &Device<U>) {
        if let Some(unit) = self.0.get(position) {
            unit.store(UnitStatus::of(device).bits(), Ordering::Relaxed);
        }
    }

    /// None: there is no such unit.
    pub(super) fn status(&self, position: usize) -> Option<UnitStatus> {
        Some(UnitStatus::from_bits(self.0.get(position)?.load(Ordering::Relaxed)))
    }

    pub(super) const fn len(&self) -> usize {
        self.0.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_status_is_the_same_in_bits() {
        for (has_power, bits, code) in [(false, 0, 0), (true, 0x11, 0x001B), (true, 0x28, 0xFFFF)] {
            let al_status = AlStatus::from_bits(bits);
            let status = UnitStatus { has_power, al_status, al_status_code: AlStatusCode(code) };
            assert_eq!(UnitStatus::from_bits(status.bits()), status);
            assert_eq!(status.al_status.bits(), bits);
        }
    }
}
