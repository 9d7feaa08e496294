use std::thread;

use super::*;
use crate::memory;

/// Sets the highest bit of passing data, destroys frames that start with 0, counts those that start with 7,
/// polls every millisecond.
#[derive(Default)]
struct Marker {
    next: Instant,
    polls: u64,
    overlong: u64,
}

impl Responder for Marker {
    fn frame(&mut self, _now: Instant, frame: &mut [u8]) -> FrameFate {
        match frame.first_mut() {
            None | Some(0) => FrameFate::Destroyed,
            Some(first) => {
                self.overlong += u64::from(*first == 7);
                *first |= 0x80;
                FrameFate::Returned
            }
        }
    }

    fn poll(&mut self, now: Instant) {
        self.polls += 1;
        self.next = now + Duration::from_millis(1);
    }

    fn deadline(&self) -> Instant {
        self.next
    }

    fn overlong_frames(&self) -> u64 {
        self.overlong
    }
}

#[derive(Default)]
struct Notes(Vec<(Vec<u8>, Option<Vec<u8>>)>);

impl Observer for Notes {
    fn frame(&mut self, seen: Seen<'_>) {
        assert!(seen.answered >= seen.received);
        self.0.push((seen.request.to_vec(), seen.answer.map(<[u8]>::to_vec)));
    }
}

/// A master sends `frames`, receives `answers` of them and closes the link.
fn run_against(frames: &[&[u8]], answers: usize, observer: Option<&mut dyn Observer>) -> Statistics {
    let (mut master, mut unit) = memory::pair();
    thread::scope(|scope| {
        scope.spawn(move || {
            frames.iter().for_each(|frame| master.send(frame).unwrap());
            for _ in 0..answers {
                master.receive(&mut [0; 64], Duration::from_secs(10)).unwrap().unwrap();
            }
        });
        run(&mut unit, &mut Marker::default(), observer, &Clock::start(), &AtomicBool::new(false)).unwrap()
    })
}

#[test]
fn frames_are_answered_and_destroyed_ones_are_counted() {
    let statistics = run_against(&[&[1, 2], &[0, 9], &[3]], 2, None);
    assert_eq!((statistics.frames, statistics.destroyed, statistics.unsent), (3, 1, 0));
}

#[test]
fn overlong_frames_are_counted() {
    assert_eq!(run_against(&[&[1], &[7], &[2], &[7]], 4, None).overlong, 2);
}

#[test]
fn an_observer_sees_the_request_as_it_came_and_the_answer_as_it_went() {
    let mut notes = Notes::default();
    run_against(&[&[1, 2], &[0, 9]], 1, Some(&mut notes));
    assert_eq!(notes.0, [(vec![1, 2], Some(vec![0x81, 2])), (vec![0, 9], None)]);
}

#[test]
fn a_closed_link_ends_the_run() {
    assert_eq!(run_against(&[], 0, None).frames, 0);
}

#[test]
fn the_stop_flag_ends_the_run() {
    let (_master, mut unit) = memory::pair();
    let statistics =
        run(&mut unit, &mut Marker::default(), None, &Clock::start(), &AtomicBool::new(true)).unwrap();
    assert_eq!(statistics, Statistics::default());
}

/// Stops the run at its own deadline, without a single frame.
struct Countdown<'a> {
    stop: &'a AtomicBool,
    left: u32,
    due: Instant,
}

impl Responder for Countdown<'_> {
    fn frame(&mut self, _now: Instant, _frame: &mut [u8]) -> FrameFate {
        FrameFate::Returned
    }

    fn poll(&mut self, now: Instant) {
        assert!(now >= self.due);
        self.left -= 1;
        self.due = now + Duration::from_millis(2);
        self.stop.store(self.left == 0, Ordering::Relaxed);
    }

    fn deadline(&self) -> Instant {
        self.due
    }
}

#[test]
fn what_is_due_happens_at_its_deadline_without_frames() {
    let (_master, mut unit) = memory::pair();
    let (clock, stop) = (Clock::start(), AtomicBool::new(false));
    let mut countdown = Countdown { stop: &stop, left: 5, due: Instant::ZERO };
    run(&mut unit, &mut countdown, None, &clock, &stop).unwrap();
    assert_eq!(countdown.left, 0);
    assert!(clock.now() >= Instant::ZERO + Duration::from_millis(8));
}

/// A port whose cable is pulled and plugged in again while it receives frames.
struct Flaky {
    frames: Vec<(bool, u8)>,
    carrier: bool,
}

