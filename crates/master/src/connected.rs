//! A master and a line in one process and in virtual time.

use time::{Duration, Instant};
use wire::{AlState, SdoInfoRequest, SdoTarget};

use crate::event::{Event, Failure, Outcome, RequestId};
use crate::master::Master;
use crate::registers;
use crate::service::Service;
use crate::state::{AlReport, StateRequest};

/// The other end of the cable: slaves that answer a frame immediately.
pub trait Line {
    /// A frame leaves the master; its answer replaces it. Returns whether it comes back.
    fn frame(&mut self, now: Instant, frame: &mut [u8]) -> bool;

    /// The slaves do due work, after each frame and at each deadline.
    fn poll(&mut self, now: Instant);

    /// The time at which [`Line::poll`] must be called next.
    fn deadline(&self) -> Instant;
}

impl<L: Line + ?Sized> Line for &mut L {
    fn frame(&mut self, now: Instant, frame: &mut [u8]) -> bool {
        (**self).frame(now, frame)
    }

    fn poll(&mut self, now: Instant) {
        (**self).poll(now);
    }

    fn deadline(&self) -> Instant {
        (**self).deadline()
    }
}

/// A master with a line. Time advances only while an order is executed, or when the caller advances it.
#[derive(Debug)]
pub struct Connected<L> {
    /// The master.
    pub master: Master,
    /// The line.
    pub line: L,
    now: Instant,
    frame: Vec<u8>,
    /// Events that have not been taken yet.
    events: Vec<Event>,
}

impl<L: Line> Connected<L> {
    /// Connects them at `now`.
    #[must_use]
    pub const fn new(master: Master, line: L, now: Instant) -> Self {
        Self { master, line, now, frame: Vec::new(), events: Vec::new() }
    }

    /// The present time.
    #[must_use]
    pub const fn now(&self) -> Instant {
        self.now
    }

    /// Advances the time; work that becomes due is done at its time.
    pub fn run_for(&mut self, duration: Duration) {
        let end = self.now + duration;
        while self.exchange() <= end {
            self.now = self.deadline();
        }
        self.now = end;
        self.line.poll(end);
    }

    /// Sends the due frames, and passes on the answers; returns when something is due next.
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

    /// Runs until an order is done; returns its result for each slave, and for all of them.
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
            Event::Finished { .. } | Event::Emergency { .. } => true,
        });
        results
    }

    /// The same for an order with one result.
    fn one(&mut self, request: RequestId) -> Result<Outcome, Failure> {
        self.complete(request).pop().map_or(Err(Failure::NoSlave), |(_, result)| result)
    }

    /// Finds the slaves; returns their number.
    ///
    /// # Errors
    /// The first slave that cannot be identified.
    pub fn search(&mut self) -> Result<usize, Failure> {
        let request = self.master.search(self.now);
        let failure = self.complete(request).into_iter().find_map(|(_, result)| result.err());
        failure.map_or(Ok(self.master.slaves().len()), Err)
    }

    /// Takes a slave to a state with the sequence of a real master.
    ///
    /// # Errors
    /// The step that failed.
    pub fn take_to(&mut self, slave: usize, state: AlState) -> Result<(), Failure> {
        let request = self.master.take_to(self.now, slave, state);
        self.one(request).map(drop)
    }

    /// Takes all slaves to a state at the same time.
    ///
    /// # Errors
    /// The first slave that does not reach it, and why.
    pub fn take_all_to(&mut self, state: AlState) -> Result<(), (usize, Failure)> {
        let request = self.master.take_all_to(self.now, state);
        let failure = |(slave, result): (Option<usize>, Result<_, _>)| Some((slave?, result.err()?));
        self.complete(request).into_iter().find_map(failure).map_or(Ok(()), Err)
    }

    /// Executes a dialogue with the state machine of a slave; returns AL status afterwards.
    ///
    /// # Errors
    /// The state is refused or not reached.
    pub fn request_state(&mut self, slave: usize, state: StateRequest) -> Result<AlReport, Failure> {
        let request = self.master.request_state(self.now, slave, state);
        match self.one(request)? {
            Outcome::State(report) => Ok(report),
            _ => Ok(AlReport::default()),
        }
    }

    /// AL status and AL status code of a slave, now.
    ///
    /// # Errors
    /// The slave does not answer.
    pub fn al_report(&mut self, slave: usize) -> Result<AlReport, Failure> {
        let bytes = self.read(slave, registers::AL_STATUS, AlReport::LENGTH_BYTES)?;
        Ok(AlReport::parse(&bytes))
    }

    /// The Explicit Device ID of a slave.
    ///
    /// # Errors
    /// The slave does not show it.
    pub fn device_id(&mut self, slave: usize) -> Result<u16, Failure> {
        let request = self.master.read_device_id(self.now, slave);
        match self.one(request)? {
            Outcome::DeviceId(id) => Ok(id),
            _ => Err(Failure::NoAnswer),
        }
    }

    /// Reads an entry or a whole object by SDO.
    ///
    /// # Errors
    /// The refusal, or why there was no reply.
    pub fn upload(&mut self, slave: usize, target: SdoTarget) -> Result<Vec<u8>, Failure> {
        let request = self.master.upload(self.now, slave, target);
        self.data(request)
    }

    /// Writes an entry or a whole object by SDO.
    ///
    /// # Errors
    /// The refusal, or why there was no reply.
    pub fn download(&mut self, slave: usize, target: SdoTarget, value: &[u8]) -> Result<(), Failure> {
        let request = self.master.download(self.now, slave, target, value);
        self.one(request).map(drop)
    }

    /// Queries the object dictionary of a slave. [`crate::SdoInformation`] describes the answer.
    ///
    /// # Errors
    /// The refusal, or why there was no reply.
    pub fn information(&mut self, slave: usize, question: SdoInfoRequest) -> Result<Vec<u8>, Failure> {
        let request = self.master.information(self.now, slave, question);
        self.data(request)
    }

    /// Executes a mailbox service of a slave.
    ///
    /// # Errors
    /// The refusal, or why there was no reply.
    pub fn service(&mut self, slave: usize, service: Service) -> Result<Vec<u8>, Failure> {
        let request = self.master.service(self.now, slave, service);
        self.data(request)
    }

    /// Events that do not belong to a completed order: emergencies, and the ends of orders that were running meanwhile.
    pub fn take_events(&mut self) -> Vec<Event> {
        core::mem::take(&mut self.events)
    }

    fn data(&mut self, request: RequestId) -> Result<Vec<u8>, Failure> {
        match self.one(request)? {
            Outcome::Data(data) => Ok(data),
            _ => Ok(Vec::new()),
        }
    }

    /// Reads bytes of a slave's memory.
    ///
    /// # Errors
    /// The slave does not answer.
    pub fn read(&mut self, slave: usize, offset: u16, length_bytes: u16) -> Result<Vec<u8>, Failure> {
        let request = self.master.read(self.now, slave, offset, length_bytes);
        self.data(request)
    }

    /// Writes bytes of a slave's memory.
    ///
    /// # Errors
    /// The slave does not accept them.
    pub fn write(&mut self, slave: usize, offset: u16, data: &[u8]) -> Result<(), Failure> {
        let request = self.master.write(self.now, slave, offset, data);
        self.one(request).map(drop)
    }
}
