//! The master: orders in, frames out and in, events out.

mod answers;
mod exchange;
mod orders;

use std::collections::VecDeque;

use esi::Timeouts;
use time::Instant;
use wire::Command;

use crate::access::Address;
use crate::arrival::Arrival;
use crate::event::{Event, RequestId};
use crate::flight::{Flights, Ticket};
use crate::habits::Habits;
use crate::load::Load;
use crate::mailbox::MailboxConduct;
use crate::process_data::ProcessData;
use crate::queue::Queue;
use crate::sender::Sender;
use crate::slave::Slave;

/// A master of one line. It has no clock and no socket: the caller gets frames from it, passes it the answers,
/// and calls again when its deadline is due.
///
/// ```
/// use master::Master;
/// use time::Instant;
///
/// let (mut master, mut now) = (Master::default(), Instant::ZERO);
/// let search = master.search(now);
/// let mut frame = Vec::new();
/// // The line has no slave: no frame comes back.
/// while master.is_open(search) {
///     while let Some(_ticket) = master.transmit(now, &mut frame) {}
///     now = master.deadline();
/// }
/// assert!(master.slaves().is_empty());
/// ```
#[derive(Debug)]
pub struct Master {
    habits: Habits,
    everybody: Queue,
    slaves: Vec<Slave>,
    datagrams: VecDeque<OwnDatagram>,
    process_data: ProcessData,
    flights: Flights<Sender>,
    events: VecDeque<Event>,
    emergencies_lost: u64,
    requests: u64,
    /// The slave that comes first if not all fit into a frame.
    turn: usize,
}

/// A datagram that the caller has ordered.
#[derive(Debug)]
struct OwnDatagram {
    request: RequestId,
    command: Command,
    address: u16,
    offset: u16,
    data: Vec<u8>,
}

/// Time-outs of dialogues with all slaves.
const EVERYBODYS: Timeouts = Timeouts::USUAL;
/// Work without an order.
const NOBODYS: RequestId = RequestId(0);

impl Master {
    /// A master with these habits, without any known slaves. Periods and time-outs that are too short are
    /// lengthened: see [`Habits`].
    #[must_use]
    pub fn new(habits: Habits) -> Self {
        let habits = habits.that_take_time();
        Self {
            everybody: Queue::new(MailboxConduct::default()),
            slaves: Vec::new(),
            datagrams: VecDeque::new(),
            process_data: ProcessData::new(habits.exchange, []),
            flights: Flights::default(),
            events: VecDeque::new(),
            emergencies_lost: 0,
            requests: NOBODYS.0,
            turn: 0,
            habits,
        }
    }

    /// The slaves, the one next to the master first.
    #[must_use]
    pub fn slaves(&self) -> &[Slave] {
        &self.slaves
    }

    /// Whether parts of an order are not complete yet.
    #[must_use]
    pub fn is_open(&self, request: RequestId) -> bool {
        self.everybody.holds(request)
            || self.slaves.iter().any(|slave| slave.queue.holds(request))
            || self.datagrams.iter().any(|datagram| datagram.request == request)
            || self.flights.carries(&Sender::Owner(request))
    }

    /// Takes the oldest event.
    pub fn take_event(&mut self) -> Option<Event> {
        self.events.pop_front()
    }

    /// Emergencies that were dropped because the events before them were not taken.
    #[must_use]
    pub const fn emergencies_lost(&self) -> u64 {
        self.emergencies_lost
    }

    /// The time at which [`Master::transmit`] must be called next, independent of answers. After it has returned none,
    /// this time is in the future.
    #[must_use]
    pub fn deadline(&self) -> Instant {
        self.accesses_deadline().min(self.process_data.deadline()).min(self.flights.deadline())
    }

    /// Accesses to single slaves, and datagrams of the caller, wait for the end of a dialogue with all slaves.
    fn accesses_deadline(&self) -> Instant {
        if !self.everybody.is_empty() {
            return self.everybody.deadline();
        }
        let slaves = self.slaves.iter().map(Slave::deadline).min().unwrap_or(Instant::NEVER);
        if self.datagrams.is_empty() { slaves } else { Instant::ZERO }
    }

