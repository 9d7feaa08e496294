//! Task periods of the primary periodic task of CPU Units.

/// The periods as text: each of them is available in some CPU Unit, and no others are.
pub const TASK_PERIODS: &str = "125us, or 250us to 32ms in steps of 250us";

const SHORTEST_NS: u64 = 125_000;
const STEP_NS: u64 = 250_000;
const LONGEST_NS: u64 = 32_000_000;

/// Whether some CPU Unit has this period in nanoseconds ([`TASK_PERIODS`]).
#[must_use]
pub const fn is_task_period(period_ns: u64) -> bool {
    let is_step = period_ns.is_multiple_of(STEP_NS) && STEP_NS <= period_ns && period_ns <= LONGEST_NS;
    period_ns == SHORTEST_NS || is_step
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn periods_are_those_of_the_list() {
        let is_listed =
            |microseconds: u64| microseconds == 125 || (1..=128).any(|steps| microseconds == 250 * steps);
        for microseconds in 0..=40_000 {
            assert_eq!(is_task_period(1_000 * microseconds), is_listed(microseconds), "{microseconds} us");
        }
        assert!(!is_task_period(125_001) && !is_task_period(u64::MAX));
    }
}
