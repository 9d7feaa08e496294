//! What a master reads from a controller before it knows the device: its information registers and DL status.

use bitflags::bitflags;

use crate::access::word;

/// Registers 0x0000 to 0x0009.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EscInformation {
    /// Type: 0x11 is an ET1100.
    pub esc_type: u8,
    /// Revision.
    pub revision: u8,
    /// Build.
    pub build: u16,
    /// Number of FMMUs, 0 to 16.
    pub fmmus: u8,
    /// Number of SyncManagers, 0 to 16.
    pub sync_managers: u8,
    /// Process data RAM in KiB.
    pub ram_kib: u8,
    /// Port descriptor: two bits for each port, 0 to 3.
    pub ports: u8,
    /// Features.
    pub features: EscFeatures,
}

impl EscInformation {
    /// Bytes of the registers.
    pub const LENGTH_BYTES: u16 = 10;

    /// Decodes the registers; none if the bytes are too few.
    #[must_use]
    pub fn parse(bytes: &[u8]) -> Option<Self> {
        let &[esc_type, revision, b0, b1, fmmus, sync_managers, ram_kib, ports, f0, f1, ..] = bytes else {
            return None;
        };
        Some(Self {
            esc_type,
            revision,
            build: u16::from_le_bytes([b0, b1]),
            fmmus,
            sync_managers,
            ram_kib,
            ports,
            features: EscFeatures::from_bits_retain(u16::from_le_bytes([f0, f1])),
        })
    }
}

bitflags! {
    /// ESC features, register 0x0008.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub struct EscFeatures: u16 {
        /// FMMUs map whole bytes only.
        const FMMU_BYTEWISE = 1 << 0;
        /// Distributed clocks.
        const DC = 1 << 2;
        /// The clocks have 64 bits.
        const DC_64_BITS = 1 << 3;
        /// LRW is not supported.
        const NO_LRW = 1 << 9;
    }
}

/// DL status, register 0x0110.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DlStatus(pub u16);

impl DlStatus {
    /// Decodes the register.
    pub(crate) fn parse(bytes: &[u8]) -> Self {
        Self(word(bytes))
    }

    /// Whether the PDI is operational and the SII is loaded.
    #[must_use]
    pub const fn is_operational(self) -> bool {
        self.0 & 1 != 0
    }

    /// Whether a port, 0 to 3, has a physical link.
    #[must_use]
    pub const fn has_link(self, port: u8) -> bool {
        self.0 >> (4 + (port & 3)) & 1 != 0
    }

    /// Whether a port, 0 to 3, is open and communicates: another slave or the master is there.
    #[must_use]
    pub const fn is_open(self, port: u8) -> bool {
        self.0 >> (8 + 2 * (port & 3)) & 3 == 2
    }

    /// Number of open ports: 1 at the end of a line, 2 within it, more at a branch.
    #[must_use]
    pub fn open_ports(self) -> usize {
        (0..4).filter(|&port| self.is_open(port)).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_registers_of_an_et1100_are_taken_apart() {
        let bytes = [0x11, 0, 3, 0, 8, 8, 8, 0x0F, 0xFC, 0x01];
        let information = EscInformation::parse(&bytes).expect("ten bytes");
        assert_eq!((information.esc_type, information.build, information.ram_kib), (0x11, 3, 8));
        assert_eq!((information.fmmus, information.sync_managers, information.ports), (8, 8, 0x0F));
        assert!(information.features.contains(EscFeatures::DC | EscFeatures::DC_64_BITS));
        assert!(!information.features.intersects(EscFeatures::FMMU_BYTEWISE | EscFeatures::NO_LRW));
        assert_eq!(EscInformation::parse(&bytes[..9]), None);
    }

    /// Reference 1.8: one port in use, two, and the unplugged LAN9252.
    #[test]
    fn open_ports_are_counted_by_loop_and_communication() {
        for (status, open) in [(0x5613, 1), (0x5A33, 2), (0x5507, 0)] {
            let status = DlStatus(status);
            assert!(status.is_operational());
            assert_eq!(status.open_ports(), open, "{status:?}");
        }
        assert!(DlStatus(0x5A33).has_link(1) && !DlStatus(0x5613).has_link(1));
    }
}
