//! A fault that a frame meets.

use core::fmt;

use time::Duration;

use super::order::{Direction, Disturbance, FrameFault, Way};

/// A fault that a frame meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Met {
    /// The number of the fault on its line, from 1.
    pub number: u32,
    /// The fault.
    pub fault: FrameFault,
    /// Where.
    pub way: Way,
    /// The delay of this frame, if it has one.
    pub delay: Option<Duration>,
    /// The datagrams that address the unit of the frames, by bits; without a unit all of them.
    datagrams: u128,
}

impl Met {
    pub(super) const fn of(
        number: u32,
        disturbance: &Disturbance,
        delay: Option<Duration>,
        datagrams: u128,
    ) -> Self {
        let Disturbance { fault, way, .. } = disturbance;
        Self { number, fault: *fault, way: *way, delay, datagrams }
    }

    /// Whether it is about the datagram with this number, from 0.
    pub(super) const fn is_about(&self, datagram: u32) -> bool {
        match self.datagrams.checked_shr(datagram) {
            Some(bits) => bits & 1 != 0,
            None => false,
        }
    }

    pub(super) fn is(&self, fault: FrameFault, direction: Direction) -> bool {
        self.fault == fault && self.way.direction == direction
    }

    /// The position of the unit behind the cable where it happens; 0: between the master and the line.
    pub(super) const fn cable(&self) -> usize {
        match (self.fault, self.way.cable) {
            (FrameFault::Corrupt { cable }, _) | (_, Some(cable)) => cable.position(),
            (_, None) => 0,
        }
    }
}

/// The words for a trace and a capture.
impl fmt::Display for Met {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let is_back = self.way.direction == Direction::Back;
        let on_cable = |formatter: &mut fmt::Formatter<'_>| match self.way.cable {
            Some(cable) => write!(formatter, " on {cable}"),
            None => Ok(()),
        };
        match (self.fault, is_back) {
            (FrameFault::Lose, false) => {
                formatter.write_str("a frame is lost")?;
                on_cable(formatter)?;
                formatter.write_str(" on the way to the units")
            }
            (FrameFault::Lose, true) | (FrameFault::LoseAnswer, _) => {
                formatter.write_str("the answer of a frame is lost")?;
                on_cable(formatter)?;
                formatter.write_str(" on the way to the master")
            }
            (FrameFault::Delay { .. }, false) => {
                formatter.write_str("a frame comes late")?;
                on_cable(formatter)
            }
            (FrameFault::Delay { .. }, true) => {
                formatter.write_str("an answer comes late")?;
                on_cable(formatter)
            }
            (FrameFault::Duplicate, false) => formatter.write_str("a frame comes twice"),
            (FrameFault::Duplicate, true) => formatter.write_str("an answer comes twice"),
            (FrameFault::Swap, false) => formatter.write_str("a frame comes after the next one"),
            (FrameFault::Swap, true) => formatter.write_str("an answer comes after the next one"),
            (FrameFault::Cut { .. }, false) => formatter.write_str("a frame is cut short"),
            (FrameFault::Cut { .. }, true) => formatter.write_str("an answer is cut short"),
            (FrameFault::Corrupt { .. }, false) => formatter.write_str("a frame has a bit error on its way"),
            (FrameFault::Corrupt { .. }, true) => {
                formatter.write_str("a frame has a bit error on its way back")
            }
            (FrameFault::LowerWorkingCounter, _) => {
                formatter.write_str("the working counters of an answer are one too low")
            }
            (FrameFault::LowerWorkingCounterBy { by }, _) => {
                write!(formatter, "the working counters of an answer are {by} too low")
            }
        }
    }
}
