//! The runner of dialogues: when the next access is sent, which answer belongs to it, and when a dialogue has waited for
//! too long.

use esi::Timeouts;
use time::Instant;

use crate::access::{Answer, Dialogue, Progress};
use crate::habits::{Habits, TimeOuts};

/// Runs dialogues one after the other: those of one slave, or those of a master that has one access at a time. It has no
/// clock, and does not own the dialogues: the caller passes the present one, sends its access when that is due, and
/// passes its answer, or that it is lost.
///
/// ```
/// use master::{Answer, Habits, Pace, Progress, RegisterRead, Runner};
/// use time::Instant;
///
/// let habits = Habits::default();
/// let pace = Pace::new(Instant::ZERO, &habits);
/// let (mut runner, mut read) = (Runner::new(), RegisterRead::new(0x0130, 2));
/// runner.begin(&read, &pace);
/// assert!(runner.is_due(pace.now));
/// let number = runner.depart();
/// assert!(!runner.is_due(pace.now), "it waits for the answer");
/// let answer = Answer { working_counter: 1, data: &[0x02, 0x00] };
/// assert_eq!(runner.answer(number, &mut read, Some(answer), &pace), Some(Progress::Done));
/// assert_eq!(runner.answer(number, &mut read, Some(answer), &pace), None, "a second answer is ignored");
/// ```
#[derive(Debug)]
pub struct Runner {
    /// The next access is sent at this time.
    at: Instant,
    /// The dialogue is given up at this time.
    until: Instant,
    /// The number of the access whose answer is awaited.
    on_its_way: Option<u32>,
    /// Number of accesses sent so far.
    departed: u32,
}

/// The present time and the settings that determine when a dialogue continues.
#[derive(Clone, Copy, Debug)]
pub struct Pace<'a> {
    /// The present time.
    pub now: Instant,
    /// Poll period and time-outs.
    pub habits: &'a Habits,
    /// The time-outs of the slave for states and mailbox.
    pub timeouts: &'a Timeouts,
}

impl<'a> Pace<'a> {
    /// With the usual time-outs of slaves.
    #[must_use]
    pub const fn new(now: Instant, habits: &'a Habits) -> Self {
        Self { now, habits, timeouts: &Timeouts::USUAL }
    }
}

impl Runner {
    /// A runner without a dialogue.
    #[must_use]
    pub const fn new() -> Self {
        Self { at: Instant::NEVER, until: Instant::NEVER, on_its_way: None, departed: 0 }
    }

    /// A dialogue begins: its first access is due now. The answer to an access of the one before is ignored from now on.
    pub fn begin(&mut self, dialogue: &dyn Dialogue, pace: &Pace<'_>) {
        self.on_its_way = None;
        self.at = pace.now;
        self.restart_time_out(dialogue, pace);
    }

    /// There is no dialogue any more.
    pub const fn rest(&mut self) {
        self.on_its_way = None;
        self.at = Instant::NEVER;
    }

    fn restart_time_out(&mut self, dialogue: &dyn Dialogue, pace: &Pace<'_>) {
        self.until = pace.now + pace.habits.patience(dialogue.patience(), pace.timeouts);
    }

    /// The time at which the next access is sent; never while an answer is awaited.
    #[must_use]
    pub const fn deadline(&self) -> Instant {
        if self.on_its_way.is_some() { Instant::NEVER } else { self.at }
    }

    /// Whether the next access is due.
    #[must_use]
    pub fn is_due(&self, now: Instant) -> bool {
        self.deadline() <= now
    }

    /// Whether the dialogue has waited for too long. It is given up in place of its next access, so that an answer
    /// that is awaited still counts.
    #[must_use]
    pub fn is_too_late(&self, now: Instant) -> bool {
        self.is_due(now) && self.until <= now
    }

    /// The next access is sent; returns its number.
    pub const fn depart(&mut self) -> u32 {
        self.departed = self.departed.wrapping_add(1);
        self.on_its_way = Some(self.departed);
        self.departed
    }

    /// The dialogue processes the answer to the access with this number; none: it is lost, and the access that the
    /// dialogue then has is due now. Returns how the dialogue continues; none if no answer to this number is awaited.
    pub fn answer(
        &mut self,
        number: u32,
        dialogue: &mut dyn Dialogue,
        answer: Option<Answer<'_>>,
        pace: &Pace<'_>,
    ) -> Option<Progress> {
        self.on_its_way.take_if(|awaited| *awaited == number)?;
        self.at = pace.now;
        let progress = dialogue.answer(answer);
        match (progress, pace.habits.time_outs) {
            (Progress::Later, _) => self.at = pace.now + pace.habits.poll_period,
            (Progress::NextStage, TimeOuts::EachStage { .. }) => self.restart_time_out(dialogue, pace),
            (Progress::NextStage, TimeOuts::WholeDialogue { .. }) | (Progress::Next | Progress::Done, _) => {}
        }
        Some(progress)
    }
}

impl Default for Runner {
    fn default() -> Self {
        Self::new()
    }
}
