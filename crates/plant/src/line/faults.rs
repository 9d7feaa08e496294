//! The faults of a line at work: which frames meet them, and what happens to those.

use core::fmt;

use device::{Network, Unit};
use time::Instant;

use super::ends::LineEnds;
use super::kept::{Flight, Kept, Stage};
use super::met::Met;
use super::numbers::WhichUnit;
use super::order::{Disturbance, FaultName, FrameFault, LineOrder};
use super::passing::Passing;
use crate::dice::Dice;

/// The faults of the frames between a master and its units, without I/O and without a clock. `T` is what a master knows a
/// frame by.
///
/// The line is free of faults at first, and then it costs a frame one comparison. A frame is passed on by
/// [`LineFaults::send`]; frames that wait are passed on by [`LineFaults::poll`] when [`LineFaults::deadline`] is reached.
/// The same seed, frames and times give the same faults.
#[derive(Clone, Debug)]
pub struct LineFaults<T> {
    dice: Dice,
    active: Vec<Active>,
    /// Number of faults so far.
    numbered: u32,
    kept: Kept<T>,
    /// Frames that were lost because too many wait.
    lost_for_room: u64,
}

/// A fault at work.
#[derive(Clone, Debug)]
struct Active {
    number: u32,
    disturbance: Disturbance,
    until: Instant,
    /// Frames of its kind so far.
    seen: u64,
    /// Those that met it.
    met: u64,
}

/// A fault at work, and the number of frames that it has met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ActiveFault<'a> {
    /// Its number: the first fault of the line has 1.
    pub number: u32,
    /// The fault.
    pub disturbance: &'a Disturbance,
    /// When it ends by itself; [`Instant::NEVER`]: not by the time.
    pub until: Instant,
    /// Frames of its kind since it began.
    pub frames_seen: u64,
    /// Those that have met it.
    pub frames_met: u64,
}

/// Why an order cannot be carried out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LineRefusal {
    /// The cable or the unit does not exist; the line has this number of units.
    NotThere(usize),
    /// A fault of this name is at work.
    NameInUse(FaultName),
    /// No fault of this name is at work.
    NoFault(FaultName),
    /// The fault would never meet a frame, or its values are impossible.
    WithoutEffect,
}

impl fmt::Display for LineRefusal {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotThere(units) => {
                let ending = if *units == 1 { "" } else { "s" };
                write!(formatter, "this unit or cable does not exist: the line has {units} unit{ending}")
            }
            Self::NameInUse(name) => write!(formatter, "a fault called {name} is at work already"),
            Self::NoFault(name) => write!(formatter, "no fault called {name} is at work"),
            Self::WithoutEffect => formatter.write_str("no frame can meet this fault"),
        }
    }
}

impl core::error::Error for LineRefusal {}

impl<T: Copy> LineFaults<T> {
    /// No faults; the seed decides which frames random faults meet.
    #[must_use]
    pub const fn new(seed: u64) -> Self {
        Self { dice: Dice::new(seed), active: Vec::new(), numbered: 0, kept: Kept::new(), lost_for_room: 0 }
    }

    /// The random faults begin with this seed; all faults and frames that wait are gone. The numbers of faults go on, so
    /// that each is used once.
    pub fn start_again(&mut self, seed: u64) {
        *self = Self { numbered: self.numbered, ..Self::new(seed) };
    }

    /// Carries out an order on this line.
    ///
    /// # Errors
    /// [`LineRefusal`]; then nothing has changed.
    pub fn order<U: Unit>(
        &mut self,
        now: Instant,
        order: &LineOrder,
        units: &mut Network<U>,
    ) -> Result<(), LineRefusal> {
        let exists = |position: usize| {
            if position < units.len() { Ok(()) } else { Err(LineRefusal::NotThere(units.len())) }
        };
        match order {
            LineOrder::Unplug { cable } => {
                exists(cable.position()).map(|()| units.set_cable(cable.position(), false))
            }
            LineOrder::Plug { cable } => {
                exists(cable.position()).map(|()| units.set_cable(cable.position(), true))
            }
            LineOrder::Disturb(disturbance) => {
                let unit = disturbance.frames.unit.as_ref().map(WhichUnit::position);
                let cable = disturbance.cable().map(|cable| cable.position());
                unit.into_iter().chain(cable).try_for_each(exists)?;
                self.disturb(now, disturbance.clone())
            }
            LineOrder::End { name } => self.end(now, name),
            LineOrder::BeQuiet => {
                self.be_quiet(now);
                Ok(())
            }
        }
    }

    /// Frames get a fault from now on.
    ///
    /// # Errors
    /// [`LineRefusal::NameInUse`], [`LineRefusal::WithoutEffect`].
    pub fn disturb(&mut self, now: Instant, disturbance: Disturbance) -> Result<(), LineRefusal> {
        if !disturbance.is_possible() {
            return Err(LineRefusal::WithoutEffect);
        }
        if let Some(name) = disturbance.name.as_ref().filter(|name| self.find(now, name).is_some()) {
            return Err(LineRefusal::NameInUse(name.clone()));
        }
        let until = disturbance.lasts.map_or(Instant::NEVER, |time| now + time);
        self.numbered = self.numbered.saturating_add(1);
        self.active.push(Active { number: self.numbered, disturbance, until, seen: 0, met: 0 });
        Ok(())
    }

