//! Process data: who takes part, what goes out, what has come.

use time::{Duration, Instant};

use super::Master;
use crate::process_data::CycleReport;

impl Master {
    /// Exchanges process data with this period, from SAFE-OP on; if a slave does so already, beginning now.
    pub fn exchange(&mut self, now: Instant, period: Duration) {
        self.process_data.start(now, period);
    }

    /// Sends no process data any more, until [`Master::exchange`].
    pub const fn stop_exchange(&mut self) {
        self.process_data.stop();
    }

    /// What the present cycle has come to so far.
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

    /// What goes to a slave with the next cycle, to be changed. Areas of fewer than eight bits begin with a byte each.
    /// Empty before the slave was on its way to SAFE-OP.
    pub fn outputs_mut(&mut self, slave: usize) -> &mut [u8] {
        self.process_data.outputs_mut(slave)
    }

    /// What goes to a slave with the next cycle.
    #[must_use]
    pub fn outputs(&self, slave: usize) -> &[u8] {
        self.process_data.outputs(slave)
    }

    /// What has come from a slave last.
    #[must_use]
    pub fn inputs(&self, slave: usize) -> &[u8] {
        self.process_data.inputs(slave)
    }

    /// Gives the process data of a slave a place in the logical address space, if they have none that fits. While
    /// others exchange theirs, it goes behind them; otherwise all are placed again.
    pub(super) fn place(&mut self, position: usize) {
        let Some(slave) = self.slaves.get(position) else { return };
        if self.process_data.holds(position, &slave.settings) {
            return;
        }
        if self.process_data.is_any_open() {
            self.process_data.place(position, &slave.settings);
        } else {
            self.process_data.place_all(self.slaves.iter().map(|slave| &slave.settings).enumerate());
        }
    }
}