impl FramePort for Flaky {
    fn receive(&mut self, buffer: &mut [u8], _wait: Duration) -> io::Result<Option<usize>> {
        let (carrier, byte) = self.frames.pop().ok_or(io::ErrorKind::UnexpectedEof)?;
        self.carrier = carrier;
        buffer[0] = byte;
        Ok(Some(1))
    }

    fn send(&mut self, _frame: &[u8]) -> io::Result<()> {
        Ok(())
    }

    fn carrier(&self) -> bool {
        self.carrier
    }

    fn dropped(&self) -> u64 {
        3
    }
}

/// The events, in order.
#[derive(Default)]
struct Diary(Vec<String>);

impl Responder for Diary {
    fn frame(&mut self, _now: Instant, frame: &mut [u8]) -> FrameFate {
        self.0.push(format!("frame {}", frame[0]));
        FrameFate::Returned
    }

    fn poll(&mut self, _now: Instant) {}

    fn deadline(&self) -> Instant {
        Instant::NEVER
    }

    fn carrier(&mut self, _now: Instant, present: bool) {
        self.0.push(format!("carrier {present}"));
    }
}

#[test]
fn the_responder_hears_of_the_carrier_before_the_frame_that_came_with_it() {
    let frames = vec![(true, 4), (true, 3), (false, 2), (true, 1)];
    let mut port = Flaky { frames, carrier: true };
    let mut diary = Diary::default();
    let statistics = run(&mut port, &mut diary, None, &Clock::start(), &AtomicBool::new(false)).unwrap();
    assert_eq!(diary.0, ["frame 1", "carrier false", "frame 2", "carrier true", "frame 3", "frame 4"]);
    assert_eq!(statistics.dropped, 3);
}

/// Does with a frame what slaves do, and ends its run when nothing has come for 20 ms or far too much has.
struct Slaves<'a> {
    counts: u16,
    frames: u32,
    silence: u32,
    due: Instant,
    stop: &'a AtomicBool,
}

impl Responder for Slaves<'_> {
    fn frame(&mut self, _now: Instant, frame: &mut [u8]) -> FrameFate {
        (self.frames, self.silence) = (self.frames + 1, 0);
        if let wire::FrameKind::Datagrams(layout) = wire::FrameKind::of(frame) {
            for mut datagram in layout.datagrams(frame) {
                datagram.working_counter += self.counts;
                datagram.header.address += u16::from(datagram.header.command.increments_position());
                datagram.close();
            }
        }
        wire::mark_source_address(frame);
        FrameFate::Returned
    }

    fn poll(&mut self, now: Instant) {
        if now >= self.due {
            self.due = now + Duration::from_millis(1);
            self.silence += 1;
        }
        self.stop.store(self.silence > 20 || self.frames > 20_000, Ordering::Relaxed);
    }

    fn deadline(&self) -> Instant {
        self.due
    }
}

/// How many frames slaves at both ends of a link answer, after one end has sent this one.
fn answered_at_both_ends(frame: &[u8], counts: u16) -> [u32; 2] {
    let (mut one, other) = memory::pair();
    one.send(frame).unwrap();
    let answered = |mut port| {
        let stop = AtomicBool::new(false);
        let mut slaves = Slaves { counts, frames: 0, silence: 0, due: Instant::ZERO, stop: &stop };
        run(&mut port, &mut slaves, None, &Clock::start(), &stop).unwrap();
        slaves.frames
    };
    thread::scope(|scope| {
        let other = scope.spawn(move || answered(other));
        [answered(one), other.join().unwrap()]
    })
}

#[test]
fn an_answer_is_answered_by_no_other_slave() {
    let from = |first_of_address: u8, mut frame: Vec<u8>| {
        frame[6] = first_of_address;
        frame
    };
    let build = wire::FrameBuilder::new;
    let broadcast = build().physical(wire::Command::Brd, 0, 0x0130, &[0, 0]).finish();
    let position = build().physical(wire::Command::Aprd, 9, 0x0130, &[0, 0]).finish();
    let other_type = [&[0xFF; 6][..], &[0x10, 0, 0, 0, 0, 1, 0x88, 0xA4, 0, 0x40], &[0; 44]].concat();
    for (frame, counts, most) in [
        (from(0x10, broadcast.clone()), 1, 1),
        (from(0x12, broadcast.clone()), 3, 1),
        (from(0x10, broadcast.clone()), 0, 2),
        (from(0x10, position.clone()), 0, 2),
        (other_type, 0, 2),
        // Nothing distinguishes it from a request, except how often it comes.
        (from(0x12, position), 0, 12_000),
    ] {
        let [one, other] = answered_at_both_ends(&frame, counts);
        assert!(other >= 1 && one + other <= most, "{one} and {other} answers to {frame:02X?}");
    }
}
