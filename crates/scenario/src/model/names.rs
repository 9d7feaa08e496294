//! States, indicators and positions in programs, in the notation of sentences.

use core::fmt;
use core::str::FromStr;

use wire::AlState;

use super::spelling::{NotAValue, by_text, number};

/// A state in the notation of sentences: `SAFE-OP`, or a number such as `0x05`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StateName(pub AlState);

const STATES: [(&str, AlState); 5] = [
    ("INIT", AlState::Init),
    ("PRE-OP", AlState::PreOp),
    ("SAFE-OP", AlState::SafeOp),
    ("OP", AlState::Op),
    ("BOOT", AlState::Boot),
];

impl fmt::Display for StateName {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match STATES.into_iter().find(|(_, state)| *state == self.0) {
            Some((name, _)) => formatter.write_str(name),
            None => write!(formatter, "{:#04X}", self.0.bits()),
        }
    }
}

impl FromStr for StateName {
    type Err = NotAValue;

    fn from_str(text: &str) -> Result<Self, NotAValue> {
        let named = STATES.into_iter().find(|(name, _)| *name == text).map(|(_, state)| state);
        let bits = || u16::try_from(number(text)?).ok().filter(|bits| *bits < 16).map(AlState::from_bits);
        let state = named.or_else(bits);
        state.map(Self).ok_or(NotAValue("INIT, PRE-OP, SAFE-OP, OP, BOOT, or a number such as 0x05"))
    }
}

/// An indicator of a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IndicatorName {
    /// RUN.
    Run,
    /// ERR.
    Err,
    /// L/A IN.
    LinkIn,
    /// L/A OUT.
    LinkOut,
    /// TS, green.
    TsGreen,
    /// TS, red.
    TsRed,
}

impl IndicatorName {
    /// All of them.
    const ALL: [Self; 6] = [Self::Run, Self::Err, Self::LinkIn, Self::LinkOut, Self::TsGreen, Self::TsRed];

    /// Its spelling, which is its name in the models.
    pub(crate) const fn as_str(self) -> &'static str {
        match self {
            Self::Run => "RUN",
            Self::Err => "ERR",
            Self::LinkIn => "L/A IN",
            Self::LinkOut => "L/A OUT",
            Self::TsGreen => "TS green",
            Self::TsRed => "TS red",
        }
    }
}

impl fmt::Display for IndicatorName {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.as_str())
    }
}

impl FromStr for IndicatorName {
    type Err = NotAValue;

    fn from_str(text: &str) -> Result<Self, NotAValue> {
        let named = Self::ALL.into_iter().find(|indicator| indicator.as_str() == text);
        named.ok_or(NotAValue("RUN, ERR, L/A IN, L/A OUT, TS green or TS red"))
    }
}

/// Line and column of a program, both from 1: `5:9`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Position {
    /// The line, from 1.
    pub line: usize,
    /// The column, from 1.
    pub column: usize,
}

impl fmt::Display for Position {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}:{}", self.line, self.column)
    }
}

impl FromStr for Position {
    type Err = NotAValue;

    fn from_str(text: &str) -> Result<Self, NotAValue> {
        let from_1 = |digits: &str| digits.parse::<usize>().ok().filter(|&number| number > 0);
        let parts = text.split_once(':');
        let position = parts.and_then(|(line, column)| Some((from_1(line)?, from_1(column)?)));
        let position = position.map(|(line, column)| Self { line, column });
        position.ok_or(NotAValue("line and column, both from 1, such as 5:9"))
    }
}

by_text! { StateName IndicatorName Position }

/// A field whose value is a state.
pub(super) mod state {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};
    use wire::AlState;

    use super::StateName;

    pub(crate) fn serialize<S: Serializer>(state: &AlState, serializer: S) -> Result<S::Ok, S::Error> {
        StateName(*state).serialize(serializer)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<AlState, D::Error> {
        StateName::deserialize(deserializer).map(|name| name.0)
    }
}
