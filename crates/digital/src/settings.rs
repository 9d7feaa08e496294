//! The settings of a terminal, before it is powered on.

use device::{Conduct, OutputsBeforeOp, SiiTiming, StartUp};
use time::Duration;

use crate::channels::Channels;

/// Number of ports of a terminal: 2 to 4.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ports(u8);

impl Ports {
    /// IN and OUT.
    pub const TWO: Self = Self(2);

    /// This number of ports; none below 2 and above 4.
    #[must_use]
    pub const fn new(count: u8) -> Option<Self> {
        if matches!(count, 2..=4) { Some(Self(count)) } else { None }
    }

    /// The number of ports.
    #[must_use]
    pub const fn count(self) -> u8 {
        self.0
    }
}

/// The settings of one terminal. The default is a coupler with two ports.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TerminalSettings {
    /// Inputs, which the master reads.
    pub inputs: Channels,
    /// Outputs, which the master writes.
    pub outputs: Channels,
    /// Ports of the controller.
    pub ports: Ports,
    /// Serial number in the SII; 0: none.
    pub serial: u32,
    /// Configured station alias in the SII; 0: none.
    pub alias: u16,
    /// From power-on to the first step.
    pub start_up: StartUp,
    /// From the first step to the first read of the inputs.
    pub refresh_phase: Duration,
    /// SAFE-OP to OP. A terminal without a processor waits for nothing.
    pub outputs_before_op: OutputsBeforeOp,
    /// Time of an SII command.
    pub sii: SiiTiming,
    /// The EEPROM is erased.
    pub is_sii_blank: bool,
    /// Slow transitions, refusals.
    pub conduct: Conduct,
}

impl Default for TerminalSettings {
    fn default() -> Self {
        Self {
            inputs: Channels::NONE,
            outputs: Channels::NONE,
            ports: Ports::TWO,
            serial: 1,
            alias: 0,
            start_up: StartUp::default(),
            refresh_phase: Duration::ZERO,
            outputs_before_op: OutputsBeforeOp::NotRequired,
            sii: SiiTiming::Immediate,
            is_sii_blank: false,
            conduct: Conduct::default(),
        }
    }
}
