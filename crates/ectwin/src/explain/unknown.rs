//! The message for an unknown text: similar names, and the existing ones.

use super::number::Number;
use super::{Explanation, Unexplained, names};

/// Examples of names, to show that more words are needed.
const SHOWN_PARTS: usize = 3;

const KNOWN: &str = "codes and indexes in hexadecimal digits, such as 391E0000 (event code), 0x001B (AL status code), 0xA000 \
    (emergency error code), 0x0602_0000 (SDO abort code), 0x1018 or 10F3:05 (objects), NX 6000:01 (NX \
    objects), 0x0130 (register); indicators and \
    their patterns, such as ERR; names of events, objects, entries, I/O ports and registers; functions, blocks, data types \
    and variables of Structured Text, such as CTU or P_PRGER; ErrorIDs, such as 16#2C00; keys of the unit file, such as fail_soft; \
    setting rules, such as sm_order; faults of scenarios, such as IoCommunications; counters of `run`, such as late_polls; words of the \
    glossary, such as watchdog";

/// A number that is not a code, object or register.
pub(super) fn number(number: Number, near: Option<Explanation>) -> Unexplained {
    let near = near.map_or_else(String::new, |near| format!("; is {}, {}, meant?", near.subject, near.name));
    Unexplained::new(format!("{number} is not known as {}{near}", number.kinds()), number.there_is())
}

/// A text that is neither a number nor a name.
pub(super) fn name(text: &str) -> Unexplained {
    let near = names::near(text).map_or_else(String::new, |near| format!("; is `{near}` meant?"));
    Unexplained::new(format!("`{}` is not known{near}", text.escape_debug()), KNOWN)
}

/// A text that is longer than every name.
pub(super) fn too_long(text: &str) -> Unexplained {
    Unexplained::new(format!("`{}` is not known", user_file::shown(text)), KNOWN)
}

/// Words that occur in more names than can be shown.
pub(super) fn part(text: &str, meanings: &[Explanation]) -> Unexplained {
    let message = format!("`{}` is a part of {} names", text.escape_debug(), meanings.len());
    let some = meanings.iter().take(SHOWN_PARTS).map(|known| format!("`{}`", known.name));
    let some = some.collect::<Vec<_>>().join(", ");
    Unexplained::new(message, format!("give more words of the name, such as {some}"))
}
