//! A recorded master: the frames of a capture are sent again at their times, and the answers are compared.
//!
//! Differences that are unavoidable between two runs of the same master are ignored: the time at which a state
//! or a mailbox changes, times of distributed clocks, error counters, and process data, which depend on the
//! phase of the CPU Unit. Working counters are always compared.

mod areas;
mod differences;
mod refusal;

use std::collections::{BTreeSet, HashMap};

use capture::{Direction, Packet, packets};
use esi::DeviceDescription;
use time::{Duration, Instant};
use wire::{Command, Returned, returned_datagrams};

use areas::Mailboxes;
use differences::Differences;

pub use differences::{Aspect, DifferenceKind};

pub use refusal::NotReplayable;

/// From power-on to the first frame, so that the unit has started.
const LEAD: Duration = Duration::from_millis(10);
/// Bit of a source address that every ESC sets: the frame has passed the units.
const PASSED: u8 = 0x02;
/// Position of the first byte of the source address.
const SOURCE_ADDRESS: usize = 6;

/// The longest pause between two frames of a master: a replay runs through it period by period.
const SILENCE_MAX: Duration = Duration::from_secs(3_600);
/// The longest time from the first frame to the last.
const DURATION_MAX: Duration = Duration::from_secs(24 * 3_600);

/// The frames of a capture, ready to be sent.
#[derive(Clone, Debug, Default)]
pub struct RecordedFrames {
    exchanges: Vec<Exchange>,
}

#[derive(Clone, Debug)]
struct Exchange {
    after: Duration,
    frame: Vec<u8>,
    answer: Option<Vec<u8>>,
}

impl RecordedFrames {
    /// Reads a capture: frames of a master and their answers.
    ///
    /// # Errors
    /// [`NotReplayable`].
    pub fn read(bytes: &[u8]) -> Result<Self, NotReplayable> {
        let mut exchanges: Vec<Exchange> = Vec::new();
        // For each sequence of datagrams: the frames without an answer yet, the oldest first.
        let mut unanswered: HashMap<Names, Vec<usize>> = HashMap::new();
        let mut origin = None;
        for packet in packets(bytes)? {
            let packet = packet?;
            let datagrams = returned_datagrams(&packet.frame);
            if datagrams.is_empty() {
                continue;
            }
            if is_answer(&packet) {
                // The newest: numbers repeat, and an older frame may have been lost.
                let asked = unanswered.get_mut(&names(&datagrams)).and_then(Vec::pop);
                if let Some(exchange) = asked.and_then(|asked| exchanges.get_mut(asked)) {
                    exchange.answer = Some(packet.frame);
                }
            } else {
                let origin = *origin.get_or_insert(packet.at_nanos);
                let before = exchanges.last().map_or(Duration::ZERO, |exchange| exchange.after);
                let after = Duration::from_nanos(packet.at_nanos.saturating_sub(origin)).max(before);
                refuse_long(exchanges.len() + 1, before, after)?;
                unanswered.entry(names(&datagrams)).or_default().push(exchanges.len());
                exchanges.push(Exchange { after, frame: packet.frame, answer: None });
            }
        }
        Ok(Self { exchanges })
    }

    /// Number of frames of a master in it.
    #[must_use]
    pub fn len(&self) -> usize {
        self.exchanges.len()
    }

    /// Whether it has none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.exchanges.is_empty()
    }

    /// Number of them that have returned.
    #[must_use]
    pub fn answers(&self) -> usize {
        self.exchanges.iter().filter(|exchange| exchange.answer.is_some()).count()
    }

    /// Number of units of the longest line: each adds 1 to the address of a datagram that passes by position.
    #[must_use]
    pub fn units(&self) -> usize {
        let answered = self.exchanges.iter().filter_map(|exchange| {
            let answer = exchange.answer.as_deref()?;
            Some((returned_datagrams(&exchange.frame), returned_datagrams(answer)))
        });
        let pairs = answered.flat_map(|(asked, answered)| asked.into_iter().zip(answered));
        let by_position =
            pairs.filter(|(asked, _)| matches!(asked.header.command, Command::Aprd | Command::Brd));
        let passed = by_position.map(|(asked, seen)| seen.header.address.wrapping_sub(asked.header.address));
        usize::from(passed.max().unwrap_or(0))
    }

    /// From the first frame to the last.
    #[must_use]
    pub fn duration(&self) -> Duration {
        self.exchanges.last().map_or(Duration::ZERO, |exchange| exchange.after)
    }
}

