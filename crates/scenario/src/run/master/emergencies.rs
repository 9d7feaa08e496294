//! An emergency in the master.

use wire::Emergency;

use crate::model::hex;

/// An emergency that the master has read from a mailbox.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Received {
    /// The unit that has sent it, by its position.
    pub(crate) unit: usize,
    pub(crate) emergency: Emergency,
}

impl Received {
    /// The line of a trace.
    pub(super) fn words(&self) -> String {
        let Emergency { code, error_register, manufacturer } = &self.emergency;
        format!(
            "receives emergency {code:04X} of unit {}: error register {error_register:#04X}, data {}",
            self.unit + 1,
            hex(manufacturer)
        )
    }
}
