//! The first address of each kind of variable.

/// First register of the entries UINTs: entry `n`, counted from 1, begins at `(n - 1) * 15`.
pub const UINTS_BASE: u16 = 0;
/// First register of the entries BYTES: entry `n` begins at `1000 + (n - 1) * 10`.
pub const BYTES_BASE: u16 = 1000;
/// First register of the entries UDINT: entry `n` begins at `2000 + (n - 1) * 2`.
pub const UDINT_BASE: u16 = 2000;
/// Input register of EtherCAT Slave Status.
pub const SLAVE_STATUS: u16 = 3000;

/// Added to the address of a holding register: writing there forces the output.
pub const FORCED_C_TO_M_BASE: u16 = 10_000;
/// Added to the address of an input register: the holding register there forces the input.
pub const FORCED_M_TO_C_BASE: u16 = 20_000;

/// Discrete input of bit 0 of EtherCAT Slave Status; bit 15 is the last.
pub const SLAVE_STATUS_BITS_BASE: u16 = 0;
/// Discrete input of NX Unit I/O Data Active Status.
pub const IO_DATA_ACTIVE: u16 = 16;
/// Discrete input of NX Unit Error Status.
pub const UNIT_ERROR: u16 = 17;
/// First discrete input of `_NXB_UnitMsgActiveTbl`.
pub const MESSAGE_TABLE_BASE: u16 = 100;
/// First discrete input of `_NXB_UnitErrFlagTbl`.
pub const ERROR_TABLE_BASE: u16 = 200;
