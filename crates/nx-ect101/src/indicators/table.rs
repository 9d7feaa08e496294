//! The table of indicators, from `tables/indicators.toml`.

use std::sync::LazyLock;

use coe_kit::indicators::Pattern;
use serde::Deserialize;

use crate::events::{Event, EventCode};
use crate::tables;

pub use unit_model::tables::Colour;

static TABLE: LazyLock<IndicatorsFile> =
    LazyLock::new(|| tables::parse("indicators.toml", include_str!("../../tables/indicators.toml")));

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct IndicatorsFile {
    pattern: Vec<PatternRow>,
    indicator: Vec<Indicator>,
    primary: Vec<PrimaryRow>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PatternRow {
    name: Pattern,
    source: String,
}

/// An indicator, or two of the same kind.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Indicator {
    /// Its label on the front.
    pub names: Vec<String>,
    /// Its purpose.
    pub shows: String,
    /// Its possible states, the most important first.
    pub status: Vec<IndicatorMeaning>,
}

/// The meaning of a colour and a pattern of an indicator.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IndicatorMeaning {
    /// The colour.
    pub colour: Colour,
    /// The pattern.
    pub pattern: Pattern,
    /// The events that cause it.
    events: Option<EventColumn>,
    /// Its meaning.
    pub meaning: Vec<String>,
}

impl Indicator {
    /// All indicators, in the order on the front: RUN, ERR, L/A IN and L/A OUT, TS (manual, 3-2).
    #[must_use]
    pub fn all() -> &'static [Self] {
        &TABLE.indicator
    }
}

impl IndicatorMeaning {
    /// The events that cause this state of the indicator.
    pub fn events(&self) -> impl Iterator<Item = EventCode> {
        let shows = |event: &&Event| self.events.is_some_and(|column| column.shows(event, self.pattern));
        Event::all().iter().filter(shows).map(|event| event.code)
    }
}

/// The column of the events that determines it.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
enum EventColumn {
    Err,
    TsRed,
    /// Green is off, and red keeps its state.
    TsDark,
}

impl EventColumn {
    fn shows(self, event: &Event, pattern: Pattern) -> bool {
        match self {
            Self::Err => event.err.pattern() == Some(pattern),
            Self::TsRed => event.ts_red.pattern() == Some(pattern),
            Self::TsDark => event.ts_green.pattern() == Some(pattern) && event.ts_red.pattern().is_none(),
        }
    }
}

/// A row of 8-2-2 that is not an event.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PrimaryRow {
    cause: PrimaryCause,
    pub(super) run: Pattern,
    pub(super) err: Pattern,
    pub(super) ts_green: Pattern,
    pub(super) ts_red: Pattern,
}

/// The subject of such a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum PrimaryCause {
    Normal,
    Initializing,
    WaitingForInitialization,
    HardwareFailure,
    CpuUnitMalfunction,
}

/// The row for a cause.
pub(super) fn primary(cause: PrimaryCause) -> PrimaryRow {
    match TABLE.primary.iter().find(|row| row.cause == cause) {
        Some(row) => *row,
        None => panic!("tables/indicators.toml: no row for {cause:?}"),
    }
}

/// The document with the times of each pattern that is in no standard.
pub(crate) fn pattern_sources() -> Vec<(Pattern, &'static str)> {
    TABLE.pattern.iter().map(|row| (row.name, row.source.as_str())).collect()
}
