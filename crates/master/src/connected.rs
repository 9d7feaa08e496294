//! A master and a line in one process and in virtual time.

use time::{Duration, Instant};

use crate::event::{Event, Failure, Outcome, RequestId};
use crate::master::Master;

/// What is at the other end of the cable: slaves that answer a frame at once.
pub trait Line {
    /// A frame leaves the master; its answer takes its place. Whether it comes back.
    fn frame(&mut self, now: Instant, frame: &mut [u8]) -> bool;

    /// The slaves do what is due, after each frame and at each deadline.
    fn poll(&mut self, now: Instant);

    /// When [`Line::poll`] has to be called next.
    fn deadline(&self) -> Instant;
}

/// A master with a line. Time passes only while an order is carried out, or as the owner says.
#[derive(Debug)]
pub struct Connected<L> {
    /// The master.
    pub master: Master,
    /// The line.
    pub line: L,
    now: Instant,
    frame: Vec<u8>,
    /// Events that nobody has taken yet.
    events: Vec<Event>,
}

impl<L: Line> Connected<L> {
    /// Connects them at `now`.
    #[must_use]
    pub const fn new(master: Master, line: L, now: Instant) -> Self {
        Self { master, line, now, frame: Vec::new(), events: Vec::new() }
    }

    /// The present moment.
    #[must_use]
    pub const fn now(&self) -> Instant {
        self.now
    }

    /// Lets time pass; what is due in it happens at its moment.
    pub fn run_for(&mut self, duration: Duration) {
        let end = self.now + duration;
        while self.exchange() <= end {
            self.now = self.deadline();
        }
        self.now = end;
    }

    /// Sends what leaves now, and brings back the answers; when something is due next.
    fn exchange(&mut self) -> Instant {
        let Self { master, line, now, frame, events } = self;
        line.poll(*now);
        while let Some(ticket) = master.transmit(*now, frame) {
            let comes_back = line.frame(*now, frame);
            line.poll(*now);
            if comes_back {
                master.receive(*now, ticket, frame);
            }
        }
        events.extend(core::iter::from_fn(|| master.take_event()));
        self.deadline()
    }

    fn deadline(&self) -> Instant {
        self.master.deadline().min(self.line.deadline()).max(self.now)
    }

    /// Runs until an order is done; how it ended at each slave, and for all of them.
    pub fn complete(&mut self, request: RequestId) -> Vec<(Option<usize>, Result<Outcome, Failure>)> {
        while self.exchange() < Instant::NEVER && self.master.is_open(request) {
            self.now = self.deadline();
        }
        let mut results = Vec::new();
        self.events.retain(|event| match event {
            Event::Finished { request: of, slave, result } if *of == request => {
                results.push((*slave, result.clone()));
                false
            }
            Event::Finished { .. } => true,
        });
        results
    }

    /// The same for an order with one result.
    fn one(&mut self, request: RequestId) -> Result<Outcome, Failure> {
        self.complete(request).pop().map_or(Err(Failure::NoSlave), |(_, result)| result)
    }

    /// Finds the slaves; how many there are.
    ///
    /// # Errors
    /// The first slave that cannot be identified.
    pub fn search(&mut self) -> Result<usize, Failure> {
        let request = self.master.search(self.now);
        let failure = self.complete(request).into_iter().find_map(|(_, result)| result.err());
        failure.map_or(Ok(self.master.slaves().len()), Err)
    }

    /// Reads bytes of a slave's memory.
    ///
    /// # Errors
    /// The slave does not answer.
    pub fn read(&mut self, slave: usize, offset: u16, length_bytes: u16) -> Result<Vec<u8>, Failure> {
        let request = self.master.read(self.now, slave, offset, length_bytes);
        match self.one(request)? {
            Outcome::Data(data) => Ok(data),
            _ => Ok(Vec::new()),
        }
    }

    /// Writes bytes of a slave's memory.
    ///
    /// # Errors
    /// The slave does not take them.
    pub fn write(&mut self, slave: usize, offset: u16, data: &[u8]) -> Result<(), Failure> {
        let request = self.master.write(self.now, slave, offset, data);
        self.one(request).map(drop)
    }
}
