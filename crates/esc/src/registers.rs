//! The register map 0x0000 to 0x0FFF as one table: width, reset value, who may write which bits, side effect.
//!
//! ETG.1000.4 and the data sheet of an ET1100-class controller, as listed in reference 2.1 to 2.15. An address
//! without a row is reserved: it reads as 0 and ignores writes.

/// Bytes of the register area.
pub(crate) const REGISTER_BYTES: usize = 0x1000;
/// Start of the user RAM, which is written immediately and not at the end of the frame.
pub(crate) const USER_RAM_START: u16 = 0x0F80;
/// Start of the process data RAM.
pub(crate) const PROCESS_RAM_START: u16 = 0x1000;
/// Digital output data: registers that SyncManagers and FMMUs access like RAM, written immediately.
pub(crate) const DIGITAL_OUTPUTS: core::ops::Range<u16> = 0x0F00..0x0F04;

/// Whether an access stays within the digital output data.
#[inline]
pub(crate) const fn are_digital_outputs(offset: u16, length_bytes: usize) -> bool {
    offset >= DIGITAL_OUTPUTS.start && offset as usize + length_bytes <= DIGITAL_OUTPUTS.end as usize
}

/// Access to a register from the ECAT side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EcatAccess {
    /// Read only: a write is ignored and does not increment the working counter.
    Read,
    /// Read and write, as far as the register's effect permits.
    ReadWrite,
}

/// Access to a register from the PDI.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PdiAccess {
    /// Read only.
    Read,
    /// Read and write.
    ReadWrite,
}

/// The effect of an ECAT write, in addition to storing the bits in [`Register::stored`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    /// No other effect.
    Store,
    /// Write protection registers: they are evaluated while a frame passes.
    Protection,
    /// "RES" in three frames resets the controller.
    Reset,
    /// Opens or closes ports.
    DlControl,
    /// A request, which remains until the PDI has read it.
    AlControl,
    /// Clears the port error counters 0x0300 to 0x030B.
    ClearPortErrors,
    /// Clears the processing unit error counter.
    ClearProcessingUnitErrors,
    /// Clears the PDI error counter.
    ClearPdiErrors,
    /// Clears the lost link counters.
    ClearLostLinks,
    /// Sets the process data watchdog again.
    Watchdog,
    /// Clears both watchdog counters.
    ClearWatchdogCounters,
    /// Assigns the SII to ECAT or PDI.
    SiiOwner,
    /// Runs a command on the SII.
    SiiCommand,
    /// Sets an FMMU again.
    Fmmu,
    /// The SyncManager determines which of its bytes are accepted.
    SyncManager,
    /// Latches the receive times of this frame.
    DcLatch,
    /// Feeds the time control loop.
    DcSystemTime,
    /// Resets the time control loop.
    DcSpeedCounter,
}

impl Effect {
    const COUNT: usize = Self::DcSpeedCounter as usize + 1;
}

const _: () = assert!(Effect::COUNT <= 32);

/// One row of the register map.
#[derive(Clone, Copy, Debug)]
pub struct Register {
    /// Its name in the standard.
    pub name: &'static str,
    /// Offset of its first byte (of the first one, in a bank).
    pub offset: u16,
    /// Width in bytes.
    pub size_bytes: u16,
    /// Access from the ECAT side.
    pub ecat: EcatAccess,
    /// Access from the PDI.
    pub pdi: PdiAccess,
    /// Value after power-on, little endian over the width.
    pub reset: u32,
    /// The bits that an ECAT write stores, byte by byte; bytes beyond the end of this list are stored
    /// completely. The other bits are reserved, read-only or cleared by any write.
    pub stored: &'static [u8],
    /// Any other effect of an ECAT write.
    pub effect: Effect,
    /// Number of consecutive registers.
    pub count: u16,
    /// Distance from one to the next in bytes.
    pub stride_bytes: u16,
}

use EcatAccess::{Read as R, ReadWrite as W};
use Effect::Store;

const fn row(
    name: &'static str,
    offset: u16,
    size_bytes: u16,
    ecat: EcatAccess,
    pdi: EcatAccess,
) -> Register {
    let pdi = match pdi {
        R => PdiAccess::Read,
        W => PdiAccess::ReadWrite,
    };
    Register {
        name,
        offset,
        size_bytes,
        ecat,
        pdi,
        reset: 0,
        stored: &[],
        effect: Store,
        count: 1,
        stride_bytes: size_bytes,
    }
}

