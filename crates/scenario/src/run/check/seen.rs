//! The actual state, for a failed expectation.

use crate::model::{Bytes, hex};

/// As text.
pub(in crate::run) type Seen = String;

pub(super) fn holds(condition: bool, seen: impl FnOnce() -> Seen) -> Result<(), Seen> {
    if condition { Ok(()) } else { Err(seen()) }
}

/// Whether the bytes from `first` on are these.
pub(super) fn lie_at(seen: &[u8], first: usize, wanted: &Bytes) -> Result<(), Seen> {
    let seen = seen.get(first..).unwrap_or_default();
    let head = seen.get(..wanted.0.len()).unwrap_or(seen);
    holds(head == wanted.0, || format!("they are {}", hex(head)))
}

pub(super) fn is_text(seen: Option<String>, wanted: &str) -> Result<(), Seen> {
    holds(seen.as_deref() == Some(wanted), || match seen {
        Some(seen) => format!("it is {seen}"),
        None => "it is not there".to_owned(),
    })
}

pub(super) fn truth(value: bool) -> &'static str {
    if value { "TRUE" } else { "FALSE" }
}

/// Whether the number of occurrences is the expected one; without a number at least one.
pub(super) fn is_often_enough(seen: u64, times: Option<u64>) -> bool {
    times.map_or(seen > 0, |times| seen == times)
}
