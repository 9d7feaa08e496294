//! The places of a sentence: the meaning of a word at `{…}` in a pattern.

mod frames;
mod group;
mod read;
mod units;

use unit_model::keys::{AL_STATUS_CODES, AL_STATUS_CODES_WORDS, TIMES, TIMES_WORDS};

use super::value::Value;
use crate::model::{Delay, FaultName};
use frames::{
    called, delay, direction, fault_name, fitting_frames, fitting_way, frames, lasting, percent, way,
};
use group::group;
use read::{
    bytes, controller, duration, entries, entry, event, fault, first_bytes, fitting_bytes, fitting_entries,
    fitting_indicator, fitting_numbers, indicator, limited, number, numbers, one, pattern, position,
    requested, state, times, transition, user_error,
};
pub(crate) use units::NOT_NAMES;
use units::{fitting_unit, fitting_units, unit, units};

/// The place that is a sentence of the table of quantities.
pub(super) const QUANTITY: &str = "quantity";

/// The place that is a sentence of the table of acts.
pub(super) const ACT: &str = "act";

/// The place of a number of times.
pub(super) const TIMES_PLACE: &str = "times";

/// A kind of place.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Its name in patterns.
    pub name: &'static str,
    /// Its possible values, for the reference.
    pub meaning: &'static str,
    read: fn(&[&str]) -> Option<(Value, usize)>,
    /// Number of words that match at the start of a value that cannot be read.
    fitting: fn(&[&str]) -> usize,
}

impl Place {
    /// The place with this name.
    ///
    /// # Panics
    /// If a pattern uses one that does not exist: the patterns are part of this program.
    #[must_use]
    pub fn named(name: &str) -> &'static Self {
        match PLACES.iter().find(|place| place.name == name) {
            Some(place) => place,
            None => panic!("a pattern names the place {{{name}}}, which does not exist"),
        }
    }

    /// All kinds of places.
    #[must_use]
    pub const fn all() -> &'static [Self] {
        PLACES
    }

    /// The value of the words, and their number; otherwise the number of matching words, and the expected value.
    pub(super) fn read(&self, words: &[&str]) -> Result<(Value, usize), (usize, String)> {
        (self.read)(words).ok_or_else(|| {
            let fitting = (self.fitting)(words);
            let found = words.get(fitting).map_or("the end".to_owned(), |word| format!("`{word}`"));
            (fitting, format!("expected {}, found {found}", self.meaning))
        })
    }
}

const fn place(
    name: &'static str,
    meaning: &'static str,
    read: fn(&[&str]) -> Option<(Value, usize)>,
) -> Place {
    Place { name, meaning, read, fitting: |_| 0 }
}

