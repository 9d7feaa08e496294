//! Actions on the line: cables, and faults of frames.

use core::fmt;
use core::str::FromStr;

use serde::{Deserialize, Serialize};
use time::Duration;

use super::delay::Delay;
use super::frames::Frames;
use super::numbers::CableNumber;
use crate::notation::{nothing, optional_text, text};

/// An action on the line between the master and the units.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum LineOrder {
    /// A cable is pulled out.
    Unplug {
        /// Its number.
        cable: CableNumber,
    },
    /// A cable is plugged in.
    Plug {
        /// Its number.
        cable: CableNumber,
    },
    /// Frames get a fault.
    Disturb(Disturbance),
    /// One fault of frames ends.
    End {
        /// Its name.
        #[serde(with = "text")]
        name: FaultName,
    },
    /// No more faults of frames.
    #[serde(with = "nothing")]
    BeQuiet,
}

/// Which frames get a fault, where, and for how long.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Disturbance {
    /// The fault.
    pub fault: FrameFault,
    /// The frames.
    pub frames: Frames,
    /// Where it happens, for the faults that have a place: see [`FrameFault::has_cable`] and
    /// [`FrameFault::has_direction`].
    #[serde(default, skip_serializing_if = "Way::is_anywhere")]
    pub way: Way,
    /// How long frames get it, above 0; none: until it is ended.
    #[serde(default, rename = "for", with = "optional_text", skip_serializing_if = "Option::is_none")]
    pub lasts: Option<Duration>,
    /// Its name, by which it is ended.
    #[serde(default, with = "optional_text", skip_serializing_if = "Option::is_none")]
    pub name: Option<FaultName>,
}

impl Disturbance {
    /// A fault of these frames, outward, until it is ended.
    #[must_use]
    pub const fn new(fault: FrameFault, frames: Frames) -> Self {
        Self { fault, frames, way: Way::ANYWHERE, lasts: None, name: None }
    }

    /// The same on this cable.
    #[must_use]
    pub const fn on_cable(mut self, cable: CableNumber) -> Self {
        self.way.cable = Some(cable);
        self
    }

    /// The same in this direction.
    #[must_use]
    pub const fn towards(mut self, direction: Direction) -> Self {
        self.way.direction = direction;
        self
    }

    /// The same for this time.
    #[must_use]
    pub const fn lasting(mut self, time: Duration) -> Self {
        self.lasts = Some(time);
        self
    }

    /// The same with a name.
    #[must_use]
    pub fn called(mut self, name: FaultName) -> Self {
        self.name = Some(name);
        self
    }

    /// Whether frames can meet it: it selects some, its numbers are possible, and the fault has the place that is named.
    #[must_use]
    pub fn is_possible(&self) -> bool {
        let is_lowered = self.fault != FrameFault::LowerWorkingCounterBy { by: 0 };
        let values = is_lowered && self.fault.delay().is_none_or(Delay::is_possible);
        let has_way = (self.way.cable.is_none() || self.fault.has_cable())
            && (self.way.direction == Direction::Outward || self.fault.has_direction());
        values && has_way && self.frames.choice.is_possible() && !self.lasts.is_some_and(Duration::is_zero)
    }

    /// The cable on which it happens, if it happens on one.
    #[must_use]
    pub const fn cable(&self) -> Option<CableNumber> {
        match self.fault {
            FrameFault::Corrupt { cable } => Some(cable),
            FrameFault::Lose
            | FrameFault::LoseAnswer
            | FrameFault::Delay { .. }
            | FrameFault::Duplicate
            | FrameFault::Swap
            | FrameFault::Cut { .. }
            | FrameFault::LowerWorkingCounter
            | FrameFault::LowerWorkingCounterBy { .. } => self.way.cable,
        }
    }
}

