//! The times of a whole scenario: its limit and the cycle of its process data.

use time::Duration;

use super::maker::Maker;
use super::problem::Part;
use crate::model::Script;

/// The shortest cycle: the shortest frame takes 6.72 us on a wire of 100 Mbit/s.
const CYCLE_MIN: Duration = Duration::from_micros(10);
/// The longest time of a scenario. A capture, which has 24 hours at most, fits into it.
pub(crate) const LIMIT_MAX: Duration = Duration::from_secs(48 * 60 * 60);

/// Refuses times with which a scenario does nothing, or does not end within hours.
pub(super) fn check(maker: &mut Maker<'_>, script: &Script) {
    let Script { limit, cycle, cycle_phase, .. } = script;
    if limit.is_zero() {
        let message = "a limit of 0 ends the scenario at its beginning";
        maker.refuse(Part::Limit, message, "such as `limit = \"60s\"`");
    } else if *limit > LIMIT_MAX {
        let message = format!("a limit of {limit} is more than 48 hours of virtual time, {LIMIT_MAX}");
        maker.refuse(Part::Limit, message, "such as `limit = \"3600s\"`; longer runs are several scenarios");
    }
    if cycle.is_zero() {
        maker.refuse(Part::Cycle, "a cycle of 0 never ends", "such as `cycle = \"1ms\"`");
    } else if *cycle < CYCLE_MIN {
        let message = format!("a cycle of {cycle} is shorter than {CYCLE_MIN}, and than frames on a wire");
        maker.refuse(Part::Cycle, message, "such as `cycle = \"1ms\"`");
    } else if let Some(phase) = cycle_phase.filter(|phase| phase >= cycle) {
        let message = format!("a phase of {phase} is beyond the cycle of {cycle}");
        maker.refuse(Part::CyclePhase, message, "`cycle_phase` is less than `cycle`");
    }
}
