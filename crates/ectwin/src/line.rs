//! Cables and faults of frames of a line, in virtual time and on a real link.

use plant::line::{ActiveFault, Disturbance, FaultName, LineOrder, LineRefusal};
use scenario::words::Spoken;
use time::Instant;

use crate::Twin;
use crate::runtime::Handle;

/// A fault of frames at work.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FaultAtWork {
    /// The fault, with its name if it has one.
    pub disturbance: Disturbance,
    /// Its sentence, as in a scenario.
    pub sentence: String,
    /// When it ends by itself, from power-on; [`Instant::NEVER`]: not by the time.
    pub until: Instant,
    /// Frames of its kind since it began.
    pub frames_seen: u64,
    /// Those that have met it.
    pub frames_met: u64,
}

impl From<ActiveFault<'_>> for FaultAtWork {
    fn from(active: ActiveFault<'_>) -> Self {
        let ActiveFault { number: _, disturbance, until, frames_seen, frames_met } = active;
        let disturbance = disturbance.clone();
        let sentence = LineOrder::Disturb(disturbance.clone()).sentence();
        Self { disturbance, sentence, until, frames_seen, frames_met }
    }
}

/// The line: cables, and faults of frames.
impl Twin {
    /// Carries out an order on the line: a cable, a fault of frames, the end of one or of all.
    ///
    /// # Errors
    /// [`LineRefusal`]; then nothing has changed.
    pub fn line_order(&mut self, order: &LineOrder) -> Result<(), LineRefusal> {
        let now = self.now();
        self.line_mut().order(now, order)
    }

    /// Frames get a fault from now on. [`Twin::frame`] returns [`crate::FrameFate::Destroyed`] for a frame that is lost or
    /// late; [`Twin::take_late_answer`] has the answers that come later.
    ///
    /// # Errors
    /// [`LineRefusal`]; then nothing has changed.
    pub fn disturb(&mut self, disturbance: Disturbance) -> Result<(), LineRefusal> {
        self.line_order(&LineOrder::Disturb(disturbance))
    }

    /// The fault with this name ends.
    ///
    /// # Errors
    /// [`LineRefusal::NoFault`].
    pub fn end_fault(&mut self, name: &FaultName) -> Result<(), LineRefusal> {
        self.line_order(&LineOrder::End { name: name.clone() })
    }

    /// All faults of frames end; frames that are delayed still come.
    pub fn be_quiet(&mut self) {
        // This order is always possible.
        let _ = self.line_order(&LineOrder::BeQuiet);
    }

    /// The faults at work, in the order in which they began.
    #[must_use]
    pub fn faults(&mut self) -> Vec<FaultAtWork> {
        let now = self.now();
        self.line_mut().faults(now).map(FaultAtWork::from).collect()
    }

    /// Random faults begin with this seed, 1 without it. Faults and frames that wait are gone.
    pub fn seed_faults(&mut self, seed: u64) {
        let now = self.now();
        self.line_mut().seed_faults(now, seed);
    }

    /// Number of frames and answers that the faults of the line lost because too many waited: more than 4,096.
    #[must_use]
    pub fn frames_lost_for_room(&mut self) -> u64 {
        self.line_mut().disturbed().lost_for_room()
    }
}

/// The line: cables, and faults of frames. Frames wait while one of these is called.
impl Handle {
    /// Carries out an order on the line: a cable, a fault of frames, the end of one or of all.
    ///
    /// # Errors
    /// [`LineRefusal`]; then nothing has changed.
    pub fn line_order(&self, order: &LineOrder) -> Result<(), LineRefusal> {
        self.look_at_line(|line, now| line.order(now, order))
    }

    /// Frames get a fault from now on: they are lost, answered late, twice or wrongly.
    ///
    /// # Errors
    /// [`LineRefusal`]; then nothing has changed.
    pub fn disturb(&self, disturbance: Disturbance) -> Result<(), LineRefusal> {
        self.line_order(&LineOrder::Disturb(disturbance))
    }

    /// The fault with this name ends.
    ///
    /// # Errors
    /// [`LineRefusal::NoFault`].
    pub fn end_fault(&self, name: &FaultName) -> Result<(), LineRefusal> {
        self.line_order(&LineOrder::End { name: name.clone() })
    }

    /// All faults of frames end; frames that are delayed still come.
    pub fn be_quiet(&self) {
        // This order is always possible.
        let _ = self.line_order(&LineOrder::BeQuiet);
    }

    /// The faults at work, in the order in which they began.
    #[must_use]
    pub fn faults(&self) -> Vec<FaultAtWork> {
        self.look_at_line(|line, now| line.faults(now).map(FaultAtWork::from).collect())
    }

    /// Random faults begin with this seed, 1 without it. Faults and frames that wait are gone.
    pub fn seed_faults(&self, seed: u64) {
        self.look_at_line(|line, now| line.seed_faults(now, seed));
    }

    /// Number of frames and answers that the faults of the line lost because too many waited: more than 4,096.
    #[must_use]
    pub fn frames_lost_for_room(&self) -> u64 {
        self.look_at_line(|line, _| line.disturbed().lost_for_room())
    }
}
