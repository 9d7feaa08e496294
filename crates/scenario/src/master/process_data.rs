//! The cyclic exchange: one LRW for each unit that has process data.

use time::{Duration, Instant};
use wire::{Command, FrameBuilder, Returned};

use super::Sent;
use crate::orders::FrameKind;

/// Logical addresses between one unit and the next.
const UNIT_BYTES: u32 = 0x1000;

/// Where the process data of a unit begin.
pub(crate) const fn logical_address(unit: usize) -> u32 {
    unit as u32 * UNIT_BYTES
}

/// The process data of all units.
#[derive(Debug)]
pub(crate) struct ProcessData {
    cycle: Duration,
    next: Instant,
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
    ticket: Option<u64>,
    working_counter: Option<u16>,
}

impl ProcessData {
    pub(crate) fn new(units: usize, cycle: Duration) -> Self {
        Self { cycle, next: Instant::NEVER, units: vec![Image::default(); units], cycles: 0 }
    }

    pub(crate) const fn cycle(&self) -> Duration {
        self.cycle
    }

    /// Goes on with this cycle.
    pub(crate) fn exchange(&mut self, cycle: Duration, now: Instant) {
        self.cycle = cycle;
        if self.units.iter().any(|image| image.is_open) {
            self.next = now;
        }
    }

    pub(crate) fn stop(&mut self) {
        self.next = Instant::NEVER;
    }

    pub(crate) fn open(&mut self, unit: usize, outputs_bytes: u16, inputs_bytes: u16, now: Instant) {
        let Some(image) = self.units.get_mut(unit) else { return };
        image.is_open = true;
        image.outputs_bytes = usize::from(outputs_bytes);
        image.bytes = vec![0; usize::from(outputs_bytes) + usize::from(inputs_bytes)];
        image.fill_outputs();
        self.next = self.next.min(now);
    }

    pub(crate) fn close(&mut self, unit: usize) {
        if let Some(image) = self.units.get_mut(unit) {
            image.is_open = false;
        }
        if !self.units.iter().any(|image| image.is_open) {
            self.stop();
        }
    }

    pub(crate) fn set_outputs(&mut self, unit: usize, bytes: &[u8]) {
        let Some(image) = self.units.get_mut(unit) else { return };
        image.outputs.resize(image.outputs.len().max(bytes.len()), 0);
        image.outputs[..bytes.len()].copy_from_slice(bytes);
        image.fill_outputs();
    }

    pub(crate) const fn deadline(&self) -> Instant {
        self.next
    }

    /// The frames of one cycle.
    pub(crate) fn send(&mut self, now: Instant, ticket: &mut u64) -> Vec<Sent> {
        self.cycles += 1;
        self.next = now + self.cycle;
        let open = self.units.iter_mut().enumerate().filter(|(_, image)| image.is_open);
        open.map(|(unit, image)| {
            *ticket += 1;
            image.ticket = Some(*ticket);
            let frame =
                FrameBuilder::new().logical(Command::Lrw, logical_address(unit), &image.bytes).finish();
            Sent { ticket: *ticket, kind: FrameKind::ProcessData, frame }
        })
        .collect()
    }

    /// Takes what comes back; false if it is no frame of this exchange.
    pub(crate) fn receive(&mut self, ticket: u64, datagrams: &[Returned]) -> bool {
        let Some(image) = self.units.iter_mut().find(|image| image.ticket == Some(ticket)) else {
            return false;
        };
        image.ticket = None;
        let Some(answer) = datagrams.first() else { return true };
        image.working_counter = Some(answer.working_counter);
        if answer.data.len() == image.bytes.len() {
            let at = image.outputs_bytes;
            image.bytes[at..].copy_from_slice(&answer.data[at..]);
        }
        true
    }

    pub(crate) const fn cycles(&self) -> u64 {
        self.cycles
    }

    pub(crate) fn inputs(&self, unit: usize) -> &[u8] {
        self.units.get(unit).and_then(|image| image.bytes.get(image.outputs_bytes..)).unwrap_or_default()
    }

    pub(crate) fn working_counter(&self, unit: usize) -> Option<u16> {
        self.units.get(unit)?.working_counter
    }
}

impl Image {
    fn fill_outputs(&mut self) {
        let length_bytes = self.outputs.len().min(self.outputs_bytes).min(self.bytes.len());
        self.bytes[..length_bytes].copy_from_slice(&self.outputs[..length_bytes]);
    }
}
