//! Frames that are lost, late, duplicated and damaged: the master always terminates, takes no wrong answer for
//! a right one, and never requests a state of a slave before it has acknowledged a refusal.

use master::{Event, Failure, Habits, LostRead, Master, Outcome, RequestId};
use nx_ect101::NxEct101;
use proptest::prelude::*;
use time::{Duration, Instant};
use wire::{AlControl, AlState, AlStatus, Command, SdoInfoList, SdoInfoRequest, SdoTarget, datagrams};

use crate::bench::{Slaves, connected_with};

/// The fault of a frame.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Fate {
    Passes,
    LostOnItsWay,
    LostOnItsWayBack,
    Late(u8),
    Doubled,
    /// A byte of the answer is changed.
    Damaged(u16, u8),
}

pub(crate) fn fate() -> impl Strategy<Value = Fate> {
    prop_oneof![
        6 => Just(Fate::Passes),
        1 => Just(Fate::LostOnItsWay),
        2 => Just(Fate::LostOnItsWayBack),
        1 => (0..60_u8).prop_map(Fate::Late),
        1 => Just(Fate::Doubled),
    ]
}

fn any_fate() -> impl Strategy<Value = Fate> {
    prop_oneof![8 => fate(), 1 => (12..80_u16, 1..=255_u8).prop_map(|(at, bits)| Fate::Damaged(at, bits))]
}

/// A line that treats each frame according to the list, and then starts again from the beginning of the list.
pub(crate) struct BadLine {
    pub(crate) master: Master,
    pub(crate) slaves: Slaves<NxEct101>,
    fates: Vec<Fate>,
    next: usize,
    late: Vec<(Instant, master::Ticket, Vec<u8>)>,
    pub(crate) now: Instant,
    /// Slaves that have shown an error to the master, and since then no state without one.
    refused: [bool; 2],
    /// A damaged answer has been delivered: from then on the master may have a wrong image of a slave.
    pub(crate) is_deceived: bool,
}

impl BadLine {
    pub(crate) fn new(fates: Vec<Fate>, lost_read: LostRead) -> Self {
        let mut habits = Habits { answer_patience: Duration::from_millis(5), ..Habits::default() };
        habits.mailbox.lost_read = lost_read;
        let bench = connected_with(Master::new(habits), 2, |_, _| {});
        let now = bench.now();
        let (master, slaves) = (bench.master, bench.line);
        Self {
            master,
            slaves,
            fates,
            next: 0,
            late: Vec::new(),
            now,
            refused: [false; 2],
            is_deceived: false,
        }
    }

    /// Runs until an order is done; returns its result for each slave.
    pub(crate) fn complete(&mut self, request: RequestId) -> Vec<(Option<usize>, Result<Outcome, Failure>)> {
        let limit = self.now + Duration::from_secs(120);
        let mut results = Vec::new();
        loop {
            self.exchange();
            results.extend(core::iter::from_fn(|| self.master.take_event()).filter_map(
                |event| match event {
                    Event::Finished { request: of, slave, result } if of == request => Some((slave, result)),
                    Event::Finished { .. } | Event::Emergency { .. } => None,
                },
            ));
            if !self.master.is_open(request) {
                return results;
            }
            self.now = self.deadline();
            assert!(self.now < limit, "{request:?} does not end");
        }
    }

    pub(crate) fn run_for(&mut self, duration: Duration) {
        let end = self.now + duration;
        self.exchange();
        while self.deadline() <= end {
            self.now = self.deadline();
            self.exchange();
        }
        self.now = end;
    }

    fn deadline(&self) -> Instant {
        let late = self.late.iter().map(|(at, ..)| *at).min().unwrap_or(Instant::NEVER);
        self.master.deadline().min(self.slaves.network.deadline()).min(late).max(self.now)
    }

