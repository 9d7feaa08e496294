//! What a program asks of the world around it.

use core::task::Poll;

/// A call of NX_ReadObj or NX_WriteObj that is under way: a number that its host gave.
pub type NxCallNumber = u64;

/// Most bytes of an NX object.
pub const NX_OBJECT_BYTES_MAX: usize = 200;

/// What answers the calls of a program. Nothing waits: what takes longer is asked for again in a later scan.
pub trait Host {
    /// Begins to read the NX object `index`:`sub` of the unit with this NX Unit number.
    ///
    /// # Errors
    /// Error ID and extended error ID of NX_ReadObj.
    fn nx_read(&mut self, unit: u16, index: u16, sub: u8) -> Result<NxCallNumber, NxFault>;

    /// Begins to write it; `value` is little endian.
    ///
    /// # Errors
    /// Error ID and extended error ID of NX_WriteObj.
    fn nx_write(&mut self, unit: u16, index: u16, sub: u8, value: &[u8]) -> Result<NxCallNumber, NxFault>;

    /// What became of a call: how many bytes were read into `value`, none after a write. Pending until it has come,
    /// then told once.
    fn nx_result(
        &mut self,
        call: NxCallNumber,
        value: &mut [u8; NX_OBJECT_BYTES_MAX],
    ) -> Poll<Result<usize, NxFault>>;

    /// ResetNXBError: begins to reset the errors of the NX Bus Function Module.
    ///
    /// # Errors
    /// Error ID: there is no NX bus here.
    fn reset_nx_bus(&mut self) -> Result<(), NxFault> {
        Err(NxFault::of(NxFault::OUT_OF_RANGE))
    }

    /// Whether the reset that was begun last is complete.
    fn nx_bus_is_reset(&self) -> bool {
        true
    }

    /// SetAlarm: a user-defined error with its code and attached information.
    fn set_alarm(&mut self, alarm: Alarm);

    /// ResetAlarm: the user-defined error of this code is reset; of code 0, all of them.
    fn reset_alarm(&mut self, code: u16);

    /// Whether the scan is to end where it is, because its CPU Unit is switched off. A long scan asks about once a
    /// millisecond.
    fn ends_scan(&self) -> bool {
        false
    }
}

/// Why an NX object was not read or written, by the numbers that the instruction's pins tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NxFault {
    /// ErrorID.
    pub error_id: u16,
    /// ErrorIDEx.
    pub error_id_ex: u32,
}

/// Error IDs of NX_ReadObj and NX_WriteObj. The blocks of the library add 16#2C02, a call that timed out.
impl NxFault {
    /// NX Message Error: the unit refused the message, and ErrorIDEx says why.
    pub const MESSAGE_ERROR: u16 = 0x2C00;
    /// NX Message Resources Exceeded: too many calls at once.
    pub const RESOURCES_EXCEEDED: u16 = 0x2C01;
    /// Incorrect NX Message Length: the object and the variable are not equally long.
    pub const INCORRECT_LENGTH: u16 = 0x2C03;
    /// Input Value Out of Range: there is no such unit.
    pub const OUT_OF_RANGE: u16 = 0x0400;

    /// An error that has no more to say.
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

/// A host for programs that ask for nothing: it refuses NX objects and drops alarms.
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

    fn set_alarm(&mut self, _: Alarm) {}

    fn reset_alarm(&mut self, _: u16) {}
}
