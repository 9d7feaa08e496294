//! The behaviour of the unit as an EtherCAT slave where the manual does not define it: times, refusals, outputs
//! before OP.

use device::Conduct;
use time::Duration;

/// The settings of the slave in a unit file. The default is a slave that follows the standard and is fast.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SlaveSettings {
    /// Whether OP is reached without outputs (`outputs_before_op`).
    pub outputs_before_op: OutputsRule,
    /// The time of each transition (`[times] transitions`), and the refused states (`[refuse]`).
    pub conduct: Conduct,
    /// Time of an SII command (`[times] sii`).
    pub sii_time: Duration,
    /// Time from an SDO request to its response (`[times] mailbox`); none: the time of the manual.
    pub mailbox_time: Option<Duration>,
    /// The EEPROM is erased, whatever the non-volatile memory contains (`blank_sii`).
    pub is_sii_blank: bool,
}

/// Whether the transition from SAFE-OP to OP waits for outputs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OutputsRule {
    /// `required`: like slaves that check it, within the time in the ESI.
    #[default]
    Required,
    /// `not-required`: OP is reached immediately, and the outputs are not valid until they are received.
    NotRequired,
}
