//! The course of the operations: one after the other, what follows from each of them, and what is given up.

use ::master::{Answer, MailboxConduct, Pace, Progress};
use time::Instant;

use super::Master;
use super::answer::{Outcome, Step};
use super::emergencies::Received;
use super::given_up::{GivenUp, OrderNumber};
use super::habits::LISTEN_PERIOD;
use super::operation::Operation;
use super::slave::Slave;

impl Master {
    /// The first operation starts.
    pub(super) fn begin(&mut self, now: Instant) {
        match self.operations.front() {
            Some(operation) => self.runner.begin(operation.dialogue(), &Pace::new(now, &self.habits)),
            None => self.runner.rest(),
        }
    }

    /// Reads the mailboxes, for emergencies.
    pub(super) fn listen(&mut self, now: Instant) {
        self.next_listen = now + LISTEN_PERIOD;
        if !self.looks_for_emergencies {
            return;
        }
        let units = self.slaves.iter().zip(&self.listens).enumerate().filter(|(_, (_, listens))| **listens);
        let listen =
            |(unit, (slave, _)): (usize, (&Slave, _))| Some(Operation::listen(unit, slave.mailbox()?));
        self.operations.extend(units.filter_map(listen));
        self.begin(now);
    }

    /// The answer to an access of the first operation; none: it is lost.
    pub(super) fn answer(&mut self, number: u32, answer: Option<Answer<'_>>, now: Instant) {
        let Some(operation) = self.operations.front_mut() else { return };
        let pace = Pace::new(now, &self.habits);
        let progress = self.runner.answer(number, operation.dialogue_mut(), answer, &pace);
        while let Some(emergency) = operation.take_emergency() {
            let received = Received { unit: operation.unit, emergency };
            self.story.push(received.words());
            self.emergencies.push(received);
        }
        if progress == Some(Progress::Done) {
            self.end_operation(now);
        }
    }

    /// The first operation is complete.
    pub(super) fn end_operation(&mut self, now: Instant) {
        self.keep_counters();
        let Some(operation) = self.operations.pop_front() else { return };
        let outcome = operation.clone().end(&mut self.slaves, &mut self.process_data);
        match outcome {
            Outcome::Done(steps) => {
                self.take_steps(steps, operation.order, now);
                self.begin(now);
            }
            Outcome::Failed(reason) => {
                self.operations.push_front(operation);
                self.give_up(reason, now);
            }
        }
    }

    /// The counters of the mailbox continue from those of the first operation.
    pub(super) fn keep_counters(&mut self) {
        let Some(operation) = self.operations.front_mut() else { return };
        let unit = operation.unit;
        let Some(conduct) = operation.mailbox().map(|mailbox| mailbox.conduct()) else { return };
        self.mailbox.counter.last = conduct.counter.last;
        if let Some(slave) = self.slaves.get_mut(unit) {
            slave.keep_received(conduct.received);
        }
    }

    /// Changes how it handles mailboxes from now on, including the present one.
    pub(super) fn change_mailbox(&mut self, change: impl Fn(&mut MailboxConduct)) {
        change(&mut self.mailbox);
        if let Some(operation) = self.operations.front_mut() {
            operation.change_mailbox(change);
        }
    }

    /// The operations that follow from an operation come before all others.
    pub(super) fn take_steps(&mut self, steps: Vec<Step>, order: Option<OrderNumber>, now: Instant) {
        for step in steps.into_iter().rev() {
            match step {
                Step::Do(operation) => self.operations.push_front(operation.of_order(order)),
                Step::Exchange(unit) => {
                    self.process_data.open(unit, now);
                    if let (Some(task), Some(slave)) = (&mut self.task, self.slaves.get(unit)) {
                        task.open(unit, slave.settings());
                    }
                }
                Step::Close(unit) => self.process_data.close(unit),
                Step::Listen { unit, listens } => {
                    self.listens[unit] = listens;
                    let any = self.listens.contains(&true);
                    self.next_listen = if any { now + LISTEN_PERIOD } else { Instant::NEVER };
                }
                Step::SdoResult { unit, number, words, result } => {
                    self.story.push(words);
                    self.refusals.extend(result.as_ref().err());
                    self.last_sdos.answer(unit, number, &result);
                }
                Step::RawAnswer { number, bytes } => self.story.push(self.raw.answer(number, bytes)),
                Step::Tell(words) => self.story.push(words),
            }
        }
    }

    /// Records that an order has failed.
    pub(super) fn fail(&mut self, given_up: GivenUp) {
        self.story.push(format!("gives up: {}", given_up.reason));
        self.given_up.add(given_up);
    }

    /// When an order fails, its remaining operations are dropped and the next order starts.
    pub(super) fn give_up(&mut self, reason: String, now: Instant) {
        if let Some(Operation { unit, order, .. }) = self.operations.front().filter(|it| !it.is_listening()) {
            let given_up = GivenUp { at: now, unit: *unit, order: *order, reason };
            self.fail(given_up);
        }
        self.keep_counters();
        let parts = self.operations.iter().take_while(|operation| operation.is_part()).count();
        for operation in self.operations.drain(..parts.max(1)) {
            self.last_sdos.give_up(operation.unit, operation.ordered_sdo());
            if let Some(number) = operation.raw_number() {
                self.raw.give_up(number);
            }
        }
        self.begin(now);
    }
}
