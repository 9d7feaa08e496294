//! The behaviours as a table: for the reader of unit files and for the page.

use core::fmt;

/// A behaviour.
#[derive(Clone, Copy, Debug)]
pub struct BehaviourRow {
    /// Its key in a unit file.
    pub name: &'static str,
    /// What the value does.
    pub meaning: &'static str,
    /// The keys of its table; none: it has a value and no table.
    pub keys: &'static [BehaviourKey],
    /// An example in a unit file.
    pub example: &'static str,
}

/// A key of a behaviour.
#[derive(Clone, Copy, Debug)]
pub struct BehaviourKey {
    /// The key.
    pub name: &'static str,
    /// Its values.
    pub values: &'static str,
    /// The value if it is left out.
    pub left_out: LeftOut,
}

/// What a key means that is left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LeftOut {
    /// It is required.
    Required,
    /// This number.
    Number(f64),
    /// 1 of a BOOL; of other types it is required.
    OneOfBool,
    /// The greatest number of the type.
    Greatest,
    /// The first column of values.
    FirstColumn,
    /// false.
    No,
}

impl fmt::Display for LeftOut {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Required => formatter.write_str("required"),
            Self::Number(number) => number.fmt(formatter),
            Self::OneOfBool => formatter.write_str("1 of a BOOL, else required"),
            Self::Greatest => formatter.write_str("the greatest number of the type"),
            Self::FirstColumn => formatter.write_str("the first one"),
            Self::No => formatter.write_str("false"),
        }
    }
}

/// What durations are.
pub(super) const DURATION: &str = "a duration of at least 1us, such as \"100ms\"";

const fn key(name: &'static str, values: &'static str, left_out: LeftOut) -> BehaviourKey {
    BehaviourKey { name, values, left_out }
}

const PERIOD: BehaviourKey = key("period", DURATION, LeftOut::Required);
const EVERY: BehaviourKey = key("every", DURATION, LeftOut::Required);
const LOW: BehaviourKey = key("low", "a number of the type", LeftOut::Number(0.0));
const HIGH: BehaviourKey = key("high", "a number of the type, not below `low`", LeftOut::OneOfBool);

/// All behaviours, in the order in which they are shown.
pub const BEHAVIOURS: &[BehaviourRow] = &[
    BehaviourRow {
        name: "hold",
        meaning: "has this value from power-on, until something else writes it",
        keys: &[],
        example: "{ hold = true }",
    },
    BehaviourRow {
        name: "ramp",
        meaning: "changes evenly from `from` to `to` in each period, then jumps back",
        keys: &[
            key("from", "a number of the type", LeftOut::Number(0.0)),
            key("to", "a number of the type", LeftOut::OneOfBool),
            PERIOD,
        ],
        example: "{ ramp = { to = 1000, period = \"10s\" } }",
    },
    BehaviourRow {
        name: "sine",
        meaning: "a sine that begins in the middle between `low` and `high` and rises",
        keys: &[LOW, HIGH, PERIOD],
        example: "{ sine = { low = 200, high = 400, period = \"60s\" } }",
    },
    BehaviourRow {
        name: "square",
        meaning: "`high` in the first part of each period, `low` in the rest",
        keys: &[
            LOW,
            HIGH,
            PERIOD,
            key("duty", "the first part in percent of the period, 0 to 100", LeftOut::Number(50.0)),
        ],
        example: "{ square = { period = \"2s\", duty = 25 } }",
    },
    BehaviourRow {
        name: "random",
        meaning: "another number between `low` and `high`, both included, after each interval; the seed decides",
        keys: &[LOW, HIGH, EVERY],
        example: "{ random = { every = \"100ms\" } }",
    },
    BehaviourRow {
        name: "counter",
        meaning: "counts by `step` after each interval; beyond `to` it begins at `from` again",
        keys: &[
            key("from", "a number of the type", LeftOut::Number(0.0)),
            key("to", "a number of the type", LeftOut::Greatest),
            key("step", "a number, not 0, towards `to`", LeftOut::Number(1.0)),
            EVERY,
        ],
        example: "{ counter = { every = \"1s\" } }",
    },
    BehaviourRow {
        name: "csv",
        meaning: "the rows of a CSV file: the time in seconds in the first column, values in the others",
        keys: &[
            key("file", "a path, seen from the unit file", LeftOut::Required),
            key("column", "the name or the number of a column of values", LeftOut::FirstColumn),
            key("repeat", "true or false: whether it begins again after its last row", LeftOut::No),
        ],
        example: "{ csv = { file = \"tank.csv\", column = \"level\", repeat = true } }",
    },
];
