//! The frames of the scripted master: what it sends now, and what returns or is lost.

use ::master::{Address, Load, MailboxConduct, Pace};
use time::Instant;
use wire::FRAME_BYTES_MAX;

use super::Master;
use super::raw::RawNumber;
use super::sent::{Sender, Sent, Ticket};
use super::slave::Slave;

/// Maximum number of frames whose memory is kept for the next ones: a cycle with 100 units has 34.
const SPARES_MAX: usize = 256;

impl Master {
    /// The frames that it sends now.
    pub(crate) fn send(&mut self, now: Instant) -> Vec<Sent> {
        let mut frames = Vec::new();
        let is_cycle = self.process_data.begin_cycle(now);
        if is_cycle {
            self.flights.forget(|sender| matches!(sender, Sender::Cycle(_)));
            self.load_all(&mut frames, |master, load| master.process_data.load(load));
        }
        self.begin_task(now, is_cycle, &mut frames);
        if self.raw.deadline() <= now {
            let raw = self.raw.send(now, now + self.habits.answer_patience, &mut self.story);
            frames.extend(raw.into_iter().map(|(number, frame)| Sent { ticket: Ticket::Raw(number), frame }));
        }
        self.lose_frames(now);
        if self.operations.is_empty() && self.next_listen <= now {
            self.listen(now);
        }
        if self.runner.is_due(now) {
            frames.extend(self.send_operation(now));
        }
        frames
    }

    /// Frames that are loaded by `fill` one after the other, until it loads nothing. They are not repeated: they are
    /// awaited until the next ones of their sender.
    pub(super) fn load_all(&mut self, frames: &mut Vec<Sent>, fill: impl Fn(&mut Self, &mut Load<Sender>)) {
        loop {
            let mut load = self.load();
            fill(self, &mut load);
            let Some(sent) = self.depart(load, Instant::NEVER) else { return };
            frames.push(sent);
        }
    }

    pub(super) fn load(&mut self) -> Load<Sender> {
        let memory = self.spares.pop().unwrap_or_else(|| Vec::with_capacity(FRAME_BYTES_MAX));
        self.flights.load(memory, &self.habits)
    }

    pub(super) fn depart(&mut self, load: Load<Sender>, due: Instant) -> Option<Sent> {
        let (frame, ticket) = self.flights.depart(load, due);
        let Some(ticket) = ticket else {
            self.reuse(frame);
            return None;
        };
        Some(Sent { ticket: Ticket::Scripted(ticket), frame })
    }

    /// Takes the memory of a frame that is no longer needed.
    pub(super) fn reuse(&mut self, frame: Vec<u8>) {
        if self.spares.len() < SPARES_MAX {
            self.spares.push(frame);
        }
    }

    pub(super) fn send_operation(&mut self, now: Instant) -> Option<Sent> {
        let operation = self.operations.front_mut()?;
        if self.runner.is_too_late(now) {
            let Pace { habits, timeouts, .. } = Pace::new(now, &self.habits);
            let patience = habits.patience(operation.dialogue().patience(), timeouts);
            let reason = format!("{}: no success within {patience}", operation.words());
            self.give_up(reason, now);
            return None;
        }
        let unit = operation.unit;
        let received = self.slaves.get(unit).map_or(0, Slave::received);
        operation.begin(MailboxConduct { received, ..self.mailbox });
        let mut load = self.load();
        let operation = self.operations.front()?;
        let sender = Sender::Operation(self.runner.depart());
        load.access(sender, Address::Position(unit as u16), &operation.dialogue().access());
        self.depart(load, now + self.habits.answer_patience)
    }

    /// Frames without an answer in time are lost.
    pub(super) fn lose_frames(&mut self, now: Instant) {
        while let Some(parts) = self.flights.lose(now) {
            for part in &parts {
                if let Sender::Operation(number) = part.sender {
                    self.answer(number, None, now);
                }
            }
            self.flights.recycle_parts(parts);
        }
    }

    /// A frame returns. Frames that are no longer expected are ignored, as by a real master.
    pub(crate) fn receive(&mut self, ticket: ::master::Ticket, frame: Vec<u8>, now: Instant) {
        if let Some(arrival) = self.flights.arrive(ticket, &frame) {
            for (sender, answer) in arrival.answers() {
                match *sender {
                    Sender::Operation(number) => self.answer(number, Some(answer), now),
                    Sender::Cycle(number) => self.process_data.answer(number, answer),
                    Sender::State(unit) => self.states.answer(unit, answer),
                }
            }
            self.flights.recycle(arrival);
        }
        self.reuse(frame);
    }

    /// A frame of a step returns.
    pub(crate) fn receive_raw(&mut self, number: RawNumber, frame: Vec<u8>) {
        self.story.extend(self.raw.receive(number, frame));
    }
}
