//! The positions of mailboxes and process data in the unit's ESC memory, and the identity of the unit.
//!
//! 8 KiB of process RAM at 0x1000 to 0x2FFF. Buffered areas take three times their length: outputs of 1,200
//! bytes end at 0x21AF, inputs of 1,204 bytes at 0x2FCB.

/// Vendor ID (object 1018:01).
pub const VENDOR_ID: u32 = 0x0000_0083;
/// Vendor name.
pub const VENDOR_NAME: &str = "OMRON Corporation";
/// Product code (object 1018:02).
pub const PRODUCT_CODE: u32 = 0x0000_017C;
/// Revision number (object 1018:03).
pub const REVISION: u32 = 0x0001_0000;
/// Order code.
pub const ORDER_CODE: &str = "NX-ECT101";

/// SyncManager 0, mailbox from master to slave: start.
pub const MAILBOX_RECEIVE_START: u16 = 0x1000;
/// SyncManager 1, mailbox from slave to master: start.
pub const MAILBOX_SEND_START: u16 = 0x1200;
/// Length of each mailbox in bytes (manual, 1-4-1).
pub const MAILBOX_BYTES: u16 = 400;
/// SyncManager 2, outputs: start.
pub const OUTPUTS_START: u16 = 0x13A0;
/// SyncManager 2: maximum length in bytes (manual, 1-4-1).
pub const OUTPUTS_MAX_BYTES: u16 = 1_200;
/// SyncManager 3, inputs: start.
pub const INPUTS_START: u16 = 0x21B0;
/// SyncManager 3: maximum length in bytes (manual, 1-4-1).
pub const INPUTS_MAX_BYTES: u16 = 1_204;
/// First byte after the process RAM.
pub const PROCESS_RAM_END: u16 = 0x3000;

/// Control byte of SyncManager 0: mailbox, the master writes, PDI interrupt.
pub const MAILBOX_RECEIVE_CONTROL: u8 = 0x26;
/// Control byte of SyncManager 1: mailbox, the master reads, PDI interrupt.
pub const MAILBOX_SEND_CONTROL: u8 = 0x22;
/// Control byte of SyncManager 2: three buffers, the master writes, PDI interrupt, watchdog trigger.
pub const OUTPUTS_CONTROL: u8 = 0x64;
/// Control byte of SyncManager 3: three buffers, the master reads, PDI interrupt.
pub const INPUTS_CONTROL: u8 = 0x20;

/// Length of the EEPROM in bytes.
pub const EEPROM_BYTES: u32 = 2048;

const _: () = assert!(MAILBOX_RECEIVE_START + MAILBOX_BYTES <= MAILBOX_SEND_START);
const _: () = assert!(MAILBOX_SEND_START + MAILBOX_BYTES <= OUTPUTS_START);
const _: () = assert!(OUTPUTS_START + 3 * OUTPUTS_MAX_BYTES <= INPUTS_START);
const _: () = assert!(INPUTS_START + 3 * INPUTS_MAX_BYTES <= PROCESS_RAM_END);
