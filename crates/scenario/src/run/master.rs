//! The scripted master: executes its orders in virtual time, one acyclic frame at a time, and exchanges process
//! data in parallel.

mod answer;
mod asked_sdo;
mod emergencies;
mod given_up;
mod habits;
mod last_sdo;
mod operation;
mod orders;
mod process_data;
mod program;
mod raw;
mod reach;
mod sdo_service;
mod sent;
mod slave;
mod states;
mod variables;

use std::collections::VecDeque;
use std::sync::Arc;

use ::master::{Address, Answer, Flights, Habits, Load, MailboxConduct, Pace, Progress, Runner};
use esi::KnownDevice;
use plc::{ProgramEvent, Reports};
use time::{Duration, Instant};
use wire::FRAME_BYTES_MAX;

use crate::model::WhichUnit;

use answer::{Outcome, Step};
use given_up::OrdersGivenUp;
use habits::{LISTEN_PERIOD, habits};
use last_sdo::{LastSdo, LastSdos};
use operation::Operation;
use process_data::ProcessData;
use program::Task;
use sent::Sender;
use slave::Slave;
use states::States;

pub(crate) use emergencies::Received;
pub(crate) use given_up::{GivenUp, OrderNumber};
pub use program::MasterProgram;
pub(crate) use raw::Kind;
use raw::{Raw, RawNumber};
pub(crate) use sent::{Sent, Ticket};
pub(crate) use slave::changed_settings;
pub(crate) use variables::{MasterVariables, NODE_ADDRESS_MAX, Node};

/// Maximum number of frames whose memory is kept for the next ones: a cycle with 100 units has 34.
const SPARES_MAX: usize = 256;

/// The scripted master.
#[derive(Debug)]
pub(crate) struct Master {
    habits: Habits,
    slaves: Vec<Slave>,
    operations: VecDeque<Operation>,
    /// Runs the first operation.
    runner: Runner,
    flights: Flights<Sender>,
    /// Memory of frames that are no longer needed.
    spares: Vec<Vec<u8>>,
    process_data: ProcessData,
    /// Its own user program, if it has one.
    task: Option<Task>,
    /// The states of the slaves for the user program; without a program they are not read.
    states: States,
    /// The reports of the user program.
    told: Reports,
    /// The next read of the mailboxes, if there are no other operations.
    next_listen: Instant,
    /// Units whose mailboxes it reads.
    listens: Vec<bool>,
    /// How it handles mailboxes, correctly or not. All units share the counters of its messages.
    mailbox: MailboxConduct,
    given_up: OrdersGivenUp,
    last_sdos: LastSdos,
    raw: Raw,
    emergencies: Vec<Received>,
    /// Abort codes of refused SDOs that the observer has not taken.
    refusals: Vec<u32>,
    /// Whether it reads the mailboxes for emergencies while it has nothing else to do.
    looks_for_emergencies: bool,
    story: Vec<String>,
}

impl Master {
    pub(crate) fn new(devices: Vec<Arc<KnownDevice>>, cycle: Duration, phase: Duration) -> Self {
        let units = devices.len();
        let slaves = devices.into_iter().enumerate();
        let habits = habits(cycle, phase);
        Self {
            slaves: slaves.map(|(unit, device)| Slave::new(unit, device)).collect(),
            operations: VecDeque::new(),
            runner: Runner::new(),
            flights: Flights::default(),
            spares: Vec::new(),
            process_data: ProcessData::new(units, habits.exchange),
            task: None,
            states: States::new(units),
            told: Reports::default(),
            next_listen: Instant::NEVER,
            listens: vec![false; units],
            mailbox: habits.mailbox,
            given_up: OrdersGivenUp::default(),
            last_sdos: LastSdos::of(units),
            raw: Raw::default(),
            emergencies: Vec::new(),
            refusals: Vec::new(),
            looks_for_emergencies: true,
            story: Vec::new(),
            habits,
        }
    }

    /// Adds a user program, which starts now.
    pub(crate) fn with_program(mut self, program: MasterProgram, now: Instant) -> Self {
        self.task = Some(Task::new(program, now));
        self
    }

    /// The first operation starts.
    fn begin(&mut self, now: Instant) {
        match self.operations.front() {
            Some(operation) => self.runner.begin(operation.dialogue(), &Pace::new(now, &self.habits)),
            None => self.runner.rest(),
        }
    }

    /// The time of its next frame or time-out.
    pub(crate) fn deadline(&self) -> Instant {
        let listen = if self.operations.is_empty() { self.next_listen } else { Instant::NEVER };
        let task = self.task.as_ref().map_or(Instant::NEVER, Task::deadline);
        let operation = self.runner.deadline().min(self.flights.deadline());
        operation.min(self.process_data.deadline()).min(self.raw.deadline()).min(listen).min(task)
    }

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
    fn load_all(&mut self, frames: &mut Vec<Sent>, fill: impl Fn(&mut Self, &mut Load<Sender>)) {
        loop {
            let mut load = self.load();
            fill(self, &mut load);
            let Some(sent) = self.depart(load, Instant::NEVER) else { return };
            frames.push(sent);
        }
    }

    fn load(&mut self) -> Load<Sender> {
        let memory = self.spares.pop().unwrap_or_else(|| Vec::with_capacity(FRAME_BYTES_MAX));
        self.flights.load(memory, &self.habits)
    }

    fn depart(&mut self, load: Load<Sender>, due: Instant) -> Option<Sent> {
        let (frame, ticket) = self.flights.depart(load, due);
        let Some(ticket) = ticket else {
            self.reuse(frame);
            return None;
        };
        Some(Sent { ticket: Ticket::Scripted(ticket), frame })
    }

