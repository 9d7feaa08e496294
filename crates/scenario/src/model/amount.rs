//! Amounts of comparisons: numbers and times in the notation of Structured Text.

use core::cmp::Ordering;
use core::fmt;
use core::str::FromStr;

use plc::{Elementary, VariableType};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::spelling::{NotAValue, TextOrNumber, number};

/// An amount as written: `5`, `-3`, `0x1F`, `16#1F`, `1.5`, `T#20ms`. In JSON and TOML a text, or a number.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Amount {
    text: String,
}

/// The value of an amount.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Number {
    /// A whole number; of a time its nanoseconds.
    Whole(i128),
    /// A real number.
    Real(f64),
}

impl Number {
    /// The number of a text in the notation of Structured Text; none if it is something else, such as TRUE.
    pub(crate) fn of(text: &str) -> Option<Self> {
        let (digits, sign) = text.strip_prefix('-').map_or((text, 1), |digits| (digits, -1));
        if let Some(whole) = number(digits).filter(|_| !digits.starts_with('+')) {
            return Some(Self::Whole(i128::from(whole) * sign));
        }
        if text.contains('#') {
            return Self::of_time(text);
        }
        let is_real = digits.starts_with(|first: char| first.is_ascii_digit()) && digits.contains('.');
        is_real.then(|| text.parse().ok().map(Self::Real))?
    }

    /// `T#20ms`: nanoseconds.
    fn of_time(text: &str) -> Option<Self> {
        let bytes = VariableType::single(Elementary::Time).parse(text).ok()?;
        Some(Self::Whole(i64::from_le_bytes(bytes.try_into().ok()?).into()))
    }

    pub(crate) fn compare(self, other: Self) -> Option<Ordering> {
        match (self, other) {
            (Self::Whole(this), Self::Whole(other)) => Some(this.cmp(&other)),
            (this, other) => this.as_real().partial_cmp(&other.as_real()),
        }
    }

    fn as_real(self) -> f64 {
        match self {
            Self::Whole(whole) => whole as f64,
            Self::Real(real) => real,
        }
    }
}

impl fmt::Display for Number {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Whole(whole) => whole.fmt(formatter),
            Self::Real(real) => real.fmt(formatter),
        }
    }
}

impl Amount {
    /// Its value.
    pub(crate) fn number(&self) -> Number {
        // The text was read as a number.
        Number::of(&self.text).unwrap_or(Number::Whole(0))
    }

    /// Whether it is a time.
    pub(crate) fn is_time(&self) -> bool {
        Number::of_time(&self.text).is_some()
    }
}

impl From<u64> for Amount {
    fn from(number: u64) -> Self {
        Self { text: number.to_string() }
    }
}

impl fmt::Display for Amount {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.text)
    }
}

impl FromStr for Amount {
    type Err = NotAValue;

    fn from_str(text: &str) -> Result<Self, NotAValue> {
        let is_one_word = !text.contains(char::is_whitespace);
        let number = Number::of(text).filter(|_| is_one_word);
        number
            .map(|_| Self { text: text.to_owned() })
            .ok_or(NotAValue("a number or a time such as 5, 0x1F, 1.5 or T#20ms"))
    }
}

impl Serialize for Amount {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Amount {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(TextOrNumber {
            text: |text| text.parse().ok(),
            number: |number| Some(Self::from(number)),
            expected: "a number or a time, such as 5, \"-3\", \"1.5\" or \"T#20ms\"",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amounts_compare_as_numbers() {
        let compare = |this: &str, other: &str| {
            let [this, other] =
                [this, other].map(|text| Number::of(text).unwrap_or_else(|| panic!("{text}")));
            this.compare(other)
        };
        for (less, more) in [
            ("-3", "2"),
            ("9", "10"),
            ("0x0F", "16"),
            ("16#1F", "32"),
            ("1.5", "2"),
            ("-0.5", "0"),
            ("T#999us", "T#1ms"),
            ("18446744073709551614", "18446744073709551615"),
        ] {
            assert_eq!(
                (compare(less, more), compare(more, less)),
                (Some(Ordering::Less), Some(Ordering::Greater))
            );
        }
        assert_eq!(compare("T#1.5s", "T#1500ms"), Some(Ordering::Equal));
        for text in ["", "-", "--1", "+1", "TRUE", "1 2", "5ms", "0x", "NaN", "inf", "'5'", "[1]", "T#"] {
            assert!(text.parse::<Amount>().is_err(), "{text}");
        }
    }
}
