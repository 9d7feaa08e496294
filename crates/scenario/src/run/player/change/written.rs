//! Bytes that an order writes, and bytes that a condition expects.

use wire::AlState;

use super::outcome::Outcome;
use super::reach::Reach;
use super::request::Request;
use crate::model::{Bytes, Entry, Quantity, WhichUnit};
use crate::run::check::register_bytes;
use crate::run::observed::Reading;

/// The request of the master: the state, and bit 4 for an acknowledge.
const AL_CONTROL: u16 = 0x0120;
const ACKNOWLEDGE: u8 = 0x10;
/// Objects of at most this length are numbers whose bytes do not depend on their type, unless they have a sign.
const INTEGER_BYTES_MAX: usize = 2;

/// Bytes at a place of a unit.
pub(super) struct BytesAt<'a> {
    pub(super) unit: &'a WhichUnit,
    pub(super) place: Place,
    pub(super) bytes: &'a Bytes,
}

/// A place of a unit.
#[derive(Clone, Copy)]
pub(super) enum Place {
    /// The outputs from this byte on.
    Outputs(u16),
    /// The registers from this one on.
    Register(u16),
    Entry(Entry),
    /// An object from this entry on.
    Object(Entry),
}

impl BytesAt<'_> {
    /// What becomes of a condition on these bytes if an order writes its own.
    pub(super) fn decides(&self, expected: &Self) -> Outcome {
        if self.unit != expected.unit {
            return Outcome::Open;
        }
        match (self.place, expected.place) {
            (Place::Outputs(at), Place::Outputs(first)) | (Place::Register(at), Place::Register(first)) => {
                self.compare(at, expected.bytes, first)
            }
            (Place::Entry(entry), Place::Entry(other)) if entry == other => {
                Outcome::of(self.bytes == expected.bytes)
            }
            (Place::Object(first), Place::Entry(other)) if first.index == other.index => {
                self.compare_in_object(first, other, &expected.bytes.0)
            }
            (Place::Outputs(_) | Place::Register(_) | Place::Entry(_) | Place::Object(_), _) => Outcome::Open,
        }
    }

    /// False if a byte that both have differs, true if all that are expected are written.
    fn compare(&self, at: u16, expected: &Bytes, first: u16) -> Outcome {
        let written = |place: usize| place.checked_sub(at.into()).and_then(|place| self.bytes.0.get(place));
        let pairs = || (usize::from(first)..).zip(&expected.0).map(|(place, byte)| (written(place), byte));
        if pairs().any(|(written, byte)| written.is_some_and(|written| written != byte)) {
            return Outcome::False;
        }
        if pairs().all(|(written, _)| written.is_some()) { Outcome::True } else { Outcome::Open }
    }

    /// The places of the other entries are not known here.
    fn compare_in_object(&self, first: Entry, other: Entry, expected: &[u8]) -> Outcome {
        let written = self.bytes.0.as_slice();
        if first.sub == other.sub {
            return Outcome::of(written.starts_with(expected));
        }
        Outcome::false_if(!written.windows(expected.len().max(1)).any(|part| part == expected))
    }

    /// The value of a quantity if all of its bytes are written.
    pub(super) fn reading(&self, of: &Quantity) -> Option<Reading> {
        let is_meant = |unit: &WhichUnit| unit == self.unit;
        let part = |at: u16, first: u16, length: usize| {
            let from = usize::from(first.checked_sub(at)?);
            let bytes = self.bytes.0.get(from..from.checked_add(length)?)?;
            Some(Reading::unsigned(bytes.to_vec()))
        };
        match (of, self.place) {
            (Quantity::Register { unit, register }, Place::Register(at)) if is_meant(unit) => {
                part(at, register.0, register_bytes(register.0))
            }
            (Quantity::OutputByte { unit, at: first }, Place::Outputs(at)) if is_meant(unit) => {
                part(at, *first, 1)
            }
            (Quantity::Object { unit, entry }, Place::Entry(own)) if is_meant(unit) && *entry == own => {
                let is_number = self.bytes.0.len() <= INTEGER_BYTES_MAX;
                let is_positive = self.bytes.0.last().is_some_and(|last| last & 0x80 == 0);
                (is_number && is_positive).then(|| Reading::unsigned(self.bytes.0.clone()))
            }
            (
                Quantity::Object { .. }
                | Quantity::Register { .. }
                | Quantity::OutputByte { .. }
                | Quantity::InputByte { .. }
                | Quantity::Outputs { .. }
                | Quantity::Inputs { .. }
                | Quantity::Variable { .. }
                | Quantity::ProgramVariable { .. }
                | Quantity::WorkingCounter { .. }
                | Quantity::Records { .. }
                | Quantity::Acts { .. }
                | Quantity::MeanPeriod { .. }
                | Quantity::LongestPeriod { .. }
                | Quantity::Emergencies { .. }
                | Quantity::Cycles,
                _,
            ) => None,
        }
    }

    /// The request for a state, if it is one.
    pub(super) fn request(&self) -> Option<Request<'_>> {
        let control = *self.bytes.0.first()?;
        let is_it = matches!(self.place, Place::Register(AL_CONTROL));
        is_it.then(|| Request {
            reach: Reach::one(self.unit),
            state: AlState::from_bits(u16::from(control) & 0x0F),
            acknowledges: control & ACKNOWLEDGE != 0,
        })
    }
}