    /// Sends what is due. The master must then have nothing to do before a later time: otherwise virtual time stops.
    fn exchange(&mut self) {
        self.slaves.network.poll(self.now);
        while let Some(at) = self.late.iter().position(|(at, ..)| *at <= self.now) {
            let (_, ticket, frame) = self.late.remove(at);
            self.deliver_late(ticket, &frame);
        }
        let mut frame = Vec::new();
        while let Some(ticket) = self.master.transmit(self.now, &mut frame) {
            self.check_requests(&frame);
            self.slaves.frames.push(frame.clone());
            let fate = self.fates[self.next % self.fates.len()];
            self.next += 1;
            self.pass(ticket, &frame, fate);
        }
        assert!(self.master.deadline() > self.now, "nothing to send, and nothing to wait for");
    }

    fn pass(&mut self, ticket: master::Ticket, sent: &[u8], fate: Fate) {
        if matches!(fate, Fate::LostOnItsWay) {
            return;
        }
        let mut frame = sent.to_vec();
        self.slaves.network.frame(self.now, &mut frame);
        self.slaves.network.poll(self.now);
        match fate {
            Fate::Passes => self.deliver_at_once(ticket, &frame),
            Fate::LostOnItsWay | Fate::LostOnItsWayBack => {}
            Fate::Late(ms) => self.late.push((self.now + Duration::from_millis(ms.into()), ticket, frame)),
            Fate::Doubled => {
                self.deliver_at_once(ticket, &frame);
                let mut again = sent.to_vec();
                self.slaves.network.frame(self.now, &mut again);
                self.slaves.network.poll(self.now);
                self.master.receive(self.now, ticket, &again);
            }
            Fate::Damaged(at, bits) => {
                if let Some(byte) = frame.get_mut(usize::from(at)) {
                    *byte ^= bits;
                }
                self.is_deceived = true;
                self.master.receive(self.now, ticket, &frame);
            }
        }
    }

    /// The master receives the answer immediately.
    fn deliver_at_once(&mut self, ticket: master::Ticket, frame: &[u8]) {
        for (slave, status) in statuses(frame) {
            self.refused[slave] = status.error;
        }
        self.master.receive(self.now, ticket, frame);
    }

    /// The master is free to use or ignore a late answer: it may detect by it that an error is gone.
    fn deliver_late(&mut self, ticket: master::Ticket, frame: &[u8]) {
        for (slave, status) in statuses(frame) {
            self.refused[slave] &= status.error;
        }
        self.master.receive(self.now, ticket, frame);
    }

    /// After a refusal there must be an acknowledge, or INIT.
    fn check_requests(&self, frame: &[u8]) {
        for datagram in datagrams(frame).filter(|datagram| datagram.header.offset == 0x0120) {
            if let (Command::Fpwr, Some(bits)) = (datagram.header.command, datagram.data.first_chunk()) {
                let control = AlControl::from_bits(u16::from_le_bytes(*bits));
                let slave = usize::from(datagram.header.address - 0x1001);
                let is_allowed = control.acknowledge
                    || control.state == AlState::Init
                    || !self.refused[slave]
                    || self.is_deceived;
                assert!(is_allowed, "{control:?} to a slave that shows an error");
            }
        }
    }

    /// Search, OP, SDOs, a refused state, and INIT again. Every order ends, whatever happens to it.
    fn do_everything(&mut self) {
        let request = self.master.search(self.now);
        self.complete(request);
        for state in [AlState::Op, AlState::Other(7), AlState::PreOp, AlState::Init, AlState::SafeOp] {
            let request = self.master.take_all_to(self.now, state);
            self.complete(request);
            self.check_values();
        }
    }