    /// The fault with this name ends. Frames that wait because of it still come.
    ///
    /// # Errors
    /// [`LineRefusal::NoFault`].
    pub fn end(&mut self, now: Instant, name: &FaultName) -> Result<(), LineRefusal> {
        let at = self.find(now, name).ok_or_else(|| LineRefusal::NoFault(name.clone()))?;
        self.active.remove(at);
        self.pair_up_without_swaps(now);
        Ok(())
    }

    /// All faults end. Frames that are delayed still come.
    pub fn be_quiet(&mut self, now: Instant) {
        self.active.clear();
        self.pair_up_without_swaps(now);
    }

    /// Frames that wait for the next one come at once if no fault makes frames change places any more.
    fn pair_up_without_swaps(&mut self, now: Instant) {
        if !self.active.iter().any(|active| active.disturbance.fault == FrameFault::Swap) {
            self.kept.next_has_passed(now, self.kept.waiting_for_next());
        }
    }

    fn find(&self, now: Instant, name: &FaultName) -> Option<usize> {
        self.active
            .iter()
            .position(|active| active.is_at_work(now) && active.disturbance.name.as_ref() == Some(name))
    }

    /// The number of the fault that began last; 0: none has begun.
    #[must_use]
    pub const fn last_number(&self) -> u32 {
        self.numbered
    }

    /// The faults at work, in the order in which they began.
    pub fn active(&self, now: Instant) -> impl Iterator<Item = ActiveFault<'_>> {
        self.active.iter().filter(move |active| active.is_at_work(now)).map(Active::view)
    }

    /// Number of frames and answers that wait.
    #[must_use]
    pub fn waiting(&self) -> usize {
        self.kept.len()
    }

    /// Number of frames and answers so far that were lost because too many of them waited: at most
    /// [`super::KEPT_FRAMES_MAX`] frames and [`super::KEPT_BYTES_MAX`] bytes wait.
    #[must_use]
    pub const fn lost_for_room(&self) -> u64 {
        self.lost_for_room
    }

    /// Whether a frame that is sent now can neither meet a fault nor be the next one for one that waits.
    #[inline]
    #[must_use]
    pub const fn is_quiet(&self) -> bool {
        self.active.is_empty() && !self.kept.waits_for_next()
    }

    /// When the next frame that waits is due.
    #[inline]
    #[must_use]
    pub fn deadline(&self) -> Instant {
        self.kept.deadline()
    }

    /// The faults that a frame meets which is sent now, in the order in which they began. It counts for them.
    pub fn meet<U: Unit>(&mut self, now: Instant, frame: &[u8], units: &Network<U>) -> Vec<Met> {
        let Self { dice, active, kept, .. } = self;
        let mut met = Vec::new();
        if active.is_empty() {
            return met;
        }
        active.retain(|active| now < active.until);
        let has_partner = kept.waits_for_next();
        for active in active.iter_mut() {
            let Disturbance { fault, frames, .. } = &active.disturbance;
            // The next frame for one that waits cannot wait for that one too.
            let is_partner = *fault == FrameFault::Swap && has_partner;
            if is_partner || !frames.include(frame, units) {
                continue;
            }
            active.seen += 1;
            if frames.choice.selects(active.seen, dice) && !has_no_effect(*fault, frame) {
                active.met += 1;
                let delay = fault.delay().map(|delay| delay.draw(dice));
                let datagrams = frames.addressing(frame, units);
                met.push(Met::of(active.number, &active.disturbance, delay, datagrams));
            }
        }
        active.retain(|active| !active.disturbance.frames.choice.is_over(active.seen));
        met
    }

    /// Passes a frame on that a master sends now and that meets these faults: to the units, which react, and back.
    pub fn send<U: Unit>(
        &mut self,
        now: Instant,
        ticket: T,
        frame: Vec<u8>,
        met: Vec<Met>,
        units: &mut Network<U>,
        ends: &mut impl LineEnds<T>,
    ) {
        let partners = self.kept.waiting_for_next();
        let flight = Flight { ticket, frame, met, stage: Stage::Outside };
        self.passing(now, units, ends).begin(flight);
        self.kept.next_has_passed(now, partners);
    }

    /// A frame has passed the units without the faults: it is the next one for those that wait for it.
    pub fn has_passed(&mut self, now: Instant) {
        self.kept.next_has_passed(now, self.kept.waiting_for_next());
    }

    /// Passes on the frames that wait and are due, one after the other.
    #[inline]
    pub fn poll<U: Unit>(&mut self, now: Instant, units: &mut Network<U>, ends: &mut impl LineEnds<T>) {
        // Mostly no frame waits.
        while self.deadline() <= now
            && let Some(flight) = self.kept.take_due(now)
        {
            self.passing(now, units, ends).resume(flight);
        }
    }

    const fn passing<'a, U: Unit, E: LineEnds<T>>(
        &'a mut self,
        now: Instant,
        units: &'a mut Network<U>,
        ends: &'a mut E,
    ) -> Passing<'a, T, U, E> {
        Passing { now, kept: &mut self.kept, lost_for_room: &mut self.lost_for_room, units, ends }
    }
}

/// A frame that is short enough is not cut.
fn has_no_effect(fault: FrameFault, frame: &[u8]) -> bool {
    matches!(fault, FrameFault::Cut { length_bytes } if usize::from(length_bytes) >= frame.len())
}

impl Active {
    fn is_at_work(&self, now: Instant) -> bool {
        now < self.until
    }

    const fn view(&self) -> ActiveFault<'_> {
        ActiveFault {
            number: self.number,
            disturbance: &self.disturbance,
            until: self.until,
            frames_seen: self.seen,
            frames_met: self.met,
        }
    }
}
