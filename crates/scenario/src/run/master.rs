//! The scripted master: executes its orders in virtual time, one acyclic frame at a time, and exchanges process
//! data in parallel.

mod answer;
mod asked_sdo;
mod course;
mod emergencies;
mod frames;
mod given_up;
mod habits;
mod known;
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

use ::master::{Flights, Habits, MailboxConduct, Runner};
use esi::KnownDevice;
use plc::{ProgramEvent, Reports};
use time::{Duration, Instant};

use given_up::OrdersGivenUp;
use habits::habits;
use last_sdo::LastSdos;
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
use raw::Raw;
pub(crate) use sent::{Sent, Ticket};
pub(crate) use slave::changed_settings;
pub(crate) use variables::{MasterVariables, NODE_ADDRESS_MAX, Node};

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

    /// The time of its next frame or time-out.
    pub(crate) fn deadline(&self) -> Instant {
        let listen = if self.operations.is_empty() { self.next_listen } else { Instant::NEVER };
        let task = self.task.as_ref().map_or(Instant::NEVER, Task::deadline);
        let operation = self.runner.deadline().min(self.flights.deadline());
        operation.min(self.process_data.deadline()).min(self.raw.deadline()).min(listen).min(task)
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
}
