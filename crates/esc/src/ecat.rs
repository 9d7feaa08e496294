//! The ECAT side: what datagrams read and write, within a frame.

use time::Instant;

use crate::config::SyncManagerWrites;
use crate::esc::Esc;
use crate::events::EcatEvents;
use crate::fmmu::FMMU_BYTES;
use crate::registers::{BYTES, Effect, PROCESS_RAM_START, USER_RAM_START, are_digital_outputs, at, is_live};
use crate::sii::Sii;
use crate::sync_manager::{Reach, SYNC_MANAGER_BYTES};

/// Longest data of one datagram in an Ethernet frame.
pub(crate) const DATA_BYTES_MAX: usize = 1_500;

/// What an access reached, for the working counter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Access {
    /// At least one byte or bit was read.
    pub read: bool,
    /// At least one byte or bit was written.
    pub written: bool,
}

impl Esc {
    /// Whether this ESC answers a configured-address command with this station address.
    #[inline]
    #[must_use]
    pub fn answers_to(&self, station_address: u16) -> bool {
        self.hot.station_address == station_address || self.hot.answering_alias == Some(station_address)
    }

    /// Whether an action waits for the end of the frame.
    #[inline]
    #[must_use]
    pub const fn awaits_end_of_frame(&self) -> bool {
        self.hot.complete != 0 || self.hot.registers_written
    }

    /// The ECAT event request, masked, for the IRQ field of datagrams.
    #[inline]
    #[must_use]
    pub const fn masked_events(&self) -> u16 {
        self.hot.masked_events
    }

    /// Reads memory into `data`. Returns whether at least one byte could be read; the other bytes are unchanged.
    #[inline]
    pub fn read(&mut self, offset: u16, data: &mut [u8], now: Instant) -> bool {
        self.read_with(offset, data.len(), now, |at, bytes| {
            if let Some(target) = data.get_mut(at..at + bytes.len()) {
                target.copy_from_slice(bytes);
            }
        })
    }

    /// Reads memory and ORs it into `data`, as a broadcast read does.
    #[inline]
    pub fn read_or(&mut self, offset: u16, data: &mut [u8], now: Instant) -> bool {
        self.read_with(offset, data.len(), now, |at, bytes| {
            let target = data.get_mut(at..).unwrap_or_default();
            target.iter_mut().zip(bytes).for_each(|(target, byte)| *target |= byte);
        })
    }

    #[inline]
    fn read_with(
        &mut self,
        offset: u16,
        length_bytes: usize,
        now: Instant,
        mut sink: impl FnMut(usize, &[u8]),
    ) -> bool {
        if offset >= PROCESS_RAM_START {
            return self.read_ram(u32::from(offset), 0, length_bytes, &mut sink);
        }
        let registers_bytes = length_bytes.min(usize::from(PROCESS_RAM_START - offset));
        let registers = self.read_registers(offset, registers_bytes, now, &mut sink);
        let rest = length_bytes - registers_bytes;
        let ram = rest > 0 && self.read_ram(u32::from(PROCESS_RAM_START), registers_bytes, rest, &mut sink);
        registers || ram
    }

    #[inline]
    fn read_registers(
        &mut self,
        offset: u16,
        length_bytes: usize,
        now: Instant,
        sink: &mut impl FnMut(usize, &[u8]),
    ) -> bool {
        if length_bytes == 0 {
            return false;
        }
        let last = offset + (length_bytes - 1) as u16;
        if (offset >> 4..=last >> 4).any(|page| is_live(page << 4)) {
            return self.read_live_registers(offset, length_bytes, now, sink);
        }
        if !self.ecat_events.is_empty() {
            self.clear_events_read(offset, length_bytes);
        }
        sink(0, self.memory.slice(offset, length_bytes));
        true
    }

    /// Registers whose value is calculated when they are read.
    fn read_live_registers(
        &mut self,
        offset: u16,
        length_bytes: usize,
        now: Instant,
        sink: &mut impl FnMut(usize, &[u8]),
    ) -> bool {
        if !self.config.distributed_clocks && offset >> 8 == 0x09 {
            return false;
        }
        self.show_live_registers(now);
        sink(0, self.memory.slice(offset, length_bytes));
        self.clear_events_read(offset, length_bytes);
        true
    }

    /// Reading DL status or AL status clears its event.
    fn clear_events_read(&mut self, offset: u16, length_bytes: usize) {
        let touched = |register: u16| {
            offset < register + 2 && usize::from(register) < usize::from(offset) + length_bytes
        };
        if touched(at::DL_STATUS) {
            self.clear_ecat_event(EcatEvents::DL_STATUS);
        }
        if touched(at::AL_STATUS) {
            self.clear_ecat_event(EcatEvents::AL_STATUS);
        }
    }

