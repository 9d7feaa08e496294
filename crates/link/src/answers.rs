//! Frames that a slave has answered already, and that come back over the link: from another ectwin or a slave at the
//! other end, or from a loop in the network. To answer them again would never end.
//!
//! A slave sets bit 1 of the source address (reference 1.7), but so do masters with a locally administered address.
//! Their frames differ from answers by their working counters: a master sends 0.

use core::hash::{Hash, Hasher};
use std::hash::DefaultHasher;

use time::{Duration, Instant};
use wire::datagrams;

const SOURCE_ADDRESS_AT: usize = 6;
const PASSED: u8 = 0x02;
/// Answers without a working counter that are remembered.
const REMEMBERED: usize = 64;
/// How often the same frame is answered within [`SAME_FRAME_TIME`] when nothing distinguishes it from an answer: more
/// often than a master with a locally administered address sends the same frame in which no unit counts, and less often
/// than a frame goes round between two units. Neither the frame nor the kernel shows the difference: an answer of
/// another machine arrives like a frame of a master.
const SAME_FRAME_MAX: u32 = 5_000;
const SAME_FRAME_TIME: Duration = Duration::from_millis(5_000);

/// Recognizes the frames that are answers.
#[derive(Debug)]
pub(crate) struct Answers {
    /// Answers that no unit counted in, the oldest one at `next`.
    uncounted: [Option<Uncounted>; REMEMBERED],
    next: usize,
}

/// An answer whose working counters are all 0.
#[derive(Clone, Copy, Debug)]
struct Uncounted {
    fingerprint: u64,
    /// The master had sent the frame without the bit.
    is_from_unmarked: bool,
    since: Instant,
    times: u32,
}

/// Whether a slave, or a master with a locally administered address, has set the bit of the source address.
pub(crate) fn is_marked(frame: &[u8]) -> bool {
    frame.get(SOURCE_ADDRESS_AT).is_some_and(|first| first & PASSED != 0)
}

impl Answers {
    pub(crate) const fn new() -> Self {
        Self { uncounted: [None; REMEMBERED], next: 0 }
    }

    /// Whether a received frame is an answer.
    #[inline]
    pub(crate) fn has(&mut self, now: Instant, frame: &[u8]) -> bool {
        is_marked(frame) && (is_counted(frame) || self.has_uncounted(now, frame))
    }

    /// Remembers an answer that has been sent to a request that was marked or not.
    #[inline]
    pub(crate) fn remember(&mut self, now: Instant, request_was_marked: bool, answer: &[u8]) {
        if !is_counted(answer) {
            self.remember_uncounted(now, request_was_marked, answer);
        }
    }

    fn has_uncounted(&mut self, now: Instant, frame: &[u8]) -> bool {
        let fingerprint = fingerprint(frame);
        let Some(known) = self.known(fingerprint) else { return false };
        if known.is_from_unmarked {
            return true;
        }
        let is_loop = known.times >= SAME_FRAME_MAX && now.saturating_since(known.since) < SAME_FRAME_TIME;
        if known.times >= SAME_FRAME_MAX {
            (known.since, known.times) = (now, 0);
        }
        is_loop
    }

    #[cold]
    fn remember_uncounted(&mut self, now: Instant, request_was_marked: bool, answer: &[u8]) {
        let fingerprint = fingerprint(answer);
        if let Some(known) = self.known(fingerprint) {
            known.is_from_unmarked |= !request_was_marked;
            known.times += 1;
            return;
        }
        let answer = Uncounted { fingerprint, is_from_unmarked: !request_was_marked, since: now, times: 1 };
        if let Some(place) = self.uncounted.get_mut(self.next) {
            *place = Some(answer);
        }
        self.next = (self.next + 1) % REMEMBERED;
    }

    fn known(&mut self, fingerprint: u64) -> Option<&mut Uncounted> {
        self.uncounted.iter_mut().flatten().find(|answer| answer.fingerprint == fingerprint)
    }
}

fn is_counted(frame: &[u8]) -> bool {
    datagrams(frame).any(|datagram| datagram.working_counter != 0)
}

