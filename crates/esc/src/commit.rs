//! The end of a frame: register writes take effect, SyncManagers release their buffers.

use time::Instant;

use crate::ecat::split_bank;
use crate::esc::{Esc, Mapping, Protection};
use crate::events::{AlEvents, EcatEvents};
use crate::fmmu::{FMMU_BYTES, Fmmu, Span};
use crate::passage::Passage;
use crate::registers::{BYTES, Effect, USER_RAM_START, at};
use crate::shadow::Shadow;
use crate::sii::Sii;
use crate::sync_manager::{SYNC_MANAGER_BYTES, SmDirection, SmMode, SyncManagerSettings};

const RESET_SEQUENCE: [u8; 3] = *b"RES";
/// DL control bit 24: the slave also answers to the station alias.
const USE_ALIAS: u8 = 1;
/// What 0x0040 reads after each step of the sequence.
const RESET_READBACK: [u8; 3] = [0, 1, 2];

impl Esc {
    /// Closes a valid frame: its writes take effect. Returns whether registers are among them. If the ESC does not wait for
    /// it ([`Esc::awaits_end_of_frame`]), nothing happens.
    #[inline]
    pub fn end_of_frame(&mut self, passage: &Passage) -> bool {
        let registers_written = self.hot.registers_written;
        self.commit(passage);
        registers_written
    }

    #[inline]
    fn commit(&mut self, passage: &Passage) {
        let mut complete = core::mem::take(&mut self.hot.complete);
        while complete != 0 {
            self.hand_over(complete.trailing_zeros() as usize, passage.arrival);
            complete &= complete - 1;
        }
        if core::mem::take(&mut self.hot.registers_written) {
            self.commit_shadow(passage);
        }
        self.update_masked_events();
    }

    // A call of its own: most frames write process data alone.
    #[inline(never)]
    fn commit_shadow(&mut self, passage: &Passage) {
        let Some(mut shadow) = self.shadow.take() else { return };
        self.commit_registers(&shadow, passage);
        shadow.clear();
        self.shadow = Some(shadow);
    }

    fn hand_over(&mut self, n: usize, now: Instant) {
        let sm = &mut self.sync_managers[n];
        sm.end_of_frame();
        let settings = sm.settings;
        if settings.watchdog_trigger && settings.direction == SmDirection::EcatWrites {
            // Check for expiry first, so that a late write cannot mask the time-out.
            self.advance(now);
            self.watchdog.trigger(now);
        }
    }

    fn commit_registers(&mut self, shadow: &Shadow, passage: &Passage) {
        let (mut at, mut reset_step, mut al_control_written, mut sii_control) = (0, None, false, None);
        while let Some((offset, data)) = shadow.run(at) {
            at = usize::from(offset) + data.len();
            let effects = self.commit_write(offset, data, passage);
            al_control_written |= effects.contains(Effect::AlControl);
            if effects.contains(Effect::SiiCommand) {
                sii_control = sii_control.or(sii_control_in(offset, data));
            }
            if effects.contains(Effect::Reset) {
                reset_step = data.get(usize::from(at::ESC_RESET_ECAT.saturating_sub(offset))).copied();
            }
        }
        self.advance_reset(reset_step);
        // Address and data of the same frame are stored by now, whether they came before or after the command.
        if let Some(control) = sii_control {
            let words_before = self.sii.words_written();
            self.sii.run_command(control, &mut self.memory, passage.arrival);
            self.sii_written |= self.sii.words_written() != words_before;
        }
        if al_control_written {
            self.al_control_pending = true;
            self.al_events |= AlEvents::AL_CONTROL;
        }
        self.protection = Protection {
            registers: self.memory.u8(at::WRITE_REGISTER_PROTECTION) & 1 != 0,
            everything: self.memory.u8(at::ESC_WRITE_PROTECTION) & 1 != 0,
            ..Protection::default()
        };
        self.hot.protected = self.protection != Protection::default();
        self.hot.event_mask = self.memory.u16(at::ECAT_EVENT_MASK);
    }

    /// Stores the bits that the table permits, then runs each effect of the written bytes once.
    fn commit_write(&mut self, offset: u16, data: &[u8], passage: &Passage) -> Effects {
        let mut effects = Effects(0);
        for (offset, byte) in (offset..USER_RAM_START).zip(data) {
            if !self.accepts_write(offset, passage.arrival) {
                continue;
            }
            let effect = BYTES.effect(offset);
            effects.0 |= 1 << effect as u32;
            // SyncManagers check their bytes as a whole: a write that disables one may also set it.
            if effect != Effect::SyncManager {
                self.memory.store(offset, *byte);
            }
        }
        if effects.contains(Effect::SyncManager) {
            self.write_sync_managers(offset, data, at::SYNC_MANAGER.max(offset));
        }
        if effects.contains(Effect::Fmmu) || effects.contains(Effect::SyncManager) {
            self.update_mappings();
        }
        self.run_effects(effects, offset, data, passage);
        effects
    }

