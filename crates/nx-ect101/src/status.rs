//! The two status words of the unit: EtherCAT Slave Status for the CPU Unit, as I/O ports, and NX Unit Status for the
//! master.

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
    fn nx_unit_status_starts_as_the_manual_says() {
        let bits = (1..=5).map(|sub| u16::from(NxUnitStatus::default().bit(sub)) << (sub - 1)).sum::<u16>();
        assert_eq!(bits, 0x0010);
    }
}
