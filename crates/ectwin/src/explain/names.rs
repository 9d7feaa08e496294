//! Names of the tables and words of the glossary: the subjects of a text, and the nearest name.

use std::sync::LazyLock;

use coe_kit::indicators::Pattern;
use esc::REGISTERS;
use objects::ObjectCode;

use super::tables::tables;
use super::{Subject, documented, glossary, indicator, key, library, port, rule};

static ALL: LazyLock<Vec<Name>> = LazyLock::new(|| all().map(Name::new).collect());

/// A name and its subject.
#[derive(Debug)]
struct Name {
    text: String,
    /// The text in one case, without spaces and punctuation.
    letters: String,
    subject: Subject,
}

impl Name {
    fn new((text, subject): (String, Subject)) -> Self {
        Self { letters: letters(&text), text, subject }
    }
}

/// All subjects with the name `text`; case, spaces and punctuation are ignored.
pub(super) fn subjects(text: &str) -> Vec<Subject> {
    let wanted = letters(text);
    if wanted.is_empty() {
        return Vec::new();
    }
    let mut found: Vec<Subject> = Vec::new();
    for name in ALL.iter().filter(|name| name.letters == wanted) {
        if !found.contains(&name.subject) {
            found.push(name.subject);
        }
    }
    found
}

/// All subjects whose names contain the words of `text` in sequence, ignoring case.
pub(super) fn containing(text: &str) -> Vec<Subject> {
    let wanted = words(text);
    if letters(text).chars().filter(|letter| letter.is_alphabetic()).count() < 3 {
        return Vec::new();
    }
    let mut found: Vec<Subject> = Vec::new();
    for Name { text, subject, .. } in ALL.iter() {
        if words(text).windows(wanted.len()).any(|part| part == wanted) && !found.contains(subject) {
            found.push(*subject);
        }
    }
    found
}

/// A name that differs from `text` in one or two letters; none if there is none.
pub(super) fn near(text: &str) -> Option<&'static str> {
    let wanted = letters(text);
    let differing_max = match wanted.len() {
        0..=3 => return None,
        4..=7 => 1,
        _ => 2,
    };
    let is_as_long = |name: &&Name| name.letters.len().abs_diff(wanted.len()) <= differing_max;
    let by_distance =
        ALL.iter().filter(is_as_long).map(|name| (strsim::osa_distance(&name.letters, &wanted), name));
    let nearest = by_distance.min_by_key(|(distance, _)| *distance);
    nearest.filter(|(distance, _)| *distance <= differing_max).map(|(_, name)| name.text.as_str())
}

fn letters(text: &str) -> String {
    text.chars().filter(|letter| letter.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

fn words(text: &str) -> Vec<String> {
    let words = text.split(|letter: char| !letter.is_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_lowercase).collect()
}

pub(super) fn all() -> impl Iterator<Item = (String, Subject)> {
    let rows = glossary::rows_of_words().map(|row| (row, row));
    let words = glossary::words().chain(rows).map(|(word, row)| (word.to_owned(), Subject::Word(row)));
    let patterns = Pattern::ALL.map(|pattern| (pattern.id().to_owned(), Subject::Pattern(pattern)));
    let events = tables().events.iter().map(|event| (event.name.to_owned(), Subject::Event(event.code)));
    let objects = tables().objects.iter().map(|object| (object.name.clone(), Subject::Object(object.index)));
    let nx_objects =
        tables().nx_objects.iter().map(|object| (object.name.clone(), Subject::NxObject(object.index)));
    let registers =
        REGISTERS.iter().map(|register| (register.name.to_owned(), Subject::Register(register.offset)));
    let indicators = indicator::names().flat_map(indicator_names);
    let keys = key::names().map(|(name, path)| (name.to_owned(), Subject::Key(path)));
    let library = library::names().map(|name| (name.to_owned(), Subject::Library(name)));
    let ports = port::names().map(|(name, port)| (name.to_owned(), Subject::Port(port)));
    let named_bits = tables().named_bits.iter();
    let named_bits =
        named_bits.map(|bit| (bit.name.to_owned(), Subject::Entry(bit.entry.index, bit.entry.sub)));
    let of_model = events.chain(objects).chain(nx_objects).chain(entries()).chain(ports).chain(named_bits);
    let lights = indicator::lights().map(|(words, name)| (words, Subject::Indicator(name)));
    let of_unit = indicators.chain(lights).chain(patterns).chain(words).chain(keys).chain(of_model);
    let rules = rule::names().map(|name| (name.to_owned(), Subject::Rule(name)));
    let documented = documented::names().map(|(name, subject)| (name.to_owned(), subject));
    of_unit.chain(registers).chain(library).chain(rules).chain(documented)
}

/// The entries of all objects. That of a variable is the object, with the same name.
fn entries() -> impl Iterator<Item = (String, Subject)> {
    let objects = tables().objects.iter().filter(|object| object.code != ObjectCode::Variable);
    let entries = objects.flat_map(|object| {
        object.entries.iter().map(|entry| (entry.name.clone(), Subject::Entry(object.index, entry.sub)))
    });
    let nx_entries = tables().nx_objects.iter().flat_map(|object| {
        object.entries.iter().map(|entry| (entry.name.clone(), Subject::NxEntry(object.index, entry.sub)))
    });
    entries.chain(nx_entries)
}

/// `L/A IN` is one of the two indicators named `L/A`.
fn indicator_names(name: &'static str) -> impl Iterator<Item = (String, Subject)> {
    let kind = name.split_once(' ').map(|(kind, _)| kind);
    [Some(name), kind].into_iter().flatten().map(move |known| (known.to_owned(), Subject::Indicator(name)))
}
