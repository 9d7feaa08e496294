//! Patterns of light over time (manual, 3-2-4; times of ETG.1300).

use serde::{Deserialize, Serialize};
use time::{Duration, Instant};

use super::table;
use crate::events::IndicatorStatus;

/// What an indicator does over time.
///
/// All indicators share one phase: each pattern begins at [`Instant::ZERO`], lit. So patterns of the same kind
/// flash together, on one unit and on a line of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Pattern {
    /// Never lit.
    #[default]
    NotLit,
    /// Always lit.
    Lit,
    /// 50 ms lit, 50 ms dark.
    Flickering,
    /// 200 ms lit, 200 ms dark.
    Blinking,
    /// 200 ms lit, 1,000 ms dark.
    SingleFlash,
    /// 200 ms lit, 200 ms dark, 200 ms lit, 1,000 ms dark.
    DoubleFlash,
    /// 500 ms lit, 500 ms dark.
    #[serde(rename = "flashing_1s")]
    Flashing1s,
    /// 1,000 ms lit, 1,000 ms dark.
    #[serde(rename = "flashing_2s")]
    Flashing2s,
}

impl Pattern {
    /// All patterns.
    pub const ALL: [Self; 8] = [
        Self::NotLit,
        Self::Lit,
        Self::Flickering,
        Self::Blinking,
        Self::SingleFlash,
        Self::DoubleFlash,
        Self::Flashing1s,
        Self::Flashing2s,
    ];

    /// The word of the tables for it.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::NotLit => "not_lit",
            Self::Lit => "lit",
            Self::Flickering => "flickering",
            Self::Blinking => "blinking",
            Self::SingleFlash => "single_flash",
            Self::DoubleFlash => "double_flash",
            Self::Flashing1s => "flashing_1s",
            Self::Flashing2s => "flashing_2s",
        }
    }

    /// How long it is lit, dark, lit, dark … in milliseconds, before it begins again; empty if it never changes.
    #[must_use]
    pub fn steps_ms(self) -> &'static [u64] {
        table::steps_ms(self)
    }

    /// Whether the indicator is lit at this moment.
    #[must_use]
    pub fn is_lit(self, at: Instant) -> bool {
        self.step(at).map_or(self == Self::Lit, |step| step.lit)
    }

    /// When it changes next, after `at`; [`Instant::NEVER`] if it never does.
    #[must_use]
    pub fn next_change(self, at: Instant) -> Instant {
        self.step(at).map_or(Instant::NEVER, |step| at + step.rest)
    }

    /// The step that a moment falls into; none of a steady pattern.
    fn step(self, at: Instant) -> Option<Step> {
        let lengths = || self.steps_ms().iter().copied().map(Duration::from_millis);
        let period = lengths().fold(Duration::ZERO, |sum, length| sum + length);
        let mut phase = Duration::from_nanos(at.as_nanos().checked_rem(period.as_nanos())?);
        let mut lit = true;
        for length in lengths() {
            if phase < length {
                return Some(Step { lit, rest: length - phase });
            }
            phase = phase - length;
            lit = !lit;
        }
        None
    }
}

/// Where a pattern is.
struct Step {
    lit: bool,
    /// Until the next step.
    rest: Duration,
}

impl IndicatorStatus {
    /// The pattern that an event shows; none if the event leaves the indicator alone.
    #[must_use]
    pub const fn pattern(self) -> Option<Pattern> {
        Some(match self {
            Self::NotLit => Pattern::NotLit,
            Self::Lit => Pattern::Lit,
            Self::Flickering => Pattern::Flickering,
            Self::Blinking => Pattern::Blinking,
            Self::SingleFlash => Pattern::SingleFlash,
            Self::DoubleFlash => Pattern::DoubleFlash,
            Self::Flashing1s => Pattern::Flashing1s,
            Self::Flashing2s => Pattern::Flashing2s,
            Self::Undefined | Self::NotListed => return None,
        })
    }
}
