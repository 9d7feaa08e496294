//! The controller: its parts, power-on, and what the ECAT side and the PDI side share.

use core::ops::{BitOrAssign, Range};

use arrayvec::ArrayVec;
use time::Instant;

use crate::config::{EscConfig, PortKind, SiiTiming};
use crate::dc::Dc;
use crate::events::{AlEvents, EcatEvents};
use crate::fmmu::{FMMUS_MAX, Fmmu, Span};
use crate::memory::Memory;
use crate::ports::{self, Port, PortStatus, Ports};
use crate::registers::at;
use crate::shadow::Shadow;
use crate::sii::Sii;
use crate::sync_manager::{SYNC_MANAGERS_MAX, SmIndex, SyncManager};
use crate::watchdog::Watchdog;

/// Features: distributed clocks, 64 bits wide.
const FEATURES_DC: u16 = 0x000C;
/// Features: enhanced link detection MII, separate handling of FCS errors.
const FEATURES_LINK: u16 = 0x00C0;

/// One EtherCAT slave controller.
#[derive(Clone, Debug)]
pub struct Esc {
    pub(crate) hot: Hot,
    pub(crate) changes: Changes,

    pub(crate) protection: Protection,
    pub(crate) memory: Memory,
    pub(crate) fmmus: [Fmmu; FMMUS_MAX],
    pub(crate) sync_managers: [SyncManager; SYNC_MANAGERS_MAX],
    pub(crate) read_mappings: ArrayVec<Mapping, FMMUS_MAX>,
    pub(crate) write_mappings: ArrayVec<Mapping, FMMUS_MAX>,
    /// A read mapping and a write mapping share memory: LRW must read before it writes.
    pub(crate) mappings_alias: bool,
    pub(crate) shadow: Option<Box<Shadow>>,
    pub(crate) ports: Ports,
    pub(crate) sii: Sii,
    pub(crate) dc: Dc,
    pub(crate) watchdog: Watchdog,
    pub(crate) ecat_events: EcatEvents,
    pub(crate) al_events: AlEvents,
    /// AL control holds a request that the PDI has not read.
    pub(crate) al_control_pending: bool,
    pub(crate) reset_progress: u8,
    pub(crate) reset_requested: bool,
    /// The ECAT side has written words to the EEPROM, and nobody has asked about it yet.
    pub(crate) sii_written: bool,
    pub(crate) config: EscConfig,
}

/// What has changed of that which decides where frames go, and which datagrams address an ESC.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Changes {
    /// A loop has opened or closed, or a cable was plugged or unplugged.
    pub ports: bool,
    /// It answers to other station addresses.
    pub addresses: bool,
    /// Its FMMUs map other bytes.
    pub mappings: bool,
}

impl Changes {
    /// Nothing has changed.
    pub const NONE: Self = Self { ports: false, addresses: false, mappings: false };
}

impl BitOrAssign for Changes {
    #[inline]
    fn bitor_assign(&mut self, others: Self) {
        self.ports |= others.ports;
        self.addresses |= others.addresses;
        self.mappings |= others.mappings;
    }
}

/// The values that every datagram needs, in one cache line, so that passing an ESC that is not addressed costs little.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Hot {
    pub(crate) read_span: Span,
    pub(crate) write_span: Span,
    pub(crate) station_address: u16,
    /// The alias, if DL control bit 24 enables it.
    pub(crate) answering_alias: Option<u16>,
    /// The visible part of the ECAT event request, for the IRQ field of datagrams.
    pub(crate) masked_events: u16,
    /// The ECAT event mask, register 0x0200.
    pub(crate) event_mask: u16,
    /// SyncManagers that release their buffer at the end of the frame, one bit each.
    pub(crate) complete: u16,
    /// Register writes wait for the end of the frame.
    pub(crate) registers_written: bool,
    /// At least one write protection is on.
    pub(crate) protected: bool,
}

impl Hot {
    const AT_POWER_ON: Self = Self {
        read_span: Span::EMPTY,
        write_span: Span::EMPTY,
        station_address: 0,
        answering_alias: None,
        masked_events: 0,
        event_mask: 0,
        complete: 0,
        registers_written: false,
        protected: false,
    };
}