/// A fault of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum FrameFault {
    /// It is lost: outward before the units behind the place, on the way back its answer.
    Lose,
    /// It passes the units, and its answer is lost.
    LoseAnswer,
    /// It is delayed: outward before the units behind the place, on the way back its answer.
    Delay {
        /// The delay.
        by: Delay,
    },
    /// Outward it passes the units twice, on the way back its answer arrives twice.
    Duplicate,
    /// It waits until the next frame has passed, at most 100 ms: outward before the units, on the way back its answer.
    Swap,
    /// It is shortened: outward so that no unit accepts it, on the way back its answer.
    Cut {
        /// Its remaining number of bytes.
        length_bytes: u16,
    },
    /// A bit error on a cable.
    Corrupt {
        /// The cable before a unit.
        cable: CableNumber,
    },
    /// The working counters of its answer are too low by one, those of the datagrams that address the unit of the frames.
    LowerWorkingCounter,
    /// The same by another number; no working counter gets below 0.
    LowerWorkingCounterBy {
        /// The number, from 1.
        by: u16,
    },
}

impl FrameFault {
    /// Whether the `way` of a disturbance can name a cable.
    #[must_use]
    pub const fn has_cable(self) -> bool {
        matches!(self, Self::Lose | Self::Delay { .. })
    }

    /// How late it makes a frame; none: it is no delay.
    #[must_use]
    pub const fn delay(self) -> Option<Delay> {
        match self {
            Self::Delay { by } => Some(by),
            Self::Lose
            | Self::LoseAnswer
            | Self::Duplicate
            | Self::Swap
            | Self::Cut { .. }
            | Self::Corrupt { .. }
            | Self::LowerWorkingCounter
            | Self::LowerWorkingCounterBy { .. } => None,
        }
    }

    /// Whether the `way` of a disturbance can name a direction.
    #[must_use]
    pub const fn has_direction(self) -> bool {
        match self {
            Self::Lose
            | Self::Delay { .. }
            | Self::Duplicate
            | Self::Swap
            | Self::Cut { .. }
            | Self::Corrupt { .. } => true,
            Self::LoseAnswer | Self::LowerWorkingCounter | Self::LowerWorkingCounterBy { .. } => false,
        }
    }
}

/// A place on the way of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Way {
    /// The cable before a unit; none: between the master and the line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cable: Option<CableNumber>,
    /// The direction.
    #[serde(default)]
    pub direction: Direction,
}

impl Way {
    /// Between the master and the line, outward.
    pub const ANYWHERE: Self = Self { cable: None, direction: Direction::Outward };

    /// Whether it names no place.
    #[must_use]
    pub const fn is_anywhere(&self) -> bool {
        matches!(self, Self { cable: None, direction: Direction::Outward })
    }
}

/// A direction on the line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Direction {
    /// From the master to the end of the line: on this way the units process a frame.
    #[default]
    Outward,
    /// From the end of the line to the master.
    Back,
}

/// The name of a fault: a letter, and then at most 63 letters, digits, `-` and `_`.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FaultName(String);

impl FaultName {
    /// The name.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

/// A text that cannot be the name of a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoFaultName;

impl fmt::Display for NoFaultName {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "expected {}", FaultName::WORDS)
    }
}

impl core::error::Error for NoFaultName {}

impl FaultName {
    /// The possible names.
    pub const WORDS: &'static str =
        "a name such as storm: a letter, and then at most 63 letters, digits, - and _";
}

impl FromStr for FaultName {
    type Err = NoFaultName;

    fn from_str(text: &str) -> Result<Self, NoFaultName> {
        let is_part = |byte: u8| byte.is_ascii_alphanumeric() || [b'-', b'_'].contains(&byte);
        let is_name = text.len() <= 64
            && text.bytes().next().is_some_and(|first| first.is_ascii_alphabetic())
            && text.bytes().all(is_part);
        is_name.then(|| Self(text.to_owned())).ok_or(NoFaultName)
    }
}

impl fmt::Display for FaultName {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.0)
    }
}