const PLACES: &[Place] = &[
    Place {
        name: "units",
        meaning: "`all units`, `unit` and its number or name such as `unit Conveyor`, or several units such as `units 3 to 5` or \
                  `units 2, 4 and Conveyor`",
        read: units,
        fitting: fitting_units,
    },
    Place {
        name: "unit",
        meaning: "`unit` and its number, 1 for the one next to the master, or its name such as `unit Conveyor`",
        read: |words| unit(words).map(|unit| (Value::Unit(unit), 2)),
        fitting: fitting_unit,
    },
    place("state", "INIT, PRE-OP, SAFE-OP, OP or BOOT", |words| one(words, state)),
    place("request", "INIT, PRE-OP, SAFE-OP, OP, BOOT, or a number such as 0x05", |words| {
        one(words, requested)
    }),
    place("transition", "a transition by its letters, such as IP, PS or SO", |words| one(words, transition)),
    place("number", "a number such as 12 or 0x0C", |words| one(words, number)),
    Place {
        name: TIMES_PLACE,
        meaning: "`once`, or a number and `times` such as `2 times`",
        read: times,
        fitting: |words| usize::from(words.first().is_some_and(|first| number(first).is_some())),
    },
    place("code", AL_STATUS_CODES_WORDS, |words| {
        limited(words, (*AL_STATUS_CODES.start()).into(), (*AL_STATUS_CODES.end()).into())
    }),
    place("length", "a length from 14 to 1513 bytes: all but the last byte of a frame", |words| {
        limited(words, 14, 1513)
    }),
    place("size", "a number of bytes from 1 to 1486: all that fit into a frame", |words| {
        limited(words, 1, 1486)
    }),
    place("byte", "a number from 0 to 255 such as 0x2A", |words| limited(words, 0, 0xFF)),
    place("word", "a number from 0 to 65535 such as 0x0120", |words| limited(words, 0, 0xFFFF)),
    place("dword", "a number of at most 32 bits such as 0x06090030", |words| limited(words, 0, 0xFFFF_FFFF)),
    place("counter", "a mailbox counter from 0 to 7", |words| limited(words, 0, 7)),
    place("channel", "a SyncManager from 0 to 7", |words| limited(words, 0, 7)),
    place("record", "a record of the diagnosis history from 1 to 250", |words| limited(words, 1, 250)),
    place("lowering", "a number from 1 to 65535", |words| limited(words, 1, 0xFFFF)),
    place("cable", "a cable, 1 for the one to the master", |words| limited(words, 1, 0xFFFF)),
    place("period", "a time above 0 such as 1ms", |words| duration(words, |period| !period.is_zero())),
    place("time", TIMES_WORDS, |words| duration(words, |time| TIMES.contains(&time))),
    place("pause", "a time above 0 and at most 60s such as 100ms", |words| {
        duration(words, |pause| !pause.is_zero() && TIMES.contains(&pause))
    }),
    Place { name: "bytes", meaning: "bytes such as 01 FF, hexadecimal", read: bytes, fitting: fitting_bytes },
    place("first-bytes", "bytes such as 01 FF, hexadecimal, before the next word", first_bytes),
    place("entry", "an entry of an object such as 10F3:05", |words| one(words, entry)),
    Place {
        name: "entries",
        meaning: "at most 254 entries such as 7000:01..06 or 7000:01 7000:02",
        read: entries,
        fitting: fitting_entries,
    },
    Place {
        name: "numbers",
        meaning: "at most 254 PDO numbers such as 1601 1602, hexadecimal",
        read: numbers,
        fitting: fitting_numbers,
    },
    place(
        "event",
        "an event code of eight hexadecimal digits such as 85000000, one of `ectwin list events`",
        |words| one(words, event),
    ),
    place("fault", "a fault of a unit such as Processing (the reference lists them)", |words| {
        one(words, fault)
    }),
    place("pattern", "a pattern such as lit, not_lit, blinking", |words| one(words, pattern)),
    Place {
        name: "indicator",
        meaning: "RUN, ERR, L/A IN, L/A OUT, TS green or TS red",
        read: indicator,
        fitting: fitting_indicator,
    },
    place("percent", "a number from 0 to 100 and %", percent),
    Place {
        name: "frames",
        meaning: "`the next 3`, `all`, `5 % of the` (0 to 100 %), `5 ‰ of the` (0 to 1000 ‰, also `per mille`; with 0 no frame meets the fault), `every 10th of the`, \
                  `number 7 of the` or `numbers 3 to 9 of the`; then `frames`, `process data frames`, `mailbox frames`, `SII frames` or \
                  those with a command such as `BRD frames`; then, if only those that address one unit are meant, `of unit 2`",
        read: frames,
        fitting: fitting_frames,
    },
    Place {
        name: "way",
        meaning: "nothing (between the master and the line), or `on cable 3`; then `on the way back` for the answer, or `outward`, \
                  which can be left out",
        read: way,
        fitting: fitting_way,
    },
    place("direction", "`on the way back` for the answer, or `outward`, which can be left out", direction),
    place("delay", Delay::WORDS, delay),
    place(
        "lasting",
        "nothing, or `for` and the time above 0 after which the fault ends, such as `for 3s`",
        lasting,
    ),
    place(
        "called",
        "nothing, or `called` and a name by which the fault can be ended, such as `called storm`",
        called,
    ),
    place("fault-name", FaultName::WORDS, fault_name),
    place("variable", "a device variable such as N1_UINTs_01_M_to_C", |words| {
        one(words, |word| word.contains('_').then(|| Value::Text(word.to_owned())))
    }),
    place(
        "controller",
        "`the master`, or `unit` and the number or the name of the unit whose CPU Unit is meant",
        controller,
    ),
    place("name", "the name of a variable of a program, such as counter, Main.counter or timer.Q", |words| {
        one(words, |word| Some(Value::Text(word.to_owned())))
    }),
    place(
        "file",
        "the path of a file, without spaces, relative to the scenario, such as units/other.toml",
        |words| one(words, |word| Some(Value::Text(word.to_owned()))),
    ),
    place("program", "the path of a program, without spaces, such as programs/a-3-3.st", |words| {
        one(words, |word| Some(Value::Text(word.to_owned())))
    }),
    place(
        "value",
        "a value as Structured Text writes it, such as 5, 16#1F, TRUE, T#20ms or [1, 2, 13(0)]",
        |words| (!words.is_empty()).then(|| (Value::Text(words.join(" ")), words.len())),
    ),
    place("error", "the code of a user-defined error from 1 to 40000, such as 16#101", |words| {
        one(words, user_error)
    }),
    place("position", "line and column, both from 1, such as 5:9", |words| one(words, position)),
    place(
        "amount",
        "a number or a time as Structured Text writes it, such as 5, -3, 0x1F, 1.5 or T#20ms",
        |words| one(words, |word| word.parse().ok().map(Value::Amount)),
    ),
    place("other", "what the sentence with `is` has there, such as 01 FF or 5", |words| {
        (!words.is_empty()).then(|| (Value::Text(words.join(" ")), words.len()))
    }),
    // The rows of the sentence have its words.
    place(ACT, "what a master can do to a unit, by one of the [acts](#acts)", |_| None),
    place(QUANTITY, "what has a value, by one of the [quantities](#quantities)", |_| None),
    place("condition", "a condition in parentheses such as (unit 1 is in OP), at most 16 deep", |words| {
        group(words)
            .filter(|(parts, _)| parts.len() == 1)
            .map(|(parts, length)| (Value::Group(parts), length))
    }),
    place(
        "conditions",
        "conditions in parentheses, with `;` between them, such as (unit 1 is in OP; unit 2 is in OP), at most 16 deep",
        |words| group(words).map(|(parts, length)| (Value::Group(parts), length)),
    ),
];
