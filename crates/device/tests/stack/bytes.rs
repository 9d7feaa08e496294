//! A unit with the number of bytes of its description.

use device::{Exchange, RefreshCause, SyncMode, Unit};
use time::{Duration, Instant};

#[derive(Debug)]
pub(crate) struct Bytes {
    /// Its inputs for the master; bytes beyond the length of the inputs are left out.
    pub(crate) inputs: Vec<u8>,
    pub(crate) outputs: Option<Vec<u8>>,
    /// The reason for its refresh.
    pub(crate) refreshes: Vec<RefreshCause>,
    pub(crate) sync_mode: Option<SyncMode>,
    pub(crate) period: Option<Duration>,
}

impl Default for Bytes {
    fn default() -> Self {
        Self {
            inputs: Vec::new(),
            outputs: None,
            refreshes: Vec::new(),
            sync_mode: None,
            period: Some(Duration::from_millis(1)),
        }
    }
}

impl Unit for Bytes {
    fn sync_mode(&self) -> Option<SyncMode> {
        self.sync_mode
    }

    fn refresh_period(&self) -> Option<Duration> {
        self.period
    }

    fn refresh(&mut self, _now: Instant, exchange: Exchange<'_>) {
        self.refreshes.push(exchange.cause);
        self.outputs = exchange.outputs.map(<[u8]>::to_vec);
        for (input, byte) in exchange.inputs.iter_mut().zip(&self.inputs) {
            *input = *byte;
        }
    }
}
