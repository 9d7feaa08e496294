//! The cyclic exchange: one LRW for each unit that has process data, or LWR and LRD where one frame is too short.

use core::ops::Range;

use time::{Duration, Instant};
use wire::{Command, FrameBuilder, Returned};

use super::sent::{Sent, Ticket};
use crate::model::FrameKind;

/// Logical addresses between one unit and the next.
const UNIT_BYTES: u32 = 0x1000;
/// Longest data of the one datagram of a frame: 1,514 bytes less its headers and working counter.
const DATAGRAM_BYTES_MAX: usize = 1_486;

/// Most output bytes that a unit can have.
const OUTPUTS_MAX: usize = 1200;

/// Where the process data of a unit begin.
pub(crate) const fn logical_address(unit: usize) -> u32 {
    unit as u32 * UNIT_BYTES
}

/// The process data of all units.
#[derive(Debug)]
pub(crate) struct ProcessData {
    cycle: Duration,
    /// Where in its period the cycle lies, from time 0.
    phase: Duration,
    next: Instant,
    /// The scenario has stopped the exchange: a unit that comes to SAFE-OP does not begin it.
    is_stopped: bool,
    units: Vec<Image>,
    cycles: u64,
}

/// The process data of one unit.
#[derive(Clone, Debug, Default)]
struct Image {
    is_open: bool,
    outputs_bytes: usize,
    /// Outputs, then inputs, as they go.
    bytes: Vec<u8>,
    /// Outputs as the scenario sets them, of any length.
    outputs: Vec<u8>,
    /// Frames of this cycle that have not come back.
    awaited: Vec<Awaited>,
    /// Sum of the working counters of this cycle, so far.
    counted: u16,
    /// The same, of the last cycle of which something has come back.
    working_counter: Option<u16>,
}

/// A frame that has not come back, and the bytes that it carries.
#[derive(Clone, Debug)]
struct Awaited {
    ticket: u64,
    bytes: Range<usize>,
}

impl ProcessData {
    pub(crate) fn new(units: usize, cycle: Duration, phase: Duration) -> Self {
        Self {
            cycle,
            phase,
            next: Instant::NEVER,
            is_stopped: false,
            units: vec![Image::default(); units],
            cycles: 0,
        }
    }

    pub(crate) const fn cycle(&self) -> Duration {
        self.cycle
    }

    pub(crate) const fn phase(&self) -> Duration {
        self.phase
    }

    /// Goes on with this cycle.
    pub(crate) fn exchange(&mut self, cycle: Duration, now: Instant) {
        self.cycle = cycle;
        self.is_stopped = false;
        if self.units.iter().any(|image| image.is_open) {
            self.phase = now.saturating_since(Instant::ZERO);
            self.next = now;
        }
    }

    /// The first moment behind `now` that lies on the cycle.
    fn after(&self, now: Instant) -> Instant {
        let first = Instant::ZERO + self.phase;
        if now < first {
            return first;
        }
        let passed = now.saturating_since(first).as_nanos();
        first + self.cycle * (passed / self.cycle.as_nanos().max(1) + 1)
    }

    pub(crate) const fn stop(&mut self) {
        self.next = Instant::NEVER;
        self.is_stopped = true;
    }

    /// An order that comes to process data lets them begin.
    pub(crate) const fn allow(&mut self) {
        self.is_stopped = false;
    }

    pub(crate) fn open(&mut self, unit: usize, outputs_bytes: u16, inputs_bytes: u16, now: Instant) {
        let Some(image) = self.units.get_mut(unit) else { return };
        image.open(usize::from(outputs_bytes), usize::from(inputs_bytes));
        if !self.is_stopped {
            self.next = self.next.min(now);
        }
    }

    pub(crate) fn close(&mut self, unit: usize) {
        if let Some(image) = self.units.get_mut(unit) {
            image.is_open = false;
        }
        if !self.units.iter().any(|image| image.is_open) {
            self.next = Instant::NEVER;
        }
    }

    pub(crate) fn set_outputs(&mut self, unit: usize, at: usize, bytes: &[u8]) {
        let end = at.saturating_add(bytes.len()).min(OUTPUTS_MAX);
        let Some(image) = self.units.get_mut(unit) else { return };
        image.outputs.resize(image.outputs.len().max(end), 0);
        for (output, byte) in image.outputs.iter_mut().skip(at).zip(bytes) {
            *output = *byte;
        }
        image.fill_outputs();
    }