    /// Reads RAM in pieces, split at the borders of SyncManagers.
    #[inline]
    fn read_ram(
        &mut self,
        offset: u32,
        sink_from: usize,
        length_bytes: usize,
        sink: &mut impl FnMut(usize, &[u8]),
    ) -> bool {
        let mut done = 0;
        let mut any = false;
        while done < length_bytes {
            let piece = self.piece(offset + done as u32, length_bytes - done);
            if let Some(bytes) = self.readable(&piece).and_then(|at| self.memory.get(at, piece.length_bytes))
            {
                sink(sink_from + done, bytes);
                any = true;
            }
            done += piece.length_bytes;
        }
        any
    }

    /// Writes memory. Returns whether at least one byte could be written.
    #[inline]
    pub fn write(&mut self, offset: u16, data: &[u8], now: Instant) -> bool {
        let ram_is_open = !self.hot.protected || self.protection.opens_ram();
        if offset >= PROCESS_RAM_START {
            return ram_is_open && self.write_ram(u32::from(offset), data);
        }
        if are_digital_outputs(offset, data.len()) {
            let are_open = !self.hot.protected || self.protection.opens_register(offset);
            return are_open && self.write_ram(u32::from(offset), data);
        }
        let (user_ram_from, ram_from) = (usize::from(USER_RAM_START), usize::from(PROCESS_RAM_START));
        let split = |limit: usize| limit.saturating_sub(usize::from(offset)).min(data.len());
        let registers = self.write_registers(offset, &data[..split(user_ram_from)], now);
        if !ram_is_open {
            return registers;
        }
        let user_ram = &data[split(user_ram_from)..split(ram_from)];
        if !user_ram.is_empty() {
            self.memory.slice_mut(offset.max(USER_RAM_START), user_ram.len()).copy_from_slice(user_ram);
        }
        let ram = self.write_ram(u32::from(PROCESS_RAM_START), &data[split(ram_from)..]);
        registers || !user_ram.is_empty() || ram
    }

    /// Register writes take effect at the end of the frame.
    fn write_registers(&mut self, offset: u16, data: &[u8], now: Instant) -> bool {
        let mut offsets = (offset..).take(data.len());
        if !offsets.any(|offset| self.accepts_write(offset, now)) {
            return false;
        }
        // The enable registers take effect within the same frame.
        if offset == at::WRITE_REGISTER_ENABLE {
            self.protection.registers_enabled = data[0] & 1 != 0;
        } else if offset == at::ESC_WRITE_ENABLE {
            self.protection.everything_enabled = data[0] & 1 != 0;
        }
        self.hot.registers_written = true;
        if let Some(shadow) = &mut self.shadow {
            shadow.write(offset, data);
        }
        true
    }

    /// Whether the ECAT side may write the byte at `offset` at the time `now`.
    pub(crate) fn accepts_write(&self, offset: u16, now: Instant) -> bool {
        let dc_missing = offset >> 8 == 0x09 && !self.config.distributed_clocks;
        let protected = self.hot.protected && !self.protection.opens_register(offset);
        BYTES.writable(offset)
            && !dc_missing
            && !protected
            && match BYTES.effect(offset) {
                Effect::AlControl => !self.al_control_pending,
                Effect::SiiCommand => Sii::ecat_owns(&self.memory) && !self.sii.is_busy(now),
                Effect::Fmmu => {
                    let (n, byte) = split_bank(offset - at::FMMU, FMMU_BYTES);
                    n < usize::from(self.config.fmmu_count) && byte < 13
                }
                Effect::SyncManager => {
                    let (n, byte) = split_bank(offset - at::SYNC_MANAGER, SYNC_MANAGER_BYTES);
                    n < usize::from(self.config.sync_manager_count)
                        && match byte {
                            0..=4 => self.takes_settings(n),
                            _ => byte == 6,
                        }
                }
                _ => !self.is_held(offset),
            }
    }

    /// Whether a SyncManager covers this byte of the digital output data: a write that continues past the data
    /// leaves this byte unchanged.
    fn is_held(&self, offset: u16) -> bool {
        let offset_is_held = || self.piece(u32::from(offset), 1).sync_manager.is_some();
        are_digital_outputs(offset, 1) && offset_is_held()
    }

    pub(crate) fn takes_settings(&self, sync_manager: usize) -> bool {
        let enabled = self.sync_managers.get(sync_manager).is_some_and(|sm| sm.settings.enabled);
        !enabled || self.config.sync_manager_writes == SyncManagerWrites::Always
    }

