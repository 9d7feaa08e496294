//! Times in a unit file, and their ranges.

use core::ops::RangeInclusive;

use time::Duration;
use user_file::{DeValue, Problem, values};

/// The times of a slave: transitions, SII commands, mailbox responses. The longest is more than any master waits.
pub const TIMES: RangeInclusive<Duration> = Duration::ZERO..=Duration::from_secs(60);
/// [`TIMES`] in words.
pub const TIMES_WORDS: &str = "a time, \"0ms\" to \"60s\"";
/// Above every refresh period of a unit.
const REFRESH_PHASE_MAX: Duration = Duration::from_millis(2);

/// The start-up time of a unit.
pub(crate) fn start_up(place: &str, value: &DeValue<'_>) -> Result<Duration, Problem> {
    values::duration(place, value, |time| TIMES.contains(&time), "a duration, \"0ms\" to \"60s\"")
}

/// The position of the refresh in the unit's period.
pub(crate) fn refresh_phase(place: &str, value: &DeValue<'_>) -> Result<Duration, Problem> {
    values::duration(place, value, |phase| phase <= REFRESH_PHASE_MAX, "a duration, \"0us\" to \"2ms\"")
}

/// A time of a slave: transition, SII, mailbox.
pub(crate) fn time(place: &str, value: &DeValue<'_>) -> Result<Duration, Problem> {
    values::duration(place, value, |time| TIMES.contains(&time), TIMES_WORDS)
}
