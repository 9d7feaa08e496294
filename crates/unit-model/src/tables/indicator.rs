//! Indicators with the meanings of their colours and patterns.

use coe_kit::indicators::Pattern;
use serde::{Deserialize, Serialize};

use crate::event::EventCode;

/// An indicator, or several of the same kind.
#[derive(Clone, Debug)]
pub struct IndicatorRow {
    /// Its label on the front.
    pub names: Vec<&'static str>,
    /// Its purpose.
    pub shows: &'static str,
    /// Its possible states, the most important first.
    pub status: Vec<StatusRow>,
}

/// The meaning of a colour and a pattern of an indicator.
#[derive(Clone, Debug)]
pub struct StatusRow {
    /// The colour.
    pub colour: Colour,
    /// The pattern.
    pub pattern: Pattern,
    /// Its meanings.
    pub meaning: Vec<&'static str>,
    /// The events that cause it.
    pub events: Vec<EventCode>,
}

/// RUN, in the order of ETG.1300.
const RUN: &[(Pattern, &str)] = &[
    (Pattern::Lit, "OP"),
    (Pattern::SingleFlash, "SAFE-OP"),
    (Pattern::Blinking, "PRE-OP"),
    (Pattern::NotLit, "INIT"),
];
/// L/A of a port, the same.
const LINK_ACTIVITY: &[(Pattern, &str)] = &[
    (Pattern::Flickering, "link, and frames pass"),
    (Pattern::Lit, "link, no frames"),
    (Pattern::NotLit, "no link"),
];

impl IndicatorRow {
    /// RUN as ETG.1300 has it, for a slave without BOOT.
    #[must_use]
    pub fn run(name: &'static str) -> Self {
        Self::green(vec![name], "the state of EtherCAT communications", RUN)
    }

    /// L/A of each port as ETG.1300 has it.
    #[must_use]
    pub fn link_activity(names: Vec<&'static str>) -> Self {
        Self::green(names, "link and activity of the port", LINK_ACTIVITY)
    }

    fn green(names: Vec<&'static str>, shows: &'static str, status: &[(Pattern, &'static str)]) -> Self {
        let status = status.iter().map(|&(pattern, meaning)| StatusRow {
            colour: if pattern == Pattern::NotLit { Colour::None } else { Colour::Green },
            pattern,
            meaning: vec![meaning],
            events: Vec::new(),
        });
        Self { names, shows, status: status.collect() }
    }
}

/// Colour of an indicator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Colour {
    /// Green.
    Green,
    /// Red.
    Red,
    /// Dark.
    None,
}

impl Colour {
    /// Its word in tables.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::Green => "green",
            Self::Red => "red",
            Self::None => "none",
        }
    }
}

#[cfg(test)]
mod tests {
    use coe_kit::indicators::{PortCondition, run};
    use wire::AlState;

    use super::*;

    fn meaning(row: &IndicatorRow, pattern: Pattern) -> &'static str {
        let status = row.status.iter().find(|status| status.pattern == pattern);
        status.unwrap_or_else(|| panic!("{pattern:?} has no meaning")).meaning[0]
    }

    #[test]
    fn each_pattern_of_the_standard_has_its_meaning() {
        let row = IndicatorRow::run("RUN");
        for state in [AlState::Init, AlState::PreOp, AlState::SafeOp, AlState::Op] {
            assert_eq!(meaning(&row, run(state)), state.to_string());
        }
        let row = IndicatorRow::link_activity(vec!["L/A"]);
        let meanings = PortCondition::ALL.map(|condition| meaning(&row, condition.pattern()));
        assert_eq!(meanings, ["no link", "link, no frames", "link, and frames pass"]);
    }
}