/// An FMMU that is switched on, in the form needed while a frame passes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mapping {
    pub(crate) logical_start: u32,
    pub(crate) length_bytes: u16,
    pub(crate) physical_start: u16,
    /// Its number, for mappings that are not byte-wise.
    pub(crate) fmmu: u8,
    pub(crate) bytewise: bool,
    /// The buffered SyncManager whose complete buffer it maps, byte by byte.
    pub(crate) sync_manager: Option<u8>,
}

impl Mapping {
    /// The logical bytes, end excluded. A mapping does not wrap at the end of the address space.
    #[inline]
    pub(crate) const fn logical_bytes(&self) -> Span {
        let start = self.logical_start as u64;
        Span { start, end: start + self.length_bytes as u64 }
    }

    /// Whether it maps one complete buffer, and a datagram covers all of it.
    #[inline]
    pub(crate) const fn is_whole_buffer_in(&self, datagram: Span) -> bool {
        let bytes = self.logical_bytes();
        self.sync_manager.is_some() && datagram.start <= bytes.start && bytes.end <= datagram.end
    }
}

/// Write protection that applies to the frame that is passing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Protection {
    pub(crate) registers: bool,
    pub(crate) everything: bool,
    /// This frame has written the enable register.
    pub(crate) registers_enabled: bool,
    pub(crate) everything_enabled: bool,
}

impl Protection {
    /// Whether RAM may be written.
    pub(crate) const fn opens_ram(&self) -> bool {
        !self.everything || self.everything_enabled
    }

    /// Whether the register byte at `offset` may be written; the enable registers always may.
    pub(crate) const fn opens_register(&self, offset: u16) -> bool {
        let enables = offset == at::WRITE_REGISTER_ENABLE || offset == at::ESC_WRITE_ENABLE;
        enables || self.opens_ram() && (!self.registers || self.registers_enabled)
    }
}

impl Esc {
    /// An ESC that is powered on at `now`, with this EEPROM image. All the memory that it ever uses is allocated here.
    #[must_use]
    pub fn power_on(config: EscConfig, sii_image: Vec<u8>, now: Instant) -> Self {
        let (memory, sii) = (Memory::new(config.ram_kib), Sii::new(sii_image, config.sii));
        Self::start(config, memory, sii, Box::default(), now)
    }

    /// Back to the state after power-on; cables and EEPROM are unchanged.
    pub fn reset(&mut self, now: Instant) {
        let ports = self.ports;
        let memory = core::mem::take(&mut self.memory).cleared();
        let no_sii = Sii::new(Vec::new(), self.config.sii);
        let sii = core::mem::replace(&mut self.sii, no_sii).restarted(self.config.sii);
        let mut shadow = self.shadow.take().unwrap_or_default();
        shadow.clear();
        *self = Self::start(self.config, memory, sii, shadow, now);
        for port in [Port::In, Port::Out] {
            self.ports.set_link(port, ports.status(port).link, &mut self.memory);
        }
        self.ecat_events = EcatEvents::default();
    }

    /// Starts with memory and EEPROM in their power-on state.
    fn start(config: EscConfig, memory: Memory, sii: Sii, shadow: Box<Shadow>, now: Instant) -> Self {
        let mut esc = Self {
            hot: Hot::AT_POWER_ON,
            changes: Changes { ports: true, addresses: true, mappings: true },
            protection: Protection::default(),
            fmmus: [Fmmu::default(); FMMUS_MAX],
            sync_managers: [SyncManager::default(); SYNC_MANAGERS_MAX],
            read_mappings: ArrayVec::new(),
            write_mappings: ArrayVec::new(),
            mappings_alias: false,
            shadow: Some(shadow),
            ports: Ports::new(),
            sii,
            dc: Dc::new(now),
            watchdog: Watchdog::at_power_on(&memory),
            memory,
            ecat_events: EcatEvents::default(),
            al_events: AlEvents::default(),
            al_control_pending: false,
            reset_progress: 0,
            reset_requested: false,
            sii_written: false,
            config,
        };
        esc.load_constants();
        esc
    }

