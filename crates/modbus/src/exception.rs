//! The exceptions with which a request is refused.

/// An exception code (application protocol, 7).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Exception {
    /// The server does not have this function code.
    IllegalFunction = 0x01,
    /// An address is not in the map, or not of this I/O allocation.
    IllegalDataAddress = 0x02,
    /// A quantity, a length or a value is not possible.
    IllegalDataValue = 0x03,
    /// The CPU Unit no longer exists.
    ServerDeviceFailure = 0x04,
    /// The request was accepted, and the task period that makes the change has not been executed yet.
    Acknowledge = 0x05,
    /// Too many changes are waiting.
    ServerDeviceBusy = 0x06,
    /// There is no unit at this position of the line.
    GatewayTargetDeviceFailedToRespond = 0x0B,
}

impl Exception {
    /// The response to a request with this function code.
    pub(crate) fn response(self, function: u8) -> Vec<u8> {
        vec![function | 0x80, self as u8]
    }
}
