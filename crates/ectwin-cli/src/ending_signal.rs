//! A signal that ends a campaign or a search: its name and its exit code.

use signal_hook::low_level::signal_name;

/// A signal that has arrived.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Signal(i32);

impl Signal {
    /// The signal with this number.
    pub(crate) const fn new(number: i32) -> Self {
        Self(number)
    }

    /// `SIGTERM`.
    pub(crate) fn name(self) -> &'static str {
        signal_name(self.0).unwrap_or("a signal")
    }

    /// The exit code of a process that a signal has ended, as shells give it.
    pub(crate) fn exit_code(self) -> u8 {
        u8::try_from(self.0).unwrap_or_default().saturating_add(128)
    }
}
