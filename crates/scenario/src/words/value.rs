//! The values of the places of a sentence, and their notation.

use core::fmt;

use time::Duration;
use wire::AlState;

use crate::model::{
    Amount, Bytes, CableNumber, Choice, Controller, Delay, Direction, Entry, EventCode, FaultName, FrameKind,
    Frames, Hex, IndicatorName, MasterAct, Position, Quantity, StateName, UnitSet, UserErrorCode, Way,
    WhichUnit,
};

/// The value of a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Value {
    /// `unit 2`, `unit Conveyor`, `units 3 to 5`, `units 2, 4 and 5`, `all units`.
    Units(UnitSet),
    /// `unit 2`, `unit Conveyor`.
    Unit(WhichUnit),
    /// `SAFE-OP`.
    State(AlState),
    /// `12`, `0x0C`.
    Number(u64),
    /// The same, written in hexadecimal with a fixed number of digits.
    Hexadecimal(u64, usize),
    /// `1.5ms`.
    Duration(Duration),
    /// `01 02 0x03`.
    Bytes(Bytes),
    /// `10F3:05`.
    Entry(Entry),
    /// `7000:01 7000:02`, `7000:01..06`.
    Entries(Vec<Entry>),
    /// `1601 1602`, hexadecimal.
    Numbers(Vec<Hex<u16>>),
    /// `85000000`.
    Event(EventCode),
    /// `RUN`.
    Indicator(IndicatorName),
    /// `5 %`.
    Percent(u8),
    /// `5 ‰`.
    PerMille(u16),
    /// `the next 3 frames`, `5 % of the mailbox frames of unit 2`.
    Frames(Frames),
    /// `on cable 3 on the way back`; nothing between master and line outward.
    Way(Way),
    /// `on the way back`; nothing outward.
    Direction(Direction),
    /// `1ms to 3ms`.
    Delay(Delay),
    /// `for 3s`; nothing without an end.
    Lasting(Option<Duration>),
    /// `called storm`; nothing without a name.
    Called(Option<FaultName>),
    /// `storm`.
    FaultName(FaultName),
    /// `the master`, `unit 2`.
    Controller(Controller),
    /// `16#101`, the code of a user-defined error.
    UserError(UserErrorCode),
    /// One word or all words to the end: the name of a fault or a variable, a value of a variable.
    Text(String),
    /// `5:9`, line and column.
    Position(Position),
    /// `5`, `T#20ms`, a number that is compared.
    Amount(Amount),
    /// `object 2002:01 of unit 1`, what has a value. Its row has the words.
    Quantity(Quantity),
    /// `sent outputs to unit 1`, what a master has done. Its row has the words.
    Act(MasterAct),
    /// `(unit 1 is in OP; unit 2 is in OP)`: sentences inside a sentence.
    Group(Vec<String>),
}

impl fmt::Display for Value {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Units(units) => units.fmt(formatter),
            Self::Unit(unit) => unit.fmt(formatter),
            Self::State(state) => StateName(*state).fmt(formatter),
            Self::Number(number) => number.fmt(formatter),
            Self::Hexadecimal(number, digits) => write!(formatter, "0x{number:0digits$X}"),
            Self::Duration(duration) => duration.fmt(formatter),
            Self::Bytes(bytes) => bytes.fmt(formatter),
            Self::Entry(entry) => entry.fmt(formatter),
            Self::Entries(entries) => formatter.write_str(&ranges(entries)),
            Self::Numbers(numbers) => {
                let words: Vec<String> = numbers.iter().map(|number| format!("{:04X}", number.0)).collect();
                formatter.write_str(&words.join(" "))
            }
            Self::Event(event) => event.fmt(formatter),
            Self::Indicator(indicator) => indicator.fmt(formatter),
            Self::Percent(percent) => write!(formatter, "{percent} %"),
            Self::PerMille(per_mille) => write!(formatter, "{per_mille} ‰"),
            Self::Frames(frames) => write_frames(frames, formatter),
            Self::Way(Way { cable: Some(cable), direction }) => {
                write!(formatter, "on {cable}")?;
                match direction_words(*direction) {
                    "" => Ok(()),
                    words => write!(formatter, " {words}"),
                }
            }
            Self::Way(Way { cable: None, direction }) | Self::Direction(direction) => {
                formatter.write_str(direction_words(*direction))
            }
            Self::Delay(delay) => delay.fmt(formatter),
            Self::Lasting(Some(time)) => write!(formatter, "for {time}"),
            Self::Called(Some(name)) => write!(formatter, "called {name}"),
            Self::Lasting(None) | Self::Called(None) => Ok(()),
            Self::FaultName(name) => name.fmt(formatter),
            Self::Controller(controller) => controller.fmt(formatter),
            Self::UserError(code) => code.fmt(formatter),
            Self::Text(text) => formatter.write_str(text),
            Self::Position(position) => position.fmt(formatter),
            Self::Amount(amount) => amount.fmt(formatter),
            Self::Quantity(quantity) => write!(formatter, "{quantity:?}"),
            Self::Act(act) => write!(formatter, "{act:?}"),
            Self::Group(sentences) => write!(formatter, "({})", sentences.join("; ")),
        }
    }
}

