//! The places of a sentence: what a word means where a pattern has `{…}`.

use nx_ect101::{EventCode, Fault, Pattern};
use time::Duration;
use wire::AlState;

use crate::{Choice, Controller, FrameKind, UnitSet};

/// What stands in a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Value {
    /// `unit 2`, `all units`.
    Units(UnitSet),
    /// `unit 2`.
    Unit(usize),
    /// `SAFE-OP`.
    State(AlState),
    /// `12`, `0x0C`.
    Number(u64),
    /// `1.5ms`.
    Duration(Duration),
    /// `01 02 0x03`.
    Bytes(Vec<u8>),
    /// `10F3:05`.
    Entry((u16, u8)),
    /// `7000:01 7000:02`, `7000:01..06`.
    Entries(Vec<(u16, u8)>),
    /// `1601 1602`, hexadecimal.
    Numbers(Vec<u64>),
    /// `85000000`.
    Event(EventCode),
    /// `Processing`.
    Fault(Fault),
    /// `blinking`.
    Pattern(Pattern),
    /// `RUN`.
    Indicator(IndicatorName),
    /// `5 %`.
    Percent(u8),
    /// `the next 3 frames`, `5 % of the mailbox frames`.
    Frames((Choice, FrameKind)),
    /// `N1_UINTs_01_M_to_C`.
    Variable(String),
    /// `the master`, `unit 2`.
    Controller(Controller),
    /// A word: the name of a variable of a program, or of a file.
    Name(String),
    /// All words to the end.
    Text(String),
    /// `5:9`, line and column.
    Position((usize, usize)),
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

/// A kind of place.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Its name in patterns.
    pub name: &'static str,
    /// What can stand there, for the reference.
    pub meaning: &'static str,
    read: fn(&[&str]) -> Option<(Value, usize)>,
    /// How many words of one that cannot be read would fit.
    fitting: fn(&[&str]) -> usize,
}

impl Place {
    /// The place of this name.
    ///
    /// # Panics
    /// If a pattern names one that does not exist: the patterns are ours.
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

    /// What the words mean, and how many they are; else how many of them fit, and what is expected.
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
    place("units", "`all units`, or `unit` and its number", units),
    place("unit", "`unit` and its number, 1 for the one next to the master", |words| {
        unit(words).map(|at| (Value::Unit(at), 2))
    }),
    place("state", "INIT, PRE-OP, SAFE-OP, OP, BOOT, or a number such as 0x05", |words| one(words, state)),
    place("number", "a number such as 12 or 0x0C", |words| {
        one(words, |word| number(word).map(Value::Number))
    }),
    place("byte", "a number from 0 to 255 such as 0x2A", |words| limited(words, 0, 0xFF)),
    place("word", "a number from 0 to 65535 such as 0x0120", |words| limited(words, 0, 0xFFFF)),
    place("dword", "a number of at most 32 bits such as 0x06090030", |words| limited(words, 0, 0xFFFF_FFFF)),
    place("counter", "a mailbox counter from 0 to 7", |words| limited(words, 0, 7)),
    place("channel", "a SyncManager from 0 to 7", |words| limited(words, 0, 7)),
    place("cable", "a cable, 1 for the one to the master", |words| limited(words, 1, 0xFFFF)),
    place("period", "a time above 0 such as 1ms", |words| {
        one(words, |word| {
            word.parse().ok().filter(|period: &Duration| !period.is_zero()).map(Value::Duration)
        })
    }),
    place("duration", "a time such as 1.5ms, 20us or 2s", |words| {
        one(words, |word| word.parse().ok().map(Value::Duration))
    }),
    place("bytes", "bytes such as 01 FF, hexadecimal", bytes),
    place("entry", "an entry of an object such as 10F3:05", |words| {
        one(words, |word| entry(word).map(Value::Entry))
    }),
    place("entries", "entries such as 7000:01..06 or 7000:01 7000:02", entries),
    place("numbers", "PDO numbers such as 1601 1602, hexadecimal", numbers),
    place("event", "an event code of eight hexadecimal digits such as 85000000", |words| one(words, event)),
    place("fault", "a fault of a unit such as Processing (the reference lists them)", |words| {
        one(words, fault)
    }),
    place("pattern", "a pattern such as lit, not_lit, blinking", |words| one(words, pattern)),
    place("indicator", "RUN, ERR, L/A IN, L/A OUT, TS green or TS red", indicator),
    place("percent", "a number from 1 to 100 and %", percent),
    Place {
        name: "frames",
        meaning: "`the next 3`, `all`, `5 % of the`, `number 7 of the` or `numbers 3 to 9 of the`, and then `frames`, \
                  `process data frames` or `mailbox frames`",
        read: frames,
        fitting: |words| choice(words).map_or(0, |(_, length)| length),
    },
    place("variable", "a device variable such as N1_UINTs_01_M_to_C", |words| {
        one(words, |word| word.contains('_').then(|| Value::Variable(word.to_owned())))
    }),
    place(
        "controller",
        "`the master`, or `unit` and the number of the unit whose CPU Unit is meant",
        controller,
    ),
    place("name", "the name of a variable of a program, such as counter, Main.counter or timer.Q", |words| {
        one(words, |word| Some(Value::Name(word.to_owned())))
    }),
    place("program", "the path of a program, without spaces, such as programs/a-3-3.st", |words| {
        one(words, |word| Some(Value::Name(word.to_owned())))
    }),
    place(
        "value",
        "a value as Structured Text writes it, such as 5, 16#1F, TRUE, T#20ms or [1, 2, 13(0)]",
        |words| (!words.is_empty()).then(|| (Value::Text(words.join(" ")), words.len())),
    ),
    place("error", "the code of a user-defined error from 1 to 40000, such as 16#101", |words| {
        limited(words, 1, 40_000)
    }),
    place("position", "line and column, both from 1, such as 5:9", |words| one(words, position)),
];

