//! The terminal itself.

use device::{Exchange, Start, Unit};
use time::{Duration, Instant};
use unit_model::DataValid;
use wire::AlStatusCode;

use crate::channels::Channels;
use crate::settings::TerminalSettings;
use crate::wiring::Wiring;

/// Time between two reads of the inputs.
const INPUT_PERIOD: Duration = Duration::from_millis(1);

/// Only inputs need a timer.
pub(crate) fn refresh_period(inputs: Channels) -> Option<Duration> {
    (!inputs.is_none()).then_some(INPUT_PERIOD)
}

/// A terminal in operation: it only passes levels between the process data and its wiring.
#[derive(Debug)]
pub struct Terminal<W> {
    inputs: Channels,
    outputs: Channels,
    wiring: W,
    pub(crate) data_valid: DataValid,
}

impl<W: Wiring> Terminal<W> {
    /// A terminal with this wiring.
    #[must_use]
    pub const fn power_on(settings: &TerminalSettings, wiring: W) -> Self {
        let data_valid = DataValid { outputs: false, inputs: false };
        Self { inputs: settings.inputs, outputs: settings.outputs, wiring, data_valid }
    }

    /// Its wiring.
    #[must_use]
    pub const fn wiring(&self) -> &W {
        &self.wiring
    }

    /// Its wiring, for changes.
    pub const fn wiring_mut(&mut self) -> &mut W {
        &mut self.wiring
    }

    /// Outputs are off without valid process data: below OP, and after the watchdog has expired.
    fn switch_outputs(&mut self, process_data: Option<&[u8]>) {
        let levels = process_data.map_or(0, |bytes| self.outputs.levels(bytes));
        self.wiring.set_outputs(levels);
    }
}

impl<W: Wiring> Unit for Terminal<W> {
    /// Outputs are applied with the frame, so that only inputs need a timer.
    fn refresh_period(&self) -> Option<Duration> {
        refresh_period(self.inputs)
    }

    fn refresh(&mut self, _now: Instant, exchange: Exchange<'_>) {
        self.data_valid = DataValid {
            outputs: exchange.outputs.is_some() && !self.outputs.is_none(),
            inputs: !exchange.inputs.is_empty(),
        };
        self.switch_outputs(exchange.outputs);
        self.inputs.put(self.wiring.inputs(), exchange.inputs);
    }

    fn restart(&mut self, _now: Instant, _start: Start, _sii_image: &mut [u8]) -> Option<AlStatusCode> {
        self.data_valid = DataValid::default();
        self.switch_outputs(None);
        None
    }

    fn power_off(&mut self, _now: Instant) {
        self.data_valid = DataValid::default();
        self.switch_outputs(None);
    }
}
