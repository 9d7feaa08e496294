//! SyncManagers and FMMUs as the master writes them.

use esi::MailboxArea;

/// The settings of a SyncManager, correct or incorrect.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SyncManagerSettings {
    /// Its number, 0 to 15.
    pub number: u8,
    /// Physical start address.
    pub start: u16,
    /// Length in bytes.
    pub length_bytes: u16,
    /// Control byte: bits 1:0 mode, 3:2 direction, 4 and 5 interrupts, 6 watchdog trigger.
    pub control: u8,
    /// Activate byte; bit 0 enables it.
    pub activate: u8,
}

impl SyncManagerSettings {
    /// The control byte of the mailbox from master to slave.
    pub const MAILBOX_OUT: u8 = 0x26;
    /// The control byte of the mailbox from slave to master.
    pub const MAILBOX_IN: u8 = 0x22;

    /// A mailbox, enabled.
    #[must_use]
    pub const fn mailbox(number: u8, area: MailboxArea, control: u8) -> Self {
        Self { number, start: area.start, length_bytes: area.length_bytes, control, activate: 1 }
    }

    /// The eight bytes of its registers; the slave sets status and PDI control.
    #[must_use]
    pub const fn pack(&self) -> [u8; 8] {
        let ([s0, s1], [l0, l1]) = (self.start.to_le_bytes(), self.length_bytes.to_le_bytes());
        [s0, s1, l0, l1, self.control, 0, self.activate, 0]
    }
}

/// The settings of an FMMU, correct or incorrect.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FmmuSettings {
    /// Its number, 0 to 15.
    pub number: u8,
    /// First logical byte.
    pub logical_start: u32,
    /// Length in bytes, from the first to the last byte touched.
    pub length_bytes: u16,
    /// First bit in the first logical byte, 0 to 7.
    pub logical_start_bit: u8,
    /// Last bit in the last logical byte, 0 to 7.
    pub logical_stop_bit: u8,
    /// First byte in the memory of the slave.
    pub physical_start: u16,
    /// First bit in the first physical byte, 0 to 7.
    pub physical_start_bit: u8,
    /// Bit 0 maps reads, bit 1 maps writes.
    pub kind: u8,
    /// Activate byte; bit 0 activates it.
    pub activate: u8,
}

impl FmmuSettings {
    /// The sixteen bytes of its registers.
    #[must_use]
    pub const fn pack(&self) -> [u8; 16] {
        let [a0, a1, a2, a3] = self.logical_start.to_le_bytes();
        let ([l0, l1], [p0, p1]) = (self.length_bytes.to_le_bytes(), self.physical_start.to_le_bytes());
        let (start_bit, stop_bit) = (self.logical_start_bit, self.logical_stop_bit);
        [
            a0,
            a1,
            a2,
            a3,
            l0,
            l1,
            start_bit,
            stop_bit,
            p0,
            p1,
            self.physical_start_bit,
            self.kind,
            self.activate,
            0,
            0,
            0,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use esc::Fmmu;

    #[test]
    fn a_controller_reads_an_fmmu_as_it_was_meant() {
        let settings = FmmuSettings {
            number: 3,
            logical_start: 0x0102_0304,
            length_bytes: 0x0506,
            logical_start_bit: 3,
            logical_stop_bit: 5,
            physical_start: 0x1100,
            physical_start_bit: 1,
            kind: 2,
            activate: 1,
        };
        let read = Fmmu {
            logical_start: 0x0102_0304,
            length_bytes: 0x0506,
            logical_start_bit: 3,
            logical_stop_bit: 5,
            physical_start: 0x1100,
            physical_start_bit: 1,
            read: false,
            write: true,
            active: true,
        };
        assert_eq!(Fmmu::from_bytes(&settings.pack()), read);
    }

    #[test]
    fn a_mailbox_is_packed_as_masters_write_it() {
        let area = MailboxArea { start: 0x1000, length_bytes: 0x0100 };
        let out = SyncManagerSettings::mailbox(0, area, SyncManagerSettings::MAILBOX_OUT);
        assert_eq!(out.pack(), [0x00, 0x10, 0x00, 0x01, 0x26, 0, 1, 0]);
    }
}
