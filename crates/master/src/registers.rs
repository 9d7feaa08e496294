//! Offsets of the registers that a master uses. The ESC's table has widths and access rights; a test compares them.

/// Type, revision, build, FMMUs, SyncManagers, RAM size, port descriptor, features: 10 bytes.
pub const INFORMATION: u16 = 0x0000;
/// Configured station address, 2 bytes.
pub const STATION_ADDRESS: u16 = 0x0010;
/// Configured station alias, 2 bytes.
pub const STATION_ALIAS: u16 = 0x0012;
/// DL control, 4 bytes: forwarding rule, loops of the ports, alias.
pub const DL_CONTROL: u16 = 0x0100;
/// Physical read/write offset, 2 bytes.
pub const READ_WRITE_OFFSET: u16 = 0x0108;
/// DL status, 2 bytes.
pub const DL_STATUS: u16 = 0x0110;
/// AL control, 2 bytes.
pub const AL_CONTROL: u16 = 0x0120;
/// AL status, 2 bytes; together with two reserved bytes and the AL status code 6.
pub const AL_STATUS: u16 = 0x0130;
/// AL status code, 2 bytes.
pub const AL_STATUS_CODE: u16 = 0x0134;
/// ECAT event mask, 2 bytes.
pub const ECAT_EVENT_MASK: u16 = 0x0200;
/// Invalid frame and RX error counters of the ports, 8 bytes; a write clears them.
pub const PORT_ERRORS: u16 = 0x0300;
/// Watchdog divider, 2 bytes.
pub const WATCHDOG_DIVIDER: u16 = 0x0400;
/// PDI watchdog time, 2 bytes.
pub const PDI_WATCHDOG: u16 = 0x0410;
/// Process data watchdog time, 2 bytes.
pub const PROCESS_DATA_WATCHDOG: u16 = 0x0420;
/// SII owner, 1 byte: bit 0 offers the SII to the PDI, bit 1 forces it back.
pub const SII_OWNER: u16 = 0x0500;
/// SII control and status, 2 bytes.
pub const SII_CONTROL: u16 = 0x0502;
/// SII data, 4 or 8 bytes.
pub const SII_DATA: u16 = 0x0508;
/// FMMU 0, 16 bytes; the others follow.
pub const FMMU: u16 = 0x0600;
/// SyncManager 0, 8 bytes; the others follow.
pub const SYNC_MANAGER: u16 = 0x0800;
/// Receive time of port 0, 4 bytes; those of ports 1 to 3 follow. A write latches all of them.
pub const RECEIVE_TIMES: u16 = 0x0900;
/// System time, 8 bytes.
pub const SYSTEM_TIME: u16 = 0x0910;
/// Receive time of the processing unit, 8 bytes.
pub const RECEIVE_TIME_EPU: u16 = 0x0918;
/// Speed counter start, 2 bytes.
pub const SPEED_COUNTER_START: u16 = 0x0930;
/// Filter depths of the time control loop, 2 bytes.
pub const TIME_FILTERS: u16 = 0x0934;
/// DC activation, 1 byte.
pub const DC_ACTIVATION: u16 = 0x0981;

/// Bytes of one FMMU.
pub const FMMU_BYTES: u16 = 16;
/// Bytes of one SyncManager.
pub const SYNC_MANAGER_BYTES: u16 = 8;
/// Status within a SyncManager; bit 3: its mailbox is full.
pub const SYNC_MANAGER_STATUS: u16 = 5;
/// Activate within a SyncManager; bit 1: repeat request.
pub const SYNC_MANAGER_ACTIVATE: u16 = 6;

/// The offset of FMMU `number`.
#[must_use]
pub const fn fmmu(number: u8) -> u16 {
    FMMU + FMMU_BYTES * number as u16
}

/// The offset of SyncManager `number`.
#[must_use]
pub const fn sync_manager(number: u8) -> u16 {
    SYNC_MANAGER + SYNC_MANAGER_BYTES * number as u16
}

#[cfg(test)]
mod tests {
    use super::*;
    use esc::REGISTERS;

    #[test]
    fn every_offset_is_a_row_of_the_controllers_table() {
        for (offset, name) in [
            (INFORMATION, "Type"),
            (STATION_ADDRESS, "Configured station address"),
            (STATION_ALIAS, "Configured station alias"),
            (DL_CONTROL, "DL control"),
            (READ_WRITE_OFFSET, "Physical read/write offset"),
            (DL_STATUS, "DL status"),
            (AL_CONTROL, "AL control"),
            (AL_STATUS, "AL status"),
            (AL_STATUS_CODE, "AL status code"),
            (ECAT_EVENT_MASK, "ECAT event mask"),
            (PORT_ERRORS, "Invalid frame and RX error counter"),
            (WATCHDOG_DIVIDER, "Watchdog divider"),
            (PDI_WATCHDOG, "Watchdog time PDI"),
            (PROCESS_DATA_WATCHDOG, "Watchdog time process data"),
            (SII_OWNER, "SII owner"),
            (SII_CONTROL, "SII control/status"),
            (SII_DATA, "SII data"),
            (FMMU, "FMMU"),
            (SYNC_MANAGER, "SyncManager"),
            (RECEIVE_TIMES, "Receive time port 0"),
            (SYSTEM_TIME, "System time"),
            (RECEIVE_TIME_EPU, "Receive time EPU"),
            (SPEED_COUNTER_START, "Speed counter start"),
            (TIME_FILTERS, "System time difference filter depth"),
            (DC_ACTIVATION, "DC activation"),
        ] {
            let row = REGISTERS.iter().find(|row| row.offset == offset).expect(name);
            assert_eq!(row.name, name);
        }
    }

    #[test]
    fn banks_have_the_stride_of_the_controllers_table() {
        for (offset, stride_bytes) in [(FMMU, FMMU_BYTES), (SYNC_MANAGER, SYNC_MANAGER_BYTES)] {
            let row = REGISTERS.iter().find(|row| row.offset == offset).expect("a row");
            assert_eq!(row.stride_bytes, stride_bytes);
        }
        assert_eq!((fmmu(2), sync_manager(3)), (0x0620, 0x0818));
    }
}
