//! The scripted master: executes its orders in virtual time, one acyclic frame at a time, and exchanges process
//! data in parallel.

mod answer;
mod asked_sdo;
mod emergencies;
mod last_sdo;
mod operation;
mod orders;
mod process_data;
mod program;
mod raw;
mod sdo_service;
mod sent;
mod slave;
mod states;
mod variables;

use std::collections::VecDeque;
use std::sync::Arc;

use ::master::{Answer, LostRead, MailboxConduct, Progress};
use esi::KnownDevice;
use plc::{ProgramEvent, Reports};
use time::{Duration, Instant};
use wire::{DatagramView, datagrams};

use crate::model::WhichUnit;

use answer::{Outcome, Step};
use last_sdo::{LastSdo, LastSdos};
use operation::Operation;
use process_data::ProcessData;
use program::Task;
use slave::Slave;
use states::States;

pub(crate) use emergencies::Received;
pub use program::MasterProgram;
pub(crate) use raw::Kind;
use raw::Raw;
pub(crate) use sent::{Sent, Ticket};
pub(crate) use slave::changed_settings;
pub(crate) use variables::{MasterVariables, NODE_ADDRESS_MAX, Node};

/// Time-out for an answer; then the frame counts as lost.
const ANSWER_PATIENCE: Duration = Duration::from_millis(2);
/// Time between two reads of a status.
const POLL_PERIOD: Duration = Duration::from_micros(500);
/// Time between two reads of the mailboxes.
const LISTEN_PERIOD: Duration = Duration::from_millis(10);
/// Time-out for one operation as a whole.
const OPERATION_PATIENCE: Duration = Duration::from_secs(5);
/// Time-out for a state. The ESI gives a unit at most 9 s, in which it reports why it does not reach the state.
const STATE_PATIENCE: Duration = Duration::from_secs(10);

/// If a read of the mailbox is lost, it reads again, and requests the message again if there is none.
const RIGHT_CONDUCT: MailboxConduct =
    MailboxConduct { lost_read: LostRead::ReadAgain, ..MailboxConduct::NEW };

/// The scripted master.
#[derive(Debug)]
pub(crate) struct Master {
    slaves: Vec<Slave>,
    operations: VecDeque<Operation>,
    /// What the first operation is waiting for.
    waiting: Waiting,
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
    ticket: u64,
    /// How it handles mailboxes, correctly or not. All units share the counters of its messages.
    mailbox: MailboxConduct,
    gave_up: Option<String>,
    last_sdos: LastSdos,
    raw: Raw,
    emergencies: Vec<Received>,
    /// Abort codes of refused SDOs that the observer has not taken.
    refusals: Vec<u32>,
    /// Whether it reads the mailboxes for emergencies while it has nothing else to do.
    looks_for_emergencies: bool,
    story: Vec<String>,
}

#[derive(Debug)]
struct Waiting {
    /// Time of its next frame.
    at: Instant,
    /// The frame in flight.
    ticket: Option<u64>,
    /// It gives up at this time.
    until: Instant,
}

impl Master {
    pub(crate) fn new(devices: Vec<Arc<KnownDevice>>, cycle: Duration, phase: Duration) -> Self {
        let units = devices.len();
        let slaves = devices.into_iter().enumerate();
        Self {
            slaves: slaves.map(|(unit, device)| Slave::new(unit, device)).collect(),
            operations: VecDeque::new(),
            waiting: Waiting { at: Instant::NEVER, ticket: None, until: Instant::NEVER },
            process_data: ProcessData::new(units, cycle, phase),
            task: None,
            states: States::new(units),
            told: Reports::default(),
            next_listen: Instant::NEVER,
            listens: vec![false; units],
            ticket: 0,
            mailbox: RIGHT_CONDUCT,
            gave_up: None,
            last_sdos: LastSdos::of(units),
            raw: Raw::default(),
            emergencies: Vec::new(),
            refusals: Vec::new(),
            looks_for_emergencies: true,
            story: Vec::new(),
        }
    }

    /// Adds a user program, which starts now.
    pub(crate) fn with_program(mut self, program: MasterProgram, now: Instant) -> Self {
        self.task = Some(Task::new(program, now));
        self
    }

    /// The first operation starts.
    fn begin(&mut self, now: Instant) {
        let at = if self.operations.is_empty() { Instant::NEVER } else { now };
        self.waiting = Waiting { at, ticket: None, until: now + self.patience() };
    }

    fn patience(&self) -> Duration {
        let waits_for_state = self.operations.front().is_some_and(Operation::waits_for_state);
        if waits_for_state { STATE_PATIENCE } else { OPERATION_PATIENCE }
    }

