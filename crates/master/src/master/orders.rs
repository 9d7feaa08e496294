//! Orders of the owner, and the jobs that they come down to.

use time::Instant;
use wire::{AlState, Command};

use super::{EVERYBODYS, Master, OwnDatagram};
use crate::event::{Event, Failure, RequestId};
use crate::habits::Addressing;
use crate::information::EscInformation;
use crate::job::Job;
use crate::queue::{Found, Pace, Task, Then};
use crate::register::{RegisterRead, RegisterWrite};
use crate::registers;
use crate::search::Search;
use crate::slave::Slave;
use crate::state::{DeviceIdRequest, StateRequest};

/// Most data bytes of one datagram.
const DATAGRAM_BYTES_MAX: usize = 1_486;

impl Master {
    /// Finds the slaves of the line: counts them, takes them to INIT, gives them station addresses, and reads what
    /// their controllers and their SIIs say. What was known of slaves is forgotten.
    pub fn search(&mut self, now: Instant) -> RequestId {
        let request = self.next_request();
        self.slaves.clear();
        let pace = Pace { now, habits: &self.habits, timeouts: &EVERYBODYS };
        let job = Job::Search(Search::default());
        self.everybody.push(Task { request, job, then: Then::Report }, &pace);
        request
    }

    /// So many slaves have answered: each of them is asked who it is.
    pub(super) fn identify(&mut self, now: Instant, request: RequestId, count: u16) {
        self.slaves = (0..count).map(Slave::new).collect();
        for position in 0..count {
            let mut jobs = Vec::new();
            if let Addressing::Station { first } = self.habits.addressing {
                let address = first.wrapping_add(position);
                let write = Job::write(registers::STATION_ADDRESS, &address.to_le_bytes());
                jobs.push((write, Then::UseStationAddress(address)));
            }
            jobs.extend([
                (
                    Job::read(registers::INFORMATION, EscInformation::LENGTH_BYTES),
                    Then::Keep(Found::Information),
                ),
                (Job::read(registers::DL_STATUS, 2), Then::Keep(Found::DlStatus)),
                (Job::read(registers::STATION_ALIAS, 2), Then::Keep(Found::Alias)),
                (Job::Sii(Box::default()), Then::Keep(Found::Sii)),
                (Job::State(StateRequest::reset(AlState::Init)), Then::Continue),
            ]);
            self.push(now, usize::from(position), request, jobs);
        }
    }

    /// Sends a datagram once, whatever comes back.
    pub fn datagram(&mut self, command: Command, address: u16, offset: u16, data: &[u8]) -> RequestId {
        let request = self.next_request();
        let data = data.to_vec();
        if data.len() > DATAGRAM_BYTES_MAX {
            self.refuse(request, None, Failure::TooLong { length_bytes: data.len() });
        } else {
            self.datagrams.push_back(OwnDatagram { request, command, address, offset, data });
        }
        request
    }

    /// Reads bytes of a slave's memory.
    pub fn read(&mut self, now: Instant, slave: usize, offset: u16, length_bytes: u16) -> RequestId {
        let job = Job::Read(RegisterRead::new(offset, length_bytes));
        self.order(now, slave, usize::from(length_bytes), job)
    }

    /// Writes bytes of a slave's memory, until it takes them.
    pub fn write(&mut self, now: Instant, slave: usize, offset: u16, data: &[u8]) -> RequestId {
        self.order(now, slave, data.len(), Job::Write(RegisterWrite::new(offset, data.to_vec())))
    }

    /// Carries out a dialogue with the state machine of a slave, as it is: nothing is set up and nothing acknowledged.
    pub fn request_state(&mut self, now: Instant, slave: usize, state: StateRequest) -> RequestId {
        self.order(now, slave, 0, Job::State(state))
    }

    /// Asks a slave for its Explicit Device ID.
    pub fn read_device_id(&mut self, now: Instant, slave: usize) -> RequestId {
        let state = self.slaves.get(slave).map_or(AlState::Init, |slave| slave.report.status.state);
        self.order(now, slave, 0, Job::DeviceId(DeviceIdRequest::new(state)))
    }

    /// Reads the SII of a slave.
    pub fn read_sii(&mut self, now: Instant, slave: usize) -> RequestId {
        self.order(now, slave, 0, Job::Sii(Box::default()))
    }

    fn order(&mut self, now: Instant, slave: usize, length_bytes: usize, job: Job) -> RequestId {
        let request = self.next_request();
        if length_bytes > DATAGRAM_BYTES_MAX {
            self.refuse(request, Some(slave), Failure::TooLong { length_bytes });
        } else {
            self.push(now, slave, request, [(job, Then::Report)]);
        }
        request
    }

    fn push(
        &mut self,
        now: Instant,
        position: usize,
        request: RequestId,
        jobs: impl IntoIterator<Item = (Job, Then)>,
    ) {
        let Some(slave) = self.slaves.get_mut(position) else {
            return self.refuse(request, Some(position), Failure::NoSlave);
        };
        let pace = Pace { now, habits: &self.habits, timeouts: &slave.timeouts };
        for (job, then) in jobs {
            slave.queue.push(Task { request, job, then }, &pace);
        }
    }

    fn refuse(&mut self, request: RequestId, slave: Option<usize>, failure: Failure) {
        self.events.push_back(Event::Finished { request, slave, result: Err(failure) });
    }

    const fn next_request(&mut self) -> RequestId {
        self.requests += 1;
        RequestId(self.requests)
    }
}