    /// Takes the memory of a frame that is no longer needed.
    fn reuse(&mut self, frame: Vec<u8>) {
        if self.spares.len() < SPARES_MAX {
            self.spares.push(frame);
        }
    }

    /// A period of the user program begins: the states of the slaves are read.
    fn begin_task(&mut self, now: Instant, is_cycle: bool, frames: &mut Vec<Sent>) {
        let Some(task) = &mut self.task else { return };
        if is_cycle {
            task.in_step(now);
        }
        if task.begin(now, self.process_data.cycle()) {
            self.flights.forget(|sender| matches!(sender, Sender::State(_)));
            self.states.begin();
            self.load_all(frames, |master, load| master.states.load(load));
        }
    }

    /// Runs the user program, if its period has begun and the frames of this time have returned.
    pub(crate) fn scan(&mut self, now: Instant) {
        let scan = |task: &mut Task| task.scan(now, &mut self.process_data, &self.states);
        if let Some(events) = self.task.as_mut().and_then(scan) {
            self.told.period(events.iter().cloned());
            let new = events.iter().filter(|event| self.told.is_new(event));
            self.story.extend(new.map(ProgramEvent::to_string));
        }
    }

    /// Reads the mailboxes, for emergencies.
    fn listen(&mut self, now: Instant) {
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

    fn send_operation(&mut self, now: Instant) -> Option<Sent> {
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
    fn lose_frames(&mut self, now: Instant) {
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

    /// The answer to an access of the first operation; none: it is lost.
    fn answer(&mut self, number: u32, answer: Option<Answer<'_>>, now: Instant) {
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
    fn end_operation(&mut self, now: Instant) {
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
    fn keep_counters(&mut self) {
        let Some(operation) = self.operations.front_mut() else { return };
        let unit = operation.unit;
        let Some(conduct) = operation.mailbox().map(|mailbox| mailbox.conduct()) else { return };
        self.mailbox.counter.last = conduct.counter.last;
        if let Some(slave) = self.slaves.get_mut(unit) {
            slave.keep_received(conduct.received);
        }
    }

    /// Changes how it handles mailboxes from now on, including the present one.
    fn change_mailbox(&mut self, change: impl Fn(&mut MailboxConduct)) {
        change(&mut self.mailbox);
        if let Some(operation) = self.operations.front_mut() {
            operation.change_mailbox(change);
        }
    }

    /// The operations that follow from an operation come before all others.
    fn take_steps(&mut self, steps: Vec<Step>, order: Option<OrderNumber>, now: Instant) {
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
    fn fail(&mut self, given_up: GivenUp) {
        self.story.push(format!("gives up: {}", given_up.reason));
        self.given_up.add(given_up);
    }

    /// When an order fails, its remaining operations are dropped and the next order starts.
    fn give_up(&mut self, reason: String, now: Instant) {
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

    pub(crate) fn cycles(&self) -> u64 {
        self.process_data.cycles()
    }

    pub(crate) fn is_idle(&self) -> bool {
        self.operations.iter().all(Operation::is_listening) && self.raw.is_idle()
    }

    pub(crate) fn activity(&self) -> String {
        let frame = || if self.raw.is_idle() { "nothing".to_owned() } else { "a frame".to_owned() };
        self.operations.front().map_or_else(frame, Operation::words)
    }

    /// Whether it has given up an order since its start.
    pub(crate) const fn has_given_up(&self) -> bool {
        self.given_up.any()
    }

    /// Whether it has given up an order since the orders directly before the present step.
    pub(crate) const fn has_given_up_again(&self) -> bool {
        self.given_up.any_again()
    }

    /// The orders that it has given up, also before its last start.
    pub(crate) fn given_up(&self) -> &[GivenUp] {
        self.given_up.all()
    }

    /// The number of the order that a step has given last.
    pub(crate) fn last_order(&self) -> Option<OrderNumber> {
        self.given_up.last()
    }

    /// From now on orders are given: what it gives up later is new.
    pub(crate) const fn mark(&mut self) {
        self.given_up.mark();
    }

    /// The SDO that was ordered last of a unit, or of all units.
    pub(crate) fn last_sdo(&self, unit: Option<&WhichUnit>) -> &LastSdo {
        self.last_sdos.get(unit)
    }

    /// What it has read without any service.
    pub(crate) const fn raw(&self) -> &Raw {
        &self.raw
    }

    /// The working counter of each datagram of process data in the present cycle, and the expected one; empty while none
    /// are exchanged.
    pub(crate) fn working_counters(&self) -> Vec<(Option<u16>, u16)> {
        self.process_data.working_counters()
    }

    /// The emergencies since its start, in the order in which it has read them.
    pub(crate) fn emergencies(&self) -> &[Received] {
        &self.emergencies
    }

    pub(crate) fn inputs(&self, unit: usize) -> &[u8] {
        self.process_data.inputs(unit)
    }

    pub(crate) fn working_counter(&self, unit: usize) -> Option<u16> {
        self.process_data.working_counter(unit)
    }

    /// The reports of its user program.
    pub(crate) const fn told(&self) -> &Reports {
        &self.told
    }

    /// The value of a variable of its user program as text.
    pub(crate) fn program_variable(&self, name: &str) -> Option<String> {
        self.task.as_ref()?.value(name)
    }

    /// The abort codes of SDOs that were refused since the last call.
    pub(crate) fn take_refusals(&mut self) -> Vec<u32> {
        core::mem::take(&mut self.refusals)
    }

    /// Its reports since the last call.
    pub(crate) fn take_story(&mut self) -> Vec<String> {
        std::mem::take(&mut self.story)
    }
}
