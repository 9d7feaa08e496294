//! The SDO that was ordered last, and its answer: "the last SDO" in sentences.

use crate::model::hex;

/// The value that was read, empty after a write, or the abort code.
pub(super) type SdoResult = Result<Vec<u8>, u32>;

/// The number of an SDO that a step orders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SdoNumber(u64);

/// The state of the last SDO.
#[derive(Debug, Default)]
pub(crate) struct LastSdo {
    ordered: u64,
    /// It has been ordered, and neither answered nor dropped.
    awaited: Option<SdoNumber>,
    result: Option<SdoResult>,
}

impl LastSdo {
    /// A step orders an SDO. From now on answers to older ones are ignored.
    pub(super) const fn order(&mut self) -> SdoNumber {
        self.ordered += 1;
        let number = SdoNumber(self.ordered);
        self.awaited = Some(number);
        number
    }

    /// An SDO is answered; without a number it is one that the master sends on the way to a state.
    pub(super) fn answer(&mut self, number: Option<SdoNumber>, result: SdoResult) {
        if self.awaited.is_none() || self.awaited == number {
            (self.awaited, self.result) = (None, Some(result));
        }
    }

    /// An SDO is dropped. If it is the last one, it has no answer, and never gets one.
    pub(super) fn give_up(&mut self, number: Option<SdoNumber>) {
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
