//! Registers whose value is calculated on access: event requests, watchdog status, SII, SyncManager status,
//! system time.

use time::Instant;

use crate::esc::Esc;
use crate::registers::at;
use crate::sync_manager::{SYNC_MANAGER_BYTES, SYNC_MANAGERS_MAX};

/// Status and PDI control of a SyncManager, from its first byte on.
const SM_STATUS: u16 = 5;
const SM_PDI_CONTROL: u16 = 7;

/// The values of these registers at one point in time.
struct Live {
    ecat_events: u16,
    al_events: u32,
    watchdog_status: u16,
    sii_control: u16,
    sync_managers: [[u8; 2]; SYNC_MANAGERS_MAX],
    sync_manager_count: usize,
    /// None without distributed clocks.
    system_time: Option<u64>,
}

impl Esc {
    /// Stores them in the memory, for a read by the ECAT side.
    pub(crate) fn show_live_registers(&mut self, now: Instant) {
        let live = self.live(now);
        live.each(|offset, value| self.memory.slice_mut(offset, value.len()).copy_from_slice(value));
    }

    /// What the ECAT side would read from `offset` on at this time, registers and RAM, without the side effects
    /// of an access. For an area with three buffers this is the first one. Bytes beyond the memory are
    /// unchanged.
    pub fn look(&self, offset: u16, bytes: &mut [u8], now: Instant) {
        let Some(memory) = self.memory.get(u32::from(offset), bytes.len()) else { return };
        bytes.copy_from_slice(memory);
        self.live(now).each(|at, value| {
            for (at, byte) in (at..).zip(value) {
                let place = at.checked_sub(offset).and_then(|from| bytes.get_mut(usize::from(from)));
                if let Some(place) = place {
                    *place = *byte;
                }
            }
        });
    }

    fn live(&self, now: Instant) -> Live {
        let sync_manager_count = usize::from(self.config.sync_manager_count);
        let mut sync_managers = [[0; 2]; SYNC_MANAGERS_MAX];
        for (values, sm) in sync_managers.iter_mut().zip(&self.sync_managers).take(sync_manager_count) {
            *values = [sm.status(), sm.pdi_control()];
        }
        let has_clock = self.config.distributed_clocks;
        Live {
            ecat_events: self.all_ecat_events().bits(),
            al_events: self.all_al_events().bits(),
            watchdog_status: self.watchdog.status(),
            sii_control: self.sii.status(now),
            sync_managers,
            sync_manager_count,
            system_time: has_clock.then(|| self.dc.system_time(&self.memory, now)),
        }
    }
}

impl Live {
    /// Each register with its bytes.
    fn each(&self, mut put: impl FnMut(u16, &[u8])) {
        put(at::ECAT_EVENT_REQUEST, &self.ecat_events.to_le_bytes());
        put(at::AL_EVENT_REQUEST, &self.al_events.to_le_bytes());
        put(at::WATCHDOG_STATUS, &self.watchdog_status.to_le_bytes());
        put(at::SII_CONTROL, &self.sii_control.to_le_bytes());
        for (n, [status, pdi_control]) in (0..).zip(self.sync_managers.iter().take(self.sync_manager_count)) {
            let registers = at::SYNC_MANAGER + n * SYNC_MANAGER_BYTES as u16;
            put(registers + SM_STATUS, &[*status]);
            put(registers + SM_PDI_CONTROL, &[*pdi_control]);
        }
        if let Some(system_time) = self.system_time {
            put(at::SYSTEM_TIME, &system_time.to_le_bytes());
        }
    }
}