    pub(crate) const fn deadline(&self) -> Instant {
        self.next
    }

    /// The frames of one cycle.
    pub(crate) fn send(&mut self, now: Instant, ticket: &mut u64) -> Vec<Sent> {
        self.cycles += 1;
        self.next = self.after(now);
        let open = self.units.iter_mut().enumerate().filter(|(_, image)| image.is_open);
        open.flat_map(|(unit, image)| image.send(logical_address(unit), ticket)).collect()
    }

    /// Takes what comes back; false if it is no frame of this exchange.
    pub(crate) fn receive(&mut self, ticket: u64, datagrams: &[Returned]) -> bool {
        self.units.iter_mut().any(|image| image.receive(ticket, datagrams))
    }

    pub(crate) const fn cycles(&self) -> u64 {
        self.cycles
    }

    pub(crate) fn inputs(&self, unit: usize) -> &[u8] {
        self.units.get(unit).and_then(|image| image.bytes.get(image.outputs_bytes..)).unwrap_or_default()
    }

    /// Outputs as they go with the next cycle; those that nobody has set are left out.
    pub(crate) fn outputs(&self, unit: usize) -> &[u8] {
        self.units.get(unit).map_or(&[], |image| &image.outputs)
    }

    /// Whether the process data of a unit go and come.
    pub(crate) fn is_exchanging(&self, unit: usize) -> bool {
        self.next != Instant::NEVER && self.units.get(unit).is_some_and(|image| image.is_open)
    }

    pub(crate) fn working_counter(&self, unit: usize) -> Option<u16> {
        self.units.get(unit)?.working_counter
    }
}

impl Image {
    /// Process data of the same lengths go on with what has come.
    fn open(&mut self, outputs_bytes: usize, inputs_bytes: usize) {
        let length_bytes = outputs_bytes + inputs_bytes;
        if !self.is_open || (self.outputs_bytes, self.bytes.len()) != (outputs_bytes, length_bytes) {
            self.outputs_bytes = outputs_bytes;
            self.bytes = vec![0; length_bytes];
        }
        self.is_open = true;
        self.fill_outputs();
    }

    fn send(&mut self, logical: u32, ticket: &mut u64) -> Vec<Sent> {
        let all = 0..self.bytes.len();
        let parts = if all.len() <= DATAGRAM_BYTES_MAX {
            vec![(Command::Lrw, all)]
        } else {
            vec![(Command::Lwr, 0..self.outputs_bytes), (Command::Lrd, self.outputs_bytes..all.end)]
        };
        self.awaited.clear();
        self.counted = 0;
        let sent = parts.into_iter().map(|(command, bytes)| {
            *ticket += 1;
            let data = self.bytes.get(bytes.clone()).unwrap_or_default();
            let frame = FrameBuilder::new().logical(command, logical + bytes.start as u32, data).finish();
            self.awaited.push(Awaited { ticket: *ticket, bytes });
            Sent { ticket: Ticket::Scripted(*ticket), kind: FrameKind::ProcessData, frame }
        });
        sent.collect()
    }

    fn receive(&mut self, ticket: u64, datagrams: &[Returned]) -> bool {
        let Some(place) = self.awaited.iter().position(|awaited| awaited.ticket == ticket) else {
            return false;
        };
        let Awaited { bytes, .. } = self.awaited.remove(place);
        let Some(answer) = datagrams.first() else { return true };
        self.counted = self.counted.saturating_add(answer.working_counter);
        self.working_counter = Some(self.counted);
        // Outputs come back as they went; only inputs are news.
        let first = bytes.start.max(self.outputs_bytes);
        let news = answer.data.get(first.saturating_sub(bytes.start)..).unwrap_or_default();
        if let Some(inputs) = self.bytes.get_mut(first..bytes.end).filter(|inputs| inputs.len() == news.len())
        {
            inputs.copy_from_slice(news);
        }
        true
    }

    fn fill_outputs(&mut self) {
        let length_bytes = self.outputs.len().min(self.outputs_bytes).min(self.bytes.len());
        self.bytes[..length_bytes].copy_from_slice(&self.outputs[..length_bytes]);
    }
}