    /// The data read are correct, or there are none.
    fn check_values(&mut self) {
        let values: [(SdoTarget, &[u8]); 4] = [
            (SdoTarget::entry(0x1018, 1), &[0x83, 0, 0, 0]),
            (SdoTarget::entry(0x1018, 2), &[0x7C, 0x01, 0, 0]),
            (SdoTarget::entry(0x1008, 0), b"NX-ECT101"),
            (SdoTarget::entry(0x1018, 0), &[4]),
        ];
        for (target, expected) in values {
            let request = self.master.upload(self.now, 0, target);
            for (_, result) in self.complete(request) {
                if let Ok(Outcome::Data(value)) = result {
                    assert!(value.starts_with(expected), "{target:?}: {value:02X?}");
                }
            }
        }
    }
}

/// The AL status of each slave that a frame has read.
fn statuses(frame: &[u8]) -> Vec<(usize, AlStatus)> {
    let of = |datagram: wire::DatagramView<'_>| {
        let is_read = datagram.header.command == Command::Fprd && datagram.header.offset == 0x0130;
        let bits = datagram.data.first_chunk().filter(|_| is_read && datagram.working_counter > 0)?;
        let slave = usize::from(datagram.header.address - 0x1001);
        Some((slave, AlStatus::from_bits(u16::from_le_bytes(*bits))))
    };
    datagrams(frame).filter_map(of).collect()
}

fn lost_read() -> impl Strategy<Value = LostRead> {
    prop_oneof![Just(LostRead::AskAgain), Just(LostRead::ReadAgain)]
}

/// The high byte of the working counter that counts the slaves is changed: 24,578 in place of 2.
#[test]
fn no_more_slaves_are_counted_than_a_broadcast_has_passed() {
    let mut fates = vec![Fate::Passes; 1_000];
    fates[2] = Fate::Damaged(29, 0x60);
    let mut line = BadLine::new(fates, LostRead::AskAgain);
    let request = line.master.search(line.now);
    let results = line.complete(request);
    assert_eq!(results.first(), Some(&(None, Ok(Outcome::Found(2)))));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn every_order_ends_and_no_value_is_wrong(
        fates in prop::collection::vec(fate(), 1..40), lost_read in lost_read(),
    ) {
        BadLine::new(fates, lost_read).do_everything();
    }

    #[test]
    fn a_line_that_has_recovered_comes_to_op(fates in prop::collection::vec(any_fate(), 1..40)) {
        let mut line = BadLine::new(fates, LostRead::AskAgain);
        let request = line.master.search(line.now);
        line.complete(request);
        let request = line.master.take_all_to(line.now, AlState::Op);
        line.complete(request);
        line.fates = vec![Fate::Passes];
        let request = line.master.search(line.now);
        line.complete(request);
        let request = line.master.take_all_to(line.now, AlState::Op);
        let results = line.complete(request);
        prop_assert_eq!(results.len(), 2);
        for (slave, result) in results {
            prop_assert!(result.is_ok(), "slave {:?}: {:?}", slave, result);
        }
    }

    #[test]
    fn no_answer_whatever_makes_the_master_panic(
        bytes in prop::collection::vec(prop::collection::vec(any::<u8>(), 0..100), 1..20),
    ) {
        let mut line = BadLine::new(vec![Fate::Passes], LostRead::AskAgain);
        let request = line.master.search(line.now);
        line.complete(request);
        line.master.take_all_to(line.now, AlState::Op);
        line.master.upload(line.now, 0, SdoTarget::complete(0x1018, 0));
        line.master.information(line.now, 1, SdoInfoRequest::List(SdoInfoList::All));
        let (mut frame, mut answers) = (Vec::new(), bytes.iter().cycle());
        for _ in 0..200 {
            while let Some(ticket) = line.master.transmit(line.now, &mut frame) {
                // Data and working counters of the right frame have any values.
                let answer = answers.next().map_or(&[][..], Vec::as_slice);
                for (byte, any) in frame.iter_mut().skip(26).zip(answer) {
                    *byte = *any;
                }
                line.master.receive(line.now, ticket, &frame);
            }
            line.now = line.master.deadline().max(line.now);
        }
    }
}
