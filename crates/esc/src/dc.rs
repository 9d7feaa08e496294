//! Distributed clocks: receive times, system time and its control loop (reference 2.14).
//!
//! SYNC pulses are not generated: their registers store what a master writes, and the unit's check refuses a
//! configuration that the unit does not support.

use time::{Duration, Instant};

use crate::memory::Memory;
use crate::passage::Passage;
use crate::registers::at;

/// The local clock follows the reference clock by at most one part in this number, like a real clock that
/// adjusts its rate.
const RATE_LIMIT: u64 = 1_024;
/// Sign of the system time difference: local copy smaller than the received time (reference 2.14).
const LOCAL_IS_LESS: u32 = 1 << 31;

/// The local clock of one ESC.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dc {
    power_on: Instant,
    /// What the control loop has added to the local time so far, in ns.
    correction: i64,
    last_sync: Option<Instant>,
}

impl Dc {
    pub(crate) const fn new(power_on: Instant) -> Self {
        Self { power_on, correction: 0, last_sync: None }
    }

    /// Free-running local time in ns, as the control loop has corrected it.
    fn local_time(&self, now: Instant) -> u64 {
        now.saturating_since(self.power_on).as_nanos().wrapping_add_signed(self.correction)
    }

    /// System time as the wire reads it: local time plus offset, less the delay.
    pub(crate) fn system_time(&self, memory: &Memory, now: Instant) -> u64 {
        let delay = u64::from(memory.u32(at::SYSTEM_TIME_DELAY));
        self.local_time(now).wrapping_add(memory.u64(at::SYSTEM_TIME_OFFSET)).wrapping_sub(delay)
    }

    /// Latches the times at which this frame arrived at the processing unit and at each port.
    pub(crate) fn latch(&self, memory: &mut Memory, passage: &Passage) {
        let arrival = self.local_time(passage.arrival);
        memory.set_u64(at::RECEIVE_TIME_EPU, arrival);
        memory.set_u32(at::RECEIVE_TIME_PORT, arrival as u32);
        // Ports without a partner see the frame when it passes them inside: their time is not 0, because
        // libethercat takes 0 for a fault.
        let returned = self.local_time(passage.returned_out) as u32;
        for port in 1..4 {
            memory.set_u32(at::RECEIVE_TIME_PORT + 4 * port, returned);
        }
    }

    /// A reference time has been written: compares, and slews the local clock towards it.
    pub(crate) fn synchronise(&mut self, memory: &mut Memory, received: u32, now: Instant) {
        let local = self.system_time(memory, now) as u32;
        let difference = local.wrapping_sub(received) as i32;
        let magnitude = difference.unsigned_abs();
        let sign = if difference < 0 { LOCAL_IS_LESS } else { 0 };
        memory.set_u32(at::SYSTEM_TIME_DIFFERENCE, (magnitude & !LOCAL_IS_LESS) | sign);
        let elapsed = self.last_sync.map_or(Duration::ZERO, |last| now.saturating_since(last));
        self.last_sync = Some(now);
        let step = u64::from(magnitude).min(elapsed.as_nanos() / RATE_LIMIT) as i64;
        self.correction -= if difference < 0 { -step } else { step };
    }

    /// Writing the speed counter start resets the control loop.
    pub(crate) fn reset_control_loop(&mut self, memory: &mut Memory) {
        memory.set_u32(at::SYSTEM_TIME_DIFFERENCE, 0);
        memory.set_u16(at::SPEED_COUNTER_DIFFERENCE, 0);
        self.last_sync = None;
    }
}
