//! Positions in the EEPROM: byte offsets of the header, category numbers.

use core::ops::Range;

/// Words 0 to 6, which the checksum covers.
pub(super) const CONFIGURATION: Range<usize> = 0..14;
/// Word 4: configured station alias.
pub(super) const STATION_ALIAS: usize = 8;
/// Word 7: checksum in the low byte.
pub(super) const CHECKSUM: usize = 14;
/// Words 8 and 9.
pub(super) const VENDOR_ID: usize = 16;
/// Words 0x0A and 0x0B.
pub(super) const PRODUCT_CODE: usize = 20;
/// Words 0x0C and 0x0D.
pub(super) const REVISION: usize = 24;
/// Words 0x0E and 0x0F.
pub(super) const SERIAL: usize = 28;
/// Words 0x14 to 0x17: receive area, send area, start before length.
pub(super) const BOOTSTRAP_MAILBOX: usize = 40;
/// Words 0x18 to 0x1B, in the same order.
pub(super) const STANDARD_MAILBOX: usize = 48;
/// Word 0x1C.
pub(super) const MAILBOX_PROTOCOLS: usize = 56;
/// Word 0x3E: size in Kibit, less one.
pub(super) const SIZE: usize = 124;
/// Word 0x3F.
pub(super) const VERSION: usize = 126;
/// Word 0x40: the first category.
pub(super) const CATEGORIES: usize = 128;

/// The version in word 0x3F.
pub(super) const CURRENT_VERSION: u16 = 1;
/// The size word counts units of 1,024 bits.
pub(super) const SIZE_STEP_BYTES: u32 = 128;
/// Length of category 30. IgH accepts no other.
pub(super) const GENERAL_BYTES: usize = 32;
/// Length of a SyncManager in category 41.
pub(super) const SYNC_MANAGER_BYTES: usize = 8;
/// Length of a PDO's head, and of each entry, in categories 50 and 51.
pub(super) const PDO_BYTES: usize = 8;
/// SyncManager of a PDO that is not assigned.
pub(super) const NO_SYNC_MANAGER: u8 = 0xFF;

/// PDO flags, bytes 6 and 7 of its head.
pub(super) const PDO_MANDATORY: u16 = 0x0001;
/// Assigned by default.
pub(super) const PDO_DEFAULT: u16 = 0x0002;
/// The mapping cannot be changed.
pub(super) const PDO_FIXED: u16 = 0x0010;

/// Category numbers.
pub mod category {
    /// Strings.
    pub const STRINGS: u16 = 10;
    /// General, 32 bytes.
    pub const GENERAL: u16 = 30;
    /// FMMU usages, one byte each.
    pub const FMMU: u16 = 40;
    /// SyncManagers, 8 bytes each.
    pub const SYNC_MANAGER: u16 = 41;
    /// PDOs from slave to master.
    pub const TX_PDO: u16 = 50;
    /// PDOs from master to slave.
    pub const RX_PDO: u16 = 51;
    /// End of the list.
    pub const END: u16 = 0xFFFF;
}
