//! What `ectwin ctl` prints of an answer.

use serde::Serialize;

use crate::failure::Failure;
use crate::output;

/// A result in its two forms.
pub(super) struct Shown {
    document: String,
    text: String,
}

impl Shown {
    pub(super) fn of(document: &impl Serialize, text: String) -> Result<Self, Failure> {
        Ok(Self { document: output::json(document)?, text })
    }

    pub(super) fn print(&self, json: bool) -> Result<(), Failure> {
        if json { output::print(self.document.as_bytes()) } else { output::print_text(&self.text) }
    }
}
