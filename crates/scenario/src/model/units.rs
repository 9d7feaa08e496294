//! The subject of a value: units by their numbers or names, ranges and lists of them, and the owner of a user program.

use core::fmt;
use core::ops::Range;
use std::collections::BTreeMap;

pub use plant::line::{CableNumber, NoUnitName, UnitName, UnitNumber, WhichUnit};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

/// Which units a value is about. In JSON `"all"`, the number or the name of a unit, `{ "from": 3, "to": 5 }`, or a list of
/// numbers, names and ranges; a unit whose name is `all` is in a list: `["all"]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum UnitSet {
    /// All of them.
    All,
    /// This one.
    One(WhichUnit),
    /// These, in this order, each of them once.
    Several(Vec<UnitSpan>),
}

/// A member of a list of units.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(
    untagged,
    expecting = "expected the number of a unit, its name, or a range such as { from = 3, to = 5 }"
)]
pub enum UnitSpan {
    /// One unit.
    One(WhichUnit),
    /// All from the first one to the last one.
    Range(UnitRange),
}

/// Units that follow each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "BTreeMap<String, UnitNumber>")]
pub struct UnitRange {
    /// The first one.
    pub from: UnitNumber,
    /// The last one.
    pub to: UnitNumber,
}

/// A table, so that a list of two numbers is no range.
impl TryFrom<BTreeMap<String, UnitNumber>> for UnitRange {
    type Error = &'static str;

    fn try_from(table: BTreeMap<String, UnitNumber>) -> Result<Self, Self::Error> {
        match (table.get("from"), table.get("to"), table.len()) {
            (Some(from), Some(to), 2) => Ok(Self { from: *from, to: *to }),
            _ => Err("a range has `from` and `to`"),
        }
    }
}

impl UnitSet {
    /// The units from one to another.
    #[must_use]
    pub fn range(from: UnitNumber, to: UnitNumber) -> Self {
        Self::Several(vec![UnitSpan::Range(UnitRange { from, to })])
    }

    /// Whether a unit of some line is in both.
    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::All, _) | (_, Self::All) => true,
            _ => self.positions(usize::MAX).any(|at| other.has(at)),
        }
    }

    /// The position of the unit that is the first one of them in the line.
    pub(crate) fn first(&self) -> usize {
        match self {
            Self::All => 0,
            Self::One(unit) => unit.position(),
            Self::Several(_) => self.positions(usize::MAX).min().unwrap_or(usize::MAX),
        }
    }

    pub(crate) fn has(&self, at: usize) -> bool {
        self.positions(at.saturating_add(1)).any(|position| position == at)
    }

    /// Positions of the units in a line of `count`, counted from 0. A name is at none of them.
    pub fn positions(&self, count: usize) -> impl Iterator<Item = usize> + '_ {
        let (first, spans): (Range<usize>, &[UnitSpan]) = match self {
            Self::All => (0..count, &[]),
            Self::One(unit) => (position_of(unit, count), &[]),
            Self::Several(spans) => (0..0, spans),
        };
        first.chain(spans.iter().flat_map(move |span| span.positions(count)))
    }
}

impl UnitSpan {
    fn positions(&self, count: usize) -> Range<usize> {
        match self {
            Self::One(unit) => position_of(unit, count),
            Self::Range(UnitRange { from, to }) => from.position()..to.number().min(count),
        }
    }
}

fn position_of(unit: &WhichUnit, count: usize) -> Range<usize> {
    let at = unit.position();
    at..at.saturating_add(1).min(count)
}

impl From<UnitNumber> for UnitSet {
    fn from(unit: UnitNumber) -> Self {
        Self::One(WhichUnit::Number(unit))
    }
}

impl From<WhichUnit> for UnitSet {
    fn from(unit: WhichUnit) -> Self {
        Self::One(unit)
    }
}

impl fmt::Display for UnitSet {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::All => formatter.write_str("all units"),
            Self::One(unit) => unit.fmt(formatter),
            Self::Several(spans) => {
                let words: Vec<String> = spans.iter().map(UnitSpan::word).collect();
                match words.split_last() {
                    Some((last, rest)) if !rest.is_empty() => {
                        write!(formatter, "units {} and {last}", rest.join(", "))
                    }
                    _ => write!(formatter, "units {}", words.concat()),
                }
            }
        }
    }
}

impl UnitSpan {
    fn word(&self) -> String {
        match self {
            Self::One(unit) => unit.word(),
            Self::Range(UnitRange { from, to }) => format!("{} to {}", from.number(), to.number()),
        }
    }
}

/// The word for all units.
const ALL: &str = "all";

impl Serialize for UnitSet {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::All => ALL.serialize(serializer),
            Self::One(WhichUnit::Named(name)) if name.as_str() == ALL => [ALL].serialize(serializer),
            Self::One(unit) => unit.serialize(serializer),
            Self::Several(spans) => match spans.as_slice() {
                [range @ UnitSpan::Range(_)] => range.serialize(serializer),
                spans => spans.serialize(serializer),
            },
        }
    }
}

/// The form of a set of units.
#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "expected \"all\", the number of a unit, from 1, its name, a range such as { from = 3, to = 5 }, or a list of these"
)]
enum Form {
    One(UnitSpan),
    Several(Vec<UnitSpan>),
}

impl<'de> Deserialize<'de> for UnitSet {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match Form::deserialize(deserializer)? {
            Form::One(UnitSpan::One(WhichUnit::Named(name))) if name.as_str() == ALL => Ok(Self::All),
            Form::One(UnitSpan::One(unit)) => Ok(Self::One(unit)),
            Form::One(range) => Ok(Self::Several(vec![range])),
            Form::Several(mut spans) => match (spans.pop(), spans.is_empty()) {
                (None, _) => Err(de::Error::custom("a list without units: name at least one, or \"all\"")),
                (Some(UnitSpan::One(unit)), true) => Ok(Self::One(unit)),
                (Some(last), _) => {
                    spans.push(last);
                    Ok(Self::Several(spans))
                }
            },
        }
    }
}

/// The owner of a user program. In JSON `"master"`, or `{ "unit": 1 }`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Controller {
    /// The master's own.
    Master,
    /// That of the CPU Unit of this unit.
    Unit(WhichUnit),
}

impl fmt::Display for Controller {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Master => formatter.write_str("the master"),
            Self::Unit(unit) => unit.fmt(formatter),
        }
    }
}
