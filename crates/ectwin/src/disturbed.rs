//! The frames of a line in place, as a link has them, with the faults of the line; and answers that come without a frame.

use std::collections::VecDeque;

use device::Network;
use link::FrameFate;
use plant::line::{ActiveFault, KEPT_FRAMES_MAX, LineEnds, LineFaults, LineOrder, LineRefusal, Met};
use time::Instant;
use unit_model::ModelUnit;

pub(crate) type Units = Network<Box<dyn ModelUnit>>;

/// The seed of the random faults, if nobody sets another one.
const SEED: u64 = 1;

/// The faults of a line, and the answers that nobody has taken yet.
#[derive(Debug)]
pub(crate) struct Disturbed {
    faults: LineFaults<()>,
    answers: Answers,
}

/// Answers that come without a frame: late ones and second ones.
#[derive(Debug, Default)]
struct Answers {
    waiting: VecDeque<Vec<u8>>,
    /// Those that had no room, because nobody takes them.
    lost: u64,
}

impl LineEnds<()> for Answers {
    fn returns(&mut self, _: Instant, (): (), answer: Vec<u8>, _: &[Met]) {
        if self.waiting.len() < KEPT_FRAMES_MAX {
            self.waiting.push_back(answer);
        } else {
            self.lost += 1;
        }
    }
}

impl Disturbed {
    /// No faults.
    pub(crate) fn new() -> Self {
        Self { faults: LineFaults::new(SEED), answers: Answers::default() }
    }

    /// The random faults begin with this seed; all faults and frames that wait are gone.
    pub(crate) fn start_again(&mut self, seed: u64) {
        self.faults.start_again(seed);
        self.answers = Answers::default();
    }

    pub(crate) fn order(
        &mut self,
        now: Instant,
        order: &LineOrder,
        units: &mut Units,
    ) -> Result<(), LineRefusal> {
        self.faults.order(now, order, units)
    }

    pub(crate) fn active(&self, now: Instant) -> impl Iterator<Item = ActiveFault<'_>> {
        self.faults.active(now)
    }

    /// Frames and answers that were lost because too many waited.
    pub(crate) const fn lost_for_room(&self) -> u64 {
        self.faults.lost_for_room() + self.answers.lost
    }

    /// Whether no frame can meet a fault.
    #[inline]
    pub(crate) const fn is_quiet(&self) -> bool {
        self.faults.is_quiet()
    }

    #[inline]
    pub(crate) fn deadline(&self) -> Instant {
        self.faults.deadline()
    }

    /// A frame passes in place. If its first answer comes at once and has its length, it replaces the frame.
    #[cold]
    pub(crate) fn frame(&mut self, now: Instant, frame: &mut [u8], units: &mut Units) -> FrameFate {
        let met = self.faults.meet(now, frame, units);
        if met.is_empty() {
            let fate = units.frame(now, frame);
            self.faults.has_passed(now);
            return fate;
        }
        let before = self.answers.waiting.len();
        self.faults.send(now, (), frame.to_vec(), met, units, &mut self.answers);
        let first = self.answers.waiting.get(before);
        if first.is_none_or(|answer| answer.len() != frame.len()) {
            return FrameFate::Destroyed;
        }
        if let Some(answer) = self.answers.waiting.remove(before) {
            frame.copy_from_slice(&answer);
        }
        FrameFate::Returned
    }

    /// Passes on the frames that have waited long enough.
    #[cold]
    pub(crate) fn poll(&mut self, now: Instant, units: &mut Units) {
        self.faults.poll(now, units, &mut self.answers);
    }

    /// Takes the next answer that comes without a frame.
    #[inline]
    pub(crate) fn take_answer(&mut self) -> Option<Vec<u8>> {
        self.answers.waiting.pop_front()
    }
}
