//! The process data of a unit as its master has mapped them, read from the registers of its ESC.

use esc::{Esc, Fmmu, SmDirection, SmIndex, SmMode, SyncManagerSettings};
use time::Instant;

use crate::happening::Mapping;

/// First byte of the SyncManagers in the register map, and length of one.
const SYNC_MANAGERS: u16 = 0x0800;
const SYNC_MANAGER_BYTES: usize = 8;
const SYNC_MANAGERS_MAX: u8 = 16;
/// The same of the FMMUs.
const FMMUS: u16 = 0x0600;
const FMMU_BYTES: usize = 16;

/// The SyncManagers in buffered mode that are enabled, with the FMMUs that map to their first byte.
pub fn of(esc: &Esc, now: Instant) -> impl Iterator<Item = Mapping> + '_ {
    (0..SYNC_MANAGERS_MAX).filter_map(move |index| {
        let mut bytes = [0; SYNC_MANAGER_BYTES];
        esc.look(SYNC_MANAGERS + u16::from(index) * bytes.len() as u16, &mut bytes, now);
        let settings = SyncManagerSettings::from_bytes(&bytes);
        let is_used = settings.enabled && settings.mode == SmMode::Buffered && settings.length_bytes > 0;
        is_used.then(|| Mapping {
            sync_manager: SmIndex(index),
            is_outputs: settings.direction == SmDirection::EcatWrites,
            physical_start: settings.start,
            length_bytes: settings.length_bytes,
            logical_start: logical_start(esc, settings.start, now),
        })
    })
}

fn logical_start(esc: &Esc, physical_start: u16, now: Instant) -> Option<u32> {
    (0..u16::from(esc.fmmu_count())).find_map(|index| {
        let mut bytes = [0; FMMU_BYTES];
        esc.look(FMMUS + index * FMMU_BYTES as u16, &mut bytes, now);
        let fmmu = Fmmu::from_bytes(&bytes);
        (fmmu.active && fmmu.physical_start == physical_start).then_some(fmmu.logical_start)
    })
}
