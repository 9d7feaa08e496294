//! A line without an index: every datagram walks along all ESCs.

use std::collections::BTreeSet;

use esc::{Access, Esc, LoopState, Passage, Port};
use time::{Duration, Instant};
use wire::{Command, Datagram, FrameKind};

const HOP: Duration = Duration::from_nanos(500);
const TURN: Duration = Duration::from_nanos(100);

/// A line of ESCs; its far end is open.
pub(crate) struct Naive {
    pub(crate) escs: Vec<Esc>,
    /// At which of them something took effect at the end of a frame.
    pub(crate) touched: BTreeSet<usize>,
}

impl Naive {
    pub(crate) fn new(mut escs: Vec<Esc>) -> Self {
        let last = escs.len() - 1;
        for (position, esc) in escs.iter_mut().enumerate() {
            esc.set_link(Port::In, true);
            esc.set_link(Port::Out, position < last);
        }
        Self { escs, touched: BTreeSet::new() }
    }

    pub(crate) fn set_cable(&mut self, number: usize, plugged: bool) {
        if let Some(esc) = self.escs.get_mut(number) {
            esc.set_link(Port::In, plugged);
        }
        if let Some(esc) = number.checked_sub(1).and_then(|before| self.escs.get_mut(before)) {
            esc.set_link(Port::Out, plugged);
        }
    }

    /// How many ESCs a frame from the master passes, and whether port IN of the next one is closed.
    fn reach(&self) -> (usize, bool) {
        for (position, esc) in self.escs.iter().enumerate() {
            if esc.port(Port::In).loop_state == LoopState::Closed {
                return (position, true);
            }
            let out = esc.port(Port::Out);
            if out.loop_state == LoopState::Closed || !out.link {
                return (position + 1, false);
            }
        }
        (self.escs.len(), false)
    }

    /// A good frame from the master; with a bit error it reaches only the ESCs before that cable.
    pub(crate) fn frame(&mut self, now: Instant, frame: &mut [u8], error_at: Option<usize>) {
        let (reach, is_blocked) = self.reach();
        let Some(cable) = error_at else {
            self.pass(0..reach, now, frame);
            if is_blocked {
                self.escs[reach].frame_at_closed_port(Port::In);
            }
            return;
        };
        self.pass(0..cable.min(reach), now, frame);
        let behind = self.escs[..reach].get_mut(cable..).and_then(<[Esc]>::split_first_mut);
        if let Some((first, others)) = behind {
            first.count_invalid_frame(Port::In);
            others.iter_mut().for_each(|esc| esc.count_forwarded_error(Port::In));
        }
    }

    /// A good frame from the far end.
    pub(crate) fn frame_at_far_end(&mut self, now: Instant, frame: &mut [u8]) {
        let is_closed = |esc: &Esc, port: Port| esc.port(port).loop_state == LoopState::Closed;
        if !self.escs.last().is_some_and(|esc| esc.port(Port::Out).link) {
            return;
        }
        let Some(closed) =
            self.escs.iter().rposition(|esc| is_closed(esc, Port::Out) || is_closed(esc, Port::In))
        else {
            return;
        };
        if is_closed(&self.escs[closed], Port::Out) {
            self.escs[closed].frame_at_closed_port(Port::Out);
        } else {
            self.pass(closed..self.escs.len(), now, frame);
        }
    }

    fn pass(&mut self, positions: core::ops::Range<usize>, now: Instant, frame: &mut [u8]) {
        let FrameKind::Datagrams(layout) = FrameKind::of(frame) else {
            panic!("frames of the test are good")
        };
        let first = positions.start;
        let escs = &mut self.escs[positions];
        for mut datagram in layout.datagrams(frame) {
            walk(escs, &mut datagram, now);
            datagram.close();
        }
        let hops = |hops: usize| HOP * hops as u64;
        let behind = escs.len().saturating_sub(1);
        for (number, esc) in escs.iter_mut().enumerate() {
            if esc.awaits_end_of_frame() {
                self.touched.insert(first + number);
            }
            let returned_out = now + hops(behind) + TURN + hops(behind - number);
            esc.end_of_frame(&Passage { arrival: now + hops(number), returned_out });
        }
    }
}

fn walk(escs: &mut [Esc], datagram: &mut Datagram<'_>, now: Instant) {
    let command = datagram.header.command;
    let (address, offset) = (datagram.header.address, datagram.header.offset);
    let logical = datagram.header.logical_address();
    if command.increments_position() {
        datagram.header.address = address.wrapping_add(escs.len() as u16);
    }
    if matches!(command, Command::Other(_)) {
        return;
    }
    let data = &mut *datagram.data;
    for (position, esc) in (0u16..).zip(escs) {
        let at = now + HOP * u64::from(position);
        let here = address.wrapping_add(position) == 0;
        let answers = esc.answers_to(address);
        let increment = match command {
            Command::Lrd => u16::from(esc.logical_read(logical, data, at)),
            Command::Lwr => u16::from(esc.logical_write(logical, data, at)),
            Command::Lrw => both(esc.logical_read_write(logical, data, at)),
            Command::Brd => u16::from(esc.read_or(offset, data, at)),
            Command::Bwr => u16::from(esc.write(offset, data, at)),
            Command::Brw => both(esc.read_or_write(offset, data, at)),
            Command::Aprd if here => u16::from(esc.read(offset, data, at)),
            Command::Apwr if here => u16::from(esc.write(offset, data, at)),
            Command::Aprw if here => both(esc.read_write(offset, data, at)),
            Command::Fprd if answers => u16::from(esc.read(offset, data, at)),
            Command::Fpwr if answers => u16::from(esc.write(offset, data, at)),
            Command::Fprw if answers => both(esc.read_write(offset, data, at)),
            Command::Armw if here => u16::from(esc.read(offset, data, at)),
            Command::Frmw if answers => u16::from(esc.read(offset, data, at)),
            Command::Armw | Command::Frmw => u16::from(esc.write(offset, data, at)),
            _ => 0,
        };
        datagram.working_counter = datagram.working_counter.wrapping_add(increment);
        datagram.header.events |= esc.masked_events();
    }
}

const fn both(access: Access) -> u16 {
    access.read as u16 + 2 * access.written as u16
}
