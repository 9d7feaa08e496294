//! The behaviours as a table: for the reader of unit files and for the page.

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
    /// The value if it is left out; empty: it is required.
    pub default: &'static str,
}

const fn key(name: &'static str, values: &'static str, default: &'static str) -> BehaviourKey {
    BehaviourKey { name, values, default }
}

const PERIOD: BehaviourKey = key("period", "a duration of at least 1us", "");
const EVERY: BehaviourKey = key("every", "a duration of at least 1us", "");
const LOW: BehaviourKey = key("low", "a number of the type", "0");
const HIGH: BehaviourKey = key("high", "a number of the type, not below `low`", "1 of a BOOL, else required");

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
            key("from", "a number of the type", "0"),
            key("to", "a number of the type", "1 of a BOOL, else required"),
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
        keys: &[LOW, HIGH, PERIOD, key("duty", "the first part in percent of the period, 0 to 100", "50")],
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
            key("from", "a number of the type", "0"),
            key("to", "a number of the type", "the greatest number of the type"),
            key("step", "a number, not 0, towards `to`", "1"),
            EVERY,
        ],
        example: "{ counter = { every = \"1s\" } }",
    },
    BehaviourRow {
        name: "csv",
        meaning: "the rows of a CSV file: the time in seconds in the first column, values in the others",
        keys: &[
            key("file", "a path, seen from the unit file", ""),
            key("column", "the name or the number of a column of values", "1"),
            key("repeat", "true or false: whether it begins again after its last row", "false"),
        ],
        example: "{ csv = { file = \"tank.csv\", column = \"level\", repeat = true } }",
    },
];
