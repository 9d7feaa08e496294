//! Orders of the caller, and the jobs that they consist of.

use esi::DeviceDescription;
use time::Instant;
use wire::{AlState, Command, SdoInfoRequest, SdoTarget};

use super::{EVERYBODYS, Master, NOBODYS, OwnDatagram};
use crate::access::{Address, DATAGRAM_BYTES_MAX};
use crate::event::{Event, Failure, RequestId};
use crate::information::EscInformation;
use crate::job::Job;
use crate::mailbox::{MailboxConduct, MailboxDialogue};
use crate::process_data::ProcessData;
use crate::queue::{Found, Task, Then};
use crate::reaction::ServiceFailure;
use crate::register::{RegisterRead, RegisterWrite};
use crate::registers;
use crate::runner::Pace;
use crate::sdo::SdoTransfer;
use crate::sdo_information::SdoInformation;
use crate::search::Search;
use crate::service::Service;
use crate::settings::{DeviceIdSource, SlaveSettings};
use crate::slave::Slave;
use crate::state::{DeviceIdRequest, StateRequest};

impl Master {
    /// Finds the slaves of the line: counts them, takes them to INIT, gives them station addresses, and reads
    /// their controllers and their SIIs. Everything known about slaves before is discarded.
    pub fn search(&mut self, now: Instant) -> RequestId {
        let request = self.next_request();
        self.slaves.clear();
        self.process_data = ProcessData::new(self.process_data.exchange(), []);
        let pace = Pace { now, habits: &self.habits, timeouts: &EVERYBODYS };
        let job = Job::Search(Search::default());
        self.everybody.push(Task { request, job, then: Then::Continue }, &pace);
        request
    }

