//! The two status words of the unit: EtherCAT Slave Status for the CPU Unit, NX Unit Status for the master.

use wire::{ObjectIndex, SubIndex};

/// A bit of a status that is an I/O port itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StatusBit {
    /// Its number, from 0.
    pub bit: u8,
    /// Name of the I/O port.
    pub port: &'static str,
}

const fn status_bit(bit: u8, port: &'static str) -> StatusBit {
    StatusBit { bit, port }
}

/// The bits of EtherCAT Slave Status; 3 to 5 and 10 to 15 are reserved and have no I/O port (manual, 6-3-2).
pub const SLAVE_STATUS_BITS: [StatusBit; 7] = [
    status_bit(0, "SDO Communications Enabled"),
    status_bit(1, "Data from EtherCAT Master to CPU Unit Valid"),
    status_bit(2, "Data from CPU Unit to EtherCAT Master Valid"),
    status_bit(6, "IN Port Link ON"),
    status_bit(7, "OUT Port Link ON"),
    status_bit(8, "New Message Data Available from EtherCAT Master"),
    status_bit(9, "Ready to Write Message Data to EtherCAT Master"),
];

/// Bit of an observation in Sysmac Error Status, CoE object 2002:01 (manual, 7-5-5).
pub const OBSERVATION_BIT: StatusBit = status_bit(4, "Observation");
/// Bit of a minor fault in it.
pub const MINOR_FAULT_BIT: StatusBit = status_bit(5, "Minor Fault");

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

/// NX Unit Status, CoE object 6003, in TxPDO 1A00 (manual, 7-5-5).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NxUnitStatus {
    /// 6003:01: NX Message Communications Enabled with the CPU Unit.
    pub nx_messages_enabled: bool,
    /// 6003:02: Data from CPU Unit to EtherCAT Master Valid.
    pub c_to_m_valid: bool,
    /// 6003:03: Data from EtherCAT Master to CPU Unit Valid.
    pub m_to_c_valid: bool,
    /// 6003:04: New Message Data Available from CPU Unit, in 3000.
    pub new_message: bool,
    /// 6003:05: Ready to Write Message Data to CPU Unit, to 3001.
    pub ready_to_write_message: bool,
}

impl NxUnitStatus {
    /// The value of 6003 at `sub`, 1 to 5; false for every other subindex.
    #[must_use]
    pub const fn bit(self, sub: u8) -> bool {
        match sub {
            1 => self.nx_messages_enabled,
            2 => self.c_to_m_valid,
            3 => self.m_to_c_valid,
            4 => self.new_message,
            5 => self.ready_to_write_message,
            _ => false,
        }
    }
}

impl Default for NxUnitStatus {
    /// The manual's defaults: 0x0010 in TxPDO 1A00.
    fn default() -> Self {
        Self {
            nx_messages_enabled: false,
            c_to_m_valid: false,
            m_to_c_valid: false,
            new_message: false,
            ready_to_write_message: true,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_words_start_as_the_manual_says() {
        assert_eq!(SlaveStatus::default().bits(), 0x0200);
        let bits = (1..=5).map(|sub| u16::from(NxUnitStatus::default().bit(sub)) << (sub - 1)).sum::<u16>();
        assert_eq!(bits, 0x0010);
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
