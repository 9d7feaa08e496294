//! Process data: who takes part, what goes out, what has come.

use time::{Duration, Instant};

use super::Master;
use crate::access::Address;
use crate::process_data::{CycleReport, Exchange, Image, Layout};
use crate::settings::SlaveSettings;
use crate::slave::Slave;

impl Master {
    /// Exchanges process data with this period, from SAFE-OP on, beginning now.
    pub fn exchange(&mut self, now: Instant, period: Duration) {
        self.cycle.exchange.period = period;
        self.is_stopped = false;
        if self.slaves.iter().any(Slave::is_exchanging) {
            self.cycle.exchange.phase = now.saturating_since(Instant::ZERO);
            self.cycle.begin(now);
        }
    }

    /// Sends no process data any more, until [`Master::exchange`].
    pub const fn stop_exchange(&mut self) {
        self.is_stopped = true;
        self.cycle.stop();
    }

    /// How process data are exchanged.
    #[must_use]
    pub const fn exchange_settings(&self) -> Exchange {
        self.cycle.exchange
    }

    /// What the present cycle has come to so far.
    #[must_use]
    pub fn cycle(&self) -> CycleReport {
        self.cycle.report()
    }

    /// What goes to a slave with the next cycle. Areas of fewer than eight bits begin with a byte each. Empty as long
    /// as it was not set up.
    pub fn outputs_mut(&mut self, slave: usize) -> &mut [u8] {
        self.images.get_mut(slave).map_or(&mut [], |image| &mut image.outputs)
    }

    /// What goes to a slave with the next cycle.
    #[must_use]
    pub fn outputs(&self, slave: usize) -> &[u8] {
        self.images.get(slave).map_or(&[], |image| &image.outputs)
    }

    /// What has come from a slave last.
    #[must_use]
    pub fn inputs(&self, slave: usize) -> &[u8] {
        self.images.get(slave).map_or(&[], |image| &image.inputs)
    }

    /// A slave exchanges process data from now on.
    pub(super) fn open(&mut self, now: Instant, position: usize) {
        if let Some(slave) = self.slaves.get_mut(position) {
            slave.is_open = true;
            self.expect();
            if !self.is_stopped {
                self.cycle.begin(now);
            }
        }
    }

    /// A slave exchanges no process data any more.
    pub(super) fn close(&mut self, position: usize) {
        if let Some(slave) = self.slaves.get_mut(position) {
            slave.is_open = false;
            self.expect();
            if !self.slaves.iter().any(Slave::is_exchanging) {
                self.cycle.stop();
            }
        }
    }

    fn expect(&mut self) {
        let slaves = &self.slaves;
        self.cycle.expect(|position| slaves.get(position).is_some_and(Slave::is_exchanging));
    }

    /// Gives the process data of a slave a place in the logical address space, if they have none that fits. While
    /// others exchange theirs, it goes behind them; otherwise all are placed again.
    pub(super) fn place(&mut self, position: usize) {
        let Some(slave) = self.slaves.get(position) else { return };
        if self.layout.holds(position, &slave.settings) {
            return;
        }
        if self.slaves.iter().any(Slave::is_exchanging) {
            self.layout.remove(position);
            self.layout.place_all(&[(position, &slave.settings)]);
        } else {
            let all: Vec<(usize, &SlaveSettings)> =
                self.slaves.iter().map(|slave| &slave.settings).enumerate().collect();
            self.layout = Layout::default();
            self.layout.place_all(&all);
        }
        self.arrange();
    }

    /// Makes datagrams and images for all places.
    fn arrange(&mut self) {
        self.images.resize_with(self.slaves.len(), Image::default);
        for (image, slave) in self.images.iter_mut().zip(&self.slaves) {
            image.resize(&slave.settings);
        }
        let separate = self.slaves.iter().any(|slave| slave.settings.separate_commands);
        let addresses: Vec<Address> = self.slaves.iter().map(Slave::address).collect();
        self.cycle.arrange(&self.layout, separate, addresses.into_iter());
        self.expect();
    }
}
