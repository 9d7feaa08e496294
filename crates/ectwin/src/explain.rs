//! `ectwin explain WHAT`: the meaning of a code, an object, a register, an indicator or a word, and the correction.
//!
//! A text may have several meanings: 0x0020 is an AL status code, an ESC register, and in a diagnosis message
//! the event 00200000. [`explain`] returns all of them, as facts under headings; [`event_pages`] writes the
//! same facts as the pages of docs/events. Names and meanings come from the tables of the model and from tables in
//! the pages of docs.

mod al_status;
mod al_status_codes;
mod documented;
mod emergency;
mod event;
mod explanation;
mod glossary;
mod indicator;
mod key;
mod kind;
mod library;
mod names;
mod number;
mod object;
mod page;
mod pages;
mod port;
mod register;
mod register_bits;
mod rule;
mod sdo_abort_codes;
mod subject;
mod tables;
#[cfg(test)]
mod tests;
mod unexplained;
mod unknown;

use wire::SdoAbort;

pub use explanation::Explanation;
use kind::Kind;
use number::Number;
pub use pages::{Page, event_pages};
pub use subject::{DocumentedKind, Subject};
pub use unexplained::Unexplained;
pub use unit_model::tables::{Advice, Fact, Section};

/// Longer than every name of the tables.
const TEXT_BYTES_MAX: usize = 200;
/// Maximum number of meanings of one name that are explained completely.
const WHOLE_MAX: usize = 3;
/// Maximum number of names with a common part that are shown.
const PARTS_MAX: usize = 20;

/// Explains `text`: a code, an index or a register in hexadecimal digits, with or without `0x`, `hex` and
/// underscores; an object's entry, such as `10F3:05`; a name of the tables, a function or block of Structured Text,
/// a key of the unit file or a word of the glossary; or words that are part of such names. A kind before it, as in
/// `NX 6000:01`, excludes meanings of other kinds. Returns all its meanings, at least one.
///
/// # Errors
/// It is in no table.
pub fn explain(text: &str) -> Result<Vec<Explanation>, Unexplained> {
    if text.len() > TEXT_BYTES_MAX {
        return Err(unknown::too_long(text));
    }
    let meant = meant_by(text);
    match kind::split(text) {
        Some((kind, rest)) if meant.is_err() => of_kind(kind, rest).unwrap_or(meant),
        _ => meant,
    }
}

/// The meaning of the rest of a text as this kind; none if it has another meaning, or is not as definite as a number.
fn of_kind(kind: &Kind, rest: &str) -> Option<Result<Vec<Explanation>, Unexplained>> {
    match meant_by(rest) {
        Ok(meanings) => {
            let of_kind: Vec<_> =
                meanings.into_iter().filter(|known| (kind.includes)(&known.subject)).collect();
            (!of_kind.is_empty()).then_some(Ok(of_kind))
        }
        Err(unexplained) => {
            rest.starts_with(|first: char| first.is_ascii_digit()).then_some(Err(unexplained))
        }
    }
}

fn meant_by(text: &str) -> Result<Vec<Explanation>, Unexplained> {
    if let Some(entry) = object::EntryNumber::parse(text) {
        return entry.explanations();
    }
    let number = Number::parse(text);
    let codes = number.into_iter().flat_map(Number::subjects);
    let meanings: Vec<_> = codes.chain(names::subjects(text)).filter_map(explanation).collect();
    match (meanings.is_empty(), number) {
        (false, _) => Ok(shortened(meanings, WHOLE_MAX)),
        (true, Some(number)) => Err(unknown::number(number, number.near().and_then(explanation))),
        (true, None) => named_by_a_part(text),
    }
}

/// The names that contain the words of `text`.
fn named_by_a_part(text: &str) -> Result<Vec<Explanation>, Unexplained> {
    let meanings: Vec<_> = names::containing(text).into_iter().filter_map(explanation).collect();
    match meanings.len() {
        0 => Err(unknown::name(text)),
        1..=PARTS_MAX => Ok(shortened(meanings, 1)),
        _ => Err(unknown::part(text, &meanings)),
    }
}

/// If there are more explanations than this, only their first lines are shown.
fn shortened(meanings: Vec<Explanation>, whole_max: usize) -> Vec<Explanation> {
    if meanings.len() <= whole_max {
        return meanings;
    }
    meanings.into_iter().map(first_line).collect()
}

/// Its kind and its name; for an entry, also the object's name.
fn first_line(known: Explanation) -> Explanation {
    let object = object::name_around(known.subject);
    let name = object.map_or_else(|| known.name.clone(), |object| format!("{}, {object}", known.name));
    Explanation { name, facts: Vec::new(), advice: Vec::new(), sections: Vec::new(), ..known }
}

/// The explanations as text: with an empty line between two, but not between first lines.
#[must_use]
pub fn to_text(explanations: &[Explanation]) -> String {
    let is_line = |known: &Explanation| known.facts.is_empty() && known.sections.is_empty();
    let between = if explanations.iter().all(is_line) { "\n" } else { "\n\n" };
    explanations.iter().map(ToString::to_string).collect::<Vec<_>>().join(between)
}

/// The explanation; none if it is in no table.
fn explanation(subject: Subject) -> Option<Explanation> {
    match subject {
        Subject::Event(code) => event::explanation(code),
        Subject::Emergency(code) => emergency::explanation(code),
        Subject::AlStatus(code) => al_status::explanation(code),
        Subject::Abort(code) => abort(code),
        Subject::Object(index) => object::object(index),
        Subject::Entry(index, sub) => object::entry(index, sub),
        Subject::NxObject(index) => object::nx_object(index),
        Subject::NxEntry(index, sub) => object::nx_entry(index, sub),
        Subject::Register(offset) => register::explanation(offset),
        Subject::Indicator(name) => indicator::explanation(name),
        Subject::Pattern(pattern) => Some(indicator::pattern(pattern)),
        Subject::Port(name) => port::explanation(name),
        Subject::Key(path) => key::explanation(path),
        Subject::Library(name) => library::explanation(name),
        Subject::Rule(name) => rule::explanation(name),
        Subject::Documented(kind, names) => documented::explanation(kind, names),
        Subject::Word(word) => glossary::explanation(word),
    }
}

fn abort(code: SdoAbort) -> Option<Explanation> {
    let (_, advice) = sdo_abort_codes::ADVICE.iter().find(|(known, _)| *known == code)?;
    Some(Explanation {
        subject: Subject::Abort(code),
        name: code.row()?.meaning.into(),
        facts: Vec::new(),
        advice: vec![advice.clone()],
        sections: Vec::new(),
    })
}
