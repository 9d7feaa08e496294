//! Faults of frames between the master and the units.

use time::Instant;

use super::dice::Dice;
use super::master::Ticket;
use crate::model::{Choice, Disturbance, FrameFault, FrameKind};

/// The faults of the line, seeded.
#[derive(Debug)]
pub(crate) struct Line {
    dice: Dice,
    disturbances: Vec<Disturbance>,
    delayed: Vec<Delayed>,
}

/// A delayed frame.
#[derive(Debug)]
pub(crate) struct Delayed {
    pub(crate) at: Instant,
    pub(crate) ticket: Ticket,
    pub(crate) frame: Vec<u8>,
    /// All its faults, including the delay.
    pub(crate) faults: Vec<FrameFault>,
}

impl Line {
    pub(crate) const fn new(seed: u64) -> Self {
        Self { dice: Dice::new(seed), disturbances: Vec::new(), delayed: Vec::new() }
    }

    pub(crate) fn disturb(&mut self, disturbance: Disturbance) {
        self.disturbances.push(disturbance);
    }

    pub(crate) fn quiet(&mut self) {
        self.disturbances.clear();
    }

    /// The faults for a frame of this kind, in the order in which they were ordered.
    pub(crate) fn faults(&mut self, kind: FrameKind) -> Vec<FrameFault> {
        let Self { dice, disturbances, .. } = self;
        let meant =
            |disturbance: &&mut Disturbance| [FrameKind::Any, kind].contains(&disturbance.frames.kind);
        let mut faults = Vec::new();
        for disturbance in disturbances.iter_mut().filter(meant) {
            let meets = match &mut disturbance.frames.choice {
                Choice::All => true,
                Choice::Percent(percent) => dice.hits(*percent),
                Choice::Next(0) => false,
                Choice::Behind { skip: 0, count } => {
                    disturbance.frames.choice = Choice::Next(count.saturating_sub(1));
                    true
                }
                Choice::Behind { skip, .. } => {
                    *skip -= 1;
                    false
                }
                Choice::Next(left) => {
                    *left -= 1;
                    true
                }
            };
            if meets {
                faults.push(disturbance.fault);
            }
        }
        disturbances.retain(|disturbance| disturbance.frames.choice != Choice::Next(0));
        faults
    }

    /// Keeps a frame for later.
    pub(crate) fn delay(&mut self, delayed: Delayed) {
        self.delayed.push(delayed);
    }

    pub(crate) fn deadline(&self) -> Instant {
        self.delayed.iter().map(|delayed| delayed.at).min().unwrap_or(Instant::NEVER)
    }

    /// The next frame that is due; of several the one that was sent first.
    pub(crate) fn due(&mut self, now: Instant) -> Option<Delayed> {
        let place = self.delayed.iter().position(|delayed| delayed.at <= now)?;
        Some(self.delayed.remove(place))
    }
}