impl Register {
    const fn reset(self, reset: u32) -> Self {
        Self { reset, ..self }
    }

    const fn stores(self, stored: &'static [u8]) -> Self {
        Self { stored, ..self }
    }

    const fn effect(self, effect: Effect) -> Self {
        Self { effect, ..self }
    }

    const fn times(self, count: u16, stride_bytes: u16) -> Self {
        Self { count, stride_bytes, ..self }
    }
}

/// Offsets that the code uses by name; each has its row in [`REGISTERS`].
pub(crate) mod at {
    pub(crate) const TYPE: u16 = 0x0000;
    pub(crate) const FMMU_COUNT: u16 = 0x0004;
    pub(crate) const SM_COUNT: u16 = 0x0005;
    pub(crate) const RAM_KIB: u16 = 0x0006;
    pub(crate) const PORT_DESCRIPTOR: u16 = 0x0007;
    pub(crate) const FEATURES: u16 = 0x0008;
    pub(crate) const STATION_ADDRESS: u16 = 0x0010;
    pub(crate) const STATION_ALIAS: u16 = 0x0012;
    pub(crate) const WRITE_REGISTER_ENABLE: u16 = 0x0020;
    pub(crate) const WRITE_REGISTER_PROTECTION: u16 = 0x0021;
    pub(crate) const ESC_WRITE_ENABLE: u16 = 0x0030;
    pub(crate) const ESC_WRITE_PROTECTION: u16 = 0x0031;
    pub(crate) const ESC_RESET_ECAT: u16 = 0x0040;
    pub(crate) const DL_CONTROL: u16 = 0x0100;
    pub(crate) const DL_STATUS: u16 = 0x0110;
    pub(crate) const AL_CONTROL: u16 = 0x0120;
    pub(crate) const AL_STATUS: u16 = 0x0130;
    pub(crate) const AL_STATUS_CODE: u16 = 0x0134;
    pub(crate) const PDI_CONTROL: u16 = 0x0140;
    pub(crate) const ESC_CONFIGURATION: u16 = 0x0141;
    pub(crate) const PDI_CONFIGURATION: u16 = 0x0150;
    pub(crate) const EXTENDED_PDI_CONFIGURATION: u16 = 0x0152;
    pub(crate) const ECAT_EVENT_MASK: u16 = 0x0200;
    pub(crate) const AL_EVENT_MASK: u16 = 0x0204;
    pub(crate) const ECAT_EVENT_REQUEST: u16 = 0x0210;
    pub(crate) const AL_EVENT_REQUEST: u16 = 0x0220;
    pub(crate) const PORT_ERRORS: u16 = 0x0300;
    pub(crate) const FORWARDED_ERRORS: u16 = 0x0308;
    pub(crate) const PROCESSING_UNIT_ERRORS: u16 = 0x030C;
    pub(crate) const PDI_ERRORS: u16 = 0x030D;
    pub(crate) const LOST_LINKS: u16 = 0x0310;
    pub(crate) const WATCHDOG_DIVIDER: u16 = 0x0400;
    pub(crate) const WATCHDOG_TIME_PROCESS_DATA: u16 = 0x0420;
    pub(crate) const WATCHDOG_STATUS: u16 = 0x0440;
    pub(crate) const WATCHDOG_COUNTER: u16 = 0x0442;
    pub(crate) const SII_OWNER: u16 = 0x0500;
    pub(crate) const SII_PDI_STATE: u16 = 0x0501;
    pub(crate) const SII_CONTROL: u16 = 0x0502;
    pub(crate) const SII_ADDRESS: u16 = 0x0504;
    pub(crate) const SII_DATA: u16 = 0x0508;
    pub(crate) const FMMU: u16 = 0x0600;
    pub(crate) const SYNC_MANAGER: u16 = 0x0800;
    pub(crate) const RECEIVE_TIME_PORT: u16 = 0x0900;
    pub(crate) const SYSTEM_TIME: u16 = 0x0910;
    pub(crate) const RECEIVE_TIME_EPU: u16 = 0x0918;
    pub(crate) const SYSTEM_TIME_OFFSET: u16 = 0x0920;
    pub(crate) const SYSTEM_TIME_DELAY: u16 = 0x0928;
    pub(crate) const SYSTEM_TIME_DIFFERENCE: u16 = 0x092C;
    pub(crate) const SPEED_COUNTER_START: u16 = 0x0930;
    pub(crate) const SPEED_COUNTER_DIFFERENCE: u16 = 0x0932;
    pub(crate) const SYNC_PULSE_LENGTH: u16 = 0x0982;
}

