//! Times of the unit, from `tables/timing.toml` (manual, 7-9).

use std::sync::LazyLock;

use device::StartUp;
use serde::Deserialize;
use time::Duration;

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

/// Whether the unit simulates the times of the manual.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Timing {
    /// T_slave by size, SDO responses after 2 ms.
    #[default]
    Exact,
    /// SDO responses immediately, T_slave at its minimum.
    Fast,
}

impl Timing {
    /// T_slave, the time between two refreshes (Free-Run), for `total_bytes` of I/O data between CPU Unit and
    /// unit: both directions and the EtherCAT Slave Status (manual, 7-9-1).
    #[must_use]
    pub fn slave_period(self, total_bytes: usize) -> Duration {
        let total_bytes = if self == Self::Fast { 0 } else { total_bytes };
        let holds = |row: &&SlaveRow| row.max_bytes.is_none_or(|max_bytes| total_bytes <= max_bytes);
        match TIMES.t_slave.iter().find(holds) {
            Some(row) => Duration::from_micros(row.period_us),
            None => panic!("tables/timing.toml: the last row of t_slave has no max_bytes"),
        }
    }

    /// The start-up time in a unit file, or that of the model. Without such a time the unit has been powered
    /// for a long time when it is first powered on, so that a master finds it ready.
    #[must_use]
    pub fn start_up(self, named: Option<Duration>) -> StartUp {
        match self {
            Self::Exact => {
                let again = named.unwrap_or(Duration::from_millis(TIMES.start_up_ms));
                StartUp { first: named.unwrap_or(Duration::ZERO), again }
            }
            Self::Fast => StartUp::default(),
        }
    }

    /// Time from an SDO request to its complete response (manual, 7-9-2).
    #[must_use]
    pub fn sdo_response(self) -> Duration {
        match self {
            Self::Exact => sdo_response(),
            Self::Fast => Duration::ZERO,
        }
    }
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
            assert_eq!(Timing::Exact.slave_period(total_bytes), period, "{total_bytes} bytes");
        }
    }

    #[test]
    fn fast_waits_for_nothing_and_still_refreshes_every_millisecond() {
        assert_eq!(Timing::Fast.slave_period(2402), Duration::from_millis(1));
        assert_eq!(Timing::Fast.sdo_response(), Duration::ZERO);
        assert_eq!(Timing::Exact.sdo_response(), Duration::from_millis(2));
    }
}
