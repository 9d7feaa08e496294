//! How the unit behaves as an EtherCAT slave where the manual leaves it open: times, refusals, outputs before OP.

use device::Conduct;
use time::Duration;

/// What a unit file says of the slave. The default is a slave that follows the standard and is quick.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SlaveSettings {
    /// Whether OP is reached without outputs (`outputs_before_op`).
    pub outputs_before_op: OutputsRule,
    /// How long each transition takes (`[times] transitions`), and what is refused (`[refuse]`).
    pub conduct: Conduct,
    /// How long an SII command takes (`[times] sii`).
    pub sii_time: Duration,
    /// How long after its request an SDO response is there (`[times] mailbox`); none: the time of the manual.
    pub mailbox_time: Option<Duration>,
    /// The EEPROM is erased, whatever the non-volatile memory holds (`blank_sii`).
    pub is_sii_blank: bool,
}

/// Whether SAFE-OP to OP waits for outputs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OutputsRule {
    /// `required`: as slaves do, for the time that the ESI gives a master.
    #[default]
    Required,
    /// `not-required`: OP comes at once, and the outputs are not valid until they come.
    NotRequired,
}