fn one(words: &[&str], read: impl Fn(&str) -> Option<Value>) -> Option<(Value, usize)> {
    read(words.first()?).map(|value| (value, 1))
}

fn unit(words: &[&str]) -> Option<usize> {
    let [name, number, ..] = words else { return None };
    (*name == "unit").then_some(())?;
    number.parse::<usize>().ok()?.checked_sub(1)
}

fn units(words: &[&str]) -> Option<(Value, usize)> {
    match words {
        ["all", "units", ..] => Some((Value::Units(UnitSet::All), 2)),
        _ => unit(words).map(|at| (Value::Units(UnitSet::One(at)), 2)),
    }
}

fn controller(words: &[&str]) -> Option<(Value, usize)> {
    let found = match words {
        ["the", "master", ..] => Controller::Master,
        _ => Controller::Unit(unit(words)?),
    };
    Some((Value::Controller(found), 2))
}

fn position(word: &str) -> Option<Value> {
    let (line, column) = word.split_once(':')?;
    let from_1 = |digits: &str| digits.parse::<usize>().ok().filter(|&number| number > 0);
    Some(Value::Position((from_1(line)?, from_1(column)?)))
}

fn state(word: &str) -> Option<Value> {
    let state = match word {
        "INIT" => AlState::Init,
        "PRE-OP" => AlState::PreOp,
        "SAFE-OP" => AlState::SafeOp,
        "OP" => AlState::Op,
        "BOOT" => AlState::Boot,
        _ => AlState::from_bits(u16::try_from(number(word)?).ok().filter(|&bits| bits < 16)?),
    };
    Some(Value::State(state))
}

fn number(word: &str) -> Option<u64> {
    match word.strip_prefix("0x").or_else(|| word.strip_prefix("16#")) {
        Some(digits) => u64::from_str_radix(digits, 16).ok(),
        None => word.parse().ok(),
    }
}

fn limited(words: &[&str], least: u64, most: u64) -> Option<(Value, usize)> {
    one(words, |word| number(word).filter(|number| (least..=most).contains(number)).map(Value::Number))
}

fn hexadecimal(word: &str, digits: usize) -> Option<u64> {
    let bare = word.strip_prefix("0x").unwrap_or(word);
    (!bare.is_empty() && bare.len() <= digits).then(|| u64::from_str_radix(bare, 16).ok())?
}

fn all<T>(words: &[&str], read: impl Fn(&str) -> Option<T>) -> Option<Vec<T>> {
    (!words.is_empty()).then(|| words.iter().map(|word| read(word)).collect())?
}