/// Nothing is stored in a register for which a write is only a command.
const NOTHING: &[u8] = &[0; 8];
/// Start bit, stop bit and physical start bit have values up to 7; type is read and write; activate is one bit.
const FMMU_BITS: [u8; 16] =
    [0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x07, 0x07, 0xFF, 0xFF, 0x07, 0x03, 0x01, 0, 0, 0];

/// The register map, ascending by offset.
pub const REGISTERS: &[Register] = &[
    row("Type", at::TYPE, 1, R, R).reset(0x11),
    row("Revision", 0x0001, 1, R, R),
    row("Build", 0x0002, 2, R, R).reset(0x0003),
    row("FMMUs supported", at::FMMU_COUNT, 1, R, R),
    row("SyncManagers supported", at::SM_COUNT, 1, R, R),
    row("RAM size in KiB", at::RAM_KIB, 1, R, R),
    row("Port descriptor", at::PORT_DESCRIPTOR, 1, R, R),
    row("ESC features supported", at::FEATURES, 2, R, R),
    row("Configured station address", at::STATION_ADDRESS, 2, W, R),
    row("Configured station alias", at::STATION_ALIAS, 2, R, W),
    row("Write register enable", at::WRITE_REGISTER_ENABLE, 1, W, R)
        .stores(&[0x01])
        .effect(Effect::Protection),
    row("Write register protection", at::WRITE_REGISTER_PROTECTION, 1, W, R)
        .stores(&[0x01])
        .effect(Effect::Protection),
    row("ESC write enable", at::ESC_WRITE_ENABLE, 1, W, R).stores(&[0x01]).effect(Effect::Protection),
    row("ESC write protection", at::ESC_WRITE_PROTECTION, 1, W, R).stores(&[0x01]).effect(Effect::Protection),
    row("ESC reset ECAT", at::ESC_RESET_ECAT, 1, W, R).stores(NOTHING).effect(Effect::Reset),
    row("ESC reset PDI", 0x0041, 1, R, W),
    row("DL control", at::DL_CONTROL, 4, W, R)
        .reset(0x0007_0001)
        .stores(&[0x03, 0xFF, 0x4F, 0x01])
        .effect(Effect::DlControl),
    row("Physical read/write offset", 0x0108, 2, W, R),
    row("DL status", at::DL_STATUS, 2, R, R),
    row("AL control", at::AL_CONTROL, 2, W, R).reset(0x0001).stores(&[0x3F, 0x00]).effect(Effect::AlControl),
    row("AL status", at::AL_STATUS, 2, R, W).reset(0x0001),
    row("AL status code", at::AL_STATUS_CODE, 2, R, W),
    row("RUN LED override", 0x0138, 1, W, W).stores(&[0x1F]),
    row("ERR LED override", 0x0139, 1, W, W).stores(&[0x1F]),
    row("PDI control", at::PDI_CONTROL, 1, R, R),
    row("ESC configuration", at::ESC_CONFIGURATION, 1, R, R),
    row("PDI information", 0x014E, 2, R, R),
    row("PDI configuration", at::PDI_CONFIGURATION, 2, R, R),
    row("Extended PDI configuration", at::EXTENDED_PDI_CONFIGURATION, 2, R, R),
    row("ECAT event mask", at::ECAT_EVENT_MASK, 2, W, R),
    row("AL event mask", at::AL_EVENT_MASK, 4, R, W).reset(0x00FF_FF0F),
    row("ECAT event request", at::ECAT_EVENT_REQUEST, 2, R, R),
    row("AL event request", at::AL_EVENT_REQUEST, 4, R, R),
    row("Invalid frame and RX error counter", at::PORT_ERRORS, 2, W, R)
        .stores(NOTHING)
        .effect(Effect::ClearPortErrors)
        .times(4, 2),
    row("Forwarded RX error counter", at::FORWARDED_ERRORS, 1, W, R)
        .stores(NOTHING)
        .effect(Effect::ClearPortErrors)
        .times(4, 1),
    row("ECAT processing unit error counter", at::PROCESSING_UNIT_ERRORS, 1, W, R)
        .stores(NOTHING)
        .effect(Effect::ClearProcessingUnitErrors),
    row("PDI error counter", at::PDI_ERRORS, 1, W, R).stores(NOTHING).effect(Effect::ClearPdiErrors),
    row("PDI error code", 0x030E, 2, R, R),
    row("Lost link counter", at::LOST_LINKS, 1, W, R)
        .stores(NOTHING)
        .effect(Effect::ClearLostLinks)
        .times(4, 1),
    row("Watchdog divider", at::WATCHDOG_DIVIDER, 2, W, R).reset(0x09C2).effect(Effect::Watchdog),
    row("Watchdog time PDI", 0x0410, 2, W, R).reset(0x03E8),
    row("Watchdog time process data", at::WATCHDOG_TIME_PROCESS_DATA, 2, W, R)
        .reset(0x03E8)
        .effect(Effect::Watchdog),
    row("Watchdog status process data", at::WATCHDOG_STATUS, 2, R, R).reset(0x0001),
    row("Watchdog counter process data", at::WATCHDOG_COUNTER, 1, W, W)
        .stores(NOTHING)
        .effect(Effect::ClearWatchdogCounters),
    row("Watchdog counter PDI", 0x0443, 1, W, W).stores(NOTHING).effect(Effect::ClearWatchdogCounters),
    row("SII owner", at::SII_OWNER, 1, W, R).stores(&[0x03]).effect(Effect::SiiOwner),
    row("SII PDI access state", at::SII_PDI_STATE, 1, R, W),
    row("SII control/status", at::SII_CONTROL, 2, W, W).stores(NOTHING).effect(Effect::SiiCommand),
    row("SII address", at::SII_ADDRESS, 4, W, W).effect(Effect::SiiCommand),
    row("SII data", at::SII_DATA, 8, W, W).effect(Effect::SiiCommand),
    // No PHY is connected: a command is complete immediately, without error, and is not stored.
    row("MII control/status", 0x0510, 2, W, W).stores(&[0x01, 0x00]),
    row("PHY address", 0x0512, 1, W, W).stores(&[0x1F]),
    row("PHY register address", 0x0513, 1, W, W).stores(&[0x1F]),
    row("PHY data", 0x0514, 2, W, W),
    row("MII ECAT access state", 0x0516, 1, W, R).stores(&[0x01]),
    row("MII PDI access state", 0x0517, 1, R, W),
    row("PHY port status", 0x0518, 1, R, R).times(4, 1),
    row("FMMU", at::FMMU, 16, W, R).stores(&FMMU_BITS).effect(Effect::Fmmu).times(16, 16),
    row("SyncManager", at::SYNC_MANAGER, 8, W, R)
        .stores(&[0xFF, 0xFF, 0xFF, 0xFF, 0x7F, 0x00, 0xC3, 0x00])
        .effect(Effect::SyncManager)
        .times(16, 8),
    row("Receive time port 0", at::RECEIVE_TIME_PORT, 4, W, R).stores(NOTHING).effect(Effect::DcLatch),
    row("Receive time ports 1 to 3", at::RECEIVE_TIME_PORT + 4, 4, R, R).times(3, 4),
    row("System time", at::SYSTEM_TIME, 8, W, R).stores(NOTHING).effect(Effect::DcSystemTime),
    row("Receive time EPU", at::RECEIVE_TIME_EPU, 8, R, R),
    row("System time offset", at::SYSTEM_TIME_OFFSET, 8, W, R),
    row("System time delay", at::SYSTEM_TIME_DELAY, 4, W, R),
    row("System time difference", at::SYSTEM_TIME_DIFFERENCE, 4, R, R),
    row("Speed counter start", at::SPEED_COUNTER_START, 2, W, R)
        .reset(0x1000)
        .stores(&[0xFF, 0x7F])
        .effect(Effect::DcSpeedCounter),
    row("Speed counter difference", at::SPEED_COUNTER_DIFFERENCE, 2, R, R),
    row("System time difference filter depth", 0x0934, 1, W, R).reset(0x04).stores(&[0x0F]),
    row("Speed counter filter depth", 0x0935, 1, W, R).reset(0x0C).stores(&[0x0F]),
    row("Receive time latch mode", 0x0936, 1, W, R).stores(&[0x01]),
    row("Cyclic unit control", 0x0980, 1, W, R).stores(&[0x31]),
    row("DC activation", 0x0981, 1, W, R),
    row("Pulse length of SYNC signals", at::SYNC_PULSE_LENGTH, 2, R, R),
    row("DC activation status", 0x0984, 1, R, R),
    row("SYNC0 and SYNC1 status", 0x098E, 1, R, R).times(2, 1),
    row("Start time cyclic operation", 0x0990, 8, W, R),
    row("Next SYNC1 pulse", 0x0998, 8, R, R),
    row("SYNC0 and SYNC1 cycle time", 0x09A0, 4, W, R).times(2, 4),
    row("Latch 0 and 1 control", 0x09A8, 1, W, R).stores(&[0x03]).times(2, 1),
    row("Latch 0 and 1 status", 0x09AE, 1, R, R).times(2, 1),
    row("Latch times", 0x09B0, 8, R, R).times(4, 8),
    row("EtherCAT buffer change event time", 0x09F0, 4, R, R),
    row("PDI buffer start and change event time", 0x09F8, 4, R, R).times(2, 4),
    row("ESC specific", 0x0E00, 8, R, R).times(32, 8),
    row("Digital output data", DIGITAL_OUTPUTS.start, 4, W, R),
    row("General purpose outputs", 0x0F10, 8, W, W),
    row("General purpose inputs", 0x0F18, 8, R, R),
    row("User RAM", USER_RAM_START, 128, W, W),
];

