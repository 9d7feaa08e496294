//! The cyclic exchange: a datagram for each unit with process data, in shared frames.

use ::master::{Address, Answer, Exchange, FmmuSettings, Load, SlaveSettings};
use time::{Duration, Instant};

use super::sent::Sender;

/// Maximum number of output bytes of a unit.
const OUTPUTS_MAX: usize = 1200;

/// The process data of all units.
#[derive(Debug)]
pub(crate) struct ProcessData {
    exchange: ::master::ProcessData,
    /// Outputs as the scenario sets them, of any length.
    outputs: Vec<Vec<u8>>,
}

impl ProcessData {
    pub(crate) fn new(units: usize, exchange: Exchange) -> Self {
        let addresses = (0..units).map(|unit| Address::Position(unit as u16));
        Self { exchange: ::master::ProcessData::new(exchange, addresses), outputs: vec![Vec::new(); units] }
    }

    pub(crate) const fn cycle(&self) -> Duration {
        self.exchange.exchange().period
    }

    pub(crate) const fn phase(&self) -> Duration {
        self.exchange.exchange().phase
    }

    /// Continues with this cycle.
    pub(crate) fn exchange(&mut self, cycle: Duration, now: Instant) {
        self.exchange.start(now, cycle);
    }

    pub(crate) const fn stop(&mut self) {
        self.exchange.stop();
    }

    /// An order that needs process data permits them to start.
    pub(crate) const fn allow(&mut self) {
        self.exchange.allow();
    }

    /// The FMMUs of a unit, whose process data are placed now unless they have a suitable place.
    pub(crate) fn place(&mut self, unit: usize, settings: &SlaveSettings) -> Vec<FmmuSettings> {
        if !self.exchange.holds(unit, settings) {
            self.exchange.place(unit, settings);
            self.fill_outputs(unit);
        }
        self.exchange.fmmus(unit).collect()
    }

    pub(crate) fn open(&mut self, unit: usize, now: Instant) {
        self.exchange.open(unit, now);
    }

    pub(crate) fn close(&mut self, unit: usize) {
        self.exchange.close(unit);
    }

    pub(crate) fn set_outputs(&mut self, unit: usize, at: usize, bytes: &[u8]) {
        let end = at.saturating_add(bytes.len()).min(OUTPUTS_MAX);
        let Some(outputs) = self.outputs.get_mut(unit) else { return };
        outputs.resize(outputs.len().max(end), 0);
        for (output, byte) in outputs.iter_mut().skip(at).zip(bytes) {
            *output = *byte;
        }
        self.fill_outputs(unit);
    }

    fn fill_outputs(&mut self, unit: usize) {
        let outputs = self.outputs.get(unit).map_or(&[][..], Vec::as_slice);
        for (output, byte) in self.exchange.outputs_mut(unit).iter_mut().zip(outputs) {
            *output = *byte;
        }
    }

    pub(crate) const fn deadline(&self) -> Instant {
        self.exchange.deadline()
    }

    /// The next cycle begins, if it is due.
    pub(super) fn begin_cycle(&mut self, now: Instant) -> bool {
        self.exchange.next_cycle(now)
    }

    /// Loads the next frame of the cycle.
    pub(super) fn load(&mut self, load: &mut Load<Sender>) {
        load.process_data(&mut self.exchange, Sender::Cycle);
    }

    /// Processes the answer to a datagram.
    pub(super) fn answer(&mut self, number: usize, answer: Answer<'_>) {
        let _ = self.exchange.answer(number, answer);
    }

    pub(crate) fn cycles(&self) -> u64 {
        self.exchange.report().cycles
    }

    pub(crate) fn inputs(&self, unit: usize) -> &[u8] {
        self.exchange.inputs(unit)
    }

    /// The outputs of the next cycle; bytes that have not been set are left out.
    pub(crate) fn outputs(&self, unit: usize) -> &[u8] {
        self.outputs.get(unit).map_or(&[], Vec::as_slice)
    }

    /// Whether the process data of a unit are exchanged.
    pub(crate) fn is_exchanging(&self, unit: usize) -> bool {
        self.exchange.is_running() && self.exchange.is_open(unit)
    }

    /// The working counter of each datagram in the present cycle, and the expected one; empty while nothing is exchanged.
    pub(crate) fn working_counters(&self) -> Vec<(Option<u16>, u16)> {
        if self.exchange.is_running() { self.exchange.counters().collect() } else { Vec::new() }
    }

    /// None while nothing is exchanged, or nothing has returned.
    pub(crate) fn working_counter(&self, unit: usize) -> Option<u16> {
        self.exchange.working_counter(unit).filter(|_| self.exchange.is_running())
    }
}
