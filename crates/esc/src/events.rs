//! Event requests towards the wire and towards the PDI.

use bitflags::bitflags;

bitflags! {
    /// ECAT event request, register 0x0210; masked by 0x0200 it goes into the datagrams.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub struct EcatEvents: u16 {
        /// Bit 0: DC latch.
        const DC_LATCH = 1 << 0;
        /// Bit 2: DL status has changed.
        const DL_STATUS = 1 << 2;
        /// Bit 3: AL status has changed.
        const AL_STATUS = 1 << 3;
        /// Bits 4 to 11: SyncManager 0 to 7.
        const SYNC_MANAGERS = 0x0FF0;
    }
}

bitflags! {
    /// AL event request, register 0x0220; masked by 0x0204 it interrupts the PDI.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub struct AlEvents: u32 {
        /// Bit 0: AL control has been written.
        const AL_CONTROL = 1 << 0;
        /// Bit 4: the activation byte of a SyncManager has been written.
        const SYNC_MANAGER_ACTIVATION = 1 << 4;
        /// Bit 6: the process data watchdog has expired.
        const WATCHDOG = 1 << 6;
        /// Bits 8 to 23: SyncManager 0 to 15.
        const SYNC_MANAGERS = 0x00FF_FF00;
    }
}
