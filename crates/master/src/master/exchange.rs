//! Process data: which slaves take part, which data are sent, which were received.

use time::{Duration, Instant};

use super::Master;
use crate::process_data::CycleReport;

impl Master {
    /// Exchanges process data with this period, from SAFE-OP on; if a slave already does so, starting now.
    pub fn exchange(&mut self, now: Instant, period: Duration) {
        self.process_data.start(now, period);
    }

    /// Stops sending process data, until [`Master::exchange`].
    pub const fn stop_exchange(&mut self) {
        self.process_data.stop();
    }

    /// The present result of the current cycle.
    #[must_use]
    pub fn cycle(&self) -> CycleReport {
        self.process_data.report()
    }

    /// The working counter of a slave's process data; see [`crate::ProcessData::working_counter`].
    #[must_use]
    pub fn working_counter(&self, slave: usize) -> Option<u16> {
        self.process_data.working_counter(slave)
    }

    /// Whether a slave exchanges process data.
    #[must_use]
    pub fn is_exchanging(&self, slave: usize) -> bool {
        self.process_data.is_open(slave)
    }

    /// The outputs for a slave in the next cycle, for changes. Areas of fewer than eight bits begin with a byte
    /// each. Empty before the slave was on its way to SAFE-OP.
    pub fn outputs_mut(&mut self, slave: usize) -> &mut [u8] {
        self.process_data.outputs_mut(slave)
    }

    /// The outputs for a slave in the next cycle.
    #[must_use]
    pub fn outputs(&self, slave: usize) -> &[u8] {
        self.process_data.outputs(slave)
    }

    /// The inputs last received from a slave.
    #[must_use]
    pub fn inputs(&self, slave: usize) -> &[u8] {
        self.process_data.inputs(slave)
    }

    /// Places the process data of a slave in the logical address space, if they have no suitable place. While
    /// other slaves exchange theirs, or their FMMUs are being set, they are placed after them; otherwise all are
    /// placed again.
    pub(super) fn place(&mut self, position: usize) {
        let Some(slave) = self.slaves.get(position) else { return };
        if self.process_data.holds(position, &slave.settings) {
            return;
        }
        if self.process_data.is_any_open() || self.slaves.iter().any(|slave| slave.queue.opens()) {
            self.process_data.place(position, &slave.settings);
        } else {
            self.process_data.place_all(self.slaves.iter().map(|slave| &slave.settings).enumerate());
        }
    }
}
