//! Times in a unit file, and their ranges.

use core::ops::RangeInclusive;

use time::Duration;
use user_file::{DeValue, Problem, values};

/// Start-up times of a unit.
const START_UP_TIMES: RangeInclusive<Duration> = Duration::ZERO..=Duration::from_secs(60);
/// The shortest task period of a CPU Unit.
const TASK_PERIOD_MIN: Duration = Duration::from_micros(125);
/// All other periods are multiples of this one.
const TASK_PERIOD_STEP: Duration = Duration::from_micros(250);
/// The longest one.
const TASK_PERIOD_MAX: Duration = Duration::from_millis(32);
/// Above every refresh period of a unit.
const REFRESH_PHASE_MAX: Duration = Duration::from_millis(2);

/// The period of the primary periodic task: one that some CPU Unit supports.
pub(super) fn task_period(place: &str, value: &DeValue<'_>) -> Result<Duration, Problem> {
    let expected = "a task period of a CPU Unit: \"125us\", or \"250us\" to \"32ms\" in steps of 250us";
    values::duration(place, value, is_task_period, expected)
}

/// The start-up time of a unit.
pub(super) fn start_up(place: &str, value: &DeValue<'_>) -> Result<Duration, Problem> {
    values::duration(place, value, |time| START_UP_TIMES.contains(&time), "a duration, \"0ms\" to \"60s\"")
}

/// The position of the refresh in the unit's period.
pub(super) fn refresh_phase(place: &str, value: &DeValue<'_>) -> Result<Duration, Problem> {
    values::duration(place, value, |phase| phase <= REFRESH_PHASE_MAX, "a duration, \"0us\" to \"2ms\"")
}

/// The position of the task in its period.
pub(super) fn task_phase(place: &str, value: &DeValue<'_>) -> Result<Duration, Problem> {
    values::duration(place, value, |phase| phase <= TASK_PERIOD_MAX, "a duration, \"0us\" to \"32ms\"")
}

fn is_task_period(period: Duration) -> bool {
    let is_step = period.as_nanos().is_multiple_of(TASK_PERIOD_STEP.as_nanos());
    period == TASK_PERIOD_MIN || is_step && (TASK_PERIOD_STEP..=TASK_PERIOD_MAX).contains(&period)
}