/// By the direction in the capture, else by the mark of ESCs.
fn is_answer(packet: &Packet) -> bool {
    match packet.direction {
        Some(direction) => direction == Direction::Outbound,
        None => packet.frame.get(SOURCE_ADDRESS).is_some_and(|byte| byte & PASSED != 0),
    }
}

/// Commands and numbers of the datagrams of a frame: an answer has those of its request.
type Names = Vec<(Command, u8)>;

fn names(datagrams: &[Returned]) -> Names {
    datagrams.iter().map(|datagram| (datagram.header.command, datagram.header.index)).collect()
}

/// A clock that was set during the capture must not cause a replay of years.
fn refuse_long(frame: usize, before: Duration, after: Duration) -> Result<(), NotReplayable> {
    let silence = Duration::from_nanos(after.as_nanos() - before.as_nanos());
    if silence > SILENCE_MAX {
        return Err(NotReplayable::Silence { frame, silence });
    }
    if after > DURATION_MAX {
        return Err(NotReplayable::TooLong { frame });
    }
    Ok(())
}

/// The recorded master at work.
#[derive(Debug, Default)]
pub(crate) struct Recorded {
    frames: RecordedFrames,
    sent: usize,
    answered: usize,
    /// Numbers of frames that are in flight, or lost, and were answered in the capture.
    missing: BTreeSet<usize>,
    differences: Differences,
}

impl Recorded {
    pub(crate) fn new<'a>(
        frames: RecordedFrames,
        devices: impl Iterator<Item = &'a DeviceDescription>,
    ) -> Self {
        let differences = Differences::none(Mailboxes::of(devices));
        Self { frames, sent: 0, answered: 0, missing: BTreeSet::new(), differences }
    }

    pub(crate) fn deadline(&self) -> Instant {
        let next = self.frames.exchanges.get(self.sent);
        next.map_or(Instant::NEVER, |exchange| Instant::ZERO + LEAD + exchange.after)
    }

    /// The next frame that is due, with its number.
    pub(crate) fn send(&mut self, now: Instant) -> Option<(usize, Vec<u8>)> {
        if self.deadline() > now {
            return None;
        }
        let number = self.sent;
        self.sent += 1;
        let exchange = self.frames.exchanges.get(number)?;
        if exchange.answer.is_some() {
            self.missing.insert(number);
        }
        Some((number, exchange.frame.clone()))
    }

    /// An answer returns.
    pub(crate) fn receive(&mut self, number: usize, frame: &[u8]) {
        self.answered += 1;
        self.missing.remove(&number);
        let Some(captured) = self.frames.exchanges.get(number).and_then(|exchange| exchange.answer.as_ref())
        else {
            return;
        };
        self.differences.compare(number, &returned_datagrams(frame), &returned_datagrams(captured));
    }

    pub(crate) fn is_done(&self) -> bool {
        self.sent == self.frames.len()
    }

    pub(crate) fn progress(&self) -> String {
        format!("{} of {} frames are sent, {} came back", self.sent, self.frames.len(), self.answered)
    }

    /// The first of them as text: answers that differ, then answers that are missing.
    pub(crate) fn differences(&self) -> Vec<String> {
        self.all_differences().described().to_vec()
    }

    pub(crate) fn difference_count(&self) -> u64 {
        self.differences.count() + self.missing.len() as u64
    }

    /// All of them by kind, the most frequent first.
    pub(crate) fn difference_kinds(&self) -> Vec<DifferenceKind> {
        self.all_differences().kinds()
    }

    fn all_differences(&self) -> Differences {
        self.differences.clone().with_missing(self.missing.iter().copied())
    }
}
