//! The interface of a program to its environment.

use core::task::Poll;

/// A call of NX_ReadObj or NX_WriteObj in progress: a number assigned by its host.
pub type NxCallNumber = u64;

/// Maximum length of an NX object in bytes.
pub const NX_OBJECT_BYTES_MAX: usize = 200;

/// Executes the calls of programs. No call waits: the result of a longer one is queried again in a later scan.
pub trait Host {
    /// Starts to read the NX object `index`:`sub` of the unit with this NX Unit number.
    ///
    /// # Errors
    /// Error ID and extended error ID of NX_ReadObj.
    fn nx_read(&mut self, unit: u16, index: u16, sub: u8) -> Result<NxCallNumber, NxFault>;

    /// Starts to write it; `value` is little endian.
    ///
    /// # Errors
    /// Error ID and extended error ID of NX_WriteObj.
    fn nx_write(&mut self, unit: u16, index: u16, sub: u8, value: &[u8]) -> Result<NxCallNumber, NxFault>;

    /// The result of a call: the number of bytes read into `value`, none after a write. Pending until it is
    /// available; then it is returned once.
    fn nx_result(
        &mut self,
        call: NxCallNumber,
        value: &mut [u8; NX_OBJECT_BYTES_MAX],
    ) -> Poll<Result<usize, NxFault>>;

    /// Drops a call that timed out: its result will not be queried.
    fn nx_forget(&mut self, call: NxCallNumber);

    /// ResetNXBError: starts to reset the errors of the NX Bus Function Module.
    ///
    /// # Errors
    /// Error ID: there is no NX bus here.
    fn reset_nx_bus(&mut self) -> Result<(), NxFault> {
        Err(NxFault::of(NxFault::OUT_OF_RANGE))
    }

    /// Whether the reset that was started last is complete.
    fn nx_bus_is_reset(&self) -> bool {
        true
    }

    /// SetAlarm: a user-defined error with its code and attached information.
    fn set_alarm(&mut self, alarm: Alarm);

    /// ResetAlarm: resets the user-defined error with this code; with code 0, all of them.
    fn reset_alarm(&mut self, code: u16);

    /// Whether the scan must end immediately, because its CPU Unit is switched off. A long scan calls this
    /// about once a millisecond.
    fn ends_scan(&self) -> bool {
        false
    }
}

/// Why an NX object was not read or written, with the numbers for the instruction's pins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NxFault {
    /// ErrorID.
    pub error_id: u16,
    /// ErrorIDEx.
    pub error_id_ex: u32,
}

/// Error IDs of NX_ReadObj and NX_WriteObj. The blocks of the library add 16#2C02, a call that timed out.
impl NxFault {
    /// NX Message Error: the unit refused the message, and ErrorIDEx contains the reason.
    pub const MESSAGE_ERROR: u16 = 0x2C00;
    /// NX Message Resources Exceeded: too many calls at once.
    pub const RESOURCES_EXCEEDED: u16 = 0x2C01;
    /// Incorrect NX Message Length: the object and the variable have different lengths.
    pub const INCORRECT_LENGTH: u16 = 0x2C03;
    /// Input Value Out of Range: there is no such unit.
    pub const OUT_OF_RANGE: u16 = 0x0400;

    /// An error without further information.
    #[must_use]
    pub const fn of(error_id: u16) -> Self {
        Self { error_id, error_id_ex: 0 }
    }
}

/// A user-defined error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Alarm {
    /// Event code, 1 to 60000.
    pub code: u16,
    /// Attached information 1: a value of an elementary type, as 64 bits.
    pub info_1: u64,
    /// Attached information 2.
    pub info_2: u64,
}

/// A host for programs without such calls: it refuses NX objects and drops alarms.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoHost;

impl Host for NoHost {
    fn nx_read(&mut self, _: u16, _: u16, _: u8) -> Result<NxCallNumber, NxFault> {
        Err(NxFault::of(NxFault::MESSAGE_ERROR))
    }

    fn nx_write(&mut self, _: u16, _: u16, _: u8, _: &[u8]) -> Result<NxCallNumber, NxFault> {
        Err(NxFault::of(NxFault::MESSAGE_ERROR))
    }

    fn nx_result(
        &mut self,
        _: NxCallNumber,
        _: &mut [u8; NX_OBJECT_BYTES_MAX],
    ) -> Poll<Result<usize, NxFault>> {
        Poll::Pending
    }

    fn nx_forget(&mut self, _: NxCallNumber) {}

    fn set_alarm(&mut self, _: Alarm) {}

    fn reset_alarm(&mut self, _: u16) {}
}
