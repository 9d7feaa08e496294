//! The number of a code, and its possible meanings, which depend on the number of digits.

use std::fmt;

use unit_model::EventCode;
use wire::{AlStatusCode, ObjectIndex, SdoAbort};

use super::tables::tables;
use super::{Subject, al_status_codes, emergency};

/// Low word of a diagnosis code whose high word is an emergency error code (manual, A-6-4).
const DIAGNOSIS_CODE: u32 = 0xE800;

/// A number with its width.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    /// Up to four digits.
    Word(u16),
    /// Five to eight digits.
    Double(u32),
}

impl Number {
    /// The number in `text`; none if it contains other characters than hexadecimal digits.
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

    /// The kinds of codes with this width.
    pub(super) const fn kinds(self) -> &'static str {
        match self {
            Self::Word(_) => "AL status code, emergency error code, text ID, object or register",
            Self::Double(_) => "event code, SDO abort code or diagnosis code",
        }
    }

    /// Its possible meanings, known or not.
    pub(super) fn subjects(self) -> Vec<Subject> {
        match self {
            Self::Word(value) => vec![
                Subject::AlStatus(AlStatusCode(value)),
                Subject::Emergency(value),
                // A text ID: the upper half of an event code.
                Subject::Event(EventCode(u32::from(value) << 16)),
                Subject::Object(ObjectIndex(value)),
                Subject::NxObject(ObjectIndex(value)),
                Subject::Register(value),
            ],
            Self::Double(value) => {
                let diagnosis = (value & 0xFFFF == DIAGNOSIS_CODE).then_some((value >> 16) as u16);
                let codes = [Subject::Event(EventCode(value)), Subject::Abort(SdoAbort(value))];
                codes.into_iter().chain(diagnosis.map(Subject::Emergency)).collect()
            }
        }
    }

    /// The known code that is higher or lower by one, or, for a long one, differs in one digit; none if there is none.
    pub(super) fn near(self) -> Option<Subject> {
        let (own, may_differ_in_a_digit) = match self {
            Self::Word(value) => (value.into(), false),
            Self::Double(value) => (value, true),
        };
        let is_near = |known: u32| {
            known.abs_diff(own) <= 1 || may_differ_in_a_digit && differing_digits(known, own) == 1
        };
        let near = self.known().into_iter().filter(|(known, _)| is_near(*known));
        near.min_by_key(|(known, _)| known.abs_diff(own)).map(|(_, code)| code)
    }

    /// The codes with this width.
    pub(super) fn there_is(self) -> String {
        match self {
            Self::Word(_) => {
                let objects = tables().objects.iter().map(|object| object.index.0.into()).collect();
                let nx_objects = tables().nx_objects.iter().map(|object| object.index.0.into()).collect();
                [
                    ("AL status codes", al_status_codes::known().map(|code| code.0.into()).collect()),
                    ("emergency error codes", emergency::known().map(u32::from).collect()),
                    ("objects", objects),
                    ("NX objects", nx_objects),
                ]
                .map(|(kind, codes)| format!("{kind}: {}", runs(codes, 4)))
                .join("; ")
            }
            Self::Double(_) => {
                let events = tables().events.iter().map(|event| event.code.0).collect();
                let aborts = SdoAbort::TABLE.iter().map(|row| row.code.0).collect();
                format!("event codes: {}; SDO abort codes: {}", runs(events, 8), runs(aborts, 8))
            }
        }
    }

    /// All known codes with this width, with their numbers.
    fn known(self) -> Vec<(u32, Subject)> {
        match self {
            Self::Word(_) => {
                let al_status = al_status_codes::known().map(|code| (code.0.into(), Subject::AlStatus(code)));
                let emergency = emergency::known().map(|code| (code.into(), Subject::Emergency(code)));
                al_status.chain(emergency).collect()
            }
            Self::Double(_) => {
                let events = tables().events.iter().map(|event| (event.code.0, Subject::Event(event.code)));
                let aborts = SdoAbort::TABLE.iter().map(|row| (row.code.0, Subject::Abort(row.code)));
                events.chain(aborts).collect()
            }
        }
    }
}

fn differing_digits(one: u32, other: u32) -> usize {
    (0..8).filter(|digit| (one ^ other) >> (4 * digit) & 0xF != 0).count()
}

/// Codes in ascending order, consecutive ones combined: `0001, 0011-001F`.
fn runs(mut codes: Vec<u32>, digits: usize) -> String {
    codes.sort_unstable();
    codes.dedup();
    let runs = codes.chunk_by(|one, next| one + 1 == *next);
    let shown = runs.filter_map(|run| match run {
        [only] => Some(format!("{only:0digits$X}")),
        [first, .., last] => Some(format!("{first:0digits$X}-{last:0digits$X}")),
        [] => None,
    });
    shown.collect::<Vec<_>>().join(", ")
}

impl fmt::Display for Number {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Word(value) => write!(formatter, "0x{value:04X}"),
            Self::Double(value) => write!(formatter, "0x{:04X}_{:04X}", value >> 16, value & 0xFFFF),
        }
    }
}
