//! The duration of an exchange with the unit according to the manual's formulas (7-9), for tests and for planning.

use time::Duration;

use crate::layout::MAILBOX_BYTES;
use crate::timing;

/// The times that make up the I/O response time (manual, 7-9-1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IoResponse {
    /// T_master, the master's cycle time.
    pub master: Duration,
    /// T_slave, the processing time of the unit: [`crate::slave_period`].
    pub slave: Duration,
    /// T_cpu, the task period of the CPU Unit.
    pub cpu: Duration,
    /// T_trans: [`transmission_time`].
    pub transmission: Duration,
}

impl IoResponse {
    /// The maximum time from sending outputs to receiving the inputs that the CPU Unit derives from them.
    #[must_use]
    pub fn maximum(self) -> Duration {
        self.master + self.slave * 3 + self.cpu * 2 + self.transmission * 2
    }
}

/// T_trans, the transmission time of a frame of `frame_bytes` through this number of slaves.
#[must_use]
pub fn transmission_time(slaves: u64, frame_bytes: u64) -> Duration {
    timing::per_slave() * slaves + timing::per_byte() * frame_bytes
}

/// The minimum time from sending an SDO request to having its response of `response_bytes`, for a master that
/// sends and receives once in a cycle of `master` (manual, 7-9-2).
///
/// # Panics
/// If the cycle is zero.
#[must_use]
pub fn sdo_response_time(master: Duration, response_bytes: u64) -> Duration {
    let waited_cycles = timing::sdo_response().as_nanos().div_ceil(master.as_nanos());
    let mailboxes = response_bytes.div_ceil(u64::from(MAILBOX_BYTES));
    master * (waited_cycles + mailboxes + 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use unit_model::keys::Timing;

    #[test]
    fn worked_examples_of_the_io_response_time() {
        // Master cycle and CPU task in µs, bytes of I/O data, slaves, bytes of the frame, result in ns.
        let examples = [
            (1_000, 2_000, 362, 1, 200, 8_038_480),
            (2_000, 1_000, 1_042, 5, 1_500, 8_782_400),
            (4_000, 4_000, 2_402, 10, 3_000, 18_564_800),
        ];
        for (master_us, cpu_us, io_bytes, slaves, frame_bytes, result_ns) in examples {
            let response = IoResponse {
                master: Duration::from_micros(master_us),
                slave: timing::slave_period(Timing::Exact, io_bytes),
                cpu: Duration::from_micros(cpu_us),
                transmission: transmission_time(slaves, frame_bytes),
            };
            assert_eq!(response.maximum().as_nanos(), result_ns);
        }
    }

    #[test]
    fn worked_examples_of_the_transmission_time() {
        for (slaves, frame_bytes, result_ns) in [(1, 64, 7_000), (20, 1_000, 114_800), (64, 1_500, 214_360)] {
            assert_eq!(transmission_time(slaves, frame_bytes).as_nanos(), result_ns);
        }
    }

    #[test]
    fn worked_examples_of_the_sdo_response_time() {
        for (master_us, response_bytes, result_us) in
            [(500, 8, 3_000), (1_000, 400, 4_000), (4_000, 401, 16_000)]
        {
            let time = sdo_response_time(Duration::from_micros(master_us), response_bytes);
            assert_eq!(time.as_micros(), result_us);
        }
    }
}
