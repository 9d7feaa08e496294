//! The SDO that was ordered last, and its answer: "the last SDO" in sentences.

use crate::model::{WhichUnit, hex};

/// The value that was read, empty after a write, or the abort code.
pub(super) type SdoResult = Result<Vec<u8>, u32>;

/// The number of an SDO that a step orders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SdoNumber(u64);

/// The last SDO of all units, and that of each unit.
#[derive(Debug)]
pub(crate) struct LastSdos {
    ordered: u64,
    of_all: LastSdo,
    of_each: Vec<LastSdo>,
}

impl LastSdos {
    /// For this number of units.
    pub(super) fn of(units: usize) -> Self {
        let of_each = (0..units).map(|_| LastSdo::default()).collect();
        Self { ordered: 0, of_all: LastSdo::default(), of_each }
    }

    /// A step orders an SDO of a unit.
    pub(super) fn order(&mut self, unit: usize) -> SdoNumber {
        self.ordered += 1;
        let number = SdoNumber(self.ordered);
        self.concerned(unit).for_each(|sdo| sdo.order(number));
        number
    }

    /// An SDO of a unit is answered; without a number it is one that the master sends on the way to a state.
    pub(super) fn answer(&mut self, unit: usize, number: Option<SdoNumber>, result: &SdoResult) {
        self.concerned(unit).for_each(|sdo| sdo.answer(number, result));
    }

    /// An SDO of a unit is dropped.
    pub(super) fn give_up(&mut self, unit: usize, number: Option<SdoNumber>) {
        self.concerned(unit).for_each(|sdo| sdo.give_up(number));
    }

    fn concerned(&mut self, unit: usize) -> impl Iterator<Item = &mut LastSdo> {
        core::iter::once(&mut self.of_all).chain(self.of_each.get_mut(unit))
    }

    /// That of a unit, which is there; without a unit that of all.
    pub(crate) fn get(&self, unit: Option<&WhichUnit>) -> &LastSdo {
        unit.and_then(|unit| self.of_each.get(unit.position())).unwrap_or(&self.of_all)
    }
}

/// The state of the last SDO.
#[derive(Debug, Default)]
pub(crate) struct LastSdo {
    /// It has been ordered, and neither answered nor dropped.
    awaited: Option<SdoNumber>,
    result: Option<SdoResult>,
}

impl LastSdo {
    /// A step orders an SDO. From now on answers to older ones are ignored.
    const fn order(&mut self, number: SdoNumber) {
        self.awaited = Some(number);
    }

    /// An SDO is answered. Without a number it is one that the master sends on the way to a state, which no step has
    /// ordered.
    fn answer(&mut self, number: Option<SdoNumber>, result: &SdoResult) {
        if number.is_some() && self.awaited == number {
            (self.awaited, self.result) = (None, Some(result.clone()));
        }
    }

    /// An SDO is dropped. If it is the last one, it has no answer, and never gets one.
    fn give_up(&mut self, number: Option<SdoNumber>) {
        if number.is_some() && self.awaited == number {
            (self.awaited, self.result) = (None, None);
        }
    }

    /// The answer; none before it is received.
    pub(crate) const fn result(&self) -> Option<&SdoResult> {
        if self.awaited.is_some() { None } else { self.result.as_ref() }
    }

    pub(crate) fn words(&self) -> String {
        match self.result() {
            Some(result) => words(result),
            None if self.awaited.is_some() => "the last SDO is not answered yet".to_owned(),
            None => "no SDO was answered".to_owned(),
        }
    }
}

fn words(result: &SdoResult) -> String {
    match result {
        Ok(value) if value.is_empty() => "the last SDO was taken".to_owned(),
        Ok(value) => format!("the last SDO gave {}", hex(value)),
        Err(code) => format!("the last SDO was refused with {code:#010X}"),
    }
}
