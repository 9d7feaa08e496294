//! Kinds as words before a name or a number: `NX 6000:01`, `event 391E0000`, `AL status code 1B`.

use super::{DocumentedKind, Subject};

/// The words of a kind, and the included meanings.
pub(super) struct Kind {
    words: &'static str,
    pub(super) includes: fn(&Subject) -> bool,
}

const fn kind(words: &'static str, includes: fn(&Subject) -> bool) -> Kind {
    Kind { words, includes }
}

/// Longer words come before words that they begin with.
#[rustfmt::skip]
const KINDS: &[Kind] = &[
    kind("nx object", is_nx_object),
    kind("nx", is_nx_object),
    kind("coe object", is_object),
    kind("coe", is_object),
    kind("object", |subject| is_object(subject) || is_nx_object(subject)),
    kind("event code", |subject| matches!(subject, Subject::Event(_))),
    kind("event", |subject| matches!(subject, Subject::Event(_))),
    kind("text id", |subject| matches!(subject, Subject::Event(_))),
    kind("emergency error code", |subject| matches!(subject, Subject::Emergency(_))),
    kind("emergency", |subject| matches!(subject, Subject::Emergency(_))),
    kind("al status code", |subject| matches!(subject, Subject::AlStatus(_))),
    kind("al status", |subject| matches!(subject, Subject::AlStatus(_))),
    kind("sdo abort code", |subject| matches!(subject, Subject::Abort(_))),
    kind("abort code", |subject| matches!(subject, Subject::Abort(_))),
    kind("sdo abort", |subject| matches!(subject, Subject::Abort(_))),
    kind("register", |subject| matches!(subject, Subject::Register(_))),
    kind("indicator", |subject| matches!(subject, Subject::Indicator(_))),
    kind("pattern", |subject| matches!(subject, Subject::Pattern(_))),
    kind("i/o port", |subject| matches!(subject, Subject::Port(_))),
    kind("key", |subject| matches!(subject, Subject::Key(_))),
    kind("structured text", |subject| matches!(subject, Subject::Library(_))),
    kind("setting rule", |subject| matches!(subject, Subject::Rule(_))),
    kind("rule", |subject| matches!(subject, Subject::Rule(_))),
    kind("errorid", |subject| matches!(subject, Subject::Documented(DocumentedKind::ErrorId, _))),
    kind("data type", |subject| matches!(subject, Subject::Documented(DocumentedKind::DataType, _))),
    kind("fault of scenarios", |subject| matches!(subject, Subject::Documented(DocumentedKind::Fault, _))),
    kind("fault", |subject| matches!(subject, Subject::Documented(DocumentedKind::Fault, _))),
    kind("variable", |subject| matches!(subject, Subject::Documented(DocumentedKind::Variable, _) | Subject::Port(_))),
    kind("counter", |subject| matches!(subject, Subject::Documented(DocumentedKind::Counter, _))),
    kind("word", |subject| matches!(subject, Subject::Word(_))),
];

const fn is_object(subject: &Subject) -> bool {
    matches!(subject, Subject::Object(_) | Subject::Entry(..))
}

const fn is_nx_object(subject: &Subject) -> bool {
    matches!(subject, Subject::NxObject(_) | Subject::NxEntry(..))
}

/// The kind and the rest of `text`; none if it does not begin with a kind. A number may follow directly: `NX6000:01`.
pub(super) fn split(text: &str) -> Option<(&'static Kind, &str)> {
    let text = text.trim();
    KINDS.iter().find_map(|kind| {
        let (words, rest) = text.split_at_checked(kind.words.len())?;
        let ends = rest.starts_with(|next: char| next.is_whitespace() || next.is_ascii_digit());
        (ends && words.eq_ignore_ascii_case(kind.words)).then(|| (kind, rest.trim()))
    })
}
