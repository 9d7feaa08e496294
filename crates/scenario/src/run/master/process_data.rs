//! The cyclic exchange: a datagram for each unit with process data, in shared frames.

use core::ops::Range;

use ::master::{Address, Answer, Commands, Exchange, FmmuSettings, Grouping, SlaveSettings};
use time::{Duration, Instant};
use wire::{FrameBuilder, datagrams};

use super::sent::{Sent, Ticket};

/// Maximum number of output bytes of a unit.
const OUTPUTS_MAX: usize = 1200;
/// Maximum number of frames whose memory is kept for the next cycles.
const SPARES_MAX: usize = 16;

/// The process data of all units.
#[derive(Debug)]
pub(crate) struct ProcessData {
    exchange: ::master::ProcessData,
    /// Outputs as the scenario sets them, of any length.
    outputs: Vec<Vec<u8>>,
    /// Frames of this cycle that have not returned, and their datagrams.
    awaited: Vec<(u64, Range<usize>)>,
    /// Memory of frames that are no longer needed.
    spares: Vec<Vec<u8>>,
}

impl ProcessData {
    pub(crate) fn new(units: usize, period: Duration, phase: Duration) -> Self {
        // LRW, or LWR and LRD if one datagram is too short; each unit has a separate working counter.
        let exchange = Exchange {
            period,
            phase,
            commands: Commands::Fitting,
            grouping: Grouping::EachSlave,
            ..Exchange::default()
        };
        let addresses = (0..units).map(|unit| Address::Position(unit as u16));
        Self {
            exchange: ::master::ProcessData::new(exchange, addresses),
            outputs: vec![Vec::new(); units],
            awaited: Vec::new(),
            spares: Vec::new(),
        }
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

    /// The frames of one cycle, which starts now.
    pub(crate) fn send(&mut self, now: Instant, ticket: &mut u64) -> Vec<Sent> {
        self.exchange.next_cycle(now);
        self.awaited.clear();
        core::iter::from_fn(|| {
            let mut frame = self.spares.pop().map_or_else(FrameBuilder::new, FrameBuilder::reusing);
            let datagrams = self.exchange.load(&mut frame);
            if datagrams.is_empty() {
                self.reuse(frame.finish());
                return None;
            }
            *ticket += 1;
            self.awaited.push((*ticket, datagrams));
            let ticket = Ticket::Scripted(*ticket);
            Some(Sent { ticket, frame: frame.finish() })
        })
        .collect()
    }

    /// Takes the memory of a frame that is no longer needed.
    pub(crate) fn reuse(&mut self, frame: Vec<u8>) {
        if self.spares.len() < SPARES_MAX {
            self.spares.push(frame);
        }
    }

    /// Processes a returned frame; false if it does not belong to this exchange.
    pub(crate) fn receive(&mut self, ticket: u64, frame: &[u8]) -> bool {
        let Some(place) = self.awaited.iter().position(|(awaited, _)| *awaited == ticket) else {
            return false;
        };
        let (_, numbers) = self.awaited.remove(place);
        for (number, datagram) in numbers.zip(datagrams(frame)) {
            let answer = Answer { working_counter: datagram.working_counter, data: datagram.data };
            let _ = self.exchange.answer(number, answer);
        }
        true
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

    pub(crate) fn working_counter(&self, unit: usize) -> Option<u16> {
        self.exchange.working_counter(unit)
    }
}
