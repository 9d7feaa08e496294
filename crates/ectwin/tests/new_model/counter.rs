use device::{Exchange, Start, Unit};
use nx_bus::{UnitEnd, UnitHeader};
use time::{Duration, Instant};
use wire::AlStatusCode;

/// Time between two refreshes.
pub(crate) const PERIOD: Duration = Duration::from_millis(1);

/// Counts its refreshes.
#[derive(Debug)]
pub(crate) struct Counter {
    pub(crate) step: u16,
    pub(crate) count: u16,
    /// Whether the master can read the count: in SAFE-OP and OP.
    pub(crate) is_exchanging: bool,
    /// The unit's end of the bus to its CPU Unit.
    pub(crate) bus: UnitEnd,
}

impl Unit for Counter {
    fn refresh_period(&self) -> Option<Duration> {
        Some(PERIOD)
    }

    fn refresh(&mut self, _now: Instant, exchange: Exchange<'_>) {
        self.count = self.count.wrapping_add(self.step);
        let bytes = self.count.to_le_bytes();
        // To the master: empty below SAFE-OP.
        self.is_exchanging = !exchange.inputs.is_empty();
        if self.is_exchanging {
            exchange.inputs.copy_from_slice(&bytes);
        }
        // To the CPU Unit.
        let header = UnitHeader { io_data_active: true, ..UnitHeader::default() };
        self.bus.m_to_c.publish(header, &bytes);
    }

    fn restart(&mut self, _now: Instant, _start: Start, _sii_image: &mut [u8]) -> Option<AlStatusCode> {
        (self.count, self.is_exchanging) = (0, false);
        None
    }
}