    /// The time of its next frame or time-out.
    pub(crate) fn deadline(&self) -> Instant {
        let listen = if self.operations.is_empty() { self.next_listen } else { Instant::NEVER };
        let task = self.task.as_ref().map_or(Instant::NEVER, Task::deadline);
        self.waiting.at.min(self.process_data.deadline()).min(self.raw.deadline()).min(listen).min(task)
    }

    /// The frames that it sends now.
    pub(crate) fn send(&mut self, now: Instant) -> Vec<Sent> {
        let mut frames = Vec::new();
        let is_cycle = self.process_data.deadline() <= now;
        if is_cycle {
            frames.extend(self.process_data.send(now, &mut self.ticket));
        }
        frames.extend(self.begin_task(now, is_cycle));
        if self.raw.deadline() <= now {
            frames.extend(self.raw.send(now, &mut self.ticket, &mut self.story));
        }
        if self.operations.is_empty() && self.next_listen <= now {
            self.listen(now);
        }
        if self.waiting.at <= now {
            frames.extend(self.send_operation(now));
        }
        frames
    }

    /// A period of the user program begins: the states of the slaves are read.
    fn begin_task(&mut self, now: Instant, is_cycle: bool) -> Vec<Sent> {
        let Some(task) = &mut self.task else { return Vec::new() };
        if is_cycle {
            task.in_step(now);
        }
        let begins = task.begin(now, self.process_data.cycle());
        if begins { self.states.send(&mut self.ticket) } else { Vec::new() }
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
        if now >= self.waiting.until {
            let words = operation.words();
            let reason = format!("{words}: no success within {}", self.patience());
            self.give_up(reason, now);
            return None;
        }
        if self.waiting.ticket.take().is_some() {
            let _ = operation.answered(None);
        }
        let received = self.slaves.get(operation.unit).map_or(0, Slave::received);
        operation.begin(MailboxConduct { received, ..self.mailbox });
        let frame = operation.frame();
        self.ticket += 1;
        self.waiting.ticket = Some(self.ticket);
        // Without an answer by then the frame is sent again.
        self.waiting.at = now + ANSWER_PATIENCE;
        Some(Sent { ticket: Ticket::Scripted(self.ticket), frame })
    }

    /// A frame returns. Frames that are no longer expected are ignored, as by a real master.
    pub(crate) fn receive(&mut self, ticket: u64, frame: Vec<u8>, now: Instant) {
        if let Some(words) = self.raw.receive(ticket, &frame) {
            return self.story.push(words);
        }
        let is_cyclic = self.process_data.receive(ticket, &frame) || self.states.receive(ticket, &frame);
        if !is_cyclic && self.waiting.ticket == Some(ticket) {
            self.waiting.ticket = None;
            if let Some(answer) = datagrams(&frame).next() {
                self.answer(&answer, now);
            }
        }
        self.process_data.reuse(frame);
    }

    fn answer(&mut self, DatagramView { working_counter, data, .. }: &DatagramView<'_>, now: Instant) {
        let Some(operation) = self.operations.front_mut() else { return };
        let answer = Answer { working_counter: *working_counter, data };
        let unit = operation.unit;
        let (progress, emergencies) = operation.answered(Some(answer));
        for emergency in emergencies {
            let received = Received { unit, emergency };
            self.story.push(received.words());
            self.emergencies.push(received);
        }
        match progress {
            Progress::Next | Progress::NextStage => self.waiting.at = now,
            Progress::Later => match operation.refusal() {
                Some(reason) => self.give_up(reason, now),
                None => self.waiting.at = now + POLL_PERIOD,
            },
            Progress::Done => self.end_operation(now),
        }
    }

    /// The first operation is complete.
    fn end_operation(&mut self, now: Instant) {
        self.keep_counters();
        let Some(operation) = self.operations.pop_front() else { return };
        let outcome = operation.clone().end(&mut self.slaves, &mut self.process_data);
        match outcome {
            Outcome::Done(steps) => {
                self.take_steps(steps, now);
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
    fn take_steps(&mut self, steps: Vec<Step>, now: Instant) {
        for step in steps.into_iter().rev() {
            match step {
                Step::Do(operation) => self.operations.push_front(operation),
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
    fn fail(&mut self, reason: String) {
        self.story.push(format!("gives up: {reason}"));
        self.gave_up = Some(reason);
    }

    /// When an order fails, its remaining operations are dropped and the next order starts.
    fn give_up(&mut self, reason: String, now: Instant) {
        if !self.operations.front().is_some_and(Operation::is_listening) {
            self.fail(reason);
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

    pub(crate) fn gave_up(&self) -> Option<&str> {
        self.gave_up.as_deref()
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
