//! EtherCAT Slave Status: the status word of an EtherCAT slave unit on the NX bus.

use wire::{ObjectIndex, SubIndex};

/// EtherCAT Slave Status, NX object 6003:01, one word that is sent to the CPU Unit with the data (manual, 6-3-2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SlaveStatus {
    /// Bit 0: SDO communications with the master are possible.
    pub sdo_enabled: bool,
    /// Bit 1: Data from EtherCAT Master to CPU Unit Valid.
    pub m_to_c_valid: bool,
    /// Bit 2: Data from CPU Unit to EtherCAT Master Valid.
    pub c_to_m_valid: bool,
    /// Bit 6: the link at port IN is on.
    pub in_port_link: bool,
    /// Bit 7: the link at port OUT is on.
    pub out_port_link: bool,
    /// Bit 8: New Message Data Available from EtherCAT Master, in NX object 5000.
    pub new_message: bool,
    /// Bit 9: Ready to Write Message Data to EtherCAT Master, to NX object 5001.
    pub ready_to_write_message: bool,
}

impl SlaveStatus {
    /// The NX object that contains it.
    pub const NX_OBJECT: (ObjectIndex, SubIndex) = (ObjectIndex(0x6003), SubIndex(1));

    /// The word. Reserved bits are 0.
    #[must_use]
    pub const fn bits(self) -> u16 {
        self.sdo_enabled as u16
            | (self.m_to_c_valid as u16) << 1
            | (self.c_to_m_valid as u16) << 2
            | (self.in_port_link as u16) << 6
            | (self.out_port_link as u16) << 7
            | (self.new_message as u16) << 8
            | (self.ready_to_write_message as u16) << 9
    }

    /// The status in the word. Reserved bits are ignored.
    #[must_use]
    pub const fn from_bits(bits: u16) -> Self {
        Self {
            sdo_enabled: bits & 1 != 0,
            m_to_c_valid: bits & 1 << 1 != 0,
            c_to_m_valid: bits & 1 << 2 != 0,
            in_port_link: bits & 1 << 6 != 0,
            out_port_link: bits & 1 << 7 != 0,
            new_message: bits & 1 << 8 != 0,
            ready_to_write_message: bits & 1 << 9 != 0,
        }
    }
}

impl Default for SlaveStatus {
    /// The manual's default, 0x0200.
    fn default() -> Self {
        Self {
            sdo_enabled: false,
            m_to_c_valid: false,
            c_to_m_valid: false,
            in_port_link: false,
            out_port_link: false,
            new_message: false,
            ready_to_write_message: true,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_word_starts_as_the_manual_says() {
        assert_eq!(SlaveStatus::default().bits(), 0x0200);
    }

    #[test]
    fn every_bit_of_the_slave_status_has_its_place() {
        let off = SlaveStatus { ready_to_write_message: false, ..SlaveStatus::default() };
        let words = [
            SlaveStatus { sdo_enabled: true, ..off },
            SlaveStatus { m_to_c_valid: true, ..off },
            SlaveStatus { c_to_m_valid: true, ..off },
            SlaveStatus { in_port_link: true, ..off },
            SlaveStatus { out_port_link: true, ..off },
            SlaveStatus { new_message: true, ..off },
            SlaveStatus { ready_to_write_message: true, ..off },
        ];
        assert_eq!(words.map(SlaveStatus::bits), [0x0001, 0x0002, 0x0004, 0x0040, 0x0080, 0x0100, 0x0200]);
    }
}
