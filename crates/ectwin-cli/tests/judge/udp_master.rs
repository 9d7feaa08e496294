//! The project's own master in real time, over UDP.

use std::io::ErrorKind;
use std::net::UdpSocket;
use std::time::{Duration, Instant as WallInstant};

use ectwin::master::{Failure, Habits, Master, Outcome, RequestId};
use ectwin::wire::SdoTarget;
use ectwin::{AlState, Instant};

const AL_STATUS: u16 = 0x0130;
/// UDP carries a frame without it.
const ETHERNET_HEADER: [u8; 14] = [0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 2, 0, 0, 0, 0, 1, 0x88, 0xA4];
/// The longest wait for one answer, so that what is due is sent.
const WAIT_MAX: Duration = Duration::from_millis(1);

/// A master at the other end of a UDP link.
pub(crate) struct UdpMaster {
    pub(crate) master: Master,
    socket: UdpSocket,
    began: WallInstant,
    frame: Vec<u8>,
    answer: Vec<u8>,
    /// Frames that a mistaken master does not send.
    pub(crate) leaves_out: fn(&[u8]) -> bool,
}

impl UdpMaster {
    /// A master on this link, such as `udp:127.0.0.1:34980`.
    pub(crate) fn new(link: &str, habits: Habits) -> Self {
        let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
        socket.connect(link.strip_prefix("udp:").unwrap()).unwrap();
        let (frame, answer) = (Vec::with_capacity(1_518), vec![0; 1_600]);
        let leaves_out = |_: &[u8]| false;
        Self { master: Master::new(habits), socket, began: WallInstant::now(), frame, answer, leaves_out }
    }

    pub(crate) fn now(&self) -> Instant {
        Instant::from_nanos(u64::try_from(self.began.elapsed().as_nanos()).unwrap())
    }

    /// Sends what is due, and takes an answer if one comes soon. False: the units are gone.
    pub(crate) fn step(&mut self) -> bool {
        while let Some(_ticket) = self.master.transmit(self.now(), &mut self.frame) {
            if (self.leaves_out)(&self.frame) {
                continue;
            }
            if self.socket.send(&self.frame[ETHERNET_HEADER.len()..]).is_err() {
                return false;
            }
        }
        let wait = self.master.deadline().saturating_since(self.now()).as_nanos();
        let wait = Duration::from_nanos(wait).clamp(Duration::from_micros(50), WAIT_MAX);
        self.socket.set_read_timeout(Some(wait)).unwrap();
        self.answer[..ETHERNET_HEADER.len()].copy_from_slice(&ETHERNET_HEADER);
        // A slave has set the bit.
        self.answer[6] |= 2;
        match self.socket.recv(&mut self.answer[ETHERNET_HEADER.len()..]) {
            Ok(length) => {
                self.master.receive_frame(self.now(), &self.answer[..ETHERNET_HEADER.len() + length])
            }
            Err(error) if [ErrorKind::WouldBlock, ErrorKind::TimedOut].contains(&error.kind()) => {}
            Err(_) => return false,
        }
        true
    }

    /// Runs until an order is done. None: the units are gone.
    pub(crate) fn complete(&mut self, request: RequestId) -> Option<Result<Outcome, Failure>> {
        while self.master.is_open(request) {
            if !self.step() {
                return None;
            }
        }
        let events = std::iter::from_fn(|| self.master.take_event());
        let results = events.filter_map(|event| match event {
            ectwin::master::Event::Finished { request: of, result, .. } if of == request => Some(result),
            _ => None,
        });
        results.last()
    }

    /// Finds the units, reads something by SDO, and takes the first one to OP.
    pub(crate) fn take_to_op(&mut self) -> Option<Result<Outcome, Failure>> {
        let search = self.master.search(self.now());
        self.complete(search)?.unwrap();
        self.take_to(AlState::PreOp)?.unwrap();
        for sub in [1, 2, 4] {
            let read = self.master.upload(self.now(), 0, SdoTarget::entry(0x1018, sub));
            // A mistaken master gets no answers.
            let _answer = self.complete(read)?;
        }
        self.take_to(AlState::Op)
    }

    fn take_to(&mut self, state: AlState) -> Option<Result<Outcome, Failure>> {
        let taken = self.master.take_to(self.now(), 0, state);
        self.complete(taken)
    }

    /// Exchanges process data, and takes the unit back to OP whenever it is not there, until the units are gone.
    pub(crate) fn keep_in_op(&mut self) -> Option<()> {
        loop {
            let read = self.master.read(self.now(), 0, AL_STATUS, 2);
            let is_in_op =
                matches!(self.complete(read)?, Ok(Outcome::Data(status)) if status.first() == Some(&8));
            if !is_in_op {
                let _result = self.take_to(AlState::Op)?;
            }
            let end = WallInstant::now() + Duration::from_millis(10);
            while WallInstant::now() < end {
                self.step().then_some(())?;
            }
        }
    }

    /// Exchanges process data until the units are gone.
    pub(crate) fn run_to_the_end(&mut self) {
        while self.step() {
            while self.master.take_event().is_some() {}
        }
    }
}
