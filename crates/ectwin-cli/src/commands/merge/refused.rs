//! Results that cannot be merged.

use crate::failure::Failure;

pub(super) fn refused(message: &str, help: &str) -> Failure {
    Failure::Refused { message: message.to_owned(), help: help.to_owned() }
}