    #[inline]
    fn write_ram(&mut self, offset: u32, data: &[u8]) -> bool {
        let mut done = 0;
        let mut any = false;
        while done < data.len() {
            let piece = self.piece(offset + done as u32, data.len() - done);
            let target = self.writable(&piece);
            if let Some(target) = target.and_then(|at| self.memory.get_mut(at, piece.length_bytes)) {
                target.copy_from_slice(&data[done..done + piece.length_bytes]);
                any = true;
            }
            done += piece.length_bytes;
        }
        any
    }

    /// Reads the old contents and writes the received data: APRW, FPRW.
    pub fn read_write(&mut self, offset: u16, data: &mut [u8], now: Instant) -> Access {
        self.exchange(offset, data, now, Self::read)
    }

    /// ORs the old contents into the data and writes the received data: BRW.
    pub fn read_or_write(&mut self, offset: u16, data: &mut [u8], now: Instant) -> Access {
        self.exchange(offset, data, now, Self::read_or)
    }

    fn exchange(
        &mut self,
        offset: u16,
        data: &mut [u8],
        now: Instant,
        read: impl FnOnce(&mut Self, u16, &mut [u8], Instant) -> bool,
    ) -> Access {
        let mut incoming = [0; DATA_BYTES_MAX];
        let Some(incoming) = incoming.get_mut(..data.len()) else { return Access::default() };
        incoming.copy_from_slice(data);
        Access { read: read(self, offset, data, now), written: self.write(offset, incoming, now) }
    }

    /// The longest piece of RAM from `offset` on that one SyncManager covers, or that no SyncManager covers.
    fn piece(&self, offset: u32, length_bytes: usize) -> Piece {
        let mut length = length_bytes as u32;
        for (n, sm) in (0u8..).zip(&self.sync_managers) {
            let start = u32::from(sm.settings.start);
            if !sm.rules || offset >= sm.end() {
                continue;
            }
            if offset >= start {
                let length_bytes = length.min(sm.end() - offset) as usize;
                return Piece { offset, length_bytes, sync_manager: Some(n) };
            }
            length = length.min(start - offset);
        }
        let room = (self.memory.end() as u32).saturating_sub(offset);
        // Everything after the end of the RAM is one piece that cannot be accessed.
        let length = if room == 0 { length } else { length.min(room) };
        Piece { offset, length_bytes: length as usize, sync_manager: None }
    }

    /// The address from which a piece is read, according to its SyncManager.
    #[inline]
    fn readable(&mut self, piece: &Piece) -> Option<u32> {
        let Some(n) = piece.sync_manager else { return Some(piece.offset) };
        let sm = self.sync_managers.get_mut(usize::from(n))?;
        let from = (piece.offset - u32::from(sm.settings.start)) as u16;
        let buffer = sm.ecat_read(Reach { from, to: from + piece.length_bytes as u16 })?;
        self.hot.complete |= u16::from(sm.complete) << n;
        Some(buffer + u32::from(from))
    }

    /// The address to which a piece is written, according to its SyncManager.
    #[inline]
    fn writable(&mut self, piece: &Piece) -> Option<u32> {
        let Some(n) = piece.sync_manager else { return Some(piece.offset) };
        let sm = self.sync_managers.get_mut(usize::from(n))?;
        let from = (piece.offset - u32::from(sm.settings.start)) as u16;
        let buffer = sm.ecat_write(Reach { from, to: from + piece.length_bytes as u16 })?;
        self.hot.complete |= u16::from(sm.complete) << n;
        Some(buffer + u32::from(from))
    }

    /// What a write at `offset` would replace, without any side effect.
    pub(crate) fn peek_for_write(&self, offset: u16, bytes: &mut [u8]) {
        let piece = self.piece(u32::from(offset), bytes.len());
        let sm = piece.sync_manager.and_then(|n| self.sync_managers.get(usize::from(n)));
        let base = sm.map_or(u32::from(offset), |sm| {
            sm.ecat_buffer() + (u32::from(offset) - u32::from(sm.settings.start))
        });
        if let Some(current) = self.memory.get(base, bytes.len()) {
            bytes.copy_from_slice(current);
        }
    }
}

/// A piece of RAM under one SyncManager or under none.
struct Piece {
    offset: u32,
    length_bytes: usize,
    sync_manager: Option<u8>,
}

/// The number of the register within a bank, and the byte within that register.
pub(crate) fn split_bank(from_bank_start: u16, size_bytes: usize) -> (usize, usize) {
    (usize::from(from_bank_start) / size_bytes, usize::from(from_bank_start) % size_bytes)
}
