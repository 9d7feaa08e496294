//! The number of a code, and what it can be: that depends on how many digits it has.

use std::fmt;

use nx_ect101::{Event, EventCode};
use wire::{AlStatusCode, SdoAbort};

use super::Code;
use super::{al_status, emergency};

/// Low word of a diagnosis code whose high word is an emergency error code (manual, A-6-4).
const DIAGNOSIS_CODE: u32 = 0xE800;

/// A number of a width.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    /// Up to four digits.
    Word(u16),
    /// Five to eight digits.
    Double(u32),
}

impl Number {
    /// The number in `text`; none if it is something else than hexadecimal digits.
    pub(super) fn parse(text: &str) -> Option<Self> {
        let digits = text.trim().to_ascii_lowercase().replace('_', "");
        let digits = digits.strip_prefix("0x").unwrap_or(&digits);
        let digits = digits.strip_suffix("hex").unwrap_or(digits).trim_end();
        if !(1..=8).contains(&digits.len()) || !digits.bytes().all(|digit| digit.is_ascii_hexdigit()) {
            return None;
        }
        if digits.len() <= 4 {
            return u16::from_str_radix(digits, 16).ok().map(Self::Word);
        }
        u32::from_str_radix(digits, 16).ok().map(Self::Double)
    }

    pub(super) const fn value(self) -> u32 {
        match self {
            Self::Word(value) => value as u32,
            Self::Double(value) => value,
        }
    }

    /// What codes of this width are.
    pub(super) const fn kinds(self) -> &'static str {
        match self {
            Self::Word(_) => "AL status code, emergency error code or text ID",
            Self::Double(_) => "event code, SDO abort code or diagnosis code",
        }
    }

    /// What it can be, known or not.
    pub(super) fn codes(self) -> impl Iterator<Item = Code> {
        let codes = match self {
            Self::Word(value) => vec![
                Code::AlStatus(AlStatusCode(value)),
                Code::Emergency(value),
                // A text ID: the upper half of an event code.
                Code::Event(EventCode(u32::from(value) << 16)),
            ],
            Self::Double(value) => {
                let diagnosis = (value & 0xFFFF == DIAGNOSIS_CODE).then_some((value >> 16) as u16);
                let codes = [Code::Event(EventCode(value)), Code::Abort(SdoAbort(value))];
                codes.into_iter().chain(diagnosis.map(Code::Emergency)).collect()
            }
        };
        codes.into_iter()
    }

    /// All codes that are known in this width, with their numbers.
    pub(super) fn known(self) -> Box<dyn Iterator<Item = (u32, Code)>> {
        match self {
            Self::Word(_) => Box::new(words()),
            Self::Double(_) => Box::new(doubles()),
        }
    }
}

fn words() -> impl Iterator<Item = (u32, Code)> {
    let al_status = al_status::known().map(|code| (u32::from(code.0), Code::AlStatus(code)));
    let emergency = emergency::known().map(|code| (u32::from(code), Code::Emergency(code)));
    al_status.chain(emergency)
}

fn doubles() -> impl Iterator<Item = (u32, Code)> {
    let events = Event::all().iter().map(|event| (event.code.0, Code::Event(event.code)));
    events.chain(SdoAbort::TABLE.iter().map(|row| (row.code.0, Code::Abort(row.code))))
}

impl fmt::Display for Number {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Word(value) => write!(formatter, "0x{value:04X}"),
            Self::Double(value) => write!(formatter, "0x{:04X}_{:04X}", value >> 16, value & 0xFFFF),
        }
    }
}