    fn load_constants(&mut self) {
        let memory = &mut self.memory;
        memory.set_u8(at::FMMU_COUNT, self.config.fmmu_count);
        memory.set_u8(at::SM_COUNT, self.config.sync_manager_count);
        memory.set_u8(at::RAM_KIB, self.config.ram_kib);
        memory.set_u8(at::PORT_DESCRIPTOR, PortKind::descriptor(self.config.ports));
        let dc = if self.config.distributed_clocks { FEATURES_DC } else { 0 };
        memory.set_u16(at::FEATURES, FEATURES_LINK | dc);
        self.sii.power_on(memory);
        ports::set_pdi_operational(memory, self.sii.is_loaded());
        self.ports.update(memory);
    }

    /// The EEPROM image.
    #[must_use]
    pub fn sii_image(&self) -> &[u8] {
        self.sii.image()
    }

    /// The EEPROM image for the start-up of the unit, before the controller loads it. In operation the PDI
    /// first takes the EEPROM: [`crate::Pdi::take_sii`].
    pub fn sii_image_mut(&mut self) -> &mut [u8] {
        self.sii.image_mut()
    }

    /// How long each further SII command takes.
    pub const fn set_sii_timing(&mut self, timing: SiiTiming) {
        self.config.sii = timing;
        self.sii.set_timing(timing);
    }

    /// Keeps the SII interface busy until the time `until`, for all users.
    pub fn keep_sii_busy(&mut self, now: Instant, until: Instant) {
        self.sii.keep_busy(now, until);
    }

    /// Number of words that the ECAT side has written to the EEPROM since power-on, modulo 2^32. Code that
    /// stores the image compares it to detect a possible change.
    #[must_use]
    pub const fn sii_words_written(&self) -> u32 {
        self.sii.words_written()
    }

    /// Whether the ECAT side has written words to the EEPROM since the last call.
    #[must_use]
    pub const fn take_sii_written(&mut self) -> bool {
        core::mem::replace(&mut self.sii_written, false)
    }

    /// The configured station address, register 0x0010.
    #[must_use]
    pub const fn station_address(&self) -> u16 {
        self.hot.station_address
    }

    /// Link and loop of a port.
    #[must_use]
    pub const fn port(&self, port: Port) -> PortStatus {
        self.ports.status(port)
    }

    /// A cable is plugged into or pulled out of a port.
    pub fn set_link(&mut self, port: Port, link: bool) {
        if self.ports.set_link(port, link, &mut self.memory) {
            self.changes.ports = true;
            self.raise_ecat_event(EcatEvents::DL_STATUS);
        }
    }

    /// A valid frame arrives at a closed port that has a link: in auto-close mode its loop opens.
    pub fn frame_at_closed_port(&mut self, port: Port) {
        if self.ports.frame_arrives(port, &mut self.memory) {
            self.changes.ports = true;
            self.raise_ecat_event(EcatEvents::DL_STATUS);
        }
    }

    /// Whether [`Esc::take_changes`] has something to return.
    #[inline]
    #[must_use]
    pub fn has_changes(&self) -> bool {
        self.changes != Changes::NONE
    }

    /// Takes what has changed for frames since the last call; after power-on and reset everything has.
    #[inline]
    pub fn take_changes(&mut self) -> Changes {
        core::mem::take(&mut self.changes)
    }

    /// The station addresses that it answers to.
    pub fn answering_addresses(&self) -> impl Iterator<Item = u16> + use<> {
        let Hot { station_address, answering_alias, .. } = self.hot;
        core::iter::once(station_address).chain(answering_alias.filter(|alias| *alias != station_address))
    }