    /// Writes the next frame to be sent now into `frame`, replacing its contents; none if there is no further
    /// one. Process data come first. Allocates nothing for a frame if `frame` has room for 1,518 bytes.
    pub fn transmit(&mut self, now: Instant, frame: &mut Vec<u8>) -> Option<Ticket> {
        self.lose_frames(now);
        self.give_up(now);
        self.listen(now);
        let mut load = self.flights.load(core::mem::take(frame), &self.habits);
        self.load(now, &mut load);
        let (bytes, ticket) = self.flights.depart(load, now + self.habits.answer_patience);
        *frame = bytes;
        ticket
    }

    /// Process data first; when those of this cycle have been sent, accesses that are due, as many as fit. A
    /// dialogue with all slaves has a frame of its own.
    fn load(&mut self, now: Instant, load: &mut Load<Sender>) {
        if self.process_data.next_cycle(now) {
            self.flights.forget(|sender| matches!(sender, Sender::Cycle(_)));
        }
        load.process_data(&mut self.process_data, Sender::Cycle);
        if !load.is_empty() {
            return;
        }
        if self.everybody.is_empty() {
            self.load_datagrams(load);
            self.load_slaves(now, load);
        } else if self.everybody.due(now) {
            let number = self.everybody.depart();
            self.everybody.load(Sender::Everybody(number), Address::All, load);
        }
    }

    fn load_datagrams(&mut self, load: &mut Load<Sender>) {
        while let Some(datagram) =
            self.datagrams.front().filter(|datagram| load.has_room(datagram.data.len()))
        {
            let sender = Sender::Owner(datagram.request);
            load.datagram(sender, datagram.command, (datagram.address, datagram.offset), &datagram.data);
            self.datagrams.pop_front();
        }
    }

    fn load_slaves(&mut self, now: Instant, load: &mut Load<Sender>) {
        let count = self.slaves.len();
        let turn = self.turn.min(count);
        for position in (turn..count).chain(0..turn) {
            let slave = &mut self.slaves[position];
            if !slave.queue.due(now) {
                continue;
            }
            if !load.has_room(slave.queue.access_bytes()) {
                self.turn = position;
                return;
            }
            let number = slave.queue.depart();
            slave.queue.load(Sender::Slave(position, number), slave.address, load);
        }
    }

    /// A frame returns for a ticket. Late, duplicate and invalid answers are ignored.
    pub fn receive(&mut self, now: Instant, ticket: Ticket, frame: &[u8]) {
        if let Some(arrival) = self.flights.arrive(ticket, frame) {
            self.take(now, arrival);
        }
    }

    /// The same for a caller that keeps no tickets: a frame is identified by the indexes of its datagrams,
    /// which must be [`Indexes::Running`](crate::Indexes::Running). A frame that has not passed a slave, and a frame that is not an
    /// answer, are ignored.
    pub fn receive_frame(&mut self, now: Instant, frame: &[u8]) {
        let has_passed = frame.get(6).is_some_and(|first| first & 0x02 != 0);
        if has_passed && let Some(arrival) = self.flights.recognize(frame) {
            self.take(now, arrival);
        }
    }

    fn take(&mut self, now: Instant, arrival: Arrival<'_, Sender>) {
        for (sender, answer) in arrival.answers() {
            self.answer(now, *sender, Some(answer));
        }
        self.flights.recycle(arrival);
    }

    /// Frames without an answer in time are lost.
    fn lose_frames(&mut self, now: Instant) {
        while let Some(parts) = self.flights.lose(now) {
            for part in &parts {
                self.answer(now, part.sender, None);
            }
            self.flights.recycle_parts(parts);
        }
    }
}

impl Default for Master {
    fn default() -> Self {
        Self::new(Habits::default())
    }
}