/// The table's values for each byte, for use while a frame passes.
pub(crate) struct ByteMap {
    writable: [bool; REGISTER_BYTES],
    stored: [u8; REGISTER_BYTES],
    effect: [Effect; REGISTER_BYTES],
}

/// The table, unrolled to bytes by the compiler; an overlap of two rows does not compile.
pub(crate) static BYTES: ByteMap = ByteMap::unroll();

impl ByteMap {
    const fn unroll() -> Self {
        let mut map = Self {
            writable: [false; REGISTER_BYTES],
            stored: [0; REGISTER_BYTES],
            effect: [Store; REGISTER_BYTES],
        };
        let mut free_from = 0;
        let mut row = 0;
        while row < REGISTERS.len() {
            let register = REGISTERS[row];
            let mut one = 0;
            while one < register.count {
                let start = register.offset + one * register.stride_bytes;
                assert!(start >= free_from, "two rows of the register map overlap");
                free_from = start + register.size_bytes;
                let mut offset = start;
                while offset < free_from {
                    let byte = (offset - start) as usize;
                    map.writable[offset as usize] = matches!(register.ecat, W);
                    map.stored[offset as usize] =
                        if byte < register.stored.len() { register.stored[byte] } else { 0xFF };
                    map.effect[offset as usize] = register.effect;
                    offset += 1;
                }
                one += 1;
            }
            row += 1;
        }
        map
    }

    /// Whether the ECAT side may write the byte at `offset`.
    #[inline]
    pub(crate) fn writable(&self, offset: u16) -> bool {
        self.writable.get(usize::from(offset)).copied().unwrap_or(false)
    }

    /// Which bits of the byte at `offset` an ECAT write stores.
    #[inline]
    pub(crate) fn stored(&self, offset: u16) -> u8 {
        self.stored.get(usize::from(offset)).copied().unwrap_or(0)
    }

    /// The effect of a write to the byte at `offset`.
    #[inline]
    pub(crate) fn effect(&self, offset: u16) -> Effect {
        self.effect.get(usize::from(offset)).copied().unwrap_or(Store)
    }
}

/// Whether a read of the 16 bytes around `offset` needs values that must be calculated first: event requests,
/// watchdog status, SII, SyncManager status, DC.
#[inline]
pub(crate) const fn is_live(offset: u16) -> bool {
    matches!(offset >> 4, 0x20..=0x22 | 0x44 | 0x50 | 0x80..=0x87 | 0x90..=0x9F)
}