    /// This number of slaves have answered: each of them is identified.
    pub(super) fn identify(&mut self, now: Instant, request: RequestId, count: u16) {
        self.slaves = (0..count).map(|position| Slave::new(position, self.habits.mailbox)).collect();
        let addresses = (0..count).map(|position| self.habits.addressing.of(position));
        self.process_data = ProcessData::new(self.process_data.exchange(), addresses);
        for position in 0..count {
            let mut jobs = Vec::new();
            if let Address::Station(address) = self.habits.addressing.of(position) {
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

    /// Sends a datagram once, whatever the result is.
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
        self.order(now, slave, Job::Read(RegisterRead::new(offset, length_bytes)))
    }

    /// Writes bytes to a slave's memory, until it accepts them.
    pub fn write(&mut self, now: Instant, slave: usize, offset: u16, data: &[u8]) -> RequestId {
        self.order(now, slave, Job::Write(RegisterWrite::new(offset, data.to_vec())))
    }

    /// Takes a slave to a state with the sequence of a real master: errors are acknowledged, SyncManagers,
    /// FMMUs, registers and SDOs are written, process data begin with SAFE-OP.
    pub fn take_to(&mut self, now: Instant, slave: usize, state: AlState) -> RequestId {
        let request = self.next_request();
        self.push(now, slave, request, [(Job::read_al_status(), Then::Walk(state))]);
        request
    }

    /// Takes all slaves to a state, at the same time.
    pub fn take_all_to(&mut self, now: Instant, state: AlState) -> RequestId {
        let request = self.next_request();
        for slave in 0..self.slaves.len() {
            self.push(now, slave, request, [(Job::read_al_status(), Then::Walk(state))]);
        }
        request
    }

    /// Executes a dialogue with the state machine of a slave as it is: without set-up or acknowledge.
    pub fn request_state(&mut self, now: Instant, slave: usize, state: StateRequest) -> RequestId {
        self.order(now, slave, Job::State(state))
    }

    /// Requests the Explicit Device ID of a slave, from the place given in its settings.
    pub fn read_device_id(&mut self, now: Instant, slave: usize) -> RequestId {
        let request = self.next_request();
        let job = match self.slaves.get(slave).map(|slave| (slave.settings.device_id, slave.state())) {
            Some((DeviceIdSource::AlStatusCode, state)) => Job::DeviceId(DeviceIdRequest::new(state)),
            Some((DeviceIdSource::Register(offset), _)) => Job::read(offset, 2),
            Some((DeviceIdSource::StationAlias, _)) | None => Job::read(registers::STATION_ALIAS, 2),
        };
        self.push(now, slave, request, [(job, Then::DeviceId)]);
        request
    }

    /// Reads the SII of a slave.
    pub fn read_sii(&mut self, now: Instant, slave: usize) -> RequestId {
        self.order(now, slave, Job::Sii(Box::default()))
    }

    /// Reads an entry or a whole object by SDO.
    pub fn upload(&mut self, now: Instant, slave: usize, target: SdoTarget) -> RequestId {
        self.service(now, slave, Service::Sdo(SdoTransfer::upload(target)))
    }

    /// Writes an entry or a whole object by SDO.
    pub fn download(&mut self, now: Instant, slave: usize, target: SdoTarget, value: &[u8]) -> RequestId {
        self.service(now, slave, Service::Sdo(SdoTransfer::download(target, value)))
    }

    /// Queries the object dictionary. [`SdoInformation`] describes the answer.
    pub fn information(&mut self, now: Instant, slave: usize, question: SdoInfoRequest) -> RequestId {
        self.service(now, slave, Service::Information(SdoInformation::new(question)))
    }

    /// Executes a mailbox service of a slave.
    pub fn service(&mut self, now: Instant, slave: usize, service: Service) -> RequestId {
        let request = self.next_request();
        let mailbox = self.slaves.get(slave).map(Slave::mailbox);
        match mailbox {
            Some(Some((out, inward))) => {
                let job = Job::mailbox(MailboxDialogue::new(out, inward, service));
                self.push(now, slave, request, [(job, Then::Continue)]);
            }
            Some(None) => self.refuse(request, Some(slave), Failure::Mailbox(ServiceFailure::NoMailbox)),
            None => self.refuse(request, Some(slave), Failure::NoSlave),
        }
        request
    }

    /// Reads the mailboxes of slaves that have no other jobs.
    pub(super) fn listen(&mut self, now: Instant) {
        let Some(period) = self.habits.listen_period else { return };
        for slave in self.slaves.iter_mut().filter(|slave| slave.queue.is_empty() && slave.next_listen <= now)
        {
            slave.next_listen = now + period;
            if let Some((out, inward)) = slave.mailbox() {
                let job = Job::mailbox(MailboxDialogue::new(out, inward, Service::Listen));
                let pace = Pace { now, habits: &self.habits, timeouts: &slave.settings.timeouts };
                slave.queue.push(Task { request: NOBODYS, job, then: Then::Continue }, &pace);
            }
        }
    }

    /// The settings that are written to a slave on its way up, for changes. They apply from its next way up.
    pub fn settings_mut(&mut self, slave: usize) -> Option<&mut SlaveSettings> {
        self.slaves.get_mut(slave).map(|slave| &mut slave.settings)
    }

    /// Sets a slave up according to a description instead of its SII.
    pub fn describe(&mut self, slave: usize, description: &DeviceDescription) {
        if let Some(slave) = self.slaves.get_mut(slave) {
            slave.settings = SlaveSettings::from_description(description);
            slave.adapt_settings();
        }
    }

    /// Changes how the mailbox of a slave is handled from now on.
    pub fn change_mailbox(&mut self, slave: usize, change: impl FnMut(&mut MailboxConduct)) {
        if let Some(slave) = self.slaves.get_mut(slave) {
            slave.queue.change_conduct(change);
        }
    }

    fn order(&mut self, now: Instant, slave: usize, job: Job) -> RequestId {
        let request = self.next_request();
        self.push(now, slave, request, [(job, Then::Continue)]);
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
        let pace = Pace { now, habits: &self.habits, timeouts: &slave.settings.timeouts };
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
