//! Patterns of light over time.

use serde::{Deserialize, Serialize};
use time::{Duration, Instant};

/// The pattern of an indicator over time.
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

/// The document with the times of a pattern.
const ETG_1300: Option<&str> = Some("ETG.1300");

struct Row {
    pattern: Pattern,
    id: &'static str,
    /// Lit, dark, lit, dark …, and again from the start.
    steps_ms: &'static [u64],
    /// None for a steady pattern, and for those that are only in manufacturers' documents.
    source: Option<&'static str>,
}

const fn row(
    pattern: Pattern,
    id: &'static str,
    steps_ms: &'static [u64],
    source: Option<&'static str>,
) -> Row {
    Row { pattern, id, steps_ms, source }
}

/// In the order of the enumeration.
const ROWS: [Row; 8] = [
    row(Pattern::NotLit, "not_lit", &[], None),
    row(Pattern::Lit, "lit", &[], None),
    row(Pattern::Flickering, "flickering", &[50, 50], ETG_1300),
    row(Pattern::Blinking, "blinking", &[200, 200], ETG_1300),
    row(Pattern::SingleFlash, "single_flash", &[200, 1_000], ETG_1300),
    row(Pattern::DoubleFlash, "double_flash", &[200, 200, 200, 1_000], ETG_1300),
    row(Pattern::Flashing1s, "flashing_1s", &[500, 500], None),
    row(Pattern::Flashing2s, "flashing_2s", &[1_000, 1_000], None),
];

const _: () = {
    let mut at = 0;
    while at < ROWS.len() {
        assert!(ROWS[at].pattern as usize == at, "rows are in the order of the enumeration");
        at += 1;
    }
};

impl Pattern {
    /// All patterns.
    pub const ALL: [Self; 8] = {
        let mut all = [Self::NotLit; 8];
        let mut at = 0;
        while at < ROWS.len() {
            all[at] = ROWS[at].pattern;
            at += 1;
        }
        all
    };

    /// Its word in tables and sentences.
    #[must_use]
    pub const fn id(self) -> &'static str {
        ROWS[self as usize].id
    }

    /// Durations of lit, dark, lit, dark … in milliseconds, before it begins again; empty if it never changes.
    #[must_use]
    pub const fn steps_ms(self) -> &'static [u64] {
        ROWS[self as usize].steps_ms
    }

    /// The standard with its times; none for a steady pattern and for one that is only in manufacturers' documents.
    #[must_use]
    pub const fn standard(self) -> Option<&'static str> {
        ROWS[self as usize].source
    }

    /// Whether the indicator is lit at this time.
    #[must_use]
    pub fn is_lit(self, at: Instant) -> bool {
        self.step(at).map_or(self == Self::Lit, |step| step.lit)
    }

    /// The time of its next change, after `at`; [`Instant::NEVER`] if it never changes.
    #[must_use]
    pub fn next_change(self, at: Instant) -> Instant {
        self.step(at).map_or(Instant::NEVER, |step| at + step.rest)
    }

    /// The step at a point in time; none for a steady pattern.
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

/// The position within a pattern.
struct Step {
    lit: bool,
    /// Until the next step.
    rest: Duration,
}