fn bytes(words: &[&str]) -> Option<(Value, usize)> {
    let bytes = all(words, |word| hexadecimal(word, 2).map(|byte| byte as u8))?;
    Some((Value::Bytes(bytes), words.len()))
}

fn numbers(words: &[&str]) -> Option<(Value, usize)> {
    Some((Value::Numbers(all(words, |word| hexadecimal(word, 4))?), words.len()))
}

fn entry(word: &str) -> Option<(u16, u8)> {
    let (index, sub) = word.split_once(':')?;
    Some((hexadecimal(index, 4)? as u16, hexadecimal(sub, 2)? as u8))
}

fn entries(words: &[&str]) -> Option<(Value, usize)> {
    let lists = all(words, |word| match word.split_once("..") {
        None => entry(word).map(|entry| vec![entry]),
        Some((first, last)) => {
            let (index, first) = entry(first)?;
            let last = hexadecimal(last, 2)? as u8;
            (first <= last).then(|| (first..=last).map(|sub| (index, sub)).collect())
        }
    })?;
    Some((Value::Entries(lists.concat()), words.len()))
}

fn event(word: &str) -> Option<Value> {
    let code = (word.len() == 8).then(|| u32::from_str_radix(word, 16).ok())??;
    nx_ect101::Event::find(EventCode(code)).map(|event| Value::Event(event.code))
}

fn fault(word: &str) -> Option<Value> {
    Fault::ALL.into_iter().find(|fault| format!("{fault:?}") == word).map(Value::Fault)
}

fn pattern(word: &str) -> Option<Value> {
    Pattern::ALL.into_iter().find(|pattern| pattern.id() == word).map(Value::Pattern)
}

fn indicator(words: &[&str]) -> Option<(Value, usize)> {
    let (name, length) = match words {
        ["RUN", ..] => (IndicatorName::Run, 1),
        ["ERR", ..] => (IndicatorName::Err, 1),
        ["L/A", "IN", ..] => (IndicatorName::LinkIn, 2),
        ["L/A", "OUT", ..] => (IndicatorName::LinkOut, 2),
        ["TS", "green", ..] => (IndicatorName::TsGreen, 2),
        ["TS", "red", ..] => (IndicatorName::TsRed, 2),
        _ => return None,
    };
    Some((Value::Indicator(name), length))
}

fn percent(words: &[&str]) -> Option<(Value, usize)> {
    let (digits, length) = match words {
        [number, "%", ..] => (*number, 2),
        [word, ..] => (word.strip_suffix('%')?, 1),
        [] => return None,
    };
    let percent = digits.parse::<u8>().ok().filter(|percent| (1..=100).contains(percent))?;
    Some((Value::Percent(percent), length))
}

/// Which frames, and of which kind.
fn frames(words: &[&str]) -> Option<(Value, usize)> {
    let (choice, length) = choice(words)?;
    let (kind, more) = match words.get(length..)? {
        ["frames" | "frame", ..] => (FrameKind::Any, 1),
        ["process", "data", "frames" | "frame", ..] => (FrameKind::ProcessData, 3),
        ["mailbox", "frames" | "frame", ..] => (FrameKind::Mailbox, 2),
        _ => return None,
    };
    Some((Value::Frames((choice, kind)), length + more))
}

/// Numbers count from 1, the next frame.
fn choice(words: &[&str]) -> Option<(Choice, usize)> {
    match words {
        ["all", ..] => Some((Choice::All, 1)),
        ["the", "next", count, ..] => Some((Choice::Next(number(count)?), 3)),
        ["number", nth, "of", "the", ..] => {
            Some((Choice::Behind { skip: number(nth)?.checked_sub(1)?, count: 1 }, 4))
        }
        ["numbers", first, "to", last, "of", "the", ..] => {
            let (first, last) = (number(first)?, number(last)?);
            let count = last.checked_sub(first)? + 1;
            Some((Choice::Behind { skip: first.checked_sub(1)?, count }, 6))
        }
        _ => match percent(words)? {
            (Value::Percent(percent), length) => (words.get(length..length + 2)? == ["of", "the"])
                .then_some((Choice::Percent(percent), length + 2)),
            _ => None,
        },
    }
}