    fn run_effects(&mut self, effects: Effects, offset: u16, data: &[u8], passage: &Passage) {
        let now = passage.arrival;
        let has = |effect| effects.contains(effect);
        if has(Effect::DlControl) && self.ports.dl_control_written(&mut self.memory) {
            self.changes.ports = true;
            self.ecat_events |= EcatEvents::DL_STATUS;
        }
        if has(Effect::Watchdog) {
            self.watchdog.configure(&self.memory, now);
        }
        if has(Effect::SiiOwner) {
            Sii::owner_written(&mut self.memory);
        }
        if has(Effect::DcLatch) {
            self.dc.latch(&mut self.memory, passage);
        }
        if has(Effect::DcSystemTime) && offset <= at::SYSTEM_TIME {
            let from = usize::from(at::SYSTEM_TIME - offset);
            let bytes = data.get(from..).unwrap_or_default().iter().take(4);
            let received = (0..).zip(bytes).fold(0, |time, (n, byte)| time | u32::from(*byte) << (8 * n));
            self.dc.synchronise(&mut self.memory, received, now);
        }
        if has(Effect::DcSpeedCounter) {
            self.dc.reset_control_loop(&mut self.memory);
        }
        self.clear_counters(effects);
        self.update_addresses();
    }

    fn clear_counters(&mut self, effects: Effects) {
        let counters = [
            (Effect::ClearPortErrors, at::PORT_ERRORS, 12),
            (Effect::ClearProcessingUnitErrors, at::PROCESSING_UNIT_ERRORS, 1),
            (Effect::ClearPdiErrors, at::PDI_ERRORS, 1),
            (Effect::ClearLostLinks, at::LOST_LINKS, 4),
            (Effect::ClearWatchdogCounters, at::WATCHDOG_COUNTER, 2),
        ];
        for (effect, offset, bytes) in counters {
            if effects.contains(effect) {
                self.memory.slice_mut(offset, bytes).fill(0);
            }
        }
    }

    pub(crate) fn update_addresses(&mut self) {
        let station_address = self.memory.u16(at::STATION_ADDRESS);
        let uses_alias = self.memory.u8(at::DL_CONTROL + 3) & USE_ALIAS != 0;
        let answering_alias = uses_alias.then(|| self.memory.u16(at::STATION_ALIAS));
        let before = (self.hot.station_address, self.hot.answering_alias);
        self.changes.addresses |= before != (station_address, answering_alias);
        (self.hot.station_address, self.hot.answering_alias) = (station_address, answering_alias);
    }

    fn write_sync_managers(&mut self, offset: u16, data: &[u8], first: u16) {
        let end = usize::from(offset) + data.len();
        let (first_sm, _) = split_bank(first - at::SYNC_MANAGER, SYNC_MANAGER_BYTES);
        for n in first_sm..usize::from(self.config.sync_manager_count) {
            let registers = at::SYNC_MANAGER + (n * SYNC_MANAGER_BYTES) as u16;
            if usize::from(registers) >= end {
                break;
            }
            self.write_sync_manager(n, registers, offset, data);
        }
    }

    fn write_sync_manager(&mut self, n: usize, registers: u16, offset: u16, data: &[u8]) {
        let written = |byte: u16| {
            let at = registers + byte;
            at.checked_sub(offset).and_then(|from| data.get(usize::from(from))).copied()
        };
        let activation = written(6);
        if let Some(activation) = activation {
            self.memory.store(registers + 6, activation);
            self.al_events |= AlEvents::SYNC_MANAGER_ACTIVATION;
        }
        // The activation is checked first: a write that also disables the SyncManager may set it.
        if self.takes_settings(n) || activation.is_some_and(|activation| activation & 1 == 0) {
            for byte in 0..5 {
                if let Some(value) = written(byte) {
                    self.memory.store(registers + byte, value);
                }
            }
        }
        let mut bytes = [0; SYNC_MANAGER_BYTES];
        bytes.copy_from_slice(self.memory.slice(registers, SYNC_MANAGER_BYTES));
        self.sync_managers[n].set(SyncManagerSettings::from_bytes(&bytes), self.memory.end());
        self.stop_watchdog_without_trigger();
    }

