//! How the unit behaves as an EtherCAT slave where the manual leaves it open: times, refusals, outputs before OP.

use device::{Conduct, OutputsBeforeOp, SiiTiming, TransitionTimes};
use time::Duration;

use crate::description;
use crate::timing::Timing;

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

impl OutputsRule {
    pub(crate) fn of_stack(self) -> OutputsBeforeOp {
        let limit = description::timeouts().safe_op_op_ms;
        match self {
            Self::Required => OutputsBeforeOp::Within(Duration::from_millis(limit.into())),
            Self::NotRequired => OutputsBeforeOp::NotRequired,
        }
    }
}

impl SlaveSettings {
    /// What the stack does; fast, no time is left.
    pub(crate) fn conduct(&self, timing: Timing) -> Conduct {
        let conduct = self.conduct.clone();
        match timing {
            Timing::Exact => conduct,
            Timing::Fast => Conduct { transition_times: TransitionTimes::default(), ..conduct },
        }
    }

    pub(crate) fn sii_timing(&self, timing: Timing) -> SiiTiming {
        if timing == Timing::Fast || self.sii_time.is_zero() {
            SiiTiming::Immediate
        } else {
            SiiTiming::Busy(self.sii_time)
        }
    }

    pub(crate) fn mailbox_time(&self, timing: Timing) -> Duration {
        match (timing, self.mailbox_time) {
            (Timing::Exact, Some(time)) => time,
            _ => timing.sdo_response(),
        }
    }
}