    /// The logical bytes that each FMMU maps.
    pub fn mapped_bytes(&self) -> impl Iterator<Item = Range<u64>> + '_ {
        let maps = |fmmu: &&Fmmu| fmmu.active && (fmmu.read || fmmu.write);
        self.fmmus.iter().filter(maps).map(|fmmu| {
            let start = u64::from(fmmu.logical_start);
            start..start + u64::from(fmmu.length_bytes)
        })
    }

    /// The number of its FMMUs.
    #[must_use]
    pub const fn fmmu_count(&self) -> u8 {
        self.config.fmmu_count
    }

    /// A frame arrived with an error: counted as invalid at the port where it first arrived.
    pub fn count_invalid_frame(&mut self, port: Port) {
        self.memory.count_up(at::PORT_ERRORS + 2 * u16::from(port == Port::Out));
    }

    /// A frame arrived that another ESC had already marked as broken.
    pub fn count_forwarded_error(&mut self, port: Port) {
        self.memory.count_up(at::FORWARDED_ERRORS + u16::from(port == Port::Out));
    }

    /// The processing unit received a frame that it cannot process.
    pub fn count_processing_unit_error(&mut self) {
        self.memory.count_up(at::PROCESSING_UNIT_ERRORS);
    }

    /// Whether frames that are not EtherCAT are destroyed here (DL control bit 0) or forwarded.
    #[must_use]
    pub fn destroys_foreign_frames(&self) -> bool {
        self.memory.u8(at::DL_CONTROL) & 1 != 0
    }

    /// The time of the next event without a frame or an access: the watchdog. [`Instant::NEVER`] if there is none.
    #[must_use]
    pub fn deadline(&self) -> Instant {
        self.watchdog.deadline().unwrap_or(Instant::NEVER)
    }

    /// Advances the time.
    pub fn advance(&mut self, now: Instant) {
        if self.watchdog.expire(&mut self.memory, now) {
            self.al_events |= AlEvents::WATCHDOG;
        }
    }

    /// Whether the PDI has work: an event that its mask lets through, or a reset.
    #[must_use]
    pub fn interrupts_pdi(&self) -> bool {
        self.reset_requested || !self.visible_al_events().is_empty()
    }

    /// Whether the ECAT side has completed an access at a SyncManager that the PDI has not read yet, with or
    /// without an interrupt.
    #[must_use]
    pub fn has_sync_manager_event(&self, index: SmIndex) -> bool {
        self.sync_managers[usize::from(index.0 & 0x0F)].pdi_event
    }

    /// Whether the master requests a reset of the controller.
    #[must_use]
    pub const fn asks_for_reset(&self) -> bool {
        self.reset_requested
    }

    pub(crate) fn visible_al_events(&self) -> AlEvents {
        let mask = AlEvents::from_bits_truncate(self.memory.u32(at::AL_EVENT_MASK));
        self.al_events & mask | self.sync_manager_events(mask)
    }

    /// The AL event request: the events stored here, and those of the SyncManagers.
    pub(crate) fn all_al_events(&self) -> AlEvents {
        self.al_events | self.sync_manager_events(AlEvents::SYNC_MANAGERS)
    }

    /// The events of the SyncManagers in this mask. The others are not looked at.
    fn sync_manager_events(&self, mask: AlEvents) -> AlEvents {
        let existing = (1 << self.config.sync_manager_count.min(SYNC_MANAGERS_MAX as u8)) - 1;
        let (mut asked, mut bits) = ((mask & AlEvents::SYNC_MANAGERS).bits() >> 8 & existing, 0);
        while asked != 0 {
            let number = asked.trailing_zeros();
            asked &= asked - 1;
            let sm = &self.sync_managers[number as usize];
            bits |= u32::from(sm.pdi_event && sm.active && sm.settings.pdi_event) << (8 + number);
        }
        AlEvents::from_bits_truncate(bits)
    }

    pub(crate) fn all_ecat_events(&self) -> EcatEvents {
        let sync_managers = self.sync_managers.iter().take(8).enumerate();
        let bits = sync_managers
            .filter(|(_, sm)| sm.active && sm.settings.ecat_event && sm.has_ecat_event())
            .fold(0, |bits, (n, _)| bits | 0x10 << n);
        self.ecat_events | EcatEvents::from_bits_truncate(bits)
    }

    pub(crate) fn raise_ecat_event(&mut self, event: EcatEvents) {
        self.ecat_events |= event;
        self.update_masked_events();
    }

    pub(crate) fn clear_ecat_event(&mut self, event: EcatEvents) {
        self.ecat_events -= event;
        self.update_masked_events();
    }

    #[inline]
    pub(crate) fn update_masked_events(&mut self) {
        self.hot.masked_events = if self.hot.event_mask == 0 { 0 } else { self.unmasked_events() };
    }

    #[inline(never)]
    fn unmasked_events(&self) -> u16 {
        self.all_ecat_events().bits() & self.hot.event_mask
    }
}
