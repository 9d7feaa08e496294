//! Times of the unit, from `tables/timing.toml` (manual, 7-9).

use std::sync::LazyLock;

use device::StartUp;
use serde::Deserialize;
use time::Duration;
use unit_model::keys::Timing;

use crate::tables;

static TIMES: LazyLock<TimingFile> =
    LazyLock::new(|| tables::parse("timing.toml", include_str!("../tables/timing.toml")));

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TimingFile {
    sdo_response_us: u64,
    start_up_ms: u64,
    task_silence_periods: u64,
    task_silence_min_ms: u64,
    transmission_per_slave_ns: u64,
    transmission_per_byte_ns: u64,
    t_slave: Vec<SlaveRow>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SlaveRow {
    max_bytes: Option<usize>,
    period_us: u64,
}

/// T_slave, the time between two refreshes (Free-Run), for `total_bytes` of I/O data between CPU Unit and
/// unit: both directions and the EtherCAT Slave Status (manual, 7-9-1). With `fast` it is at its minimum.
#[must_use]
pub fn slave_period(timing: Timing, total_bytes: usize) -> Duration {
    let total_bytes = if timing == Timing::Fast { 0 } else { total_bytes };
    let holds = |row: &&SlaveRow| row.max_bytes.is_none_or(|max_bytes| total_bytes <= max_bytes);
    match TIMES.t_slave.iter().find(holds) {
        Some(row) => Duration::from_micros(row.period_us),
        None => panic!("tables/timing.toml: the last row of t_slave has no max_bytes"),
    }
}

/// The start-up time in a unit file, or that of the model.
pub(crate) fn start_up(timing: Timing, named: Option<Duration>) -> StartUp {
    timing.start_up(named, Duration::from_millis(TIMES.start_up_ms))
}

/// From the receipt of an SDO request to its response.
pub(crate) fn sdo_response() -> Duration {
    Duration::from_micros(TIMES.sdo_response_us)
}

/// Time without a new task period after which the task of the CPU Unit counts as stopped.
pub(crate) fn task_silence(task_period: Duration) -> Duration {
    let periods = task_period * TIMES.task_silence_periods;
    periods.max(Duration::from_millis(TIMES.task_silence_min_ms))
}

/// The contribution of each slave to the transmission time of a frame.
pub(crate) fn per_slave() -> Duration {
    Duration::from_nanos(TIMES.transmission_per_slave_ns)
}

/// The contribution of each byte of a frame to its transmission time.
pub(crate) fn per_byte() -> Duration {
    Duration::from_nanos(TIMES.transmission_per_byte_ns)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn t_slave_has_the_rows_of_the_manual() {
        let cases =
            [(0, 1000), (362, 1000), (800, 1000), (801, 1500), (1600, 1500), (1601, 2000), (2402, 2000)];
        for (total_bytes, period_us) in cases {
            let period = Duration::from_micros(period_us);
            assert_eq!(slave_period(Timing::Exact, total_bytes), period, "{total_bytes} bytes");
        }
    }

    #[test]
    fn fast_still_refreshes_every_millisecond() {
        assert_eq!(slave_period(Timing::Fast, 2402), Duration::from_millis(1));
        assert_eq!(start_up(Timing::Fast, None), StartUp::default());
        assert_eq!(sdo_response(), Duration::from_millis(2));
    }
}