/// The same for a frame and what slaves make of it that do not count in it: they increment positions, and set the bit of
/// the source address, which every answer has.
fn fingerprint(frame: &[u8]) -> u64 {
    let mut hasher = DefaultHasher::new();
    let mut is_empty = true;
    for datagram in datagrams(frame) {
        is_empty = false;
        let header = datagram.header;
        let address = if header.command.increments_position() { 0 } else { header.address };
        (header.command.code(), header.index, address, header.offset, datagram.data).hash(&mut hasher);
    }
    let whole = if is_empty { frame } else { frame.get(..2 * SOURCE_ADDRESS_AT).unwrap_or_default() };
    whole.hash(&mut hasher);
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use wire::{Command, FrameBuilder, mark_source_address};

    use super::*;

    const START: Instant = Instant::ZERO;

    /// A frame from a universal or a locally administered address, to a station that does not exist.
    fn unmatched(first_of_address: u8, data: u8) -> Vec<u8> {
        let mut frame = FrameBuilder::new().physical(Command::Fprd, 0x1234, 0x0130, &[data, 0]).finish();
        frame[SOURCE_ADDRESS_AT] = first_of_address;
        frame
    }

    fn with_working_counter(mut frame: Vec<u8>, working_counter: u16) -> Vec<u8> {
        if let wire::FrameKind::Datagrams(layout) = wire::FrameKind::of(&frame) {
            for mut datagram in layout.datagrams(&mut frame) {
                datagram.working_counter = working_counter;
                datagram.close();
            }
        }
        frame
    }

    #[test]
    fn a_working_counter_and_the_bit_together_make_an_answer() {
        let mut answers = Answers::new();
        for (first_of_address, working_counter, is_answer) in [
            (0x00, 0, false),
            (0x00, 1, false),
            (0x10, 3, false),
            (0x02, 0, false),
            (0x02, 1, true),
            (0x12, 3, true),
        ] {
            let frame = with_working_counter(unmatched(first_of_address, 0), working_counter);
            assert_eq!(answers.has(START, &frame), is_answer, "{first_of_address:#04X} {working_counter}");
        }
    }

    #[test]
    fn an_answer_that_no_unit_counted_in_is_known_again() {
        let mut answers = Answers::new();
        let mut frame = unmatched(0x10, 0);
        assert!(!answers.has(START, &frame));
        mark_source_address(&mut frame);
        assert!(!answers.has(START, &frame), "nothing has been answered yet");
        answers.remember(START, false, &frame);
        assert!(answers.has(START, &frame));
        assert!(!answers.has(START, &unmatched(0x12, 1)), "another frame");
        assert!(!answers.has(START, &unmatched(0x10, 0)), "the master sends it again");
    }

    #[test]
    fn positions_that_slaves_increment_do_not_hide_an_answer() {
        let mut answers = Answers::new();
        let at = |position| {
            let mut frame = FrameBuilder::new().physical(Command::Aprd, position, 0x0130, &[0, 0]).finish();
            frame[SOURCE_ADDRESS_AT] = 0x12;
            frame
        };
        answers.remember(START, false, &at(6));
        assert!(answers.has(START, &at(9)));
    }

    #[test]
    fn a_master_with_a_locally_administered_address_is_answered_and_a_loop_ends() {
        let mut answers = Answers::new();
        let frame = unmatched(0x02, 0);
        let mut answered = |step: Duration| {
            (0..20_000)
                .filter(|&number| {
                    let now = START + step * number;
                    let is_answer = answers.has(now, &frame);
                    if !is_answer {
                        answers.remember(now, true, &frame);
                    }
                    !is_answer
                })
                .count()
        };
        assert_eq!(answered(Duration::from_millis(2)), 20_000, "a master");
        assert!(answered(Duration::from_micros(900)) < 20_000, "a loop");
    }

    #[test]
    fn a_burst_of_equal_frames_from_a_locally_administered_address_loses_none() {
        let mut answers = Answers::new();
        let frame = unmatched(0x02, 0);
        for number in 0..4_000 {
            let now = START + Duration::from_micros(10) * number;
            assert!(!answers.has(now, &frame), "frame {number}");
            answers.remember(now, true, &frame);
        }
    }

    #[test]
    fn other_ethercat_frames_are_known_by_all_their_bytes() {
        let mut answers = Answers::new();
        let other =
            |last| [&[0xFF; 6][..], &[0x12, 0, 0, 0, 0, 1, 0x88, 0xA4, 0, 0x40], &[last; 44]].concat();
        answers.remember(START, false, &other(1));
        assert!(answers.has(START, &other(1)));
        assert!(!answers.has(START, &other(2)));
    }
}