/// Entries that follow each other become one range.
fn ranges(entries: &[Entry]) -> String {
    let follows = |before: &Entry, next: &Entry| {
        before.index == next.index && before.sub.checked_add(1) == Some(next.sub)
    };
    let words = entries.chunk_by(follows).map(|run| match run {
        [first, .., last] => format!("{first}..{:02X}", last.sub),
        _ => run.iter().map(Entry::to_string).collect(),
    });
    words.collect::<Vec<_>>().join(" ")
}

fn write_frames(frames: &Frames, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
    match frames.choice {
        Choice::All => formatter.write_str("all"),
        Choice::Next(count) => write!(formatter, "the next {count}"),
        Choice::Percent(percent) => write!(formatter, "{percent} % of the"),
        Choice::PerMille(per_mille) => write!(formatter, "{per_mille} ‰ of the"),
        Choice::Every(period) => write!(formatter, "every {period}{} of the", ordinal_ending(period)),
        Choice::Behind { skip, count: 1 } => write!(formatter, "number {} of the", skip.saturating_add(1)),
        Choice::Behind { skip, count } => {
            let first = skip.saturating_add(1);
            write!(formatter, "numbers {first} to {} of the", skip.saturating_add(count))
        }
    }?;
    match (frames.kind, frames.kind.command()) {
        (_, Some((_, name))) => write!(formatter, " {name} frames"),
        (FrameKind::ProcessData, _) => formatter.write_str(" process data frames"),
        (FrameKind::Mailbox, _) => formatter.write_str(" mailbox frames"),
        (FrameKind::Sii, _) => formatter.write_str(" SII frames"),
        (_, None) => formatter.write_str(" frames"),
    }?;
    match &frames.unit {
        Some(unit) => write!(formatter, " of {unit}"),
        None => Ok(()),
    }
}

/// `1st`, `2nd`, `3rd`, `11th`.
pub(super) const fn ordinal_ending(number: u64) -> &'static str {
    match (number % 10, number % 100) {
        (_, 11..=13) => "th",
        (1, _) => "st",
        (2, _) => "nd",
        (3, _) => "rd",
        _ => "th",
    }
}

const fn direction_words(direction: Direction) -> &'static str {
    match direction {
        Direction::Outward => "",
        Direction::Back => "on the way back",
    }
}

/// A field of a typed value, as the value of a place.
pub(crate) trait Field: Sized {
    /// The field from the value of a place; none if the place reads another kind.
    fn of(value: &Value) -> Option<Self>;
    /// The value that is written at the place.
    fn value(&self) -> Value;
}

macro_rules! fields {
    ($($type:ty: $variant:ident;)*) => {$(
        impl Field for $type {
            fn of(value: &Value) -> Option<Self> {
                match value {
                    Value::$variant(field) => Some(field.clone()),
                    _ => None,
                }
            }

            fn value(&self) -> Value {
                Value::$variant(self.clone())
            }
        }
    )*};
}

fields! {
    UnitSet: Units;
    WhichUnit: Unit;
    AlState: State;
    Duration: Duration;
    Bytes: Bytes;
    Entry: Entry;
    Vec<Entry>: Entries;
    Vec<Hex<u16>>: Numbers;
    EventCode: Event;
    IndicatorName: Indicator;
    Frames: Frames;
    Way: Way;
    Direction: Direction;
    Delay: Delay;
    Option<Duration>: Lasting;
    Option<FaultName>: Called;
    FaultName: FaultName;
    Controller: Controller;
    UserErrorCode: UserError;
    String: Text;
    Position: Position;
    Amount: Amount;
    Quantity: Quantity;
    MasterAct: Act;
}

macro_rules! numbers {
    ($($type:ty)*) => {$(
        impl Field for $type {
            fn of(value: &Value) -> Option<Self> {
                match value {
                    Value::Number(number) => Self::try_from(*number).ok(),
                    _ => None,
                }
            }

            fn value(&self) -> Value {
                Value::Number(u64::from(*self))
            }
        }

        impl Field for Hex<$type> {
            fn of(value: &Value) -> Option<Self> {
                <$type>::of(value).map(Hex)
            }

            fn value(&self) -> Value {
                Value::Hexadecimal(u64::from(self.0), 2 * size_of::<$type>())
            }
        }
    )*};
}

numbers! { u8 u16 u32 u64 }

impl Field for CableNumber {
    fn of(value: &Value) -> Option<Self> {
        u16::of(value).and_then(Self::new)
    }

    fn value(&self) -> Value {
        self.number().value()
    }
}