    pub(crate) fn stop_watchdog_without_trigger(&mut self) {
        let watched = |sm: &crate::SyncManager| sm.settings.enabled && sm.settings.watchdog_trigger;
        if !self.sync_managers.iter().any(watched) {
            self.watchdog.stop();
        }
    }

    /// Decodes the FMMUs once, so that they are ready while a frame passes.
    pub(crate) fn update_mappings(&mut self) {
        self.read_mappings.clear();
        self.write_mappings.clear();
        for n in 0..u16::from(self.config.fmmu_count) {
            let mut bytes = [0; FMMU_BYTES];
            bytes.copy_from_slice(self.memory.slice(at::FMMU + n * FMMU_BYTES as u16, FMMU_BYTES));
            let fmmu = Fmmu::from_bytes(&bytes);
            let before = core::mem::replace(&mut self.fmmus[usize::from(n & 0x0F)], fmmu);
            self.changes.mappings |= before != fmmu;
            if !fmmu.active {
                continue;
            }
            let mapping = Mapping {
                logical_start: fmmu.logical_start,
                length_bytes: fmmu.length_bytes,
                physical_start: fmmu.physical_start,
                fmmu: n as u8,
                bytewise: fmmu.is_bytewise(),
                sync_manager: self.buffer_of(&fmmu),
            };
            if fmmu.read {
                self.read_mappings.push(mapping);
            }
            if fmmu.write {
                self.write_mappings.push(mapping);
            }
        }
        self.hot.read_span = cover(&self.read_mappings);
        self.hot.write_span = cover(&self.write_mappings);
        self.mappings_alias =
            self.read_mappings.iter().any(|read| self.write_mappings.iter().any(|write| alias(read, write)));
    }

    /// The buffered SyncManager whose buffer a byte-wise mapping covers exactly, if no lower FMMU maps there.
    fn buffer_of(&self, fmmu: &Fmmu) -> Option<u8> {
        let (start, end) = physical_range(fmmu.physical_start, fmmu.length_bytes);
        let touches =
            |sm: &crate::SyncManager| sm.rules && u32::from(sm.settings.start) < end && start < sm.end();
        let (n, sm) = (0u8..).zip(&self.sync_managers).find(|(_, sm)| touches(sm))?;
        let exact = u32::from(sm.settings.start) == start && sm.end() == end;
        (exact && fmmu.is_bytewise() && sm.settings.mode == SmMode::Buffered).then_some(n)
    }

    /// "RES" in three frames requests a reset; the code that drives this ESC carries it out. A frame that
    /// writes other registers in between restarts the sequence.
    fn advance_reset(&mut self, byte: Option<u8>) {
        let Some(byte) = byte else {
            self.reset_progress = 0;
            self.memory.set_u8(at::ESC_RESET_ECAT, 0);
            return;
        };
        let step = usize::from(self.reset_progress);
        self.reset_progress = match RESET_SEQUENCE.get(step) {
            Some(expected) if *expected == byte => self.reset_progress + 1,
            _ => u8::from(byte == RESET_SEQUENCE[0]),
        };
        if usize::from(self.reset_progress) == RESET_SEQUENCE.len() {
            self.reset_progress = 0;
            self.reset_requested = true;
        }
        self.memory.set_u8(at::ESC_RESET_ECAT, RESET_READBACK[usize::from(self.reset_progress)]);
    }
}

/// The effects of one write, one bit each.
#[derive(Clone, Copy)]
struct Effects(u32);

impl Effects {
    const fn contains(self, effect: Effect) -> bool {
        self.0 & 1 << effect as u32 != 0
    }
}

/// The SII control value in a write: only if the write includes its upper byte, which is the command.
fn sii_control_in(offset: u16, data: &[u8]) -> Option<u16> {
    let byte = |at: u16| data.get(usize::from(at.checked_sub(offset)?)).copied();
    let command = byte(at::SII_CONTROL + 1)?;
    Some(u16::from_le_bytes([byte(at::SII_CONTROL).unwrap_or(0), command]))
}

fn cover(mappings: &[Mapping]) -> Span {
    mappings.iter().fold(Span::EMPTY, |span, mapping| span.cover(mapping.logical_bytes()))
}

fn physical_range(start: u16, length_bytes: u16) -> (u32, u32) {
    (u32::from(start), u32::from(start) + u32::from(length_bytes))
}

fn alias(read: &Mapping, write: &Mapping) -> bool {
    let (read_start, read_end) = physical_range(read.physical_start, read.length_bytes);
    let (write_start, write_end) = physical_range(write.physical_start, write.length_bytes);
    read_start < write_end && write_start < read_end
}
