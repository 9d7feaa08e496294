//! Numbers and codes, each with its spelling.

use core::fmt;
use core::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::spelling::{NotAValue, TextOrNumber, by_text, number};

/// A number that is written in hexadecimal, with all its digits: `0x001B`. A plain number is also accepted in
/// JSON and TOML.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Hex<T>(pub T);

macro_rules! hex {
    ($($type:ty, $width:literal, $expected:literal;)*) => {$(
        impl fmt::Display for Hex<$type> {
            fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(formatter, concat!("{:#0", $width, "X}"), self.0)
            }
        }

        impl Serialize for Hex<$type> {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.collect_str(self)
            }
        }

        impl<'de> Deserialize<'de> for Hex<$type> {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                deserializer.deserialize_any(TextOrNumber {
                    text: |text| <$type>::try_from(number(text)?).ok().map(Hex),
                    number: |number| <$type>::try_from(number).ok().map(Hex),
                    expected: $expected,
                })
            }
        }
    )*};
}

hex! {
    u8, "4", "a number from 0 to 0xFF";
    u16, "6", "a number from 0 to 0xFFFF";
    u32, "10", "a number from 0 to 0xFFFFFFFF";
}

/// The code of an event, as support software shows it: `85000000`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EventCode(pub u32);

impl fmt::Display for EventCode {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{:08X}", self.0)
    }
}

impl FromStr for EventCode {
    type Err = NotAValue;

    fn from_str(text: &str) -> Result<Self, NotAValue> {
        let code = if text.len() == 8 { u32::from_str_radix(text, 16).ok() } else { None };
        code.map(Self).ok_or(NotAValue("an event code of eight hexadecimal digits such as 85000000"))
    }
}

/// The code of a user-defined error, 1 to 40,000, in the notation of Structured Text: `16#101`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct UserErrorCode(pub u16);

impl fmt::Display for UserErrorCode {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "16#{:X}", self.0)
    }
}

impl Serialize for UserErrorCode {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for UserErrorCode {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(TextOrNumber {
            text: |text| u16::try_from(number(text)?).ok().map(Self),
            number: |number| u16::try_from(number).ok().map(Self),
            expected: "the code of a user-defined error, such as \"16#101\"",
        })
    }
}

by_text! { EventCode }
